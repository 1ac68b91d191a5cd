//! A question about a mechanism: which coordinates are held and which are to be found.
//!
//! Direct, inverse and mixed kinematics are only different choices of held coordinates ([`Held`]).
//!
//! [`equations`](System) assembles the closures, [`tangent`](Neighbourhood) linearises them,
//! [`question`](Question) holds coordinates, [`search`](Search) assembles, and [`curve`](Curve)
//! follows one-parameter curves of configurations; [`bundle`](Bundle) solves for many configurations that share dimensions.

mod balance;
mod ball_angle_sets;
mod branch;
mod bundle;
mod closed_form;
mod curve;
mod dynamics;
mod enclosure;
mod equations;
mod equilibrium;
mod joint_reactions;
mod joint_space;
mod lanes;
mod loaded;
mod question;
mod record;
mod rest_equations;
mod search;
mod tangent;

pub use crate::mechanism::{
    ByName, FormulaNames, FrameRecord, PlatformRecord, PointError, Value, ValueError,
};
pub use balance::{Balance, Instant};
pub use ball_angle_sets::sets_of_angles;
pub use branch::BRANCH_CHANGE;
pub(crate) use bundle::SideRows;
pub use bundle::{Arrow, Bundle, Bundled, Closer, Copies, PathForm, Target, TargetError};
pub use closed_form::{Branching, ClosedSolution, Rule, Step};
pub use curve::{
    Bound, ComplexCurve, ConfigurationCurve, Curve, Driven, Event, LocusCurve, LocusEnd, Monitor,
    MotionTracker, NoStart, Region, Segment, Singular, SweepEnd, Traced, Walk, met_at, neared,
    settled,
};
pub use dynamics::{Accelerated, Dynamics, NoDynamics};
pub(crate) use enclosure::Enclosure;
pub use equations::{
    ClosureAxes, ClosureWrenches, Coordinate, Gap, Held, HeldParts, HeldPlatform, Places, Spin,
    System, SystemWork, Unknown, approach, independent_parts,
};
pub(crate) use equations::{ConstantsCourse, solve};
pub use equilibrium::Equilibrium;
pub use joint_reactions::{Bearings, Carried};
pub use joint_space::Unfit;
pub(crate) use joint_space::{JointSpace, enclosed};
pub(crate) use lanes::{LaneNumbers, LaneProgram, Mask, assign, bits, choose, small};
pub use loaded::{Acting, Loaded, Moving};
pub use question::{
    Count, Demand, Drive, DriveError, ForceError, Load, Question, QuestionError, Role, Still,
    actuated, check_angle, check_angles, check_count, coordinate_outputs, default_outputs,
    free_outputs, inputs_of, platform_outputs, redundant_motors, with_coordinates,
};
pub use record::{NamedUnit, infinite_if_null};
pub(crate) use record::{is_origin, uncut};
pub use rest_equations::{NotAlgebraic, RestEquations, RestWay};
pub use search::{
    Analysed, AssemblySettings, Attempt, Closed, GivenPose, Moved, NotClosed, RESTARTS, Search,
    Searched, TooLarge, WidestGap, close, moved, random_configuration, sampling_range, too_large,
};
pub use tangent::{
    Cone, Driving, FINITE_STEP, FiniteStep, FlatSet, FrameMotion, FrameTwists, Freedoms, Lasting,
    Lock, Locked, LoopPart, MechanismLoop, Motion, Neighbourhood, RegularFreedoms, SET_STEP, Screw,
    Tangent, Twist, TwistSpace, combination, loops, moving, spin_lines, without, wrench_screws,
};
