//! Places of all bodies with other angles of balls.

use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::system::{Coordinate, Held, Neighbourhood};

/// A configuration with every combination of the sets of angles that balls have and the same input,
/// where the joints held stand as they do in it.
///
/// Where a joint stands still so that a link does not spin, the other set of a ball has turned it by
/// half a turn. It is turned back in steps, and the link spins with it.
pub(super) fn sets_of_angles(
    mechanism: &Mechanism,
    (held, input): (&Held<f64>, Coordinate),
    at: &Configuration<f64>,
) -> Vec<Configuration<f64>> {
    const STEPS: usize = 16;
    const REACH: f64 = 1.0;
    let mut near = Neighbourhood::holding(mechanism, held);
    let sets = mechanism.sets_of_angles(at).into_iter();
    let sets = sets.filter(|set| input.of(set) == input.of(at));
    let back = sets.filter_map(|mut set| {
        let joints = held.joints.iter().zip(&set.joints).zip(&at.joints);
        let turned: Vec<(usize, f64)> = (joints.enumerate())
            .filter(|(_, ((held, from), to))| **held && from != to)
            .map(|(joint, ((_, from), to))| (joint, turn_near(to - from, 0.0)))
            .collect();
        if turned.is_empty() {
            return Some(set);
        }
        for _ in 0..STEPS {
            for (joint, angle) in &turned {
                set.joints[*joint] += angle / STEPS as f64;
            }
            set = near.settle(set, REACH)?;
        }
        turned
            .iter()
            .for_each(|&(joint, _)| set.joints[joint] = at.joints[joint]);
        Some(set)
    });
    back.collect()
}
