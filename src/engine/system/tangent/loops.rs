//! The loops of a mechanism, and the joints in them.

use super::neighbourhood::Neighbourhood;
use super::twists::Twist;
use crate::geometry::Vector3;
use crate::linear::Decomposition;
use crate::mechanism::{Body, ClosureKind, Configuration, Connector, Frame, Linkage, Symbol};
use crate::system::Unknown;

/// A loop: a closure and the two chains from it to the body where they part.
#[derive(Clone, Debug)]
pub struct MechanismLoop {
    /// Name of the closure that completes it.
    pub closure: String,
    /// Its bodies in order, from the one where its two chains part.
    pub bodies: Vec<Body>,
    /// Joints and closures that connect each body to the next, and the last to the first.
    pub parts: Vec<LoopPart>,
}

/// Two bodies and the relative motions that a joint between them permits.
#[derive(Clone, Debug)]
pub struct LoopPart {
    /// The two bodies; in a chain the one nearer to its base first.
    pub bodies: [Body; 2],
    /// Names of the joint variables, or of the closure and those that drive it.
    pub names: Vec<String>,
    /// The joint variables.
    pub joints: Vec<usize>,
    /// (ω; v/L) at the origin of ground for each freedom.
    pub twists: Vec<[f64; 6]>,
    /// True for a closure.
    pub closure: bool,
}

/// The independent loops at a configuration, one for each closure between bodies that are already connected.
pub fn loops(near: &mut Neighbourhood, at: &Configuration<f64>) -> Vec<MechanismLoop> {
    let mechanism = near.mechanism();
    let linkage = mechanism.linkage();
    let mut parts = rows(near, at, &linkage);
    parts.extend(closures(near, at));
    let loops = linkage.loops().into_iter();
    let with_motions = loops.map(|found| MechanismLoop {
        closure: mechanism.closures()[found.closure].name.clone(),
        bodies: found.bodies,
        parts: found
            .connections
            .iter()
            .map(|&part| parts[part].clone())
            .collect(),
    });
    with_motions.collect()
}
/// The rows that move, with their motions.
fn rows(near: &Neighbourhood, at: &Configuration<f64>, linkage: &Linkage) -> Vec<LoopPart> {
    let mechanism = near.mechanism();
    let length = mechanism.characteristic_length();
    let twists = near.frames();
    let placement = twists.placed(at);
    let places = twists.places();
    let column = |joint: usize| near.system().place_of(Unknown::Joint(joint));
    let mut rates = vec![0.0; near.system().unknowns().len()];
    let mut parts = Vec::new();
    for connection in &linkage.connections {
        let Connector::Row { chain, row } = connection.by else {
            continue;
        };
        // a joint that is locked joins two bodies without a freedom
        let all = mechanism.chains()[chain].rows[row].joints().into_iter();
        let joints: Vec<usize> = all.filter(|&joint| column(joint).is_some()).collect();
        let [b, a] = [row, row + 1].map(|row| places[&Frame::Link { chain, row }]);
        let relative = joints.iter().filter_map(|&joint| {
            let column = column(joint)?;
            rates[column] = 1.0;
            let [a, b] = [a, b].map(|frame| {
                let twist = twists.twist(frame, &placement, &rates);
                twist.at_ground(&twists.origin(frame, &placement), length)
            });
            rates[column] = 0.0;
            Some(std::array::from_fn(|k| a[k] - b[k]))
        });
        let names = joints
            .iter()
            .map(|&joint| mechanism.joints()[joint].name.clone());
        parts.push(LoopPart {
            bodies: connection.bodies,
            twists: relative.collect(),
            names: names.collect(),
            joints,
            closure: false,
        });
    }
    parts
}

/// The closures, each with the motions it does not resist.
fn closures(near: &mut Neighbourhood, at: &Configuration<f64>) -> Vec<LoopPart> {
    let mechanism = near.mechanism();
    let length = mechanism.characteristic_length();
    let wrenches = near.closure_wrenches(at);
    let closures = mechanism.closures().iter().zip(wrenches);
    let closures = closures.filter(|(closure, _)| closure.kind != ClosureKind::Coupling);
    closures
        .map(|(closure, wrenches)| {
            // rows as columns: what is orthogonal to all of them is free
            let rows: Vec<f64> = wrenches.rows.iter().flatten().copied().collect();
            let free = Decomposition::of(6, wrenches.rows.len(), &rows).left_null_space();
            let mut twists: Vec<[f64; 6]> = (free.iter())
                .map(|twist| {
                    let twist = Twist {
                        omega: Vector3([twist[0], twist[1], twist[2]]),
                        velocity: Vector3([twist[3], twist[4], twist[5]]).times(length),
                    };
                    twist.at_ground(&wrenches.points[1], length)
                })
                .collect();
            let (mut names, mut joints) = (vec![closure.name.clone()], vec![]);
            // a length that a joint drives is one freedom more: that along the rod
            for (symbol, _) in closure.length.iter().flat_map(|length| &length.terms) {
                if let Symbol::Joint(joint) = symbol
                    && near.system().place_of(Unknown::Joint(*joint)).is_some()
                {
                    names.push(mechanism.joints()[*joint].name.clone());
                    joints.push(*joint);
                    let along = &wrenches.rows[0];
                    let slide = Twist {
                        omega: Vector3::zero(),
                        velocity: Vector3([along[3], along[4], along[5]]).times(length),
                    };
                    twists.push(slide.at_ground(&wrenches.points[1], length));
                }
            }
            LoopPart {
                bodies: closure.frames.map(|frame| mechanism.body(frame)),
                names,
                joints,
                twists,
                closure: true,
            }
        })
        .collect()
}
