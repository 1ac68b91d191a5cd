//! What names in quantities stand for at one configuration.

use super::Meter;
use super::probe::Found;
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Measured, Order, Point, PoseCoordinate};
use crate::number::Packed;
use crate::system::Coordinate;

/// A configuration and what is known of its motion.
pub(super) struct Here<'a, T> {
    pub at: &'a Configuration<f64>,
    /// What was found there, in this place.
    pub found: &'a Found<T>,
    pub place: usize,
    /// The largest rate and acceleration, in rad and characteristic lengths.
    pub largest: [f64; 2],
}

impl<T: Packed> Here<'_, T> {
    fn tells(&self, order: Order) -> bool {
        self.found.moves || order == Order::Value
    }

    /// Where the point of that number is, or how it moves.
    fn moved(&self, i: usize, order: Order) -> Option<Vector3<f64>> {
        let moved = self.found.points[order as usize].get(i)?;
        Some(moved.map(|x| x.part(self.place)))
    }
}

impl Meter<'_> {
    /// The value of a name, not a number where it is not determined, and how far it may be off; with the number of the
    /// point, if it is of one.
    pub(super) fn value<T: Packed>(&self, here: &Here<T>, of: &Measured, i: usize) -> [f64; 2] {
        let value = self.known(here, of, i).unwrap_or(f64::NAN);
        [value, self.off(here, of, i, value)]
    }

    /// How far the value of a name may be off: configurations are closed to 1e-12.
    fn off<T: Packed>(&self, here: &Here<T>, of: &Measured, i: usize, value: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let [rate, change] = here.largest;
        let most = |order: Order| match order {
            Order::Value => 1.0,
            Order::Velocity => rate,
            Order::Acceleration => change.max(rate * rate),
        };
        let mechanism = self.of.question.mechanism();
        let length = mechanism.characteristic_length();
        let scale = |is_angle: bool| if is_angle { 1.0 } else { length };
        let size = match *of {
            Measured::Parameter(_) => 0.0,
            Measured::Joint(joint, order) => {
                mechanism.dimensions().joint_scales[joint] * most(order)
            }
            Measured::Place(_, c, order) => scale(c.is_angle()) * most(order),
            Measured::Size(_, order) => length * most(order),
            Measured::Transmission(_) => 10.0,
            Measured::Force(_) | Measured::PlatformForce(..) => {
                let forces = here.found.forces.iter().map(|x| x.part(here.place).abs());
                forces.fold(0.0, f64::max)
            }
            // κ = |v × a| / |v|³ by δv and δa
            Measured::Curvature(point) => {
                let [v, a] = [Order::Velocity, Order::Acceleration]
                    .map(|order| self.vector(here, point, i, order).map_or(0.0, |v| v.norm()));
                length * (change.max(rate * rate) + rate * a / v) / (v * v)
            }
            Measured::Figure(_) if value.is_nan() => 0.0,
            Measured::Figure(_) => value.abs(),
        };
        ROUNDING * size
    }

    fn known<T: Packed>(&self, here: &Here<T>, of: &Measured, i: usize) -> Option<f64> {
        let mechanism = self.of.question.mechanism();
        match *of {
            Measured::Parameter(parameter) => Some(mechanism.parameters()[parameter].value),
            Measured::Joint(joint, Order::Value) => Some(here.at.joints[joint]),
            Measured::Joint(joint, order) => {
                let rates = &here.found.rates[usize::from(order == Order::Acceleration)];
                let rate = rates.get(joint).filter(|_| here.found.moves)?;
                Some(rate.part(here.place) * mechanism.dimensions().joint_scales[joint])
            }
            Measured::Place(point, coordinate, order) => {
                let loose = order > Order::Value
                    && (coordinate.is_angle() || !point.is_origin())
                    && self.loose.contains(&point.frame);
                let known = here.tells(order) && !loose;
                known.then(|| self.coordinate(here, i, coordinate, order))?
            }
            Measured::Size(point, order) => Some(self.vector(here, point, i, order)?.norm()),
            // κ = |v × a| / |v|³
            Measured::Curvature(point) => {
                let velocity = self.vector(here, point, i, Order::Velocity)?;
                let size = velocity.norm();
                if size <= self.off(here, &Measured::Size(point, Order::Velocity), i, size) {
                    return None;
                }
                let across = velocity.cross(&self.vector(here, point, i, Order::Acceleration)?);
                Some(across.norm() / size.powi(3))
            }
            Measured::Force(joint) => self.force(here, Coordinate::Joint(joint)),
            Measured::PlatformForce(platform, c) => self.force(here, Coordinate::Pose(platform, c)),
            Measured::Transmission(closure) => {
                let name = closure.map(|closure| &*mechanism.closures()[closure].name);
                let loops = self.plan.transmission.as_ref()?.loops();
                let loops = loops.zip(&here.found.transmission);
                let of_it = loops.filter(|(closure, _)| name.is_none_or(|name| name == *closure));
                let angles = of_it.map(|(_, angle)| angle.part(here.place));
                angles.filter(|angle| !angle.is_nan()).reduce(f64::min)
            }
            Measured::Figure(figure) => {
                let mut known = self.figures.iter();
                known.find(|(of, _)| *of == figure)?.1
            }
        }
    }

    /// Place, velocity or acceleration of a point, by its number.
    fn vector<T: Packed>(
        &self,
        here: &Here<T>,
        point: Point,
        i: usize,
        order: Order,
    ) -> Option<Vector3<f64>> {
        let loose = order > Order::Value && !point.is_origin() && self.loose.contains(&point.frame);
        let known = here.tells(order) && !loose;
        known.then(|| here.moved(i, order))?
    }

    /// A coordinate of the point of that number, or of the orientation of its frame.
    fn coordinate<T: Packed>(
        &self,
        here: &Here<T>,
        i: usize,
        c: PoseCoordinate,
        order: Order,
    ) -> Option<f64> {
        if !c.is_angle() {
            return Some(here.moved(i, order)?.0[c as usize]);
        }
        let mut angles = self.plan.angles.iter();
        let place = angles.position(|of| *of == (i, c, order))?;
        Some(here.found.angles.get(place)?.part(here.place))
    }

    fn force<T: Packed>(&self, here: &Here<T>, of: Coordinate) -> Option<f64> {
        let place = self.coordinates.iter().position(|known| *known == of)?;
        let force = here.found.forces.get(place)?.part(here.place);
        (here.found.moves && !force.is_nan()).then_some(force)
    }
}
