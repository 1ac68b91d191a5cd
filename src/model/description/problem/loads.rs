//! Problems of masses, springs and forces.

use std::ops::Range;

use thiserror::Error;

use crate::description::{Problem, ProblemKind};

/// A problem of a mass, a spring, a force or friction. Its title is one sentence without a full stop.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)]
pub enum LoadProblem {
    #[error("{what} is negative: {value}")]
    Negative { what: &'static str, value: f64 },
    #[error("the mass of `{name}` is not given")]
    NoMass { name: String },
    #[error("{fields} of `{name}` are both given")]
    Twice { name: String, fields: &'static str },
    #[error("no body has the principal moments of inertia {}: the largest exceeds the sum of the others, or one is negative", listed(*_0))]
    Triangle([f64; 3]),
    #[error("`{name}` joins two points of the same body")]
    SameBody { name: String },
    #[error("`{name}` is fixed to ground, which nothing moves")]
    OnGround { name: String },
    #[error("`{name}` needs {fields}")]
    Needs { name: String, fields: &'static str },
    #[error("there is no joint `{name}`")]
    NoJoint {
        name: String,
        suggestion: Option<String>,
    },
    #[error("the first column of a table must rise from row to row, in two rows or more")]
    Table,
    #[error("the table `{file}` cannot be read: {reason}")]
    TableFile { file: String, reason: String },
    #[error("`{name}` changes while the mechanism moves; only parameters have a meaning here")]
    NotConstant { name: String },
    #[error("a force cannot depend on `{name}`, which follows from forces or accelerations")]
    NotGiven { name: String },
}

fn listed(moments: [f64; 3]) -> String {
    let shown = moments.map(|x| {
        let rounded = format!("{x:.4e}").parse::<f64>();
        rounded.unwrap_or(x).to_string()
    });
    format!("{} kg·m²", shown.join(", "))
}

impl LoadProblem {
    /// The problem at a place.
    pub fn at(self, span: &Range<usize>) -> Problem {
        ProblemKind::Load(Box::new(self)).at(span.clone())
    }

    pub(super) fn help(&self) -> Option<String> {
        Some(match self {
            Self::NoMass { .. } => "give `mass`, or `shape` and `density`".into(),
            Self::Twice { .. } => "leave one of them out".into(),
            Self::Triangle(_) => {
                "moments are about the centre of mass; of a flat body one number, Izz, is enough"
                    .into()
            }
            Self::NoJoint { suggestion, .. } => {
                format!("did you mean `{}`?", suggestion.as_ref()?)
            }
            _ => return None,
        })
    }
}
