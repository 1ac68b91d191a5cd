//! Points of bodies.

use super::{Configuration, Frame, Mechanism};
use crate::geometry::{Pose, Vector3};
use crate::number::Number;

/// A point fixed to a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The frame.
    pub frame: Frame,
    /// Where it is in the frame, in m.
    pub offset: [f64; 3],
}

impl From<Frame> for Point {
    fn from(frame: Frame) -> Self {
        let offset = [0.0; 3];
        Point { frame, offset }
    }
}

impl From<&Frame> for Point {
    fn from(frame: &Frame) -> Self {
        Point::from(*frame)
    }
}

impl From<&Point> for Point {
    fn from(point: &Point) -> Self {
        *point
    }
}

impl Point {
    /// Whether it is the origin of its frame.
    pub fn is_origin(&self) -> bool {
        self.offset == [0.0; 3]
    }

    /// Where it is when its frame has this pose.
    #[inline]
    pub fn placed<T: Number>(&self, pose: &Pose<T>) -> Vector3<T> {
        match self.is_origin() {
            true => pose.position,
            false => *pose * Vector3(self.offset.map(T::from_f64)),
        }
    }

    /// Where it is in ground, in m.
    pub fn at(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Vector3<f64> {
        self.placed(&mechanism.poses([self.frame], at)[0])
    }

    /// From the origin of its frame to it, in directions of ground, in m.
    pub fn arm(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> Vector3<f64> {
        match self.is_origin() {
            true => Vector3::zero(),
            false => mechanism.poses([self.frame], at)[0].rotation * Vector3(self.offset),
        }
    }

    /// As questions name it: `left`, or `left+0.5,0.2` with the offsets in m.
    pub fn name(&self, mechanism: &Mechanism) -> String {
        let frame = mechanism.frame_name(self.frame);
        let last = self.offset.iter().rposition(|x| *x != 0.0);
        let Some(last) = last else { return frame };
        let offsets = self.offset[..=last].iter().map(|x| (x + 0.0).to_string());
        format!("{frame}+{}", offsets.collect::<Vec<_>>().join(","))
    }
}
