//! Numbers, mechanism files and their exchange with other programs, and published numbers of the model itself.

mod description;
mod exchange;
mod golden;
mod mechanisms;
mod numbers;
