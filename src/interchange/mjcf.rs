//! MJCF, the format of MuJoCo.

mod write;
mod xml;

pub use write::write;
