//! Questions that cannot be answered as they are posed.

use thiserror::Error;

use super::study_error::StudyError;
use crate::algebra::EvaluationError;
use crate::analysis::assemblies::AssembliesError;
use crate::analysis::solver::NoSolver;
use crate::description::{count, listed};
use crate::mechanism::QuantityError;
use crate::system::{DriveError, ForceError, PointError, QuestionError};

/// A demand of a question that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its index among [`Question::demands`](super::Question::demands).
    pub index: usize,
    /// The index of the value that is wrong, if not the name or all of it.
    pub value: Option<usize>,
}

impl Item {
    pub(super) fn new(index: usize) -> Item {
        Item { index, value: None }
    }

    pub(super) fn value(self, value: usize) -> Item {
        Item {
            value: Some(value),
            ..self
        }
    }

    /// The error of a kind for what is wrong with it.
    pub(super) fn wrong<E>(self, of: fn(Item, Box<E>) -> AskError) -> impl Fn(E) -> AskError {
        move |error| of(self, Box::new(error))
    }

    /// The error for a quantity that cannot be known.
    pub(super) fn unmeasured(self, quantity: &str, error: Unmeasured) -> AskError {
        AskError::Unmeasured {
            item: self,
            quantity: quantity.to_owned(),
            error,
        }
    }

    /// The error for a text that is no quantity.
    pub(super) fn quantity(self, text: &str) -> impl Fn(QuantityError) -> AskError {
        move |error| AskError::Quantity {
            item: self,
            text: text.to_owned(),
            error: Box::new(error),
        }
    }
}

/// Reasons for which a question has no answer as it is posed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AskError {
    /// A name or a value is wrong.
    #[error("{1}")]
    Named(Item, Box<QuestionError>),
    /// The question as a whole holds too much or too little.
    #[error("{0}")]
    Question(#[from] QuestionError),
    /// The question of a map holds too much or too little.
    #[error("{error}")]
    Mapped {
        /// The error.
        error: Box<QuestionError>,
        /// The mapped coordinates.
        mapped: Vec<String>,
        /// Coordinates of platforms that are to be mapped or held too, if the actuated joints are free.
        missing: Vec<String>,
    },
    /// A whole platform is mapped, or a coordinate of something that is no platform.
    #[error("{1}")]
    NotMapped(Item, Box<QuestionError>),
    /// A rate or an acceleration is wrong.
    #[error("{1}")]
    Drive(Item, Box<DriveError>),
    /// A load is wrong.
    #[error("{1}")]
    Load(Item, Box<ForceError>),
    /// The frame of a point stands still.
    #[error("`{1}` does not move")]
    Motionless(Item, String),
    /// There is no coordinate and no frame of the name of an output.
    #[error("`{1}` is neither a coordinate nor a frame")]
    UnknownOutput(Item, String),
    /// A point is wrong.
    #[error("{1}")]
    Point(Item, PointError),
    /// A quantity is wrong.
    #[error("{error}")]
    Quantity {
        /// The list that it stands in.
        item: Item,
        /// The expression.
        text: String,
        /// The error in it.
        error: Box<QuantityError>,
    },
    /// A quantity cannot be known on the motion.
    #[error("`{quantity}` has no value: {error}")]
    Unmeasured {
        /// The list that it stands in.
        item: Item,
        /// Its name.
        quantity: String,
        /// The reason.
        error: Unmeasured,
    },
    /// The analysis would not use a demand.
    #[error("{analysis} takes no {demand}")]
    Unused {
        /// The demand.
        item: Item,
        /// The analysis.
        analysis: &'static str,
        /// The demand in words.
        demand: String,
        /// The analyses that take such demands.
        takers: Vec<&'static str>,
    },
    /// Every mode is asked for where an analysis is of one.
    #[error("all modes are asked for, and this analysis is of one")]
    AllModes,
    /// The time of a motion is none.
    #[error("the duration of a motion must be positive, not {0} s")]
    Duration(f64),
    /// One name has two ranges or values.
    #[error("`{name}` is given twice")]
    Twice {
        /// The second of them.
        item: Item,
        /// The first.
        first: Item,
        /// The name.
        name: String,
    },
    /// One coordinate has two columns of values.
    #[error("`{0}` is given twice")]
    TwoColumns(String),
    /// The range of a coordinate has no length, or its end comes before its beginning where that matters.
    #[error("the range of `{1}` is empty")]
    EmptyRange(Item, String),
    /// A motion begins outside the limits of a joint.
    #[error("the motion begins outside the limits of `{name}`")]
    OutsideLimits {
        /// The input.
        item: Item,
        /// The joint.
        name: String,
        /// Its limits in m or rad.
        limits: (f64, f64),
        /// True if it turns.
        is_angle: bool,
    },
    /// A mapped coordinate is held or freed too.
    #[error("`{1}` is given a range and also held or freed")]
    AlsoHeld(Item, String),
    /// A coordinate that comes round again is mapped, or an angle of a platform moved, over more than a turn.
    #[error("the range of `{0}` is wider than a full turn")]
    MoreThanATurn(String),
    /// An input that turns more often than is followed.
    #[error("`{name}` would turn {} times, and at most {most} turns are followed", turns.round())]
    TooManyTurns {
        /// The input.
        item: Item,
        /// Its name.
        name: String,
        /// The turns it would make.
        turns: f64,
        /// The turns it may make.
        most: f64,
    },
    /// Nothing moves, though a joint may be driven.
    #[error("no input moves")]
    NothingMoves(Option<String>),
    /// A number of steps outside its range.
    #[error("a motion has 1 to {most} steps, not {given}")]
    Steps {
        /// The number given.
        given: usize,
        /// The largest number allowed.
        most: usize,
    },
    /// Random starts, or nodes that are searched.
    #[error("a search has 1 to {most} starts or nodes, not {given}")]
    Starts {
        /// The number given.
        given: usize,
        /// The largest number allowed.
        most: usize,
    },
    /// Nothing is left to move: this holds as much as the mechanism has freedoms.
    #[error("{}", nothing_left(.0))]
    NothingLeft(Vec<String>),
    /// More than one freedom is left.
    #[error("{}", not_one_freedom(.0))]
    NotOneFreedom(QuestionError),
    /// The freedom is not that of one joint or of one coordinate of a platform.
    #[error("the remaining freedom is not that of one joint or one coordinate of a platform")]
    NotOneCoordinate,
    /// The mechanism does not assemble with this held, where the work is to begin.
    #[error("no assembly was found {}", with_held(.0))]
    NotAssembled(Vec<String>),
    /// There is no mode of that number.
    #[error("{}", no_such_mode(*mode, *modes))]
    NoSuchMode {
        /// The number.
        mode: usize,
        /// Number of modes.
        modes: usize,
    },
    /// No input can be driven.
    #[error("nothing is driven: singularities are defined with respect to inputs")]
    NothingToDrive,
    /// Loci need a box of two sides.
    #[error("a locus needs two coordinates, but {0} {are} given", are = if *.0 == 1 { "is" } else { "are" })]
    Sides(usize),
    /// A map has one to three coordinates.
    #[error("{}", wrong_axes(*.0))]
    Axes(usize),
    /// Links that spin without a joint that could be held still; the number of these freedoms.
    #[error(
        "{} of links that spin about their own axes remain whatever the inputs do",
        count(*.0, "freedom")
    )]
    Spinning(usize),
    /// The mechanism has too many unknowns.
    #[error("the mechanism has {0} unknowns, too many for this analysis")]
    TooLarge(usize),
    /// The nodes of a map are not one number or one for each coordinate, or too few.
    #[error("{}", wrong_grid(nodes, *axes))]
    Grid {
        /// The numbers of nodes given.
        nodes: Vec<usize>,
        /// Number of mapped coordinates.
        axes: usize,
    },
    /// A map would take too much memory.
    #[error(
        "the grid has {nodes} nodes, which in one mode alone take {:.1} GB of {:.1} GB",
        bytes / 1e9,
        most / 1e9
    )]
    TooFine {
        /// Its nodes.
        nodes: f64,
        /// Memory that they take, in bytes.
        bytes: f64,
        /// Memory that they may take, in bytes.
        most: f64,
    },
    /// More was reached than memory allows.
    #[error(
        "{cells} nodes in modes were reached, which take all of {:.1} GB",
        most / 1e9
    )]
    TooMany {
        /// The nodes in modes that may be kept.
        cells: usize,
        /// Memory that they may take, in bytes.
        most: f64,
    },
    /// The search for assemblies cannot be made.
    #[error("{0}")]
    Assemblies(AssembliesError),
    /// The store cannot be used.
    #[error("{0}")]
    Store(String),
    /// There is no such study.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// An expression of the file has no value in letters.
    #[error("{0}")]
    Formula(EvaluationError),
    /// The question has no solver of its own.
    #[error("{0}")]
    NoSolver(NoSolver),
    /// The work was stopped before its first result.
    #[error("interrupted before the first result")]
    Interrupted,
}

/// Reasons for which a quantity cannot be known on a motion.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unmeasured {
    /// It depends on the inputs, and none moves.
    #[error("it depends on how the inputs move, and none moves")]
    NoInput,
    /// The coordinate is not held, so that no force holds it.
    #[error("`{name}` is not held, so no force holds it")]
    NotHeld {
        /// The coordinate.
        name: String,
        /// Names of the coordinates that are held or moved as inputs.
        held: Vec<String>,
    },
    /// A speed or a load of a motion follows from what is not known before it is.
    #[error("it follows from {what} alone")]
    Follows {
        /// The quantities from which it may follow.
        what: &'static str,
    },
    /// Nothing is loaded.
    #[error("without a load all forces are zero")]
    NoLoad,
    /// Only a square Jacobian has a determinant.
    #[error("the Jacobian has no determinant: it is {rows} × {columns}")]
    NotSquare {
        /// Rates of outputs.
        rows: usize,
        /// Inputs.
        columns: usize,
    },
}

impl AskError {
    /// The part of the question that is wrong, if it is one.
    pub fn item(&self) -> Option<Item> {
        match self {
            AskError::Named(item, _)
            | AskError::NotMapped(item, _)
            | AskError::Drive(item, _)
            | AskError::Load(item, _)
            | AskError::Motionless(item, _)
            | AskError::UnknownOutput(item, _)
            | AskError::Point(item, _)
            | AskError::EmptyRange(item, _)
            | AskError::AlsoHeld(item, _)
            | AskError::Quantity { item, .. }
            | AskError::Unmeasured { item, .. }
            | AskError::Twice { item, .. }
            | AskError::Unused { item, .. }
            | AskError::TooManyTurns { item, .. }
            | AskError::OutsideLimits { item, .. } => Some(*item),
            _ => None,
        }
    }
}

fn nothing_left(held: &[String]) -> String {
    match held {
        [] => "the mechanism has no freedom, so there is no motion to follow".into(),
        held => format!("with {} held no freedom remains", listed(held)),
    }
}

fn with_held(held: &[String]) -> String {
    match held {
        [] => "near the start".into(),
        [one] => format!("with {one} held at its value"),
        several => format!("with {} held at their values", listed(several)),
    }
}

fn not_one_freedom(error: &QuestionError) -> String {
    match error {
        QuestionError::TooFew { mobility, held, .. } => {
            let left = count(mobility.saturating_sub(*held), "freedom");
            format!("{left} remain, but a curve has one")
        }
        error => error.to_string(),
    }
}

fn wrong_axes(given: usize) -> String {
    match given {
        0 => "nothing is mapped".into(),
        _ => format!("{given} coordinates are mapped, and a map has one, two or three"),
    }
}

fn wrong_grid(nodes: &[usize], axes: usize) -> String {
    match nodes.iter().any(|n| *n < 2) {
        true => "a grid has at least 2 nodes along each coordinate".into(),
        false => format!(
            "{} numbers of nodes are given for {}",
            nodes.len(),
            count(axes, "mapped coordinate")
        ),
    }
}

fn no_such_mode(mode: usize, modes: usize) -> String {
    match modes {
        0 => "there is no assembly with these inputs".into(),
        _ => format!("there is no mode {mode}: with these inputs there are modes 1 to {modes}"),
    }
}
