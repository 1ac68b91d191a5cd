//! Report on a mechanism file.

use serde::{Deserialize, Serialize};

use super::count::MobilityCount;
use super::loops::Loop;
use crate::algebra::SiUnit;
use crate::description::{AxesDescription, axes_text};
use crate::mechanism::{ClosureKind, Convention, JointKind, Role};

/// Overview of a mechanism file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Overview {
    /// Name of the mechanism.
    #[serde(rename = "mechanism")]
    pub name: String,
    /// Its source in the literature.
    pub source: Option<String>,
    /// The joint coordinates from which the tables were made, if they were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinates: Option<CoordinatesOverview>,
    /// The parameters.
    pub parameters: Vec<ParameterOverview>,
    /// The joints.
    pub joints: Vec<JointOverview>,
    /// The chains with their tables.
    pub chains: Vec<ChainOverview>,
    /// The platforms.
    pub platforms: Vec<PlatformOverview>,
    /// The closures.
    pub closures: Vec<ClosureOverview>,
    /// The bodies, ground first.
    #[serde(default)]
    pub bodies: Vec<BodyOverview>,
    /// Independent loops.
    pub loops: Vec<Loop>,
    /// Freedoms expected by count.
    pub count: MobilityCount,
    /// The closed forms.
    pub closed_forms: Vec<ClosedFormOverview>,
    /// Warnings about the file, one sentence each.
    pub warnings: Vec<String>,
}

/// Joint coordinates, with the choices made in writing tables of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoordinatesOverview {
    /// The file of joint coordinates, serialised as its text.
    #[serde(rename = "file", with = "axes_text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub axes: AxesDescription,
    /// The joints that are cut, besides balls and rods.
    pub cut: Vec<String>,
    /// Bodies with nothing but two balls, taken for rods.
    pub rods: Vec<String>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterOverview {
    /// Its name.
    pub name: String,
    /// Its definition.
    pub definition: String,
    /// Its value, in m or rad or without unit.
    pub value: f64,
}

/// A joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointOverview {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: JointUse,
    /// Actuated or passive.
    pub role: Role,
    /// Unit of its values, rad or m; none if it is unused.
    pub unit: Option<SiUnit>,
    /// Its value in the home configuration, rad or m.
    pub home: f64,
    /// Lowest and highest value, rad or m.
    pub limits: Option<(f64, f64)>,
}

/// Kind of a joint variable by its use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum JointUse {
    /// The joint turns.
    Revolute,
    /// The joint slides.
    Prismatic,
    /// The joint turns and slides at once.
    Helical,
    /// The variable occurs nowhere.
    Unused,
}

impl JointUse {
    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            JointUse::Revolute => JointKind::Revolute.word(),
            JointUse::Prismatic => JointKind::Prismatic.word(),
            JointUse::Helical => JointKind::Helical.word(),
            JointUse::Unused => "unused",
        }
    }
}

/// A chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChainOverview {
    /// Its name.
    pub name: String,
    /// The frame it stands on.
    pub on: String,
    /// Convention of its rows.
    pub convention: Convention,
    /// Displacement from that frame to the chain's frame 0, as written.
    pub base: Vec<String>,
    /// The rows of its table.
    pub rows: Vec<RowOverview>,
    /// Displacement from its last link frame to its tip, as written.
    pub tip: Vec<String>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RowOverview {
    /// Twist.
    pub alpha: EntryOverview,
    /// Length.
    pub a: EntryOverview,
    /// Offset.
    pub d: EntryOverview,
    /// Joint angle.
    pub theta: EntryOverview,
    /// Turn about y behind the twist, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta: Option<EntryOverview>,
}

/// An entry of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EntryOverview {
    /// As written in the file.
    pub written: String,
    /// Its value (rad or m), if no joint variable stands in it.
    pub value: Option<f64>,
    /// True if parameters stand in it, so that the value says more than the entry as written.
    pub uses_parameters: bool,
}

/// A platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlatformOverview {
    /// Its name.
    pub name: String,
    /// Position of its origin at home (m).
    pub position: [f64; 3],
    /// Its orientation at home, scalar part first.
    pub quaternion: [f64; 4],
    /// Its orientation at home: roll, pitch, yaw (rad), Rz(yaw)·Ry(pitch)·Rx(roll).
    pub roll_pitch_yaw: [f64; 3],
    /// Frames fixed in it, as written.
    pub frames: Vec<PlatformFrameOverview>,
}

/// A frame of a platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlatformFrameOverview {
    /// Its name.
    pub name: String,
    /// Its displacement in the platform, as written.
    pub placed: Vec<String>,
}

/// A closure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosureOverview {
    /// Its name.
    pub name: String,
    /// The kind of joint.
    pub kind: ClosureKind,
    /// The frames it joins.
    pub frames: [String; 2],
    /// Its length, if it is a `Distance`.
    pub length: Option<String>,
    /// Number of its equations.
    pub equations: usize,
}

/// A body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BodyOverview {
    /// Its name, which is that of a frame on it.
    pub name: String,
    /// The joints and closures that join it to others.
    pub joints: Vec<String>,
    /// The other frames on it that have names of their own.
    pub frames: Vec<String>,
}

/// A closed form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosedFormOverview {
    /// Its name.
    pub name: String,
    /// Number of its entries of a pose, or of its identities.
    pub formulas: usize,
    /// The frame whose pose it gives and the frame this is seen from; none for identities.
    pub pose_of: Option<[String; 2]>,
    /// Publication in which it is printed.
    pub source: Option<String>,
}
