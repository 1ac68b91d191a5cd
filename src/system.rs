//! A question about a mechanism: which coordinates are held and which are to be found.
//!
//! Direct, inverse and mixed kinematics are only different choices of what is held ([`Held`]).

mod count;
mod displacement;
mod equations;
mod freedom;
mod gap;
mod layout;
mod question;
mod tracker;
mod value;

pub use count::Count;
pub use equations::{System, Work};
pub use freedom::{Freedoms, Holdable, Mobility};
pub use gap::{Gap, gaps};
pub use layout::{Held, HeldPlatform, Unknown};
pub use question::{Question, QuestionError};
pub use tracker::Tracker;
pub use value::ValueError;
