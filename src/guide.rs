//! The guide: what linkwork answers, how to ask, and how to read the answers.
//!
//! Every command on these pages is run, and every file on them is read, by a test; the Rust runs as doctests.
//!
//! | Page | Subject |
//! |---|---|
//! | [`begin`] | examples, completions, manual, handouts |
//! | [`file`](mod@file) | the mechanism file |
//! | [`coordinates`] | the same by joint coordinates, as a drawing gives them |
//! | [`solve`] | the assembled configuration near a guess: direct, inverse and mixed kinematics |
//! | [`assemblies`] | all assemblies, with certificates |
//! | [`mobility`] | mobility, velocities and forces |
//! | [`dynamics`] | motion under weights, springs and forces, rest positions |
//! | [`motion`] | sweeps, circuits and branches |
//! | [`suspensions`] | steering axis, caster, scrub radius, roll centre and anti-dive as quantities |
//! | [`loads`] | masses, springs and friction: torques, reactions, energies |
//! | [`singularities`] | singular configurations and loci |
//! | [`workspace`] | workspace maps, modes and aspects |
//! | [`formulas`] | closed forms derived and checked |
//! | [`generate`] | a solver for one question as C or Rust |
//! | [`drawing`] | pictures of the mechanism |
//! | [`view`] | an interactive page with the solver inside |
//! | [`frames`] | tables from joint axes and back, conventions and cuts |
//! | [`exchange`] | URDF, MJCF and SDF |
//! | [`conventions`] | units, frames, angles, names, exit status |
//! | [`design`] | dimensions from what the mechanism shall do |
//! | [`library`] | use from Rust |
//! | [`studies`] | quantities over many dimensions and inputs, tolerances, on any number of machines |
//! | [`python`] | use from Python |
//! | [`performance`] | builds, features, speed |

// The pages are read by rustdoc only: editing them does not recompile the library. On docs.rs their links lead to
// modules, by `links.txt`; the definitions at their own ends are for readers of the files.

/// All assemblies (assembly modes, working modes) for held inputs, each with a certificate.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/assemblies.md"))]
pub mod assemblies {}

/// The first hour: examples, completions, manual, handouts.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/begin.md"))]
pub mod begin {}

/// Units, frames, tables, angles, names, exit status.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/conventions.md"))]
pub mod conventions {}

/// Joint coordinates: points and directions as a drawing gives them; gears, cylinders, rods, slots.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/coordinates.md"))]
pub mod coordinates {}

/// Dimensions from what the mechanism shall do, each design judged over its whole motion.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/design.md"))]
pub mod design {}

/// Pictures of the mechanism in any configuration.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/drawing.md"))]
pub mod drawing {}

/// Motion under weights, springs and forces, and rest positions.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/dynamics.md"))]
pub mod dynamics {}

/// Exchange with other programs: URDF, MJCF and SDF.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/exchange.md"))]
pub mod exchange {}

/// The mechanism file: tables, platforms, closures, closed forms.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/file.md"))]
pub mod file {}

/// Formulas derived from the tables, and printed formulas checked against them.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/formulas.md"))]
pub mod formulas {}

/// From joint axes to tables and back; other conventions, other cuts.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/frames.md"))]
pub mod frames {}

/// A solver for one question as source code, for controllers.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/generate.md"))]
pub mod generate {}

/// The Rust library: load, ask, answer.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/library.md"))]
pub mod library {}

/// Masses, springs, forces and friction; holding forces, torques over a cycle, bearing forces, energies.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/loads.md"))]
pub mod loads {}

/// Mobility, velocities and forces of an assembled mechanism.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/mobility.md"))]
pub mod mobility {}

/// Motion: inputs swept through a range, whole curves, circuits and branches.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/motion.md"))]
pub mod motion {}

/// Features, builds, and what is fast.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/performance.md"))]
pub mod performance {}

/// The questions of the guide asked from Python.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/python.md"))]
pub mod python {}

/// Singularities: at a configuration, along inputs, and as loci.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/singularities.md"))]
pub mod singularities {}

/// The assembled configuration near a guess: direct, inverse and mixed kinematics.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/solve.md"))]
pub mod solve {}

/// Quantities at many points of parameters and inputs, on any number of machines.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/studies.md"))]
pub mod studies {}

/// A page in which the mechanism can be moved, with the solver inside.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/view.md"))]
pub mod view {}

/// Workspace maps: reached values, modes, aspects and boundaries.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/workspace.md"))]
#[cfg_attr(doc, doc = "<div>", doc = include_str!("guide/workspace.svg"), doc = "</div>")]
pub mod workspace {}

/// The words of suspensions as quantities: steering axis, caster, scrub radius, roll centre, anti-dive.
#[cfg_attr(doc, doc = "", doc = include_str!("guide/links.txt"), doc = "", doc = include_str!("guide/suspensions.md"))]
pub mod suspensions {}
