//! Motions on which designs are judged: inputs through their ranges, and straight moves between positions.

use std::f64::consts::TAU;

use super::{Figure, Judge, Observed, driver_turns};
use crate::algebra::SiUnit;
use crate::analysis::design::{Defect, DesignCourse};
use crate::analysis::sweep::{SweepEnd, SweepSettings};
use crate::ask::Question;
use crate::description::{Entry, Role};
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::tolerance::{SAME, SOLVED};
use crate::system;

/// Joints that differ by more are those of another assembly.
const APART: f64 = SAME;

impl Judge<'_> {
    /// The ranges through which inputs go.
    pub(super) fn ranges(
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
    pub(super) fn motion(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        ranges: &[(String, f64, f64)],
        defects: &mut Vec<Defect>,
    ) -> Option<Vec<Vec<Observed>>> {
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
                extend(&mut all, seen);
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
                extend(&mut all, seen.into_iter().map(|seen| vec![seen]).collect());
            }
        }
        Some(all)
    }

    /// Moves the driven joints of a mechanism with several freedoms straight from each position to the next, and inputs through the
    /// ranges that are given.
    pub(super) fn between(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        defects: &mut Vec<Defect>,
    ) -> Option<Vec<Vec<Observed>>> {
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
            extend(&mut all, seen);
        }
        if !elsewhere.is_empty() {
            defects.push(Defect::Assembly {
                positions: elsewhere,
            });
        }
        let given = self.given_motion(mechanism);
        if !given.is_empty() {
            let seen = self.motion(mechanism, positions, &given, defects)?;
            extend(&mut all, seen);
        }
        Some(all)
    }

    /// What each figure sees in one position.
    fn at_position(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<Vec<Observed>> {
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
        values
            .into_iter()
            .map(|x| vec![Observed::here(x)])
            .collect()
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
    ) -> Option<(Vec<Observed>, Vec<f64>)> {
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
        let seen = motion.extremes.iter().map(|of| Observed::of(of, duration));
        let joints = mechanism.joints().iter();
        let joints = joints.map(|joint| last(&joint.name).unwrap_or(f64::NAN));
        Some((seen.collect(), joints.collect()))
    }
}

/// Adds what figures see to what they saw before.
fn extend(all: &mut [Vec<Observed>], seen: Vec<Vec<Observed>>) {
    let pairs = all.iter_mut().zip(seen);
    pairs.for_each(|(all, seen)| all.extend(seen));
}
