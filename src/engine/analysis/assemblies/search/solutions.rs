//! All solutions of one generic member.

use serde::{Deserialize, Serialize};

use crate::analysis::assemblies::family::{C, LegwiseSolutions, Member, count};
use crate::analysis::assemblies::report::GenericSearch;

/// All solutions of a generic member, kept to be tracked to any inputs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GenericSolutions {
    /// Names of the mechanism and its joints, values of its parameters and the held coordinates: the
    /// solutions serve no other question.
    pub(crate) question: String,
    pub(crate) parameters: Vec<C>,
    pub(crate) inputs: Vec<C>,
    #[serde(rename = "stances")]
    pub(crate) legwise: Vec<LegwiseSolutions>,
    /// Freedom left when the inputs are held: the least dimension of a set of solutions that was
    /// met, 0 if there was none. There may be isolated solutions beside it.
    pub freedom: usize,
    /// Seeds that met a set of solutions which is not isolated.
    pub not_isolated: usize,
    /// True if every seed led to another solution: they are not finite in number, and none is kept.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub endless: bool,
    /// The search that found them.
    pub search: GenericSearch,
}

impl GenericSolutions {
    /// Number of isolated complex solutions of a generic member.
    pub fn count(&self) -> usize {
        count(&self.legwise)
    }

    pub(crate) fn member(&self) -> Member {
        Member {
            parameters: self.parameters.clone(),
            inputs: self.inputs.clone(),
        }
    }
}
