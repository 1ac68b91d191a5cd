//! Report of the search for an assembled configuration.

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::description::Role;
use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, PlatformPose};
use crate::system::{
    ByName, FrameRecord, Gap, Moved, PlatformRecord, infinite_if_null, is_origin, uncut,
};

/// Freedoms that the held coordinates leave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RemainingFreedoms {
    /// Number of freedoms.
    pub freedoms: usize,
    /// Coordinates that decide them if they are held too.
    pub hold: Vec<String>,
    /// Number of further freedoms, to first order only, at a singular configuration.
    pub singular: usize,
}

/// End of the search. Joints, platforms and closures are given by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum Outcome {
    /// Assembled.
    Converged,
    /// Assembled, but some joints are outside their limits.
    ConvergedOutsideLimits {
        /// Joints outside their limits.
        #[serde(rename = "outside_limits")]
        joints: Vec<String>,
    },
    /// Assembled at a singular configuration: something moves although all inputs are held.
    Singular {
        /// Joints and platforms that can move, the most mobile first.
        moving: Vec<String>,
        /// The closure whose equations depend on the others, if the mechanism has closures.
        #[serde(
            rename = "dependent_closure",
            default,
            skip_serializing_if = "Option::is_none"
        )]
        closure: Option<String>,
        /// The held joints that cannot drive the mechanism there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        powerless: Vec<String>,
    },
    /// No start assembles.
    CannotBeAssembled {
        /// The closure with the widest gap at the closest approach.
        worst: String,
        /// True if the closest approach is a true local minimum of the gaps.
        local_minimum: bool,
    },
    /// No start assembles, and none settled either.
    GaveUp {
        /// The closure with the widest gap.
        worst: String,
    },
}

/// A joint variable and its part in the question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointVariable {
    /// Its name.
    pub name: String,
    /// The unit of its values, rad or m.
    pub unit: SiUnit,
    /// Actuated or passive.
    pub role: Role,
    /// True if its value was given; false if it was solved for.
    pub held: bool,
    /// Lowest and highest value, rad or m, if it has limits.
    pub limits: Option<(f64, f64)>,
    /// True if its value is within them.
    pub within_limits: bool,
}

/// Result of the search for an assembled configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AssemblyReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// End of the search.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Newton steps of the start that succeeded.
    pub steps: usize,
    /// Random starts made after the guess.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// The largest closure residual, dimensionless (characteristic lengths and rad).
    pub residual: f64,
    /// Ratio of the largest to the smallest singular value of the dimensionless Jacobian, estimated beyond
    /// [`SPECTRUM_LIMIT`](crate::linear::SPECTRUM_LIMIT) unknowns; infinite, in JSON `null`, at a singular configuration.
    #[serde(deserialize_with = "infinite_if_null")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub condition: f64,
    /// True if the condition number is poor.
    pub near_singular: bool,
    /// Freedoms of the mechanism, if it assembles near the start.
    pub mobility: Option<usize>,
    /// Local (passive) freedoms: a link turns about its own axis.
    pub idle: usize,
    /// Freedoms left where they were, if less is held than the mechanism has freedoms: the configuration
    /// is then the one nearest to the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left: Option<RemainingFreedoms>,
    /// The joint or platform that moved most from its guess, or from a pose of the file that was more than rounded, if
    /// the mechanism assembles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<Moved>,
    /// Names of the held coordinates.
    pub held: Vec<String>,
    /// Those of them that the others determine: they are held where they would stand anyway.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub redundant: Vec<String>,
    /// Joint values of the assembled configuration, or of the closest approach, rad or m, those of joints at which loops
    /// are cut last.
    pub joints: ByName<f64>,
    /// The joints at which loops are cut.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut: Vec<String>,
    /// Values there of the outputs of the file that depend on joints alone, in SI units and rad.
    #[serde(default, skip_serializing_if = "ByName::is_empty")]
    pub outputs: ByName<f64>,
    /// Their units.
    #[serde(skip)]
    pub output_units: Vec<SiUnit>,
    /// Poses of the platforms there.
    pub platforms: ByName<PlatformRecord>,
    /// Tip frames of the chains and frames of the platforms there; of a file of joint coordinates, of the bodies and points
    /// that it names.
    pub frames: ByName<FrameRecord>,
    /// Position in ground, in m, from which a [configuration](AssemblyReport::configuration) measures positions: the
    /// origin unless the mechanism is far from it.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre: [f64; 3],
    /// Gap of each closure.
    pub gaps: ByName<Gap>,
    /// The joints, in the order of their values.
    pub variables: Vec<JointVariable>,
    /// True if rods count by (d² − L²)/2 over the square of the characteristic length, d being the distance of their
    /// ends and L their length, so that the configuration is not the one where Σ (d − L)² is least.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub squared_lengths: bool,
    /// Warnings about the file or the answer, one sentence each.
    pub warnings: Vec<String>,
    /// True if the search was stopped before all starts were made.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

impl AssemblyReport {
    /// The assembled configuration, or the closest approach.
    pub fn configuration(&self) -> Configuration<f64> {
        Configuration {
            joints: uncut(&self.joints, &self.cut),
            platforms: (self.platforms.values())
                .map(|platform| PlatformPose {
                    orientation: Quaternion(platform.frame.quaternion),
                    position: Vector3(platform.frame.position) - Vector3(self.centre),
                })
                .collect(),
        }
    }

    /// True if the configuration closes every loop.
    pub fn is_assembled(&self) -> bool {
        !matches!(
            self.outcome,
            Outcome::CannotBeAssembled { .. } | Outcome::GaveUp { .. }
        )
    }

    /// Warning about the configuration, if it is near a singular one.
    pub fn warning(&self) -> Option<String> {
        let singular = matches!(self.outcome, Outcome::Singular { .. });
        (self.near_singular && !singular).then(|| {
            format!(
                "near a singular configuration: the condition number is {:.1e}",
                self.condition
            )
        })
    }
}
