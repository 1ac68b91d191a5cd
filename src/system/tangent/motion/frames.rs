//! Motion of frames for the rates and accelerations of all unknowns.

use super::super::twists::{FrameTwists, Twist};
use super::Motion;
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Mechanism, Placement, Point};
use crate::number::Dual;

/// How frames move: positions, twists and their rates of change.
#[derive(Clone, Debug)]
pub struct FrameMotions {
    twists: FrameTwists<Dual<f64>>,
}

/// The motion of a frame in ground, to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameMotion {
    /// Where its point is, in m.
    pub position: Vector3<f64>,
    /// Its twist at the point.
    pub twist: Twist<f64>,
    /// Angular acceleration, and acceleration of the point.
    pub change: Twist<f64>,
}

impl FrameMotions {
    /// For points, or origins of frames, that a motion places.
    pub fn new(mechanism: &Mechanism, motion: &Motion, points: &[impl Copy + Into<Point>]) -> Self {
        let dimensions = mechanism.dimensions().map(&mut Dual::constant);
        let kinematics = motion.changing.system.kinematics();
        FrameMotions {
            twists: FrameTwists::sharing(kinematics, &dimensions, motion.unknowns(), points),
        }
    }

    /// The pose of the frame of point `i`, as it changes.
    pub fn frame<'a>(&self, i: usize, placement: &'a Placement<Dual<f64>>) -> &'a Pose<Dual<f64>> {
        self.twists.frame(i, placement)
    }

    /// The twist at point `i`, as it [changes](Motion::changes). Nothing allocates.
    pub fn twist(
        &self,
        i: usize,
        (rates, placement): (&[Dual<f64>], &Placement<Dual<f64>>),
    ) -> Twist<Dual<f64>> {
        self.twists.twist(i, placement, rates)
    }

    /// The motion at point `i`, as it [changes](Motion::changes). Nothing allocates.
    pub fn motion(&self, i: usize, changes: (&[Dual<f64>], &Placement<Dual<f64>>)) -> FrameMotion {
        let twist = self.twist(i, changes);
        let value = |v: Vector3<Dual<f64>>| Vector3(v.0.map(|x| x.value));
        let slope = |v: Vector3<Dual<f64>>| Vector3(v.0.map(|x| x.slope));
        FrameMotion {
            position: value(self.twists.origin(i, changes.1)),
            twist: Twist {
                omega: value(twist.omega),
                velocity: value(twist.velocity),
            },
            change: Twist {
                omega: slope(twist.omega),
                velocity: slope(twist.velocity),
            },
        }
    }
}
