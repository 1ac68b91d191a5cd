//! Configurations to compare at.

use std::f64::consts::PI;

use rand::Rng;

use crate::mechanism::{Configuration, Joint, Mechanism, Role};
use crate::solve::{Newton, Stop};
use crate::system::{Held, HeldPlatform, System, Work};

/// The configurations, home first.
pub(super) struct Samples {
    /// At random values of all joints; platforms stay at home.
    pub anywhere: Vec<Configuration<f64>>,
    /// Assembled, at random values of the actuated joints.
    pub assembled: Vec<Configuration<f64>>,
    /// Random inputs at which the mechanism did not assemble.
    pub not_assembled: usize,
    /// Whether the home configuration assembles.
    pub home_assembles: bool,
}

impl Samples {
    pub fn new(mechanism: &Mechanism, count: usize, assemble: bool, rng: &mut impl Rng) -> Self {
        let home = mechanism.home();
        let mut anywhere = vec![home.clone()];
        for _ in 0..count {
            let mut at = home.clone();
            for (value, joint) in at.joints.iter_mut().zip(mechanism.joints()) {
                *value = random_value(mechanism, joint, rng);
            }
            anywhere.push(at);
        }
        let mut solver = Solver::new(mechanism);
        let solved_home = solver.solve(&home, &home.joints);
        let home_assembles = solved_home.is_some();
        anywhere.extend(solved_home.clone());
        let mut samples = Samples {
            anywhere,
            assembled: solved_home.into_iter().collect(),
            not_assembled: 0,
            home_assembles,
        };
        if assemble {
            samples.assemble(mechanism, &mut solver, rng);
        }
        samples
    }

    /// Solves for the held values of every sample, each time from the nearest configuration so far.
    fn assemble(&mut self, mechanism: &Mechanism, solver: &mut Solver, rng: &mut impl Rng) {
        let home = mechanism.home();
        let random = self.anywhere[1..].iter().map(|at| at.joints.clone());
        let mut targets: Vec<Vec<f64>> = random.collect();
        if self.home_assembles {
            targets.pop();
        }
        for mut target in targets {
            let nearest = (self.assembled.iter())
                .min_by(|a, b| {
                    let distance = |at: &&Configuration<f64>| solver.distance(&at.joints, &target);
                    distance(a).total_cmp(&distance(b))
                })
                .unwrap_or(&home);
            if !solver.drives {
                // nothing is held: a shaken start ends somewhere else
                for (value, near) in target.iter_mut().zip(&nearest.joints) {
                    *value = near + 0.3 * rng.random_range(-1.0..=1.0) * (*value - near);
                }
            }
            match solver.approach(nearest, &target) {
                Some(at) => self.assembled.push(at),
                None => self.not_assembled += 1,
            }
        }
    }
}

/// Within limits; where there are none an angle may be anything, a length differs from home by up
/// to half the characteristic length.
fn random_value(mechanism: &Mechanism, joint: &Joint, rng: &mut impl Rng) -> f64 {
    let reach = match joint.kind.is_angle() {
        true => PI,
        false => 0.5 * mechanism.characteristic_length(),
    };
    let (low, high) = (joint.limits).unwrap_or((joint.home - reach, joint.home + reach));
    rng.random_range(low..=high)
}

/// Finds assembled configurations with the actuated joints held.
struct Solver {
    system: System<f64>,
    work: Work<f64>,
    held: Vec<bool>,
    /// Whether any joint is held.
    drives: bool,
}

impl Solver {
    fn new(mechanism: &Mechanism) -> Self {
        let closed = !mechanism.closures().is_empty();
        let joints = mechanism.joints().iter();
        let held: Vec<bool> = joints
            .map(|joint| joint.role == Role::Actuated || !closed)
            .collect();
        let platforms = vec![HeldPlatform::Free; mechanism.platforms().len()];
        let joints = held.clone();
        let system = System::new(mechanism.dimensions(), &Held { joints, platforms });
        Solver {
            work: system.work(),
            system,
            drives: held.contains(&true),
            held,
        }
    }

    /// How far the held values are apart, in natural sizes.
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

    /// At once, or if that fails in steps.
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
