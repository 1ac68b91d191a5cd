//! Ranges and turning points of joints and platform coordinates over a circuit.

use std::f64::consts::TAU;

use super::{At, Branch, FoundCurve, JointMotion};
use crate::algebra::SiUnit;
use crate::mechanism::{Mechanism, turn_near, turns};
use crate::number::tolerance::ROUNDING;
use crate::solve::Continuation;
use crate::system::{Coordinate, Curve};

/// The values of a coordinate along a curve, angles without jumps of a turn.
pub(super) struct JointCourse<'m> {
    mechanism: &'m Mechanism,
    pub of: Coordinate,
    closed: bool,
    /// Whole turns from one end to the other.
    turns: i64,
    /// Values at the places of the curve.
    values: Vec<f64>,
    /// Values at its turning points, in order, located to rounding.
    turnings: Vec<f64>,
    /// Value at its first turning point, once round.
    again: Option<f64>,
}

impl<'m> JointCourse<'m> {
    pub fn of_joint(mechanism: &'m Mechanism, joint: usize, found: &FoundCurve) -> Self {
        let value = |place: &At| place.at.joints[joint];
        let values: Vec<f64> = found.places.iter().map(value).collect();
        let turnings = found.turnings.iter().filter(|(j, _)| *j == joint);
        let turnings: Vec<f64> = turnings.map(|(_, place)| value(place)).collect();
        let (first, last) = (values[0], values[values.len() - 1]);
        JointCourse {
            mechanism,
            of: Coordinate::Joint(joint),
            closed: found.closed,
            turns: match found.closed && mechanism.turns_to_repeat(joint).is_some() {
                true => turns(last - first) as i64,
                false => 0,
            },
            again: turnings.first().map(|again| again + last - first),
            values,
            turnings,
        }
    }

    /// Course of a coordinate of a platform that moves. None for an angle that the pose does not determine, where
    /// another angle is ±90° on the way, or nearly.
    pub fn of_platform(
        mechanism: &'m Mechanism,
        (curve, method): (&mut Curve, &Continuation),
        found: &FoundCurve,
        of: Coordinate,
    ) -> Option<Self> {
        let is_angle = of.is_angle(mechanism);
        let near = |value: f64, before: f64| match is_angle {
            true => before + turn_near(value - before, 0.0),
            false => value,
        };
        let mut values: Vec<f64> = Vec::with_capacity(found.places.len());
        let places = found.restored(curve, method);
        for place in &places {
            let value = of.of(mechanism, &place.at);
            let before = values.last().copied();
            let value = before.map_or(value, |before| near(value, before));
            // angles that change more in one step do not follow from the pose
            if is_angle && before.is_some_and(|before| (value - before).abs() > 0.5) {
                return None;
            }
            values.push(value);
        }
        let rates: Vec<f64> = (places.iter())
            .map(|place| curve.rate(&place.at, &place.tangent, of))
            .collect();
        let moving: Vec<usize> = (0..rates.len())
            .filter(|&i| rates[i].abs() > ROUNDING)
            .collect();
        let (first, last) = (*moving.first()?, *moving.last()?);
        let mut turnings = Vec::new();
        for pair in moving.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            if rates[a] * rates[b] > 0.0 {
                continue;
            }
            turnings.push(match b - a {
                1 => {
                    let mut rate =
                        |curve: &mut Curve, place: &At| curve.rate(&place.at, &place.tangent, of);
                    let (from, to) = (&places[a], &places[b]);
                    let turning = method.root(curve, from, to, &mut rate);
                    near(of.of(mechanism, &turning.at), values[a])
                }
                // a place in between is where it turns
                _ => values[a + 1],
            });
        }
        let end = values[values.len() - 1];
        if found.closed && rates[first] * rates[last] < 0.0 {
            turnings.push(end);
        }
        let whole = match found.closed && is_angle {
            true => turns(end - values[0]) as i64,
            false => 0,
        };
        Some(JointCourse {
            mechanism,
            of,
            closed: found.closed,
            turns: whole,
            again: turnings.first().map(|again| again + TAU * whole as f64),
            values,
            turnings,
        })
    }

    /// A range, by whole turns where single values of this coordinate are reported.
    fn centred(&self, low: f64, high: f64) -> (f64, f64) {
        let middle = 0.5 * (low + high);
        let shift = match self.of {
            Coordinate::Joint(joint) => self.mechanism.within_cycle(joint, middle) - middle,
            of if of.is_angle(self.mechanism) => turn_near(middle, 0.0) - middle,
            _ => 0.0,
        };
        (low + shift, high + shift)
    }

    pub fn motion(&self) -> JointMotion {
        let all = self.values.iter().chain(&self.turnings);
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = all.fold(none, |(low, high), x| (low.min(*x), high.max(*x)));
        let (low, high) = self.centred(low, high);
        JointMotion {
            name: self.of.name(self.mechanism),
            unit: SiUnit::of_coordinate(self.of.is_angle(self.mechanism)),
            turns: self.turns,
            low,
            high,
        }
    }

    /// Pieces between places where it turns back; none where it stands still.
    pub fn branches(&self) -> Vec<Branch> {
        if self
            .values
            .iter()
            .all(|x| (x - self.values[0]).abs() < ROUNDING)
        {
            return Vec::new();
        }
        let (first, last) = (self.values[0], self.values[self.values.len() - 1]);
        let piece = |a: f64, b: f64, turns: bool| {
            let (low, high) = self.centred(a.min(b), a.max(b));
            Branch { low, high, turns }
        };
        let cuts = match (self.closed, self.again) {
            (true, None) => return vec![piece(first, last, true)],
            // once round, with the turns it made on the way
            (true, Some(again)) => [&self.turnings[..], &[again]].concat(),
            (false, _) => [&[first], &self.turnings[..], &[last]].concat(),
        };
        let pieces = cuts.windows(2).map(|pair| piece(pair[0], pair[1], false));
        pieces.collect()
    }
}
