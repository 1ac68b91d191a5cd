//! The bodies of the tree that correspond to those of an MJCF model, and poses of mjcf-rs.

use crate::geometry::{Pose, Quaternion, Rotation, Vector3};

/// A body and its place in the tree: its first and its last part, if it was split.
pub(super) type Parts = Vec<usize>;

/// A pose of mjcf-rs.
pub(super) fn pose(pose: &mjcf_rs::Pose) -> Pose<f64> {
    let q = pose.rotation;
    let q = Quaternion([q.w, q.x, q.y, q.z]).normalised();
    let t = pose.translation;
    Pose {
        rotation: exact(q.rotation()),
        position: Vector3([t.x, t.y, t.z]),
    }
}

/// Entries that differ from 0, 1 and −1 by rounding made exact, so that planar linkages stay planar.
fn exact(rotation: Rotation<f64>) -> Rotation<f64> {
    let clean = |x: f64| match x.round() {
        whole if (x - whole).abs() < 4.0 * f64::EPSILON => whole + 0.0,
        _ => x,
    };
    let cleaned = Rotation(rotation.0.map(|column| column.map(clean)));
    // all three axes are along coordinates, or one is and the others are turned about it
    let planar = cleaned.0.iter().flat_map(|c| c.0).any(|x| x.abs() == 1.0);
    if planar { cleaned } else { rotation }
}
