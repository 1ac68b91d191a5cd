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
    quantities: Vec<Watched>,
}

/// What is remembered of a quantity.
#[derive(Clone)]
struct Watched {
    sides: [Side; 2],
    /// Its values at the two rows before.
    before: [Option<f64>; 2],
    /// The range of values that all rows allow.
    allowed: [f64; 2],
}

/// Rows where a quantity is greater than at their neighbours, or less: the best of them.
#[derive(Clone, Default)]
struct Side {
    /// The greatest value at a row at all.
    most: Option<f64>,
    /// Where it is, and when, once another row has followed.
    place: Option<(Configuration<f64>, f64)>,
    is_latest: bool,
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
            quantities: vec![
                Watched {
                    sides: Default::default(),
                    before: [None; 2],
                    allowed: [f64::NEG_INFINITY, f64::INFINITY],
                };
                quantities
            ],
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
        let latest = values.iter().zip(noise);
        for (quantity, (&value, noise)) in self.quantities.iter_mut().zip(latest) {
            let Watched {
                sides,
                before,
                allowed: [low, high],
            } = quantity;
            let [first, middle] = std::mem::replace(before, [before[1], value]);
            if let Some(value) = value
                && low <= high
            {
                let off = 4.0 * noise.max(f64::EPSILON * value.abs());
                (*low, *high) = (low.max(value - off), high.min(value + off));
            }
            for (side, sense) in sides.iter_mut().zip(SENSES) {
                side.reach(value.map(|value| sense * value), &self.rows);
            }
            if self.seen < 3 {
                continue;
            }
            if let (Some(a), Some(b), Some(c)) = (first, middle, value) {
                // most rows lie between their neighbours
                if self.seen == 3 || (b - a) * (c - b) <= 0.0 {
                    for (side, sense) in sides.iter_mut().zip(SENSES) {
                        let [a, b, c] = [a, b, c].map(|x| sense * x);
                        if b >= a && b >= c && b > a.min(c) || self.seen == 3 && a > b {
                            side.peak(a.max(b), None, &self.rows);
                        }
                    }
                }
            } else if let Some(known) = middle {
                // it may grow towards a row where it is not known
                let grows = |other: Option<f64>| other.is_none_or(|x| x.abs() < known.abs());
                let side = &mut sides[usize::from(known > 0.0)];
                for (beyond, other, gap) in [(first, value, 0.0), (value, first, 1.0)] {
                    if beyond.is_none() && grows(other) {
                        side.peak(known.abs(), Some(gap), &self.rows);
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
        for (i, quantity) in self.quantities.iter_mut().enumerate() {
            for (side, sense) in quantity.sides.iter_mut().zip(SENSES) {
                if let Some(last) = self.rows.last().filter(|_| side.is_latest) {
                    side.keep(last);
                }
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
        for (i, (watched, quantity)) in self.quantities.into_iter().zip(quantities).enumerate() {
            let Watched { sides, allowed, .. } = watched;
            let none = Extremum {
                name: quantity.name.clone(),
                unit: quantity.unit,
                constant: None,
                least: None,
                greatest: None,
                unbounded: Vec::new(),
                missing: None,
            };
            let row = |k: usize| sides[k].most.map(|height| SENSES[k] * height);
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
            let [low, high] = allowed;
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
                let (at, time) = side.place.clone()?;
                let mut best = (side.most?, at, time);
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
    /// Takes in the value at the last of some rows.
    fn reach(&mut self, height: Option<f64>, rows: &[Seen]) {
        if let Some(height) = height
            && self.most.is_none_or(|most| height > most)
        {
            (self.most, self.is_latest) = (Some(height), true);
        } else if let [.., before, _] = rows
            && self.is_latest
        {
            self.keep(before);
        }
    }

    /// Remembers the row of the greatest value.
    fn keep(&mut self, row: &Seen) {
        self.is_latest = false;
        match &mut self.place {
            Some((place, time)) => {
                place.clone_from(&row.at);
                *time = row.time;
            }
            none => *none = Some((row.at.clone(), row.time)),
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
