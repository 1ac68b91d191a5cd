//! Ends of motions, and reasons for which none begins.

use serde::{Deserialize, Serialize};

/// End of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SweepEnd {
    /// The inputs went through their whole segment.
    Complete,
    /// The inputs came back to where they began, on another branch, having gone round a fold.
    Returned,
    /// The curve closed.
    Closed,
    /// Both ends of the curve were reached: limits.
    Limits,
    /// The branch ends: the inputs would have to turn back.
    Fold,
    /// A joint is at its limit.
    Limit,
    /// Branches cross, and which to take is not clear.
    Crossing,
    /// The start is singular: branches cross there or more than one freedom is left.
    SingularStart,
    /// A joint is outside its limits at the start.
    OutsideLimits,
    /// The curve ends in a point that no sure step leads to.
    Lost,
    /// It was stopped, or took too many steps.
    Stopped,
}

impl SweepEnd {
    /// True if the motion ended as asked.
    pub fn is_whole(self) -> bool {
        matches!(
            self,
            SweepEnd::Complete | SweepEnd::Returned | SweepEnd::Closed | SweepEnd::Limits
        )
    }
}

/// Reasons for which a motion cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoStart {
    /// The joint of that index is outside its limits.
    OutsideLimits(usize),
    /// The closures do not close near the start.
    NotClosed,
    /// The start is singular: branches cross there, or so near that rounding decides between them.
    Singular,
}
