//! What a file of joint axes says: the same kind of file as a mechanism's, before frames are placed.

use std::ops::Range;

use super::{ClosureKind, Convention, Displacement, Entry, Named, Role, Spanned};

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

/// How a joint moves of which the axis is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisKind {
    /// It turns about its axis.
    Revolute,
    /// It slides along its axis, which has a direction only.
    Prismatic,
    /// A ball, which has a centre only. It is always cut.
    Spherical,
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
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Revolute, Self::Prismatic, Self::Spherical];

    /// The closure that puts such a joint back.
    pub fn closure(self) -> ClosureKind {
        match self {
            Self::Revolute => ClosureKind::Revolute,
            Self::Prismatic => ClosureKind::Prismatic,
            Self::Spherical => ClosureKind::Spherical,
        }
    }

    /// How it is written in a file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Revolute => "Revolute",
            Self::Prismatic => "Prismatic",
            Self::Spherical => "Spherical",
        }
    }
}

/// What is wrong with axes whose form is right.
#[derive(Debug, Clone, PartialEq)]
pub enum AxesProblem {
    /// A direction of zero length, or two points that coincide.
    NoDirection {
        /// The joint.
        joint: String,
    },
    /// Fewer joints than a chain needs for a table.
    TooFew {
        /// How many there are.
        joints: usize,
    },
    /// A point that is given in two ways.
    TwoPlaces {
        /// The joint.
        joint: &'static str,
    },
    /// Some joints say which bodies they connect and this one does not.
    NotBetween {
        /// The joint.
        joint: String,
    },
    /// A joint that connects a body with itself.
    OneBody {
        /// The body.
        body: String,
    },
    /// No joint is attached to the ground.
    NoGround,
    /// A body that no joints connect with the ground.
    NotConnected {
        /// The body.
        body: String,
    },
    /// A joint to be cut that does not exist.
    UnknownCut {
        /// Its name.
        name: String,
        /// The joint that was probably meant.
        suggestion: Option<String>,
    },
    /// A cut that takes a body off instead of opening a loop.
    CutsOff {
        /// The joint.
        joint: String,
    },
    /// A loop that no cut opens.
    StillClosed {
        /// A joint of it that could be cut.
        joint: String,
    },
    /// Loops in which every joint is driven.
    NothingToCut,
    /// Something that only serial chains have.
    SerialOnly {
        /// The field.
        field: &'static str,
    },
    /// A ball in a serial chain.
    SphericalInSerial {
        /// The joint.
        joint: String,
    },
    /// Too many joints for one file of axes.
    TooMany {
        /// How many there are.
        joints: usize,
    },
    /// A driven joint that is cut, and so has no variable.
    DriveCut {
        /// The joint.
        joint: String,
    },
    /// A joint with limits that is cut, and so has no variable.
    LimitsCut {
        /// The joint.
        joint: String,
    },
    /// A base from which no row leads to the first axis.
    BaseUnused {
        /// The convention of the table.
        convention: Convention,
    },
    /// Nearly parallel axes whose common normal is far off.
    FarNormal {
        /// The joints.
        joints: [String; 2],
        /// Angle in rad between the axes.
        angle: f64,
        /// Offset in m that leads to the normal.
        offset: f64,
        /// Size of the mechanism in m.
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
