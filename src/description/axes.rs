//! What a file of joint axes says: the same kind of file as a mechanism's, before frames are placed.

use std::ops::Range;

use thiserror::Error;

use super::{ClosureKind, Convention, Displacement, Entry, GROUND, Named, Role, Spanned};
use crate::algebra::words;

/// A whole file of joint axes. Everything is in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct AxesDescription {
    /// What the mechanism is called.
    pub name: Spanned<String>,
    /// Where it comes from.
    pub source: Option<Spanned<String>>,
    /// The convention of the tables that are asked for.
    pub convention: Option<Spanned<Convention>>,
    /// Dimensions and other constants.
    pub parameters: Vec<Named<Entry>>,
    /// The joints; in a serial chain from the base to the tool.
    pub joints: Vec<Named<AxisDescription>>,
    /// The frame from which the tables shall start.
    pub base: Option<Vec<Displacement>>,
    /// The frame at which a serial chain ends.
    pub tool: Option<Vec<Displacement>>,
    /// The joints at which closed loops shall be broken.
    pub cut: Vec<Spanned<String>>,
}

/// A joint of which the axis is known.
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
    /// How a joint moves of which the axis is known.
    AxisKind {
        /// It turns about its axis.
        Revolute = "Revolute",
        /// It slides along its axis, which has a direction only.
        Prismatic = "Prismatic",
        /// A ball, which has a centre only. It is always cut.
        Spherical = "Spherical",
    }
}

/// How the place of an axis is given: three coordinates in m, or a direction of any length.
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
    /// The closure that puts such a joint back.
    pub fn closure(self) -> ClosureKind {
        match self {
            Self::Revolute => ClosureKind::Revolute,
            Self::Prismatic => ClosureKind::Prismatic,
            Self::Spherical => ClosureKind::Spherical,
        }
    }
}

/// What is wrong with axes whose form is right. Lengths are in m, angles in rad.
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
    #[error("nothing says which bodies the joint `{joint}` connects, as others do")]
    NotBetween { joint: String },
    #[error("the joint connects the body `{body}` with itself")]
    OneBody { body: String },
    #[error("no joint connects anything with `{GROUND}`")]
    NoGround,
    #[error("no joints connect the body `{body}` with `{GROUND}`")]
    NotConnected { body: String },
    #[error("there is no joint `{name}` to be cut")]
    UnknownCut {
        name: String,
        suggestion: Option<String>,
    },
    #[error("cutting the joint `{joint}` takes bodies off instead of opening a loop")]
    CutsOff { joint: String },
    /// A loop that no cut opens; the joint is one of it that could be cut.
    #[error("the cuts leave a loop closed that goes through the joint `{joint}`")]
    StillClosed { joint: String },
    #[error("a loop has no joint to be cut, because all of them are driven")]
    NothingToCut,
    #[error("`{field}` is for serial chains, and these joints say what they connect")]
    SerialOnly { field: &'static str },
    #[error("the spherical joint `{joint}` stands in a serial chain")]
    SphericalInSerial { joint: String },
    #[error("there are {joints} joints, more than are placed")]
    TooMany { joints: usize },
    #[error("the driven joint `{joint}` is cut, and so has no variable any more")]
    DriveCut { joint: String },
    #[error("the joint `{joint}` is cut, and so has no variable and no limits any more")]
    LimitsCut { joint: String },
    /// A base from which no row leads to the first axis.
    #[error("frame 0 cannot stand where `base` says, and is placed freely")]
    BaseUnused { convention: Convention },
    /// Nearly parallel axes whose common normal is far off.
    #[error(
        "the axes of `{}` and `{}` are nearly parallel, {angle:.1e} rad apart: their common normal is \
         {offset:.1e} m off, {:.0e} times the size of the mechanism",
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
    /// Whether tables are made all the same.
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
