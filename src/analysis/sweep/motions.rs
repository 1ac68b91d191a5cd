//! Motions with the rows that are kept of them.

use serde::{Deserialize, Serialize};

use super::SweepReport;
use crate::system::{Column, Variable};

/// Motions of one mechanism, one for each mode that was asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionsReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joint variables with their units, in the order of the file.
    pub variables: Vec<Variable>,
    /// The motions.
    pub motions: Vec<MotionReport>,
}

/// One motion with its mode and the rows that are kept of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionReport {
    /// The number of the mode, if it was asked for.
    pub mode: Option<usize>,
    /// What it came to.
    #[serde(flatten)]
    pub report: SweepReport,
    /// The headings of the rows: the number of the step, joints, platforms, traced points.
    pub columns: Vec<Column>,
    /// Rows of numbers in the units of their columns; `None` for the step of a row between two.
    pub values: Vec<Vec<Option<f64>>>,
}
