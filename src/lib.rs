//! Kinematic analysis of parallel and closed-chain mechanisms.
//!
//! A mechanism is described as in a textbook: serial Denavit–Hartenberg chains, left when the closed mechanism is
//! broken at some of its joints, and closures that restore those joints. linkwork assembles it, finds all its
//! assemblies, and analyses mobility, velocities, forces, motion, singularities and workspace.
//!
//! Load, ask, answer:
//!
//! ```
//! use linkwork::{ask::Question, mechanism::Mechanism, solve::Watch};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mechanism = Mechanism::load("mechanisms/three_rps.ron")?;
//! let question = Question::new(mechanism).hold("l1", 0.7);
//! let report = question.assemblies(Default::default(), &Watch::none())?;
//! println!("{} real assemblies", report.real);
//! for mode in &report.assemblies {
//!     println!("mode {}: {:?}", mode.mode, mode.platforms.get("top"));
//! }
//! # Ok(())
//! # }
//! ```
//!
//! The [guide] explains the file, every question, and the conventions. The modules, each of which uses only those above
//! it:
//!
//! | Module | Contents |
//! |---|---|
//! | [`number`] | real, complex, dual and interval numbers |
//! | [`linear`] | small dense and sparse linear algebra for least-squares steps |
//! | [`algebra`] | expressions and trigonometric polynomials |
//! | [`geometry`] | vectors, rotations, poses, lines |
//! | [`solve`] | Newton's method, continuation, homotopy |
//! | [`description`] | the mechanism file, read and written |
//! | [`mechanism`] | the valid, immutable mechanism and its kinematics over any number |
//! | [`interchange`] | URDF, MJCF and SDF |
//! | [`system`] | equations, Jacobians and curves of one question about a mechanism |
//! | [`analysis`] | the analyses: a mechanism, a question and settings in, a report out |
//! | [`ask`] | questions that own their mechanism, and every analysis as a method of them |
//! | [`scene`] | a configuration as named shapes |
//! | [`output`] | reports as text, JSON, CSV, Markdown, HTML and pictures |
//! | `page` | the interface of the page of `linkwork view`; with the feature `page` |
//! | `python` | the interface of the Python package; with the feature `python` |

// answers are the same bytes on every machine
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod algebra;
pub mod analysis;
pub mod ask;
pub mod description;
pub mod geometry;
pub mod guide;
#[cfg(feature = "interchange")]
pub mod interchange;
pub mod linear;
pub mod mechanism;
pub mod number;
pub mod output;
#[cfg(feature = "page")]
pub mod page;
#[cfg(feature = "python")]
mod python;
pub mod scene;
pub mod solve;
pub mod system;

// the Python module brings the command line with it, which sees the library as other programs do
#[cfg(feature = "python")]
#[allow(unreachable_patterns)]
mod cli;
#[cfg(feature = "python")]
extern crate self as linkwork;

/// The Rust of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
