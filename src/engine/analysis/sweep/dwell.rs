//! Ranges of a motion over which a quantity stays.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::number::sorting::sort_by;
use crate::number::tolerance::{ROUNDING, SUMMED};
use crate::solve::summit;

/// The longest part of a motion over which a quantity stays within a tolerance of one value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Dwell {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// Largest deviation from the value, to either side.
    pub tolerance: f64,
    /// The value.
    pub value: f64,
    /// The parts of the time that are gone where it begins and where it ends.
    pub times: [f64; 2],
    /// The inputs where it begins and where it ends, in m or rad.
    pub inputs: [Vec<f64>; 2],
    /// True if there may be a longer one, since not all of the curve could be examined.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub at_least: bool,
}

/// The time and the value of a quantity at a place of a motion.
type ValueAt<'f> = dyn FnMut(f64) -> Option<[f64; 2]> + 'f;

/// A place with the time and the value there, if there is one.
pub(crate) type Sample = (f64, Option<[f64; 2]>);

/// The longest stay within a band that is twice the tolerance wide: the middle of the band, and where the stay begins and
/// ends, both located to rounding. None if there is no value anywhere.
///
/// Samples are to be so near to one another that a line between two is off by far less than the tolerance, or leaves any
/// band. A window slides over them; the band of each that may be the longest is then moved as far as the extremes inside
/// allow, to where the stay is longest.
pub(crate) fn dwell(
    samples: &[Sample],
    tolerance: f64,
    at: &mut ValueAt,
) -> Option<(f64, [f64; 2])> {
    let width = 2.0 * tolerance;
    let stays = windows(samples, width);
    let stays = stays
        .into_iter()
        .map(|window| stay(samples, window, tolerance, at));
    let longest = stays.max_by(|a, b| a.0.total_cmp(&b.0));
    longest.map(|(_, value, ends)| (value, ends))
}

/// The longest stay about a window of samples that is within a band: how long it is, the middle of its band, and its ends.
fn stay(
    samples: &[Sample],
    [first, last]: [usize; 2],
    tolerance: f64,
    at: &mut ValueAt,
) -> (f64, f64, [f64; 2]) {
    /// Bands tried, before the best of them is moved on.
    const BANDS: u32 = 32;
    let width = 2.0 * tolerance;
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
        let ends = ends(samples, core, [from, from + width], at);
        let [begin, end] = ends.map(|place| at(place).map_or(f64::NAN, |[time, _]| time));
        (end - begin, ends)
    };
    let mut bases: Vec<f64> = (0..=BANDS)
        .map(|k| least + (most - least) * f64::from(k) / f64::from(BANDS))
        .collect();
    let mut stays: Vec<_> = bases.iter().map(|base| stay(*base)).collect();
    let longest = |stays: &[(f64, [f64; 2])]| {
        (0..stays.len()).max_by(|&i, &j| stays[i].0.total_cmp(&stays[j].0))
    };
    let rough = longest(&stays).unwrap_or(0);
    let near = [rough.saturating_sub(1), (rough + 1).min(bases.len() - 1)].map(|k| bases[k]);
    if let Some((base, _)) = summit(near[0], near[1], |base| Some(stay(base).0)) {
        bases.push(base);
        stays.push(stay(base));
    }
    let longest = longest(&stays).unwrap_or(0);
    let (base, (length, ends)) = (bases[longest], stays[longest]);
    // where the values do not fill the band, their middle says more than that of the band
    let inside = samples
        .iter()
        .filter(|of| ends[0] <= of.0 && of.0 <= ends[1]);
    let inside: Vec<_> = inside.filter_map(|of| of.1).collect();
    for [_, value] in ends.into_iter().filter_map(&mut *at).chain(inside) {
        (low, high) = (low.min(value), high.max(value));
    }
    let value = match high - low < width * (1.0 - ROUNDING) {
        true => 0.5 * (low + high),
        false => base + tolerance,
    };
    (length, value, ends)
}

/// The windows of samples within a band of some width that may be the longest: from the first to the last of each. A
/// stay may reach from a window to the samples beside it.
fn windows(samples: &[Sample], width: f64) -> Vec<[usize; 2]> {
    /// Windows compared at most: those of a periodic motion are equal.
    const MOST: usize = 8;
    let [time, value] =
        [0, 1].map(|k| move |i: usize| samples[i].1.map_or(f64::NAN, |found| found[k]));
    // indices whose values may still be the least and the greatest
    let (mut least, mut most) = (VecDeque::new(), VecDeque::<usize>::new());
    let mut first = 0;
    let mut all: Vec<[usize; 2]> = Vec::new();
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
        match all.last_mut() {
            Some(known) if known[0] == first => known[1] = last,
            _ => all.push([first, last]),
        }
    }
    let length = |[first, last]: [usize; 2]| time(last) - time(first);
    let reach = |[first, last]: [usize; 2]| {
        let beside = [
            first.checked_sub(1),
            Some(last + 1).filter(|i| *i < samples.len()),
        ];
        let [begin, end] = [(beside[0], first), (beside[1], last)]
            .map(|(beside, own)| beside.filter(|i| samples[*i].1.is_some()).unwrap_or(own));
        time(end) - time(begin)
    };
    let longest = all.iter().map(|of| length(*of)).fold(0.0, f64::max);
    all.retain(|of| reach(*of) >= longest);
    sort_by(&mut all, |a, b| length(*b).total_cmp(&length(*a)));
    all.truncate(MOST);
    all
}

/// Places at which a band is left, before and after a sample in it.
fn ends(samples: &[Sample], core: usize, [low, high]: [f64; 2], at: &mut ValueAt) -> [f64; 2] {
    let slack = SUMMED * low.abs().max(high.abs());
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

/// Place at which a function changes its sign between two others, by false position with halved heights.
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

    /// Of a function of the time from 0 to 1 with so many samples.
    fn of(count: usize, tolerance: f64, f: fn(f64) -> f64) -> (f64, [f64; 2]) {
        let at = |place: f64| Some([place, f(place)]);
        let places = (0..count).map(|i| i as f64 / (count - 1) as f64);
        let samples: Vec<_> = places.map(|place| (place, at(place))).collect();
        dwell(&samples, tolerance, &mut |place| at(place)).unwrap()
    }

    #[test]
    fn a_dwell_is_as_long_as_the_quantity_says_however_many_samples_there_are() {
        for rows in [80, 101, 1000] {
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
        assert!(dwell(&[(0.0, None), (1.0, None)], 1.0, &mut |_| None).is_none());
    }
}
