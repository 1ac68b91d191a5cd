//! Every node in every mode that reaches it, as a table.

use serde::de::Error;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::algebra::SiUnit;
use crate::mechanism::Variable;

/// A mapped coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

/// The indicators of a node in a mode, as in a [`Cell`].
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
    /// length; none if it is singular or not computed.
    pub condition: Option<f64>,
    /// The determinant of the rates of the inputs for those of what is mapped and held: zero at
    /// direct singularities. Dimensionless; none if it is not reported.
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
        let indicators = [
            Some(self.mode as f64),
            self.aspect.map(|aspect| aspect as f64),
            self.condition,
            self.direct,
            self.inverse,
        ];
        let values = self.joints.iter().chain(self.following);
        let mapped = self.at.iter().copied().map(Some);
        mapped.chain(indicators).chain(values.copied().map(Some))
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

/// Mode, aspect, condition and the two determinants: numbers of a row.
const INDICATORS: usize = 5;

/// The values one after another: what they are is not known before they are
/// `arranged`.
impl<'de> Deserialize<'de> for Cells {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Table {
            columns: Vec<Variable>,
            values: Vec<Vec<Option<f64>>>,
        }
        let Table { columns, values } = Table::deserialize(deserializer)?;
        if values.iter().any(|row| row.len() != columns.len()) {
            return Err(D::Error::custom("a row has too few or too many values"));
        }
        let values = values.into_iter().flatten();
        let values = values.map(|value| value.unwrap_or(f64::NAN)).collect();
        let heads = Vec::new();
        Ok(Cells {
            columns,
            widths: [0; 3],
            parts: vec![Part { heads, values }],
        })
    }
}

impl Cells {
    /// Cells that were just deserialised, with what their values are; `None` if they cannot be that.
    pub(crate) fn arranged(self, widths: [usize; 3], axes: &[AxisReport]) -> Option<Self> {
        let Cells { columns, parts, .. } = self;
        if widths.iter().sum::<usize>() + INDICATORS != columns.len() {
            return None;
        }
        let mut part = Part::default();
        let rows = parts.iter();
        for row in rows.flat_map(|part| part.values.chunks_exact(columns.len())) {
            let (at, rest) = row.split_at(widths[0]);
            let (indicators, rest) = rest.split_at(INDICATORS);
            let count = |x: f64| (x.is_finite() && x >= 0.0).then_some(x as usize);
            let known = |x: f64| (!x.is_nan()).then_some(x);
            // the first coordinate runs fastest
            let mut node = 0;
            for (x, axis) in at.iter().zip(axes).rev() {
                let part = (x - axis.from) / (axis.to - axis.from);
                let place = (part * axis.nodes.saturating_sub(1) as f64).round();
                node = node * axis.nodes + count(place)?;
            }
            part.heads.push(Head {
                node,
                mode: count(indicators[0])?,
                aspect: count(indicators[1]),
                condition: known(indicators[2]),
                direct: known(indicators[3]),
                inverse: known(indicators[4]),
            });
            part.values.extend(at.iter().chain(rest));
        }
        let parts = vec![part];
        Some(Cells {
            columns,
            widths,
            parts,
        })
    }

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
