//! Reduction of joint angles modulo a full turn, for reports.

use std::f64::consts::{PI, TAU};

use super::model::JointKind;
use super::{Dimensions, Mechanism};
use crate::number::tolerance::{ROUNDING, SOLVED};

/// The equivalent of an angle that is nearest to another, in rad.
#[inline]
pub fn turn_near(angle: f64, to: f64) -> f64 {
    angle - TAU * turns(angle - to)
}

/// The whole turns nearest to an angle in rad.
#[inline]
pub fn turns(angle: f64) -> f64 {
    (angle / TAU).round()
}

/// The equivalent angle in (−π, π], in rad. −π and π are the same angle, and rounding must not decide which
/// is reported: values this near to −π become those near π.
pub fn principal(angle: f64, rounding: f64) -> f64 {
    let within = turn_near(angle, 0.0);
    match within <= -PI + rounding {
        true => within + TAU,
        false => within,
    }
}

impl Mechanism {
    /// True if a full turn of the joint leaves every frame where it is; false if it also slides, or if
    /// its variable turns some row by a fraction.
    pub fn repeats(&self, joint: usize) -> bool {
        self.cycles[joint] == Some(1.0)
    }

    /// Number of turns of the joint after which every frame is where it was: more than one where a gear turns something
    /// by a
    /// fraction. `None` if it also slides, or if a ratio is no fraction.
    pub fn turns_to_repeat(&self, joint: usize) -> Option<f64> {
        self.cycles[joint]
    }

    pub(super) fn infer_cycles(&mut self) {
        let revolute = |joint: usize| self.joints[joint].kind == JointKind::Revolute;
        let cycles = turns_to_repeat(&self.dimensions, self.joints.len());
        let cycles = cycles.into_iter().enumerate();
        self.cycles = cycles
            .map(|(joint, turns)| turns.filter(|_| revolute(joint)))
            .collect();
    }

    /// The mechanism with joints that go as far as the links let them.
    pub fn without_limits(&self) -> Mechanism {
        let mut free = self.clone();
        free.joints.iter_mut().for_each(|joint| joint.limits = None);
        free
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

    /// The value for reports where a joint that turns something by a fraction also has an equivalent nearest to zero.
    pub fn within_cycle(&self, joint: usize, value: f64) -> f64 {
        match (self.cycles[joint], self.joints[joint].limits) {
            (Some(turns), None) => turns * principal(value / turns, ROUNDING),
            _ => self.as_given(joint, value),
        }
    }
}

/// Number of turns of each joint after which everything that it turns is where it was; `None` where a ratio is no
/// fraction or a relation is not linear.
pub fn turns_to_repeat(dimensions: &Dimensions<f64>, joints: usize) -> Vec<Option<f64>> {
    /// Gears have some dozen teeth.
    const MOST: u32 = 120;
    let mut ratios = vec![Vec::new(); joints];
    for row in dimensions.chains.iter().flat_map(|chain| &chain.rows) {
        for &(joint, ratio) in &row.turn.0 {
            ratios[joint].push(ratio);
        }
    }
    let whole = |x: f64| (x - x.round()).abs() <= SOLVED * x.abs();
    let turns = |of: &Vec<f64>| {
        let mut turns = (1..=MOST).map(f64::from);
        turns.find(|n| of.iter().all(|ratio| whole(n * ratio)))
    };
    let mut turns: Vec<Option<f64>> = ratios.iter().map(turns).collect();
    let relations = dimensions.closures.iter().flat_map(|c| &c.relation);
    for &joint in relations.flat_map(|relation| relation.joints.iter()) {
        turns[joint] = None;
    }
    turns
}
