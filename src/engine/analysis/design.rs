//! Design: dimensions with which a mechanism does what it shall.
//!
//! Positions of one mechanism with shared dimensions as unknowns are a [`Bundle`](crate::system::Bundle). Where it must be
//! somewhere exactly (an input that is given) is an equation beside the closures; points, poses and functions are met in least
//! squares, exactly where there are no more of them than unknowns. The search starts from many random dimensions and goes down by the method of Levenberg and
//! Marquardt with all closures kept closed; every different end is then judged along the whole curve of its mechanism.

mod coupler_curve;
mod course;
mod exact;
mod four_bar;
mod front;
mod improve;
mod listed;
mod nearest;
mod pinned;
mod report;
mod search;
mod starts;
mod symmetry;

pub use course::{DesignCourse, course};
pub use exact::{Exact, NotAll, Triples};
pub use front::{Costs, MISSED};
pub use improve::Cost;
pub use listed::Listed;
pub use pinned::PinnedFourBar;
pub use report::{Cognate, Defect, DesignReport, Deviation, FoundDesign, Goal, Moves, Nearest};
pub use search::{FoundEnd, SearchedEnds, Task};
