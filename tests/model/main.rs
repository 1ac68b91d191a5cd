//! Numbers, mechanism files and their exchange with other programs, and published numbers of the model itself.

mod coordinates;
mod couplings;
mod description;
mod exchange;
mod golden;
mod imports;
mod includes;
mod machines;
mod mechanisms;
mod negative_lengths;
mod numbers;
mod numerics;
mod pictures;
#[cfg(feature = "cli")]
mod rendered;
mod scene;
mod units;
