//! Rows that wait until their quantities are read.

use crate::analysis::sweep::{MetKind, Row};
use crate::mechanism::Configuration;

/// A row in storage that is used again.
pub(super) struct Waiting {
    pub at: Configuration<f64>,
    pub time: f64,
    number: usize,
    step: Option<usize>,
    points: Vec<[f64; 3]>,
    special: Option<MetKind>,
    between: bool,
}

impl Waiting {
    /// Storage for rows of a mechanism.
    pub fn new(at: &Configuration<f64>) -> Self {
        Waiting {
            at: at.clone(),
            time: 0.0,
            number: 0,
            step: None,
            points: Vec::new(),
            special: None,
            between: false,
        }
    }

    /// Keeps a row.
    pub fn put(&mut self, row: &Row, time: f64) {
        self.at.clone_from(row.configuration);
        self.time = time;
        (self.number, self.step, self.between) = (row.number, row.step, row.between);
        self.points.clear();
        self.points.extend_from_slice(row.points);
        self.special = row.special.cloned();
    }

    /// The row as it came.
    pub fn row(&self) -> Row<'_> {
        Row {
            number: self.number,
            step: self.step,
            points: &self.points,
            special: self.special.as_ref(),
            between: self.between,
            ..Row::of(&self.at)
        }
    }
}
