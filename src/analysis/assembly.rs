//! The assembled configuration near a guess.

mod closest;
mod singular;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Joint, JointKind, Mechanism, PlatformPose};
use crate::solve::{Equations, Newton, Report, Stop};
use crate::system::{
    Count, Freedoms, Gap, Held, HeldPlatform, Question, QuestionError, System, Work, gaps,
};

/// How to look for an assembled configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblySettings {
    /// The iteration.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// A condition number above this is worth a warning: four digits of the joint values are lost.
    pub poor_condition: f64,
}

impl Default for AssemblySettings {
    fn default() -> Self {
        AssemblySettings {
            newton: Newton::default(),
            restarts: 40,
            seed: 1,
            poor_condition: 1e4,
        }
    }
}

/// How the search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Assembled.
    Converged,
    /// Assembled, but some joints are outside their limits.
    ConvergedOutsideLimits {
        /// Indices of those joints.
        joints: Vec<usize>,
    },
    /// Assembled at a singular configuration: something moves although all inputs are held.
    Singular {
        /// What can move: joints and platforms, by name, the most mobile first.
        moving: Vec<String>,
        /// Index of the closure whose equations depend on the others.
        closure: usize,
        /// Indices of the held joints that cannot drive the mechanism there.
        powerless: Vec<usize>,
    },
    /// No start assembles.
    CannotBeAssembled {
        /// Index of the closure with the widest gap at the closest approach.
        worst: usize,
        /// Whether the closest approach is a true local minimum of the gaps: no small motion comes
        /// closer.
        local_minimum: bool,
    },
    /// No start assembles, and none settled either.
    GaveUp {
        /// Index of the closure with the widest gap.
        worst: usize,
    },
}

/// Where the search for an assembled configuration ended.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyReport {
    /// How it ended.
    pub outcome: Outcome,
    /// The assembled configuration, or the closest approach.
    pub configuration: Configuration<f64>,
    /// Newton steps of the start that succeeded.
    pub steps: usize,
    /// Random starts made after the guess.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// The largest closure row, dimensionless: lengths over the characteristic length, angles in
    /// rad.
    pub residual: f64,
    /// Ratio of the largest to the smallest singular value of the dimensionless Jacobian; infinite
    /// at a singular configuration, NaN where there are too many unknowns to compute it
    /// ([`SPECTRUM_LIMIT`](crate::linear::SPECTRUM_LIMIT)).
    pub condition: f64,
    /// Whether the condition number is poor.
    pub near_singular: bool,
    /// For each closure how far it is from being whole.
    pub gaps: Vec<Gap>,
    /// Freedoms that only turn a link about its own line and do not matter.
    pub idle: usize,
    /// What is held beside what the mechanism allows.
    pub count: Count,
}

/// Finds the assembled configuration near the start of a question.
///
/// Newton's method on the loop closure from the guess; if that fails, or ends outside the limits,
/// from seeded random starts within the limits.
///
/// # Errors
/// If more or less is held than the mechanism has freedoms, or what is held depends on itself.
pub fn assemble(
    question: &Question,
    settings: &AssemblySettings,
) -> Result<AssemblyReport, QuestionError> {
    let count = question.count()?;
    let mut search = Search::new(question, settings);
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    let mut outside: Option<Attempt> = None;
    let mut closest: Option<Attempt> = None;
    let mut restarts = 0;
    for start in 0..=settings.restarts {
        let at = if start == 0 {
            search.guess()
        } else {
            search.random_start(&mut rng)
        };
        restarts = start;
        let attempt = search.from(at);
        if attempt.report.stop == Stop::Solved {
            // another start cannot change where a held joint is
            let outside_limits = search.outside_limits(&attempt.at);
            if outside_limits
                .iter()
                .all(|&joint| search.held.joints[joint])
            {
                return Ok(search.assembled(attempt, restarts, count));
            }
            outside.get_or_insert(attempt);
        } else if closest
            .as_ref()
            .is_none_or(|c| attempt.report.size.squares < c.report.size.squares)
        {
            closest = Some(attempt);
        }
        // an assembled configuration outside limits is worth a few more starts, not all
        if outside.is_some() && start >= settings.restarts / 4 {
            break;
        }
    }
    Ok(match (outside, closest) {
        (Some(attempt), _) => search.assembled(attempt, restarts, count),
        (None, Some(attempt)) => search.unassembled(attempt, restarts, count),
        (None, None) => unreachable!("every start is either assembled or not"),
    })
}

/// One start and where it led.
struct Attempt {
    at: Configuration<f64>,
    report: Report,
}

struct Search<'a> {
    question: &'a Question<'a>,
    mechanism: &'a Mechanism,
    settings: &'a AssemblySettings,
    held: Held<f64>,
    system: System<f64>,
    work: Work<f64>,
}

impl<'a> Search<'a> {
    fn new(question: &'a Question<'a>, settings: &'a AssemblySettings) -> Self {
        let mechanism = question.mechanism();
        let held = question.held();
        let system = System::new(mechanism.dimensions(), &held);
        Search {
            question,
            mechanism,
            settings,
            work: system.work(),
            system,
            held,
        }
    }

    fn from(&mut self, mut at: Configuration<f64>) -> Attempt {
        let mut trial = at.clone();
        let newton = &self.settings.newton;
        let report = newton.solve(&self.system, &mut at, &mut trial, &mut self.work);
        Attempt { at, report }
    }

    /// The start of the question; platforms without a guess of their own are put where they suit
    /// the joints best when those do not start at home.
    fn guess(&self) -> Configuration<f64> {
        let start = self.question.start();
        if self.question.differs_from_home() {
            self.fit_platforms(start, self.question.guessed())
        } else {
            start
        }
    }

    /// Brings platforms as near to the chains as they can come with all joints held: the
    /// formulation decides success more than the method, and a platform that fits its legs is a far
    /// better guess than one that does not.
    fn fit_platforms(&self, start: Configuration<f64>, fixed: &[bool]) -> Configuration<f64> {
        let platforms = self.held.platforms.iter().zip(fixed);
        let held = Held {
            joints: vec![true; start.joints.len()],
            platforms: platforms
                .map(|(held, &fixed)| {
                    if fixed {
                        HeldPlatform::Pose
                    } else {
                        held.clone()
                    }
                })
                .collect(),
        };
        let system = System::new(self.mechanism.dimensions(), &held);
        if system.unknowns().is_empty() {
            return start;
        }
        let mut work = system.work();
        let newton = Newton {
            max_steps: 20,
            ..self.settings.newton.clone()
        };
        let (mut at, mut trial) = (start.clone(), start);
        newton.solve(&system, &mut at, &mut trial, &mut work);
        at
    }

    fn random_start(&self, rng: &mut Pcg64Mcg) -> Configuration<f64> {
        let mut at = self.question.start();
        let length = self.mechanism.characteristic_length();
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            let (low, high) = sampling_range(joint, length);
            // drawn for held joints too, so that the draws of the others do not depend on the split
            let value = low + (high - low) * rng.random::<f64>();
            if !self.held.joints[i] {
                at.joints[i] = value;
            }
        }
        for (pose, held) in at.platforms.iter_mut().zip(&self.held.platforms) {
            let mut inside = || 2.0 * rng.random::<f64>() - 1.0;
            let shift = Vector3([inside(), inside(), inside()]).times(length);
            let quaternion = Quaternion([inside(), inside(), inside(), inside()]);
            if *held != HeldPlatform::Pose {
                *pose = PlatformPose {
                    orientation: quaternion.normalised(),
                    position: pose.position + shift,
                };
            }
        }
        self.fit_platforms(at, &vec![false; self.held.platforms.len()])
    }

    fn outside_limits(&self, at: &Configuration<f64>) -> Vec<usize> {
        let joints = self.mechanism.joints().iter().zip(&at.joints).enumerate();
        joints
            .filter(|(_, (joint, value))| !joint.allows(**value))
            .map(|(i, _)| i)
            .collect()
    }

    fn report(
        &self,
        attempt: Attempt,
        outcome: Outcome,
        restarts: usize,
        count: Count,
    ) -> AssemblyReport {
        let freedoms = Freedoms::at(self.mechanism.dimensions(), &self.held, &attempt.at);
        let condition = freedoms.condition();
        AssemblyReport {
            near_singular: attempt.report.stop == Stop::Solved
                && condition > self.settings.poor_condition,
            condition,
            outcome,
            steps: attempt.report.steps,
            restarts,
            seed: self.settings.seed,
            residual: attempt.report.size.largest,
            gaps: gaps(self.mechanism, &attempt.at),
            idle: 0,
            count,
            configuration: attempt.at,
        }
    }

    fn assembled(&mut self, mut attempt: Attempt, restarts: usize, count: Count) -> AssemblyReport {
        self.normalise_angles(&mut attempt.at);
        let outside = self.outside_limits(&attempt.at);
        let freedoms = Freedoms::at(self.mechanism.dimensions(), &self.held, &attempt.at);
        let idle = if freedoms.are_idle(self.mechanism, &attempt.at) {
            freedoms.motions.len()
        } else {
            0
        };
        let outcome = if freedoms.motions.len() > idle {
            singular::blame(self.mechanism, &self.held, &attempt.at, &freedoms)
        } else if outside.is_empty() {
            Outcome::Converged
        } else {
            Outcome::ConvergedOutsideLimits { joints: outside }
        };
        let mut report = self.report(attempt, outcome, restarts, count);
        if idle > 0 {
            // unknowns that nothing determines have no part in the conditioning of the others
            report.condition = freedoms.condition_of_determined();
            report.near_singular = report.condition > self.settings.poor_condition;
            report.idle = idle;
        }
        report
    }

    fn unassembled(&mut self, attempt: Attempt, restarts: usize, count: Count) -> AssemblyReport {
        let settled = attempt.report.stop == Stop::Minimum;
        let (at, local_minimum) = closest::approach(&self.system, &attempt.at);
        let size = self.system.residual(&at, &mut self.work);
        let attempt = Attempt {
            at,
            report: Report {
                size,
                ..attempt.report
            },
        };
        let length = self.mechanism.characteristic_length();
        let gaps = gaps(self.mechanism, &attempt.at);
        let width = |gap: &Gap| (gap.distance / length).max(gap.angle);
        let worst = (0..gaps.len()).fold(0, |worst, i| {
            if width(&gaps[i]) > width(&gaps[worst]) {
                i
            } else {
                worst
            }
        });
        let outcome = if settled || local_minimum {
            Outcome::CannotBeAssembled {
                worst,
                local_minimum,
            }
        } else {
            Outcome::GaveUp { worst }
        };
        self.report(attempt, outcome, restarts, count)
    }

    /// Passive turns found by a long search come back to (−π, π], or into their limits.
    fn normalise_angles(&self, at: &mut Configuration<f64>) {
        let turn = std::f64::consts::TAU;
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            if self.held.joints[i] || joint.kind != JointKind::Revolute || !self.turns_freely(i) {
                continue;
            }
            let middle = joint.limits.map_or(0.0, |(low, high)| 0.5 * (low + high));
            let value = &mut at.joints[i];
            *value -= turn * ((*value - middle) / turn).round();
        }
    }

    /// Whether a whole turn of the joint leaves every frame where it is: not if the variable turns
    /// some row by a fraction.
    fn turns_freely(&self, joint: usize) -> bool {
        let rows = self
            .mechanism
            .dimensions()
            .chains
            .iter()
            .flat_map(|chain| &chain.rows);
        rows.map(|row| row.turn.coefficient(joint))
            .all(|c| c == c.round())
    }
}

/// Where random values of a joint are drawn from: its limits, or a turn, or a characteristic length
/// to each side of home.
fn sampling_range(joint: &Joint, length: f64) -> (f64, f64) {
    match joint.limits {
        Some((low, high)) if low.is_finite() && high.is_finite() => (low, high),
        _ if joint.kind.is_angle() => (-std::f64::consts::PI, std::f64::consts::PI),
        _ => (joint.home - length, joint.home + length),
    }
}
