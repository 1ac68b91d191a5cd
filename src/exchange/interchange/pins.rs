//! Points that a file joins although they lie beside each other on the pin of a plane linkage.

use super::remark::Remark;
use super::tree::{BodyMotion, Tree};
use crate::description::ClosureKind;
use crate::number::tolerance::SAME;

/// Brings points onto one pin where all joints of their loop move parallel to a plane and the points lie apart across it: what
/// no motion changes is how the links lie on the pin, not a gap between them. A distance beyond a part of the loop's size is
/// one.
pub(super) fn on_one_pin(tree: &mut Tree) -> Option<Remark> {
    /// Axes that are turned less against each other are parallel; sine of the angle.
    const PARALLEL: f64 = 1e-4;
    let poses = tree.home();
    let way = |body: usize| {
        let up = std::iter::successors(Some(body), |&body| tree.bodies[body].parent);
        up.collect::<Vec<usize>>()
    };
    let mut moved = Vec::new();
    for (number, part) in tree.loops.iter().enumerate() {
        let ways = part.sides.each_ref().map(|side| way(side.body));
        let ways = &ways;
        let only = |own: usize| {
            let own_way = ways[own].iter().copied();
            own_way.filter(move |body| !ways[1 - own].contains(body))
        };
        let around: Vec<usize> = only(0).chain(only(1)).collect();
        let joints = around.iter().flat_map(|&body| {
            let joints = tree.bodies[body].joints.iter();
            joints.map(move |joint| (body, joint))
        });
        let hinge = joints
            .clone()
            .find(|(_, joint)| joint.motion == BodyMotion::Turn);
        let pinned = matches!(part.kind, ClosureKind::Spherical | ClosureKind::Revolute);
        let Some((body, hinge)) = hinge.filter(|_| pinned) else {
            continue;
        };
        let normal = poses[body].rotation * hinge.axis;
        let is_plane = joints.clone().all(|(body, joint)| {
            let axis = poses[body].rotation * joint.axis;
            match joint.motion {
                BodyMotion::Turn => axis.cross(&normal).norm() < PARALLEL,
                BodyMotion::Slide => axis.dot(&normal).abs() < PARALLEL,
                BodyMotion::Ball | BodyMotion::Free => false,
            }
        });
        let ends = part
            .sides
            .each_ref()
            .map(|side| poses[side.body] * side.pose);
        let across = (ends[1].position - ends[0].position).dot(&normal);
        let size = joints.fold(0.0, |most: f64, (body, joint)| {
            most.max((poses[body] * joint.point - ends[0].position).norm())
        });
        if is_plane && across.abs() > SAME * size && across.abs() <= 0.1 * size {
            let body = part.sides[1].body;
            let shift = poses[body].rotation.inverse_rotate(&normal.times(across));
            moved.push((number, shift));
        }
    }
    let most = moved
        .iter()
        .map(|(_, shift)| shift.norm())
        .reduce(f64::max)?;
    let mut names = Vec::new();
    for (number, shift) in moved {
        let part = &mut tree.loops[number];
        let side = &mut part.sides[1];
        side.pose.position = side.pose.position - shift;
        side.frame += "_pin";
        names.push(part.name.clone());
    }
    Some(Remark::Beside { names, most })
}
