//! Analyses: each one function, one settings struct and one report. They print nothing and do not
//! use one another.

pub mod assemblies;
pub mod assembly;
pub mod compare;
pub mod convert;
pub mod formulas;
pub mod frames;
pub mod mobility;
pub mod overview;
pub mod singularities;
pub mod solver;
pub mod statics;
pub mod sweep;
pub mod velocity;
pub mod workspace;
