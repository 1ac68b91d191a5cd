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

#[cfg(test)]
mod tests {
    use crate::description::Description;
    use crate::mechanism::Mechanism;
    use crate::system::{Question, QuestionError};

    fn mechanism() -> Mechanism {
        let text = r#"Mechanism(version: 1, name: "x", convention: Modified,
            joints: { "q": Actuated(), "p": Passive() },
            chains: { "c": Chain(rows: [(theta: "q"), (d: "p")]) },
            platforms: { "top": Platform(), "low": Platform() },
            closures: { "k": Spherical("c", "top"), "l": Rigid("top", "low") })"#;
        Mechanism::new(&Description::read(text).unwrap()).unwrap()
    }

    #[test]
    fn demands_that_contradict_one_another_are_refused() {
        let mechanism = mechanism();
        let question = || Question::new(&mechanism);
        let refused = |result: Result<Question, QuestionError>| match result {
            Err(QuestionError::Contradiction { first, second }) => format!("{first} {second}"),
            other => panic!("{other:?}"),
        };
        let held = || question().hold("q", "1").unwrap();
        assert_eq!(refused(held().hold("q", "2")), "`hold q=1` `hold q=2`");
        assert_eq!(refused(held().free("q")), "`hold q=1` `free q`");
        let freed = question().free("q").unwrap();
        assert_eq!(refused(freed.hold("q", "1")), "`free q` `hold q=1`");
        let guessed = question().guess("p", "1").unwrap();
        assert_eq!(refused(guessed.guess("p", "1")), "`guess p=1` `guess p=1`");
        let posed = || question().hold("top", "home").unwrap();
        assert_eq!(
            refused(posed().hold("top.z", "1")),
            "`hold top=home` `hold top.z=1`"
        );
        let part = question().hold("top.z", "1").unwrap();
        assert_eq!(
            refused(part.hold("top", "home")),
            "`hold top.z=1` `hold top=home`"
        );
    }

    #[test]
    fn demands_of_different_things_are_not() {
        let mechanism = mechanism();
        let question = Question::new(&mechanism);
        let asked = question
            .free("actuated")
            .and_then(|q| q.hold("q", "1"))
            .and_then(|q| q.guess("q", "1"))
            .and_then(|q| q.guess("p", "1"))
            .and_then(|q| q.hold("top.x", "1"))
            .and_then(|q| q.hold("top.y", "1"))
            .and_then(|q| q.hold("low", "home"));
        assert!(asked.is_ok(), "{asked:?}");
    }
}
