//! Positions and rates at a configuration that loads depend on.

use super::{LoadPlace, Loaded, Moving};
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Measured, Order, Placement, Point, PoseCoordinate};
use crate::number::{Dual, Number};

/// A configuration with its motion.
pub(super) struct Here<'a, T> {
    pub of: &'a Loaded<T>,
    pub at: &'a Configuration<T>,
    pub placement: &'a Placement<T>,
    pub moving: Option<Moving<'a, T>>,
}

impl<T: Number> Here<'_, T> {
    /// Angular velocity and velocity of a point.
    pub fn motion(&self, i: usize) -> Option<[Vector3<T>; 2]> {
        let moving = self.moving.as_ref()?;
        let twist = self.of.twists.twist(i, self.placement, moving.rates);
        Some([twist.omega, twist.velocity].map(|v| v.times(moving.pace[0])))
    }

    /// Angular acceleration and acceleration of a point.
    pub fn change(&self, i: usize) -> Option<[Vector3<T>; 2]> {
        let moving = self.moving.as_ref()?;
        let (twists, rates, placement) = moving.changes?;
        let twist = twists.twist(i, placement, rates);
        let [r, c] = moving.pace;
        let paced = |x: Dual<T>| x.slope * r * r + x.value * c;
        Some([twist.omega.map(paced), twist.velocity.map(paced)])
    }

    /// Distance of two points, and the direction from the first to the second.
    pub fn line(&self, a: usize, b: usize) -> (T, Vector3<T>) {
        let [a, b] = [a, b].map(|i| self.of.twists.origin(i, self.placement));
        let apart = b - a;
        let distance = apart.norm();
        match distance.real() == 0.0 {
            true => (distance, Vector3::zero()),
            false => (distance, apart.times(T::one() / distance)),
        }
    }

    /// The distance of two points, or the value of a joint, and its rate.
    pub fn extension(&self, place: LoadPlace) -> (T, Option<T>) {
        match place {
            LoadPlace::Joint(joint) => (self.at.joints[joint], self.rate(joint)),
            LoadPlace::Points(a, b) => {
                let (distance, direction) = self.line(a, b);
                let rates = self.motion(a).zip(self.motion(b));
                let rate = rates.map(|(a, b)| direction.dot(&(b[1] - a[1])));
                (distance, rate)
            }
            LoadPlace::At(_) => (T::zero(), None),
        }
    }

    pub fn rate(&self, joint: usize) -> Option<T> {
        let moving = self.moving.as_ref()?;
        let (column, scale) = self.of.columns[joint];
        let rate = moving.rates[column?] * moving.pace[0];
        Some(rate.scale(scale))
    }

    /// The value of a quantity on which a given force depends. Nothing moves where it is not said how.
    pub fn value(&self, of: &Measured) -> T {
        let of_point = |point: &Point| self.of.points.iter().position(|known| known == point);
        let nothing = T::zero();
        match of {
            Measured::Parameter(i) => T::from_f64(self.of.parameters[*i]),
            Measured::Time => self.moving.as_ref().map_or(nothing, |moving| moving.time),
            Measured::Joint(joint, Order::Value) => self.at.joints[*joint],
            Measured::Joint(joint, _) => self.rate(*joint).unwrap_or(nothing),
            Measured::Place(point, c, order) => {
                let Some(i) = of_point(point) else {
                    return T::from_f64(f64::NAN);
                };
                self.coordinate(i, *c, *order)
            }
            Measured::Size(point, _) => {
                let motion = of_point(point).and_then(|i| self.motion(i));
                motion.map_or(nothing, |[_, velocity]| velocity.norm())
            }
            _ => T::from_f64(f64::NAN),
        }
    }

    fn coordinate(&self, i: usize, c: PoseCoordinate, order: Order) -> T {
        let frame = self.of.twists.frame(i, self.placement);
        let motion = self.motion(i).unwrap_or([Vector3::zero(); 2]);
        match (order, c.is_angle()) {
            (Order::Value, true) => c.of(frame),
            (Order::Value, false) => {
                let place = self.of.twists.origin(i, self.placement).0[c as usize];
                place + T::from_f64(self.of.centre[c as usize])
            }
            (_, true) => c.turned(frame, &motion[0]),
            (_, false) => motion[1].0[c as usize],
        }
    }
}
