//! Quantities over a motion: what is asked for, and what of it can be known.

mod extremes;
mod meter;

pub(super) use extremes::Extremes;
pub(super) use meter::{Meter, Metered};

use super::{AskError, Question, Role, Unmeasured};
use crate::mechanism::{Figure, Measured, Order, Point, Quantity};
use crate::system::{self, Coordinate};

impl Question {
    /// The quantities that are asked for; without any those that the file names and that can be known.
    pub(super) fn quantities(
        &self,
        held: &system::Question,
        points: &[Point],
    ) -> Result<Vec<Quantity>, AskError> {
        let mechanism = &*self.mechanism;
        let unmeasured = |quantity: &Quantity| {
            let parts = quantity.measured();
            parts
                .filter_map(|measured| self.unmeasured(held, measured))
                .next()
        };
        if self.reports.is_empty() {
            let known = mechanism
                .outputs()
                .iter()
                .filter(|output| unmeasured(output).is_none());
            return Ok(known.cloned().collect());
        }
        let mut quantities = Vec::new();
        for (index, list) in self.reports.iter().enumerate() {
            let item = Role::Quantity.item(index);
            for text in Quantity::split(list) {
                for (name, text) in self.expanded(&text, held, points) {
                    let named = mechanism
                        .outputs()
                        .iter()
                        .find(|output| output.name == text);
                    let read = match named {
                        Some(output) => Ok(output.clone()),
                        None => Quantity::read(mechanism, &name, &text),
                    };
                    let quantity = read.map_err(|error| AskError::Quantity {
                        item,
                        text: text.clone(),
                        error: Box::new(error),
                    })?;
                    if let Some(error) = unmeasured(&quantity) {
                        let quantity = quantity.name;
                        return Err(AskError::Unmeasured {
                            item,
                            quantity,
                            error,
                        });
                    }
                    quantities.push(quantity);
                }
            }
        }
        Ok(quantities)
    }

    /// Name and text of a quantity: `NAME=EXPRESSION`, or an expression that is its own name. `velocity` and
    /// `acceleration` alone are those of all traced points, or else of all joints that are not held.
    fn expanded(
        &self,
        text: &str,
        held: &system::Question,
        points: &[Point],
    ) -> Vec<(String, String)> {
        if let Some((name, text)) = text.split_once('=') {
            return vec![(name.trim().into(), text.trim().into())];
        }
        if !["velocity", "acceleration"].contains(&text) {
            return vec![(text.into(), text.into())];
        }
        let of: Vec<String> = match points {
            [] => {
                let known = held.held_coordinates();
                let joints = self.mechanism.joints().iter().enumerate();
                let free = joints.filter(|(i, _)| !known.contains(&Coordinate::Joint(*i)));
                free.map(|(_, joint)| joint.name.clone()).collect()
            }
            points => points
                .iter()
                .map(|point| point.name(&self.mechanism))
                .collect(),
        };
        let named = of.into_iter().map(|of| format!("{text}:{of}"));
        named.map(|text| (text.clone(), text)).collect()
    }

    /// Why what a name stands for cannot be known.
    fn unmeasured(&self, held: &system::Question, measured: &Measured) -> Option<Unmeasured> {
        let moves = match measured {
            Measured::Parameter(_) => false,
            Measured::Joint(_, order) | Measured::Place(_, _, order) => *order != Order::Value,
            Measured::Figure(figure) => *figure != Figure::Constraint,
            _ => true,
        };
        if moves && self.inputs.is_empty() {
            return Some(Unmeasured::NoInput);
        }
        let of = match *measured {
            Measured::Force(joint) => Coordinate::Joint(joint),
            Measured::PlatformForce(platform, c) => Coordinate::Pose(platform, c),
            _ => return None,
        };
        match held.driven_coordinates().contains(&of) {
            true if self.wrenches.is_empty() && self.loads.is_empty() => Some(Unmeasured::NoLoad),
            true => None,
            false => Some(Unmeasured::NotHeld {
                name: of.name(&self.mechanism),
                held: held.held_names(),
            }),
        }
    }
}
