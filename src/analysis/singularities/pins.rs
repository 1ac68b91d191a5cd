//! Passive joints locked so that no link spins about its own axis while loci are followed.

use crate::mechanism::Mechanism;
use crate::system::Unknown;

/// A passive joint, not `taken`, for each local freedom: with these held none is left. `None` if some
/// link spins without such a joint. `idle` are independent motions over `unknowns`.
///
/// Gaussian elimination with full pivoting.
pub(super) fn pins(
    mechanism: &Mechanism,
    unknowns: &[Unknown],
    mut idle: Vec<Vec<f64>>,
    taken: impl Fn(usize) -> bool,
) -> Option<Vec<usize>> {
    /// Joints that move less in a local freedom of unit norm do not fix it.
    const LEAST: f64 = 1e-3;
    let joints = unknowns.iter().enumerate();
    let joints = joints.filter_map(|(column, unknown)| match *unknown {
        Unknown::Joint(joint) if !taken(joint) => Some((column, joint)),
        _ => None,
    });
    let joints: Vec<(usize, usize)> = joints
        .filter(|(_, joint)| mechanism.joints()[*joint].role == crate::mechanism::Role::Passive)
        .collect();
    let mut pins = Vec::new();
    for done in 0..idle.len() {
        let places = (done..idle.len()).flat_map(|row| joints.iter().map(move |j| (row, *j)));
        let (row, (column, joint)) = places.reduce(|best, place| {
            let size = |(row, (column, _)): (usize, (usize, usize))| idle[row][column].abs();
            // of equal ones the first, whatever rounding says
            if size(place) > size(best) * (1.0 + 1e-9) {
                place
            } else {
                best
            }
        })?;
        if idle[row][column].abs() < LEAST {
            return None;
        }
        idle.swap(done, row);
        let (before, rest) = idle.split_at_mut(done + 1);
        let pivot = &before[done];
        for other in rest {
            let factor = other[column] / pivot[column];
            let both = other.iter_mut().zip(pivot);
            both.for_each(|(x, p)| *x -= factor * p);
        }
        pins.push(joint);
    }
    pins.sort_unstable();
    Some(pins)
}
