//! What a question drives, and how fast.

use super::value::{self, ValueError};
use super::{Holdable, Question, QuestionError};
use crate::algebra::Measure;
use crate::description::nearest;

/// Rates and accelerations of the held coordinates of a question, in m and rad and seconds.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// The held coordinates.
    pub coordinates: Vec<Holdable>,
    /// Their rates.
    pub rates: Vec<f64>,
    /// Their accelerations.
    pub accelerations: Vec<f64>,
    /// Whether a rate or acceleration was given.
    pub given: bool,
}

/// Why a rate, an acceleration or a force cannot be given.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveError {
    /// The name or the value is wrong.
    Question(QuestionError),
    /// Roll, pitch and yaw do not tell how a platform that is held at a pitch of ±90° turns.
    Locked {
        /// The platform.
        platform: String,
    },
    /// The coordinate is not held, so that its rate follows.
    NotHeld {
        /// The coordinate.
        name: String,
        /// What is held.
        held: Vec<String>,
    },
}

impl Drive {
    /// Everything held stands still.
    pub fn still(question: &Question) -> Self {
        let coordinates = question.held_coordinates();
        Drive {
            rates: vec![0.0; coordinates.len()],
            accelerations: vec![0.0; coordinates.len()],
            coordinates,
            given: false,
        }
    }

    /// Gives a held coordinate a rate, an expression as in the file, in m/s or rad/s.
    ///
    /// # Errors
    /// If the coordinate is not held or the value has none.
    pub fn rate(mut self, question: &Question, name: &str, text: &str) -> Result<Self, DriveError> {
        let place = self.place(question, name)?;
        self.rates[place] = number(question, name, text, self.measure(question, place))?;
        self.given = true;
        Ok(self)
    }

    /// Gives a held coordinate an acceleration, in m/s² or rad/s².
    ///
    /// # Errors
    /// If the coordinate is not held or the value has none.
    pub fn acceleration(
        mut self,
        question: &Question,
        name: &str,
        text: &str,
    ) -> Result<Self, DriveError> {
        let place = self.place(question, name)?;
        self.accelerations[place] = number(question, name, text, self.measure(question, place))?;
        self.given = true;
        Ok(self)
    }

    /// A rate has the unit of its coordinate per unit of time, which is not written.
    fn measure(&self, question: &Question, place: usize) -> Measure {
        self.coordinates[place].measure(question.mechanism())
    }

    fn place(&self, question: &Question, name: &str) -> Result<usize, DriveError> {
        let mechanism = question.mechanism();
        let names = self.coordinates.iter().map(|c| c.name(mechanism));
        let names: Vec<String> = names.collect();
        if let Some(place) = names.iter().position(|held| held == name) {
            return Ok(place);
        }
        let joints = (0..mechanism.joints().len()).map(Holdable::Joint);
        let platforms = 0..mechanism.platforms().len();
        let coordinates = platforms.flat_map(|platform| {
            let all = crate::mechanism::Coordinate::ALL;
            all.map(|c| Holdable::Coordinate(platform, c))
        });
        let known = joints.chain(coordinates).map(|c| c.name(mechanism));
        let known: Vec<String> = known.collect();
        let locked = self.coordinates.iter().find_map(|held| match *held {
            Holdable::Turn(platform, _) => {
                let platform = mechanism.platforms()[platform].name.as_str();
                let angles = crate::mechanism::Coordinate::ALL.map(|c| (c.is_angle(), c.name()));
                let asked = name.strip_prefix(platform)?.strip_prefix('.')?;
                (angles.contains(&(true, asked))).then(|| platform.to_owned())
            }
            Holdable::Joint(_) | Holdable::Coordinate(..) => None,
        });
        if let Some(platform) = locked {
            return Err(DriveError::Locked { platform });
        }
        if known.iter().any(|known| known == name) {
            return Err(DriveError::NotHeld {
                name: name.into(),
                held: names,
            });
        }
        let suggestion = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
        Err(DriveError::Question(QuestionError::UnknownName {
            name: name.into(),
            suggestion,
        }))
    }
}

/// The value of an expression over the parameters.
pub(super) fn number(
    question: &Question,
    name: &str,
    text: &str,
    wanted: Measure,
) -> Result<f64, DriveError> {
    let value = value::number(question.mechanism(), text, wanted);
    value.map_err(|error: ValueError| {
        DriveError::Question(QuestionError::Value {
            name: name.into(),
            text: text.into(),
            error,
        })
    })
}
