//! Solvers written by the program, with the lengths and near the starts of the bench; a test keeps them as the program
//! writes them.
//!
//! - `linkwork generate mechanisms/four_bar.ron --set l0=4.5 --set l1=2 --set l2=4 --set l3=3.5 --hold theta1=0 --lang rust`
//! - `linkwork generate mechanisms/three_rps.ron --hold l1=0.8 --hold l2=0.8 --hold l3=0.8 --guess phi1="40 deg"
//!   --guess phi2="40 deg" --guess phi3="40 deg" --lang rust`
//! - `linkwork generate mechanisms/stewart_gough_6sps.ron --lang rust`

#![allow(dead_code)]

#[rustfmt::skip]
pub mod four_bar;
#[rustfmt::skip]
pub mod stewart_gough_6sps;
#[rustfmt::skip]
pub mod three_rps;
