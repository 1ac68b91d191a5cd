//! Following solutions along parameter homotopies between members of the family.

mod along;
mod carry;
mod fold;
mod local;
mod path;
mod place;
mod simple;
mod way;

pub(super) use along::{carried, polish};
pub(super) use carry::{Ends, carry};
pub(super) use fold::located;
pub(super) use local::Local;
pub(super) use path::End;
pub(super) use simple::{are_one, stands_alone};
pub(super) use way::Way;
