//! Problems of joint coordinates.

use std::ops::Range;

use thiserror::Error;

use super::{Problem, ProblemKind};
use crate::description::words::cycle;
use crate::description::{Convention, GROUND};

/// Problems of meaning in a well-formed file of axes. Lengths are in m, angles in rad.
#[derive(Debug, Clone, Error, PartialEq)]
#[allow(missing_docs)]
pub enum AxesProblem {
    /// A direction of zero length, or two points that coincide.
    #[error("the axis of joint `{joint}` has no direction")]
    NoDirection { joint: String },
    /// Fewer joints than a chain needs for a table.
    #[error("there {}", if *joints == 0 { "are no joints" } else { "is only one joint" })]
    TooFew { joints: usize },
    #[error("the axis is given in two ways")]
    TwoPlaces { joint: &'static str },
    #[error("the joint `{joint}` does not name the bodies that it connects, as other joints do")]
    NotBetween { joint: String },
    #[error("the joint connects the body `{body}` with itself")]
    OneBody { body: String },
    #[error("no joint connects anything with `{GROUND}`")]
    NoGround,
    #[error("no joints connect the body `{body}` with `{GROUND}`")]
    NotConnected { body: String },
    #[error("there is no joint `{name}` to cut")]
    UnknownCut {
        name: String,
        suggestion: Option<String>,
    },
    #[error("cutting the joint `{joint}` disconnects bodies instead of opening a loop")]
    CutsOff { joint: String },
    /// A loop that no cut opens; the joint is one of it that could be cut.
    #[error("the cuts leave a closed loop through the joint `{joint}`")]
    StillClosed { joint: String },
    #[error("a loop has no joint to cut, because all its joints are driven or move with others")]
    NothingToCut,
    #[error("`{field}` is for serial chains, but these joints connect named bodies")]
    SerialOnly { field: &'static str },
    #[error("a serial chain cannot contain the spherical joint `{joint}`")]
    SphericalInSerial { joint: String },
    #[error("no joint is at the body `{name}`")]
    UnknownBody {
        name: String,
        suggestion: Option<String>,
    },
    /// Values of joints given by one another; the first follows the last.
    #[error("the value of a joint depends on itself: {}", cycle(joints))]
    FollowsItself { joints: Vec<String> },
    #[error(
        "the constant in the value of `{joint}` has no effect: its value in the drawing follows from the joints it follows"
    )]
    ConstantLost { joint: String },
    #[error("the joint `{joint}` follows others by its {by} and has no `{field}` of its own")]
    Follows {
        joint: String,
        by: &'static str,
        field: &'static str,
    },
    #[error(
        "the axes of the universal joint `{joint}` are not perpendicular: the angle between them is {:.4}°", .angle.to_degrees()
    )]
    NotPerpendicular { joint: String, angle: f64 },
    #[error(
        "`frames` places revolute, prismatic and spherical joints that points and directions give in one place, without `value`; `{joint}` is not one of these"
    )]
    NotPlaced { joint: String },
    #[error("the screw `{joint}` cannot be cut")]
    ScrewCut { joint: String },
    #[error("there are {joints} joints, more than can be placed")]
    TooMany { joints: usize },
    #[error("the driven joint `{joint}` is cut and loses its variable")]
    DriveCut { joint: String },
    #[error("the joint `{joint}` is cut and loses its variable and its limits")]
    LimitsCut { joint: String },
    /// A base from which no row leads to the first axis.
    #[error("frame 0 cannot be placed as `base` says; it is placed freely")]
    BaseUnused { convention: Convention },
}

impl AxesProblem {
    /// The problem at a place of the file.
    pub fn at(self, span: &Range<usize>) -> Problem {
        ProblemKind::Axes(Box::new(self)).at(span.clone())
    }

    /// True if tables are made nevertheless.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            Self::DriveCut { .. } | Self::LimitsCut { .. } | Self::BaseUnused { .. }
        )
    }
}
