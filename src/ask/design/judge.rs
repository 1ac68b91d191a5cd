//! Designs judged over their whole motion.

use std::f64::consts::TAU;

use super::DesignError;
use super::figure::{Figure, Over, Seen, no_quantity};
use super::read::Read;
use crate::algebra::{Measure, SiUnit};
use crate::analysis::design::{Defect, DesignCourse, FoundEnd, Moves, course};
use crate::analysis::sweep::{SweepEnd, SweepSettings};
use crate::ask::Question;
use crate::description::{Description, DesignDescription, DesignPart, DesignProblem, Entry, Role};
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::tolerance::{SAME, SOLVED};
use crate::solve::Watch;
use crate::system::{self, Value};

/// Judges designs by what was asked.
pub(super) struct Judge<'a> {
    asked: &'a DesignDescription,
    read: &'a Read,
    description: &'a Description,
    mechanism: &'a Mechanism,
    watch: &'a Watch<'a>,
    bounds: Vec<Bound>,
    goal: Option<Figure>,
}

/// A bound of a figure.
struct Bound {
    figure: Figure,
    bound: f64,
    at_least: bool,
}

/// A judgement of a design.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdict {
    pub defects: Vec<Defect>,
    /// How the driving joint moves.
    pub moves: Moves,
    /// The value of what is improved; `None` for a design with defects, or if it is not determined everywhere.
    pub goal: Option<f64>,
}

/// Slack of a bound that is met, beside its size.
const SLACK: f64 = 1e-9;

/// Joints that differ by more are those of another assembly.
const APART: f64 = SAME;

impl<'a> Judge<'a> {
    /// # Errors
    /// If names and values of the motion, the bounds or the goal are wrong.
    pub fn new(
        asked: &'a DesignDescription,
        read: &'a Read,
        (description, mechanism): (&'a Description, &'a Mechanism),
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
        for (part, named, at_least) in all {
            let over = if at_least {
                Over::Least
            } else {
                Over::Greatest
            };
            let figure = figure(&named.name.value, Some(over)).map_err(|of| of.at(part))?;
            let figure = figure.expect("there is a figure otherwise");
            let bound = bound(mechanism, &figure, &named.value);
            bounds.push(Bound {
                bound: bound.map_err(|problem| problem.of_value(part))?,
                figure,
                at_least,
            });
        }
        let goal = asked.goal.as_ref().map(|goal| {
            let text = &goal.figure.value;
            let no_figure = || DesignProblem::NoFigure { text: text.clone() };
            let read = figure(text, None).and_then(|figure| figure.ok_or_else(no_figure));
            read.map_err(|problem| problem.at(DesignPart::Goal))
        });
        Ok(Judge {
            asked,
            read,
            description,
            mechanism,
            watch,
            bounds,
            goal: goal.transpose()?,
        })
    }

    /// True if designs that meet the targets differ in worth.
    pub fn improves(&self) -> bool {
        self.goal.is_some() || !self.bounds.is_empty()
    }

    /// The unit of what is improved.
    pub fn unit_of_goal(&self) -> Option<SiUnit> {
        self.goal.as_ref().map(|goal| goal.quantity.unit)
    }

    /// The mechanism of a design.
    fn designed(&self, found: &FoundEnd) -> Option<Mechanism> {
        let parameters = self.read.varied.iter().map(|of| of.parameter);
        let values: Vec<(usize, f64)> = parameters.zip(found.at.numbers.iter().copied()).collect();
        self.mechanism.with_values(&values).ok()
    }

    /// The file of a design, which begins in the first position.
    pub fn file(&self, found: &FoundEnd) -> String {
        let mut description = self.description.clone();
        let names = self.asked.vary.iter().map(|named| &named.name.value);
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
        for (joint, value) in description.joints.iter_mut().zip(values) {
            joint.value.home = Entry::number(*value, 0..0);
        }
        description.to_ron().unwrap_or_default()
    }

    /// What a design costs: the value of the goal, negative if it shall be great, or more than any goal where bounds are missed.
    /// `None` for other defects.
    pub fn cost(&self, found: &FoundEnd) -> Option<f64> {
        const MISSED: f64 = 1e30;
        let verdict = self.verdict(found);
        let missed = verdict.defects.iter().map(|defect| match defect {
            Defect::Condition {
                bound,
                worst: Some(worst),
                ..
            } => Some((worst - bound).abs() / (1.0 + bound.abs())),
            _ => None,
        });
        let missed: f64 = missed.sum::<Option<f64>>()?;
        match &self.asked.goal {
            _ if missed > 0.0 => Some(MISSED * (1.0 + missed)),
            None => Some(0.0),
            Some(goal) if goal.greatest => Some(-verdict.goal?),
            Some(_) => verdict.goal,
        }
    }

    /// Judges a design.
    pub fn verdict(&self, found: &FoundEnd) -> Verdict {
        let not_judged = || Verdict {
            defects: vec![Defect::NotJudged],
            ..Verdict::default()
        };
        let Some(mechanism) = self.designed(found) else {
            return not_judged();
        };
        let positions: Vec<_> = (found.at.configurations.iter())
            .map(|at| self.about(&mechanism, at))
            .collect();
        let mut verdict = Verdict::default();
        let defects = &mut verdict.defects;
        let seen = if Question::new(mechanism.clone()).one_freedom().is_ok() {
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
        let seen = seen.unwrap_or_default();
        if defects.is_empty() {
            self.bounded(&seen, defects);
            let goal = self.goal.as_ref().zip(seen.last());
            verdict.goal = goal.and_then(|(goal, seen)| goal.of(seen));
        }
        if !defects.is_empty() {
            verdict.goal = None;
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

    fn outside(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        defects: &mut Vec<Defect>,
    ) {
        let mut beyond: Vec<(usize, usize)> = Vec::new();
        for (i, at) in positions.iter().enumerate() {
            let mut joints = at.joints.clone();
            mechanism.turn_to_limits(&mut joints);
            beyond.extend(
                mechanism
                    .outside_limits(&joints)
                    .map(|joint| (joint, i + 1)),
            );
        }
        if !beyond.is_empty() {
            let mut joints: Vec<String> = (beyond.iter())
                .map(|(joint, _)| mechanism.joints()[*joint].name.clone())
                .collect();
            let mut positions: Vec<usize> = beyond.iter().map(|(_, i)| *i).collect();
            joints.dedup();
            positions.dedup();
            defects.push(Defect::Limit { joints, positions });
        }
    }

    fn judge(&self, mechanism: &Mechanism, course: &DesignCourse, defects: &mut Vec<Defect>) {
        let numbers = |places: Vec<usize>| places.into_iter().map(|i| i + 1).collect::<Vec<_>>();
        let elsewhere = course.elsewhere();
        if !elsewhere.is_empty() {
            let mut limits = course.limits.clone();
            limits.sort_unstable();
            limits.dedup();
            defects.push(match limits.is_empty() {
                true => Defect::Circuit {
                    positions: numbers(elsewhere),
                },
                false => Defect::Limit {
                    joints: (limits.iter())
                        .map(|joint| mechanism.joints()[*joint].name.clone())
                        .collect(),
                    positions: numbers(elsewhere),
                },
            });
        }
        let beyond = course.beyond_dead();
        if let (false, Some(driver)) = (beyond.is_empty(), self.read.driver) {
            defects.push(Defect::Branch {
                driver: mechanism.joints()[driver].name.clone(),
                positions: numbers(beyond),
            });
        }
        let ordered = self.read.driven || self.asked.any_order;
        if course.elsewhere().is_empty() && !ordered && !course.in_order() {
            defects.push(Defect::Order {
                order: numbers(course.order()),
            });
        }
        if course.crosses {
            defects.push(Defect::Crossing);
        }
    }

    /// The ranges through which inputs go.
    fn ranges(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        course: &DesignCourse,
    ) -> Vec<(String, f64, f64)> {
        let given = self.given_motion(mechanism);
        let measured = !self.bounds.is_empty() || self.goal.is_some();
        let (true, true, Some(driver)) = (given.is_empty(), measured, self.read.driver) else {
            return given;
        };
        // all of a turn, or from the least to the greatest of the positions
        let name = mechanism.joints()[driver].name.clone();
        let first = positions[0].joints[driver];
        if driver_turns(course) {
            return vec![(name, first, first + TAU)];
        }
        let turns = mechanism.turns_to_repeat(driver) == Some(1.0);
        let near = |value: f64| match turns {
            true => value - ((value - first) / TAU).round() * TAU,
            false => value,
        };
        let values = positions.iter().map(|at| near(at.joints[driver]));
        let (low, high) = values.fold((first, first), |(low, high), x| (low.min(x), high.max(x)));
        vec![(name, low, high)]
    }

    /// The ranges of inputs that the question gives.
    fn given_motion(&self, mechanism: &Mechanism) -> Vec<(String, f64, f64)> {
        let plain = system::Question::new(mechanism);
        let given = self.asked.motion.iter().filter_map(|named| {
            let value = |entry: &Entry| {
                let text = entry.expression.to_string();
                Some(plain.value(&named.name.value, text).ok()?.1)
            };
            let [from, to] = &named.value;
            Some((named.name.value.clone(), value(from)?, value(to)?))
        });
        given.collect()
    }

    /// Moves the inputs from the first position to both ends of their ranges. What each figure sees on the way, unless the
    /// motion stops; without ranges what they see in the positions.
    fn motion(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        ranges: &[(String, f64, f64)],
        defects: &mut Vec<Defect>,
    ) -> Option<Vec<Vec<Seen>>> {
        let first = &positions[0];
        let plain = system::Question::new(mechanism);
        let start = |name: &str| Some(plain.value(name, "home").ok()?.0.of(mechanism, first));
        let starts: Vec<f64> = (ranges.iter())
            .map(|(name, ..)| start(name).unwrap_or(0.0))
            .collect();
        let mut all = vec![Vec::new(); self.figures().count()];
        if ranges.is_empty() {
            for at in positions {
                let seen = self.at_position(mechanism, at);
                all.iter_mut()
                    .zip(seen)
                    .for_each(|(all, seen)| all.extend(seen));
            }
            return Some(all);
        }
        for end in [0, 1] {
            let mut inputs = Vec::new();
            let mut longest: f64 = 0.0;
            for ((name, from, to), start) in ranges.iter().zip(&starts) {
                let to = if end == 0 { *from } else { *to };
                longest = longest.max((to - start).abs());
                inputs.push((name.clone(), *start, to));
            }
            if longest > SOLVED {
                let (seen, _) = self.moved(mechanism, (first, longest), &inputs, defects)?;
                all.iter_mut()
                    .zip(seen)
                    .for_each(|(all, seen)| all.push(seen));
            }
        }
        Some(all)
    }

    /// Moves the driven joints of a mechanism with several freedoms straight from each position to the next.
    fn between(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        defects: &mut Vec<Defect>,
    ) -> Option<Vec<Vec<Seen>>> {
        let given = self.given_motion(mechanism);
        if !given.is_empty() {
            return self.motion(mechanism, positions, &given, defects);
        }
        let joints = mechanism.joints().iter().enumerate();
        let driven = joints.filter(|(_, joint)| joint.role == Role::Actuated);
        let driven: Vec<usize> = driven.map(|(i, _)| i).collect();
        let mut all = self.at_position(mechanism, &positions[0]);
        let mut elsewhere = Vec::new();
        for (k, pair) in positions.windows(2).enumerate() {
            let way = |joint: &usize| {
                let (from, to) = (pair[0].joints[*joint], pair[1].joints[*joint]);
                let angle = mechanism.joints()[*joint].kind.is_angle()
                    && mechanism.turns_to_repeat(*joint) == Some(1.0);
                let to = if angle { turn_near(to, from) } else { to };
                (mechanism.joints()[*joint].name.clone(), from, to)
            };
            let inputs: Vec<_> = driven.iter().map(way).collect();
            let seen = if inputs
                .iter()
                .all(|(_, from, to)| (to - from).abs() <= SOLVED)
            {
                self.at_position(mechanism, &pair[1])
            } else {
                let begin = (&pair[0], 1.0);
                let (seen, end) = self.moved(mechanism, begin, &inputs, defects)?;
                let apart = |(joint, (x, y)): (usize, (&f64, &f64))| {
                    let y = match mechanism.joints()[joint].kind.is_angle() {
                        true => turn_near(*y, *x),
                        false => *y,
                    };
                    (x - y).abs() > APART
                };
                if end.iter().zip(&pair[1].joints).enumerate().any(apart) {
                    elsewhere.push(k + 2);
                }
                seen.into_iter().map(|seen| vec![seen]).collect()
            };
            all.iter_mut()
                .zip(seen)
                .for_each(|(all, seen)| all.extend(seen));
        }
        if !elsewhere.is_empty() {
            defects.push(Defect::Assembly {
                positions: elsewhere,
            });
        }
        Some(all)
    }

    /// What each figure sees in one position.
    fn at_position(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<Vec<Seen>> {
        let all = self.figures().count();
        let question = self.question(mechanism, at);
        let joints = mechanism.joints().iter().zip(&at.joints);
        let driven = joints.filter(|(joint, _)| joint.role == Role::Actuated);
        let question = driven.fold(question.report(self.texts()), |question, (joint, value)| {
            question.hold(joint.name.as_str(), *value)
        });
        let read = match all {
            0 => Vec::new(),
            _ => question.measured_here(false, false).unwrap_or_default(),
        };
        // after whether it assembles
        let mut values: Vec<Option<f64>> = read.into_iter().skip(1).collect();
        values.resize(all, None);
        values.into_iter().map(|x| vec![Seen::here(x)]).collect()
    }

    /// A question about a design from a configuration on.
    fn question(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Question {
        let question = Question::new(mechanism.clone()).near(at.clone());
        let outputs = self.asked.outputs.iter();
        outputs.fold(question, |question, of| question.output(of.value.clone()))
    }

    fn figures(&self) -> impl Iterator<Item = &Figure> {
        let bounds = self.bounds.iter().map(|bound| &bound.figure);
        bounds.chain(&self.goal)
    }

    /// The quantities of all figures, each with a name of its own.
    fn texts(&self) -> String {
        let texts = self.figures().enumerate();
        let texts: Vec<String> = texts
            .map(|(i, figure)| format!("figure{i}={}", figure.text))
            .collect();
        texts.join(", ")
    }

    /// Moves inputs from a configuration on, for some duration: what each figure sees on the way, and the joints at its end.
    fn moved(
        &self,
        mechanism: &Mechanism,
        (begin, duration): (&Configuration<f64>, f64),
        inputs: &[(String, f64, f64)],
        defects: &mut Vec<Defect>,
    ) -> Option<(Vec<Seen>, Vec<f64>)> {
        let question = self.question(mechanism, begin);
        let inputs = inputs.iter();
        let mut question = inputs.fold(question, |question, (name, from, to)| {
            question.input(name.as_str(), *from, *to)
        });
        let texts = self.texts();
        if !texts.is_empty() {
            question = question.report(texts);
        }
        // extremes are those of the curve, whatever the rows
        let settings = SweepSettings {
            steps: 1,
            ..SweepSettings::default()
        };
        let report = (question.motions(&settings, self.watch))
            .map(|motions| motions.report(2, &mut |_, _| {}, self.watch));
        let motion = report
            .ok()
            .and_then(|report| report.motions.into_iter().next());
        let Some(motion) = motion else {
            defects.push(Defect::NotJudged);
            return None;
        };
        let column = |name: &str| motion.columns.iter().position(|of| of.name == name);
        let last = |name: &str| *motion.values.last()?.get(column(name)?)?;
        if motion.sweep.ending != SweepEnd::Complete {
            let input = motion.sweep.inputs.first();
            defects.push(Defect::Motion {
                input: input.map_or_else(String::new, |input| input.name.clone()),
                unit: input.map_or(SiUnit::ONE, |input| input.unit),
                at: input.and_then(|input| last(&input.name)),
            });
            return None;
        }
        let seen = motion.extremes.iter().map(|of| Seen::of(of, duration));
        let joints = mechanism.joints().iter();
        let joints = joints.map(|joint| last(&joint.name).unwrap_or(f64::NAN));
        Some((seen.collect(), joints.collect()))
    }

    /// The bounds that are not kept.
    fn bounded(&self, seen: &[Vec<Seen>], defects: &mut Vec<Defect>) {
        for (bound, seen) in self.bounds.iter().zip(seen) {
            let (limit, at_least) = (bound.bound, bound.at_least);
            let worst = bound.figure.of(seen);
            let slack = SLACK * (1.0 + limit.abs());
            let kept = worst.is_some_and(|worst| match at_least {
                true => worst >= limit - slack,
                false => worst <= limit + slack,
            });
            if !kept {
                defects.push(Defect::Condition {
                    quantity: bound.figure.quantity.name.clone(),
                    unit: bound.figure.quantity.unit,
                    bound: limit,
                    worst,
                    at_least,
                });
            }
        }
    }
}

/// The value of a bound.
fn bound(mechanism: &Mechanism, figure: &Figure, entry: &Entry) -> Result<f64, DesignProblem> {
    let measure = match figure.quantity.unit {
        SiUnit::RADIAN => Measure::Angle,
        SiUnit::METRE => Measure::Length,
        _ => Measure::Number,
    };
    let text = entry.expression.to_string();
    let read = Value::Text(text.clone()).number(mechanism, measure);
    read.map_err(|error| {
        let why = error.to_string();
        DesignProblem::Value { text, why }
    })
}

/// A number with all its digits, as a file has it.
fn number(value: f64) -> String {
    format!("{value}")
}

fn driver_turns(course: &DesignCourse) -> bool {
    course.closed && course.dead.is_empty() && (course.turn.abs() - TAU).abs() < 1e-6
}

fn driver_moves(course: &DesignCourse) -> Moves {
    match course {
        of if driver_turns(of) => Moves::Turns,
        of if of.closed && !of.dead.is_empty() || !of.limits.is_empty() => Moves::Rocks,
        _ => Moves::Unknown,
    }
}
