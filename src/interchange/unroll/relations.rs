//! Relations between the bodies and joints of a tree before it is unrolled.

use std::collections::HashMap;

use crate::geometry::Pose;
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::tree::{Coupling, Tree};

/// The body that carries each body, and the pose of the body in it: the nearest one that moves.
pub(super) fn carriers(tree: &Tree) -> Vec<(usize, Pose<f64>)> {
    let mut carriers: Vec<(usize, Pose<f64>)> = Vec::with_capacity(tree.bodies.len());
    for (i, body) in tree.bodies.iter().enumerate() {
        carriers.push(match body.parent {
            Some(parent) if body.joints.is_empty() => {
                (carriers[parent].0, carriers[parent].1 * body.pose)
            }
            _ => (i, Pose::identity()),
        });
    }
    carriers
}

/// For each following joint: the first leader, factor and offset.
pub(super) fn leaders(tree: &Tree) -> Result<HashMap<String, Coupling>, ImportProblemKind> {
    let mut direct: HashMap<&str, &Coupling> = HashMap::new();
    for coupling in &tree.couplings {
        if direct.insert(&coupling.joint, coupling).is_some() {
            let joint = coupling.joint.clone();
            return Err(ImportProblemKind::FollowsTwo { joint });
        }
    }
    let mut leaders: HashMap<String, Coupling> = HashMap::new();
    for coupling in &tree.couplings {
        // up to a joint that leads, or whose leader is known
        let (mut way, mut at) = (Vec::new(), &coupling.joint);
        while let (Some(next), false) = (direct.get(at.as_str()), leaders.contains_key(at)) {
            way.push(*next);
            at = &next.leader;
            if way.len() > direct.len() {
                let joint = coupling.joint.clone();
                return Err(ImportProblemKind::FollowsItself { joint });
            }
        }
        for own in way.into_iter().rev() {
            let mut total = own.clone();
            if let Some(next) = leaders.get(&own.leader) {
                total.offset += total.factor * next.offset;
                total.factor *= next.factor;
                total.leader = next.leader.clone();
            }
            leaders.insert(own.joint.clone(), total);
        }
    }
    Ok(leaders)
}

/// Refuses numbers so large that all others would be lost to rounding.
pub(super) fn within_reason(tree: &Tree) -> Result<(), ImportProblemKind> {
    const MOST: f64 = 1e12;
    fn entries(pose: &Pose<f64>) -> impl Iterator<Item = f64> {
        let axes = pose.rotation.0.into_iter().chain([pose.position]);
        axes.flat_map(|axis| axis.0)
    }
    fn check(of: &str, mut numbers: impl Iterator<Item = f64>) -> Result<(), ImportProblemKind> {
        let of = of.to_owned();
        let fit = numbers.all(|x| x.abs() <= MOST);
        fit.then_some(()).ok_or(ImportProblemKind::TooLarge { of })
    }
    let zero = tree.poses(|joint| joint.reference);
    for ((body, zero), home) in tree.bodies.iter().zip(&zero).zip(&tree.home()) {
        let poses = [&body.pose, zero, home];
        check(&body.name, poses.into_iter().flat_map(entries))?;
        for (name, frame) in &body.frames {
            check(name, entries(frame))?;
        }
        for joint in &body.joints {
            let line = joint.point.0.into_iter().chain(joint.axis.0);
            let (low, high) = joint.limits.unwrap_or_default();
            let values = [joint.reference, joint.home, low, high];
            check(&joint.name, line.chain(values))?;
        }
    }
    for coupling in &tree.couplings {
        let line = [coupling.factor, coupling.offset];
        check(&coupling.joint, line.into_iter())?;
    }
    for part in &tree.loops {
        let lengths = part.length.iter().flat_map(|length| {
            let factors = length.terms.iter().map(|(_, factor)| *factor);
            factors.chain([length.constant])
        });
        let sides = part.sides.iter().flat_map(|side| entries(&side.pose));
        check(&part.name, sides.chain(lengths))?;
    }
    Ok(())
}
