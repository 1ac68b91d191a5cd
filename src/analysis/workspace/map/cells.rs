//! Every node in every mode that reaches it, as a table.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::mechanism::Variable;

/// A table of nodes in modes, sorted by nodes and modes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// What the columns of its rows are: see [`Cell::values`].
    pub columns: Vec<Variable>,
    /// Mapped coordinates, joints and coordinates that follow in a row.
    pub(crate) widths: [usize; 3],
    pub(crate) parts: Vec<Part>,
}

/// Some rows of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Part {
    pub heads: Vec<Head>,
    /// The mapped coordinates, the joints and the coordinates that follow of one row after another.
    pub values: Vec<f64>,
}

/// What is told of a node in a mode, as in a [`Cell`].
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Head {
    pub node: usize,
    pub mode: usize,
    pub aspect: Option<usize>,
    pub condition: Option<f64>,
    pub direct: Option<f64>,
    pub inverse: Option<f64>,
}

/// A node in a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<'a> {
    /// The number of the node, the first coordinate running fastest.
    pub node: usize,
    /// The mapped coordinates, rad or m.
    pub at: &'a [f64],
    /// The mode.
    pub mode: usize,
    /// The aspect; none outside limits and on singularities.
    pub aspect: Option<usize>,
    /// The condition number of the Jacobian from inputs to outputs, lengths over the normalising
    /// length; none if it is singular or not told.
    pub condition: Option<f64>,
    /// The determinant of the rates of the inputs for those of what is mapped and held: zero at
    /// direct singularities. Dimensionless; none if it is not told.
    pub direct: Option<f64>,
    /// The same for outputs: zero at inverse singularities.
    pub inverse: Option<f64>,
    /// The joints, rad or m, in the order of the file.
    pub joints: &'a [f64],
    /// The coordinates of platforms that follow, rad or m.
    pub following: &'a [f64],
}

impl Cell<'_> {
    /// The values in the columns of its table: what is mapped, then mode, aspect, condition, the
    /// determinants of direct and inverse singularities, joints, coordinates that follow. An aspect
    /// is missing outside limits and on singularities.
    pub fn values(&self) -> impl Iterator<Item = Option<f64>> {
        let told = [
            Some(self.mode as f64),
            self.aspect.map(|aspect| aspect as f64),
            self.condition,
            self.direct,
            self.inverse,
        ];
        let values = self.joints.iter().chain(self.following);
        let mapped = self.at.iter().copied().map(Some);
        mapped.chain(told).chain(values.copied().map(Some))
    }
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

impl Cells {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.parts.iter().map(|part| part.heads.len()).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = Cell<'_>> + Clone {
        let [axes, joints, following] = self.widths;
        let rows = self.parts.iter().flat_map(move |part| {
            let values = part.values.chunks_exact(axes + joints + following);
            part.heads.iter().zip(values)
        });
        rows.map(move |(head, values)| {
            let (at, values) = values.split_at(axes);
            let (joints, following) = values.split_at(joints);
            let Head {
                node,
                mode,
                aspect,
                condition,
                direct,
                inverse,
            } = *head;
            Cell {
                node,
                at,
                mode,
                aspect,
                condition,
                direct,
                inverse,
                joints,
                following,
            }
        })
    }
}
