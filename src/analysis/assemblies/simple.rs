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

/// Whether a solution of a generic member is one by itself.
///
/// Rounding leaves the closures of a multiple solution unseen some 1e-7 about it, where the quotient
/// of pivots may be as large. But there Newton's method ends elsewhere from every start.
pub(super) fn is_simple(way: &mut Way<'_>, s: C, x: &[C], rng: &mut Pcg64) -> bool {
    /// A larger quotient leaves no doubt.
    const PLAIN: f64 = 1e-5;
    const DISTANCE: f64 = 1e-6;
    let regularity = way.regularity(s, x);
    if regularity <= REGULAR || regularity > PLAIN {
        return regularity > PLAIN;
    }
    (0..3).all(|_| {
        let mut beside = way.family.shaken(x, DISTANCE, rng);
        for _ in 0..10 {
            if !way.correct(s, &mut beside).is_finite() {
                return false;
            }
        }
        way.family.coordinates.difference(x, &beside) < SETTLED * (1.0 + size(x))
    })
}
