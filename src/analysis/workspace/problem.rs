//! What a map is of: the mapped coordinates, their grid, and the rates at its nodes.

mod asked;
mod condition;
mod grid;
mod rates;

pub(super) use asked::{Asked, Targets};
pub(super) use grid::{Grid, MOST_AXES, MOST_DIRECTIONS};
pub(super) use rates::{Rates, Told};
