//! The valid, immutable mechanism, and its kinematics over any number.

mod ball_rows;
mod build;
mod centre;
mod closure;
mod configuration;
mod coordinate;
mod cut_joints;
mod dimensions;
mod follower;
mod frames;
mod inspect;
mod kinematics;
mod letters;
mod lift;
mod linkage;
mod loads;
mod loops;
mod model;
mod names;
mod parameters;
mod plane;
mod point;
mod quantity;
mod record;
mod recut;
mod relation;
mod rounded;
mod section;
mod serial_axes;
mod turns;
mod value;
mod vanishing;
mod variable;

pub use configuration::{Configuration, ConfigurationRef, PlatformPose};
pub use coordinate::PoseCoordinate;
pub use cut_joints::{ClosingJoint, ClosingValues};
pub use dimensions::{ChainDimensions, ClosureDimensions, Dimensions, LinearForm, RowDimensions};
pub use follower::FollowingOutput;
pub use frames::Body;
pub use kinematics::{Kinematics, Placement};
pub use linkage::{Connection, Connector, FundamentalLoop, Linkage};

pub use loads::{Along, Friction, GivenEffort, GivenForce, GivenValue, Loads, Mass, Spring};
pub use point::{NamedPoint, Point, PointError};
pub use record::{ByName, FormulaNames, FrameRecord, PlatformRecord};
pub use relation::JointRelation;

pub use ball_rows::LockedBall;
pub use quantity::{
    Carrier, Effort, Energy, Figure, Measured, Order, Quantity, QuantityError, ScrewPart, Worker,
};
pub use rounded::{NumberChange, Rounded, Rounding};
pub use value::{Value, ValueError, number_of};
pub use variable::Variable;

pub use serial_axes::{DhTable, FrameAssignment, JointAxis, Normal, SerialAxes, TableRow};

pub use crate::description::{ClosureKind, Convention, MatrixEntry, Role};
pub use model::{
    Chain, ChainRow, ClosedForm, Closure as NamedClosure, FixedStep, Formula, GivenForm, Joint,
    JointKind, Parameter, Platform, Symbol,
};

use std::sync::{Arc, OnceLock};

use crate::description::{JointCoordinates, LoadsDescription, Problem};

pub use closure::{ClosureEquations, EVERY_ROW, Kept, Side, needs};
pub use coordinate::orientation_rows;
pub use cut_joints::joint_values;
pub use kinematics::{KinematicsCourse, Mover, Need};
pub use letters::{Formal, Letters};
pub use recut::Recut;
pub use turns::{principal, turn_near, turns, turns_to_repeat};

/// A valid mechanism. It is immutable; its existence proves that its description is meaningful. Copies share what does not
/// depend on the values of parameters.
#[derive(Clone, Debug)]
pub struct Mechanism {
    name: String,
    source: Option<String>,
    parameters: Vec<Parameter>,
    joints: Vec<Joint>,
    chains: Arc<Vec<Chain>>,
    platforms: Vec<Platform>,
    closures: Arc<Vec<model::Closure>>,
    closed_forms: Arc<Vec<ClosedForm>>,
    outputs: Arc<Vec<Quantity>>,
    homes: Arc<model::Homes>,
    loads: Arc<Loads>,
    /// As the file has it.
    loads_file: Arc<LoadsDescription>,
    /// The variables of closures that are not among the joints.
    closing: Arc<[ClosingJoint]>,
    /// Numbers of chains and closures of the file; those that make points, frames and closures joints come after them.
    own: [usize; 2],
    /// Number of unknowns, and of independent equations, added to those of the file.
    added_unknowns: usize,
    dimensions: Arc<Dimensions<f64>>,
    /// For each joint after how many turns every frame is where it was, if ever.
    cycles: Vec<Option<f64>>,
    /// For each closure the rows that do not vanish in every configuration, once asked for.
    rows_that_vary: OnceLock<Vec<Kept>>,
    coordinates: Option<Arc<JointCoordinates>>,
    warnings: Arc<Vec<Problem>>,
    /// The most by which numbers of the file are off, in m, if it says so.
    tolerance: Option<f64>,
    rounding: Option<Arc<Rounding>>,
}

/// A frame of a mechanism; chains, platforms and frames by their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Frame {
    /// The fixed frame.
    Ground,
    /// A platform's own frame.
    Platform { platform: usize },
    /// A named frame on a platform.
    OnPlatform { platform: usize, frame: usize },
    /// The frame after a row of a chain's table; row 0 is the chain's base frame.
    Link { chain: usize, row: usize },
    /// A chain's tip frame.
    Tip { chain: usize },
}
