//! The class of a 4-bar.

use super::{Circuit, FourBarClass};
use crate::description::ClosureKind;
use crate::mechanism::{Frame, JointKind, Mechanism};

/// The class of a planar 4-bar whose two joints on ground are joint variables.
pub(super) fn class(mechanism: &Mechanism, circuits: &[Circuit]) -> Option<FourBarClass> {
    let [closure] = mechanism.closures() else {
        return None;
    };
    let joints = mechanism.joints();
    let limits = joints.iter().any(|joint| joint.limits.is_some());
    let revolute = joints.iter().all(|joint| joint.kind == JointKind::Revolute);
    if closure.kind != ClosureKind::Revolute || joints.len() != 3 || !revolute || limits {
        return None;
    }
    let home = mechanism.home();
    let axes = mechanism
        .frames()
        .into_iter()
        .map(|frame| mechanism.transform(Frame::Ground, frame, &home).rotation.0[2]);
    let axes: Vec<_> = axes.collect();
    let planar = axes.iter().all(|axis| axis.cross(&axes[0]).norm() < 1e-9);
    let chains = mechanism
        .chains()
        .iter()
        .zip(&mechanism.dimensions().chains);
    let grounded: Vec<usize> = chains
        .filter(|(_, of)| of.on == Frame::Ground)
        .filter_map(|(_, of)| of.rows.first()?.turn.0.first().map(|(joint, _)| *joint))
        .collect();
    if !planar || grounded.len() != 2 || circuits.iter().any(|c| !c.whole) || circuits.is_empty() {
        return None;
    }
    // ground and three links; with one more, a joint variable moves two of them
    match mechanism.bodies().len() {
        4 => {}
        5 => return Some(FourBarClass::GearedFiveBar),
        _ => return None,
    }
    if circuits.iter().any(|circuit| !circuit.crossings.is_empty()) {
        return Some(FourBarClass::ChangePoint);
    }
    let turns = |joint: usize| circuits[0].joints.get(joint).is_some_and(|j| j.turns != 0);
    Some(
        match (
            grounded.iter().filter(|&&joint| turns(joint)).count(),
            circuits.len(),
        ) {
            (2, 2) => FourBarClass::DoubleCrank,
            (1, 2) => FourBarClass::CrankRocker,
            (0, 2) => FourBarClass::DoubleRocker,
            (0, 1) => FourBarClass::TripleRocker,
            // nothing a 4-bar does: a circuit was not found
            _ => return None,
        },
    )
}
