//! Joint axes → Denavit–Hartenberg tables, as a mechanism file.
//!
//! A serial chain is one table. Where the joints say which bodies they connect, closed loops are cut
//! (`loops.rs`), and the rest becomes chains (`chains.rs`).

mod build;
mod chains;
mod given;
mod loops;
mod values;

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::description::{
    AxesDescription, AxesProblem, AxisDescription, AxisKind, AxisPlace, Convention, Description,
    Displacement, Graph, Named, Problem, ProblemKind, axes_text, mechanism_text,
};
use crate::geometry::{Line, Pose, Relation};
use crate::mechanism::{FrameAssignment, Mechanism, Normal, TableRow};

use build::Build;
pub use given::{AxesError, joint_axes};

/// The most joints of one file of axes.
const MOST_JOINTS: usize = 1000;

/// Settings of frame placement.
#[derive(Clone, Debug, Default)]
pub struct FramesSettings {
    /// The convention of the tables; that of the file, or else the modified one.
    pub convention: Option<Convention>,
}

/// Tables for joint axes.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FramesReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// Convention of the rows of the tables.
    pub convention: Convention,
    /// The chains with their frames.
    pub chains: Vec<PlacedChain>,
    /// Cuts of loops, with those compared; `None` for a serial chain.
    pub cuts: Option<CutReport>,
    /// Largest angle in rad by which an axis or the tool differs from the one given.
    pub turned: f64,
    /// Largest distance in m by which an axis or the tool differs from the one given.
    pub moved: f64,
    /// The mechanism file, serialised as its text.
    #[serde(rename = "file", with = "mechanism_text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub description: Description,
    /// Warnings about the file of axes, with places in its text, which are not serialised.
    #[serde(skip)]
    pub warnings: Vec<Problem>,
}

/// The joint axes that the tables of a mechanism describe.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxesReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The file of joint axes, serialised as its text.
    #[serde(rename = "file", with = "axes_text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub axes: AxesDescription,
}

impl From<AxesDescription> for AxesReport {
    fn from(axes: AxesDescription) -> Self {
        AxesReport {
            mechanism: axes.name.value.clone(),
            axes,
        }
    }
}

/// A chain whose frames are placed.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedChain {
    /// Its name.
    pub name: String,
    /// The frame it stands on.
    pub on: String,
    /// The joints, one for each row.
    pub joints: Vec<String>,
    /// True if frame 0 is the frame it stands on or the base given.
    pub starts_at_base: bool,
    /// True if the last frame is the tool given.
    pub ends_at_tool: bool,
    /// The common normals N₀ … N_n that x₀ … x_n lie on.
    pub normals: Vec<PlacedNormal>,
    /// The rows, constant parts; home values are not serialised.
    pub rows: Vec<TableRow>,
    /// Frames 0 to n at home.
    pub frames: Vec<PlacedFrame>,
    /// The joint axes at home.
    pub axes: Vec<PlacedAxis>,
}

/// A common normal between consecutive axes.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedNormal {
    /// Relation of the axes; `None` at an end where nothing given fixes it.
    pub relation: Option<Relation>,
    /// Angle in rad between the axes as given.
    pub angle: f64,
    /// Distance in m between the axes as given.
    pub distance: f64,
    /// Its start, in m.
    pub from: [f64; 3],
    /// Its end, in m.
    pub to: [f64; 3],
    /// Unit vector along it.
    pub x: [f64; 3],
}

/// A frame at home, in ground.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedFrame {
    /// Its origin in m.
    pub position: [f64; 3],
    /// Its x axis.
    pub x: [f64; 3],
    /// Its y axis.
    pub y: [f64; 3],
    /// Its z axis.
    pub z: [f64; 3],
}

/// A joint axis at home, in ground.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedAxis {
    /// A point on it, in m.
    pub point: [f64; 3],
    /// Its direction.
    pub direction: [f64; 3],
    /// True if the joint slides along it.
    pub prismatic: bool,
}

/// Cuts of loops.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CutReport {
    /// The joints that were cut.
    pub cut: Vec<String>,
    /// True if the file named them.
    pub given: bool,
    /// The ways to cut that were compared, simplest first; the first is the one taken.
    pub ways: Vec<CutChoice>,
    /// True if there are more ways than were compared.
    pub more: bool,
}

/// A way to cut the loops.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CutChoice {
    /// Rows of the longest chain.
    pub longest: usize,
    /// Entries and displacements that are not zero, joint variables left out.
    pub entries: usize,
    /// Number of cut joints that are prismatic.
    pub prismatic: usize,
    /// The joints cut.
    pub cut: Vec<String>,
}

impl PlacedChain {
    /// The first `rows` rows of an assignment.
    fn of(name: String, on: String, joints: Vec<String>, made: &FrameAssignment) -> Self {
        let count = joints.len();
        let rows = &made.table.rows[..count];
        let normal = |normal: &Normal| PlacedNormal {
            relation: normal.relation,
            angle: normal.angle,
            distance: normal.distance,
            from: normal.feet[0].0,
            to: normal.feet[1].0,
            x: normal.x.0,
        };
        let frame = |pose: &Pose<f64>| {
            let [x, y, z] = pose.rotation.0.map(|column| column.0);
            PlacedFrame {
                position: pose.position.0,
                x,
                y,
                z,
            }
        };
        let axis = |(line, row): (&Line, &TableRow)| PlacedAxis {
            point: line.point.0,
            direction: line.direction.0,
            prismatic: row.turn == 0.0,
        };
        PlacedChain {
            name,
            on,
            starts_at_base: made.starts_at_base,
            ends_at_tool: made.ends_at_tool && made.table.rows.len() == count,
            normals: made.normals[..=count].iter().map(normal).collect(),
            rows: rows.to_vec(),
            frames: made.table.frames()[..=count].iter().map(frame).collect(),
            axes: made.axes.iter().zip(rows).map(axis).collect(),
            joints,
        }
    }
}

/// Places frames on joint axes and reads the tables off them.
///
/// # Errors
/// With all problems of the axes, in the order of the file.
pub fn frames(
    axes: &AxesDescription,
    settings: &FramesSettings,
) -> Result<FramesReport, Vec<Problem>> {
    let of_file = axes.convention.as_ref().map(|convention| convention.value);
    let convention = settings
        .convention
        .or(of_file)
        .unwrap_or(Convention::Modified);
    let unplaced = |joint: &&Named<AxisDescription>| {
        use AxisKind::{Prismatic, Revolute, Spherical};
        let part = &joint.value;
        let placed = matches!(part.kind, Revolute | Prismatic | Spherical);
        let frame = matches!(part.place, AxisPlace::Frame(_));
        !placed || frame || part.second.is_some() || part.value.is_some()
    };
    let unplaced = axes.joints.iter().filter(unplaced).map(|joint| {
        let name = joint.name.value.clone();
        AxesProblem::NotPlaced { joint: name }.at(&joint.name.span)
    });
    let unplaced: Vec<Problem> = unplaced.collect();
    if !unplaced.is_empty() {
        return Err(unplaced);
    }
    let closed = !axes.is_serial();
    if !closed {
        chains::check_serial(axes)?;
    }
    let values = values::Values::of(axes)?;
    let mut report = match closed {
        true => loops::closed(axes, &values, convention)?,
        false => {
            let (graph, cuts) = (Graph::of(axes)?, BTreeSet::new());
            Build::new(axes, &values, &graph, &cuts, convention).build()
        }
    };
    let mut warnings = values.warnings.clone();
    // entries keep their places in the file, and what is new cannot be wrong
    let mechanism = Mechanism::new(&report.description)?;
    let kept = |problem: &&Problem| matches!(problem.kind, ProblemKind::HomeOutsideLimits { .. });
    warnings.extend(mechanism.warnings().iter().filter(kept).cloned());
    let is_cut = |name: &str| {
        let mut cuts = report.cuts.iter().flat_map(|cuts| &cuts.cut);
        cuts.any(|cut| cut == name)
    };
    warnings.extend(axes.lost_by_cuts(is_cut));
    if let [chain] = &report.chains[..]
        && let Some(base) = axes.base.as_deref().filter(|_| !closed)
        && !chain.starts_at_base
    {
        let start = |step: &Displacement| Some(step.entries().first()?.span.start);
        let end = |step: &Displacement| Some(step.entries().last()?.span.end);
        let span = base.first().and_then(start).zip(base.last().and_then(end));
        let span = span.map_or(axes.name.span.clone(), |(start, end)| start..end);
        warnings.push(AxesProblem::BaseUnused { convention }.at(&span));
    }
    report.warnings = warnings;
    Ok(report)
}
