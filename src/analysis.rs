//! What can be asked about a mechanism. No analysis prints, and none uses another.

pub mod assemblies;
