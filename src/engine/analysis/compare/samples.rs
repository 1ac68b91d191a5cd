//! Configurations to compare at.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::mechanism::{Configuration, Mechanism, Role};
use crate::solve::{Newton, Stop};
use crate::system::{Held, HeldPlatform, System, SystemWork};

/// Assembled configurations remembered as starts: with more of them none is much nearer, but the search for the nearest
/// takes longer.
const REMEMBERED: usize = 1000;

/// Configurations to compare at, made one after the other so that any number of them takes no memory.
pub(super) struct SampleStream<'a> {
    mechanism: &'a Mechanism,
    count: usize,
    rng: Pcg64Mcg,
    system: System<f64>,
    work: SystemWork<f64>,
    /// Joints with given values: the actuated ones, or all where there are no closures.
    held: Vec<bool>,
    /// True if any joint is held.
    drives: bool,
    solved_home: Option<Configuration<f64>>,
}

impl<'a> SampleStream<'a> {
    pub fn new(mechanism: &'a Mechanism, count: usize, seed: u64) -> Self {
        let closed = !mechanism.closures().is_empty();
        let actuated = mechanism.joints().iter();
        let actuated = actuated.map(|joint| joint.role == Role::Actuated || !closed);
        let held: Vec<bool> = actuated.collect();
        let joints = held.clone();
        let platforms = vec![HeldPlatform::Free; mechanism.platforms().len()];
        let system = System::new(mechanism.dimensions(), &Held { joints, platforms });
        let mut samples = SampleStream {
            mechanism,
            count,
            rng: Pcg64Mcg::seed_from_u64(seed),
            work: system.work(),
            system,
            drives: held.contains(&true),
            held,
            solved_home: None,
        };
        let home = mechanism.home();
        samples.solved_home = samples.solve(&home, &home.joints);
        samples
    }

    /// True if the home configuration assembles.
    pub fn home_assembles(&self) -> bool {
        self.solved_home.is_some()
    }

    /// Visits home and random values of all joints, with platforms at home; then the solved home.
    pub fn anywhere(
        &mut self,
        visit: &mut dyn FnMut(&Configuration<f64>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut at = self.mechanism.home();
        visit(&at)?;
        for _ in 0..self.count {
            scatter(self.mechanism, &mut at, &mut self.rng);
            visit(&at)?;
        }
        self.solved_home.iter().try_for_each(visit)
    }

    /// Visits the solved home and then assembled configurations at the same random values of the actuated joints, each
    /// found from the nearest one remembered; `None` where none was found.
    pub fn assembled(
        &mut self,
        seed: u64,
        visit: &mut dyn FnMut(Option<&Configuration<f64>>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let home = self.mechanism.home();
        let mut known: Vec<Configuration<f64>> = self.solved_home.iter().cloned().collect();
        known.iter().try_for_each(|at| visit(Some(at)))?;
        let mut again = Pcg64Mcg::seed_from_u64(seed);
        let mut random = home.clone();
        for _ in 0..self.count {
            scatter(self.mechanism, &mut random, &mut again);
            let mut target = random.joints.clone();
            let nearest = (known.iter())
                .min_by(|a, b| {
                    let distance = |at: &&Configuration<f64>| self.distance(&at.joints, &target);
                    distance(a).total_cmp(&distance(b))
                })
                .unwrap_or(&home);
            if !self.drives {
                // nothing is held: a shaken start ends somewhere else
                for (value, near) in target.iter_mut().zip(&nearest.joints) {
                    *value = near + 0.3 * self.rng.random_range(-1.0..=1.0) * (*value - near);
                }
            }
            let found = self.approach(nearest, &target);
            visit(found.as_ref())?;
            known.extend(found.filter(|_| known.len() < REMEMBERED));
        }
        ControlFlow::Continue(())
    }

    /// Squared distance of the held values, in natural sizes.
    fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        let joints = from.iter().zip(to).enumerate();
        joints
            .filter(|(joint, _)| self.held[*joint])
            .map(|(joint, (a, b))| ((a - b) / self.system.joint_scale(joint)).powi(2))
            .sum()
    }

    /// The held joints at `target`, the others starting as in `from`; all of them if none is held.
    fn solve(&mut self, from: &Configuration<f64>, target: &[f64]) -> Option<Configuration<f64>> {
        let mut at = from.clone();
        for (joint, (value, target)) in at.joints.iter_mut().zip(target).enumerate() {
            if self.held[joint] || !self.drives {
                *value = *target;
            }
        }
        let mut trial = at.clone();
        let newton = Newton::default();
        let report = newton.solve(&self.system, &mut at, &mut trial, &mut self.work);
        (report.stop == Stop::Solved).then_some(at)
    }

    /// Solves for target values at once, or if that fails in steps.
    fn approach(
        &mut self,
        from: &Configuration<f64>,
        target: &[f64],
    ) -> Option<Configuration<f64>> {
        const STEPS: i32 = 8;
        let at_once = self.solve(from, target);
        if at_once.is_some() {
            return at_once;
        }
        let mut at = from.clone();
        for step in 1..=STEPS {
            let part = f64::from(step) / f64::from(STEPS);
            let joints = from.joints.iter().zip(target);
            let between: Vec<f64> = joints.map(|(a, b)| a + part * (b - a)).collect();
            at = self.solve(&at, &between)?;
        }
        Some(at)
    }
}

/// Gives every joint a random value within its limits; where there are none an angle may be anything, a length differs
/// from home by up to half the characteristic length.
fn scatter(mechanism: &Mechanism, at: &mut Configuration<f64>, rng: &mut Pcg64Mcg) {
    for (value, joint) in at.joints.iter_mut().zip(mechanism.joints()) {
        let reach = match joint.kind.is_angle() {
            true => PI,
            false => 0.5 * mechanism.characteristic_length(),
        };
        let (low, high) = (joint.limits).unwrap_or((joint.home - reach, joint.home + reach));
        *value = rng.random_range(low..=high);
    }
}
