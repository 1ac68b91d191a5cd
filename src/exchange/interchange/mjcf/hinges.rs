//! Points that make a hinge.

use crate::description::ClosureKind;
use crate::interchange::tree::TreeLoop;
use crate::interchange::xml_reader::along_z;

/// Two points of the same two bodies, at the same distance on both, are a hinge.
pub(super) fn hinges(loops: Vec<TreeLoop>) -> Vec<TreeLoop> {
    let mut merged: Vec<TreeLoop> = Vec::new();
    for second in loops {
        let same = |first: &&mut TreeLoop| {
            first.kind == ClosureKind::Spherical
                && second.kind == ClosureKind::Spherical
                && (0..2).all(|side| first.sides[side].body == second.sides[side].body)
        };
        let first = merged.iter_mut().find(same);
        let apart = |first: &TreeLoop| {
            [0, 1].map(|side| second.sides[side].pose.position - first.sides[side].pose.position)
        };
        let Some(first) = first else {
            merged.push(second);
            continue;
        };
        let ways = apart(first);
        let [p, q] = [ways[0].norm(), ways[1].norm()];
        if p < 1e-9 || (p - q).abs() > 1e-9 * p {
            merged.push(second);
            continue;
        }
        first.kind = ClosureKind::Revolute;
        for (side, way) in first.sides.iter_mut().zip(ways) {
            let along = way.times(1.0 / way.norm());
            // a frame that has the axis already stays as it is
            if (side.pose.rotation.0[2] - along).norm() > 1e-12 {
                side.pose.rotation = along_z(&along).rotation;
                side.frame += "_axis";
            }
        }
    }
    merged
}
