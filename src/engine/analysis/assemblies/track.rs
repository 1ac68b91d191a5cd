//! Path tracking along parameter homotopies between members of the family.

mod along;
mod fold;
mod homotopy;
mod lift;
mod local;
mod member;
mod path;
mod simple;
mod target;

pub(super) use along::{polish, tracked};
pub(super) use fold::located;
pub(super) use homotopy::{END, ParameterHomotopy, START};
pub(super) use lift::Lift;
pub(super) use local::Local;
pub(super) use path::End;
pub(super) use simple::{are_one, stands_alone};
pub(super) use target::{Ends, WAYS, ends_by, track_to_target};
