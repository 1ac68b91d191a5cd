//! Inputs over time, through the rows of a table.

use super::points::Paths;
use super::{
    MetKind, PathPoint, PathReport, Row, Sink, SweepEnd, SweepReport, SweepSettings, sweep,
};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::sorting::sort_by;
use crate::number::tolerance::{ROUNDING, SAME};
use crate::solve::{Watch, halved};
use crate::system::{Driven, Held};

/// Inputs that go through given values at given times by natural cubic splines: their rates and accelerations are
/// continuous, and the accelerations vanish at both ends.
///
/// Source: de Boor, A Practical Guide to Splines, chapter IV.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// Times in s, ascending.
    times: Vec<f64>,
    /// For each input its values at the times, in m or rad, and its accelerations there.
    inputs: Vec<[Vec<f64>; 2]>,
}

impl Schedule {
    /// Splines through values at ascending times, of which there are at least two; for each input as many values as
    /// times.
    pub fn new(times: Vec<f64>, inputs: Vec<Vec<f64>>) -> Self {
        let inputs = inputs.into_iter().map(|values| {
            let accelerations = accelerations(&times, &values);
            [values, accelerations]
        });
        Schedule {
            inputs: inputs.collect(),
            times,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.times.len()
    }

    /// The time from the first row to the last, in s.
    pub fn duration(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// Value, rate and acceleration of an input where a part of the time is gone.
    pub fn at(&self, input: usize, part: f64) -> [f64; 3] {
        let time = self.times[0] + part * self.duration();
        let after = self.times.partition_point(|known| *known <= time);
        let i = after.clamp(1, self.times.len() - 1);
        let [values, curved] = &self.inputs[input];
        let h = self.times[i] - self.times[i - 1];
        let (u, v) = (self.times[i] - time, time - self.times[i - 1]);
        let (from, to) = (values[i - 1], values[i]);
        let (a, b) = (curved[i - 1] / 6.0, curved[i] / 6.0);
        [
            // at the rows themselves without rounding
            match (u == 0.0, v == 0.0) {
                (true, _) => to,
                (_, true) => from,
                _ => {
                    (a * u.powi(3) + b * v.powi(3)) / h
                        + (from / h - a * h) * u
                        + (to / h - b * h) * v
                }
            },
            3.0 * (b * v * v - a * u * u) / h + (to - from) / h - (b - a) * h,
            6.0 * (a * u + b * v) / h,
        ]
    }

    /// Rate and acceleration of an input where a part of the time is gone.
    pub fn rates(&self, input: usize, part: f64) -> [f64; 2] {
        let [_, rate, change] = self.at(input, part);
        [rate, change]
    }

    /// The inputs from one part of the time to another.
    fn span(&self, inputs: &[Driven], [from, to]: [f64; 2]) -> Vec<Driven> {
        let inputs = inputs.iter().enumerate().map(|(i, input)| Driven {
            from: self.at(i, from)[0],
            to: self.at(i, to)[0],
            ..*input
        });
        inputs.collect()
    }

    /// Parts of the time between which every input goes one way, and no farther than a tenth of its unit; the last is 1.
    fn turns(&self, units: &[f64]) -> Vec<f64> {
        let mut parts = vec![0.0];
        for i in 1..self.times.len() {
            let h = self.times[i] - self.times[i - 1];
            let begin = self.times[i - 1] - self.times[0];
            // where a rate vanishes: a quadratic of the time v that is gone
            let mut ends: Vec<f64> = vec![h];
            for [values, curved] in &self.inputs {
                let (a, b) = (curved[i - 1] / 6.0, curved[i] / 6.0);
                let slope = (values[i] - values[i - 1]) / h - (b - a) * h - 3.0 * a * h;
                let (square, line) = (3.0 * (b - a) / h, 3.0 * a);
                let root = (line * line - square * slope).sqrt();
                let far = -(line + root.copysign(line));
                let roots = [far / square, slope / far];
                ends.extend(roots.iter().filter(|v| **v > 0.0 && **v < h));
            }
            sort_by(&mut ends, f64::total_cmp);
            let mut from = parts[parts.len() - 1];
            for end in ends {
                let to = (begin + end) / self.duration();
                let ways = units.iter().enumerate().map(|(input, unit)| {
                    (self.at(input, to)[0] - self.at(input, from)[0]).abs() / unit
                });
                let count = (ways.fold(0.0, f64::max) / 0.1).ceil().clamp(1.0, 1e4);
                parts.extend((1..=count as usize).map(|k| from + (to - from) * k as f64 / count));
                from = to;
            }
        }
        parts.push(1.0);
        parts
    }

    /// Moves the inputs from row to row, and to where one of them turns back between rows, each piece followed surely, so
    /// that no branch is changed between two rows.
    pub(super) fn followed(
        &self,
        (mechanism, held, inputs): (&Mechanism, &Held<f64>, &[Driven]),
        start: &Configuration<f64>,
        settings: &SweepSettings,
        sink: &mut Sink,
        watch: &Watch,
    ) -> SweepReport {
        let alone = SweepSettings {
            steps: 1,
            continuation: settings.continuation.clone(),
            points: settings.points.clone(),
            ..SweepSettings::default()
        };
        let units: Vec<f64> = (inputs.iter())
            .map(|input| input.coordinate.scale(mechanism))
            .collect();
        let mut turns = self.turns(&units).into_iter().peekable();
        let mut traced = Paths::new(mechanism, &settings.points);
        let mut at = start.clone();
        let mut whole = SweepReport::of(mechanism, inputs, SweepEnd::Complete);
        let (mut gone, mut row_ahead) = (0.0, 1);
        while row_ahead <= settings.steps {
            let time_of_row = row_ahead as f64 / settings.steps as f64;
            while turns.next_if(|turn| *turn < gone + ROUNDING).is_some() {}
            let turn = turns.peek().filter(|turn| **turn < time_of_row - ROUNDING);
            let (to, step) = match turn {
                Some(turn) => (*turn, None),
                None => (time_of_row, Some(row_ahead)),
            };
            row_ahead += usize::from(step.is_some());
            let moved = self.span(inputs, [gone, to]);
            let begin = at.clone();
            let most = (0..moved.len()).max_by(|&i, &j| {
                let [a, b] = [i, j].map(|i| (moved[i].to - moved[i].from).abs() / units[i]);
                a.total_cmp(&b)
            });
            let mut take = |row: &Row| {
                // a piece begins where the one before ended
                if row.step == Some(0) && gone > 0.0 {
                    return;
                }
                let ends = row.step == Some(1);
                // the input that moves most says when it is elsewhere: it goes one way
                let time = match most.filter(|_| row.step.is_none()) {
                    Some(i) => {
                        let of = &moved[i];
                        let wanted = of.coordinate.of(mechanism, row.configuration);
                        let before =
                            |time: f64| (self.at(i, time)[0] < wanted) == (of.from < of.to);
                        let [before, after] = halved([gone, to], before);
                        0.5 * (before + after)
                    }
                    None if ends => to,
                    None => gone,
                };
                let between = ends && step.is_none();
                traced.place(row.configuration);
                sink(&Row {
                    number: whole.rows,
                    step: if ends { step } else { row.step },
                    time: Some(time),
                    points: &traced.at,
                    between,
                    ..*row
                });
                whole.rows += usize::from(!between);
                if ends {
                    at.clone_from(row.configuration);
                }
            };
            if moved.iter().all(|input| input.from == input.to) {
                for step in [0, 1] {
                    take(&Row {
                        step: Some(step),
                        ..Row::of(&begin)
                    });
                }
                gone = to;
                continue;
            }
            let report = sweep(mechanism, held, &moved, &begin, &alone, &mut take, watch);
            let last = row_ahead > settings.steps || report.ending != SweepEnd::Complete;
            let met = report.met.into_iter();
            (whole.met).extend(met.filter(|met| last || met.kind != MetKind::End));
            whole.more_met += report.more_met;
            whole.sure_steps += report.sure_steps;
            whole.length += report.length;
            whole.interrupted = report.interrupted;
            met_on_paths(&mut whole.paths, report.paths);
            whole.ending = report.ending;
            if last {
                break;
            }
            gone = to;
        }
        whole
    }
}

/// Adds what was met on paths in one step; what was passed before is the same point. Paths that cross in different
/// steps are not looked for.
fn met_on_paths(all: &mut Vec<PathReport>, more: Vec<PathReport>) {
    if all.is_empty() {
        *all = more;
        return;
    }
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME);
    for (path, more) in all.iter_mut().zip(more) {
        for (known, found) in [
            (&mut path.cusps, more.cusps),
            (&mut path.double_points, more.double_points),
        ] {
            for point in found {
                let same =
                    |of: &PathPoint| of.joints.iter().zip(&point.joints).all(|(a, b)| near(a, b));
                if !known.iter().any(same) {
                    known.push(point);
                }
            }
        }
    }
}

/// The second derivatives of the natural cubic spline at its knots: a tridiagonal system, by elimination.
fn accelerations(times: &[f64], values: &[f64]) -> Vec<f64> {
    let count = times.len();
    let mut found = vec![0.0; count];
    let (mut above, mut right) = (vec![0.0; count], vec![0.0; count]);
    for i in 1..count - 1 {
        let (before, after) = (times[i] - times[i - 1], times[i + 1] - times[i]);
        let slopes = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
        let pivot = 2.0 * (before + after) - before * above[i - 1];
        above[i] = after / pivot;
        right[i] = (6.0 * slopes - before * right[i - 1]) / pivot;
    }
    for i in (1..count - 1).rev() {
        found[i] = right[i] - above[i] * found[i + 1];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::Schedule;

    #[test]
    fn a_straight_line_stays_one() {
        let line = Schedule::new(vec![0.0, 0.4, 2.0], vec![vec![1.0, 1.8, 5.0]]);
        for part in [0.0, 0.1, 0.7, 1.0] {
            let [value, rate, acceleration] = line.at(0, part);
            assert!((value - (1.0 + 4.0 * part)).abs() < 1e-15);
            assert!((rate - 2.0).abs() < 1e-14 && acceleration.abs() < 1e-14);
        }
    }
}
