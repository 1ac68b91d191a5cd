//! Files of other programs: URDF, MJCF and SDF, read as descriptions and written from mechanisms.
//!
//! The formats describe trees of bodies; they differ in how they close loops. The [`Tree`] is the intermediate
//! form: writing goes mechanism → tree → text, reading text → tree → description.

mod import;
mod masses;
mod mechanism_tree;
mod mjcf;
mod names;
mod pins;
mod problem;
mod remark;
mod rods;
mod sdf;
mod tree;
mod unroll;
mod urdf;
mod xml_reader;
mod xml_writer;

pub use import::{ImportError, ImportSettings, Imported, import, load, load_beside};
pub use mechanism_tree::tree_of;
pub use mjcf::{NotRead, write as write_mjcf};
pub use problem::{ImportProblem, ImportProblemKind, WrongFile};
pub use remark::Remark;
pub use sdf::write as write_sdf;
pub use tree::{
    Attachment, Bend, BodyMotion, Coupling, Extent, Tree, TreeBody, TreeJoint, TreeLoop,
};
pub use urdf::write as write_urdf;
