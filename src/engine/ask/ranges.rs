//! Coordinates that move or are mapped, with their ranges.

use std::f64::consts::TAU;

use super::{AskError, Question, Role};
use crate::mechanism::Mechanism;
use crate::system::{self, Coordinate, Driven, Held, QuestionError};

/// Turns of an input at most: the curve is followed through each, a thousand in about a second.
const MOST_TURNS: f64 = 10_000.0;

impl Question {
    /// The inputs with their ranges; `refuse` is true for a range that is no use.
    pub(super) fn driven(&self, refuse: fn(f64, f64) -> bool) -> Result<Vec<Driven>, AskError> {
        let question = system::Question::new(self.mechanism());
        let mut ranges = Vec::new();
        for (item, input) in self.distinct(Role::Input)? {
            let name = &input.name;
            // a wrong name is the first thing to say
            (question.value(name, "home")).map_err(item.wrong(AskError::Named))?;
            let from = question.value(name, input.value(0));
            let (coordinate, from) = from.map_err(item.value(0).wrong(AskError::Named))?;
            let to = question.value(name, input.value(1));
            let (_, to) = to.map_err(item.value(1).wrong(AskError::Named))?;
            if refuse(from, to) {
                return Err(AskError::EmptyRange(item, name.clone()));
            }
            ranges.push(Driven {
                coordinate,
                from,
                to,
            });
        }
        Ok(ranges)
    }

    /// Refuses inputs that turn so often that nobody waits for it.
    pub(super) fn few_turns(&self, inputs: &[Driven]) -> Result<(), AskError> {
        for (input, (item, demand)) in inputs.iter().zip(self.of(Role::Input)) {
            let turns = (input.to - input.from).abs() / TAU;
            if input.coordinate.is_angle(self.mechanism()) && turns > MOST_TURNS {
                return Err(AskError::TooManyTurns {
                    item,
                    name: demand.name.clone(),
                    turns,
                    most: MOST_TURNS,
                });
            }
        }
        Ok(())
    }

    /// A question with the inputs held too, at these values in m or rad.
    pub(super) fn with_inputs<'q>(
        &self,
        mut question: system::Question<'q>,
        values: &[f64],
    ) -> Result<system::Question<'q>, AskError> {
        for ((item, input), value) in self.of(Role::Input).zip(values) {
            question = (question.hold(&input.name, *value)).map_err(|error| match error {
                QuestionError::Contradiction { .. } => AskError::AlsoHeld(item, input.name.clone()),
                error => AskError::Named(item, Box::new(error)),
            })?;
        }
        Ok(question)
    }
}

/// The middle of each range.
pub(super) fn middles(ranges: &[Driven]) -> Vec<f64> {
    ranges.iter().map(|r| 0.5 * (r.from + r.to)).collect()
}

/// The held coordinates less those that move.
pub(super) fn still(held: Held<f64>, moved: &[Driven]) -> Held<f64> {
    let without = |held: Held<f64>, input: &Driven| held.without(input.coordinate);
    moved.iter().fold(held, without)
}

/// True for a coordinate of a platform or of a point.
pub(super) fn of_platform(mechanism: &Mechanism, coordinate: &Coordinate) -> bool {
    match *coordinate {
        Coordinate::Joint(joint) => mechanism.is_of_point(joint),
        Coordinate::Pose(..) | Coordinate::Turn(..) => true,
    }
}
