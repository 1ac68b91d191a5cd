//! Motion of frames for the rates and accelerations of all unknowns.

use super::super::twists::{FrameTwists, Twist};
use super::Motion;
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Mechanism, Placement, Point};
use crate::number::Dual;

/// How frames move: positions, twists and their rates of change.
#[derive(Clone, Debug)]
pub struct FrameMotions {
    twists: FrameTwists<Dual<f64>>,
    placement: Placement<Dual<f64>>,
    rates: Vec<Dual<f64>>,
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
    /// For points, or origins of frames, of a mechanism.
    pub fn new(mechanism: &Mechanism, motion: &Motion, points: &[impl Copy + Into<Point>]) -> Self {
        let dimensions = mechanism.dimensions().map(&mut Dual::constant);
        let twists = FrameTwists::new(&dimensions, motion.unknowns(), points);
        FrameMotions {
            placement: twists.placement(),
            rates: vec![Dual::constant(0.0); motion.unknowns().len()],
            twists,
        }
    }

    /// Places the frames for the rates and accelerations last computed. Nothing allocates.
    pub fn place(&mut self, motion: &mut Motion, at: &Configuration<f64>) {
        motion.follow_rates(at);
        self.twists.place(&motion.first_path, &mut self.placement);
        let both = motion.rates.iter().zip(&motion.accelerations);
        for (rate, (&value, &slope)) in self.rates.iter_mut().zip(both) {
            *rate = Dual { value, slope };
        }
    }

    /// The motion at point `i`. Nothing allocates.
    pub fn motion(&self, i: usize) -> FrameMotion {
        let twist = self.twists.twist(i, &self.placement, &self.rates);
        let value = |v: Vector3<Dual<f64>>| Vector3(v.0.map(|x| x.value));
        let slope = |v: Vector3<Dual<f64>>| Vector3(v.0.map(|x| x.slope));
        FrameMotion {
            position: value(self.twists.origin(i, &self.placement)),
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
