//! Twists of frames from the rates of all unknowns.

use std::collections::HashMap;

use crate::geometry::{Axis, Vector3};
use crate::mechanism::{Configuration, Dimensions, Frame, Kinematics, Mover, Placement, Point};
use crate::number::Number;
use crate::system::{Places, Unknown};

/// The motion of a frame at an instant, in ground, at its origin or another point of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<T> {
    /// Rotation rate, in rad per unit of time.
    pub omega: Vector3<T>,
    /// Velocity of the point, in m per unit of time.
    pub velocity: Vector3<T>,
}

impl Twist<f64> {
    /// (ω; v/L) of the point of the body at the origin of ground; `point` is where the twist's point is.
    pub fn at_ground(&self, point: &Vector3<f64>, length: f64) -> [f64; 6] {
        let velocity = self.velocity - self.omega.cross(point);
        let ([a, b, c], [x, y, z]) = (self.omega.0, velocity.times(1.0 / length).0);
        [a, b, c, x, y, z]
    }
}

/// Twists of chosen frames at chosen points for rates of all joints and platforms, in dimensionless unknowns.
///
/// ω = Σ z q̇ and v = Σ z × (p − o) q̇ (or z q̇ for a slide) over the joints on the way to the frame,
/// beside the twist of the platform that carries it.
#[derive(Clone, Debug)]
pub struct FrameTwists<T> {
    kinematics: Kinematics<T>,
    plans: Vec<Plan<T>>,
    length: f64,
}

#[derive(Clone, Debug)]
struct Plan<T> {
    point: Point,
    /// Joints on the way with the columns of their rates.
    movers: Vec<(Mover<T>, usize)>,
    /// The platform that carries it and the column of its first twist component.
    platform: Option<(usize, usize)>,
}

impl<T: Number> FrameTwists<T> {
    /// For points, or origins of frames, of a mechanism whose unknowns are all free, in the given order.
    pub fn new(
        dimensions: &Dimensions<T>,
        unknowns: &[Unknown],
        points: &[impl Copy + Into<Point>],
    ) -> Self {
        let points: Vec<Point> = points.iter().map(|&point| point.into()).collect();
        let kinematics = Kinematics::new(dimensions, points.iter().map(|point| point.frame));
        let places = Places::new(unknowns);
        let column = |unknown| places.of(unknown);
        let plans = points.into_iter().map(|point| {
            let slot = kinematics
                .slot(point.frame)
                .expect("the plan was made for it");
            let (movers, platform) = kinematics.movers(slot, &dimensions.joint_scales);
            Plan {
                point,
                movers: (movers.into_iter())
                    .filter_map(|mover| Some((mover, column(Unknown::Joint(mover.joint))?)))
                    .collect(),
                platform: platform
                    .and_then(|platform| Some((platform, column(Unknown::first_twist(platform))?))),
            }
        });
        FrameTwists {
            plans: plans.collect(),
            length: dimensions.characteristic_length,
            kinematics,
        }
    }

    /// The frames.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = Frame> {
        self.plans.iter().map(|plan| plan.point.frame)
    }

    /// The places of the frames in their order.
    pub fn places(&self) -> HashMap<Frame, usize> {
        self.frames().zip(0..).collect()
    }

    /// Room for poses.
    pub fn placement(&self) -> Placement<T> {
        self.kinematics.placement()
    }

    /// Multiplies the chains out at a configuration. Nothing allocates.
    pub fn place(&self, at: &Configuration<T>, placement: &mut Placement<T>) {
        self.kinematics.place(at, placement);
    }

    /// The chains multiplied out at a configuration.
    pub fn placed(&self, at: &Configuration<T>) -> Placement<T> {
        let mut placement = self.placement();
        self.place(at, &mut placement);
        placement
    }

    /// Point `i`, in ground, in m.
    pub fn origin(&self, i: usize, placement: &Placement<T>) -> Vector3<T> {
        let point = &self.plans[i].point;
        let pose = self.kinematics.pose(point.frame, placement);
        point.placed(pose.expect("the plan was made for it"))
    }

    /// The z axis of the frame of point `i`, in ground.
    pub fn axis(&self, i: usize, placement: &Placement<T>) -> Vector3<T> {
        let pose = self.kinematics.pose(self.plans[i].point.frame, placement);
        pose.expect("the plan was made for it")
            .rotation
            .column(Axis::Z)
    }

    /// The twist at point `i`. Nothing allocates.
    pub fn twist(&self, i: usize, placement: &Placement<T>, rates: &[T]) -> Twist<T> {
        let Plan {
            movers, platform, ..
        } = &self.plans[i];
        let point = self.origin(i, placement);
        let mut twist = Twist {
            omega: Vector3::zero(),
            velocity: Vector3::zero(),
        };
        for (mover, column) in movers {
            let (omega, velocity) = placement.twist(mover, &point);
            twist.omega += omega.times(rates[*column]);
            twist.velocity += velocity.times(rates[*column]);
        }
        if let Some((platform, first)) = *platform {
            let omega = Vector3([rates[first], rates[first + 1], rates[first + 2]]);
            let shift = [3, 4, 5].map(|k| rates[first + k].scale(self.length));
            let arm = point - placement.pose(1 + platform).position;
            twist.omega += omega;
            twist.velocity += Vector3(shift) + omega.cross(&arm);
        }
        twist
    }
}
