//! Answers and complaints made visible.

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
#[cfg(feature = "cli")]
mod json;
#[cfg(feature = "cli")]
mod layout;
#[cfg(feature = "cli")]
pub mod mobility;
#[cfg(feature = "cli")]
pub mod option;
#[cfg(feature = "cli")]
pub mod overview;
#[cfg(feature = "plot")]
pub mod plot;
#[cfg(feature = "cli")]
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
