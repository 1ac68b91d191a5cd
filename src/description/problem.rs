//! Problems of a mechanism file, as data. `words.rs` has the English words.

use std::ops::Range;

use super::{AxesProblem, Expected, Found, Structure};
use crate::algebra::{EvaluationErrorKind, MeasureErrorKind, ParseErrorKind};

/// A problem of a mechanism file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What is wrong.
    pub kind: ProblemKind,
    /// The offending bytes of the file.
    pub span: Range<usize>,
    /// Other places involved.
    pub related: Vec<(Range<usize>, Note)>,
}

/// How serious a problem is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; the file is usable.
    Warning,
    /// The file is refused.
    Error,
}

/// How another place is involved in a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Note {
    /// The name or field was first given here.
    FirstHere(Noun),
    /// The same problem is here too.
    AlsoHere,
    /// This bracket is still open.
    StillOpen,
    /// The joint is declared here.
    DeclaredHere(Noun),
    /// One more step of a cycle.
    ThenHere,
}

/// The kinds of named items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Noun {
    Field,
    Parameter,
    Joint,
    Axis,
    Chain,
    Platform,
    PlatformFrame,
    Closure,
    ClosedForm,
    LocalName,
    MatrixEntry,
    Identity,
}

/// Which names an expression may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scope {
    /// Parameters only.
    Parameters,
    /// Parameters and joint variables.
    ParametersAndJoints,
    /// Parameters, joint variables and the local names of a closed form.
    ClosedForm,
}

/// What is wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum ProblemKind {
    /// The text is larger than the limit.
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// There is nothing in the file.
    Empty,
    /// Brackets nested too deeply.
    TooDeep,
    /// The text is not RON.
    Syntax {
        /// The error of `ron`.
        error: Box<ron::Error>,
        /// The character at which it stopped; `None` at the end of the text.
        found: Option<char>,
    },
    /// The file is for a later version of the program.
    LaterVersion(f64),
    /// The version is not a positive whole number.
    NotAVersion(f64),
    /// Something of the wrong type.
    WrongType {
        /// What is expected.
        expected: Expected,
        /// What was found.
        found: Found,
    },
    /// Too few or too many things in parentheses.
    WrongLength {
        /// What is expected.
        of: Expected,
        /// How many parts it has.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A word that is none of those possible here.
    UnknownWord {
        /// What is expected.
        expected: Expected,
        /// The word.
        word: String,
        /// The word that was probably meant.
        suggestion: Option<String>,
        /// The words possible here.
        known: Vec<&'static str>,
    },
    /// A field that the structure does not have.
    UnknownField {
        /// The structure.
        structure: Structure,
        /// The field.
        field: String,
        /// The field that was probably meant.
        suggestion: Option<String>,
    },
    /// A field that the structure must have.
    MissingField {
        /// The structure.
        structure: Structure,
        /// The field.
        field: &'static str,
    },
    /// A field given twice.
    DuplicateField {
        /// The field.
        field: String,
    },
    /// A name given twice.
    DuplicateName {
        /// The kind of item.
        noun: Noun,
        /// The name.
        name: String,
    },
    /// An expression that does not parse.
    Expression(ParseErrorKind),
    /// A number that is infinite or not a number.
    NotFinite,
    /// A name that no expression could use.
    NotAName {
        /// The kind of item.
        noun: Noun,
        /// The name.
        name: String,
    },
    /// A reserved name.
    ReservedName {
        /// The kind of item.
        noun: Noun,
        /// The name.
        name: String,
    },
    /// The name of a chain or platform has a dot, which separates it from the names of its frames.
    DottedName {
        /// The kind of item.
        noun: Noun,
        /// The name.
        name: String,
    },
    /// A name without a letter.
    EmptyName {
        /// The kind of item.
        noun: Noun,
    },
    /// Neither the file nor the chain gives the convention of the rows.
    NoConvention {
        /// The chain.
        chain: String,
    },
    /// A closed form that gives neither a pose nor an identity.
    EmptyClosedForm,
    /// A closed form that gives a pose and an identity.
    MixedClosedForm,
    /// A key of `entries` that is no entry of `[R | p]`.
    UnknownMatrixEntry {
        /// The key.
        name: String,
    },
    /// The fourth row of a transform is not (0, 0, 0, 1).
    WrongLastRow,
    /// An expression uses an unknown name.
    UnknownName {
        /// The name.
        name: String,
        /// The name that was probably meant.
        suggestion: Option<String>,
        /// The names possible here.
        scope: Scope,
    },
    /// A joint variable where only parameters are allowed.
    JointNotAllowed {
        /// The joint.
        name: String,
    },
    /// The name of a frame that does not exist.
    UnknownFrame {
        /// The name.
        name: String,
        /// The frame that was probably meant.
        suggestion: Option<String>,
    },
    /// A link frame beyond the last row of a chain.
    NoSuchLink {
        /// The chain.
        chain: String,
        /// The number of the link.
        link: String,
        /// How many rows the chain has.
        rows: usize,
    },
    /// Parameters or local names defined through one another.
    DefinitionCycle {
        /// What they are.
        noun: Noun,
        /// The names; the first follows the last.
        names: Vec<String>,
    },
    /// Chains attached to one another in a cycle.
    ChainCycle {
        /// The names; the first follows the last.
        names: Vec<String>,
    },
    /// An expression that is not constant + Σ coefficient·joint.
    NotAffine,
    /// An expression that has no value.
    NoValue(EvaluationErrorKind),
    /// A unit that does not fit.
    Unit(MeasureErrorKind),
    /// A closure between two frames of one body.
    SameBody {
        /// The closure.
        closure: String,
    },
    /// A distance that is negative.
    NegativeDistance {
        /// The length (m).
        length: f64,
    },
    /// The lowest value is above the highest.
    LimitsReversed {
        /// The joint.
        joint: String,
        /// The lowest value (rad or m).
        low: f64,
        /// The highest value (rad or m).
        high: f64,
    },
    /// The home value is not within the limits.
    HomeOutsideLimits {
        /// The joint.
        joint: String,
        /// The home value (rad or m).
        home: f64,
        /// The lowest value (rad or m).
        low: f64,
        /// The highest value (rad or m).
        high: f64,
    },
    /// Neither a chain nor a platform.
    NothingToAnalyse,
    /// A joint variable that no chain and no closure uses.
    UnusedJoint {
        /// The joint.
        name: String,
    },
    /// An unused parameter.
    UnusedParameter {
        /// The parameter.
        name: String,
    },
    /// A joint variable that moves no closure.
    UnfeltJoint {
        /// The joint.
        name: String,
    },
    /// A link length below zero: the x axis points the other way.
    NegativeLinkLength {
        /// The chain.
        chain: String,
        /// The number of the row, from 1.
        row: usize,
        /// The length (m).
        a: f64,
    },
    /// A distance of zero, whose equation is singular where it holds.
    ZeroDistance {
        /// The closure.
        closure: String,
    },
    /// A problem of a file of joint axes.
    Axes(Box<AxesProblem>),
    /// A platform that no closure and no chain touches.
    UnusedPlatform {
        /// The platform.
        name: String,
    },
}

impl ProblemKind {
    /// Whether the file is refused.
    pub fn severity(&self) -> Severity {
        match self {
            Self::UnusedJoint { .. }
            | Self::UnusedParameter { .. }
            | Self::UnusedPlatform { .. }
            | Self::UnfeltJoint { .. }
            | Self::NegativeLinkLength { .. }
            | Self::HomeOutsideLimits { .. } => Severity::Warning,
            Self::Axes(problem) if problem.is_warning() => Severity::Warning,
            _ => Severity::Error,
        }
    }

    /// The problem of this kind at `span`.
    pub fn at(self, span: Range<usize>) -> Problem {
        Problem {
            kind: self,
            span,
            related: Vec::new(),
        }
    }
}

impl Problem {
    /// Whether the file is refused.
    pub fn severity(&self) -> Severity {
        self.kind.severity()
    }

    /// The same problem, with one more place involved.
    pub fn with(mut self, span: Range<usize>, note: Note) -> Self {
        self.related.push((span, note));
        self
    }
}
