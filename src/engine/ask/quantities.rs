//! Quantities that a question asks for, and those of them that can be known.

use super::{AskError, Item, Question, Role, Unmeasured};
use crate::algebra::{Measure, SiUnit};
use crate::analysis::velocity::row_count;
use crate::mechanism::{Figure, Measured, NamedPoint, Order, Quantity};
use crate::system::{self, Coordinate, QuestionError, free_outputs};

impl Question {
    /// The quantities that are asked for; without any those that the file names and that can be known where what is held
    /// moves or not.
    pub(super) fn quantities(
        &self,
        held: &system::Question,
        moving: bool,
        points: &[NamedPoint],
    ) -> Result<Vec<Quantity>, AskError> {
        let mechanism = &**self.mechanism();
        let lists = || {
            self.of(Role::Report)
                .filter(|(_, list)| !list.name.is_empty())
        };
        if lists().next().is_none() {
            let outputs = mechanism.outputs().iter();
            let known = outputs.filter(|output| self.unmeasured(held, moving, output).is_none());
            return Ok(known.cloned().collect());
        }
        let mut quantities = Vec::new();
        for (item, list) in lists() {
            for text in Quantity::split(&list.name) {
                for (name, text) in self.expanded(&text, held, points) {
                    quantities.push(self.quantity((held, moving), item, &name, &text)?);
                }
            }
        }
        Ok(quantities)
    }

    /// The quantity of that name in the file, or that of a text.
    fn quantity(
        &self,
        (held, moving): (&system::Question, bool),
        item: Item,
        name: &str,
        text: &str,
    ) -> Result<Quantity, AskError> {
        let mechanism = &**self.mechanism();
        let mut outputs = mechanism.outputs().iter();
        let read = match outputs.find(|output| output.name == text) {
            Some(output) => Ok(output.clone()),
            None => Quantity::read(mechanism, name, text),
        };
        let quantity = read.map_err(item.quantity(text))?;
        match self.unmeasured(held, moving, &quantity) {
            Some(error) => Err(item.unmeasured(&quantity.name, error)),
            None => Ok(quantity),
        }
    }

    /// The quantities that may dwell, by their numbers, with tolerances in SI units; those that are not reported yet are.
    pub(super) fn tolerances(
        &self,
        held: &system::Question,
        quantities: &mut Vec<Quantity>,
    ) -> Result<Vec<(usize, f64)>, AskError> {
        let moving = self.has(Role::Input);
        let dwells = self.of(Role::Dwell).map(|(item, demand)| {
            let (text, tolerance) = (&demand.name, demand.value(0));
            let known = quantities.iter().position(|known| known.name == *text);
            let place = match known {
                Some(place) => place,
                None => {
                    quantities.push(self.quantity((held, moving), item, text, text)?);
                    quantities.len() - 1
                }
            };
            let measure = match quantities[place].unit {
                SiUnit::RADIAN => Measure::Angle,
                SiUnit::METRE => Measure::Length,
                _ => Measure::Number,
            };
            let number = tolerance.number(self.mechanism(), measure);
            let number = number.map_err(|error| QuestionError::Value {
                name: text.clone(),
                text: tolerance.to_string(),
                error,
            });
            let number = number.map_err(item.wrong(AskError::Named))?;
            match moving {
                true => Ok((place, number.abs())),
                false => Err(item.unmeasured(text, Unmeasured::NoInput)),
            }
        });
        dwells.collect()
    }

    /// Name and text of a quantity: `NAME=EXPRESSION`, or an expression that is its own name. `velocity` and
    /// `acceleration` alone are those of all traced points, or else of all joints that are not held.
    fn expanded(
        &self,
        text: &str,
        held: &system::Question,
        points: &[NamedPoint],
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
                let joints = self.mechanism().joints().iter().enumerate();
                let free = joints.filter(|(i, _)| !known.contains(&Coordinate::Joint(*i)));
                free.map(|(_, joint)| joint.name.clone()).collect()
            }
            points => points.iter().map(|point| point.name.clone()).collect(),
        };
        let named = of.into_iter().map(|of| format!("{text}:{of}"));
        named.map(|text| (text.clone(), text)).collect()
    }

    /// The reason for which a quantity cannot be known, if there is one.
    fn unmeasured(
        &self,
        held: &system::Question,
        moving: bool,
        quantity: &Quantity,
    ) -> Option<Unmeasured> {
        quantity.measured().find_map(|measured| {
            let moves = match measured {
                Measured::Parameter(_) | Measured::Time => false,
                Measured::Joint(_, order) | Measured::Place(_, _, order) => *order != Order::Value,
                Measured::Figure(figure) => *figure != Figure::Constraint,
                _ => true,
            };
            if moves && !moving {
                return Some(Unmeasured::NoInput);
            }
            let of = match *measured {
                Measured::Figure(Figure::Determinant) => {
                    let outputs = free_outputs(self.mechanism(), &held.driven_coordinates(), &[]);
                    let rows = row_count(self.mechanism(), &outputs);
                    let columns = held.driven_coordinates().len();
                    return (rows != columns).then_some(Unmeasured::NotSquare { rows, columns });
                }
                Measured::Force(joint) | Measured::Inertia(joint) => Coordinate::Joint(joint),
                Measured::PlatformForce(platform, c) => Coordinate::Pose(platform, c),
                _ => return None,
            };
            match held.driven_coordinates().contains(&of) {
                true if !self.has(Role::Wrench)
                    && !self.has(Role::Load)
                    && self.mechanism().loads().is_empty() =>
                {
                    Some(Unmeasured::NoLoad)
                }
                true => None,
                false => Some(Unmeasured::NotHeld {
                    name: of.name(self.mechanism()),
                    held: held.held_names(),
                }),
            }
        })
    }
}
