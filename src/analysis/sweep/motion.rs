//! Motions with the rows that are kept of them.

use serde::{Deserialize, Serialize};

use super::{Row, SweepReport};
use crate::algebra::SiUnit;
use crate::mechanism::{Mechanism, Point, Variable};

/// The motions of one question: one, or one in each mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionsReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// The motions.
    pub motions: Vec<MotionReport>,
}

/// A motion with its mode and the rows that are kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionReport {
    /// The number of the mode, if it was asked for.
    pub mode: Option<usize>,
    /// How it ended, in words; the output fills it in.
    pub sentence: String,
    /// What it came to.
    #[serde(flatten)]
    pub sweep: SweepReport,
    /// What the columns are: the number of the step, joints, platforms, traced points.
    pub columns: Vec<Variable>,
    /// The rows in SI units and rad; what is not known is `None`.
    pub values: Vec<Vec<Option<f64>>>,
}

/// What the columns of rows are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns(Vec<Variable>);

impl Columns {
    /// The number of the step, then all joints, platforms and traced points of a mechanism.
    pub fn new(mechanism: &Mechanism, points: &[Point]) -> Self {
        let mut variables = vec![Variable::plain("step")];
        variables.extend(Variable::joints(mechanism));
        variables.extend(Variable::poses(mechanism));
        for point in points {
            let (axes, name) = (["x", "y", "z"], point.name(mechanism));
            let variable = |axis| Variable::new(format!("{name}.{axis}"), SiUnit::METRE);
            variables.extend(axes.map(variable));
        }
        Columns(variables)
    }

    /// Their names and units.
    pub fn variables(&self) -> &[Variable] {
        &self.0
    }

    /// The values of a row in these columns, but for the number of the step.
    pub fn values<'a>(&self, row: &Row<'a>) -> impl Iterator<Item = f64> + use<'a> {
        let at = row.configuration;
        let poses = at.platforms.iter().flat_map(|platform| {
            let position = platform.position.0.into_iter();
            position.chain(platform.orientation.0)
        });
        let points = row.points.iter().flatten().copied();
        at.joints.iter().copied().chain(poses).chain(points)
    }
}

/// Rows that are kept: all, or no more than a number, evenly spread.
#[derive(Clone, Debug)]
pub struct KeptRows {
    rows: Vec<Vec<Option<f64>>>,
    most: usize,
    every: usize,
    seen: usize,
    last: Option<Vec<Option<f64>>>,
}

impl KeptRows {
    /// Keeps no more than this many rows, at least two.
    pub fn of(most: usize) -> Self {
        KeptRows {
            rows: Vec::new(),
            most: most.max(2),
            every: 1,
            seen: 0,
            last: None,
        }
    }

    /// Takes in a row.
    pub fn take(&mut self, columns: &Columns, row: &Row) {
        let values = columns.values(row);
        let values = values.map(|value| value.is_finite().then_some(value));
        let step = row.step.map(|step| step as f64);
        let values: Vec<Option<f64>> = std::iter::once(step).chain(values).collect();
        if self.seen.is_multiple_of(self.every) && self.rows.len() == self.most {
            // every second goes, and from now on twice as many are left out
            let mut keep = false;
            self.rows.retain(|_| {
                keep = !keep;
                keep
            });
            self.every *= 2;
        }
        self.last = match self.seen.is_multiple_of(self.every) {
            true => {
                self.rows.push(values);
                None
            }
            false => Some(values),
        };
        self.seen += 1;
    }

    /// The rows with the last one there was.
    pub fn finished(mut self) -> Vec<Vec<Option<f64>>> {
        self.rows.extend(self.last.take());
        self.rows
    }
}
