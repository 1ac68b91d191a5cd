//! Twists of frames from the rates of all unknowns.

use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Dimensions, Frame, Kinematics, Mover, Placement};
use crate::number::Number;
use crate::system::Unknown;

/// The motion of a frame at an instant, in ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<T> {
    /// Rotation rate, in rad per unit of time.
    pub omega: Vector3<T>,
    /// Velocity of the frame's origin, in m per unit of time.
    pub velocity: Vector3<T>,
}

impl Twist<f64> {
    /// (ω; v/L) of the point of the body at the origin of ground; `point` is the frame's origin.
    pub fn at_ground(&self, point: &Vector3<f64>, length: f64) -> [f64; 6] {
        let velocity = self.velocity - self.omega.cross(point);
        let ([a, b, c], [x, y, z]) = (self.omega.0, velocity.times(1.0 / length).0);
        [a, b, c, x, y, z]
    }
}

/// Twists of chosen frames for rates of all joints and platforms, in dimensionless unknowns.
///
/// ω = Σ z q̇ and v = Σ z × (p − o) q̇ (or z q̇ for a slide) over the joints on the way to the frame,
/// beside the twist of the platform it stands on.
#[derive(Clone, Debug)]
pub struct FrameTwists<T> {
    kinematics: Kinematics<T>,
    plans: Vec<Plan<T>>,
    length: f64,
}

#[derive(Clone, Debug)]
struct Plan<T> {
    frame: Frame,
    /// Joints on the way with the columns of their rates.
    movers: Vec<(Mover<T>, usize)>,
    /// The platform it stands on and the column of its first twist component.
    platform: Option<(usize, usize)>,
}

impl<T: Number> FrameTwists<T> {
    /// For frames of a mechanism whose unknowns are all free, in the given order.
    pub fn new(dimensions: &Dimensions<T>, unknowns: &[Unknown], frames: &[Frame]) -> Self {
        let kinematics = Kinematics::new(dimensions, frames.iter().copied());
        let column = |unknown| unknowns.iter().position(|u| *u == unknown);
        let plans = frames.iter().map(|&frame| {
            let slot = kinematics.slot(frame).expect("the plan was made for it");
            let (movers, platform) = kinematics.movers(slot, &dimensions.joint_scales);
            Plan {
                frame,
                movers: (movers.into_iter())
                    .filter_map(|mover| Some((mover, column(Unknown::Joint(mover.joint))?)))
                    .collect(),
                platform: platform.and_then(|platform| {
                    let first = Unknown::Twist {
                        platform,
                        component: 0,
                    };
                    Some((platform, column(first)?))
                }),
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
        self.plans.iter().map(|plan| plan.frame)
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

    /// The origin of frame `i` of those asked for, in ground, in m.
    pub fn origin(&self, i: usize, placement: &Placement<T>) -> Vector3<T> {
        let pose = self.kinematics.pose(self.plans[i].frame, placement);
        pose.expect("the plan was made for it").position
    }

    /// The twist of frame `i` of those asked for. Nothing allocates.
    pub fn twist(&self, i: usize, placement: &Placement<T>, rates: &[T]) -> Twist<T> {
        let Plan {
            frame,
            movers,
            platform,
        } = &self.plans[i];
        let pose = self.kinematics.pose(*frame, placement);
        let point = pose.expect("the plan was made for it").position;
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
