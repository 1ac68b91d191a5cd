//! All rest positions, as solutions of algebraic equations.

use std::f64::consts::PI;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::{EquilibriumReport, Start};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::SAME;
use crate::number::{C, Number};
use crate::solve::monodromy::{Monodromy, ParametricSystem, followed, place, random};
use crate::solve::{Tracker, Watch, each};
use crate::system::{NotAlgebraic, RestEquations, RestWay};

/// Solutions of the equations of rest, counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AllRest {
    /// Solutions for generic loads: weights and stiffnesses that are any complex numbers.
    pub generic: usize,
    /// Fresh random ways through the loads that brought no other solution.
    pub quiet: usize,
    /// Random rest positions under other loads, all of which led to known solutions.
    pub quiet_seeds: usize,
    /// Paths to the loads of the mechanism that arrived at real solutions.
    pub real: usize,
    /// Real solutions among these in which a spring would have a negative length.
    pub negative: usize,
    /// Paths that arrived at other complex solutions.
    pub complex: usize,
    /// Paths that went to infinity.
    pub at_infinity: usize,
    /// Paths that arrived at no single solution: several meet there, or there are infinitely many.
    pub multiple: usize,
}

/// The loads as parameters of a family.
struct Resting<'a> {
    mechanism: &'a Mechanism,
    equations: &'a RestEquations,
}

impl Resting<'_> {
    /// The turns after which each free joint is where it was; `None` if it slides.
    fn turns(&self) -> impl Iterator<Item = Option<f64>> {
        let joints = self.equations.joints.iter();
        joints.map(|joint| self.mechanism.turns_to_repeat(*joint))
    }

    /// A random rest position under other loads.
    fn seed(&self, rng: &mut Pcg64) -> Option<(Vec<C>, Vec<C>)> {
        const TRIES: usize = 50;
        (0..TRIES).find_map(|_| {
            let mut x: Vec<C> = self
                .turns()
                .map(|turns| match turns {
                    Some(turns) => {
                        let angle = PI * turns * (2.0 * rng.random::<f64>() - 1.0);
                        C::new(angle, 0.8 * (2.0 * rng.random::<f64>() - 1.0))
                    }
                    None => random(rng) * 2.0,
                })
                .collect();
            x.resize(self.equations.count(), C::zero());
            let near = self.member(rng);
            self.equations.resting(x, &near)
        })
    }
}

impl<'a> ParametricSystem for Resting<'a> {
    type Way<'f>
        = RestWay<'f>
    where
        Self: 'f;

    fn count(&self) -> usize {
        self.equations.count()
    }

    fn way(&self, from: &[C], to: &[C]) -> RestWay<'_> {
        self.equations.way(from, to)
    }

    fn member(&self, rng: &mut Pcg64) -> Vec<C> {
        self.equations
            .parameters
            .iter()
            .map(|_| random(rng))
            .collect()
    }

    /// Joints, angles as points of the unit circle, and lengths.
    fn key(&self, x: &[C]) -> Vec<C> {
        let joints = x
            .iter()
            .zip(self.turns())
            .flat_map(|(x, turns)| match turns {
                Some(turns) => {
                    let (sin, cos) = Number::sin_cos(x.scale(1.0 / turns));
                    vec![sin, cos]
                }
                None => vec![*x],
            });
        let lines = x[self.equations.joints.len()..].chunks(2);
        joints
            .chain(lines.take(self.equations.lengths).map(|line| line[0]))
            .collect()
    }

    fn size(&self, x: &[C]) -> f64 {
        let sizes = self.key(x).into_iter().chain(x.iter().copied());
        sizes.map(|x| x.norm_sqr().sqrt()).fold(0.0, f64::max)
    }
}

impl Start<'_> {
    /// Adds all rest positions; false if the search did not come to its end.
    ///
    /// # Errors
    /// If the equations of rest are not algebraic, or more of them are left than single solutions.
    pub(super) fn all(
        &self,
        (at, seed): (&Configuration<f64>, u64),
        report: &mut EquilibriumReport,
        watch: &Watch,
    ) -> Result<bool, NotAlgebraic> {
        /// The most solutions that are followed.
        const MOST: usize = 2000;
        const SEEDS: usize = 10;
        if !self.held.1.is_empty() {
            return Err(NotAlgebraic::Platforms);
        }
        let equations = RestEquations::new(self.mechanism, self.load, &self.held.0, at)?;
        let family = Resting {
            mechanism: self.mechanism,
            equations: &equations,
        };
        let mut rng = Pcg64::seed_from_u64(seed);
        let first = family.seed(&mut rng).ok_or(NotAlgebraic::Overconstrained)?;
        let settings = Monodromy {
            seed,
            most: MOST,
            ..Monodromy::default()
        };
        let (member, first) = first;
        let mut spread = settings.spread(&family, &member, first, watch);
        let mut all = AllRest::default();
        let tracker = Tracker {
            largest: 1e6,
            ..Tracker::default()
        };
        let lead = |members: &[&[C]], x: &[C]| {
            let first = followed(&family, members, x, &tracker, watch);
            first.or_else(|_| followed(&family, members, x, &tracker.tightened(0.03), watch))
        };
        while all.quiet_seeds < SEEDS && spread.quiet > 0 && !watch.is_stopped() {
            let Some((from, x)) = family.seed(&mut rng) else {
                break;
            };
            let Ok(x) = lead(&[&from, &member], &x) else {
                continue;
            };
            let keys: Vec<Vec<C>> = spread.solutions.iter().map(|x| family.key(x)).collect();
            if place(&keys, &family.key(&x)).is_some() {
                all.quiet_seeds += 1;
                continue;
            }
            // another component
            let other = settings.spread(&family, &member, x, watch);
            spread.solutions.extend(other.solutions);
            spread.quiet = spread.quiet.min(other.quiet);
            all.quiet_seeds = 0;
        }
        if watch.is_stopped() {
            return Ok(false);
        }
        if spread.quiet == 0 || all.quiet_seeds < SEEDS {
            return Err(NotAlgebraic::Large);
        }
        (all.generic, all.quiet) = (spread.solutions.len(), spread.quiet);
        // what was reached downhill must be among them
        let reached = std::mem::take(&mut report.positions);
        let target = &equations.parameters;
        let ends = each(all.generic, &(), |(), i| {
            lead(&[&member, target], &spread.solutions[i])
        });
        let mut keys: Vec<Vec<C>> = Vec::new();
        for end in ends {
            let x = match end {
                Ok(x) => x,
                Err(true) => {
                    all.at_infinity += 1;
                    continue;
                }
                Err(false) => {
                    all.multiple += 1;
                    continue;
                }
            };
            let key = family.key(&x);
            if place(&keys, &key).is_some() {
                all.multiple += 1;
                continue;
            }
            let is_real = key.iter().all(|x| x.im.abs() < SAME * (1.0 + x.re.abs()));
            keys.push(key);
            if !is_real {
                all.complex += 1;
                continue;
            }
            all.real += 1;
            let (joints, rest) = x.split_at(equations.joints.len());
            let lines = rest.chunks(2).take(equations.lengths);
            if lines.map(|line| line[0].re).any(|length| length < 0.0) {
                all.negative += 1;
                continue;
            }
            let mut here = at.clone();
            for (joint, x) in equations.joints.iter().zip(joints) {
                here.joints[*joint] = x.re * self.mechanism.dimensions().joint_scales[*joint];
            }
            match self.settle(&here) {
                Ok(position) => self.add(position, report),
                Err(_) => all.multiple += 1,
            }
        }
        for position in reached {
            let before = report.positions.len();
            self.add(position, report);
            all.multiple += report.positions.len() - before;
        }
        report.complete = Some(all);
        Ok(!watch.is_stopped())
    }
}
