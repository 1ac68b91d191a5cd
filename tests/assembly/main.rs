//! Assembled configurations: the one near a guess, and all of them.

mod assemblies;
mod cold_starts;
mod conjugates;
mod large;
mod printed_assemblies;
mod questions;
mod random_mechanisms;
mod seeds;
mod special_inputs;
mod stores;
mod witness;
