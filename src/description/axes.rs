//! The contents of a file of joint axes: like a mechanism file, before frames are placed.

use std::ops::Range;

use thiserror::Error;

use super::{ClosureKind, Convention, Displacement, Entry, GROUND, Named, Role, Spanned};
use crate::algebra::words;

/// A whole file of joint axes. Everything is in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct AxesDescription {
    /// The name of the mechanism.
    pub name: Spanned<String>,
    /// Its source in the literature.
    pub source: Option<Spanned<String>>,
    /// The convention of the tables to be made.
    pub convention: Option<Spanned<Convention>>,
    /// Dimensions and other constants.
    pub parameters: Vec<Named<Entry>>,
    /// The joints; in a serial chain from the base to the tool.
    pub joints: Vec<Named<AxisDescription>>,
    /// The frame from which the tables should start.
    pub base: Option<Vec<Displacement>>,
    /// The frame at which a serial chain ends.
    pub tool: Option<Vec<Displacement>>,
    /// The joints at which closed loops are to be cut.
    pub cut: Vec<Spanned<String>>,
}

/// A joint given by its axis.
#[derive(Debug, Clone)]
pub struct AxisDescription {
    /// How it moves.
    pub kind: AxisKind,
    /// Where its axis lies in the home configuration.
    pub place: AxisPlace,
    /// Whether it is driven, if the file says so.
    pub role: Option<Role>,
    /// The value of its variable in the home configuration; 0 if not given.
    pub home: Entry,
    /// Lowest and highest value.
    pub limits: Option<(Entry, Entry)>,
    /// The two bodies it connects; the second moves positively against the first.
    pub between: Option<[Spanned<String>; 2]>,
    /// Where the joint is described.
    pub span: Range<usize>,
}

words! {
    /// The kind of a joint given by its axis.
    AxisKind {
        /// Revolute about its axis.
        Revolute = "Revolute",
        /// Prismatic along its axis, which has a direction only.
        Prismatic = "Prismatic",
        /// Spherical, with a centre only. It is always cut.
        Spherical = "Spherical",
    }
}

/// The position of an axis: three coordinates in m, or a direction of any length.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisPlace {
    /// A point, which a prismatic joint need not have, and a direction.
    Along(Option<[Entry; 3]>, [Entry; 3]),
    /// Two points, the axis directed from the first to the second.
    Through([Entry; 3], [Entry; 3]),
    /// The centre of a ball.
    Centre([Entry; 3]),
}

impl AxisKind {
    /// The closure that restores such a joint.
    pub fn closure(self) -> ClosureKind {
        match self {
            Self::Revolute => ClosureKind::Revolute,
            Self::Prismatic => ClosureKind::Prismatic,
            Self::Spherical => ClosureKind::Spherical,
        }
    }
}

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
    #[error("a loop has no joint to cut, because all its joints are driven")]
    NothingToCut,
    #[error("`{field}` is for serial chains, but these joints connect named bodies")]
    SerialOnly { field: &'static str },
    #[error("a serial chain cannot contain the spherical joint `{joint}`")]
    SphericalInSerial { joint: String },
    #[error("there are {joints} joints, more than can be placed")]
    TooMany { joints: usize },
    #[error("the driven joint `{joint}` is cut and loses its variable")]
    DriveCut { joint: String },
    #[error("the joint `{joint}` is cut and loses its variable and its limits")]
    LimitsCut { joint: String },
    /// A base from which no row leads to the first axis.
    #[error("frame 0 cannot be placed as `base` says; it is placed freely")]
    BaseUnused { convention: Convention },
    /// Nearly parallel axes whose common normal is far away.
    #[error(
        "the axes of `{}` and `{}` are nearly parallel, {angle:.1e} rad apart: their common normal is \
         {offset:.1e} m away, {:.0e} times the size of the mechanism",
        joints[0], joints[1], offset / size
    )]
    FarNormal {
        joints: [String; 2],
        /// Angle between the axes.
        angle: f64,
        /// Offset that leads to the normal.
        offset: f64,
        /// Size of the mechanism.
        size: f64,
    },
}

impl AxesProblem {
    /// Whether tables are made nevertheless.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            Self::DriveCut { .. }
                | Self::LimitsCut { .. }
                | Self::BaseUnused { .. }
                | Self::FarNormal { .. }
        )
    }
}
