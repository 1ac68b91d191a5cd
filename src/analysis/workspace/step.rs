//! From a node to its neighbour: several such steps side by side.

use super::asked::{Asked, Targets};
use super::rates::{Rates, Told};
use crate::linear::{Factorable, norm};
use crate::mechanism::{Configuration, Role};
use crate::number::Packed;
use crate::solve::{Equations, SolutionCurve};
use crate::system::{Curve, Held, Holdable, System, Unknown, Work};

/// Where a step begins.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// Near what is looked for.
    pub guess: Configuration<f64>,
    /// How far that may be, dimensionless.
    pub reach: f64,
    /// The mapped coordinates there.
    pub values: Vec<f64>,
}

/// An assembled configuration at a node.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    pub at: Configuration<f64>,
    /// The motions for unit rates of the mapped coordinates, dimensionless.
    pub motions: Vec<Vec<f64>>,
    pub told: Told,
}

/// Newton's method in several places at once. A place whose steps are too long stands still from
/// there on and does no harm to the others.
#[derive(Clone, Debug)]
pub(super) struct Steps<T: Factorable> {
    targets: Targets,
    system: System<T>,
    work: Work<T>,
    spare: Configuration<T>,
    pub rates: Rates<T>,
    axes: usize,
}

/// The part of a step that its first correction may be, and of a correction that the next may be:
/// beyond it another solution may be as near.
pub(super) const SURE: f64 = 0.3;

impl<T: Factorable + Packed> Steps<T> {
    pub fn new(asked: &Asked) -> Self {
        let system: System<T> = asked.question.system_over();
        Steps {
            targets: Targets::new(asked),
            work: system.work(),
            system,
            spare: asked.question.start().map(T::from_f64),
            rates: Rates::new(asked),
            axes: asked.axes.len(),
        }
    }

    /// The configurations that are surely meant; at most as many starts as places.
    pub fn settle(&mut self, starts: &[Start]) -> Vec<Option<Arrival>> {
        const STEPS: usize = 8;
        const TOLERANCE: f64 = 1e-12;
        /// Corrections this small are rounding.
        const SMALL: f64 = 1e-9;
        let start = |place: usize| &starts[place.min(starts.len() - 1)];
        let mut point = self.packed(|place| &start(place).guess);
        let values: Vec<Vec<f64>> = (0..T::WIDTH).map(|p| start(p).values.clone()).collect();
        self.targets.ask(&mut self.system, &mut point, &values);
        let mut sure = vec![true; T::WIDTH];
        let mut solved = vec![false; T::WIDTH];
        let mut bounds: Vec<f64> = (0..T::WIDTH).map(|place| start(place).reach).collect();
        for step in 0..=STEPS {
            self.system.linearise(&point, &mut self.work);
            for (place, solved) in solved.iter_mut().enumerate() {
                let rows = self.system.residual_of(&self.work).iter();
                // a NaN is not small
                *solved = rows
                    .map(|row| row.part(place).abs())
                    .all(|row| row <= TOLERANCE);
            }
            if step == STEPS
                || solved
                    .iter()
                    .zip(&sure)
                    .all(|(solved, sure)| *solved || !sure)
            {
                break;
            }
            self.system.factorise(0.0, &mut self.work);
            self.system.step(&mut self.work);
            let steps = self.system.step_mut(&mut self.work);
            let square = |place: usize| steps.iter().map(|x| x.part(place) * x.part(place)).sum();
            let sizes: Vec<f64> = (0..T::WIDTH).map(|p| f64::sqrt(square(p))).collect();
            let mut moves = vec![0.0; T::WIDTH];
            for place in 0..T::WIDTH {
                if solved[place] || !sure[place] {
                    continue;
                }
                sure[place] = sizes[place] <= bounds[place].max(SMALL);
                bounds[place] = SURE * sizes[place];
                moves[place] = f64::from(u8::from(sure[place]));
            }
            for x in steps.iter_mut() {
                let old = *x;
                // not a product: what is not finite is to stay behind
                *x = T::of_parts(|p| if moves[p] > 0.0 { old.part(p) } else { 0.0 });
            }
            let (from, to) = (&point, &mut self.spare);
            self.system.advance(from, 1.0, &self.work, to);
            std::mem::swap(&mut point, &mut self.spare);
        }
        let told = self.rates.at(&point);
        (0..starts.len())
            .map(|place| {
                let told = &told[place];
                (sure[place] && solved[place] && told.regular).then(|| Arrival {
                    at: point.map(|x| x.part(place)),
                    motions: (0..self.axes)
                        .map(|i| self.rates.motion(i, place))
                        .collect(),
                    told: told.clone(),
                })
            })
            .collect()
    }

    fn packed<'c>(&self, of: impl Fn(usize) -> &'c Configuration<f64>) -> Configuration<T> {
        let mut all = self.spare.clone();
        for (joint, to) in all.joints.iter_mut().enumerate() {
            *to = T::of_parts(|place| of(place).joints[joint]);
        }
        for (platform, to) in all.platforms.iter_mut().enumerate() {
            for k in 0..4 {
                to.orientation.0[k] =
                    T::of_parts(|place| of(place).platforms[platform].orientation.0[k]);
            }
            for k in 0..3 {
                to.position.0[k] = T::of_parts(|place| of(place).platforms[platform].position.0[k]);
            }
        }
        all
    }
}

/// How far configurations are apart.
#[derive(Clone, Debug)]
pub(super) struct Measure {
    free: Curve,
    /// Unknowns that tell modes apart: of platforms, actuated joints and joints with limits; without
    /// platforms of all joints. Legs that are folded the other way about their passive joints, or
    /// spin, do not make another mode.
    seen: Vec<bool>,
    /// rad or m in one unit of the mapped coordinates.
    units: Vec<f64>,
}

impl Measure {
    pub fn new(asked: &Asked) -> Self {
        let mechanism = asked.mechanism;
        let free = Curve::new(mechanism, &Held::nothing(mechanism));
        let whole = mechanism.platforms().is_empty();
        let seen = free
            .system()
            .unknowns()
            .iter()
            .map(|unknown| match *unknown {
                Unknown::Joint(joint) => {
                    let joint = &mechanism.joints()[joint];
                    whole || joint.role == Role::Actuated || joint.limits.is_some()
                }
                Unknown::Twist { .. } => true,
            });
        Measure {
            seen: seen.collect(),
            units: (asked.axes.iter())
                .map(|axis| match axis.coordinate {
                    Holdable::Joint(joint) => free.system().joint_scale(joint),
                    Holdable::Coordinate(_, c) if !c.is_angle() => {
                        mechanism.characteristic_length()
                    }
                    Holdable::Coordinate(..) | Holdable::Turn(..) => 1.0,
                })
                .collect(),
            free,
        }
    }

    /// How far two configurations are apart, so far as modes are concerned.
    pub fn apart(&self, a: &Configuration<f64>, b: &Configuration<f64>) -> f64 {
        let step = self.free.difference_but_turns(a, b);
        let seen = step.iter().zip(&self.seen).filter(|(_, seen)| **seen);
        seen.map(|(x, _)| x * x).sum::<f64>().sqrt()
    }

    /// Whether the motions at two configurations are near enough for these to be on one sheet.
    ///
    /// With M as in [`Rates`], N₁ − N₀ = −M₁⁺(M₁ − M₀) N₀ is short beside N wherever Newton's
    /// theorem makes a step sure. Across a point where several legs fold at once the configuration
    /// may go on smoothly, and only motions to the side tell: they turn round.
    pub fn alike(&self, a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
        const CHANGE: f64 = 0.6;
        let seen = |motion: &[f64]| {
            let seen = motion.iter().zip(&self.seen).filter(|(_, seen)| **seen);
            seen.map(|(x, _)| x * x).sum::<f64>().sqrt()
        };
        a.iter().zip(b).all(|(a, b)| {
            let change: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
            seen(&change) <= CHANGE * seen(a).max(seen(b))
        })
    }

    /// Where a motion leads when a mapped coordinate changes by so much, how long the step is, and
    /// how long the part of it is that tells modes apart.
    pub fn ahead(
        &self,
        at: &Configuration<f64>,
        motion: &[f64],
        axis: usize,
        change: f64,
    ) -> (Configuration<f64>, f64, f64) {
        let factor = change / self.units[axis];
        let step: Vec<f64> = motion.iter().map(|x| x * factor).collect();
        let seen = step.iter().zip(&self.seen).filter(|(_, seen)| **seen);
        let seen = seen.map(|(x, _)| x * x).sum::<f64>().sqrt();
        (self.free.displaced(at, &step), norm(&step), seen)
    }
}
