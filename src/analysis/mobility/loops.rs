//! Kutzbach's count, loop by loop.

use std::collections::{BTreeMap, VecDeque};

use serde::Serialize;

use super::body_name;
use crate::geometry::Vector3;
use crate::linear::Decomposition;
use crate::mechanism::{Body, Configuration, Frame};
use crate::system::{Neighbourhood, Twist, Unknown};

/// Kutzbach's count for one loop.
///
/// M = Σf − λ with λ = 6; and once more with λ the order of the loop's screw system: 3 for a planar
/// or a spherical loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LoopCount {
    /// The closure that completes the loop.
    pub closure: String,
    /// Its bodies in order, from the one the two ways part at.
    pub bodies: Vec<String>,
    /// The joint variables and closures in it.
    pub joints: Vec<String>,
    /// The sum of their freedoms Σf.
    pub freedoms: usize,
    /// The order λ of the screw system that they span at the configuration.
    pub order: usize,
    /// Σf − 6.
    pub kutzbach: i64,
    /// Σf − λ.
    pub by_order: i64,
}

/// Two bodies and the relative motions that a joint between them permits.
struct Edge {
    bodies: [Body; 2],
    joints: Vec<String>,
    /// (ω; v/L) at the origin of ground for each freedom.
    twists: Vec<[f64; 6]>,
    closure: bool,
}

pub(super) fn count(near: &mut Neighbourhood, at: &Configuration<f64>) -> Vec<LoopCount> {
    let mechanism = near.mechanism();
    let mut edges = rows(near, at);
    edges.extend(closures(near, at));
    // the tree takes links first, so that closures are what completes a loop
    let mut parent: BTreeMap<Body, Option<(Body, usize)>> = BTreeMap::from([(Body::Ground, None)]);
    let mut in_tree = vec![false; edges.len()];
    for with_closures in [false, true] {
        let mut queue: VecDeque<Body> = parent.keys().copied().collect();
        while let Some(body) = queue.pop_front() {
            for (e, edge) in edges.iter().enumerate() {
                if edge.closure && !with_closures || in_tree[e] {
                    continue;
                }
                let [a, b] = edge.bodies;
                let other = match body {
                    _ if a == body => b,
                    _ if b == body => a,
                    _ => continue,
                };
                if let std::collections::btree_map::Entry::Vacant(entry) = parent.entry(other) {
                    entry.insert(Some((body, e)));
                    in_tree[e] = true;
                    queue.push_back(other);
                }
            }
        }
    }
    let way = |from: Body| {
        let mut way = vec![(from, None)];
        let mut body = from;
        while let Some(Some((next, edge))) = parent.get(&body) {
            way.push((*next, Some(*edge)));
            body = *next;
        }
        way
    };
    let closing = (0..edges.len()).filter(|&e| edges[e].closure && !in_tree[e]);
    closing
        .map(|e| {
            let [mut left, mut right] = edges[e].bodies.map(way);
            while left.len() > 1 && right.len() > 1 {
                let (a, b) = (left[left.len() - 2].0, right[right.len() - 2].0);
                if a != b {
                    break;
                }
                left.pop();
                right.pop();
            }
            let steps = left.iter().rev().chain(&right);
            let mut members: Vec<usize> = steps.filter_map(|(_, edge)| *edge).collect();
            members.push(e);
            let joints: Vec<String> = (members.iter())
                .flat_map(|&e| edges[e].joints.clone())
                .collect();
            let twists: Vec<f64> = (members.iter())
                .flat_map(|&e| edges[e].twists.iter().flatten().copied())
                .collect();
            let freedoms = twists.len() / 6;
            let order = Decomposition::of(6, freedoms, &twists).rank();
            let names = left.iter().rev().chain(&right[..right.len() - 1]);
            LoopCount {
                closure: edges[e].joints[0].clone(),
                bodies: names.map(|(body, _)| body_name(mechanism, *body)).collect(),
                joints,
                freedoms,
                order,
                kutzbach: freedoms as i64 - 6,
                by_order: freedoms as i64 - order as i64,
            }
        })
        .collect()
}

fn at_ground(twist: &Twist<f64>, point: &Vector3<f64>, length: f64) -> [f64; 6] {
    let velocity = twist.velocity - twist.omega.cross(point);
    let ([a, b, c], [x, y, z]) = (twist.omega.0, velocity.times(1.0 / length).0);
    [a, b, c, x, y, z]
}

/// The rows of the tables in which a joint variable stands.
fn rows(near: &Neighbourhood, at: &Configuration<f64>) -> Vec<Edge> {
    let mechanism = near.mechanism();
    let length = mechanism.characteristic_length();
    let twists = near.frames();
    let mut placement = twists.placement();
    twists.place(at, &mut placement);
    let frames: Vec<Frame> = twists.frames().collect();
    let place = |frame: Frame| frames.iter().position(|f| *f == frame);
    let unknowns = near.system().unknowns();
    let mut edges = Vec::new();
    for (chain, part) in mechanism.chains().iter().enumerate() {
        for (i, row) in part.rows.iter().enumerate() {
            let joints = row.joints();
            let [before, after] = [i, i + 1].map(|row| Frame::Link { chain, row });
            let (Some(b), Some(a), false) = (place(before), place(after), joints.is_empty()) else {
                continue;
            };
            let columns = joints.iter().map(|joint| {
                let mut rates = vec![0.0; unknowns.len()];
                let column = unknowns.iter().position(|u| *u == Unknown::Joint(*joint));
                rates[column.expect("every joint is free")] = 1.0;
                let [a, b] = [a, b].map(|frame| {
                    let twist = twists.twist(frame, &placement, &rates);
                    at_ground(&twist, &twists.origin(frame, &placement), length)
                });
                std::array::from_fn(|k| a[k] - b[k])
            });
            edges.push(Edge {
                bodies: [before, after].map(|frame| mechanism.body(frame)),
                twists: columns.collect(),
                joints: (joints.iter())
                    .map(|&joint| mechanism.joints()[joint].name.clone())
                    .collect(),
                closure: false,
            });
        }
    }
    edges
}

/// The closures, each with the motions it does not resist.
fn closures(near: &mut Neighbourhood, at: &Configuration<f64>) -> Vec<Edge> {
    let mechanism = near.mechanism();
    let length = mechanism.characteristic_length();
    let wrenches = near.closure_wrenches(at);
    let closures = mechanism.closures().iter().zip(wrenches);
    closures
        .map(|(closure, wrenches)| {
            // rows as columns: what is orthogonal to all of them is free
            let columns: Vec<f64> = wrenches.rows.iter().flatten().copied().collect();
            let free = Decomposition::of(6, wrenches.rows.len(), &columns).left_null_space();
            let mut twists: Vec<[f64; 6]> = (free.iter())
                .map(|twist| {
                    let twist = Twist {
                        omega: Vector3([twist[0], twist[1], twist[2]]),
                        velocity: Vector3([twist[3], twist[4], twist[5]]).times(length),
                    };
                    at_ground(&twist, &wrenches.points[1], length)
                })
                .collect();
            let mut joints = vec![closure.name.clone()];
            // a length that a joint drives is one freedom more: that along the rod
            for (symbol, _) in closure.length.iter().flat_map(|length| &length.terms) {
                if let crate::mechanism::Symbol::Joint(joint) = symbol {
                    joints.push(mechanism.joints()[*joint].name.clone());
                    let along = &wrenches.rows[0];
                    let slide = Twist {
                        omega: Vector3::zero(),
                        velocity: Vector3([along[3], along[4], along[5]]).times(length),
                    };
                    twists.push(at_ground(&slide, &wrenches.points[1], length));
                }
            }
            Edge {
                bodies: closure.frames.map(|frame| mechanism.body(frame)),
                joints,
                twists,
                closure: true,
            }
        })
        .collect()
}
