//! Every node in every mode that reaches it, as a table.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::filled::Band;
use super::map::{Map, bring};
use super::report::AxisReport;
use crate::mechanism::Coordinate;
use crate::solve::each;

/// A table of nodes in modes, sorted by nodes and modes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Mapped coordinates, joints and coordinates that follow in a row.
    pub(super) widths: [usize; 3],
    pub(super) parts: Vec<Part>,
}

/// Some rows of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Part {
    pub heads: Vec<Head>,
    /// The mapped coordinates, the joints and the coordinates that follow of one row after another.
    pub values: Vec<f64>,
}

/// What is told of a node in a mode, as in a [`Cell`].
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Head {
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

impl Cell<'_> {
    /// The cell as a row of numbers; an aspect that is missing stands for a node outside limits or
    /// on a singularity.
    pub fn row(&self) -> Vec<Option<f64>> {
        let mut row: Vec<Option<f64>> = self.at.iter().copied().map(Some).collect();
        row.push(Some(self.mode as f64));
        row.push(self.aspect.map(|aspect| aspect as f64));
        row.extend([self.condition, self.direct, self.inverse]);
        row.extend(self.joints.iter().chain(self.following).copied().map(Some));
        row
    }
}

impl Serialize for Cells {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter().map(|cell| cell.row()))
    }
}

/// What is told of a node stands in so many numbers of a row.
const TOLD: usize = 5;

impl<'de> Deserialize<'de> for Cells {
    /// As one value after another: what they are is not known until they are [`arranged`](Cells::arranged).
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let rows = Vec::<Vec<Option<f64>>>::deserialize(deserializer)?;
        let width = rows.first().map_or(0, Vec::len);
        let values = rows.into_iter().flatten();
        let values = values.map(|value| value.unwrap_or(f64::NAN)).collect();
        let heads = Vec::new();
        Ok(Cells {
            widths: [width, 0, 0],
            parts: vec![Part { heads, values }],
        })
    }
}

impl Cells {
    /// Cells that were just deserialised, with what their values are; `None` if they cannot be that.
    pub(super) fn arranged(self, widths: [usize; 3], axes: &[AxisReport]) -> Option<Self> {
        let values: Vec<f64> = self
            .parts
            .into_iter()
            .flat_map(|part| part.values)
            .collect();
        let width = widths.iter().sum::<usize>() + TOLD;
        if values.len() % width != 0 || !values.is_empty() && self.widths[0] != width {
            return None;
        }
        let mut part = Part::default();
        for row in values.chunks_exact(width) {
            let (at, rest) = row.split_at(widths[0]);
            let (told, rest) = rest.split_at(TOLD);
            let number = |x: f64| (x.is_finite() && x >= 0.0).then_some(x as usize);
            let known = |x: f64| (!x.is_nan()).then_some(x);
            // the first coordinate runs fastest
            let mut node = 0;
            for (x, axis) in at.iter().zip(axes).rev() {
                let part = (x - axis.from) / (axis.to - axis.from);
                let place = (part * axis.nodes.saturating_sub(1) as f64).round();
                node = node * axis.nodes + number(place)?;
            }
            part.heads.push(Head {
                node,
                mode: number(told[0])?,
                aspect: number(told[1]),
                condition: known(told[2]),
                direct: known(told[3]),
                inverse: known(told[4]),
            });
            part.values.extend(at.iter().chain(rest));
        }
        let parts = vec![part];
        Some(Cells { widths, parts })
    }
}

impl Map<'_> {
    /// The table, given for the first sheet of each aspect its number.
    pub fn cells(&self, numbers: &[Option<usize>]) -> Cells {
        let following: Vec<(usize, Coordinate)> = self.following().collect();
        let (direct, inverse) = (self.asked.tells_direct(), self.asked.tells_inverse());
        let told = |x: f64, told: bool| told.then_some(x);
        let axes = self.grid.dimensions();
        let widths = [axes, self.asked.mechanism.joints().len(), following.len()];
        let width: usize = widths.iter().sum();
        let bands = self.filled.bands();
        let parts = each(bands.len(), &(), |(), i| {
            let first = bands[i].numbers.start;
            let rows = self.rows(&bands[i]);
            let mut places = vec![None; bands[i].numbers.len()];
            for (row, (s, mode)) in rows.iter().enumerate() {
                places[s - first] = Some((row, *mode));
            }
            let mut part = Part {
                heads: vec![Head::default(); rows.len()],
                values: vec![0.0; rows.len() * width],
            };
            // in the order in which they are kept: reading from everywhere takes longer than writing
            for (s, sheet, at) in self.filled.kept(&bands[i]) {
                let Some((row, mode)) = places[s - first] else {
                    continue;
                };
                let of = &sheet.told;
                part.heads[row] = Head {
                    node: sheet.node,
                    mode: mode + 1,
                    aspect: self.aspect[s].and_then(|first| numbers[first]),
                    condition: of.condition.is_finite().then_some(of.condition),
                    direct: told(of.direct, direct),
                    inverse: told(of.inverse, inverse),
                };
                let values = &mut part.values[row * width..][..width];
                let (mapped, values) = values.split_at_mut(axes);
                let (joints, values) = values.split_at_mut(widths[1]);
                mapped.copy_from_slice(&self.grid.point(sheet.node)[..axes]);
                joints.copy_from_slice(at.joints);
                bring(self.asked, joints, false);
                let mut values = values.iter_mut();
                for of_platform in following.chunk_by(|(a, _), (b, _)| a == b) {
                    let pose = at.platforms[of_platform[0].0].pose();
                    let all = Coordinate::all_of(&pose);
                    for ((_, c), value) in of_platform.iter().zip(&mut values) {
                        *value = all[*c as usize];
                    }
                }
            }
            part
        });
        Cells { widths, parts }
    }

    /// The sheets of a band that are in modes, in the order of their nodes and then of modes.
    fn rows(&self, band: &Band) -> Vec<(usize, usize)> {
        let all = band.numbers.clone();
        let mut rows: Vec<(usize, usize)> = all.filter_map(|s| Some((s, self.mode[s]?))).collect();
        let node = |s: usize| self.filled.node(s);
        for of_node in rows.chunk_by_mut(|(a, _), (b, _)| node(*a) == node(*b)) {
            of_node.sort_by_key(|(s, mode)| (*mode, *s));
        }
        rows
    }
}
