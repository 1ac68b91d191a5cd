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
    let mut leaders = HashMap::new();
    for coupling in &tree.couplings {
        let mut total = coupling.clone();
        let mut steps = 0;
        while let Some(next) = direct.get(total.leader.as_str()) {
            total.offset += total.factor * next.offset;
            total.factor *= next.factor;
            total.leader = next.leader.clone();
            steps += 1;
            if steps > direct.len() {
                let joint = coupling.joint.clone();
                return Err(ImportProblemKind::FollowsItself { joint });
            }
        }
        leaders.insert(coupling.joint.clone(), total);
    }
    Ok(leaders)
}

/// Refuses lengths so large that all others would be lost to rounding.
pub(super) fn within_reason(tree: &Tree) -> Result<(), ImportProblemKind> {
    const MOST: f64 = 1e12;
    let fits = |x: &f64| x.abs() <= MOST;
    let pose = |pose: &Pose<f64>| {
        let axes = pose.rotation.0.iter().flat_map(|axis| &axis.0);
        pose.position.0.iter().chain(axes).all(fits)
    };
    let refuse = |of: &str| Err(ImportProblemKind::TooLarge { of: of.to_owned() });
    let zero = tree.poses(|joint| joint.reference);
    let home = tree.home();
    for (i, body) in tree.bodies.iter().enumerate() {
        if ![&body.pose, &zero[i], &home[i]].into_iter().all(pose) {
            return refuse(&body.name);
        }
        if let Some((name, _)) = body.frames.iter().find(|(_, frame)| !pose(frame)) {
            return refuse(name);
        }
        for joint in &body.joints {
            let point = joint.point.0.iter().chain(&joint.axis.0);
            let limits = joint.limits.map_or([0.0; 2], |(low, high)| [low, high]);
            let values = [joint.reference, joint.home];
            if !point.chain(&values).chain(&limits).all(fits) {
                return refuse(&joint.name);
            }
        }
    }
    for coupling in &tree.couplings {
        if ![coupling.factor, coupling.offset].iter().all(fits) {
            return refuse(&coupling.joint);
        }
    }
    for part in &tree.loops {
        let lengths = part.length.iter().flat_map(|length| {
            let factors = length.terms.iter().map(|(_, factor)| *factor);
            factors.chain([length.constant])
        });
        if !part.sides.iter().all(|side| pose(&side.pose)) || !lengths.into_iter().all(|x| fits(&x))
        {
            return refuse(&part.name);
        }
    }
    Ok(())
}
