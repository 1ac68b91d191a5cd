//! Files of other programs: URDF and MJCF, read as descriptions and written from mechanisms.
//!
//! Both formats know trees of bodies; they differ in what they say about loops. In between stands the [`Tree`].

mod cut;
mod mjcf;
mod remark;
mod tree;
mod urdf;

pub use cut::tree_of;
pub use mjcf::write as write_mjcf;
pub use remark::Remark;
pub use tree::{Attachment, Body, Coupling, Extent, Joint, Loop, Motion, Tree};
pub use urdf::write as write_urdf;
