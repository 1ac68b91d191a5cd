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
