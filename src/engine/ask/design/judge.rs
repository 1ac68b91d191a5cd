//! Designs judged over their whole motion.

mod defects;
mod moves;

use std::f64::consts::TAU;
use std::sync::Arc;

use super::DesignError;
use super::figure::{Figure, Observed, Statistic, in_unit, no_quantity};
use super::read::Read;
use crate::algebra::SiUnit;
use crate::analysis::design::{Defect, DesignCourse, FoundEnd, MISSED, Moves, course};
use crate::ask::Question;
use crate::description::{Description, DesignDescription, DesignPart, DesignProblem, Entry, Role};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::{ROUNDING, SAME};
use crate::solve::Watch;
use crate::system::{self, Bundle};

/// Judges designs by what was asked.
pub(super) struct Judge<'a> {
    asked: &'a DesignDescription,
    pub read: &'a Read,
    description: &'a Description,
    mechanism: &'a Arc<Mechanism>,
    pub watch: &'a Watch<'a>,
    bounds: Vec<FigureBound>,
    goals: Vec<Figure>,
    /// True if the mechanism has one freedom.
    pub one_freedom: bool,
    /// Closures with what is driven held, by which designs with several freedoms move in a search.
    held: Option<Bundle<'a>>,
}

/// A bound of a figure.
struct FigureBound {
    figure: Figure,
    bound: f64,
    at_least: bool,
}

/// A judgement of a design.
#[derive(Clone, Debug, Default)]
pub(super) struct Judgement {
    pub defects: Vec<Defect>,
    /// Motion of the driving joint.
    pub moves: Moves,
    /// The value of each goal, unless it is not determined everywhere; none for a design with defects.
    pub goals: Vec<Option<f64>>,
}

impl<'a> Judge<'a> {
    /// # Errors
    /// If names and values of the motion, the bounds or the goal are wrong.
    pub fn new(
        asked: &'a DesignDescription,
        read: &'a Read,
        (description, mechanism): (&'a Description, &'a Arc<Mechanism>),
        watch: &'a Watch<'a>,
    ) -> Result<Self, DesignError> {
        let plain = system::Question::new(mechanism);
        for (i, named) in asked.motion.iter().enumerate() {
            for (value, entry) in named.value.iter().enumerate() {
                let text = entry.expression.to_string();
                if let Err(error) = plain.value(&named.name.value, text) {
                    let problem = DesignProblem::Motion {
                        why: error.to_string(),
                    };
                    let (part, value) = (DesignPart::Motion(i), value > 0);
                    return Err(DesignError::Part {
                        part,
                        value,
                        problem,
                    });
                }
            }
        }
        for (i, output) in asked.outputs.iter().enumerate() {
            let question = Question::new(mechanism.clone()).output(output.value.clone());
            question.asked_outputs().map_err(|error| {
                let (why, suggestion) = (error.to_string(), None);
                DesignProblem::Quantity { why, suggestion }.at(DesignPart::Output(i))
            })?;
        }
        let figure =
            |name: &str, otherwise| Figure::read(mechanism, name, otherwise).map_err(no_quantity);
        let least = asked.at_least.iter().enumerate();
        let most = asked.at_most.iter().enumerate();
        let least = least.map(|(i, named)| (DesignPart::AtLeast(i), named, true));
        let all = least.chain(most.map(|(i, named)| (DesignPart::AtMost(i), named, false)));
        let mut bounds = Vec::new();
        let parameters = read.possible(mechanism);
        for (part, named, at_least) in all {
            let over = if at_least {
                Statistic::Least
            } else {
                Statistic::Greatest
            };
            let figure = figure(&named.name.value, Some(over)).map_err(|of| of.at(part))?;
            let text = named.name.value.clone();
            let figure = figure.ok_or_else(|| DesignProblem::NoFigure { text }.at(part))?;
            let bound = in_unit(mechanism, figure.unit, &named.value);
            let bound = bound.map_err(|problem| problem.of_value(part))?;
            let possible = figure.possible(&parameters);
            let slack = ROUNDING * (1.0 + bound.abs());
            let (best, beyond) = match at_least {
                true => (possible.high, possible.high < bound - slack),
                false => (possible.low, possible.low > bound + slack),
            };
            if beyond {
                let (name, unit) = (named.name.value.clone(), figure.unit);
                let problem = DesignProblem::Impossible {
                    name,
                    unit,
                    bound,
                    best,
                    at_least,
                };
                return Err(problem.of_value(part));
            }
            bounds.push(FigureBound {
                bound,
                figure,
                at_least,
            });
        }
        let goals = asked.goals.iter().enumerate().map(|(i, goal)| {
            let text = &goal.figure.value;
            let no_figure = || DesignProblem::NoFigure { text: text.clone() };
            let read = figure(text, None).and_then(|figure| figure.ok_or_else(no_figure));
            let read = match i {
                0 | 1 => read,
                _ => Err(DesignProblem::MoreGoals),
            };
            read.map_err(|problem| problem.at(DesignPart::Goal(i)))
        });
        let one_freedom = Question::new(mechanism.clone()).one_freedom().is_ok();
        let held = (!one_freedom).then(|| {
            let mut held = read.held.clone();
            driven(mechanism).for_each(|joint| held.joints[joint] = true);
            read.bundle(mechanism, asked.positions.len()).alone(held)
        });
        Ok(Judge {
            one_freedom,
            held,
            asked,
            read,
            description,
            mechanism,
            watch,
            bounds,
            goals: goals.collect::<Result<_, _>>()?,
        })
    }

    /// True if designs that meet the targets differ in worth.
    pub fn improves(&self) -> bool {
        !(self.goals.is_empty() && self.bounds.is_empty())
    }

    /// The units of the goals.
    pub fn units_of_goals(&self) -> impl Iterator<Item = SiUnit> {
        self.goals.iter().map(|goal| goal.unit)
    }

    /// The mechanism of a design.
    fn designed(&self, found: &FoundEnd) -> Option<Arc<Mechanism>> {
        let parameters = self.read.varied.iter().map(|of| of.parameter);
        let values: Vec<(usize, f64)> = parameters.zip(found.at.numbers.iter().copied()).collect();
        self.mechanism.with_values(&values).ok().map(Arc::new)
    }

    /// The file of a design, which begins in the first position.
    pub fn file(&self, found: &FoundEnd) -> String {
        let mut description = self.description.clone();
        let parameters = self.mechanism.parameters();
        let names = self
            .read
            .varied
            .iter()
            .map(|of| &parameters[of.parameter].name);
        for (name, value) in names.zip(&found.at.numbers) {
            if let Ok(changed) = description.clone().with_parameter(name, &number(*value)) {
                description = changed;
            }
        }
        if let Some(coordinates) = description.coordinates.as_deref() {
            return coordinates.axes.to_ron().unwrap_or_default();
        }
        let first = found.at.configurations.first();
        let values = first.into_iter().flat_map(|at| &at.joints);
        // a search may have gone round many times
        for (i, (joint, value)) in description.joints.iter_mut().zip(values).enumerate() {
            joint.value.home = Entry::number(self.mechanism.as_given(i, *value), 0..0);
        }
        description.to_ron().unwrap_or_default()
    }

    /// Costs of a design by each goal, or by none: the value of the goal, negative if it shall be great, or more than any goal
    /// where bounds are missed. `None` for other defects.
    pub fn costs(&self, found: &FoundEnd) -> Option<Vec<f64>> {
        self.costs_of(&self.verdict(found))
    }

    /// Costs of a design, of several freedoms by a few places of its moves alone: a search judges many.
    pub fn estimates(&self, found: &FoundEnd) -> Option<Vec<f64>> {
        let Some(held) = &self.held else {
            return self.costs(found);
        };
        let mechanism = self.designed(found)?;
        let mut verdict = Judgement::default();
        let places = self.passed(held, found)?;
        let places: Vec<_> = places.iter().map(|at| self.about(&mechanism, at)).collect();
        self.outside(&mechanism, &places, &mut verdict.defects);
        if verdict.defects.is_empty() {
            let seen = self.at_positions(&mechanism, &places);
            self.weighed(&seen, &mut verdict);
        }
        self.costs_of(&verdict)
    }

    fn costs_of(&self, verdict: &Judgement) -> Option<Vec<f64>> {
        let missed = verdict.defects.iter().map(|defect| match defect {
            Defect::Condition {
                bound,
                worst: Some(worst),
                ..
            } => Some((worst - bound).abs() / (1.0 + bound.abs())),
            _ => None,
        });
        let missed: f64 = missed.sum::<Option<f64>>()?;
        if missed > 0.0 || self.goals.is_empty() {
            let cost = if missed > 0.0 {
                MISSED * (1.0 + missed)
            } else {
                0.0
            };
            return Some(vec![cost; self.goals.len().max(1)]);
        }
        let goals = verdict.goals.iter().zip(&self.asked.goals);
        goals
            .map(|(value, goal)| Some(goal.sign() * (*value)?))
            .collect()
    }

    /// Bounds and goal by what the figures see.
    fn weighed(&self, seen: &[Vec<Observed>], verdict: &mut Judgement) {
        self.bounded(seen, &mut verdict.defects);
        if verdict.defects.is_empty() {
            let goals = self.goals.iter().zip(seen.iter().skip(self.bounds.len()));
            verdict.goals = goals.map(|(goal, seen)| goal.of(seen)).collect();
        }
    }

    /// Judges a design.
    pub fn verdict(&self, found: &FoundEnd) -> Judgement {
        let not_judged = || Judgement {
            defects: vec![Defect::NotJudged],
            ..Judgement::default()
        };
        let Some(mechanism) = self.designed(found) else {
            return not_judged();
        };
        let positions: Vec<_> = (found.at.configurations.iter())
            .map(|at| self.about(&mechanism, at))
            .collect();
        let mut verdict = Judgement::default();
        let defects = &mut verdict.defects;
        let seen = if self.one_freedom {
            let (held, driver) = (&self.read.held, self.read.driver);
            match course(&mechanism, held, &positions, driver, self.watch) {
                Ok(course) if course.whole => {
                    verdict.moves = driver_moves(&course);
                    self.judge(&mechanism, &course, defects);
                    let ranges = self.ranges(&mechanism, &positions, &course);
                    match defects.is_empty() {
                        true => self.motion(&mechanism, &positions, &ranges, defects),
                        false => None,
                    }
                }
                _ => return not_judged(),
            }
        } else {
            self.outside(&mechanism, &positions, defects);
            match defects.is_empty() {
                true => self.between(&mechanism, &positions, defects),
                false => None,
            }
        };
        if defects.is_empty() {
            self.weighed(&seen.unwrap_or_default(), &mut verdict);
        }
        verdict
    }

    /// A configuration with its positions measured from the centre of another mechanism of the same file.
    fn about(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Configuration<f64> {
        let mut at = at.clone();
        let centres = [self.mechanism, mechanism].map(|of| of.dimensions().centre);
        for platform in &mut at.platforms {
            for (i, x) in platform.position.0.iter_mut().enumerate() {
                *x += centres[0][i] - centres[1][i];
            }
        }
        at
    }
}

/// A number with all its digits, as a file has it.
fn number(value: f64) -> String {
    format!("{value}")
}

/// The joints that are driven.
fn driven(mechanism: &Mechanism) -> impl Iterator<Item = usize> {
    let joints = mechanism.joints().iter().enumerate();
    let driven = joints.filter(|(_, joint)| joint.role == Role::Actuated);
    driven.map(|(i, _)| i)
}

fn driver_turns(course: &DesignCourse) -> bool {
    course.closed && course.dead.is_empty() && (course.turn.abs() - TAU).abs() < SAME
}

fn driver_moves(course: &DesignCourse) -> Moves {
    match course {
        of if driver_turns(of) => Moves::Turns,
        of if of.closed && !of.dead.is_empty() || !of.limits.is_empty() => Moves::Rocks,
        _ => Moves::Unknown,
    }
}
