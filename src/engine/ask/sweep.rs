//! Motions.

use std::f64::consts::TAU;

use super::ranges::still;
use super::{AskError, Mode, Question, Role};
use crate::analysis::quantities::{Metered, Motions};
use crate::analysis::sweep::{CircuitsReport, Sink, SweepReport, SweepSettings, sweep};
use crate::description;
use crate::mechanism::Configuration;
use crate::number::tolerance::ROUNDING;
use crate::solve::Watch;
use crate::system::{self, Coordinate, Driven, QuestionError, check_count, moved};

/// Steps made at most.
const MOST_STEPS: usize = 1_000_000_000;

impl Question {
    /// The motions of the inputs through their ranges; without inputs those along the whole curve of a mechanism with
    /// one freedom. Points of the question are traced besides those of the settings.
    ///
    /// # Errors
    /// If the question is wrong, or the mechanism does not assemble where the inputs begin.
    pub fn motions(
        &self,
        settings: &SweepSettings,
        watch: &Watch,
    ) -> Result<Motions<'_>, AskError> {
        self.takes("sweep")?;
        let mechanism = &**self.mechanism();
        if !self.has(Role::Input) && !settings.follow {
            let driven = CircuitsReport::input_of(mechanism);
            let driven = driven.map(|joint| mechanism.joints()[joint].name.clone());
            return Err(AskError::NothingMoves(driven));
        }
        if !(1..=MOST_STEPS).contains(&settings.steps) {
            return Err(AskError::Steps {
                given: settings.steps,
                most: MOST_STEPS,
            });
        }
        let table = self.schedule.is_some();
        let inputs = self.driven(if table {
            |_, _| false
        } else {
            |from, to| from == to
        })?;
        // known modulo a turn
        let angle = |input: &&Driven| {
            input.coordinate.platform().is_some() && input.coordinate.is_angle(mechanism)
        };
        let wide = |input: &&Driven| (input.to - input.from).abs() > TAU * (1.0 + ROUNDING);
        if let Some(input) = inputs.iter().filter(angle).find(wide) {
            return Err(AskError::MoreThanATurn(input.coordinate.name(mechanism)));
        }
        self.few_turns(&inputs)?;
        let begin: Vec<f64> = inputs.iter().map(|input| input.from).collect();
        let mut question = self.with_inputs(self.resolved()?, &begin)?;
        for ((item, _), input) in self.of(Role::Input).zip(&inputs) {
            if let Coordinate::Joint(joint) = input.coordinate
                && let joint = &mechanism.joints()[joint]
                && let Some(limits) = joint.limits
                && !joint.allows(input.from)
            {
                return Err(AskError::OutsideLimits {
                    item,
                    name: joint.name.clone(),
                    limits,
                    is_angle: joint.kind.is_angle(),
                });
            }
        }
        let posed = question.clone();
        // everything but the inputs stands still; where none is given, the freedom is let go
        let held = match inputs.is_empty() {
            false => {
                check_count(&question)?;
                question = question.with_spins_still();
                still(question.with_still(self.resolved()?.held()), &inputs)
            }
            true => {
                question = question.with_spins_still();
                question.with_still(self.one_freedom()?.held())
            }
        };
        let duration = settings.pace.duration;
        if !(duration > 0.0 && duration.is_finite()) {
            return Err(AskError::Duration(duration));
        }
        let mut pace = settings.pace;
        if let Some(schedule) = &self.schedule {
            pace.duration = schedule.duration();
        }
        let settings = SweepSettings {
            pace,
            schedule: self.schedule.clone(),
            points: [&settings.points[..], &self.named_points()?].concat(),
            ..settings.clone()
        };
        let mut quantities = self.quantities(&posed, !inputs.is_empty(), &settings.points)?;
        let dwells = self.tolerances(&posed, &mut quantities)?;
        let starts = self.starts(&question, watch)?;
        let moved = match (self.mode, &starts[..]) {
            (Mode::Nearest, [(_, at)]) => moved(&question, at),
            _ => None,
        };
        Ok(Motions {
            mechanism,
            held,
            dwells,
            metered: Metered {
                quantities,
                inputs,
                pace,
                schedule: self.schedule.clone(),
                load: self.load_of(&posed)?,
                outputs: self.asked_outputs()?,
                question: posed,
            },
            settings,
            starts,
            moved,
        })
    }

    /// The motion along the whole curve through an assembled configuration, whatever moves it: driven joints that are
    /// held there are let go. Rows trace the question's points.
    ///
    /// # Errors
    /// If the question is wrong or leaves another number of freedoms.
    pub fn through(
        &self,
        at: &Configuration<f64>,
        sink: &mut Sink,
        watch: &Watch,
    ) -> Result<SweepReport, AskError> {
        let mut asked = self.clone();
        if let Err(AskError::NothingLeft(_)) = self.one_freedom() {
            let joints = self.mechanism().joints();
            let driven = |name: &str| {
                let joint = self.mechanism().joint(name);
                joint.is_some_and(|joint| joints[joint].role == description::Role::Actuated)
            };
            asked = self.keeping(|of| of.role != Role::Hold || !driven(&of.name));
        }
        let question = asked.one_freedom()?.with_spins_still();
        let held = question.with_still(question.held());
        let settings = SweepSettings {
            points: self.named_points()?,
            ..SweepSettings::default()
        };
        let mechanism = self.mechanism();
        Ok(sweep(mechanism, &held, &[], at, &settings, sink, watch))
    }

    /// The question that leaves one freedom: actuated joints are held only if that is asked for.
    pub(super) fn one_freedom(&self) -> Result<system::Question<'_>, AskError> {
        let question = self.released()?;
        match check_count(&question) {
            Err(QuestionError::TooFew { mobility, held, .. }) if mobility == held + 1 => {
                Ok(question)
            }
            Ok(_) | Err(QuestionError::TooMany { .. }) => {
                Err(AskError::NothingLeft(question.held_names()))
            }
            Err(error @ QuestionError::TooFew { .. }) => Err(AskError::NotOneFreedom(error)),
            Err(error) => Err(AskError::Question(error)),
        }
    }
}
