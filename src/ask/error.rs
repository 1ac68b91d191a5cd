//! Questions that cannot be answered as they are posed.

use std::fmt::{self, Display, Formatter};

use crate::analysis::assemblies::AssembliesError;
use crate::analysis::sweep::PointError;
use crate::description::{count, listed};
use crate::system::{DriveError, ForceError, QuestionError};

/// What a name or a value is in a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Something held.
    Hold,
    /// Something freed.
    Free,
    /// A start of the search.
    Guess,
    /// A coordinate that moves or is mapped: its name or its whole range.
    Input,
    /// The beginning of its range.
    From,
    /// The end of its range.
    To,
    /// An output of singularities.
    Output,
    /// A point.
    Point,
    /// A rate.
    Rate,
    /// An acceleration.
    Acceleration,
    /// A wrench.
    Wrench,
    /// A load on a joint.
    Load,
}

/// A part of a question: the how-manieth of its role, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its role.
    pub role: Role,
    /// Its index among those of its role, in the order in which they were given.
    pub index: usize,
}

impl Role {
    pub(super) fn item(self, index: usize) -> Item {
        Item { role: self, index }
    }

    /// The error for the part of this index.
    pub(super) fn named(self, index: usize) -> impl Fn(QuestionError) -> AskError {
        move |error| AskError::Named {
            item: self.item(index),
            error: Box::new(error),
        }
    }
}

/// Why a question has no answer as it is posed. Who asks puts it right.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum AskError {
    /// A name or a value is wrong.
    Named {
        /// Which.
        item: Item,
        /// What is wrong with it.
        error: Box<QuestionError>,
    },
    /// The question as a whole holds too much or too little.
    Question(QuestionError),
    /// The same for a map.
    Mapped {
        /// What is wrong.
        error: Box<QuestionError>,
        /// The mapped coordinates.
        mapped: Vec<String>,
        /// Coordinates of platforms that are to be mapped or held too, if the actuated joints are free.
        missing: Vec<String>,
    },
    /// A whole platform is mapped, or a coordinate of what is no platform.
    NotMapped {
        /// Which.
        item: Item,
        /// What is wrong with it.
        error: Box<QuestionError>,
    },
    /// A rate or an acceleration is wrong.
    Drive {
        /// Which.
        item: Item,
        /// What is wrong with it.
        error: Box<DriveError>,
    },
    /// A load is wrong.
    Load {
        /// Which.
        item: Item,
        /// What is wrong with it.
        error: Box<ForceError>,
    },
    /// There is no frame of that name.
    UnknownFrame {
        /// Which point.
        item: Item,
        /// Its name.
        name: String,
    },
    /// The frame stands still.
    Motionless {
        /// Which point.
        item: Item,
        /// Its name.
        name: String,
    },
    /// There is no coordinate and no frame of that name.
    UnknownOutput {
        /// Which output.
        item: Item,
        /// Its name.
        name: String,
    },
    /// A traced point is wrong.
    Traced {
        /// Which point.
        item: Item,
        /// What is wrong with it.
        error: PointError,
    },
    /// A range is given to one coordinate twice.
    Twice {
        /// The second of them.
        item: Item,
        /// The first.
        first: Item,
        /// The coordinate.
        name: String,
    },
    /// A range has no length, or its end comes before its beginning where that matters.
    EmptyRange {
        /// Which.
        item: Item,
        /// The coordinate.
        name: String,
    },
    /// A motion begins outside the limits of a joint.
    OutsideLimits {
        /// Which input.
        item: Item,
        /// The joint.
        name: String,
        /// Its limits in m or rad.
        limits: (f64, f64),
        /// Whether it turns.
        is_angle: bool,
    },
    /// A mapped coordinate is held or freed too.
    AlsoHeld {
        /// Which.
        item: Item,
        /// The coordinate.
        name: String,
    },
    /// A mapped coordinate that comes round again covers more than a turn.
    MoreThanATurn {
        /// The coordinate.
        name: String,
    },
    /// Nothing moves.
    NothingMoves {
        /// The driven joint, if there is one.
        driven: Option<String>,
    },
    /// A motion of so many steps.
    Steps {
        /// How many were given.
        given: usize,
        /// How many can be made.
        most: usize,
    },
    /// Random starts, or nodes that are searched.
    Starts {
        /// How many were given.
        given: usize,
        /// How many there can be.
        most: usize,
    },
    /// Nothing is left to move: as much is held as the mechanism has freedoms.
    NothingLeft {
        /// What is held.
        held: Vec<String>,
    },
    /// More than one freedom is left.
    NotOneFreedom(QuestionError),
    /// The freedom is not that of one joint.
    NotOneJoint,
    /// The mechanism does not assemble where the work is to begin.
    NotAssembled {
        /// What is held there.
        held: Vec<String>,
    },
    /// There is no mode of that number.
    NoSuchMode {
        /// The number.
        mode: usize,
        /// How many modes there are.
        modes: usize,
    },
    /// No input can be driven.
    NothingToDrive,
    /// Loci need a box of two sides.
    Sides(usize),
    /// A map has one to three coordinates.
    Axes(usize),
    /// Some link spins without a joint that could stand still; so many such freedoms.
    Spinning(usize),
    /// The mechanism has too many unknowns.
    TooLarge {
        /// How many it has.
        unknowns: usize,
    },
    /// The nodes of a map are not one number or one for each coordinate, or too few.
    Grid {
        /// What was given.
        nodes: Vec<usize>,
        /// How many coordinates are mapped.
        axes: usize,
    },
    /// A map would take too much memory.
    TooFine {
        /// Its nodes.
        nodes: f64,
        /// What they take.
        bytes: f64,
        /// What they may take.
        most: f64,
    },
    /// More was reached than memory allows.
    TooMany {
        /// The nodes in modes that may be kept.
        cells: usize,
        /// What they may take in bytes.
        most: f64,
    },
    /// The search for assemblies cannot be made.
    Assemblies(AssembliesError),
    /// The store cannot be used.
    Store(String),
    /// The work was stopped before its first result.
    Interrupted,
}

impl AskError {
    /// The part of the question that is wrong, if it is one.
    pub fn item(&self) -> Option<Item> {
        match self {
            AskError::Named { item, .. }
            | AskError::NotMapped { item, .. }
            | AskError::Drive { item, .. }
            | AskError::Load { item, .. }
            | AskError::UnknownFrame { item, .. }
            | AskError::Motionless { item, .. }
            | AskError::UnknownOutput { item, .. }
            | AskError::Traced { item, .. }
            | AskError::Twice { item, .. }
            | AskError::EmptyRange { item, .. }
            | AskError::OutsideLimits { item, .. }
            | AskError::AlsoHeld { item, .. } => Some(*item),
            _ => None,
        }
    }
}

impl Display for AskError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            AskError::Named { error, .. }
            | AskError::Mapped { error, .. }
            | AskError::NotMapped { error, .. } => write!(f, "{error}"),
            AskError::NotOneFreedom(QuestionError::TooFew { mobility, held, .. }) => {
                let left = count(mobility.saturating_sub(*held), "freedom");
                write!(f, "{left} remain, but a curve has one")
            }
            AskError::Question(error) | AskError::NotOneFreedom(error) => write!(f, "{error}"),
            AskError::Drive { error, .. } => write!(f, "{error}"),
            AskError::Load { error, .. } => write!(f, "{error}"),
            AskError::Traced { error, .. } => write!(f, "{error}"),
            AskError::UnknownFrame { name, .. } => write!(f, "`{name}` is not a frame"),
            AskError::Motionless { name, .. } => write!(f, "`{name}` does not move"),
            AskError::UnknownOutput { name, .. } => {
                write!(f, "`{name}` is neither a coordinate nor a frame")
            }
            AskError::Twice { name, .. } => write!(f, "`{name}` has two ranges"),
            AskError::EmptyRange { name, .. } => write!(f, "the range of `{name}` is empty"),
            AskError::OutsideLimits { name, .. } => {
                write!(f, "the motion begins outside the limits of `{name}`")
            }
            AskError::AlsoHeld { name, .. } => {
                write!(f, "`{name}` is given a range and also held or freed")
            }
            AskError::MoreThanATurn { name } => {
                write!(f, "the map of `{name}` is wider than a full turn")
            }
            AskError::NothingMoves { .. } => write!(f, "no input moves"),
            AskError::Steps { given, most } => {
                write!(f, "a motion has 1 to {most} steps, not {given}")
            }
            AskError::Starts { given, most } => {
                write!(f, "a search has 1 to {most} starts or nodes, not {given}")
            }
            AskError::NothingLeft { held } if held.is_empty() => {
                write!(
                    f,
                    "the mechanism has no freedom, so there is no motion to follow"
                )
            }
            AskError::NothingLeft { held } => {
                write!(f, "with {} held no freedom remains", listed(held))
            }
            AskError::NotOneJoint => write!(f, "the freedom that is left is not that of one joint"),
            AskError::NotAssembled { held } => write!(
                f,
                "the mechanism does not assemble where the motion begins: {}",
                held.join(", ")
            ),
            AskError::NoSuchMode { modes: 0, .. } => {
                write!(f, "there is no assembly with these inputs")
            }
            AskError::NoSuchMode { mode, modes } => write!(
                f,
                "there is no mode {mode}: with these inputs there are modes 1 to {modes}"
            ),
            AskError::NothingToDrive => write!(
                f,
                "nothing is driven: singularities are defined with respect to inputs"
            ),
            AskError::Sides(given) => {
                let are = if *given == 1 { "is" } else { "are" };
                write!(f, "a locus needs two coordinates, but {given} {are} given")
            }
            AskError::Axes(0) => write!(f, "nothing is mapped"),
            AskError::Axes(given) => write!(
                f,
                "{given} coordinates are mapped, and a map has one, two or three"
            ),
            AskError::Spinning(spins) => write!(
                f,
                "{} of links that spin about their own axes remain whatever the inputs do",
                count(*spins, "freedom")
            ),
            AskError::TooLarge { unknowns } => write!(
                f,
                "the mechanism has {unknowns} unknowns, too many for this analysis"
            ),
            AskError::Grid { nodes, .. } if nodes.iter().any(|n| *n < 2) => {
                write!(f, "a grid has at least 2 nodes along each coordinate")
            }
            AskError::Grid { nodes, axes } => write!(
                f,
                "{} numbers of nodes are given for {}",
                nodes.len(),
                count(*axes, "mapped coordinate")
            ),
            AskError::TooFine { nodes, bytes, most } => write!(
                f,
                "the grid has {nodes} nodes, which in one mode alone take {:.1} GB of {:.1} GB",
                bytes / 1e9,
                most / 1e9
            ),
            AskError::TooMany { cells, most } => write!(
                f,
                "{cells} nodes in modes were reached, which take all of {:.1} GB",
                most / 1e9
            ),
            AskError::Assemblies(error) => write!(f, "{error}"),
            AskError::Store(error) => write!(f, "{error}"),
            AskError::Interrupted => write!(f, "interrupted before the first result"),
        }
    }
}

impl std::error::Error for AskError {}
