//! Points as questions name them.

use super::value::{ValueError, number};
use crate::algebra::Measure;
use crate::mechanism::{Mechanism, Point};

/// Why a text is not a point.
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

impl Point {
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
            *to = number(mechanism, text, Measure::Length).map_err(|error| PointError::Value {
                text: text.trim().into(),
                error,
            })?;
        }
        Ok(Point { frame, offset })
    }
}
