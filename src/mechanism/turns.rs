//! Reduction of joint angles modulo a full turn, for reports.

use std::f64::consts::{PI, TAU};

use super::Mechanism;
use super::model::{Joint, JointKind};

/// As much as `Joint::allows`, in rad or m.
const ROUNDING: f64 = 1e-9;

/// The equivalent of an angle that is nearest to another, in rad.
#[inline]
pub(crate) fn turn_near(angle: f64, to: f64) -> f64 {
    angle - TAU * turns(angle - to)
}

/// The whole turns nearest to an angle in rad.
#[inline]
pub(crate) fn turns(angle: f64) -> f64 {
    (angle / TAU).round()
}

/// The equivalent angle in (−π, π], in rad. −π and π are the same angle, and rounding must not decide which
/// is reported: values this near to −π become those near π.
pub(crate) fn principal(angle: f64, rounding: f64) -> f64 {
    let within = turn_near(angle, 0.0);
    match within <= -PI + rounding {
        true => within + TAU,
        false => within,
    }
}

impl Mechanism {
    /// Whether a full turn of the joint leaves every frame where it is: not if it also slides, or if
    /// its variable turns some row by a fraction.
    pub fn repeats(&self, joint: usize) -> bool {
        self.repeating[joint]
    }

    pub(super) fn infer_repeating(&mut self) {
        let revolute = |joint: &Joint| joint.kind == JointKind::Revolute;
        self.repeating = self.joints.iter().map(revolute).collect();
        let rows = self.dimensions.chains.iter().flat_map(|chain| &chain.rows);
        for &(joint, factor) in rows.flat_map(|row| &row.turn.0) {
            self.repeating[joint] &= factor == factor.round();
        }
    }

    /// The joints that are outside their limits.
    pub fn outside_limits(&self, joints: &[f64]) -> impl Iterator<Item = usize> {
        let joints = self.joints.iter().zip(joints).enumerate();
        joints.filter_map(|(i, (joint, value))| (!joint.allows(*value)).then_some(i))
    }

    /// Brings joints with limits, where full turns change nothing, to the nearest equivalent value within the limits; where
    /// there is none, to the one nearest their middle.
    pub fn turn_to_limits(&self, joints: &mut [f64]) {
        for (joint, value) in joints.iter_mut().enumerate() {
            *value = self.turned_near(joint, *value, *value);
        }
    }

    /// The equivalent of a value of a joint that is nearest to another, brought within limits as above; the value itself
    /// where full turns change something.
    pub fn turned_near(&self, joint: usize, value: f64, to: f64) -> f64 {
        if !self.repeats(joint) {
            return value;
        }
        let turned = self.by_limits(joint, turn_near(value, to));
        match self.joints[joint].limits {
            Some((low, high)) if !self.joints[joint].allows(turned) => {
                turn_near(turned, 0.5 * (low + high))
            }
            _ => turned,
        }
    }

    /// The value near which a joint is reported where no guess or earlier configuration leads to it: home if it has
    /// limits, otherwise the whole turns nearest home.
    pub fn home_turn(&self, joint: usize) -> f64 {
        let of = &self.joints[joint];
        match of.limits {
            Some(_) => of.home,
            None => TAU * turns(of.home),
        }
    }

    /// The equivalent value of a joint within its limits that is nearest to it, where full turns
    /// change nothing and there is one; otherwise the value itself. In rad or m.
    pub fn by_limits(&self, joint: usize, value: f64) -> f64 {
        let Some((low, high)) = self.joints[joint].limits else {
            return value;
        };
        let (below, above) = (low - ROUNDING - value, value - high - ROUNDING);
        let turned = match (below > 0.0, above > 0.0) {
            (true, _) => value + TAU * (below / TAU).ceil(),
            (_, true) => value - TAU * (above / TAU).ceil(),
            _ => value,
        };
        let within = turned >= low - ROUNDING && turned <= high + ROUNDING;
        if self.repeats(joint) && within {
            turned
        } else {
            value
        }
    }

    /// The value of a joint for reports: where full turns change nothing, the equivalent value within its
    /// limits, or else in (−π, π]. In rad or m.
    pub fn as_given(&self, joint: usize, value: f64) -> f64 {
        let of = &self.joints[joint];
        match (self.repeats(joint), of.limits) {
            (false, _) => value,
            (true, Some(_)) if of.allows(value) => self.by_limits(joint, value),
            (true, _) => principal(value, ROUNDING),
        }
    }
}
