//! Motions on which designs are judged: inputs through their ranges, and straight moves between positions.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::super::drawn::with_numbers;
use super::{Figure, Judge, Observed, Statistic, driven, driver_turns};
use crate::algebra::SiUnit;
use crate::analysis::design::{Defect, DesignCourse, FoundEnd};
use crate::analysis::sweep::{SweepEnd, SweepSettings};
use crate::ask::Question;
use crate::description::Entry;
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::tolerance::{SAME, SOLVED};
use crate::system::{self, Bundle};

impl Judge<'_> {
    /// The ranges through which inputs go.
    pub(super) fn ranges(
        &self,
        mechanism: &Arc<Mechanism>,
        positions: &[Configuration<f64>],
        course: &DesignCourse,
    ) -> Vec<(String, f64, f64)> {
        let given = self.given_motion(mechanism);
        let (true, true, Some(driver)) = (given.is_empty(), self.improves(), self.read.driver)
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

    /// The ranges of inputs that the question gives.
    fn given_motion(&self, mechanism: &Arc<Mechanism>) -> Vec<(String, f64, f64)> {
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
        mechanism: &Arc<Mechanism>,
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
            return Some(self.at_positions(mechanism, positions));
        }
        let (from, to) = ranges.iter().map(|(_, from, to)| (*from, *to)).unzip();
        let ends: [Vec<f64>; 2] = [from, to];
        let apart = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            pairs.fold(0.0, f64::max)
        };
        let way = |from: &[f64], to: &[f64]| -> Vec<(String, f64, f64)> {
            let names = ranges.iter().map(|(name, ..)| name.clone());
            let ends = names.zip(from).zip(to);
            ends.map(|((name, from), to)| (name, *from, *to)).collect()
        };
        let mut see = |(seen, _): (Vec<Observed>, Vec<f64>)| {
            extend(&mut all, seen.into_iter().map(|seen| vec![seen]).collect());
        };
        // what belongs to the whole is seen on one way from end to end
        let whole = self.figures().any(Figure::is_of_whole) && mechanism.platforms().is_empty();
        if whole && apart(&starts, &ends[0]) > SOLVED {
            let there = way(&starts, &ends[0]);
            let (_, joints) = self.moved(mechanism, (first, 1.0), &there, defects)?;
            let begin = Configuration {
                joints,
                ..first.clone()
            };
            let along = way(&ends[0], &ends[1]);
            see(self.moved(mechanism, (&begin, 1.0), &along, defects)?);
            return Some(all);
        }
        for end in &ends {
            let long = apart(&starts, end);
            if long > SOLVED {
                see(self.moved(mechanism, (first, long), &way(&starts, end), defects)?);
            }
        }
        // ranges of one value are no motion
        match all.iter().any(Vec::is_empty) {
            true => Some(self.at_positions(mechanism, &positions[..1])),
            false => Some(all),
        }
    }

    /// Moves the driven joints of a mechanism with several freedoms straight from each position to the next, and inputs through the
    /// ranges that are given.
    pub(super) fn between(
        &self,
        mechanism: &Arc<Mechanism>,
        positions: &[Configuration<f64>],
        defects: &mut Vec<Defect>,
    ) -> Option<Vec<Vec<Observed>>> {
        let mut all = self.at_positions(mechanism, &positions[..1]);
        let mut elsewhere = Vec::new();
        for (k, pair) in positions.windows(2).enumerate() {
            let way = |joint: usize| {
                let (from, to) = (pair[0].joints[joint], pair[1].joints[joint]);
                let to = nearest_turn(mechanism, joint, to, from);
                (mechanism.joints()[joint].name.clone(), from, to)
            };
            let inputs: Vec<_> = driven(mechanism).map(way).collect();
            let seen = if inputs
                .iter()
                .all(|(_, from, to)| (to - from).abs() <= SOLVED)
            {
                self.at_positions(mechanism, &pair[1..])
            } else {
                let begin = (&pair[0], 1.0);
                let (seen, end) = self.moved(mechanism, begin, &inputs, defects)?;
                if apart(mechanism, &end, &pair[1].joints) {
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

    /// Places of the straight moves from each position to the next with the closures closed from place to place, some of each
    /// move; `None` if they lead elsewhere.
    pub(super) fn passed(
        &self,
        held: &Bundle,
        found: &FoundEnd,
    ) -> Option<Vec<Configuration<f64>>> {
        const PLACES: i32 = 6;
        let mut closer = held.closer(&found.at.numbers)?;
        let positions = &found.at.configurations;
        let mut all = positions[..1].to_vec();
        let side = closer.side(0, &positions[0]);
        for pair in positions.windows(2) {
            let mut at = pair[0].clone();
            for place in 1..=PLACES {
                let part = f64::from(place) / f64::from(PLACES);
                for joint in driven(self.mechanism) {
                    let (from, to) = (pair[0].joints[joint], pair[1].joints[joint]);
                    let to = nearest_turn(self.mechanism, joint, to, from);
                    at.joints[joint] = from + part * (to - from);
                }
                at = closer.closed(0, at)?;
                if closer.side(0, &at) != side {
                    return None;
                }
                all.push(at.clone());
            }
            if apart(self.mechanism, &at.joints, &pair[1].joints) {
                return None;
            }
        }
        Some(all)
    }

    /// The values of each figure in positions.
    pub(super) fn at_positions(
        &self,
        mechanism: &Arc<Mechanism>,
        positions: &[Configuration<f64>],
    ) -> Vec<Vec<Observed>> {
        let all = self.figures().count();
        let first = &positions[0];
        let question = self.question(mechanism, first).report(self.texts());
        let question = driven(mechanism).fold(question, |question, joint| {
            let name = mechanism.joints()[joint].name.as_str();
            question.hold(name, first.joints[joint])
        });
        let rows = match all {
            0 => Vec::new(),
            _ => question.measured_along(positions).unwrap_or_default(),
        };
        let value = |place: usize, i: usize| rows.get(place).and_then(|row| row[i]);
        let of = |i: usize| (0..positions.len()).map(move |place| Observed::here(value(place, i)));
        (0..all).map(|i| of(i).collect()).collect()
    }

    /// A question about a design from a configuration on.
    fn question(&self, mechanism: &Arc<Mechanism>, at: &Configuration<f64>) -> Question {
        let question = Question::new(mechanism.clone()).near(at.clone());
        let outputs = self.asked.outputs.iter();
        outputs.fold(question, |question, of| question.output(of.value.clone()))
    }

    fn figures(&self) -> impl Iterator<Item = &Figure> {
        let bounds = self.bounds.iter().map(|bound| &bound.figure);
        bounds.chain(&self.goals)
    }

    /// The quantities of all figures, each with a name of its own.
    fn texts(&self) -> String {
        let texts = self.figures().enumerate();
        let texts: Vec<String> = texts
            .map(|(i, figure)| match figure.over {
                Statistic::Straightness => {
                    let frame = figure.text.split('+').next().unwrap_or_default();
                    format!("figure{i}=[{}].x", frame.trim())
                }
                _ => format!("figure{i}={}", figure.text),
            })
            .collect();
        texts.join(", ")
    }

    /// Moves inputs from a configuration on, for some duration: what each figure sees on the way, and the joints at its end.
    fn moved(
        &self,
        mechanism: &Arc<Mechanism>,
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
        for (i, figure) in self.figures().enumerate() {
            question = match figure.over {
                Statistic::Dwell => question.dwell(format!("figure{i}"), figure.tolerance.as_str()),
                Statistic::Straightness => question.point(with_numbers(mechanism, &figure.text)?),
                _ => question,
            };
        }
        // extremes are those of the curve, whatever the rows
        let settings = SweepSettings {
            steps: 1,
            means: self.figures().any(Figure::is_mean),
            straightness: self.figures().any(|of| of.over == Statistic::Straightness),
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
        if motion.sweep.ending == SweepEnd::Stopped {
            defects.push(Defect::NotJudged);
            return None;
        }
        if motion.sweep.ending != SweepEnd::Complete {
            let input = motion.sweep.inputs.first();
            defects.push(Defect::Motion {
                input: input.map_or_else(String::new, |input| input.name.clone()),
                unit: input.map_or(SiUnit::ONE, |input| input.unit),
                at: input.and_then(|input| last(&input.name)),
            });
            return None;
        }
        let along = |(i, figure): (usize, &Figure)| match figure.over {
            Statistic::Dwell => {
                let mut dwells = motion.dwells.iter().filter(|of| !of.at_least);
                let dwell = dwells.find(|of| of.name == format!("figure{i}"))?;
                Some(dwell.times[1] - dwell.times[0])
            }
            Statistic::Straightness => {
                let name = with_numbers(mechanism, &figure.text)?;
                let mut lines = motion.straightness.iter().filter(|of| !of.at_least);
                Some(lines.find(|of| of.point == name)?.deviation)
            }
            _ => None,
        };
        let figures = motion.extremes.iter().zip(self.figures().enumerate());
        let seen = figures.map(|(of, figure)| Observed {
            along: along(figure),
            ..Observed::of(of, duration)
        });
        let joints = mechanism.joints().iter();
        let joints = joints.map(|joint| last(&joint.name).unwrap_or(f64::NAN));
        Some((seen.collect(), joints.collect()))
    }
}

/// The value of a joint that is nearest to another one, where turns are the same.
fn nearest_turn(mechanism: &Mechanism, joint: usize, to: f64, from: f64) -> f64 {
    let angle = mechanism.joints()[joint].kind.is_angle();
    match angle && mechanism.turns_to_repeat(joint) == Some(1.0) {
        true => turn_near(to, from),
        false => to,
    }
}

/// True for joints of different assemblies.
fn apart(mechanism: &Mechanism, a: &[f64], b: &[f64]) -> bool {
    let mut joints = mechanism.joints().iter().zip(a.iter().zip(b));
    joints.any(|(joint, (x, y))| {
        let y = if joint.kind.is_angle() {
            turn_near(*y, *x)
        } else {
            *y
        };
        (x - y).abs() > SAME
    })
}

/// Adds what figures see to what they saw before.
fn extend(all: &mut [Vec<Observed>], seen: Vec<Vec<Observed>>) {
    let pairs = all.iter_mut().zip(seen);
    pairs.for_each(|(all, seen)| all.extend(seen));
}
