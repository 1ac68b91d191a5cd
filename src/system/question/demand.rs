//! Demands made by name, and which of them contradict one another.

use super::{Question, QuestionError, actuated};
use crate::algebra::words;
use crate::description::nearest;
use crate::mechanism::{PoseCoordinate, Value};
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

impl Question<'_> {
    /// The coordinates that a name stands for: one, the six of a platform, or all actuated joints for
    /// `actuated`.
    ///
    /// # Errors
    /// If there is no such joint or coordinate.
    pub fn coordinates(&self, name: &str) -> Result<Vec<Coordinate>, QuestionError> {
        if name == "actuated" && self.mechanism.joint(name).is_none() {
            return Ok(actuated(self.mechanism));
        }
        Ok(match self.target(name)? {
            Target::Coordinate(coordinate) => vec![coordinate],
            Target::Pose(platform) => PoseCoordinate::ALL
                .map(|c| Coordinate::Pose(platform, c))
                .to_vec(),
        })
    }

    /// The joint or platform coordinate of that name, and the value of an expression for it, in m
    /// or rad.
    ///
    /// # Errors
    /// If there is no such joint or coordinate, or the expression has no value.
    pub fn value(
        &self,
        name: &str,
        value: impl Into<Value>,
    ) -> Result<(Coordinate, f64), QuestionError> {
        let Target::Coordinate(coordinate) = self.target(name)? else {
            return Err(QuestionError::NotAJoint { name: name.into() });
        };
        Ok((coordinate, self.number(name, &value.into(), coordinate)?))
    }

    /// What a name stands for, unless something else was demanded of it before.
    pub(super) fn demand(
        &mut self,
        verb: Verb,
        name: &str,
        value: Option<&Value>,
    ) -> Result<Target, QuestionError> {
        let target = self.target(name)?;
        let second = Demand {
            verb,
            name: name.into(),
            value: value.map(Value::to_string),
        };
        let mut demands = self.demands.iter();
        let clash = demands.find(|(of, first)| of.meets(target) && first.verb.clashes(verb));
        if let Some((_, first)) = clash {
            let first = first.clone();
            return Err(QuestionError::Contradiction { first, second });
        }
        self.demands.push((target, second));
        Ok(target)
    }

    pub(super) fn number(
        &self,
        name: &str,
        value: &Value,
        of: Coordinate,
    ) -> Result<f64, QuestionError> {
        if value.is_home() {
            return Ok(of.home(self.mechanism));
        }
        let number = value.coordinate(self.mechanism, of.measure(self.mechanism));
        number.map_err(|error| QuestionError::value(name, value, error))
    }

    fn target(&self, name: &str) -> Result<Target, QuestionError> {
        if let Some(joint) = self.mechanism.joint(name) {
            return Ok(Target::Coordinate(Coordinate::Joint(joint)));
        }
        if let Some(platform) = self.mechanism.platform(name) {
            return Ok(Target::Pose(platform));
        }
        if let Some((platform, coordinate)) = name.rsplit_once('.')
            && let (Some(platform), Some(coordinate)) = (
                self.mechanism.platform(platform),
                PoseCoordinate::from_word(coordinate),
            )
        {
            return Ok(Target::Coordinate(Coordinate::Pose(platform, coordinate)));
        }
        let platforms = self.mechanism.platforms().iter();
        let coordinates = Coordinate::all(self.mechanism).map(|of| of.name(self.mechanism));
        let known: Vec<String> = coordinates
            .chain(platforms.map(|platform| platform.name.clone()))
            .collect();
        Err(QuestionError::UnknownName {
            name: name.into(),
            suggestion: nearest(name, known.iter().map(String::as_str)).map(str::to_owned),
        })
    }
}
