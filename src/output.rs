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
pub mod text;

pub use document::{Document, Report};

#[cfg(feature = "cli")]
pub mod assemblies;
#[cfg(feature = "cli")]
pub mod closing;
#[cfg(feature = "cli")]
pub mod comparison;
#[cfg(feature = "cli")]
pub mod conversion;
#[cfg(feature = "cli")]
pub mod diagnostics;
#[cfg(feature = "cli")]
pub mod formulas;
#[cfg(feature = "cli")]
pub mod frames;
#[cfg(feature = "cli")]
pub mod import;
mod layout;
#[cfg(feature = "cli")]
pub mod mobility;
#[cfg(feature = "cli")]
pub mod option;
#[cfg(feature = "cli")]
pub mod overview;
#[cfg(feature = "plot")]
pub mod plot;
mod quantity;
#[cfg(feature = "cli")]
pub mod question;
#[cfg(feature = "cli")]
mod screws;
#[cfg(feature = "cli")]
pub mod singularities;
#[cfg(feature = "cli")]
pub mod solution;
#[cfg(feature = "cli")]
pub mod statics;
#[cfg(feature = "cli")]
pub mod sweep;
#[cfg(feature = "cli")]
pub mod velocity;
#[cfg(feature = "cli")]
pub mod workspace;
