//! Demands made by name, and which of them contradict one another.

use crate::algebra::words;
use crate::system::Coordinate;

/// A demand on one joint, coordinate or platform, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Demand {
    /// What to do with it.
    pub verb: Verb,
    /// Its name.
    pub name: String,
    /// The value as given; none for what is freed.
    pub value: Option<String>,
}

words! {
    /// What a question does with a joint, coordinate or platform.
    Verb {
        /// Its value is given.
        Hold = "hold",
        /// Its value is to be found.
        Free = "free",
        /// The search starts at a value.
        Guess = "guess",
    }
}

/// What the name in a demand stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    /// A joint or a coordinate of a platform.
    Coordinate(Coordinate),
    /// The whole pose of the platform of that index.
    Pose(usize),
}

impl Target {
    /// Whether both are the same, or one is part of the other.
    pub(crate) fn meets(self, other: Target) -> bool {
        match (self, other) {
            (Target::Pose(whole), Target::Coordinate(part))
            | (Target::Coordinate(part), Target::Pose(whole)) => part.platform() == Some(whole),
            _ => self == other,
        }
    }
}

impl Verb {
    /// Whether two demands of one target cannot both be meant.
    pub(crate) fn clashes(self, other: Verb) -> bool {
        match (self, other) {
            (Verb::Free, Verb::Free) => false,
            (Verb::Guess, other) | (other, Verb::Guess) => other == Verb::Guess,
            _ => true,
        }
    }
}
