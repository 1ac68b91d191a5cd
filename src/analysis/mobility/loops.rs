//! Kutzbach's count, loop by loop.

use serde::Serialize;

use crate::linear::Decomposition;
use crate::mechanism::Configuration;
use crate::system::{Neighbourhood, loops};

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
    /// The joint variables and closures in it, in order.
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

pub(super) fn count(near: &mut Neighbourhood, at: &Configuration<f64>) -> Vec<LoopCount> {
    let mechanism = near.mechanism();
    let loops = loops(near, at).into_iter();
    loops
        .map(|found| {
            let parts = found.parts.iter();
            let twists: Vec<f64> = (parts.clone())
                .flat_map(|part| part.twists.iter().flatten().copied())
                .collect();
            let freedoms = twists.len() / 6;
            let order = Decomposition::of(6, freedoms, &twists).rank();
            let bodies = found.bodies.iter();
            LoopCount {
                closure: found.closure,
                bodies: bodies.map(|&body| mechanism.body_name(body)).collect(),
                joints: parts.flat_map(|part| part.names.clone()).collect(),
                freedoms,
                order,
                kutzbach: freedoms as i64 - 6,
                by_order: freedoms as i64 - order as i64,
            }
        })
        .collect()
}
