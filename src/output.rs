//! Answers and complaints made visible.

#[cfg(feature = "cli")]
pub mod diagnostics;
