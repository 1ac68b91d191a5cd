//! Errors of cutting a mechanism at a joint.

use crate::description::quoted;

/// Reasons for which a mechanism cannot be cut at a joint.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CutError {
    /// There is no such joint.
    #[error("there is no joint `{name}`{}", meant(.suggestion.as_deref()))]
    UnknownJoint {
        /// Its name.
        name: String,
        /// The joint that was probably meant.
        suggestion: Option<String>,
    },
    /// The name is a closure's: the mechanism is broken there already.
    #[error("`{0}` is a closure: the mechanism is already cut there")]
    AlreadyCut(String),
    /// The joint is helical, and no closure is.
    #[error("the joint `{0}` is helical, and there is no helical closure")]
    Helical(String),
    /// The variable stands in no row.
    #[error("the variable `{0}` occurs in no row of a table")]
    NoRow(String),
    /// The variable stands in several rows or entries.
    #[error("the variable `{0}` occurs in several places, and a cut would open only one of them")]
    SeveralRows(String),
    /// Other variables stand in its row.
    #[error("the row of `{0}` has other variables too, which the cut would free")]
    SharedRow(String),
    /// No closure holds the links behind the joint.
    #[error("`{0}` is not part of a loop: after the cut nothing would hold the links behind it")]
    NoLoop(String),
    /// A row behind it has β, and the way back along its link is no row.
    #[error("a row behind `{0}` has `beta`, which no row undoes")]
    Tilted(String),
    /// The closures that do are not at the end of the joint's own chain, or cannot become rows.
    #[error(
        "the links behind `{joint}` are held only by {}, which cannot become rows at the end of \
         its chain",
        quoted(closures)
    )]
    NotRows {
        /// The joint.
        joint: String,
        /// The closures.
        closures: Vec<String>,
    },
}

fn meant(suggestion: Option<&str>) -> String {
    suggestion.map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}
