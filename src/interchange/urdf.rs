//! URDF, the format of ROS.

mod write;

pub use write::write;
