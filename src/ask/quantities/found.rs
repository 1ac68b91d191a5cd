//! What names in quantities stand for at one configuration.

use super::places::PlacesAt;
use crate::analysis::velocity::TransmissionAngles;
use crate::geometry::Vector3;
use crate::mechanism::{Figure, Frame, Measured, Mechanism, Order, Point};
use crate::system::Coordinate;

/// What the engines tell of one configuration.
pub(super) struct Found<'a> {
    pub mechanism: &'a Mechanism,
    pub places: PlacesAt<'a>,
    pub loose: &'a [Frame],
    /// Whether rates are determined there.
    pub moves: bool,
    /// The largest rate and acceleration, in rad and characteristic lengths.
    pub rates: [f64; 2],
    pub coordinates: &'a [Coordinate],
    pub forces: &'a [f64],
    pub transmission: Option<&'a TransmissionAngles>,
    pub angles: &'a [Option<f64>],
    pub figures: &'a [(Figure, Option<f64>)],
}

impl Found<'_> {
    /// The value of a name, not a number where it is not determined, and how far it may be off; with the number of the
    /// point, if it is of one.
    pub fn value(&self, of: &Measured, i: usize) -> [f64; 2] {
        let value = self.known(of, i).unwrap_or(f64::NAN);
        [value, self.noise(of, i, value)]
    }

    /// How far the value of a name may be off: configurations are closed to 1e-12.
    fn noise(&self, of: &Measured, i: usize, value: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let [rate, change] = self.rates;
        let most = |order: Order| match order {
            Order::Value => 1.0,
            Order::Velocity => rate,
            Order::Acceleration => change.max(rate * rate),
        };
        let length = self.mechanism.characteristic_length();
        let scale = |is_angle: bool| if is_angle { 1.0 } else { length };
        let size = match *of {
            Measured::Parameter(_) => 0.0,
            Measured::Joint(joint, order) => {
                self.mechanism.dimensions().joint_scales[joint] * most(order)
            }
            Measured::Place(_, c, order) => scale(c.is_angle()) * most(order),
            Measured::Size(_, order) => length * most(order),
            Measured::Transmission(_) => 10.0,
            Measured::Force(_) | Measured::PlatformForce(..) => self
                .forces
                .iter()
                .fold(0.0, |most: f64, x| most.max(x.abs())),
            // κ = |v × a| / |v|³ by δv and δa
            Measured::Curvature(point) => {
                let [v, a] = [Order::Velocity, Order::Acceleration]
                    .map(|order| self.vector(point, i, order).map_or(0.0, |v| v.norm()));
                length * (change.max(rate * rate) + rate * a / v) / (v * v)
            }
            Measured::Figure(_) if value.is_nan() => 0.0,
            Measured::Figure(_) => value.abs(),
        };
        ROUNDING * size
    }

    fn known(&self, of: &Measured, i: usize) -> Option<f64> {
        match *of {
            Measured::Parameter(parameter) => Some(self.mechanism.parameters()[parameter].value),
            Measured::Joint(joint, order) => self.moving(self.places.joint(joint, order), order),
            Measured::Place(point, coordinate, order) => {
                let loose = order > Order::Value
                    && (coordinate.is_angle() || !point.is_origin())
                    && self.loose.contains(&point.frame);
                self.moving(self.places.coordinate(i, coordinate, order), order)
                    .filter(|_| !loose)
            }
            Measured::Size(point, order) => Some(self.vector(point, i, order)?.norm()),
            // κ = |v × a| / |v|³
            Measured::Curvature(point) => {
                let velocity = self.vector(point, i, Order::Velocity)?;
                let size = velocity.norm();
                if size <= self.noise(&Measured::Size(point, Order::Velocity), i, size) {
                    return None;
                }
                let across = velocity.cross(&self.vector(point, i, Order::Acceleration)?);
                Some(across.norm() / size.powi(3))
            }
            Measured::Force(joint) => self.force(Coordinate::Joint(joint)),
            Measured::PlatformForce(platform, c) => self.force(Coordinate::Pose(platform, c)),
            Measured::Transmission(closure) => {
                let name = closure.map(|closure| &*self.mechanism.closures()[closure].name);
                let loops = self.transmission?.loops().zip(self.angles);
                let of_it = loops.filter(|(closure, _)| name.is_none_or(|name| name == *closure));
                of_it.filter_map(|(_, angle)| *angle).reduce(f64::min)
            }
            Measured::Figure(figure) => {
                let mut known = self.figures.iter();
                known.find(|(of, _)| *of == figure)?.1
            }
        }
    }

    /// Place, velocity or acceleration of a point, by its number.
    fn vector(&self, point: Point, i: usize, order: Order) -> Option<Vector3<f64>> {
        let loose = order > Order::Value && !point.is_origin() && self.loose.contains(&point.frame);
        let known = (self.moves || order == Order::Value) && !loose;
        known.then(|| self.places.vector(i, order))?
    }

    /// A derivative, if rates are determined.
    fn moving(&self, value: Option<f64>, order: Order) -> Option<f64> {
        value.filter(|_| self.moves || order == Order::Value)
    }

    fn force(&self, of: Coordinate) -> Option<f64> {
        let place = self.coordinates.iter().position(|known| *known == of)?;
        self.forces
            .get(place)
            .copied()
            .filter(|force| !force.is_nan())
    }
}
