//! URDF, the format of ROS.

mod loops;
mod read;
mod write;

pub(super) use loops::along_z;
pub(super) use read::{direction, read};
pub use write::write;
