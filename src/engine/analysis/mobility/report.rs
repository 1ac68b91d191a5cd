//! Report on the freedoms of a mechanism.

use serde::{Deserialize, Serialize};

use super::loops::LoopCount;
use super::redundancy::Redundancy;
use crate::mechanism::Variable;
use crate::system::{ByName, GivenPose, TwistSpace};

/// Mobility of an assembled mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MobilityReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joint variables with their units, in the order of the file.
    pub variables: Vec<Variable>,
    /// Names of the locked coordinates: everything else in the report is about the mechanism in which these stand
    /// still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub locked: Vec<String>,
    /// Finite freedoms at the configuration without local ones: the largest dimension of a branch.
    pub mobility: usize,
    /// Kutzbach's count: variables that are not locked and 6 for each platform less closure equations.
    pub kutzbach: i64,
    /// Rank of the closure Jacobian with nothing held but the locked coordinates.
    pub rank: usize,
    /// Infinitesimal freedoms without local ones.
    pub infinitesimal: usize,
    /// Closure equations that depend on the others.
    pub redundant: usize,
    /// Joints that stand still in every finite motion, or move in local freedoms only.
    pub idle_joints: Vec<String>,
    /// Idle joints that spin a link about its own axis.
    pub spinning_joints: Vec<String>,
    /// Joints in gimbal lock: they turn in place at the configuration and move links beside it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gimbal_locked_joints: Vec<String>,
    /// Number of freedoms lost in gimbal lock at the configuration.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gimbal_locked: usize,
    /// True if the freedoms were counted beside the configuration, which is singular in joint angles in gimbal lock.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub counted_beside: bool,
    /// Joints that move.
    pub moving_joints: Vec<String>,
    /// Joint values of the closed configuration, rad or m.
    pub joints: ByName<f64>,
    /// Kind of point of the configuration space.
    pub character: Character,
    /// The branches through a singular configuration, the first of very many.
    pub branches: Vec<BranchReport>,
    /// Number of branches found by steps in many directions.
    pub branch_count: usize,
    /// True if there are certainly no more branches.
    pub branches_complete: bool,
    /// Other assemblies with another mobility.
    pub elsewhere: Vec<Elsewhere>,
    /// Random starts from which one was sought.
    pub elsewhere_starts: usize,
    /// Joint variables and six for each platform.
    pub unknowns: usize,
    /// Closure equations, and one for each coordinate of a platform that is locked by itself.
    pub equations: usize,
    /// Number of equations that lock coordinates of platforms.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub locking: usize,
    /// Local (passive) freedoms: a link turns about its own axis and nothing else moves.
    pub idle_freedoms: Vec<LocalFreedom>,
    /// Kutzbach's count loop by loop.
    pub loops: Vec<LoopCount>,
    /// The dependent equations as wrenches.
    pub redundancies: Vec<Redundancy>,
    /// Infinitesimal motions of the platforms, or of the links at the closures if there are none.
    pub twists: Vec<TwistSpace>,
    /// Condition number of the dimensionless Jacobian over its rank.
    pub condition: f64,
    /// About how far a singular configuration is where a regular one is nearer to it than the
    /// length of a step, in rad and normalising lengths: to first order, along the motions.
    pub singular_at: Option<f64>,
    /// The largest singular value that counts as zero, relative to the largest, where the configuration is a singular
    /// one only
    /// to within the rank tolerance; none where what counts as zero is rounding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neglected: Option<f64>,
    /// The characteristic length that makes it dimensionless, in m.
    #[serde(rename = "normalising_length")]
    pub length: f64,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
    /// Residual of the closure equations after a finite step, dimensionless; `None` if the step does not settle.
    pub gap_after_step: Option<f64>,
    /// True if the work was stopped early: branches and other assemblies may be missing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// Kind of a point of the configuration space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Character {
    /// No freedom, not even an infinitesimal one.
    Structure,
    /// Every infinitesimal freedom is finite.
    Regular,
    /// Infinitesimal freedoms, none of them finite.
    Shaky,
    /// One branch with fewer freedoms than the infinitesimal ones.
    Singular,
    /// Several branches of the same number of freedoms meet.
    Bifurcation,
    /// Branches of different numbers of freedoms meet (Wohlhart 1996).
    Kinematotropic,
}

/// A local (passive) freedom: a link turns about its own axis and nothing else moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum LocalFreedom {
    /// The link turns in joints of its own, which these are.
    Joints(Vec<String>),
    /// The link is a platform on closures, which turns in joints too if it has some.
    Platforms {
        /// The platform, or those that turn together.
        platforms: Vec<String>,
        /// The joints that turn with it.
        joints: Vec<String>,
    },
    /// The rod of a `Distance` turns in the balls at its ends, which the closure does not model.
    Rod(String),
}

impl LocalFreedom {
    /// True if the joint turns in the freedom.
    pub(super) fn moves(&self, joint: &String) -> bool {
        match self {
            LocalFreedom::Joints(joints) | LocalFreedom::Platforms { joints, .. } => {
                joints.contains(joint)
            }
            LocalFreedom::Rod(_) => false,
        }
    }
}

/// A branch of assembled configurations through the one given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BranchReport {
    /// Its freedoms.
    pub mobility: usize,
    /// Joints that move on it.
    pub moving_joints: Vec<String>,
    /// Its motions at the configuration, as for the whole.
    pub twists: Vec<TwistSpace>,
    /// True if these motions are a curved cone, of which `twists` is the span: not every motion in it is possible.
    pub cone: bool,
    /// True if `twists` are known to about the length of a step only: the branch is shaky throughout.
    pub approximate: bool,
}

/// An assembly of another mobility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Elsewhere {
    /// Its freedoms.
    pub mobility: usize,
    /// Joint values there, rad or m.
    pub joints: ByName<f64>,
}

/// True for a count that is left out of a report.
#[allow(clippy::trivially_copy_pass_by_ref)] // serde passes it so
fn is_zero(number: &usize) -> bool {
    *number == 0
}
