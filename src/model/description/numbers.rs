//! Numbers written as briefly as a person would write them.

use super::{Axis, Displacement, Entry};
use crate::algebra::{Node, Unit};
use crate::geometry::Pose;
use crate::number::{Number, real};

/// The largest relative error when a number is written shorter.
const SHORTENED: f64 = 4e-15;

/// The number with at most twelve decimals that differs by no more than rounding, if there is one.
fn short(value: f64) -> Option<f64> {
    let shortened = (value * 1e12).round() / 1e12;
    let near = (shortened - value).abs() <= SHORTENED * value.abs().max(1.0);
    // a zero has no sign here
    near.then_some(shortened + 0.0)
}

impl Entry {
    /// A length in m.
    pub fn length(metres: f64) -> Self {
        Entry::number(short(metres).unwrap_or(metres), 0..0)
    }

    /// An angle in rad, written in degrees where that is shorter: `90 deg`.
    pub fn angle(radians: f64) -> Self {
        let degrees = short(radians.to_degrees())
            .filter(|degrees| (degrees.to_radians() - radians).abs() <= SHORTENED)
            .filter(|degrees| degrees.to_string().len() <= 12);
        match degrees {
            Some(0.0) => Entry::number(0.0, 0..0),
            Some(degrees) => Entry::degrees(degrees),
            // many turns need their unit, to be read again
            None if radians.abs() > 2.0 * std::f64::consts::TAU => {
                Entry::signed(radians, Unit::Radian)
            }
            None => Entry::number(radians, 0..0),
        }
    }

    /// An angle written in degrees, with its sign before the quantity as the parser reads it.
    pub fn degrees(degrees: f64) -> Self {
        Entry::signed(degrees, Unit::Degree)
    }

    fn signed(value: f64, unit: Unit) -> Self {
        let size = Node::Quantity(value.abs(), unit).at(0..0);
        let expression = match value < 0.0 {
            true => Node::Negate(Box::new(size)).at(0..0),
            false => size,
        };
        expression.into()
    }
}

impl Displacement {
    /// A pose as a list of displacements: T, then Rz, Ry and Rx, without those that do nothing.
    pub fn of_pose(pose: &Pose<f64>) -> Vec<Displacement> {
        let mut steps = Displacement::of_position(pose.position.0);
        let mut left = *pose;
        let mut turn = |axis: Axis, (sin, cos): (f64, f64)| {
            let angle = Number::atan2(sin, cos);
            // the remainder is recomputed after each rotation, so that rounding does not accumulate
            left = Pose::rotation(axis, -angle) * left;
            let entry = Entry::angle(angle);
            if !entry.expression.is_zero() && angle.abs() > SHORTENED {
                steps.push(Displacement::Rotate(axis, entry));
            }
            left.rotation.0
        };
        let [n, ..] = pose.rotation.0;
        let upright = real::hypot(n.0[0], n.0[1]) < 1e-9;
        let yaw = if upright {
            (0.0, 1.0)
        } else {
            (n.0[1], n.0[0])
        };
        let [n, ..] = turn(Axis::Z, yaw);
        let [_, s, _] = turn(Axis::Y, (-n.0[2], n.0[0]));
        turn(Axis::X, (s.0[2], s.0[1]));
        steps
    }

    /// A translation in m, without zero components.
    pub fn of_position(position: [f64; 3]) -> Vec<Displacement> {
        let entries = position.map(Entry::length);
        let given = |i: &usize| !entries[*i].expression.is_zero() && position[*i].abs() > SHORTENED;
        let parts: Vec<usize> = (0..3).filter(given).collect();
        match parts[..] {
            [] => Vec::new(),
            [i] => {
                let axis = [Axis::X, Axis::Y, Axis::Z][i];
                vec![Displacement::Translate(axis, entries[i].clone())]
            }
            _ => vec![Displacement::TranslateBy(entries)],
        }
    }
}
