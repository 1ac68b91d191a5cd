//! Ranges of a motion over which a quantity stays.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;

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

/// A row: the part of the time that is gone, the value of the quantity, the inputs.
pub(crate) type Timed = (f64, Option<f64>, Vec<f64>);

/// The longest run of rows within a band that is twice the tolerance wide, with the parts of the rows beside it that
/// still are, by straight lines between rows. None if no row has a value.
pub(crate) fn dwell(rows: &[Timed], tolerance: f64) -> Option<(f64, [f64; 2], [Vec<f64>; 2])> {
    let width = 2.0 * tolerance;
    let value = |i: usize| rows[i].1.unwrap_or(f64::NAN);
    // indices whose values may still be the least and the greatest
    let (mut least, mut most) = (VecDeque::new(), VecDeque::<usize>::new());
    let mut first = 0;
    let mut best: Option<(f64, [usize; 2], [f64; 2])> = None;
    for last in 0..rows.len() {
        if rows[last].1.is_none() {
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
        let time = rows[last].0 - rows[first].0;
        if best.is_none_or(|(longest, ..)| time > longest) {
            best = Some((time, [first, last], [value(least[0]), value(most[0])]));
        }
    }
    let (_, [first, last], [mut low, mut high]) = best?;
    let mut ends = [first, last].map(|i| (rows[i].0, rows[i].2.clone()));
    let beyond = [
        first.checked_sub(1),
        (last + 1 < rows.len()).then_some(last + 1),
    ];
    for ((end, inside), outside) in ends.iter_mut().zip([first, last]).zip(beyond) {
        let Some(outside) = outside.filter(|i| rows[*i].1.is_some()) else {
            continue;
        };
        let (from, to) = (value(inside), value(outside));
        let wall = if to > from { low + width } else { high - width };
        let part = ((wall - from) / (to - from)).clamp(0.0, 1.0);
        let between = |a: f64, b: f64| a + part * (b - a);
        let inputs = rows[inside].2.iter().zip(&rows[outside].2);
        *end = (
            between(rows[inside].0, rows[outside].0),
            inputs.map(|(a, b)| between(*a, *b)).collect(),
        );
        (low, high) = (low.min(between(from, to)), high.max(between(from, to)));
    }
    let [(begin, from), (end, to)] = ends;
    Some((0.5 * (low + high), [begin, end], [from, to]))
}

#[cfg(test)]
mod tests {
    use super::{Timed, dwell};

    #[test]
    fn a_parabola_dwells_about_its_vertex() {
        let row = |k: i32| -> Timed {
            let time = 0.001 * f64::from(k);
            (time, Some((time - 0.3).powi(2)), vec![2.0 * time])
        };
        let rows: Vec<Timed> = (0..=1000).map(row).collect();
        let (value, times, inputs) = dwell(&rows, 0.005).unwrap();
        // within 0.01 over its vertex: 0.1 to either side, but for the chords between rows
        assert!((value - 0.005).abs() < 1e-6, "{value}");
        assert!(
            (times[0] - 0.2).abs() < 1e-5 && (times[1] - 0.4).abs() < 1e-5,
            "{times:?}"
        );
        assert!((inputs[1][0] - 2.0 * times[1]).abs() < 1e-12);
        assert!(dwell(&[(0.0, None, vec![])], 1.0).is_none());
    }
}
