//! Every node in every mode that reaches it, as a table.

use serde::de::Error;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::algebra::SiUnit;
use crate::mechanism::Variable;

/// A mapped coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxisReport {
    /// Its name.
    pub name: String,
    /// rad or m.
    pub unit: SiUnit,
    /// Its least value.
    pub from: f64,
    /// Its greatest value.
    pub to: f64,
    /// Nodes along it.
    pub nodes: usize,
}

/// A table of nodes in modes, sorted by nodes and modes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(inline, with = "WrittenCells"))]
pub struct Cells {
    /// Names and units of its columns, as in [`MapNode::values`].
    pub columns: Vec<Variable>,
    /// Mapped coordinates, joints and coordinates that follow in a row.
    pub(crate) widths: [usize; 3],
    pub(crate) parts: Vec<TablePart>,
}

/// Columns by name, and rows with a value or `null` in each: a table as it is written.
#[cfg(feature = "schema")]
#[derive(schemars::JsonSchema)]
#[allow(dead_code)]
struct WrittenCells {
    columns: Vec<String>,
    values: Vec<Vec<Option<f64>>>,
}

/// Some rows of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TablePart {
    /// The node of each row.
    pub nodes: Vec<usize>,
    /// The values of one row after another; infinite where one is missing, so that equal tables are equal.
    pub values: Vec<f64>,
}

/// Mode, aspect, condition and two determinants, between mapped coordinates and joints of a row.
pub(crate) const INDICATORS: usize = 5;

/// A node in a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapNode<'a> {
    /// The number of the node, the first coordinate running fastest.
    pub node: usize,
    /// The mapped coordinates, rad or m.
    pub at: &'a [f64],
    /// The mode.
    pub mode: usize,
    /// The aspect; none outside limits and on singularities.
    pub aspect: Option<usize>,
    /// The condition number of the Jacobian from inputs to outputs, normalised; none if singular.
    pub condition: Option<f64>,
    /// The determinant of the rates of the inputs for those of the mapped and held coordinates: zero at
    /// direct singularities. Dimensionless; none if it is not reported.
    pub direct: Option<f64>,
    /// The determinant of the rates of the outputs for those of the mapped and held coordinates: zero at inverse
    /// singularities. Dimensionless; none if it is not reported.
    pub inverse: Option<f64>,
    /// The joints, rad or m, in the order of the file.
    pub joints: &'a [f64],
    /// The coordinates of platforms that follow, rad or m.
    pub following: &'a [f64],
    row: &'a [f64],
}

impl MapNode<'_> {
    /// The values in the columns of its table: mapped coordinates, then mode, aspect, condition, the
    /// determinants of direct and inverse singularities, joints, coordinates that follow.
    pub fn values(&self) -> impl Iterator<Item = Option<f64>> {
        self.row.iter().copied().map(known)
    }
}

fn known(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// The columns, then the rows.
impl Serialize for Cells {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows: Vec<Vec<Option<f64>>> = self.iter().map(|cell| cell.values().collect()).collect();
        let mut table = serializer.serialize_struct("Cells", 2)?;
        table.serialize_field("columns", &self.columns)?;
        table.serialize_field("values", &rows)?;
        table.end()
    }
}

/// The rows as they stand: their columns are not known before they are `arranged`.
impl<'de> Deserialize<'de> for Cells {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct CellRows {
            columns: Vec<Variable>,
            values: Vec<Vec<Option<f64>>>,
        }
        let CellRows { columns, values } = CellRows::deserialize(deserializer)?;
        if values.iter().any(|row| row.len() != columns.len()) {
            return Err(D::Error::custom("a row has too few or too many values"));
        }
        let part = TablePart {
            nodes: vec![0; values.len()],
            values: (values.into_iter().flatten())
                .map(|value| value.unwrap_or(f64::INFINITY))
                .collect(),
        };
        Ok(Cells {
            columns,
            widths: [0; 3],
            parts: vec![part],
        })
    }
}

impl Cells {
    /// Cells that were just deserialised, with what their values are; `None` if they cannot be that.
    pub(crate) fn arranged(mut self, widths: [usize; 3], axes: &[AxisReport]) -> Option<Self> {
        let width = self.columns.len();
        if widths.iter().sum::<usize>() + INDICATORS != width {
            return None;
        }
        self.widths = widths;
        for part in &mut self.parts {
            for (node, row) in part.nodes.iter_mut().zip(part.values.chunks_exact(width)) {
                let count = |x: f64| (x.is_finite() && x >= 0.0).then_some(x as usize);
                count(row[axes.len()])?;
                // the first coordinate runs fastest
                for (x, axis) in row.iter().zip(axes).rev() {
                    let part = (x - axis.from) / (axis.to - axis.from);
                    let place = (part * axis.nodes.saturating_sub(1) as f64).round();
                    *node = *node * axis.nodes + count(place)?;
                }
            }
        }
        Some(self)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.parts.iter().map(|part| part.nodes.len()).sum()
    }

    /// True if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = MapNode<'_>> + Clone {
        let [axes, joints, _] = self.widths;
        let width = self.columns.len().max(1);
        let rows = (self.parts.iter())
            .flat_map(move |part| part.nodes.iter().zip(part.values.chunks_exact(width)));
        rows.map(move |(&node, row)| {
            let (at, rest) = row.split_at(axes);
            let (indicators, rest) = rest.split_at(INDICATORS);
            let (joints, following) = rest.split_at(joints);
            MapNode {
                node,
                at,
                mode: indicators[0] as usize,
                aspect: known(indicators[1]).map(|aspect| aspect as usize),
                condition: known(indicators[2]),
                direct: known(indicators[3]),
                inverse: known(indicators[4]),
                joints,
                following,
                row,
            }
        })
    }
}
