//! Means of quantities over the time of a motion.

use super::course::{Course, Sought};
use crate::solve::halved;

/// Means over the time of a motion, and the swing of the integral.
#[derive(Clone, Copy, Debug)]
pub(super) struct Means {
    /// The mean value.
    pub mean: f64,
    /// The root of the mean square.
    pub rms: f64,
    /// The largest less the least of ∫ (q − mean) dt, over the part of the time: of a power the energy that a flywheel
    /// stores and gives back, over the duration.
    pub swing: f64,
}

/// Nodes and weights of the Gauss–Legendre rule on −1 to 1 that is exact to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Parts into which each piece of the curve is divided.
const PARTS: usize = 4;

/// The means of a quantity, unless it has no value somewhere, or too much of the curve is no polynomial.
pub(super) fn means(course: &Course, of: &Sought) -> Option<Means> {
    if !course.whole || !course.is_driven() || course.pieces.is_empty() {
        return None;
    }
    let value = |piece: usize, s: f64| course.value(of, piece, s).0;
    // ∫ qⁿ dt from s to t
    let integral = |piece: usize, [from, to]: [f64; 2], power: i32| -> Option<f64> {
        let (middle, radius) = (0.5 * (from + to), 0.5 * (to - from));
        let parts = GAUSS.iter().map(|(node, weight)| {
            let s = middle + radius * node;
            Some(weight * value(piece, s)?.powi(power) * course.time_rate(piece, s) * radius)
        });
        parts.sum()
    };
    let parts = |piece: usize| {
        let ends = move |k: usize| -1.0 + 2.0 * k as f64 / PARTS as f64;
        (0..PARTS).map(move |k| (piece, [ends(k), ends(k + 1)]))
    };
    let (mut sums, mut time, mut lost) = ([0.0; 2], 0.0, 0.0);
    for (piece, span) in (0..course.pieces.len()).flat_map(parts) {
        let long = course.time_at(piece, span[1]) - course.time_at(piece, span[0]);
        time += long;
        let both = [1, 2].map(|power| integral(piece, span, power));
        match both {
            [Some(first), Some(second)] if !course.is_rough(of, piece) => {
                sums[0] += first;
                sums[1] += second;
            }
            _ => lost += long.abs(),
        }
    }
    // a millionth of the time may be lost at kinks
    if !(time > 0.0 && lost <= 1e-6 * time) {
        return None;
    }
    let mean = sums[0] / time;
    let (mut gathered, mut least, mut most) = (0.0, 0.0f64, 0.0f64);
    for (piece, [from, to]) in (0..course.pieces.len()).flat_map(parts) {
        if course.is_rough(of, piece) {
            continue;
        }
        let off = |s: f64| value(piece, s).map(|q| q - mean);
        let to_there = |s: f64| {
            let long = course.time_at(piece, s) - course.time_at(piece, from);
            Some(integral(piece, [from, s], 1)? - mean * long)
        };
        // it turns back where the quantity has its mean
        if let (Some(a), Some(b)) = (off(from), off(to))
            && a * b < 0.0
        {
            let [turn, _] = halved([from, to], |s| off(s).is_some_and(|x| x * a > 0.0));
            let turning = gathered + to_there(turn)?;
            (least, most) = (least.min(turning), most.max(turning));
        }
        gathered += to_there(to)?;
        (least, most) = (least.min(gathered), most.max(gathered));
    }
    Some(Means {
        mean,
        rms: (sums[1] / time).max(0.0).sqrt(),
        swing: most - least,
    })
}
