//! Kinematic analysis of parallel and closed-chain mechanisms.
//!
//! A mechanism is described as in a textbook: serial Denavit–Hartenberg chains, left when the closed mechanism is
//! broken at some of its joints, and closures that restore those joints. linkwork assembles it, finds all its
//! assemblies, analyses mobility, velocities, forces, motion under loads, singularities and workspace, and finds dimensions for
//! what a mechanism shall do.
//!
//! Load, ask, answer:
//!
//! ```
//! use linkwork::{Question, Watch};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mechanism = linkwork::load("mechanisms/three_rps.ron")?;
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
//! A [`Question`] has a method for each analysis, which takes the settings of that analysis and returns its report. Reports
//! are plain data and implement [`Report`], by which they become text, Markdown, HTML or JSON. The [guide] explains the
//! file, every question, and the conventions. The module [`kernel`] has everything beneath: numbers, linear algebra,
//! kinematics over any number, equations, continuation, and the analyses themselves.

// answers are the same bytes on every machine
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod guide;
#[cfg(feature = "page")]
#[doc(hidden)]
pub mod page;
#[cfg(feature = "python")]
mod python;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod view;

#[doc(hidden)]
pub use linkwork_engine::{analysis, ask, system};
#[cfg(feature = "interchange")]
#[doc(hidden)]
pub use linkwork_exchange::interchange;
#[doc(hidden)]
pub use linkwork_model::{description, mechanism};
#[doc(hidden)]
pub use linkwork_numerics::{algebra, geometry, linear, number, solve};
#[doc(hidden)]
pub use linkwork_show::{output, scene};

#[doc(inline)]
pub use analysis::{
    assemblies::{AssembliesReport, Assembly, ComplexAssembly, LostMode, Proof, Wanted},
    assembly::{AssemblyReport, AssemblySettings, Outcome},
    compare::{CompareReport, FormReport},
    convert::{Conversion, ConvertError, ConvertSettings, convert},
    design::{Defect, DesignReport},
    equilibrium::{EquilibriumReport, EquilibriumSettings},
    formulas::{FormulasReport, FormulasSettings},
    frames::{FramesReport, FramesSettings, frames},
    mobility::{BranchReport, Character, MobilityReport},
    overview::{Overview, overview},
    quantities::Motions,
    rounding::load,
    simulation::{SimulationEnd, SimulationReport, SimulationSettings},
    singularities::{
        AlongReport, Crossing, Locus, LocusReport, SingularitiesReport, SingularitiesSettings,
        Singularity,
    },
    solver::{NoSolver, Solver},
    statics::{Reaction, StaticsReport},
    sweep::{
        Circuit, CircuitsReport, Extremum, Law, MotionReport, MotionsReport, Pace, PathReport, Row,
        SweepReport, SweepSettings,
    },
    velocity::VelocityReport,
    workspace::{AspectReport, ModeReport, WorkspaceReport, WorkspaceSettings},
};
#[doc(inline)]
pub use ask::{
    AskError, Demand, Design, DesignError, Item, Many, Mode, Points, Question, Remedy, Role,
    Solved, Steering, Store, Study, StudyError, StudyRows, TableError, Value,
};
#[doc(inline)]
pub use description::{Description, DesignDescription, FileError, LoadError, Problem, ProblemKind};
#[doc(inline)]
pub use mechanism::{Configuration, Frame, Mechanism, Point, Quantity};
#[doc(inline)]
pub use output::{AnyReport, JsonReport, Report};
#[doc(inline)]
pub use solve::{Progress, Pruning, Stage, Watch};
#[doc(inline)]
pub use system::{Analysed, QuestionError, SweepEnd};

/// The modules beneath, for programs that build on them. Each uses only those above it.
///
/// | Module | Contents |
/// |---|---|
/// | [`number`] | real, complex, dual and interval numbers |
/// | [`linear`] | small dense and sparse linear algebra for least-squares steps |
/// | [`algebra`] | expressions and trigonometric polynomials |
/// | [`geometry`] | vectors, rotations, poses, lines |
/// | [`solve`] | Newton's method, continuation, homotopy |
/// | [`description`] | the mechanism file, read and written |
/// | [`mechanism`] | the valid, immutable mechanism and its kinematics over any number |
/// | `interchange` | URDF, MJCF and SDF; with the feature `interchange` |
/// | [`system`] | equations, Jacobians and curves of one question about a mechanism |
/// | [`analysis`] | the analyses: a mechanism, a question and settings in, a report out |
/// | [`ask`] | questions that own their mechanism, and every analysis as a method of them |
/// | [`scene`] | a configuration as named shapes |
/// | [`output`] | reports as text, JSON, CSV, Markdown, HTML and pictures |
/// | `page` | the interface of the page of `linkwork view`; with the feature `page` |
/// | `python` | the interface of the Python package; with the feature `python` |
pub mod kernel {
    #[cfg(feature = "interchange")]
    #[doc(inline)]
    pub use crate::interchange;
    #[cfg(feature = "page")]
    #[doc(inline)]
    pub use crate::page;
    #[doc(inline)]
    pub use crate::{
        algebra, analysis, ask, description, geometry, linear, mechanism, number, output, scene,
        solve, system,
    };
}

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
