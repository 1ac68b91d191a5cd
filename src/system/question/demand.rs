//! Demands made by name, and contradictions between them.

use crate::algebra::words;
use crate::system::Coordinate;

/// A demand on one joint, coordinate or platform, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Demand {
    /// Hold, free or guess.
    pub verb: Verb,
    /// Its name.
    pub name: String,
    /// The value as given; none if it is freed.
    pub value: Option<String>,
}

words! {
    /// Treatment of a joint, coordinate or platform in a question.
    Verb {
        /// Its value is given.
        Hold = "hold",
        /// Its value is to be found.
        Free = "free",
        /// The search starts at a value.
        Guess = "guess",
    }
}

/// Meaning of the name in a demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    /// A joint or a coordinate of a platform.
    Coordinate(Coordinate),
    /// The whole pose of the platform of that index.
    Pose(usize),
}

impl Target {
    /// True if the two are equal, or one is part of the other.
    pub(crate) fn meets(self, other: Target) -> bool {
        match (self, other) {
            (Target::Pose(whole), Target::Coordinate(part))
            | (Target::Coordinate(part), Target::Pose(whole)) => part.platform() == Some(whole),
            _ => self == other,
        }
    }
}

impl Verb {
    /// True if two demands on one target contradict each other.
    pub(crate) fn clashes(self, other: Verb) -> bool {
        match (self, other) {
            (Verb::Free, Verb::Free) => false,
            (Verb::Guess, other) | (other, Verb::Guess) => other == Verb::Guess,
            _ => true,
        }
    }
}
