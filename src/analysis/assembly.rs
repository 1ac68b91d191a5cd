//! The assembled configuration near a guess.

mod closest;
mod singular;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;

use crate::geometry::{Quaternion, Vector3};
use crate::linear::RANK_TOLERANCE;
use crate::mechanism::{Configuration, Frame, Joint, Mechanism, PlatformPose};
use crate::solve::{Equations, Newton, Report, Stop};
use crate::system::{
    Freedoms, Held, HeldPlatform, Holdable, Mobility, Question, QuestionError, System, Work,
};

/// How to look for an assembled configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblySettings {
    /// The iteration.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// A condition number above this is worth a warning: four digits of the joint values are lost.
    pub poor_condition: f64,
}

impl Default for AssemblySettings {
    fn default() -> Self {
        AssemblySettings {
            newton: Newton::default(),
            restarts: 40,
            seed: 1,
            poor_condition: 1e4,
        }
    }
}

/// How the search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Assembled.
    Converged,
    /// Assembled, but some joints are outside their limits.
    ConvergedOutsideLimits {
        /// Indices of those joints.
        joints: Vec<usize>,
    },
    /// Assembled at a singular configuration: something moves although all inputs are held.
    Singular {
        /// What can move: joints and platforms, by name, the most mobile first.
        moving: Vec<String>,
        /// Index of the closure whose equations depend on the others.
        closure: usize,
        /// Indices of the held joints that cannot drive the mechanism there.
        powerless: Vec<usize>,
    },
    /// No start assembles.
    CannotBeAssembled {
        /// Index of the closure with the widest gap at the closest approach.
        worst: usize,
        /// Whether the closest approach is a true local minimum of the gaps: no small motion comes
        /// closer.
        local_minimum: bool,
    },
    /// No start assembles, and none settled either.
    GaveUp {
        /// Index of the closure with the widest gap.
        worst: usize,
    },
}

/// How far a closure is from being whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Distance in m: between the origins, or what a `Distance` differs by, or along the blocked
    /// directions of a sliding joint.
    pub distance: f64,
    /// Angle in rad between the axes, or between the frames where no turn is allowed.
    pub angle: f64,
}

/// Where the search for an assembled configuration ended.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyReport {
    /// How it ended.
    pub outcome: Outcome,
    /// The assembled configuration, or the closest approach.
    pub configuration: Configuration<f64>,
    /// Newton steps of the start that succeeded.
    pub steps: usize,
    /// Random starts made after the guess.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// The largest closure row, dimensionless: lengths over the characteristic length, angles in
    /// rad.
    pub residual: f64,
    /// Ratio of the largest to the smallest singular value of the dimensionless Jacobian; infinite
    /// at a singular configuration.
    pub condition: f64,
    /// Whether the condition number is poor.
    pub near_singular: bool,
    /// For each closure how far it is from being whole.
    pub gaps: Vec<Gap>,
    /// Freedoms that only turn a link about its own line and do not matter.
    pub idle: usize,
    /// Whether held values were given that the mechanism can take by a smaller set only.
    pub count: Count,
}

/// What is held beside what the mechanism allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Freedoms of the mechanism, if it assembles near the start.
    pub mobility: Option<usize>,
    /// Coordinates held.
    pub held: usize,
}
