//! The least and greatest values of quantities over a motion, and where they have no bound.

use std::cmp::Ordering;

use super::poles::{middle_of_gap, unbounded};
use super::{Meter, Passage, Seen};
use crate::analysis::sweep::{Extreme, Extremum, Missing, Pole};
use crate::mechanism::{Configuration, Measured, Order, Quantity};
use crate::solve::summit;

/// Watches rows and remembers where quantities are least and greatest.
pub(in super::super) struct Extremes {
    rows: Vec<Seen>,
    seen: usize,
    sides: Vec<[Side; 2]>,
    /// Of each quantity the range of values that all rows allow.
    allowed: Vec<[f64; 2]>,
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
    /// The part of the way where the first or the last row has no value.
    gap: Option<f64>,
}

/// The senses of least and greatest.
const SENSES: [f64; 2] = [-1.0, 1.0];

/// Peaks remembered: a lower row may have the higher peak beside it.
const PEAKS: usize = 8;

impl Extremes {
    pub fn new(quantities: usize) -> Self {
        Extremes {
            rows: Vec::new(),
            seen: 0,
            sides: vec![<[Side; 2]>::default(); quantities],
            allowed: vec![[f64::NEG_INFINITY, f64::INFINITY]; quantities],
        }
    }

    /// Takes in the next row, with how far its values may be off.
    pub fn take(
        &mut self,
        at: &Configuration<f64>,
        time: f64,
        values: &[Option<f64>],
        noise: &[f64],
    ) {
        match self.rows.len() {
            3 => {
                // the oldest gives way
                self.rows.swap(0, 1);
                self.rows.swap(1, 2);
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
            if let Some(value) = values[i] {
                let [low, high] = &mut self.allowed[i];
                if low <= high {
                    let off = 4.0 * noise[i].max(f64::EPSILON * value.abs());
                    (*low, *high) = (low.max(value - off), high.min(value + off));
                }
                for (side, sense) in sides.iter_mut().zip(SENSES) {
                    side.reach(sense * value, at, time);
                }
            }
            let [a, b, c] = &self.rows[..] else { continue };
            let known = [a, b, c].map(|row| row.values[i]);
            if let [Some(a), Some(b), Some(c)] = known {
                // most rows lie between their neighbours
                if self.seen == 3 || (b - a) * (c - b) <= 0.0 {
                    for (side, sense) in sides.iter_mut().zip(SENSES) {
                        let [a, b, c] = [a, b, c].map(|x| sense * x);
                        if b >= a && b >= c && b > a.min(c) || self.seen == 3 && a > b {
                            side.peak(a.max(b), None, &self.rows);
                        }
                    }
                }
            } else if let Some(value) = known[1] {
                // it may grow towards a row where it is not known
                let grows = |row: &Seen| row.values[i].is_none_or(|x| x.abs() < value.abs());
                let side = &mut sides[usize::from(value > 0.0)];
                for (beyond, other, gap) in [(a, c, 0.0), (c, a, 1.0)] {
                    if beyond.values[i].is_none() && grows(other) {
                        side.peak(value.abs(), Some(gap), &self.rows);
                    }
                }
            }
        }
    }

    /// The extremes, sought between rows too.
    pub fn located(
        mut self,
        quantities: &[Quantity],
        passage: Passage,
        meter: &mut Meter,
    ) -> Vec<Extremum> {
        // beside the last row there may be more too, as beside the first
        for (i, sides) in self.sides.iter_mut().enumerate() {
            for (side, sense) in sides.iter_mut().zip(SENSES) {
                if let Some([_, b, c]) = heights(&self.rows, i, sense)
                    && c > b
                {
                    side.peak(c, None, &self.rows);
                }
            }
        }
        /// Rows are closed to so much of the characteristic length, and no value is known better beside the greatest.
        const ROUNDING: f64 = 1e-12;
        let mut all = Vec::new();
        for (i, (sides, quantity)) in self.sides.into_iter().zip(quantities).enumerate() {
            let none = Extremum {
                name: quantity.name.clone(),
                unit: quantity.unit,
                constant: None,
                least: None,
                greatest: None,
                unbounded: Vec::new(),
                missing: None,
            };
            let row = |k: usize| sides[k].row.as_ref().map(|(height, ..)| SENSES[k] * height);
            let (Some(least), Some(greatest)) = (row(0), row(1)) else {
                all.push(Extremum {
                    missing: Some(missing(quantity)),
                    ..none
                });
                continue;
            };
            let largest = least.abs().max(greatest.abs());
            let known = |value: f64| match value.abs() > ROUNDING * largest {
                true => value,
                false => 0.0,
            };
            // one value is within what rounding leaves open at every row
            let [low, high] = self.allowed[i];
            if self.seen > 1 && low <= high && high.is_finite() {
                let zero = low <= 0.0 && high >= 0.0;
                all.push(Extremum {
                    constant: Some(if zero { 0.0 } else { 0.5 * (low + high) }),
                    ..none
                });
                continue;
            }
            let mut poles: Vec<Pole> = Vec::new();
            let [least, greatest] = std::array::from_fn::<_, 2, _>(|k| {
                let (side, sense) = (&sides[k], SENSES[k]);
                let mut best = side.row.clone()?;
                for peak in &side.peaks {
                    let rows = &peak.rows;
                    let Some(mut between) = passage.between(rows.each_ref()) else {
                        continue;
                    };
                    // the value at a part of the way, with how far it may be off
                    let mut read = |part: f64| {
                        let (at, when) = passage.at(&mut between, part)?;
                        meter.settle(&rows[1].values);
                        let value = meter.read(at, when)[i];
                        Some((value, meter.noise()[i]))
                    };
                    let mut gap = None;
                    let found = match peak.gap {
                        Some(_) => None,
                        None => summit(0.0, 1.0, |part| {
                            let (value, _) = read(part)?;
                            if value.is_none() {
                                gap = Some(part);
                            }
                            Some(sense * value?)
                        }),
                    };
                    let place = match (peak.gap, found, gap) {
                        (Some(gap), ..) => gap,
                        (None, Some((part, _)), _) => part,
                        (None, None, Some(gap)) => {
                            middle_of_gap(gap, &mut |part| read(part).and_then(|(value, _)| value))
                        }
                        (None, None, None) => continue,
                    };
                    let sides = unbounded(place, &mut |part| {
                        let (value, noise) = read(part)?;
                        // what is nothing but rounding grows where it is divided by little
                        value.map(|x| if x.abs() > 4.0 * noise { x } else { 0.0 })
                    });
                    let Some((at, when)) = passage.at(&mut between, place) else {
                        continue;
                    };
                    if sides.iter().any(Option::is_some) {
                        let pole = Pole {
                            time: (!passage.inputs.is_empty()).then_some(when),
                            inputs: passage.inputs(at),
                            joints: at.joints.clone(),
                            upwards: sides,
                        };
                        merge(&mut poles, pole);
                    } else if let Some((_, height)) = found
                        && height > best.0
                    {
                        best = (height, at.clone(), when);
                    }
                }
                Some(Extreme {
                    value: known(sense * best.0),
                    time: (!passage.inputs.is_empty()).then_some(best.2),
                    inputs: passage.inputs(&best.1),
                    joints: best.1.joints,
                })
            });
            poles.sort_by(|a, b| a.time.partial_cmp(&b.time).unwrap_or(Ordering::Equal));
            let bounded = |upwards: bool| {
                let mut sides = poles.iter().flat_map(|pole| pole.upwards);
                !sides.any(|side| side == Some(upwards))
            };
            all.push(Extremum {
                least: least.filter(|_| bounded(false)),
                greatest: greatest.filter(|_| bounded(true)),
                unbounded: poles,
                ..none
            });
        }
        all
    }
}

/// Why a quantity has no value at any row.
fn missing(quantity: &Quantity) -> Missing {
    if (quantity.measured()).any(|of| matches!(of, Measured::Transmission(_))) {
        return Missing::PlanarLoop;
    }
    let still = |of: &Measured| match of {
        Measured::Parameter(_) => true,
        Measured::Joint(_, order) | Measured::Place(_, _, order) => *order == Order::Value,
        _ => false,
    };
    match quantity.measured().all(still) {
        true => Missing::Expression,
        false => Missing::Rates,
    }
}

/// Adds a pole to others; each is seen from either side, and in either sense.
fn merge(poles: &mut Vec<Pole>, pole: Pole) {
    /// In m and rad.
    const SAME: f64 = 1e-6;
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME);
    let same =
        |known: &&mut Pole| near(&known.inputs, &pole.inputs) && near(&known.joints, &pole.joints);
    match poles.iter_mut().find(same) {
        Some(known) => {
            for (known, side) in known.upwards.iter_mut().zip(pole.upwards) {
                *known = known.or(side);
            }
        }
        None => poles.push(pole),
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

    fn peak(&mut self, height: f64, gap: Option<f64>, rows: &[Seen]) {
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
        self.peaks.push(Peak { height, rows, gap });
    }
}
