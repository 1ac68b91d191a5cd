//! Where points and joints are, with derivatives by time.

use crate::geometry::{Pose, Vector3};
use crate::mechanism::{
    Configuration, Frame, Kinematics, Mechanism, Order, Placement, Point, PoseCoordinate,
};
use crate::number::{Dual, Number};

/// Points and joints with as many derivatives by time as are asked for.
pub(super) enum Places {
    Values(Placed<f64>),
    Velocities(Placed<Dual<f64>>),
    Accelerations(Placed<Dual<Dual<f64>>>),
}

pub(in super::super) struct Placed<T> {
    kinematics: Kinematics<T>,
    placement: Placement<T>,
    joints: Vec<T>,
}

impl<T: Number> Placed<T> {
    pub fn new(mechanism: &Mechanism, frames: &[Frame]) -> Self {
        let dimensions = mechanism.dimensions().map(&mut { T::from_f64 });
        let kinematics = Kinematics::new(&dimensions, frames.iter().copied());
        Placed {
            placement: kinematics.placement(),
            kinematics,
            joints: vec![T::zero(); mechanism.joints().len()],
        }
    }

    pub fn place(&mut self, at: &Configuration<T>) {
        self.kinematics.place(at, &mut self.placement);
        self.joints.copy_from_slice(&at.joints);
    }

    pub fn pose(&self, point: Point) -> Pose<T> {
        let pose = self.kinematics.pose(point.frame, &self.placement);
        let mut pose = *pose.expect("the kinematics was planned for the frames of all points");
        pose.position = point.placed(&pose);
        pose
    }
}

impl Places {
    pub fn new(mechanism: &Mechanism, frames: &[Frame], order: Order) -> Self {
        match order {
            Order::Value => Places::Values(Placed::new(mechanism, frames)),
            Order::Velocity => Places::Velocities(Placed::new(mechanism, frames)),
            Order::Acceleration => Places::Accelerations(Placed::new(mechanism, frames)),
        }
    }

    pub fn joint(&self, joint: usize, order: Order) -> Option<f64> {
        match self {
            Places::Values(of) => of.joints[joint].derivative(order),
            Places::Velocities(of) => of.joints[joint].derivative(order),
            Places::Accelerations(of) => of.joints[joint].derivative(order),
        }
    }

    pub fn coordinate(&self, point: Point, c: PoseCoordinate, order: Order) -> Option<f64> {
        match self {
            Places::Values(of) => c.of(&of.pose(point)).derivative(order),
            Places::Velocities(of) => c.of(&of.pose(point)).derivative(order),
            Places::Accelerations(of) => c.of(&of.pose(point)).derivative(order),
        }
    }
}

impl Places {
    /// Where a point is, or how it moves.
    pub fn vector(&self, point: Point, order: Order) -> Option<Vector3<f64>> {
        fn of<T: Moving>(position: Vector3<T>, order: Order) -> Option<Vector3<f64>> {
            let [x, y, z] = position.0.map(|part| part.derivative(order));
            Some(Vector3([x?, y?, z?]))
        }
        match self {
            Places::Values(places) => of(places.pose(point).position, order),
            Places::Velocities(places) => of(places.pose(point).position, order),
            Places::Accelerations(places) => of(places.pose(point).position, order),
        }
    }
}

/// A number that may have derivatives by time.
trait Moving {
    fn derivative(self, order: Order) -> Option<f64>;
}

impl Moving for f64 {
    fn derivative(self, order: Order) -> Option<f64> {
        (order == Order::Value).then_some(self)
    }
}

impl Moving for Dual<f64> {
    fn derivative(self, order: Order) -> Option<f64> {
        match order {
            Order::Value => Some(self.value),
            Order::Velocity => Some(self.slope),
            Order::Acceleration => None,
        }
    }
}

impl Moving for Dual<Dual<f64>> {
    fn derivative(self, order: Order) -> Option<f64> {
        Some(match order {
            Order::Value => self.value.value,
            Order::Velocity => self.slope.value,
            Order::Acceleration => self.slope.slope,
        })
    }
}
