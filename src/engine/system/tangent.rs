//! The linearised equations at a configuration: twists of frames, freedoms, screws and rates.

mod cone;
mod driving;
mod freedom;
mod locked;
mod loops;
mod motion;
mod neighbourhood;
mod screws;
mod shake;
mod twists;

pub use cone::{Cone, FlatSet, SET_STEP, combination};
pub use driving::Driving;
pub use freedom::{Freedoms, RegularFreedoms, moving};
pub use locked::{Lock, Locked};
pub use loops::{LoopPart, MechanismLoop, loops};
pub use motion::{FrameMotion, Motion};
pub use neighbourhood::{FINITE_STEP, FiniteStep, Lasting, Neighbourhood, Tangent};
pub use screws::{Screw, TwistSpace, spin_lines, without, wrench_screws};
pub use twists::{FrameTwists, Twist};
