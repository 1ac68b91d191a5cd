//! Answers and complaints made visible.

#[cfg(feature = "cli")]
pub mod comparison;
#[cfg(feature = "cli")]
pub mod diagnostics;
