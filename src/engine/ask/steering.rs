//! Moving a mechanism by hand: from its configuration to new values of the held coordinates, on its branch.

mod pull;
mod ways;

use std::sync::{Arc, OnceLock};

use super::{AskError, Question, Role};
use crate::analysis::sweep::{Row, SweepEnd, SweepReport, SweepSettings, sweep};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::SUMMED;
use crate::solve::Watch;
use crate::system::{self, Coordinate, Driven, Held, QuestionError, Still, check_count};

/// A mechanism in a configuration, with its held coordinates.
#[derive(Clone, Debug)]
pub struct Steering {
    mechanism: Arc<Mechanism>,
    /// Coordinates that stay where they are so that links do not spin about their own lines.
    still: Vec<Still>,
    driven: Vec<Coordinate>,
    at: Configuration<f64>,
    /// The singular configuration that stopped the last motion.
    stopped: Option<Configuration<f64>>,
    /// The last configuration well determined by the held coordinates.
    regular: Option<Configuration<f64>>,
    /// True if it has been pulled through a dead point of the held coordinates, and not back.
    crossed: bool,
}

impl Question {
    /// The mechanism assembled near the start, or in the mode asked for, ready to be moved by its held coordinates. If
    /// too little is held, or something that depends on the rest, this is corrected.
    ///
    /// # Errors
    /// If the question is wrong or nothing assembles.
    pub fn steering(&self, watch: &Watch) -> Result<Steering, AskError> {
        let asked = self.clone().completed()?;
        let (_, at) = asked.configurations(watch)?.swap_remove(0);
        asked.steering_from(at)
    }

    /// As [`Question::steering`], from the assembly that Newton's method finds near a configuration.
    ///
    /// # Errors
    /// If the question is wrong, or Newton's method leads nowhere from there.
    pub fn steering_near(
        &self,
        at: &Configuration<f64>,
        watch: &Watch,
    ) -> Result<Steering, AskError> {
        let asked = self.clone().completed()?;
        let question = asked.resolved()?.near(at).with_spins_still();
        match asked.nearest(&question, 0, watch) {
            Some(at) => asked.steering_from(at),
            None => Err(AskError::NotAssembled(question.held_names())),
        }
    }

    /// As [`Question::steering`], from an assembled configuration, at which the held coordinates may have other values.
    pub fn steering_from(&self, at: Configuration<f64>) -> Result<Steering, AskError> {
        let resolved = self.resolved()?;
        Ok(Steering {
            mechanism: self.mechanism().clone(),
            driven: resolved.held_coordinates(),
            still: resolved.with_spins_still().still().to_vec(),
            at,
            stopped: None,
            regular: None,
            crossed: false,
        })
    }

    /// Holds a coordinate no longer, so that it can be an input.
    pub fn let_go(mut self, name: &str) -> Self {
        (self.demands).retain(|of| of.role != Role::Hold || of.name != name);
        self.ready = OnceLock::new();
        self
    }

    /// With as much held as decides the configuration.
    fn completed(self) -> Result<Self, AskError> {
        let counted = check_count(&self.resolved()?);
        let (free, hold) = match counted {
            Ok(_) => return Ok(self),
            Err(QuestionError::TooFew { hold, .. }) => (Vec::new(), hold),
            Err(QuestionError::TooMany { free, .. }) => (free, Vec::new()),
            Err(QuestionError::Dependent { free, hold }) => (free, hold),
            Err(error) => return Err(AskError::Question(error)),
        };
        let mut asked = self;
        for name in free {
            asked = asked.let_go(&name);
            if asked.mechanism().joint(&name).is_some() {
                asked = asked.free(name);
            }
        }
        let values = asked.holdable(&hold).unwrap_or_default();
        for holdable in values {
            (asked.demands).retain(|of| of.role != Role::Free || of.name != holdable.name);
            asked = asked.demand(holdable);
        }
        Ok(asked)
    }
}

impl Steering {
    /// The mechanism.
    pub fn mechanism(&self) -> &Arc<Mechanism> {
        &self.mechanism
    }

    /// The present configuration, which is assembled.
    pub fn at(&self) -> &Configuration<f64> {
        &self.at
    }

    /// True if a singular configuration stopped the last motion.
    pub fn is_stopped(&self) -> bool {
        self.stopped.is_some()
    }

    /// True if it has been pulled through a dead point of the held coordinates, on to another branch.
    pub fn is_crossed(&self) -> bool {
        self.crossed
    }

    /// The mechanism at the singular configuration that stopped the last motion, if one did.
    pub(super) fn where_stopped(&self) -> Self {
        let mut there = self.clone();
        there.at = there.stopped.take().unwrap_or(there.at);
        there
    }

    /// The held coordinates, at their present values.
    pub fn held(&self) -> Held<f64> {
        self.held_but(&[])
    }

    fn held_but(&self, released: &[Coordinate]) -> Held<f64> {
        let kept = self.driven.iter().filter(|of| !released.contains(of));
        let kept: Vec<Coordinate> = kept.copied().collect();
        let question = system::Question::locking(&self.mechanism, &kept, &self.at);
        Still::held_with(&self.still, question.held())
    }

    /// The coordinates that can be moved: those that are held.
    pub fn driven(&self) -> &[Coordinate] {
        &self.driven
    }

    /// The question that holds the held coordinates at their present values.
    pub fn question(&self) -> Question {
        let name = |coordinate: &Coordinate| coordinate.name(&self.mechanism);
        let joints = (0..self.mechanism.joints().len()).map(Coordinate::Joint);
        let free = joints.filter(|joint| !self.driven.contains(joint));
        let asked = Question::new(self.mechanism.clone()).free("actuated");
        let asked = self.driven.iter().fold(asked, |asked, coordinate| {
            asked.hold(name(coordinate), coordinate.of(&self.mechanism, &self.at))
        });
        free.fold(asked, |asked, joint| {
            asked.guess(name(&joint), joint.of(&self.mechanism, &self.at))
        })
    }

    /// Moves held coordinates together to these values, in m or rad, as far as the branch and the limits allow. At a
    /// dead point, and where branches cross, the mechanism stops just before it.
    pub fn move_to(&mut self, targets: &[(Coordinate, f64)], watch: &Watch) -> SweepReport {
        let inputs = targets.iter().map(|&(coordinate, to)| Driven {
            coordinate,
            from: coordinate.of(&self.mechanism, &self.at),
            to,
        });
        let moves = |input: &Driven| {
            let size = input
                .coordinate
                .scale(&self.mechanism)
                .max(input.from.abs());
            (input.to - input.from).abs() > SUMMED * size
        };
        let inputs: Vec<Driven> = inputs.filter(moves).collect();
        if inputs.is_empty() {
            return SweepReport {
                rows: 1,
                ..SweepReport::of(&self.mechanism, &[], SweepEnd::Complete)
            };
        }
        let (report, end) = self.moved(&inputs, watch);
        let leaves = |ending| matches!(ending, SweepEnd::Complete | SweepEnd::Limit);
        if !leaves(report.ending)
            && let Some(from) = self.regular.take()
            && from != self.at
        {
            // too near to a dead point to tell its branches apart: back to the one on which it came
            let mut back = Steering {
                at: from,
                ..self.clone()
            };
            let again = back.move_to(targets, watch);
            if leaves(again.ending) {
                *self = back;
                return again;
            }
        }
        self.stopped = None;
        let part = report.met.last().and_then(|met| met.part).unwrap_or(0.0);
        match report.ending {
            SweepEnd::Complete | SweepEnd::Limit => {
                self.at = end;
                self.regular = Some(self.at.clone());
            }
            SweepEnd::Fold | SweepEnd::Crossing => {
                let size = |input: &Driven| {
                    (input.to - input.from).abs() / input.coordinate.scale(&self.mechanism)
                };
                let size = inputs.iter().map(size).fold(0.0, f64::max);
                // a long step sees the end and the dead point behind it as one: from farther away it does not
                // the rest of the mechanism, which goes by the square root, is then a thousandth away, where the branch is unique
                let mut before = 1e-6 / size;
                while before < part {
                    let nearer = inputs.iter().map(|input| Driven {
                        to: input.at(part - before),
                        ..*input
                    });
                    let (nearer, end) = self.moved(&nearer.collect::<Vec<_>>(), watch);
                    if nearer.ending == SweepEnd::Complete {
                        self.at = end;
                        break;
                    }
                    before *= 10.0;
                }
                self.stopped = Some(end);
            }
            _ => {}
        }
        report
    }

    fn moved(&self, inputs: &[Driven], watch: &Watch) -> (SweepReport, Configuration<f64>) {
        let settings = SweepSettings {
            steps: 1,
            ..SweepSettings::default()
        };
        let moved: Vec<Coordinate> = inputs.iter().map(|input| input.coordinate).collect();
        let held = self.held_but(&moved);
        let mut end = self.at.clone();
        let mut last = |row: &Row| end.clone_from(row.configuration);
        let report = sweep(
            &self.mechanism,
            &held,
            inputs,
            &self.at,
            &settings,
            &mut last,
            watch,
        );
        (report, end)
    }
}
