//! Poses of all bodies with other joint angles of ball joints.

use super::{Held, Neighbourhood, Still};
use crate::mechanism::{Configuration, Mechanism, turn_near};

/// The configuration, then those with every other combination of the two sets of angles of ball joints written as three
/// rows, held coordinates unchanged.
///
/// If a joint of a ball is fixed to stop a local spin, the other set has turned it by half a turn. It is turned back in
/// steps, and the link spins with it.
pub fn sets_of_angles(
    mechanism: &Mechanism,
    (held, still): (&Held<f64>, &[Still]),
    at: &Configuration<f64>,
) -> Vec<Configuration<f64>> {
    const STEPS: usize = 16;
    let sets = mechanism.sets_of_angles(at);
    if sets.len() == 1 {
        return sets;
    }
    let mut near = Neighbourhood::holding(mechanism, held);
    let stands = |joint: usize| still.iter().any(|still| still.joint() == Some(joint));
    let back = sets.into_iter().filter_map(|mut set| {
        let changed = (0..at.joints.len()).filter(|&joint| set.joints[joint] != at.joints[joint]);
        let held: Vec<usize> = changed.filter(|&joint| held.joints[joint]).collect();
        if held.is_empty() {
            return Some(set);
        }
        if !held.iter().all(|&joint| stands(joint)) {
            return None;
        }
        let part = |joint: &usize| {
            let angle = turn_near(at.joints[*joint] - set.joints[*joint], 0.0);
            (*joint, angle / STEPS as f64)
        };
        let parts: Vec<(usize, f64)> = held.iter().map(part).collect();
        for _ in 0..STEPS {
            for (joint, angle) in &parts {
                set.joints[*joint] += angle;
            }
            set = near.settle(set, 1.0)?;
        }
        for joint in held {
            set.joints[joint] = at.joints[joint];
        }
        Some(set)
    });
    back.collect()
}
