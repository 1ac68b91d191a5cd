//! The contents of a file of joint axes: like a mechanism file, before frames are placed.

use std::ops::Range;

use super::{ClosureKind, Convention, Displacement, Entry, Named, Problem, Role, Spanned, reader};

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

/// The kind of a joint given by its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisKind {
    /// Revolute about its axis.
    Revolute,
    /// Prismatic along its axis, which has a direction only.
    Prismatic,
    /// Spherical, with a centre only. It is always cut.
    Spherical,
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
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Revolute, Self::Prismatic, Self::Spherical];

    /// The closure that restores such a joint.
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

/// Problems of meaning in a well-formed file of axes.
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
    /// Some joints name the bodies they connect and this one does not.
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
    /// A cut that disconnects a body instead of opening a loop.
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
    /// A field that only serial chains have.
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
    /// A driven joint that is cut and loses its variable.
    DriveCut {
        /// The joint.
        joint: String,
    },
    /// A joint with limits that is cut and loses its variable.
    LimitsCut {
        /// The joint.
        joint: String,
    },
    /// A base from which no row leads to the first axis.
    BaseUnused {
        /// The convention of the table.
        convention: Convention,
    },
    /// Nearly parallel axes whose common normal is far away.
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

/// Whether a text seems to be a mechanism file, not a file of joint axes.
pub fn is_mechanism(text: &str) -> bool {
    reader::first_word(text).is_some_and(|word| word == "Mechanism")
}

impl AxesDescription {
    /// Reads the text of a file of joint axes, or returns all its problems of form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, mut problems) = reader::read_axes(text);
        if let Some(description) = &description {
            super::checks::check_axes(description, &mut problems);
        }
        problems.sort_by_key(|problem| (problem.span.start, problem.span.end));
        match description {
            Some(description) if problems.is_empty() => Ok(description),
            _ => Err(problems),
        }
    }
}
