//! Where points and joints are, with derivatives by time.

use crate::geometry::{Pose, Vector3};
use crate::mechanism::{
    Configuration, Frame, Kinematics, Mechanism, Order, Placement, Point, PoseCoordinate,
};
use crate::number::Dual;
use crate::system::{FrameTwists, Held, Motion, System, Unknown};

/// Frames at a configuration.
pub(in super::super) struct Placed {
    kinematics: Kinematics<f64>,
    placement: Placement<f64>,
}

impl Placed {
    /// The frames of the closures and more.
    pub fn new(mechanism: &Mechanism, frames: &[Frame]) -> Self {
        let nothing = Held::nothing(mechanism);
        let system = System::placing(mechanism, mechanism.dimensions(), &nothing, frames);
        let kinematics = system.kinematics().clone();
        Placed {
            placement: kinematics.placement(),
            kinematics,
        }
    }

    pub fn kinematics(&self) -> &Kinematics<f64> {
        &self.kinematics
    }

    pub fn place(&mut self, at: &Configuration<f64>) {
        self.kinematics.place(at, &mut self.placement);
    }

    pub fn placement(&self) -> &Placement<f64> {
        &self.placement
    }

    pub fn pose(&self, point: Point) -> Pose<f64> {
        let pose = self.kinematics.pose(point.frame, &self.placement);
        let mut pose = *pose.expect("the kinematics was planned for the frames of all points");
        pose.position = point.placed(&pose);
        pose
    }
}

/// Points, how they move, and how that changes.
pub(super) struct Places {
    points: Vec<Point>,
    twists: FrameTwists<f64>,
    motions: Option<FrameTwists<Dual<f64>>>,
    scales: Vec<f64>,
}

/// Points and joints at a configuration.
pub(super) struct PlacesAt<'a> {
    pub places: &'a Places,
    pub at: &'a Configuration<f64>,
    pub placement: &'a Placement<f64>,
    pub motion: Option<&'a Motion>,
}

impl Places {
    /// `kinematics` and `motion` place the frames of all points.
    pub fn new(
        mechanism: &Mechanism,
        points: Vec<Point>,
        kinematics: &Kinematics<f64>,
        motion: Option<(&Motion, Order)>,
    ) -> Self {
        let unknowns: &[Unknown] = motion.map_or(&[], |(motion, _)| motion.unknowns());
        let changing = motion.filter(|(_, order)| *order == Order::Acceleration);
        let dimensions = mechanism.dimensions();
        Places {
            twists: FrameTwists::sharing(kinematics, dimensions, unknowns, &points),
            motions: changing.map(|(motion, _)| FrameTwists::moving(mechanism, motion, &points)),
            scales: dimensions.joint_scales.clone(),
            points,
        }
    }

    /// The number of a point.
    pub fn number(&self, point: Point) -> Option<usize> {
        self.points.iter().position(|known| *known == point)
    }
}

impl PlacesAt<'_> {
    pub fn joint(&self, joint: usize, order: Order) -> Option<f64> {
        let known = match order {
            Order::Value => return Some(self.at.joints[joint]),
            Order::Velocity => self.motion?.known()[0],
            Order::Acceleration => self.motion?.known()[1],
        };
        Some(known[joint] * self.places.scales[joint])
    }

    /// A coordinate of the point of that number, or of the orientation of its frame.
    pub fn coordinate(&self, i: usize, c: PoseCoordinate, order: Order) -> Option<f64> {
        if !c.is_angle() {
            return Some(self.vector(i, order)?.0[c as usize]);
        }
        let Places {
            twists, motions, ..
        } = self.places;
        match order {
            Order::Value => Some(c.of(twists.frame(i, self.placement))),
            Order::Velocity => {
                let turn = twists
                    .twist(i, self.placement, self.motion?.known()[0])
                    .omega;
                Some(c.turned(twists.frame(i, self.placement), &turn))
            }
            Order::Acceleration => {
                let (motions, (rates, placement)) = (motions.as_ref()?, self.motion?.changes());
                let turn = motions.twist(i, placement, rates).omega;
                Some(c.turned(motions.frame(i, placement), &turn).slope)
            }
        }
    }

    /// Where the point of that number is, or how it moves.
    pub fn vector(&self, i: usize, order: Order) -> Option<Vector3<f64>> {
        let Places {
            twists, motions, ..
        } = self.places;
        match order {
            Order::Value => Some(twists.origin(i, self.placement)),
            Order::Velocity => {
                let twist = twists.twist(i, self.placement, self.motion?.known()[0]);
                Some(twist.velocity)
            }
            Order::Acceleration => {
                let (rates, placement) = self.motion?.changes();
                let twist = motions.as_ref()?.twist(i, placement, rates);
                Some(Vector3(twist.velocity.0.map(|part| part.slope)))
            }
        }
    }
}
