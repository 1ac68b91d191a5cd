use serde::Serialize;

use super::freedom::{Holdable, Mobility};
use super::question::{Question, QuestionError};
use crate::description::Role;
use crate::mechanism::Coordinate;

/// What is held beside what the mechanism allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Freedoms of the mechanism, if it assembles near the start.
    pub mobility: Option<usize>,
    /// Coordinates held.
    pub held: usize,
}

impl Question<'_> {
    /// Compares what is held with what the mechanism allows.
    ///
    /// # Errors
    /// If more or less is held than the mechanism has freedoms, or what is held depends on itself.
    pub fn count(&self) -> Result<Count, QuestionError> {
        let mechanism = self.mechanism();
        let held = self.held_coordinates();
        let start = self.start();
        let mobility = Mobility::near(mechanism, &start)
            .or_else(|| Mobility::near(mechanism, &mechanism.home()));
        let Some(mobility) = mobility else {
            return Ok(Count {
                mobility: None,
                held: held.len(),
            });
        };
        let count = Count {
            mobility: Some(mobility.count()),
            held: held.len(),
        };
        let joints = (0..mechanism.joints().len()).map(Holdable::Joint);
        let coordinates = (0..mechanism.platforms().len())
            .flat_map(|platform| Coordinate::ALL.map(|c| Holdable::Coordinate(platform, c)));
        let (actuated, passive): (Vec<_>, Vec<_>) = joints.partition(|joint| match joint {
            Holdable::Joint(joint) => mechanism.joints()[*joint].role == Role::Actuated,
            Holdable::Coordinate(..) => false,
        });
        let candidates: Vec<Holdable> = (held.iter().copied())
            .chain(actuated)
            .chain(passive)
            .chain(coordinates)
            .collect();
        let chosen = mobility.independent(mechanism, &candidates);
        let name = |holdable: &Holdable| holdable.name(mechanism);
        let free: Vec<String> = held
            .iter()
            .filter(|h| !chosen.contains(h))
            .map(name)
            .collect();
        let hold: Vec<String> = chosen
            .iter()
            .filter(|c| !held.contains(c))
            .map(name)
            .collect();
        let (mobility, held) = (mobility.count(), held.len());
        match (free.is_empty(), hold.is_empty()) {
            (true, true) => Ok(count),
            (false, true) => Err(QuestionError::TooMany {
                mobility,
                held,
                free,
            }),
            (true, false) => Err(QuestionError::TooFew {
                mobility,
                held,
                hold,
            }),
            (false, false) => Err(QuestionError::Dependent { free, hold }),
        }
    }
}
