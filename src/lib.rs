//! Analysis of parallel and closed-chain mechanisms described as serial Denavit–Hartenberg chains,
//! broken at chosen joints and put back together by closures.

pub mod algebra;
pub mod analysis;
pub mod ask;
pub mod description;
pub mod geometry;
#[cfg(feature = "interchange")]
pub mod interchange;
pub mod linear;
pub mod mechanism;
pub mod number;
pub mod output;
pub mod solve;
pub mod system;

/// The Rust of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
