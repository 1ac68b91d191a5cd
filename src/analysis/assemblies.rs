//! Every assembled configuration for held inputs, each with a certificate.
//!
//! The mechanism's inputs are made complex and generic; there all solutions are found once
//! ([`GenericSolutions`]) and then carried, as many paths as solutions, to any inputs that are asked
//! for ([`AssemblySolver::at`]).

mod carry;
mod coordinates;
mod family;
mod generic;
mod threads;

pub use generic::GenericSolutions;

use crate::mechanism::Mechanism;
use crate::system::Held;

/// How hard to search.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblySettings {
    /// The random seed. It decides the way to the answer, not the answer.
    pub seed: u64,
    /// Seeds that must meet only known solutions before the search ends.
    pub quiet_seeds: usize,
    /// Loops in a row that must bring nothing new before the search ends.
    pub quiet_loops: usize,
    /// Seeds after which a search that found nothing gives up.
    pub hopeless_seeds: usize,
    /// Seeds never exceeded.
    pub most_seeds: usize,
    /// Loops never exceeded.
    pub most_loops: usize,
}

impl Default for AssemblySettings {
    fn default() -> Self {
        AssemblySettings {
            seed: 1,
            quiet_seeds: 150,
            quiet_loops: 6,
            hopeless_seeds: 600,
            most_seeds: 5000,
            most_loops: 200,
        }
    }
}

/// Temporary
pub fn search(
    mechanism: &Mechanism,
    held: &Held<f64>,
    settings: &AssemblySettings,
) -> Option<GenericSolutions> {
    let family = family::Family::new(mechanism, held);
    generic::search(&family, String::new(), settings)
}
