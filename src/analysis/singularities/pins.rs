//! Passive joints locked so that links do not spin about their own axes while loci are followed.

use crate::mechanism::Mechanism;
use crate::system::Unknown;

/// For each idle motion a passive joint that moves in it, none of which is `taken`: with these at
/// rest nothing idle is left. None if some link spins without such a joint.
///
/// `idle` are independent motions over `unknowns`. Elimination with the largest pivot first.
pub(super) fn pins(
    mechanism: &Mechanism,
    unknowns: &[Unknown],
    mut idle: Vec<Vec<f64>>,
    taken: impl Fn(usize) -> bool,
) -> Option<Vec<usize>> {
    /// Joints that move less in an idle motion of unit norm do not tell it.
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
