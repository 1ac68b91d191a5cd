//! The values expected at each place of a mechanism file, with the words for them.

use std::fmt::{self, Display, Formatter};

use super::ClosureKind;

macro_rules! nouns {
    ($($(#[$about:meta])* $name:ident = $said:literal, $content:literal;)+) => {
        /// The kinds of named items, as sentences call them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[allow(missing_docs)]
        pub enum Noun {
            $($name,)+
        }

        impl Noun {
            /// As sentences call it, and the value behind its name in a map.
            fn words(self) -> (&'static str, &'static str) {
                match self {
                    $(Noun::$name => ($said, $content),)+
                }
            }
        }
    };
}

nouns! {
    Field = "a field", "a value";
    Parameter = "a parameter", "a number or an expression";
    Joint = "a joint", "`Passive(…)` or `Actuated(…)`";
    Axis = "a joint", "a joint such as `Revolute(…)`, `Prismatic(…)` or `Spherical(…)`";
    Body = "a body", "`(origin: (x, y, z))`";
    Point = "a point", "`(body: \"…\", at: (x, y, z))`";
    Chain = "a chain", "`Chain(…)`";
    Platform = "a platform", "`Platform(…)`";
    PlatformFrame = "a platform frame", "a list of displacements";
    Closure = "a closure", "a closure";
    Coupling = "a coupling", "an expression of joints";
    ClosedForm = "a closed form", "`ClosedForm(…)`";
    LocalName = "a local name", "a number or an expression";
    MatrixEntry = "an entry of a pose", "a number or an expression";
    Identity = "an identity", "a number or an expression";
    Output = "an output", "a number or an expression";
    Mass = "a mass", "`(mass: …)`";
    Load = "a load", "`Spring(…)`, `Force(…)` or `Friction(…)`";
    Varied = "a number that varies", "a range `(least, greatest)`, a list of values or an expression";
    Input = "an input", "a range `(least, greatest)`";
    Target = "a target", "a value or the coordinates of a point";
}

impl Display for Noun {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.words().0)
    }
}

/// A group of named fields in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FieldGroup {
    /// The name before its fields.
    pub word: &'static str,
    pub(super) form: &'static GroupForm,
}

/// The words and the fields of a group.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct GroupForm {
    /// As sentences call it.
    pub said: &'static str,
    pub fields: &'static [&'static [&'static str]],
    /// Those of structures within it, which stand behind its own.
    pub within: &'static [&'static [&'static [&'static str]]],
}

/// The form of a group: its words, then its fields.
macro_rules! form {
    ($said:literal, $($fields:expr),+) => {
        &$crate::description::expectation::GroupForm {
            said: $said,
            fields: &[$($fields),+],
            within: &[],
        }
    };
}
pub(super) use form;

impl FieldGroup {
    /// The fields it may have.
    pub fn fields(self) -> impl Iterator<Item = &'static str> {
        let within = self.form.within.iter().copied().flatten();
        let all = self.form.fields.iter().chain(within);
        all.flat_map(|names| names.iter().copied())
    }
}

impl Display for FieldGroup {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.form.said)
    }
}

/// The value expected at a place of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Expected {
    /// Named fields.
    Fields(FieldGroup),
    /// The name of something.
    NameOf(Noun),
    /// Things behind their names.
    MapOf(Noun),
    /// The entries of the displacement of that word.
    DisplacementEntries(&'static str),
    /// The frames of the closure of that kind, and the length of a distance.
    ClosureFrames(ClosureKind),
    /// An expression over quantities.
    Quantity,
    /// As sentences call it.
    Said(&'static str),
    /// Parts in parentheses: as sentences call them together, and each of them.
    Parts(&'static [&'static str; 2]),
}

#[allow(missing_docs)]
impl Expected {
    pub const TEXT: Self = Self::Said("a string");
    pub const FRAME: Self = Self::Said("the name of a frame");
    pub const BODY: Self = Self::Said("the name of a body");
    pub const ENTRY: Self = Self::Said("a number or an expression");
    pub const VECTOR: Self = Self::Said("a vector `(x, y, z)`");
    pub const ROWS: Self = Self::Said("a list of rows");
    pub const TRANSFORM: Self = Self::Said("a list of displacements");
    pub const JOINT: Self = Self::Said("`Passive(…)` or `Actuated(…)`");
    pub const LIMITS: Self = Self::Said("limits `(lowest, highest)`");
    pub const CONVENTION: Self = Self::Said("`Modified` or `Standard`");
    pub const ROLE: Self = Self::Said("`Passive` or `Actuated`");
    pub const ROTATION: Self = Self::Parts(&["a rotation matrix", "row"]);
    pub const HOMOGENEOUS: Self = Self::Parts(&["a transform", "row"]);
    pub const BODIES: Self = Self::Parts(&["two bodies `(\"ground\", \"crank\")`", "body"]);
    pub const POINTS: Self =
        Self::Parts(&["two points `(\"crank\", \"ground+0.1,0,0\")`", "point"]);
    pub const CUTS: Self = Self::Said("a list of joints");
    pub const INERTIA: Self = Self::Said("moments of inertia `(Ixx, Iyy, Izz, Ixy, Ixz, Iyz)`");
    pub const SHAPE: Self = Self::Said("a shape such as `Rod(…)` or `Box(…)`");
    pub const RANGE: Self = Self::Said("a range `(least, greatest)`");

    /// The value expected for each part of it.
    pub(super) fn part(self) -> Self {
        match self {
            Self::MapOf(Noun::Output) => Self::Quantity,
            Self::MapOf(Noun::PlatformFrame) => Self::TRANSFORM,
            Self::BODIES => Self::BODY,
            Self::POINTS => Self::FRAME,
            Self::CUTS => Self::NameOf(Noun::Axis),
            _ => Self::ENTRY,
        }
    }

    /// As messages count its parts.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::ClosureFrames(ClosureKind::Coupling) => "expression",
            Self::ClosureFrames(kind) if kind.has_length() => "value",
            Self::ClosureFrames(_) => "frame",
            Self::Parts([_, part]) => part,
            _ => "entry",
        }
    }
}

impl Display for Expected {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Fields(group) => write!(f, "{group}, `{}(…)`", group.word),
            Self::NameOf(noun) => write!(f, "the name of {noun}"),
            Self::MapOf(noun) => {
                let content = noun.words().1;
                write!(f, "a map in which each name is followed by {content}")
            }
            Self::DisplacementEntries(word) => write!(f, "`{word}(…)`"),
            Self::ClosureFrames(kind) if kind.has_length() => {
                write!(f, "`{}(frame, frame, length)`", kind.word())
            }
            Self::ClosureFrames(ClosureKind::Coupling) => f.write_str("`Coupling(expression)`"),
            Self::ClosureFrames(kind) => write!(f, "`{}(frame, frame)`", kind.word()),
            Self::Quantity => Self::ENTRY.fmt(f),
            Self::Said(words) | Self::Parts([words, _]) => f.write_str(words),
        }
    }
}

/// The value found at a place of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum FoundValue {
    Number,
    Text,
    Character,
    Bytes,
    List,
    Map,
    /// `(…, …)`
    Tuple,
    /// `(name: …)`
    Fields,
    Word(String),
    /// A word followed by parentheses.
    Call(String),
}

impl Display for FoundValue {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Number => "a number",
            Self::Text => "a string",
            Self::Character => "a character in apostrophes",
            Self::Bytes => "a byte string",
            Self::List => "a list `[…]`",
            Self::Map => "a map `{…}`",
            Self::Tuple => "values without field names `(…)`",
            Self::Fields => "fields `(name: …)`",
            Self::Word(word) => return write!(f, "`{word}`"),
            Self::Call(word) => return write!(f, "`{word}(…)`"),
        })
    }
}
