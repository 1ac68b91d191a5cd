//! The search for an assembled configuration: from the guess, then from random starts.

mod closing;
mod home_continuation;
mod random;

pub use closing::{
    Analysed, AssemblySettings, Closed, GivenPose, Moved, NotClosed, TooLarge, WidestGap, close,
    moved, too_large,
};
pub use random::{random_configuration, sampling_range};

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::equations::{System, SystemWork, solve};
use super::question::{Count, Question};
use crate::description::Role;
use crate::linear::{RANK_TOLERANCE, SPECTRUM_LIMIT};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Equations, Newton, NewtonReport, Stage, Stop, Watch};
use crate::system::{Freedoms, Held, HeldPlatform};

/// Random starts within limits after the guess has failed: the same wherever one assembly is sought, so that all analyses
/// assemble where one does.
pub const RESTARTS: usize = 40;

/// Newton's method from one start.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    /// End of the iteration.
    pub at: Configuration<f64>,
    /// Outcome of the iteration.
    pub report: NewtonReport,
}

/// Outcome of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Searched {
    /// The attempt that assembles, or the one that came closest.
    pub attempt: Attempt,
    /// Random starts made after the guess.
    pub restarts: usize,
}

impl Searched {
    /// True if the mechanism assembles there.
    pub fn assembles(&self) -> bool {
        self.attempt.report.stop == Stop::Solved
    }
}

/// The search for the assembled configuration of a question: one for all analyses, so that all mean the same.
pub struct Search<'a> {
    pub(super) question: &'a Question<'a>,
    pub(super) mechanism: &'a Mechanism,
    pub(super) newton: &'a Newton,
    pub(super) held: Held<f64>,
    pub(super) system: System<f64>,
    work: SystemWork<f64>,
}

impl<'a> Search<'a> {
    /// For a question.
    pub fn new(question: &'a Question<'a>, newton: &'a Newton) -> Self {
        let mechanism = question.mechanism();
        let held = question.held();
        let system = System::reduced(mechanism, mechanism.dimensions(), &held);
        Search {
            question,
            mechanism,
            newton,
            work: system.work(),
            system,
            held,
        }
    }

    /// The held coordinates.
    pub fn held(&self) -> &Held<f64> {
        &self.held
    }

    /// The equations that are solved.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// Moves the mechanism from home to the held values, unless there is a guess. If that fails or ends
    /// outside limits, starts from the guess, then from seeded random starts within the limits.
    pub fn run(&mut self, restarts: usize, seed: u64, watch: &Watch) -> Searched {
        let first = self.first();
        self.restart(first, restarts, seed, watch)
    }

    /// The attempt without random starts.
    pub fn first(&mut self) -> Attempt {
        let guesses = [
            self.question.guessed_joints(),
            self.question.guessed_platforms(),
        ];
        let guessed = guesses.concat().contains(&true);
        let moved = match self.question.differs_from_home() && !guessed {
            true => self.moved_from_home(),
            false => None,
        };
        let moved = match moved {
            Some(attempt) if self.settles(&attempt) => return attempt,
            moved => moved,
        };
        let guess = self.guess();
        let guessed = self.from(guess);
        match moved {
            // outside limits, but assembled
            Some(moved) if guessed.report.stop != Stop::Solved => moved,
            _ => guessed,
        }
    }

    /// The search after the [`first`](Self::first) attempt.
    pub fn restart(
        &mut self,
        first: Attempt,
        restarts: usize,
        seed: u64,
        watch: &Watch,
    ) -> Searched {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut best = first;
        let most = if self.settles(&best) { 0 } else { restarts };
        let mut made = 0;
        for start in 1..=most {
            let assembled = best.report.stop == Stop::Solved;
            // an assembled configuration outside limits justifies a few more starts, not all
            if assembled && start > restarts / 4
                || watch.stops(Stage::Starts, start - 1, Some(restarts))
            {
                break;
            }
            made = start;
            let at = self.random_start(&mut rng);
            let attempt = self.from(at);
            if self.settles(&attempt) {
                best = attempt;
                break;
            }
            let solved = attempt.report.stop == Stop::Solved;
            let closer = attempt.report.size.squares < best.report.size.squares;
            if !assembled && (solved || closer) {
                best = attempt;
            }
        }
        Searched {
            attempt: self.normalised(best),
            restarts: made,
        }
    }

    /// The count of a question that an attempt answers at a regular configuration: with as many independent equations
    /// as unknowns, the mechanism has as many freedoms as are held, nowhere fewer, and all of them are driven.
    /// `None` where that cannot be said without examining the mechanism.
    pub fn counted(&mut self, attempt: &Attempt) -> Option<Count> {
        let joints = self.mechanism.joints().iter().zip(&self.held.joints);
        let driven = (joints.clone()).all(|(joint, held)| !held || joint.role == Role::Actuated);
        let free = (self.held.platforms.iter()).all(|held| *held == HeldPlatform::Free);
        let unknowns = self.system.unknowns().len();
        let square = self.system.rows() == unknowns && unknowns <= SPECTRUM_LIMIT;
        if !(driven && free && square && self.settles(attempt)) {
            return None;
        }
        self.system.linearise(&attempt.at, &mut self.work);
        if self.system.nullity(RANK_TOLERANCE, &self.work) > 0 {
            return None;
        }
        let held = joints.filter(|(_, held)| **held).count();
        Some(Count {
            mobility: Some(held),
            held,
        })
    }

    /// The motions that closures and held coordinates leave at a configuration.
    pub fn freedoms(&mut self, at: &Configuration<f64>) -> Freedoms {
        Freedoms::of(&self.system, at, &mut self.work)
    }

    /// True if no other start can do better: the attempt assembles, and only held joints are outside their limits.
    fn settles(&self, attempt: &Attempt) -> bool {
        attempt.report.stop == Stop::Solved
            && (self.mechanism.outside_limits(&attempt.at.joints)).all(|i| self.held.joints[i])
    }

    /// The attempt with solved joints turned to the turn of their guess, or else of home, and into their limits.
    fn normalised(&self, mut attempt: Attempt) -> Attempt {
        if attempt.report.stop != Stop::Solved {
            return attempt;
        }
        for (i, value) in attempt.at.joints.iter_mut().enumerate() {
            if !self.held.joints[i] {
                let home = || self.mechanism.home_turn(i);
                let near = self.question.guess_of(i).unwrap_or_else(home);
                *value = self.mechanism.turned_near(i, *value, near);
            }
        }
        attempt
    }

    fn from(&mut self, mut at: Configuration<f64>) -> Attempt {
        let report = solve(self.newton, &self.system, &mut at, &mut self.work);
        Attempt { at, report }
    }

    /// Start of the question; if that is not home, free coordinates without a guess are fitted to the rest.
    fn guess(&self) -> Configuration<f64> {
        let start = self.question.start();
        if !self.question.differs_from_home() {
            return start;
        }
        let guessed = self.question.guessed_joints();
        let joints = match guessed.contains(&true) {
            true => (guessed.iter().zip(&self.held.joints))
                .map(|(guessed, held)| guessed | held)
                .collect(),
            false => vec![true; guessed.len()],
        };
        self.fit(start, joints, self.question.guessed_platforms())
    }

    /// Minimises the gaps over all that is not fixed: a platform that fits its legs is a far better guess.
    fn fit(
        &self,
        start: Configuration<f64>,
        joints: Vec<bool>,
        platforms: &[bool],
    ) -> Configuration<f64> {
        let poses = self.held.platforms.iter().zip(platforms);
        let held = Held {
            joints,
            platforms: poses
                .map(|(held, &fixed)| match fixed {
                    true => HeldPlatform::Pose,
                    false => held.clone(),
                })
                .collect(),
        };
        let system = System::reduced(self.mechanism, self.mechanism.dimensions(), &held);
        if system.unknowns().is_empty() {
            return start;
        }
        let newton = Newton {
            max_steps: 20,
            ..self.newton.clone()
        };
        let (mut at, mut trial) = (start.clone(), start);
        newton.solve(&system, &mut at, &mut trial, &mut system.work());
        at
    }

    fn random_start(&self, rng: &mut Pcg64Mcg) -> Configuration<f64> {
        let start = self.question.start();
        // drawn for what is held too, so that the draws of the rest do not depend on the split
        let mut at = random_configuration(self.mechanism, &start, rng);
        self.held.keep(&start, &mut at);
        let joints = vec![true; at.joints.len()];
        self.fit(at, joints, &vec![false; self.held.platforms.len()])
    }
}
