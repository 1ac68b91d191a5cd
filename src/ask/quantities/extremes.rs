//! The least and greatest values of quantities over a motion, and where they have no bound.

use std::cmp::Ordering;

use super::poles::{middle_of_gap, unbounded};
use super::{Block, Meter, Passage, Seen};
use crate::algebra::BATCH;
use crate::analysis::sweep::{Extreme, Extremum, Missing, Pole};
use crate::mechanism::{Configuration, Measured, Order, Quantity};
use crate::number::widest;
use crate::solve::summit;

/// Watches rows and remembers where quantities are least and greatest.
pub(in super::super) struct Extremes {
    /// The last rows, three if there are so many.
    rows: Vec<Seen>,
    seen: usize,
    quantities: Vec<Watched>,
    /// The rows of a block that count.
    kept: Vec<usize>,
}

/// What is remembered of a quantity.
#[derive(Clone)]
struct Watched {
    sides: [Side; 2],
    /// The range of values that all rows allow.
    allowed: [f64; 2],
}

/// Rows where a quantity is greater than at their neighbours, or less: the best of them.
#[derive(Clone, Default)]
struct Side {
    /// The greatest value at a row at all, and where and when it is.
    most: Option<(f64, Configuration<f64>, f64)>,
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

/// Two rows before those of a block, and these.
const WATCHED: usize = BATCH + 2;

impl Extremes {
    pub fn new(quantities: usize) -> Self {
        let none = Watched {
            sides: Default::default(),
            allowed: [f64::NEG_INFINITY, f64::INFINITY],
        };
        Extremes {
            rows: Vec::new(),
            seen: 0,
            quantities: vec![none; quantities],
            kept: Vec::with_capacity(BATCH),
        }
    }

    /// Takes in the next rows, but for those between the ones asked for.
    pub fn take(&mut self, block: &Block) {
        self.kept.clear();
        let kept = (0..block.len()).filter(|&i| !block.row(i).0.between);
        self.kept.extend(kept);
        let kept = &self.kept;
        let before = self.rows.len().min(2);
        let earlier = &self.rows[self.rows.len() - before..];
        let count = before + kept.len();
        let seen = |i: usize| match earlier.get(i) {
            Some(row) => row.clone(),
            None => Seen::of(block, kept[i - before]),
        };
        let quantities = self.quantities.iter_mut().zip(block.columns());
        for (number, (quantity, column)) in quantities.enumerate() {
            let mut values = [f64::NAN; WATCHED];
            let mut noise = [0.0; BATCH];
            for (value, row) in values.iter_mut().zip(earlier) {
                *value = row.values[number].unwrap_or(f64::NAN);
            }
            let latest = &mut values[before..before + BATCH];
            for ((value, noise), &i) in latest.iter_mut().zip(&mut noise).zip(kept) {
                (*value, *noise) = (column.values[i % BATCH], column.noise[i % BATCH]);
            }
            let mut most = [0.0; 4];
            outermost(latest, &noise, &mut most);
            let [least, greatest, low, high] = most;
            let [known_low, known_high] = quantity.allowed;
            quantity.allowed = [larger(low, known_low), -larger(high, -known_high)];
            let sides = quantity.sides.iter_mut().zip(SENSES);
            for ((side, sense), height) in sides.zip([least, greatest]) {
                side.reach(height, sense, latest, |i| seen(before + i));
            }
            let mut bends = self.seen < 3;
            if !bends {
                turns(&values[..count], &mut bends);
            }
            if bends {
                for middle in 1..count.max(1) - 1 {
                    let near = [middle - 1, middle, middle + 1];
                    let first = self.seen + middle + 2 == before + 3;
                    quantity.bend(near.map(|i| values[i]), first, || near.map(seen));
                }
            }
        }
        self.seen += kept.len();
        for &i in &kept[kept.len().saturating_sub(3)..] {
            if self.rows.len() < 3 {
                self.rows.push(Seen::of(block, i));
            } else {
                self.rows.rotate_left(1);
                self.rows[2].put(block, i);
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
                if let Some([_, b, c]) = heights(&self.rows, i, sense)
                    && c > b
                {
                    side.peak(c, None, || [0, 1, 2].map(|k| self.rows[k].clone()));
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
            let row = |k: usize| sides[k].most.as_ref().map(|most| SENSES[k] * most.0);
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
                let mut best = side.most.clone()?;
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

widest! {
    /// The greatest of −x, x, x − δ and −(x + δ) for values x that may be off by δ, a block of them. What is not a number
    /// does not count.
    fn outermost(values: &[f64], noise: &[f64], most: &mut [f64; 4]) runs outermost_in_lanes
}

#[inline(always)]
fn outermost_in_lanes(values: &[f64], noise: &[f64], most: &mut [f64; 4]) {
    const LANES: usize = 8;
    let mut all = [[f64::NEG_INFINITY; LANES]; 4];
    let (values, noise) = (values.as_chunks::<LANES>().0, noise.as_chunks::<LANES>().0);
    for (values, noise) in values.iter().zip(noise) {
        for i in 0..LANES {
            let x = values[i];
            let off = 4.0 * larger(noise[i], f64::EPSILON * x.abs());
            for (most, y) in all.iter_mut().zip([-x, x, x - off, -x - off]) {
                most[i] = larger(y, most[i]);
            }
        }
    }
    *most = all.map(|most| most.into_iter().fold(f64::NEG_INFINITY, larger));
}

/// The larger of two numbers, the second if one is none.
#[inline(always)]
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

widest! {
    /// Whether one of some values is an extreme beside its neighbours, or one is missing.
    fn turns(values: &[f64], found: &mut bool) runs turns_of_each
}

#[inline(always)]
fn turns_of_each(values: &[f64], found: &mut bool) {
    let neighbours = values.iter().zip(&values[1..]).zip(&values[2..]);
    for ((a, b), c) in neighbours {
        let beyond = (b >= a) & (b >= c) | (b <= a) & (b <= c);
        let missing = a.is_nan() | b.is_nan() | c.is_nan();
        *found |= missing | beyond & !((a == b) & (b == c));
    }
}

impl Watched {
    /// Takes in three neighbouring values; `first` says whether there are none before.
    fn bend(&mut self, [a, b, c]: [f64; 3], first: bool, rows: impl Fn() -> [Seen; 3]) {
        if ![a, b, c].iter().any(|x| x.is_nan()) {
            for (side, sense) in self.sides.iter_mut().zip(SENSES) {
                let [a, b, c] = [a, b, c].map(|x| sense * x);
                if b >= a && b >= c && b > a.min(c) || first && a > b {
                    side.peak(a.max(b), None, &rows);
                }
            }
        } else if !b.is_nan() {
            // it may grow towards a row where it is not known
            let side = &mut self.sides[usize::from(b > 0.0)];
            for (beyond, other, gap) in [(a, c, 0.0), (c, a, 1.0)] {
                if beyond.is_nan() && (other.is_nan() || other.abs() < b.abs()) {
                    side.peak(b.abs(), Some(gap), &rows);
                }
            }
        }
    }
}

impl Side {
    /// Takes in values at rows with the greatest of them in this sense.
    fn reach(&mut self, greatest: f64, sense: f64, values: &[f64], row: impl Fn(usize) -> Seen) {
        let most = self.most.as_ref().map_or(f64::NEG_INFINITY, |most| most.0);
        if greatest > most
            && let Some(first) = values.iter().position(|x| sense * x == greatest)
        {
            let Seen { at, time, .. } = row(first);
            self.most = Some((greatest, at, time));
        }
    }

    fn peak(&mut self, height: f64, gap: Option<f64>, rows: impl Fn() -> [Seen; 3]) {
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
        let rows = rows();
        self.peaks.push(Peak { height, rows, gap });
    }
}
