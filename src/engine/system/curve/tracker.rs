use crate::mechanism::Configuration;
use crate::solve::{Newton, NewtonReport, Trail, Warm, WarmReport};
use crate::system::{Coordinate, System, SystemWork};

/// Follows a mechanism while its held coordinates move: one short solve for each change of them.
///
/// ```text
/// let mut tracker = MotionTracker::new(question.system(), assembled.configuration);
/// for angle in crank_angles {
///     let report = tracker.solve(|held| held.joints[crank] = angle);
///     assert!(report.solved || tracker.recover(&Newton::default()).stop == Stop::Solved);
///     draw(tracker.configuration());
/// }
/// ```
#[derive(Clone, Debug)]
pub struct MotionTracker {
    system: System<f64>,
    warm: Warm,
    configuration: Configuration<f64>,
    work: SystemWork<f64>,
    trail: Trail<Configuration<f64>>,
}

impl MotionTracker {
    /// Follows from `start`, which ought to be assembled or nearly so.
    pub fn new(system: System<f64>, start: Configuration<f64>) -> Self {
        MotionTracker {
            work: system.work(),
            trail: Trail::new(&start, system.unknowns().len()),
            warm: Warm::default(),
            configuration: start,
            system,
        }
    }

    /// Tracker with other settings of the method.
    pub fn with(self, warm: Warm) -> Self {
        MotionTracker { warm, ..self }
    }

    /// The equations that are solved.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// The latest solution; after a solve that failed, the one before with the held values asked for.
    pub fn configuration(&self) -> &Configuration<f64> {
        &self.configuration
    }

    /// Lets `hold` change the held joints and poses, and finds the free ones. Nothing allocates. `solved` is said only
    /// of a residual evaluated at the configuration returned.
    #[inline]
    pub fn solve(&mut self, hold: impl FnOnce(&mut Configuration<f64>)) -> WarmReport {
        hold(&mut self.configuration);
        (self.warm).solve(
            &self.system,
            &mut self.configuration,
            &mut self.trail,
            &mut self.work,
        )
    }

    /// Gives held joints and platform coordinates held alone values in m or rad, by their numbers, and finds the rest.
    #[inline]
    pub fn solve_at(
        &mut self,
        held: impl Iterator<Item = Coordinate> + Clone,
        value: impl Fn(usize) -> f64,
    ) -> WarmReport {
        for (i, coordinate) in held.clone().enumerate() {
            if let Coordinate::Pose(platform, coordinate) = coordinate {
                self.system.set_target(platform, coordinate, value(i));
            }
        }
        self.solve(|at| {
            for (i, coordinate) in held.enumerate() {
                if let Coordinate::Joint(joint) = coordinate {
                    at.joints[joint] = value(i);
                }
            }
        })
    }

    /// Continues from another configuration, which ought to be assembled.
    pub fn restart(&mut self, at: &Configuration<f64>) {
        self.trail.forget();
        self.configuration.clone_from(at);
    }

    /// Solves for the held values last asked for by a method that also works from afar, when
    /// [`solve`](MotionTracker::solve) has failed. The branch found need not be the one followed so far.
    pub fn recover(&mut self, newton: &Newton) -> NewtonReport {
        self.trail.forget();
        let mut trial = self.configuration.clone();
        newton.solve(
            &self.system,
            &mut self.configuration,
            &mut trial,
            &mut self.work,
        )
    }
}
