//! Generic solutions as they are stored between runs.

use serde::{Deserialize, Serialize};

use super::coordinates::C;
use super::family::Member;
use super::stances::{Stance, count};

/// All solutions of a generic member, kept to be carried to any inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GenericSolutions {
    /// Names of the mechanism and its joints, values of its parameters and what is held: the
    /// solutions serve no other question.
    pub(super) question: String,
    pub(super) parameters: Vec<[f64; 2]>,
    pub(super) inputs: Vec<[f64; 2]>,
    pub(super) stances: Vec<Stance<[f64; 2]>>,
    /// Freedom left when the inputs are held: the least dimension of a set of solutions that was
    /// met, 0 if there was none. There may be isolated solutions beside it.
    pub freedom: usize,
    /// Newton seeds tried.
    pub seeds: usize,
    /// Seeds that met a set of solutions which is not isolated.
    pub not_isolated: usize,
    /// Monodromy loops, each followed by every solution known.
    pub loops: usize,
    /// Seeds since the last discovery.
    pub quiet_seeds: usize,
    /// Loops since the last discovery in which no path was lost.
    pub quiet_loops: usize,
    /// Whether the search ended at its limits and not because nothing more was found.
    pub exhausted: bool,
    /// The random seed.
    pub seed: u64,
}

pub(super) fn pairs(x: &[C]) -> Vec<[f64; 2]> {
    x.iter().map(|z| [z.re, z.im]).collect()
}

fn numbers(x: &[[f64; 2]]) -> Vec<C> {
    x.iter().map(|z| C::new(z[0], z[1])).collect()
}

impl GenericSolutions {
    /// From what [`GenericSolutions::to_text`] wrote.
    ///
    /// # Errors
    /// If it is something else.
    pub fn from_text(text: &str) -> Result<Self, StoredError> {
        let stored: Self = ron::from_str(text).map_err(|e| StoredError(e.to_string()))?;
        let numbers = (stored.stances.iter().flat_map(Stance::numbers))
            .chain(&stored.parameters)
            .chain(&stored.inputs);
        let finite = numbers.flatten().all(|x| x.is_finite());
        match finite {
            true => Ok(stored),
            false => Err(StoredError("numbers are missing".into())),
        }
    }

    /// All digits, as RON.
    pub fn to_text(&self) -> String {
        ron::to_string(self).expect("lists of numbers have a RON form")
    }

    /// How many isolated complex solutions a generic member has.
    pub fn count(&self) -> usize {
        count(&self.stances)
    }

    pub(super) fn stances(&self) -> Vec<Stance<C>> {
        let number = |z: [f64; 2]| C::new(z[0], z[1]);
        self.stances.iter().map(|s| s.map(number)).collect()
    }

    pub(super) fn member(&self) -> Member {
        Member {
            parameters: numbers(&self.parameters),
            inputs: numbers(&self.inputs),
        }
    }
}

/// What is wrong with stored solutions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredError(String);

impl std::fmt::Display for StoredError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for StoredError {}
