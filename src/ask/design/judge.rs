//! Designs judged over their whole motion.

use std::f64::consts::TAU;

use super::DesignError;
use super::read::Read;
use crate::algebra::{Measure, SiUnit};
use crate::analysis::design::{Defect, DesignCourse, FoundEnd, Moves, course};
use crate::analysis::sweep::{SweepEnd, SweepSettings};
use crate::ask::{AskError, Question};
use crate::description::{Description, DesignDescription, DesignPart, DesignProblem, Entry, Named};
use crate::mechanism::{Configuration, Mechanism, Quantity};
use crate::solve::Watch;
use crate::system::{self, Value};

/// Judges designs by what was asked.
pub(super) struct Judge<'a> {
    pub asked: &'a DesignDescription,
    pub read: &'a Read,
    pub description: &'a Description,
    pub mechanism: &'a Mechanism,
    pub watch: &'a Watch<'a>,
}

/// Slack of a bound that is met, beside its size.
const SLACK: f64 = 1e-9;

impl Judge<'_> {
    /// Refuses names and values of the motion that are wrong.
    pub fn check(&self) -> Result<(), DesignError> {
        let plain = system::Question::new(self.mechanism);
        for (i, named) in self.asked.motion.iter().enumerate() {
            for (value, entry) in named.value.iter().enumerate() {
                let text = entry.expression.to_string();
                if let Err(error) = plain.value(&named.name.value, text) {
                    let problem = DesignProblem::Motion {
                        why: error.to_string(),
                        help: None,
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
        for (part, named, _) in self.bounds() {
            let (quantity, _) = self.quantity(named).map_err(|problem| problem.at(part))?;
            self.bound(&quantity, &named.value)
                .map_err(|problem| problem.of_value(part))?;
        }
        Ok(())
    }

    /// The bounds, true for those from below.
    fn bounds(&self) -> impl Iterator<Item = (DesignPart, &Named<Entry>, bool)> {
        let least = self.asked.at_least.iter().enumerate();
        let most = self.asked.at_most.iter().enumerate();
        let least = least.map(|(i, named)| (DesignPart::AtLeast(i), named, true));
        least.chain(most.map(|(i, named)| (DesignPart::AtMost(i), named, false)))
    }

    fn quantity(&self, named: &Named<Entry>) -> Result<(Quantity, String), DesignProblem> {
        let text = &named.name.value;
        match Quantity::read(self.mechanism, text, text) {
            Ok(quantity) => Ok((quantity, text.clone())),
            Err(error) => Err(DesignProblem::Quantity {
                why: error.to_string(),
                help: None,
            }),
        }
    }

    fn bound(&self, quantity: &Quantity, entry: &Entry) -> Result<f64, DesignProblem> {
        let measure = match quantity.unit {
            SiUnit::RADIAN => Measure::Angle,
            SiUnit::METRE => Measure::Length,
            _ => Measure::Number,
        };
        let text = entry.expression.to_string();
        let read = Value::Text(text.clone()).number(self.mechanism, measure);
        read.map_err(|error| {
            let why = error.to_string();
            DesignProblem::Value { text, why }
        })
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

    /// What a design does not do, and how its driving joint moves.
    pub fn defects(&self, found: &FoundEnd) -> (Vec<Defect>, Moves) {
        let Some(mechanism) = self.designed(found) else {
            return (vec![Defect::NotJudged], Moves::Unknown);
        };
        let positions: Vec<_> = (found.at.configurations.iter())
            .map(|at| self.about(&mechanism, at))
            .collect();
        let mut defects = Vec::new();
        let mut moves = Moves::Unknown;
        let mut along = None;
        let question = Question::new(mechanism.clone());
        if question.one_freedom().is_ok() {
            let held = &self.read.held;
            match course(&mechanism, held, &positions, self.read.driver, self.watch) {
                Ok(course) if course.whole => {
                    moves = driver(&course);
                    self.judge(&mechanism, &course, &mut defects);
                    along = Some(course);
                }
                _ => defects.push(Defect::NotJudged),
            }
        } else {
            self.outside(&mechanism, &positions, &mut defects);
        }
        if defects.is_empty() {
            self.motion(mechanism, &positions, along.as_ref(), &mut defects);
        }
        (defects, moves)
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

    /// The ranges through which inputs go, each from its value in the first position.
    fn ranges(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        along: Option<&DesignCourse>,
    ) -> Vec<(String, f64, f64)> {
        let plain = system::Question::new(mechanism);
        let given = self.asked.motion.iter().filter_map(|named| {
            let [from, to] = &named.value;
            let value =
                |entry: &Entry| plain.value(&named.name.value, entry.expression.to_string());
            let ((_, from), (_, to)) = (value(from).ok()?, value(to).ok()?);
            Some((named.name.value.clone(), from, to))
        });
        let given: Vec<_> = given.collect();
        let bounded = self.bounds().next().is_some();
        let (true, true, Some(driver), Some(course)) =
            (given.is_empty(), bounded, self.read.driver, along)
        else {
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

    /// Moves the inputs from the first position to both ends of their ranges, with the bounds measured.
    fn motion(
        &self,
        mechanism: Mechanism,
        positions: &[Configuration<f64>],
        along: Option<&DesignCourse>,
        defects: &mut Vec<Defect>,
    ) {
        let ranges = self.ranges(&mechanism, positions, along);
        if ranges.is_empty() {
            return;
        }
        let bounds: Vec<_> = self.bounds().collect();
        let texts: Vec<String> = (bounds.iter().enumerate())
            .map(|(i, (_, named, _))| format!("bound{i}={}", named.name.value))
            .collect();
        let plain = system::Question::new(&mechanism);
        let start = |name: &str| {
            let (of, _) = plain.value(name, "home").ok()?;
            Some(of.of(&mechanism, &positions[0]))
        };
        let starts: Vec<f64> = ranges
            .iter()
            .map(|(name, ..)| start(name).unwrap_or(0.0))
            .collect();
        for end in [0, 1] {
            let mut question = Question::new(mechanism.clone()).near(positions[0].clone());
            let mut moves = false;
            for ((name, from, to), start) in ranges.iter().zip(&starts) {
                let to = if end == 0 { *from } else { *to };
                moves |= (to - start).abs() > 1e-12;
                question = question.input(name.as_str(), *start, to);
            }
            if !moves {
                continue;
            }
            if !texts.is_empty() {
                question = question.report(texts.join(", "));
            }
            let settings = SweepSettings {
                steps: 60,
                ..SweepSettings::default()
            };
            let report = (question.motions(&settings, self.watch))
                .map(|motions| motions.report(2, &mut |_, _| {}, self.watch));
            let motion = match &report {
                Ok(report) => report.motions.first(),
                Err(AskError::Unmeasured { .. }) | Err(_) => None,
            };
            let Some(motion) = motion else {
                defects.push(Defect::NotJudged);
                return;
            };
            if motion.sweep.ending != SweepEnd::Complete {
                let bound = motion.sweep.inputs.first();
                let last = motion.values.last();
                let column = |name: &str| motion.columns.iter().position(|of| of.name == name);
                let at = bound.and_then(|bound| *last?.get(column(&bound.name)?)?);
                defects.push(Defect::Motion {
                    input: ranges[0].0.clone(),
                    unit: bound.map_or(SiUnit::ONE, |bound| bound.unit),
                    at,
                });
                return;
            }
            for ((_, named, at_least), extreme) in bounds.iter().zip(&motion.extremes) {
                let Ok((quantity, text)) = self.quantity(named) else {
                    continue;
                };
                let Ok(bound) = self.bound(&quantity, &named.value) else {
                    continue;
                };
                let end = match at_least {
                    true => &extreme.least,
                    false => &extreme.greatest,
                };
                let worst = extreme.constant.or(end.as_ref().map(|end| end.value));
                let worst = worst.filter(|_| extreme.unbounded.is_empty() && !extreme.at_least);
                let slack = SLACK * (1.0 + bound.abs());
                let kept = worst.is_some_and(|worst| match at_least {
                    true => worst >= bound - slack,
                    false => worst <= bound + slack,
                });
                let known = defects.iter().any(|defect| {
                    matches!(defect, Defect::Condition { quantity, .. } if *quantity == text)
                });
                if !kept && !known {
                    defects.push(Defect::Condition {
                        quantity: text,
                        unit: quantity.unit,
                        bound,
                        worst,
                        at_least: *at_least,
                    });
                }
            }
        }
    }
}

/// A number with all its digits, as a file has it.
fn number(value: f64) -> String {
    format!("{value}")
}

fn driver_turns(course: &DesignCourse) -> bool {
    course.closed && course.dead.is_empty() && (course.turn.abs() - TAU).abs() < 1e-6
}

fn driver(course: &DesignCourse) -> Moves {
    match course {
        of if driver_turns(of) => Moves::Turns,
        of if of.closed && !of.dead.is_empty() || !of.limits.is_empty() => Moves::Rocks,
        _ => Moves::Unknown,
    }
}
