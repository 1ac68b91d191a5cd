//! Whether a solution is one by itself or several that coincide.

use rand_pcg::Pcg64;

use super::coordinates::{C, size};
use super::way::Way;
use crate::solve::Homotopy;

/// The quotient of pivots below which a solution of a generic member counts as one of infinitely
/// many (or of several that always coincide).
const REGULAR: f64 = 1e-7;

/// Newton's last step at a solution that is not multiple: at a multiple one steps only halve.
pub(super) const SETTLED: f64 = 1e-9;

/// How much smaller pivots of solutions far out are beside the largest, without others being near,
/// and how much larger rounding is: as the square of their size.
pub(super) fn steepness(x: &[C]) -> f64 {
    (size(x) / 30.0).max(1.0).powi(2)
}

/// Whether a solution of a generic member is one by itself.
///
/// Rounding leaves the closures of a multiple solution unseen some 1e-7 about it, where the quotient
/// of pivots may be as large. But there Newton's method ends elsewhere from every start.
pub(super) fn is_simple(way: &mut Way<'_>, s: C, x: &[C], rng: &mut Pcg64) -> bool {
    /// A larger quotient leaves no doubt.
    const PLAIN: f64 = 1e-5;
    const DISTANCE: f64 = 1e-6;
    let regularity = way.regularity(s, x);
    let plain = PLAIN / steepness(x);
    if regularity <= REGULAR || regularity > plain {
        return regularity > plain;
    }
    (0..3).all(|_| {
        let mut beside = way.family.shaken(x, DISTANCE, rng);
        for _ in 0..10 {
            if !way.correct(s, &mut beside).is_finite() {
                return false;
            }
        }
        way.family.coordinates.difference(x, &beside) < SETTLED * (1.0 + size(x)) * steepness(x)
    })
}
