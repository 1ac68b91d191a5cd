//! Analyses: each one function, one settings struct and one report. They print nothing.
//!
//! A new one is also a method of the question (`ask`), an answer in words (`output`) and a command (`cli`).
//!
//! All are independent of one another but `quantities`, which reads what `velocity`, `singularities` and `statics` make of a
//! configuration over the motions of `sweep`.

pub mod assemblies;
pub mod assembly;
pub mod compare;
pub mod convert;
pub mod design;
pub mod equilibrium;
pub mod formulas;
pub mod frames;
pub mod mobility;
pub mod overview;
pub mod quantities;
pub mod rounding;
pub mod simulation;
pub mod singularities;
pub mod solver;
pub mod statics;
pub mod sweep;
pub mod velocity;
pub mod workspace;
