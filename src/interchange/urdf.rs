//! URDF, the format of ROS.

mod loops;
mod motion;
mod read;
mod write;

pub(super) use loops::along_z;
pub(super) use motion::direction;
pub(super) use read::read;
pub use write::write;
