//! Assembled configurations: the one near a guess, and all of them.

mod assemblies;
mod bundle;
mod certain;
mod cold_starts;
mod conjugates;
mod endless;
mod far;
mod large;
mod printed_assemblies;
mod proofs;
mod questions;
mod random_counts;
mod random_mechanisms;
mod scales;
mod seeds;
mod special_inputs;
mod stores;
mod straight;
mod traces;
mod witness;
