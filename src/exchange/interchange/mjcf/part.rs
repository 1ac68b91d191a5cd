//! The bodies of the tree that correspond to those of an MJCF model, and poses of mjcf-rs.

use crate::geometry::{Pose, Vector3};
use crate::interchange::xml_reader::turned;

/// A body and its place in the tree: its first and its last part, if it was split.
pub(super) type BodyParts = Vec<usize>;

pub(super) fn pose(pose: &mjcf_rs::Pose) -> Pose<f64> {
    let (q, t) = (pose.rotation, pose.translation);
    Pose {
        rotation: turned([q.w, q.x, q.y, q.z]),
        position: Vector3([t.x, t.y, t.z]),
    }
}
