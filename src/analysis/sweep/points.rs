//! Points of bodies whose paths are traced.

use crate::algebra::Measure;
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Frame, Kinematics, Mechanism, Placement};
use crate::system::{ValueError, number_of};

/// A point fixed to a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedPoint {
    /// As it was asked for.
    pub name: String,
    /// The frame.
    pub frame: Frame,
    /// Where it is in the frame, in m.
    pub offset: [f64; 3],
}

/// Why a point cannot be traced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PointError {
    /// There is no frame of that name.
    #[error("there is no frame `{0}`")]
    NoFrame(String),
    /// An offset has no value.
    #[error("`{text}` cannot be an offset: {error}")]
    Value {
        /// The offset as given.
        text: String,
        /// Why.
        #[source]
        error: ValueError,
    },
    /// There are more than three offsets.
    #[error("a point has at most three offsets, along x, y and z, but {0} were given")]
    TooMany(usize),
}

impl TracedPoint {
    /// A frame's origin, `left`, or a point beside it in its own axes, `left+0.5,0.2,0`: offsets
    /// along x, y, z are expressions as in the file, and those left out are zero.
    ///
    /// # Errors
    /// If there is no such frame, or an offset has no value.
    pub fn read(mechanism: &Mechanism, text: &str) -> Result<Self, PointError> {
        let (name, offsets) = match text.split_once('+') {
            Some((name, offsets)) => (name.trim(), offsets.split(',').collect::<Vec<_>>()),
            None => (text.trim(), Vec::new()),
        };
        let frame = mechanism.frame(name);
        let frame = frame.ok_or_else(|| PointError::NoFrame(name.into()))?;
        if offsets.len() > 3 {
            return Err(PointError::TooMany(offsets.len()));
        }
        let mut offset = [0.0; 3];
        for (to, text) in offset.iter_mut().zip(offsets) {
            *to =
                number_of(mechanism, text, Measure::Length).map_err(|error| PointError::Value {
                    text: text.trim().into(),
                    error,
                })?;
        }
        Ok(TracedPoint {
            name: text.trim().into(),
            frame,
            offset,
        })
    }

    /// The offset as a vector, in m.
    pub fn vector(&self) -> Vector3<f64> {
        Vector3(self.offset)
    }
}

/// Where traced points are, without allocating.
pub(super) struct Paths {
    kinematics: Kinematics<f64>,
    placement: Placement<f64>,
    points: Vec<TracedPoint>,
    pub at: Vec<[f64; 3]>,
}

impl Paths {
    pub fn new(mechanism: &Mechanism, points: &[TracedPoint]) -> Self {
        let kinematics = Kinematics::new(mechanism.dimensions(), points.iter().map(|p| p.frame));
        Paths {
            placement: kinematics.placement(),
            kinematics,
            at: vec![[0.0; 3]; points.len()],
            points: points.to_vec(),
        }
    }

    pub fn place(&mut self, configuration: &Configuration<f64>) {
        if self.points.is_empty() {
            return;
        }
        self.kinematics.place(configuration, &mut self.placement);
        for (at, point) in self.at.iter_mut().zip(&self.points) {
            let pose = self.kinematics.pose(point.frame, &self.placement);
            let pose = pose.expect("the kinematics was planned for the points' frames");
            let [x, y, z] = pose.rotation.0;
            let [a, b, c] = point.offset;
            *at = (pose.position + x.times(a) + y.times(b) + z.times(c)).0;
        }
    }
}
