//! A question about a mechanism: which coordinates are held and which are to be found.
//!
//! Direct, inverse and mixed kinematics are only different choices of what is held ([`Held`]).

mod equations;
mod layout;
mod tracker;

pub use equations::{System, Work};
pub use layout::{Held, HeldPlatform, Unknown};
pub use tracker::Tracker;
