//! The search for all solutions of one generic member of the family.

mod monodromy;
mod newton_starts;
mod solutions;
mod starts;
mod store;
mod trace;

pub(super) use monodromy::search;
pub use solutions::GenericSolutions;
pub(super) use starts::solved;
pub use store::StoredError;
pub(super) use store::question;
