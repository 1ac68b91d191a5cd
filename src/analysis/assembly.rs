//! The assembled configuration near a guess.

mod singular;

use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Equations, Newton, Report, Stop, Watch};
use crate::system::{Attempt, Freedoms, Question, QuestionError, Search, approach, check_count};
pub use crate::system::{Count, Gap};

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
    /// Whether the search was stopped before all starts were made.
    pub interrupted: bool,
    /// Whether no other assembly can exist, because nothing is closed. Others are not searched for.
    pub only: bool,
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
    watch: &Watch,
) -> Result<AssemblyReport, QuestionError> {
    let count = check_count(question)?;
    let mut search = Search::new(question, &settings.newton);
    let found = search.run(settings.restarts, settings.seed, watch);
    let reporter = Reporter {
        mechanism: question.mechanism(),
        settings,
        search,
        count,
        restarts: found.restarts,
        interrupted: watch.is_stopped(),
    };
    Ok(if found.assembles() {
        reporter.assembled(found.attempt)
    } else {
        reporter.unassembled(found.attempt)
    })
}

/// Says what an attempt means.
struct Reporter<'a> {
    mechanism: &'a Mechanism,
    settings: &'a AssemblySettings,
    search: Search<'a>,
    count: Count,
    restarts: usize,
    interrupted: bool,
}

impl Reporter<'_> {
    fn report(&self, attempt: Attempt, outcome: Outcome) -> AssemblyReport {
        let freedoms = Freedoms::at(self.mechanism.dimensions(), self.search.held(), &attempt.at);
        let condition = freedoms.condition();
        AssemblyReport {
            near_singular: attempt.report.stop == Stop::Solved
                && condition > self.settings.poor_condition,
            condition,
            outcome,
            steps: attempt.report.steps,
            restarts: self.restarts,
            seed: self.settings.seed,
            residual: attempt.report.size.largest,
            gaps: Gap::of(self.mechanism, &attempt.at),
            idle: 0,
            count: self.count,
            interrupted: self.interrupted,
            only: self.mechanism.closures().is_empty(),
            configuration: self.by_limits(attempt.at),
        }
    }

    /// Angles that were solved for by the turn that is within their limits, if one is.
    fn by_limits(&self, mut at: Configuration<f64>) -> Configuration<f64> {
        let held = &self.search.held().joints;
        for j in (0..held.len()).filter(|&j| !held[j]) {
            at.joints[j] = self.mechanism.by_limits(j, at.joints[j]);
        }
        at
    }

    fn assembled(&self, attempt: Attempt) -> AssemblyReport {
        let outside = self.search.outside_limits(&attempt.at);
        let freedoms = Freedoms::at(self.mechanism.dimensions(), self.search.held(), &attempt.at);
        let idle = if freedoms.are_idle(self.mechanism, &attempt.at) {
            freedoms.motions.len()
        } else {
            0
        };
        let outcome = if freedoms.motions.len() > idle {
            singular::blame(self.mechanism, self.search.held(), &attempt.at, &freedoms)
        } else if outside.is_empty() {
            Outcome::Converged
        } else {
            Outcome::ConvergedOutsideLimits { joints: outside }
        };
        let mut report = self.report(attempt, outcome);
        if idle > 0 {
            // unknowns that nothing determines have no part in the conditioning of the others
            report.condition = freedoms.condition_of_determined();
            report.near_singular = report.condition > self.settings.poor_condition;
            report.idle = idle;
        }
        report
    }

    fn unassembled(&self, attempt: Attempt) -> AssemblyReport {
        let settled = attempt.report.stop == Stop::Minimum;
        let (at, local_minimum) = match self.interrupted {
            false => approach(self.search.system(), &attempt.at),
            true => (attempt.at.clone(), false),
        };
        let system = self.search.system();
        let size = system.residual(&at, &mut system.work());
        let attempt = Attempt {
            at,
            report: Report {
                size,
                ..attempt.report
            },
        };
        let gaps = Gap::of(self.mechanism, &attempt.at);
        let width = |gap: &Gap| gap.size(self.mechanism);
        let worst = (0..gaps.len()).fold(0, |worst, i| {
            if width(&gaps[i]) > width(&gaps[worst]) {
                i
            } else {
                worst
            }
        });
        let outcome = if !self.interrupted && (settled || local_minimum) {
            Outcome::CannotBeAssembled {
                worst,
                local_minimum,
            }
        } else {
            Outcome::GaveUp { worst }
        };
        self.report(attempt, outcome)
    }
}
