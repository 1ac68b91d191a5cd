//! Analysis of parallel and closed-chain mechanisms described as serial Denavit–Hartenberg chains,
//! broken at chosen joints and put back together by closures.

pub mod algebra;
pub mod analysis;
pub mod description;
pub mod geometry;
pub mod linear;
pub mod mechanism;
pub mod number;
pub mod output;
pub mod solve;
pub mod system;
