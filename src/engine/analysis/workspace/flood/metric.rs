//! Distances between configurations and between tangents, and the test for one mode.

use std::f64::consts::PI;

use super::arrivals::TangentSolutionRef;
use super::step::SURE;
use crate::analysis::workspace::problem::MapProblem;
use crate::linear::norm;
use crate::mechanism::{ConfigurationRef, Role, turn_near};
use crate::number::tolerance::SAME;
use crate::solve::SolutionCurve;
use crate::system::{Curve, Held, Unknown};

#[derive(Clone, Debug)]
pub(crate) struct Metric {
    free: Curve,
    /// Unknowns that distinguish modes: of platforms, actuated joints and joints with limits;
    /// without platforms of all joints. Legs that are folded the other way about their passive
    /// joints, or spin, do not make another mode. 1 for those that do, 0 for the others.
    seen: Vec<f64>,
    /// Joints among them.
    joints: Vec<SeenJoint>,
    /// rad or m in one unit of the mapped coordinates.
    units: Vec<f64>,
}

/// A joint that distinguishes modes.
#[derive(Clone, Copy, Debug)]
struct SeenJoint {
    joint: usize,
    /// Its place among the unknowns.
    place: usize,
    scale: f64,
    repeats: bool,
}

/// Tangent prediction from one configuration for a step along an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prediction<'a> {
    from: TangentSolutionRef<'a>,
    axis: usize,
    change: f64,
    motion: &'a [f64],
    /// Distance along the motion.
    factor: f64,
    /// Largest distance of the solution from the prediction.
    miss: f64,
}

impl Metric {
    pub fn new(problem: &MapProblem) -> Self {
        let mechanism = problem.mechanism;
        let free = Curve::new(mechanism, &Held::nothing(mechanism));
        let whole = mechanism.platforms().is_empty();
        let seen = (free.system().unknowns().iter()).map(|unknown| match *unknown {
            Unknown::Joint(joint) => {
                let joint = &mechanism.joints()[joint];
                whole || joint.role == Role::Actuated || joint.limits.is_some()
            }
            Unknown::Twist(..) => true,
        });
        let seen: Vec<bool> = seen.collect();
        let unknowns = free.system().unknowns().iter().enumerate();
        let joints = unknowns.filter(|(place, _)| seen[*place]);
        let joints = joints.filter_map(|(place, unknown)| match *unknown {
            Unknown::Joint(joint) => Some(SeenJoint {
                joint,
                place,
                scale: free.system().joint_scale(joint),
                repeats: mechanism.repeats(joint),
            }),
            Unknown::Twist(..) => None,
        });
        Metric {
            joints: joints.collect(),
            seen: seen
                .into_iter()
                .map(|seen| f64::from(u8::from(seen)))
                .collect(),
            units: (problem.axes.iter())
                .map(|axis| axis.coordinate.scale(mechanism))
                .collect(),
            free,
        }
    }

    /// True if two configurations are equal in all unknowns that distinguish modes.
    pub fn same(&self, a: ConfigurationRef<f64>, b: ConfigurationRef<f64>) -> bool {
        // most that are not are recognised by one joint
        let mut joints = self.joints.iter();
        if joints.any(|joint| joint.change(a, b).abs() >= SAME) {
            return false;
        }
        let mut step = vec![0.0; self.free.unknowns()];
        self.free.difference_but_turns_into(a, b, &mut step);
        self.seen_length(step.into_iter()) < SAME
    }

    /// True if two configurations of one node are equal in all unknowns that distinguish modes and belong to one mode.
    /// Two modes may meet there by chance, as the lengths of cylinders are equal for an arm bent to the one and to the
    /// other side: from there they go on in different ways.
    pub fn meets(&self, a: TangentSolutionRef, b: TangentSolutionRef) -> bool {
        if !self.same(a.at, b.at) {
            return false;
        }
        if self.apart(a.at, b.at) < SAME {
            return true;
        }
        let (mut change, mut size) = (0.0, 0.0);
        let of_modes = self.seen.iter().cycle();
        for ((a, b), seen) in a.motions.iter().zip(b.motions).zip(of_modes) {
            change += seen * (a - b) * (a - b);
            size += seen * f64::max(a * a, b * b);
        }
        // motions of one mode differ by 1e-4, from conditioning
        change <= 1e-8 * size
    }

    /// Distance of two configurations in all unknowns, in rad and characteristic lengths.
    pub fn apart(&self, a: ConfigurationRef<f64>, b: ConfigurationRef<f64>) -> f64 {
        let mut step = vec![0.0; self.free.unknowns()];
        self.free.difference_but_turns_into(a, b, &mut step);
        norm(&step)
    }

    fn seen_length(&self, step: impl Iterator<Item = f64>) -> f64 {
        let squares = step.zip(&self.seen).map(|(x, seen)| seen * x * x);
        squares.sum::<f64>().sqrt()
    }

    /// The motion for a unit rate of a mapped coordinate, and how far a change leads along it.
    pub fn motion<'a>(
        &self,
        from: TangentSolutionRef<'a>,
        axis: usize,
        change: f64,
    ) -> (&'a [f64], f64) {
        let unknowns = self.free.unknowns();
        let motion = &from.motions[axis * unknowns..][..unknowns];
        (motion, change / self.units[axis])
    }

    /// The tangent prediction for a change of a mapped coordinate.
    pub fn ahead<'a>(
        &self,
        from: TangentSolutionRef<'a>,
        axis: usize,
        change: f64,
    ) -> Prediction<'a> {
        let (motion, factor) = self.motion(from, axis, change);
        let length = self.seen_length(motion.iter().map(|x| x * factor));
        Prediction {
            from,
            axis,
            change,
            motion,
            factor,
            miss: SURE * length + SAME,
        }
    }

    /// True if each of two configurations lies where the tangent of the other predicts it, and the
    /// motions are [alike](Self::alike).
    ///
    /// All joints must lie there, also those that do not distinguish modes: what does may be near
    /// by chance, as the lengths of two cylinders are about the same on both sides of the arm that
    /// they move. Where legs are folded otherwise, a step decides.
    pub fn linked(
        &self,
        ahead: &Prediction,
        to: TangentSolutionRef,
        storage: &mut Vec<f64>,
    ) -> bool {
        let from = ahead.from;
        // most that lie elsewhere are recognised by one joint
        let mut joints = self.joints.iter();
        let elsewhere = joints.any(|joint| {
            let wanted = ahead.motion[joint.place] * ahead.factor;
            (joint.change(from.at, to.at) - wanted).abs() > ahead.miss
        });
        if elsewhere {
            return false;
        }
        storage.resize(self.free.unknowns(), 0.0);
        let step = &mut storage[..];
        self.free.difference_but_turns_into(from.at, to.at, step);
        let near = |ahead: &Prediction| {
            let (mut seen, mut all) = (0.0, 0.0);
            for ((x, d), of_modes) in ahead.motion.iter().zip(&*step).zip(&self.seen) {
                let squared = (d - x * ahead.factor).powi(2);
                seen += of_modes * squared;
                all += squared;
            }
            let reach = SURE * ahead.factor.abs() * norm(ahead.motion) + SAME;
            seen <= ahead.miss * ahead.miss && all <= reach * reach
        };
        near(ahead)
            && near(&self.ahead(to, ahead.axis, ahead.change))
            && self.alike(from, to, ahead.change / self.units[ahead.axis], storage)
    }

    /// True if the motions at two configurations, a step of the given length of the mapped
    /// coordinates apart, are near enough for these to be on one solution.
    ///
    /// With M as in [`Rates`](super::rates::Rates), N₁ − N₀ = −M₁⁺(M₁ − M₀) N₀ is short relative to N
    /// wherever Newton's theorem makes a step sure. Across a point where legs fold the
    /// configuration may go on smoothly, and only motions to the side tell: they turn round. Where
    /// one leg folds, as one of length ρ = 0, that may be seen in one passive joint only: it turns
    /// by dθ = ds/ρ to one side before and to the other after, so that over a step s from −ρ₀ to ρ₁
    /// the difference of both is s/ρ₀ + s/ρ₁ ≥ 4 rad. No joint is to differ by so much.
    pub fn alike(
        &self,
        a: TangentSolutionRef,
        b: TangentSolutionRef,
        length: f64,
        storage: &mut Vec<f64>,
    ) -> bool {
        let unknowns = self.free.unknowns();
        storage.clear();
        storage.resize(unknowns, 0.0);
        let swings = &mut storage[..];
        let columns = a.motions.chunks_exact(unknowns);
        let mut columns = columns.zip(b.motions.chunks_exact(unknowns));
        let same_way = columns.all(|(a, b)| {
            let [mut change, mut from, mut to] = [0.0; 3];
            let pairs = a.iter().zip(b).zip(&self.seen);
            for (((a, b), seen), swing) in pairs.zip(&mut *swings) {
                let squared = (b - a) * (b - a);
                *swing += squared;
                change += seen * squared;
                from += seen * a * a;
                to += seen * b * b;
            }
            // motions change by less than 0.6 of the longer
            change <= 0.36 * f64::max(from, to)
        });
        // no unknown goes by 1 rad or characteristic length off the line
        let most = 1.0 / length.abs();
        same_way && swings.iter().all(|swing| *swing <= most * most)
    }
}

impl SeenJoint {
    /// Change of the joint from one configuration to another, dimensionless, without turns that change nothing.
    fn change(&self, from: ConfigurationRef<f64>, to: ConfigurationRef<f64>) -> f64 {
        let change = (to.joints[self.joint] - from.joints[self.joint]) / self.scale;
        match self.repeats && change.abs() > PI {
            true => turn_near(change, 0.0),
            false => change,
        }
    }
}
