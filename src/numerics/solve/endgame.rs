//! Endgame: the limit of a path as s → 1, at a singularity or at infinity.
//!
//! Near s = 1 a solution is a series in (1 − s)^{1/w}. Going w times round s = 1 on a circle closes it; the mean over
//! the circle is the value at the centre (Morgan, Sommese and Wampler 1991, the Cauchy endgame). Negative powers, or
//! an angle that gains whole turns on the circle (a logarithm), mean that the end is at infinity.

use std::f64::consts::TAU;

use super::homotopy::{Arrival, Homotopy, Stages, Tracker};
use crate::number::{C, real};

/// A homotopy whose coordinates may be angles.
pub trait Turning: Homotopy {
    /// The largest difference of two points, angles modulo a turn, and true if turns were dropped.
    fn apart(&self, x: &[C], y: &[C]) -> (f64, bool);
    /// True if a point is so far out that it counts as infinite.
    fn is_far(&self, x: &[C]) -> bool;
}

/// Limit of a solution as s → 1.
#[derive(Clone, Debug, PartialEq)]
pub enum PathEnd {
    /// To a finite point, shared by `winding` solutions that exchange places round it.
    Finite {
        /// The point.
        x: Vec<C>,
        /// Winding number: turns of s until the solution returns.
        winding: usize,
    },
    /// Out of all bounds.
    Infinite,
    /// It could not be decided.
    Undecided {
        /// The nearest point that was reached.
        x: Vec<C>,
    },
}

/// Points sampled on one turn of the circle.
const SAMPLES: usize = 8;
/// The most turns waited for.
const MOST_TURNS: usize = 8;
/// Circles in a row on which it must grow; as another meeting point inside looks the same, until all of one is far out.
const IN_A_ROW: usize = 3;
/// Circles gone round at most.
const CIRCLES: usize = 12;

/// Ratio of the radii of one circle and the next.
const SHRINK: f64 = 6.0;

/// Follows the solution round s = 1 on ever smaller circles, from a point `x` at s = 1 − `radius`.
pub fn path_end<H: Turning>(
    h: &mut H,
    tracker: &Tracker,
    x: &[C],
    mut radius: f64,
    stages: &mut Stages<'_>,
) -> PathEnd {
    // where on the circle, in parts of a turn
    let (mut at, mut phase) = (x.to_vec(), 0);
    let mut before: Option<(Vec<C>, f64)> = None;
    let (mut growing, mut outwards) = (0, false);
    for _ in 0..CIRCLES {
        let round = circle(h, tracker, &at, (radius, phase), stages);
        if let Some((samples, turned)) = &round {
            let turned = *turned;
            let winding = samples.len() / SAMPLES;
            let mean = coefficient(samples, winding, 0);
            let scale = 1.0 + norm(&mean);
            let negative = (1..=3).map(|k| norm(&coefficient(samples, winding, k)));
            let negative = negative.fold(0.0, f64::max);
            if let Some((previous, was)) = &before {
                // a term with a negative power is seen from a thousandth of the solution on
                let grows = turned || (negative > 1e-3 * scale && negative > 1.05 * was);
                growing = if grows { growing + 1 } else { 0 };
                let gap: Vec<C> = mean.iter().zip(previous).map(|(a, b)| a - b).collect();
                let logarithmic = turned && grows_as_logarithm(&gap, winding);
                outwards |= growing + usize::from(logarithmic) >= IN_A_ROW;
                if outwards && samples.iter().all(|x| h.is_far(x)) {
                    return PathEnd::Infinite;
                }
                // far out a tracker may stand still in rounding, as at a finite end
                let is_end = !outwards || h.residual(place(0.0, 0), &mean) < 1e-6 * scale * scale;
                if !turned && negative < 1e-7 * scale && norm(&gap) < 1e-8 * scale && is_end {
                    return PathEnd::Finite { x: mean, winding };
                }
            }
            before = Some((mean, negative));
        }
        // where another meeting point is in the way, from elsewhere on the circle
        let smaller = radius / SHRINK;
        let inwards = [0, 2, 6, 4].into_iter().find_map(|part| {
            let from = match (&round, part) {
                (_, 0) => &at,
                (Some((samples, _)), _) => &samples[part],
                (None, _) => return None,
            };
            let mut x = from.clone();
            let way = (place(radius, phase + part), place(smaller, phase + part));
            let track = tracker.track(h, way, &mut x, stages);
            (track.arrival == Arrival::There).then_some((x, phase + part))
        });
        let Some(inwards) = inwards else { break };
        (at, phase) = inwards;
        radius = smaller;
    }
    match outwards {
        true => PathEnd::Infinite,
        false => PathEnd::Undecided { x: at },
    }
}

/// A point of the circle round s = 1, after so many parts of a turn.
fn place(radius: f64, part: usize) -> C {
    let phi = TAU * part as f64 / SAMPLES as f64;
    C::new(1.0 - radius * real::cos(phi), -radius * real::sin(phi))
}

/// True if an angle goes to infinity as k/w times i ln(1 − s), beside terms that vanish with 1 − s: its
/// mean moves by just that from circle to circle.
fn grows_as_logarithm(gap: &[C], winding: usize) -> bool {
    let most = gap.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
    let times = most * winding as f64 / real::ln(SHRINK);
    times > 0.5 && (times - times.round()).abs() < 1e-3
}

/// Samples on the circle until the solution returns, and true if angles gained turns.
fn circle<H: Turning>(
    h: &mut H,
    tracker: &Tracker,
    start: &[C],
    (radius, phase): (f64, usize),
    stages: &mut Stages<'_>,
) -> Option<(Vec<Vec<C>>, bool)> {
    let mut samples = Vec::new();
    let place = |k: usize| place(radius, phase + k);
    let mut x = start.to_vec();
    settle(h, place(0), &mut x);
    let start = x.clone();
    for _ in 0..MOST_TURNS {
        for k in 0..SAMPLES {
            samples.push(x.clone());
            let way = (place(k), place((k + 1) % SAMPLES));
            if tracker.track(h, way, &mut x, stages).arrival != Arrival::There {
                return None;
            }
            settle(h, way.1, &mut x);
        }
        let (apart, turned) = h.apart(&x, &start);
        // solutions on the circle are at least some root of the radius apart
        if apart < 1e-7 * (1.0 + norm(&start)) {
            return Some((samples, turned));
        }
    }
    None
}

/// Newton steps to the last digits: the mean over the circle is as good as its samples.
fn settle<H: Turning>(h: &mut H, s: C, x: &mut [C]) {
    const STEPS: usize = 3;
    let mut to = x.to_vec();
    for _ in 0..STEPS {
        let step = h.correct(s, &mut to);
        // a tracked point is near enough for that; what goes further has left its path
        if !step.is_finite() || step > 1e-4 {
            return;
        }
        x.copy_from_slice(&to);
        if step < 1e-14 * (1.0 + norm(x)) {
            return;
        }
    }
}

/// The term of power −k/w, times its size on the circle.
fn coefficient(samples: &[Vec<C>], winding: usize, k: usize) -> Vec<C> {
    let mut sum = vec![C::new(0.0, 0.0); samples[0].len()];
    for (j, sample) in samples.iter().enumerate() {
        let phi = TAU * (j * k) as f64 / (SAMPLES * winding) as f64;
        let factor = C::new(real::cos(phi), real::sin(phi)) / samples.len() as f64;
        for (sum, x) in sum.iter_mut().zip(sample) {
            *sum += factor * x;
        }
    }
    sum
}

fn norm(x: &[C]) -> f64 {
    x.iter().map(|z| z.norm_sqr()).fold(0.0, f64::max).sqrt()
}
