//! Answers and complaints made visible.
//!
//! A report becomes a [`Document`], and a document becomes [`text`], [`markdown`] or [`html`]; the
//! report itself becomes [`json`], and rows that come one by one become [`csv`]. A new format is one
//! file beside these, a new analysis one file that implements [`Report`].

pub mod csv;
pub mod document;
pub mod html;
pub mod json;
pub mod markdown;
mod report;
pub mod text;

pub use document::Document;
pub use json::{AnyReport, JsonReport};
pub use report::{Remarks, Report, Rows};

pub mod assemblies;
pub mod assembly_remarks;
pub mod canvas;
pub mod comparison;
pub mod complaint;
pub mod conversion;
mod coordinates;
pub mod design;
#[cfg(feature = "cli")]
pub mod diagnostics;
pub mod drawing;
pub mod equilibrium;
pub mod formulas;
pub mod frames;
pub mod glb;
pub mod mobility;
pub mod overview;
pub mod plot;
pub mod quantity;
pub mod rounding;
#[cfg(feature = "schema")]
pub mod schema;
mod screws;
pub mod simulation;
pub mod singularities;
pub mod solution;
pub mod solver;
pub mod statics;
pub mod study;
pub mod sweep;
pub mod velocity;
#[cfg(feature = "cli")]
pub mod workspace;
