//! A question about a mechanism: which coordinates are held and which are to be found.
//!
//! Direct, inverse and mixed kinematics are only different choices of what is held ([`Held`]).

mod approach;
mod closing;
mod count;
mod curve;
mod demand;
mod displacement;
mod drive;
mod equations;
mod error_words;
mod freedom;
mod gap;
mod layout;
mod load;
mod locked;
mod locus;
mod loops;
mod motion;
mod neighbourhood;
mod parts;
mod question;
mod question_error;
mod record;
mod screws;
mod search;
mod starts;
mod trace;
mod tracker;
mod twists;
mod value;
mod walk;
mod way;

pub use approach::approach;
pub use closing::{Analysed, Closed, NotClosed, WidestGap, close, fit, too_large};
pub use count::{Count, check_angles, check_count};
pub use curve::{Curve, Driven};
pub use demand::{Demand, Verb};
pub use drive::{Drive, DriveError};
pub use equations::{ClosureAxes, ClosureWrenches, System, Work};
pub use freedom::{Freedoms, Holdable, Mobility, moving};
pub use gap::Gap;
pub use layout::{Held, HeldPlatform, Unknown};
pub use load::{Load, LoadError};
pub use locked::{Lock, Locked};
pub use locus::{LocusCurve, Singular};
pub use loops::{LoopPart, MechanismLoop, loops};
pub use motion::{FrameMotion, FrameMotions, Motion};
pub use neighbourhood::{Followed, Neighbourhood, Tangent};
pub use parts::independent_parts;
pub use question::{Question, with_coordinates};
pub use question_error::QuestionError;
pub use record::{
    Column, FormulaNames, FrameRecord, Named, PlatformRecord, Variable, infinite_if_null,
};
pub use screws::{Screw, TwistSpace, spin_lines, without, wrench_screws};
pub use search::{Attempt, Search, Searched};
pub use starts::{random_configuration, sampling_range};
pub use trace::{ConfigurationCurve, LocusEnd, Region, Traced, met_at, passes, settled};
pub use tracker::Tracker;
pub use twists::{FrameTwists, Twist};
pub use value::{ValueError, number as number_of};
pub use walk::{Event, Leg, Monitor, Walk};
