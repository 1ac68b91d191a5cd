//! The least and greatest values of quantities over a motion.

use super::Meter;
use crate::analysis::sweep::{Between, Extreme, Extremum, Schedule};
use crate::mechanism::{Configuration, Mechanism, Quantity};
use crate::solve::summit;
use crate::system::{Driven, Held};

/// Watches rows and remembers where quantities are least and greatest.
pub(in super::super) struct Extremes {
    rows: Vec<Seen>,
    seen: usize,
    sides: Vec<[Side; 2]>,
}

/// A row that was seen.
#[derive(Clone)]
struct Seen {
    at: Configuration<f64>,
    /// The part of the time that is gone.
    time: f64,
    values: Vec<Option<f64>>,
}

/// Rows where a quantity is greater than at their neighbours, or less: the best of them.
#[derive(Clone, Default)]
struct Side {
    /// The greatest value at a row at all, where it is, and when.
    row: Option<(f64, Configuration<f64>, f64)>,
    peaks: Vec<Peak>,
}

#[derive(Clone)]
struct Peak {
    /// Times the sense: what is sought is the greatest.
    height: f64,
    rows: [Seen; 3],
}

/// The senses of least and greatest.
const SENSES: [f64; 2] = [-1.0, 1.0];

/// Peaks remembered: a lower row may have the higher peak beside it.
const PEAKS: usize = 4;

impl Extremes {
    pub fn new(quantities: usize) -> Self {
        Extremes {
            rows: Vec::new(),
            seen: 0,
            sides: vec![<[Side; 2]>::default(); quantities],
        }
    }

    /// Takes in the next row.
    pub fn take(&mut self, at: &Configuration<f64>, time: f64, values: &[Option<f64>]) {
        match self.rows.len() {
            3 => {
                self.rows.rotate_left(1);
                self.rows[2].at.clone_from(at);
                self.rows[2].time = time;
                self.rows[2].values.copy_from_slice(values);
            }
            _ => self.rows.push(Seen {
                at: at.clone(),
                time,
                values: values.to_vec(),
            }),
        }
        self.seen += 1;
        for (i, sides) in self.sides.iter_mut().enumerate() {
            for (side, sense) in sides.iter_mut().zip(SENSES) {
                if let Some(value) = values[i] {
                    side.reach(sense * value, at, time);
                }
                if let Some([a, b, c]) = heights(&self.rows, i, sense)
                    && (b >= a && b >= c && b > a.min(c) || self.seen == 3 && a > b)
                {
                    side.peak(a.max(b), &self.rows);
                }
            }
        }
    }

    /// The extremes, sought between rows too.
    pub fn located(
        mut self,
        quantities: &[Quantity],
        mechanism: &Mechanism,
        (held, inputs, schedule): (&Held<f64>, &[Driven], Option<&Schedule>),
        meter: &mut Meter,
        time: &dyn Fn(&Configuration<f64>) -> f64,
    ) -> Vec<Extremum> {
        // beside the last row there may be more too, as beside the first
        for (i, sides) in self.sides.iter_mut().enumerate() {
            for (side, sense) in sides.iter_mut().zip(SENSES) {
                if let Some([_, b, c]) = heights(&self.rows, i, sense)
                    && c > b
                {
                    side.peak(c, &self.rows);
                }
            }
        }
        /// Rows are closed to so much of the characteristic length, and no value is known better beside the greatest.
        const ROUNDING: f64 = 1e-12;
        let mut all = Vec::new();
        for (i, (sides, quantity)) in self.sides.into_iter().zip(quantities).enumerate() {
            let rows = sides.iter().filter_map(|side| side.row.as_ref());
            let largest = rows.fold(0.0f64, |most, (height, ..)| most.max(height.abs()));
            let found = std::array::from_fn::<_, 2, _>(|k| {
                let (side, sense) = (&sides[k], SENSES[k]);
                let mut best = side.row.clone()?;
                for peak in &side.peaks {
                    let [first, middle, last] = &peak.rows;
                    let rows = [&first.at, &middle.at, &last.at];
                    let ends = schedule.map(|of| (of.clone(), [first.time, last.time]));
                    let between = Between::new(mechanism, held, inputs, ends, rows);
                    let Some(mut between) = between else {
                        continue;
                    };
                    let mut height = |part: f64| {
                        let when = between.time(part);
                        let at = between.at(part)?;
                        meter.settle(&middle.values);
                        Some(sense * meter.read(at, when.unwrap_or_else(|| time(at)))[i]?)
                    };
                    if let Some((part, height)) = summit(0.0, 1.0, &mut height)
                        && height > best.0
                        && let when = between.time(part)
                        && let Some(at) = between.at(part)
                    {
                        best = (height, at.clone(), when.unwrap_or_else(|| time(at)));
                    }
                }
                Some(Extreme {
                    value: match best.0.abs() > ROUNDING * largest {
                        true => sense * best.0,
                        false => 0.0,
                    },
                    time: (!inputs.is_empty()).then_some(best.2),
                    inputs: inputs
                        .iter()
                        .map(|input| input.coordinate.of(&best.1))
                        .collect(),
                    joints: best.1.joints,
                })
            });
            let [least, greatest] = found;
            all.push(Extremum {
                name: quantity.name.clone(),
                unit: quantity.unit,
                least,
                greatest,
            });
        }
        all
    }
}

/// The values of a quantity at three rows times a sense, if it has all of them.
fn heights(rows: &[Seen], quantity: usize, sense: f64) -> Option<[f64; 3]> {
    let [a, b, c] = rows else { return None };
    let [a, b, c] = [a, b, c].map(|row| row.values[quantity]);
    Some([sense * a?, sense * b?, sense * c?])
}

impl Side {
    fn reach(&mut self, height: f64, at: &Configuration<f64>, time: f64) {
        match &mut self.row {
            Some((most, place, when)) if height > *most => {
                (*most, *when) = (height, time);
                place.clone_from(at);
            }
            Some(_) => {}
            none => *none = Some((height, at.clone(), time)),
        }
    }

    fn peak(&mut self, height: f64, rows: &[Seen]) {
        let [a, b, c] = rows else { return };
        if self.peaks.len() == PEAKS {
            let lowest =
                (0..PEAKS).min_by(|&i, &j| self.peaks[i].height.total_cmp(&self.peaks[j].height));
            match lowest {
                Some(lowest) if self.peaks[lowest].height < height => {
                    self.peaks.swap_remove(lowest);
                }
                _ => return,
            }
        }
        let rows = [a, b, c].map(Clone::clone);
        self.peaks.push(Peak { height, rows });
    }
}
