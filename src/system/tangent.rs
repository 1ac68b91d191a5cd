//! The linearised equations at a configuration: twists of frames, freedoms, screws and rates.

mod freedom;
mod locked;
mod loops;
mod motion;
mod neighbourhood;
mod screws;
mod shake;
mod twists;

pub use freedom::{Freedoms, Mobility, moving};
pub use locked::{Lock, Locked};
pub use loops::{LoopPart, MechanismLoop, loops};
pub use motion::{FrameMotion, FrameMotions, Motion};
pub use neighbourhood::{FiniteStep, Lasting, Neighbourhood, Tangent};
pub use screws::{Screw, TwistSpace, spin_lines, without, wrench_screws};
pub use twists::{FrameTwists, Twist};
