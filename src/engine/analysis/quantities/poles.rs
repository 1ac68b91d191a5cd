//! Places where a quantity has no bound.

use crate::number::real;
use crate::solve::halved;

/// Sides towards which a quantity grows without bound, just before a place and just after it: true upwards.
///
/// A power of the distance r⁻ᵖ with p ≥ 1/4 grows by the same factor, 10^(p/2) at least, each time the place is nearer by
/// √10; a bounded value, however high and narrow, stops growing.
pub(super) fn unbounded(
    place: f64,
    value: &mut dyn FnMut(f64) -> Option<f64>,
) -> [Option<bool>; 2] {
    /// Distances from the place are powers of √10 from this one to this one.
    const POWERS: [i32; 2] = [3, 16];
    /// Steps over which it must grow: three decades.
    const WATCHED: usize = 6;
    /// Least growth in a step.
    const FACTOR: f64 = 1.33;
    [-1.0, 1.0].map(|side| {
        let mut at = |power: i32| {
            let x = place + side * real::pow(0.1f64, 0.5 * f64::from(power));
            (0.0..=1.0).contains(&x).then(|| value(x))?
        };
        if let (Some(far), Some(near)) = (at(POWERS[0]), at(POWERS[1]))
            && near.abs() < far.abs() * FACTOR.powi(WATCHED as i32)
        {
            return None;
        }
        // far ones may be off the piece of the curve that the place is on
        let known: Vec<f64> = (POWERS[0]..=POWERS[1]).filter_map(&mut at).collect();
        let last = &known[known.len().checked_sub(WATCHED + 1)?..];
        let grows = last.windows(2).all(|w| w[1] / w[0] >= FACTOR);
        grows.then(|| last[0] > 0.0)
    })
}

/// The place where a value that has this sign at the first of two places changes it, or has none.
pub(super) fn change_of_sign(
    [mut from, mut to]: [f64; 2],
    first: f64,
    value: &mut dyn FnMut(f64) -> Option<f64>,
) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        match value(middle) {
            None => return middle,
            Some(x) if x * first > 0.0 => from = middle,
            Some(_) => to = middle,
        }
    }
    0.5 * (from + to)
}

/// The middle of the places about one without a value that have none either.
pub(super) fn middle_of_gap(gap: f64, value: &mut dyn FnMut(f64) -> Option<f64>) -> f64 {
    let ends = [0.0, 1.0].map(|end| {
        if value(end).is_none() {
            return gap;
        }
        halved([end, gap], |place| value(place).is_some())[1]
    });
    0.5 * (ends[0] + ends[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pole_has_no_bound_and_a_narrow_peak_has_one() {
        let of = |f: fn(f64) -> f64| unbounded(0.4, &mut |x| Some(f(x - 0.4)));
        assert_eq!(of(|x| 1.0 / x), [Some(false), Some(true)]);
        assert_eq!(of(|x| -2.0 / (x * x)), [Some(false), Some(false)]);
        assert_eq!(of(|x| 5.0 + 1.0 / x.abs().sqrt()), [Some(true), Some(true)]);
        assert_eq!(of(|x| 1.0 / (x * x + 1e-10)), [None, None]);
        assert_eq!(of(|x| x.signum()), [None, None]);
        assert_eq!(of(|x| 3.0 - x * x), [None, None]);
        // near an end of what is known
        let near_end = unbounded(1e-3, &mut |x| Some(1.0 / (x - 1e-3)));
        assert_eq!(near_end, [Some(false), Some(true)]);
        // one side only
        let root = unbounded(1.0, &mut |x| Some(-1.0 / (1.0 - x).sqrt()));
        assert_eq!(root, [Some(false), None]);
    }

    #[test]
    fn a_gap_is_halved() {
        let mut value = |x: f64| ((x - 0.3).abs() > 1e-5).then_some(1.0);
        assert!((middle_of_gap(0.300_007, &mut value) - 0.3).abs() < 1e-12);
    }
}
