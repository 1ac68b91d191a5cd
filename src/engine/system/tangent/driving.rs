//! Rates of all unknowns for rates of the held coordinates.

use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, PoseCoordinate};
use crate::number::Number;
use crate::solve::Equations;
use crate::system::{Coordinate, Held, HeldPlatform, System, SystemWork, Unknown};

/// The rates of all unknowns for those of the held coordinates h: ẋ = −J⁺ H ḣ, where H ḣ are the rates of the rows in a
/// motion of h alone.
///
/// All joints, then six twist components of each platform, are unknowns here. Rates are dimensionless: rad and
/// characteristic lengths.
#[derive(Clone, Debug)]
pub struct Driving {
    entries: Vec<RateEntry>,
    /// For each unknown of the system its place among all.
    places: Vec<usize>,
}

/// Entrance of the rate of a held coordinate into the equations.
#[derive(Clone, Copy, Debug)]
struct RateEntry {
    at: Entrance,
    /// An angle of a platform, the other two of which are at rest: its angular velocity enters in place of the rate.
    turning: Option<(usize, PoseCoordinate)>,
}

/// Row or unknown at which a rate enters; the first of three for an angle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Entrance {
    /// Unknown whose rate it is.
    Unknown(usize),
    /// A row of the equations holds it, as a platform of which not the whole pose is held.
    Row(usize),
}

impl Entrance {
    fn after(self, components: usize) -> Self {
        match self {
            Entrance::Unknown(first) => Entrance::Unknown(first + components),
            Entrance::Row(first) => Entrance::Row(first + components),
        }
    }
}

impl Driving {
    /// For a choice of coordinates, which are all that is held in the equations.
    pub fn new<T: Factorable>(
        system: &System<T>,
        held: &Held<f64>,
        coordinates: &[Coordinate],
    ) -> Self {
        let joints = held.joints.len();
        let place = |unknown: &Unknown| match *unknown {
            Unknown::Joint(joint) => joint,
            Unknown::Twist(platform, component) => joints + 6 * platform + component,
        };
        let twist =
            |platform, component| Entrance::Unknown(place(&Unknown::Twist(platform, component)));
        let orientation = |platform| {
            let first = system.orientation_row(platform);
            Entrance::Row(first.expect("three held angles are an orientation"))
        };
        let whole = |platform: usize| held.platforms[platform] == HeldPlatform::Pose;
        let entry = |&coordinate: &Coordinate| {
            let (at, turning) = match coordinate {
                Coordinate::Joint(joint) => (Entrance::Unknown(joint), None),
                Coordinate::Turn(p, axis) if whole(p) => (twist(p, axis as usize), None),
                Coordinate::Turn(p, axis) => (orientation(p).after(axis as usize), None),
                Coordinate::Pose(p, c) if whole(p) && c.is_angle() => (twist(p, 0), Some((p, c))),
                Coordinate::Pose(p, c) if whole(p) => (twist(p, 3 + c as usize), None),
                Coordinate::Pose(p, c) => match system.coordinate_row(p, c) {
                    Some(row) => (Entrance::Row(row), None),
                    None => (orientation(p), Some((p, c))),
                },
            };
            RateEntry { at, turning }
        };
        Driving {
            entries: coordinates.iter().map(entry).collect(),
            places: system.unknowns().iter().map(place).collect(),
        }
    }

    /// Entrances of the held coordinates' rates, each with the number that enters.
    pub(super) fn entering<'a, T: Number>(
        &'a self,
        at: &'a Configuration<T>,
        given: &'a [T],
    ) -> impl Iterator<Item = (Entrance, T)> + 'a {
        let rates = self.entries.iter().zip(given);
        rates.flat_map(move |(entry, &rate)| {
            let (rates, count) = match entry.turning {
                None => ([rate; 3], 1),
                Some((platform, c)) => (turning(at, platform, c).times(rate).0, 3),
            };
            let components = rates.into_iter().take(count).enumerate();
            components.map(|(k, rate)| (entry.at.after(k), rate))
        })
    }

    /// The rates of all unknowns where the equations are linearised and factorised.
    pub fn rates<T: Factorable>(
        &self,
        system: &System<T>,
        at: &Configuration<T>,
        given: &[T],
        work: &mut SystemWork<T>,
        rates: &mut [T],
    ) {
        rates.fill(T::zero());
        for (entrance, rate) in self.entering(at, given) {
            if let Entrance::Unknown(place) = entrance {
                rates[place] += rate;
            }
        }
        self.row_rates(system, at, given, work, rates);
        self.rest(system, work, rates);
    }

    /// The rates at which all rows open for rates of all unknowns, in place of the residual: zero if these are those of a
    /// motion in which the held coordinates have the given ones.
    pub fn row_rates<'a, T: Factorable>(
        &self,
        system: &System<T>,
        at: &Configuration<T>,
        given: &[T],
        work: &'a mut SystemWork<T>,
        rates: &[T],
    ) -> &'a mut [T] {
        let rows = system.row_rates(at, rates, work);
        for (entrance, rate) in self.entering(at, given) {
            if let Entrance::Row(row) = entrance {
                rows[row] -= rate;
            }
        }
        rows
    }

    /// Adds the rates of the unknowns of the equations for which the rows stay closed.
    pub(super) fn rest<T: Factorable>(
        &self,
        system: &System<T>,
        work: &mut SystemWork<T>,
        rates: &mut [T],
    ) {
        system.stretch_angle_rates(work);
        system.step(work);
        for (&place, &step) in self.places.iter().zip(system.step_of(work)) {
            rates[place] = step;
        }
    }
}

/// The angular velocity for a unit rate of one angle of a platform, the other two at rest.
fn turning<T: Number>(at: &Configuration<T>, platform: usize, c: PoseCoordinate) -> Vector3<T> {
    let pose = at.platforms[platform].pose();
    let slope = |c: PoseCoordinate| {
        let slope = c.slope(&pose);
        Vector3([slope[0], slope[1], slope[2]])
    };
    let [next, last] = match c {
        PoseCoordinate::Roll => [PoseCoordinate::Pitch, PoseCoordinate::Yaw],
        PoseCoordinate::Pitch => [PoseCoordinate::Yaw, PoseCoordinate::Roll],
        _ => [PoseCoordinate::Roll, PoseCoordinate::Pitch],
    };
    let across = slope(next).cross(&slope(last));
    across.times(T::one() / slope(c).dot(&across))
}
