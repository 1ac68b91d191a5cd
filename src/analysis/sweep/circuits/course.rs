//! How coordinates of platforms move over a circuit.

use std::f64::consts::TAU;

use super::{Branch, Found, JointMotion};
use crate::algebra::SiUnit;
use crate::mechanism::{Mechanism, turn_near, turns};
use crate::solve::Continuation;
use crate::system::{Coordinate, Curve};

/// The values of a coordinate along a curve, angles without jumps of a turn.
pub(super) struct Course {
    is_angle: bool,
    /// Where it was followed.
    values: Vec<f64>,
    /// Where it turns back, in order, located to rounding.
    turnings: Vec<f64>,
}

/// Those coordinates of platforms that move. An angle is left out where another one is ±90° on the
/// way, or nearly, and does not tell it.
pub(super) fn platform_courses(
    mechanism: &Mechanism,
    curve: &mut Curve,
    method: &Continuation,
    found: &Found,
) -> Vec<(Coordinate, Course)> {
    let platforms = Coordinate::all(mechanism).filter(|of| of.platform().is_some());
    let courses = platforms.filter_map(|of| {
        let course = course(mechanism, (&mut *curve, method), found, of)?;
        Some((of, course))
    });
    courses.collect()
}

fn course(
    mechanism: &Mechanism,
    (curve, method): (&mut Curve, &Continuation),
    found: &Found,
    of: Coordinate,
) -> Option<Course> {
    /// A rate as small beside a unit tangent is rounding.
    const STILL: f64 = 1e-9;
    /// Angles that change more in one step do not follow from the pose.
    const JUMP: f64 = 0.5;
    let is_angle = of.is_angle(mechanism);
    let mut values: Vec<f64> = Vec::with_capacity(found.places.len());
    for place in &found.places {
        let value = of.of(&place.at);
        let value = match (is_angle, values.last()) {
            (true, Some(&before)) => before + turn_near(value - before, 0.0),
            _ => value,
        };
        if is_angle
            && values
                .last()
                .is_some_and(|before| (value - before).abs() > JUMP)
        {
            return None;
        }
        values.push(value);
    }
    let rates: Vec<f64> = (found.places.iter())
        .map(|place| curve.rate(&place.at, &place.tangent, of))
        .collect();
    let moving: Vec<usize> = (0..rates.len())
        .filter(|&i| rates[i].abs() > STILL)
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
                let mut rate = |curve: &mut Curve, place: &super::At| {
                    curve.rate(&place.at, &place.tangent, of)
                };
                let (from, to) = (&found.places[a], &found.places[b]);
                let value = of.of(&method.root(curve, from, to, &mut rate).at);
                match is_angle {
                    true => values[a] + turn_near(value - values[a], 0.0),
                    false => value,
                }
            }
            // a place in between is where it turns
            _ => values[a + 1],
        });
    }
    if found.closed && rates[first] * rates[last] < 0.0 {
        turnings.push(values[values.len() - 1]);
    }
    Some(Course {
        is_angle,
        values,
        turnings,
    })
}

impl Course {
    /// Whole turns from one end to the other.
    fn turned(&self, closed: bool) -> i64 {
        let ends = self.values.first().zip(self.values.last());
        match ends {
            Some((first, last)) if closed && self.is_angle => turns(last - first) as i64,
            _ => 0,
        }
    }

    /// A range, that of an angle with its middle within (−π, π].
    fn centred(&self, low: f64, high: f64) -> (f64, f64) {
        let middle = 0.5 * (low + high);
        let shift = match self.is_angle {
            true => turn_near(middle, 0.0) - middle,
            false => 0.0,
        };
        (low + shift, high + shift)
    }

    pub fn motion(&self, name: String, closed: bool) -> JointMotion {
        let all = self.values.iter().chain(&self.turnings);
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = all.fold(none, |(low, high), x| (low.min(*x), high.max(*x)));
        let (low, high) = self.centred(low, high);
        JointMotion {
            name,
            unit: SiUnit::of_coordinate(self.is_angle),
            turns: self.turned(closed),
            low,
            high,
        }
    }

    /// Pieces between places where it turns back.
    pub fn branches(&self, closed: bool) -> Vec<Branch> {
        let (Some(&first), Some(&last)) = (self.values.first(), self.values.last()) else {
            return Vec::new();
        };
        let piece = |a: f64, b: f64, turns: bool| {
            let (low, high) = self.centred(a.min(b), a.max(b));
            Branch { low, high, turns }
        };
        let cuts = match (closed, self.turnings.first()) {
            (true, None) => return vec![piece(first, last, true)],
            (true, Some(again)) => {
                let round = TAU * self.turned(closed) as f64;
                [&self.turnings[..], &[again + round]].concat()
            }
            (false, _) => [&[first], &self.turnings[..], &[last]].concat(),
        };
        let pieces = cuts.windows(2).map(|pair| piece(pair[0], pair[1], false));
        pieces.collect()
    }
}
