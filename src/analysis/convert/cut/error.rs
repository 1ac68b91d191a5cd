//! Why a mechanism cannot be cut at a joint.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use crate::description::quoted;

/// Why a mechanism is not broken at a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum CutError {
    /// There is no such joint.
    UnknownJoint {
        /// Its name.
        name: String,
        /// The joint that was probably meant.
        suggestion: Option<String>,
    },
    /// The name is a closure's: the mechanism is broken there already.
    AlreadyCut {
        /// The closure.
        closure: String,
    },
    /// The joint is helical, and no closure is.
    Helical {
        /// The joint.
        joint: String,
    },
    /// The variable stands in no row.
    NoRow {
        /// The joint.
        joint: String,
    },
    /// The variable stands in several rows or entries.
    SeveralRows {
        /// The joint.
        joint: String,
    },
    /// Other variables stand in its row.
    SharedRow {
        /// The joint.
        joint: String,
    },
    /// No closure holds what is behind the joint.
    NoLoop {
        /// The joint.
        joint: String,
    },
    /// The closures that do are not at the end of the joint's own chain, or cannot become rows.
    NotRows {
        /// The joint.
        joint: String,
        /// The closures.
        closures: Vec<String>,
    },
}

impl Display for CutError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            CutError::UnknownJoint { name, suggestion } => {
                write!(f, "there is no joint `{name}`")?;
                match suggestion {
                    Some(meant) => write!(f, "; did you mean `{meant}`?"),
                    None => Ok(()),
                }
            }
            CutError::AlreadyCut { closure } => {
                write!(
                    f,
                    "`{closure}` is a closure: the mechanism is already cut there"
                )
            }
            CutError::Helical { joint } => write!(
                f,
                "the joint `{joint}` is helical, and there is no helical closure"
            ),
            CutError::NoRow { joint } => {
                write!(f, "the variable `{joint}` stands in no row of a table")
            }
            CutError::SeveralRows { joint } => write!(
                f,
                "the variable `{joint}` stands in several places, and a cut would open only one of them"
            ),
            CutError::SharedRow { joint } => write!(
                f,
                "the row of `{joint}` has other variables too, which the cut would free"
            ),
            CutError::NoLoop { joint } => write!(
                f,
                "`{joint}` is not part of a loop: after the cut nothing would hold the links behind it"
            ),
            CutError::NotRows { joint, closures } => write!(
                f,
                "the links behind `{joint}` are held only by {}, which cannot become rows at the \
                 end of its chain",
                quoted(closures)
            ),
        }
    }
}

impl Error for CutError {}
