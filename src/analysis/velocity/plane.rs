//! The plane in which twists move.

use crate::geometry::Vector3;
use crate::linear::norm;
use crate::number::tolerance::ROUNDING;
pub(super) use crate::number::tolerance::ROUNDING as ZERO;

/// The two halves of a twist.
pub(super) fn split(twist: &[f64; 6]) -> (Vector3<f64>, Vector3<f64>) {
    let [a, b, c, x, y, z] = *twist;
    (Vector3([a, b, c]), Vector3([x, y, z]))
}

/// The unit normal of the plane in which all twists (ω; v/L) move; `None` if there is none.
pub(super) fn normal<'a>(
    twists: impl Iterator<Item = &'a [f64; 6]> + Clone,
) -> Option<Vector3<f64>> {
    let largest = twists.clone().map(|twist| norm(twist)).fold(0.0, f64::max);
    let turning = twists.clone().map(|twist| split(twist).0);
    let most = turning.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    if most.norm() <= ROUNDING * largest {
        return None;
    }
    let normal = most.times(1.0 / most.norm());
    let in_plane = |twist: &[f64; 6]| {
        let (omega, velocity) = split(twist);
        let across = omega.cross(&normal).norm();
        across.max(velocity.dot(&normal).abs()) <= ROUNDING * largest
    };
    let mut twists = twists;
    twists.all(in_plane).then_some(normal)
}
