//! MJCF, the format of MuJoCo.

mod constraints;
mod include;
mod read;
mod write;

pub(crate) use include::{Files, splice};
pub(crate) use read::read;
pub use write::write;
