//! Reactions: wrenches that closures and joints transmit from body to body.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use crate::geometry::Vector3;
use crate::linear::{Decomposition, RANK_TOLERANCE};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};
use crate::system::{Load, Neighbourhood};

/// The wrench that one body exerts on another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// The closure, or the link after the joint.
    pub name: String,
    /// The joint variables there.
    pub variables: Vec<String>,
    /// The body that exerts it.
    pub from: String,
    /// The body it acts on.
    pub on: String,
    /// The point it acts at.
    pub point: [f64; 3],
    /// Force, in N.
    pub force: [f64; 3],
    /// Moment about the point, in N·m.
    pub moment: [f64; 3],
    /// For each component of force and moment, true if equilibrium determines it.
    pub unique: [bool; 6],
}

/// The reactions of closures, then of joints, for multipliers λ of the closure rows, in N·m.
///
/// A closure exerts Σ λ·row on its second body and the opposite on its first. A joint balances all
/// that acts on the bodies beyond it.
pub(super) fn of(
    near: &mut Neighbourhood,
    at: &Configuration<f64>,
    load: &Load,
    multipliers: &[f64],
) -> Vec<Reaction> {
    let mechanism = near.mechanism();
    let length = mechanism.characteristic_length();
    // force, moment about the centre
    let at_origin = |point: Vector3<f64>, force: Vector3<f64>, moment: Vector3<f64>| {
        [force, moment + point.cross(&force)]
    };
    let mut acting: Vec<(Body, [Vector3<f64>; 2])> = Vec::new();
    for &(point, force, moment) in &load.wrenches {
        let wrench = at_origin(
            mechanism.to_centre(point.at(mechanism, at)),
            Vector3(force),
            Vector3(moment),
        );
        acting.push((mechanism.body(point.frame), wrench));
    }
    let mut reactions = Vec::new();
    let wrenches = near.closure_wrenches(at);
    for (closure, wrenches) in mechanism.closures().iter().zip(wrenches) {
        let (mut force, mut moment) = (Vector3::zero(), Vector3::zero());
        let factors = &multipliers[wrenches.first_row..];
        for (row, &factor) in wrenches.rows.iter().zip(factors) {
            let [a, b, c, x, y, z] = *row;
            moment += Vector3([a, b, c]).times(factor);
            force += Vector3([x, y, z]).times(factor / length);
        }
        let [first, second] = closure.frames.map(|frame| mechanism.body(frame));
        let [start, end] = wrenches.points;
        acting.push((second, at_origin(end, force, moment)));
        acting.push((first, at_origin(start, -force, -moment)));
        reactions.push(Reaction {
            name: closure.name.clone(),
            variables: vec![],
            from: mechanism.body_name(first),
            on: mechanism.body_name(second),
            point: mechanism.to_ground(end).0,
            force: force.0,
            moment: moment.0,
            unique: [true; 6],
        });
    }
    // a joint carries what acts on its link and on all that stands on it
    let mut carried: HashMap<Body, [Vector3<f64>; 2]> = HashMap::new();
    for &(on, wrench) in &acting {
        let mut body = on;
        while let Body::Link { chain, row } = body {
            let [force, moment] = carried.entry(body).or_insert([Vector3::zero(); 2]);
            *force += -wrench[0];
            *moment += -wrench[1];
            body = parent(mechanism, chain, row);
        }
    }
    let links = mechanism
        .bodies()
        .into_iter()
        .filter_map(|body| match body {
            Body::Link { chain, row } => Some((body, chain, row)),
            _ => None,
        });
    let links: Vec<(Body, usize, usize)> = links.collect();
    let frame = |&(_, chain, row): &_| Frame::Link { chain, row };
    let frames: Vec<Frame> = links.iter().map(frame).collect();
    let poses = mechanism.poses_about_centre(&frames, at);
    let joints = links.into_iter().zip(frames).zip(poses);
    reactions.extend(joints.map(|(((body, chain, row), frame), pose)| {
        let point = pose.position;
        let still = [Vector3::zero(); 2];
        let [force, moment] = carried.get(&body).copied().unwrap_or(still);
        let inner = parent(mechanism, chain, row);
        let variables = mechanism.chains()[chain].rows[row - 1].joints();
        Reaction {
            name: mechanism.frame_name(frame),
            variables: (variables.iter())
                .map(|&joint| mechanism.joints()[joint].name.clone())
                .collect(),
            from: mechanism.body_name(inner),
            on: mechanism.body_name(body),
            point: mechanism.to_ground(point).0,
            force: force.0,
            moment: (moment - point.cross(&force)).0,
            unique: [true; 6],
        }
    }));
    reactions
}

/// The body that carries the joint of a row.
fn parent(mechanism: &Mechanism, chain: usize, row: usize) -> Body {
    mechanism.body(Frame::Link {
        chain,
        row: row - 1,
    })
}

/// Multiples of the states of stress that, added, make the sum of squares of all reactions least.
pub(super) fn least(found: &[Reaction], stresses: &[Vec<Reaction>], length: f64) -> Vec<f64> {
    let columns: Vec<f64> = stresses.iter().flat_map(|s| stacked(s, length)).collect();
    let opposite: Vec<f64> = stacked(found, length).map(|x| -x).collect();
    Decomposition::of(opposite.len(), stresses.len(), &columns).solve(&opposite)
}

/// The parts of reactions in a plane: forces along it, times the length, and moments about its normal.
pub(super) fn in_plane(
    reactions: &[Reaction],
    normal: Vector3<f64>,
    length: f64,
) -> impl Iterator<Item = f64> {
    reactions.iter().flat_map(move |reaction| {
        let force = Vector3(reaction.force);
        let along = force - normal.times(normal.dot(&force));
        let moment = normal.dot(&Vector3(reaction.moment));
        (along.times(length).0.into_iter()).chain([moment])
    })
}

fn stacked(reactions: &[Reaction], length: f64) -> impl Iterator<Item = f64> {
    reactions.iter().flat_map(move |reaction| {
        let force = reaction.force.map(|f| f * length);
        force.into_iter().chain(reaction.moment)
    })
}

/// Marks what changes in states of stress without load.
pub(super) fn mark(found: &mut [Reaction], changes: &[Vec<Reaction>], length: f64) {
    for change in changes {
        for (reaction, change) in found.iter_mut().zip(change) {
            for i in 0..3 {
                // a stress of unit norm is one of 1 N·m
                let (force, moment) = (change.force[i] * length, change.moment[i]);
                reaction.unique[i] &= force.abs() <= RANK_TOLERANCE;
                reaction.unique[3 + i] &= moment.abs() <= RANK_TOLERANCE;
            }
        }
    }
}
