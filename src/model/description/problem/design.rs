//! Problems of design questions.

use thiserror::Error;

use super::Problem;
use crate::algebra::SiUnit;
use crate::description::{DesignPart, count};

/// Reasons for which a design question has no answer. Lengths are in m, angles in rad.
#[derive(Debug, Clone, Error, PartialEq)]
#[allow(missing_docs)]
pub enum DesignProblem {
    #[error("the design has no positions")]
    NoPositions,
    #[error("position {position} has no targets")]
    NoTargets { position: usize },
    #[error("positions {first} and {second} are the same")]
    SamePositions { first: usize, second: usize },
    #[error("`{name}` is a joint, which each position has a value of its own for")]
    VariesJoint { name: String },
    #[error("the parameter `{name}` follows from others")]
    VariesFormula { name: String },
    #[error("`{name}` cannot be the name of a further unknown")]
    NotAName {
        name: String,
        suggestion: Option<String>,
    },
    #[error("nothing uses `{name}`")]
    Unused {
        name: String,
        suggestion: Option<String>,
    },
    #[error("`{text}` has no value: {why}")]
    Value { text: String, why: String },
    #[error("the range of `{name}` is reversed")]
    Reversed { name: String },
    #[error("{why}")]
    Quantity {
        why: String,
        suggestion: Option<String>,
    },
    #[error("no position has a target `{name}`")]
    NoTarget {
        name: String,
        suggestion: Option<String>,
    },
    #[error("`{name}` is given, and is met exactly")]
    IsGiven { name: String },
    #[error("`{text}` is not positive")]
    NotPositive { text: String },
    #[error("`{name}` has {values} values for {}", count(*.positions, "position"))]
    NotForEach {
        name: String,
        values: usize,
        positions: usize,
    },
    #[error("`{name}` is no point, and has {count} coordinates")]
    NotAPoint { name: String, count: usize },
    #[error("`{name}` is a rate, a force or a figure, which a position alone does not have")]
    NotOfPosition { name: String },
    #[error("`{text}` is no figure of a quantity over the motion")]
    NoFigure { text: String },
    #[error("`{name}` shall be {} {}, and is {} {} in these ranges", sense(*.at_least), said(*.bound, *.unit), sense(!*.at_least), said(*.best, *.unit))]
    Impossible {
        name: String,
        unit: SiUnit,
        bound: f64,
        /// The value beyond which it never is.
        best: f64,
        at_least: bool,
    },
    #[error("a design has two goals at most")]
    MoreGoals,
    #[error("no mechanism in these ranges can be assembled in all positions ({tried} were tried{})", missed(.nearest))]
    NothingAssembles {
        tried: usize,
        nearest: Option<MissedTarget>,
    },
    #[error("{why}")]
    Motion { why: String },
}

/// The target that what comes nearest misses most.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs)]
pub struct MissedTarget {
    pub position: usize,
    pub quantity: String,
    pub unit: SiUnit,
    pub by: f64,
}

/// `; the nearest misses …`
fn missed(nearest: &Option<MissedTarget>) -> String {
    let Some(of) = nearest else {
        return String::new();
    };
    let by = said(of.by.abs(), of.unit);
    let (quantity, position) = (&of.quantity, of.position);
    format!("; the nearest misses `{quantity}` in position {position} by {by}")
}

/// A value of four digits with its unit.
fn said(value: f64, unit: SiUnit) -> String {
    let (value, unit) = match unit {
        _ if unit.is_angle() => (value.to_degrees(), "°".to_owned()),
        SiUnit::ONE => (value, String::new()),
        _ => (value, format!(" {unit}")),
    };
    let value: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    format!("{value}{unit}")
}

fn sense(at_least: bool) -> &'static str {
    if at_least { "at least" } else { "at most" }
}

impl DesignProblem {
    /// Remedy, if there is one worth saying.
    pub fn help(&self) -> Option<String> {
        let near =
            |name: &Option<String>| name.as_ref().map(|name| format!("did you mean `{name}`?"));
        Some(match self {
            Self::NoPositions => {
                "give positions, such as `positions: [{ \"coupler\": (0.5, 1.1) }, …]`".into()
            }
            Self::NoTargets { .. } => {
                "give it the coordinates of a point or values of quantities, or leave it out".into()
            }
            Self::SamePositions { .. } => {
                "leave one of them out, or give them different inputs".into()
            }
            Self::VariesJoint { .. } => {
                "name parameters of the file, or new names for further unknowns".into()
            }
            Self::VariesFormula { .. } => "vary the parameters in its definition".into(),
            Self::NotAName { suggestion, .. } => near(suggestion)
                .unwrap_or_else(|| "begin it with a letter, without spaces or dots".into()),
            Self::Unused { suggestion, .. } => near(suggestion)
                .unwrap_or_else(|| "use it in a position, or vary a parameter of the file".into()),
            Self::Value { .. } => "write a number or an expression such as `60 deg`".into(),
            Self::Reversed { .. } => "write the least value first".into(),
            Self::Quantity { suggestion, .. } => near(suggestion)?,
            Self::NoTarget { suggestion, .. } => {
                near(suggestion).unwrap_or_else(|| "write the name of a target as the positions do".into())
            }
            Self::IsGiven { .. } => "leave it out: only targets are weighed".into(),
            Self::NotPositive { .. } => "write a positive value, or leave out the target".into(),
            Self::NotForEach { .. } => "write one value for all positions, or one for each".into(),
            Self::Motion { .. } => return None,
            Self::NotAPoint { .. } => {
                "give coordinates to a frame or a body, such as `coupler` or `coupler+u,v`".into()
            }
            Self::NotOfPosition { .. } => {
                "bound it over the motion instead, by `at_least` or `at_most`".into()
            }
            Self::NoFigure { .. } => {
                "write `max`, `min`, `range`, `stroke`, `mean` or `rms` of a quantity, as `max(force:theta1)`, `dwell(phi1, 1 deg)`, or \
                 `straightness` of a point"
                    .into()
            }
            Self::Impossible { .. } => "ask for less, or widen the ranges of what varies".into(),
            Self::MoreGoals => "leave one out, or bound it by `at_least` or `at_most`".into(),
            Self::NothingAssembles { .. } => {
                "widen the ranges, or ask for positions that the mechanism can reach".into()
            }
        })
    }
}

/// An error in a design question.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum DesignError {
    /// The mechanism has problems.
    #[error("the mechanism has problems")]
    Mechanism(Vec<Problem>),
    /// Part of the question is wrong: its name, or with `value` what it is given.
    #[error("{problem}")]
    Part {
        part: DesignPart,
        value: bool,
        problem: DesignProblem,
    },
}

impl DesignProblem {
    /// The error of a part of the question.
    pub fn at(self, part: DesignPart) -> DesignError {
        DesignError::Part {
            part,
            value: false,
            problem: self,
        }
    }

    /// The error of the value of a part.
    pub fn of_value(self, part: DesignPart) -> DesignError {
        DesignError::Part {
            part,
            value: true,
            problem: self,
        }
    }
}
