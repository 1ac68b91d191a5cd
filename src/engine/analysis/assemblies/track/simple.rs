//! Distinguishing simple and multiple solutions in double precision.

use super::homotopy::ParameterHomotopy;
use crate::analysis::assemblies::family::{C, size};
use crate::solve::Homotopy;

/// An error of a closure relative to its row of J: some tens of roundings.
const NOISE: f64 = 5e-15;

/// True if a solution is simple: one Newton step returns to it from a point to which an error of rounding in the
/// closures moves it. Towards a multiple solution it goes at most half the distance; in a positive-dimensional
/// set it stays.
pub(crate) fn stands_alone(homotopy: &mut ParameterHomotopy<'_>, s: C, x: &[C]) -> bool {
    const TRIES: usize = 3;
    // pivots of no larger quotient leave no doubt
    if homotopy.regularity(s, x) > 1e-4 {
        return true;
    }
    (0..TRIES).all(|k| {
        let Some(beside) = homotopy.jolted(s, x, NOISE, k) else {
            return false;
        };
        let coordinates = &homotopy.family.coordinates;
        let gone = coordinates.difference(x, &beside);
        let mut back = beside;
        homotopy.correct(s, &mut back).is_finite() && coordinates.difference(x, &back) <= 0.3 * gone
    })
}

/// Largest distance of another approximation of a solution; multiplied by J they differ by no more than 4 times the noise.
pub(crate) fn near(x: &[C]) -> f64 {
    1e-4 * (1.0 + size(x))
}

/// True if two points, the first of which is a simple solution, are one solution.
pub(crate) fn are_one(homotopy: &mut ParameterHomotopy<'_>, s: C, x: &[C], y: &[C]) -> bool {
    homotopy.family.coordinates.within(near(x), x, y) && homotopy.seen_apart(s, x, y) <= 4.0 * NOISE
}
