//! Spreading over the nodes of the grid from assembled configurations.

mod arrivals;
mod configurations;
mod edge;
mod fill;
mod filled;
mod measure;
mod neighbour;
mod pace;
mod seeds;
mod spread;
mod step;
mod tile;

pub(super) use edge::{Edge, Met, Until, walk};
pub(super) use filled::{Band, Filled, Link, join, root, signs};
pub(super) use measure::Measure;
pub(super) use neighbour::Fill;
pub(super) use seeds::{PROBES, Sown, probe, sow};
pub(super) use spread::Spread;
pub(super) use step::Steps;
