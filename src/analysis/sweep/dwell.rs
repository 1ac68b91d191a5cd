//! Ranges of a motion over which a quantity stays.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::solve::summit;

/// The longest part of a motion over which a quantity stays within a tolerance of one value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dwell {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// How far it may be from the value, to either side.
    pub tolerance: f64,
    /// The value.
    pub value: f64,
    /// The parts of the time that are gone where it begins and where it ends.
    pub times: [f64; 2],
    /// The inputs where it begins and where it ends, in m or rad.
    pub inputs: [Vec<f64>; 2],
}

/// The time and the value of a quantity at a place of a motion: from 0, its first row, to its last.
type At<'f> = dyn FnMut(f64) -> Option<[f64; 2]> + 'f;

/// A place with the time and the value there, if there is one.
type Sample = (f64, Option<[f64; 2]>);

/// The longest stay within a band that is twice the tolerance wide: the middle of the band, and where the stay begins and
/// ends, both located to rounding. None if there is no value anywhere.
///
/// A window slides over samples so near to one another that a line between two is off by less than a quarter of the
/// tolerance. Its band is then moved as far as the extremes inside allow, to where the stay is longest.
pub(crate) fn dwell(rows: usize, tolerance: f64, at: &mut At) -> Option<(f64, [f64; 2])> {
    let width = 2.0 * tolerance;
    let samples = sampled(rows, 0.25 * tolerance, at);
    let [first, last] = longest(&samples, width)?;
    let value = |i: usize| samples[i].1.map_or(f64::NAN, |[_, value]| value);
    let core = (first + last) / 2;
    // the band holds the core and the extremes inside
    let (mut low, mut high) = (value(core), value(core));
    for sense in [-1.0, 1.0] {
        let inside = (first + 1..last).filter(|&i| {
            let [a, b, c] = [i - 1, i, i + 1].map(|i| sense * value(i));
            b >= a && b >= c
        });
        let peak = inside.max_by(|&i, &j| (sense * value(i)).total_cmp(&(sense * value(j))));
        let Some(peak) = peak else { continue };
        let mut height = |place: f64| Some(sense * at(place)?[1]);
        let top = summit(samples[peak - 1].0, samples[peak + 1].0, &mut height);
        let top = sense * top.map_or(sense * value(peak), |(_, height)| height);
        (low, high) = (low.min(top), high.max(top));
    }
    let (least, most) = ((high - width).min(low), low);
    let mut stay = |from: f64| {
        let ends = ends(&samples, core, [from, from + width], at);
        let [begin, end] = ends.map(|place| at(place).map_or(f64::NAN, |[time, _]| time));
        (end - begin, ends)
    };
    let middle = 0.5 * (least + most);
    let found = summit(least, most, |base| Some(stay(base).0));
    let bases = [least, most, found.map_or(middle, |(base, _)| base), middle];
    let stays = bases.map(&mut stay);
    let longest = (0..4).max_by(|&i, &j| stays[i].0.total_cmp(&stays[j].0))?;
    let (base, (_, ends)) = (bases[longest], stays[longest]);
    // where the values do not fill the band, their middle says more than that of the band
    let inside = samples
        .iter()
        .filter(|of| ends[0] <= of.0 && of.0 <= ends[1]);
    let inside: Vec<_> = inside.filter_map(|of| of.1).collect();
    for [_, value] in ends.into_iter().filter_map(&mut *at).chain(inside) {
        (low, high) = (low.min(value), high.max(value));
    }
    let value = match high - low < width * (1.0 - 1e-9) {
        true => 0.5 * (low + high),
        false => base + tolerance,
    };
    Some((value, ends))
}

/// The rows, and between them so many places that straight lines are off by no more than a limit.
fn sampled(rows: usize, limit: f64, at: &mut At) -> Vec<Sample> {
    fn refine(
        [a, b]: [(f64, [f64; 2]); 2],
        (limit, depth): (f64, u32),
        at: &mut At,
        all: &mut Vec<Sample>,
    ) {
        const DEEPEST: u32 = 12;
        let place = 0.5 * (a.0 + b.0);
        let Some(found) = at(place) else { return };
        let straight = (found[1] - 0.5 * (a.1[1] + b.1[1])).abs() <= limit;
        let deeper = (limit, depth + 1);
        if !straight && depth < DEEPEST {
            refine([a, (place, found)], deeper, at, all);
        }
        all.push((place, Some(found)));
        if !straight && depth < DEEPEST {
            refine([(place, found), b], deeper, at, all);
        }
    }
    let mut all: Vec<Sample> = Vec::new();
    for row in 0..rows {
        let here = (row as f64, at(row as f64));
        if let (Some((place, Some(before))), Some(found)) = (all.last().copied(), here.1) {
            refine([(place, before), (here.0, found)], (limit, 0), at, &mut all);
        }
        all.push(here);
    }
    all
}

/// The first and the last of the samples that are longest within a band of some width.
fn longest(samples: &[Sample], width: f64) -> Option<[usize; 2]> {
    let [time, value] =
        [0, 1].map(|k| move |i: usize| samples[i].1.map_or(f64::NAN, |found| found[k]));
    // indices whose values may still be the least and the greatest
    let (mut least, mut most) = (VecDeque::new(), VecDeque::<usize>::new());
    let mut first = 0;
    let mut best: Option<(f64, [usize; 2])> = None;
    for (last, sample) in samples.iter().enumerate() {
        if sample.1.is_none() {
            least.clear();
            most.clear();
            first = last + 1;
            continue;
        }
        while least.back().is_some_and(|&i| value(i) >= value(last)) {
            least.pop_back();
        }
        while most.back().is_some_and(|&i| value(i) <= value(last)) {
            most.pop_back();
        }
        least.push_back(last);
        most.push_back(last);
        while value(most[0]) - value(least[0]) > width {
            first += 1;
            for known in [&mut least, &mut most] {
                if known.front().is_some_and(|i| *i < first) {
                    known.pop_front();
                }
            }
        }
        let stays = time(last) - time(first);
        if best.is_none_or(|(longest, _)| stays > longest) {
            best = Some((stays, [first, last]));
        }
    }
    best.map(|(_, range)| range)
}

/// Where a band is left, before and after a sample in it.
fn ends(samples: &[Sample], core: usize, [low, high]: [f64; 2], at: &mut At) -> [f64; 2] {
    let slack = 1e-13 * low.abs().max(high.abs());
    let beyond = |value: f64| match value {
        _ if value > high + slack => Some(high),
        _ if value < low - slack => Some(low),
        _ => None,
    };
    [-1, 1].map(|way| {
        let mut inside = core;
        loop {
            let next = inside
                .checked_add_signed(way)
                .filter(|i| *i < samples.len());
            let Some((next, [_, value])) = next.and_then(|i| Some((i, samples[i].1?))) else {
                return samples[inside].0;
            };
            if let Some(wall) = beyond(value) {
                let ends = [samples[inside].0, samples[next].0];
                return crossing(ends, &mut |place| Some(at(place)?[1] - wall));
            }
            inside = next;
        }
    })
}

/// Where a function changes its sign between two places, by false position with halved heights.
///
/// Source: Dowell and Jarratt, A modified regula falsi method (Illinois), 1971.
fn crossing([inside, outside]: [f64; 2], f: &mut dyn FnMut(f64) -> Option<f64>) -> f64 {
    let (mut a, mut b) = (inside, outside);
    let (Some(mut at_a), Some(mut at_b)) = (f(a), f(b)) else {
        return inside;
    };
    if at_a * at_b >= 0.0 {
        return if at_b == 0.0 { outside } else { inside };
    }
    for _ in 0..100 {
        let x = b - at_b * (b - a) / (at_b - at_a);
        let Some(at_x) = f(x) else { return a };
        if at_x == 0.0 || (x - b).abs() <= 4.0 * f64::EPSILON * b.abs() {
            return x;
        }
        match at_x * at_b < 0.0 {
            true => (a, at_a) = (b, at_b),
            false => at_a *= 0.5,
        }
        (b, at_b) = (x, at_x);
    }
    b
}

#[cfg(test)]
mod tests {
    use super::dwell;

    /// Of a function of the time from 0 to 1 at so many rows.
    fn of(rows: usize, tolerance: f64, f: fn(f64) -> f64) -> (f64, [f64; 2]) {
        let time = |place: f64| place / (rows - 1) as f64;
        let found = dwell(rows, tolerance, &mut |place| {
            Some([time(place), f(time(place))])
        });
        let (value, places) = found.unwrap();
        (value, places.map(time))
    }

    #[test]
    fn a_dwell_is_as_long_as_the_quantity_says_however_many_rows_there_are() {
        for rows in [11, 20, 101] {
            // within 0.01 over the vertex of a parabola: 0.1 to either side
            let (value, times) = of(rows, 0.005, |t| (t - 0.3).powi(2));
            assert!((value - 0.005).abs() < 1e-14, "{value}");
            let [begin, end] = times;
            assert!(
                (begin - 0.2).abs() < 1e-12 && (end - 0.4).abs() < 1e-12,
                "{times:?}"
            );
            // about an inflection: 2 x³ = 2 tolerances, as far to either side
            let (value, times) = of(rows, 0.001, |t| (t - 0.45).powi(3));
            assert!(value.abs() < 1e-9, "{value}");
            let [begin, end] = times;
            assert!(
                (begin - 0.35).abs() < 1e-8 && (end - 0.55).abs() < 1e-8,
                "{times:?}"
            );
            // with a maximum and a minimum inside: x³ - 3a²x is q where x = 2a cosh(arcosh(q/2a³)/3)
            let (value, times) = of(rows, 0.00201, |t| (t - 0.5).powi(3) - 0.03 * (t - 0.5));
            let end = 0.2 * (1.005f64.acosh() / 3.0).cosh();
            assert!(value.abs() < 1e-9, "{value}");
            let [before, after] = times.map(|t| t - 0.5);
            assert!(
                (before + end).abs() < 1e-8 && (after - end).abs() < 1e-8,
                "{times:?}"
            );
        }
        // all of it
        let (value, times) = of(5, 2.0, |t| t);
        assert_eq!((value, times), (0.5, [0.0, 1.0]));
        assert!(dwell(3, 1.0, &mut |_| None).is_none());
    }
}
