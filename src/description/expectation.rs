//! The values expected at each place of a mechanism file.

use crate::algebra::words;

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

words! {
    /// The groups of named fields in a file, with the names that stand before them.
    #[allow(missing_docs)]
    Structure {
        Mechanism = "Mechanism",
        Passive = "Passive",
        Actuated = "Actuated",
        Chain = "Chain",
        Row = "Row",
        Platform = "Platform",
        ClosedForm = "ClosedForm",
        Axes = "Axes",
        RevoluteAxis = "Revolute",
        PrismaticAxis = "Prismatic",
        SphericalCentre = "Spherical",
    }
}

/// The value expected at a place of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Expected {
    /// The fields of a structure.
    Fields(Structure),
    /// The number of the file format.
    Version,
    /// Any text.
    Text,
    /// A name, as the key of a map.
    NameOf(Noun),
    /// The name of a frame.
    Frame,
    /// A number or an expression.
    Entry,
    /// A map from names to things.
    MapOf(Noun),
    /// A list of rows.
    Rows,
    /// A list of displacements.
    Transform,
    /// A displacement such as `Tx(…)`.
    Displacement,
    /// One of the displacements, with this many entries.
    DisplacementEntries(&'static str),
    /// Passive or actuated.
    Joint,
    /// A lowest and a highest value.
    Limits,
    /// Modified or standard.
    Convention,
    /// A closure such as `Spherical(…)`.
    Closure,
    /// The frames of a closure, for a distance with the length.
    ClosureFrames(&'static str),
    /// Three entries.
    Vector,
    /// Rows of a rotation matrix.
    RotationRows,
    /// One row of a rotation matrix.
    RotationRow,
    /// Three or four rows of a transform.
    TransformRows,
    /// One row of a transform.
    TransformRow,
    /// A joint such as `Revolute(…)` in a file of joint axes.
    Axis,
    /// Two points on an axis.
    TwoPoints,
    /// `Passive` or `Actuated`, without parentheses.
    Role,
    /// The name of a body.
    Body,
    /// The names of two bodies.
    Bodies,
    /// A list of joints to cut.
    Cuts,
}

/// The value found at a place of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Found {
    /// A number.
    Number,
    /// A string.
    Text,
    /// A character in apostrophes.
    Character,
    /// A byte string.
    Bytes,
    /// `[…]`
    List,
    /// `{…}`
    Map,
    /// `(…, …)`
    Tuple,
    /// `(name: …)`
    Fields,
    /// A word by itself, such as `true`.
    Word(String),
    /// A word followed by parentheses.
    Call(String),
}

impl Structure {
    /// The fields it may have.
    pub fn fields(self) -> &'static [&'static str] {
        match self {
            Self::Mechanism => &[
                "version",
                "name",
                "source",
                "convention",
                "parameters",
                "joints",
                "chains",
                "platforms",
                "closures",
                "closed_forms",
            ],
            Self::Passive | Self::Actuated => &["home", "limits"],
            Self::Axes => &[
                "version",
                "name",
                "source",
                "convention",
                "parameters",
                "joints",
                "base",
                "tool",
                "cut",
            ],
            Self::RevoluteAxis | Self::PrismaticAxis => &[
                "point",
                "direction",
                "through",
                "home",
                "limits",
                "role",
                "between",
            ],
            Self::SphericalCentre => &["point", "between"],
            Self::Chain => &["on", "convention", "base", "rows", "tip"],
            Self::Row => &["alpha", "a", "d", "theta"],
            Self::Platform => &["home", "frames"],
            Self::ClosedForm => &[
                "of",
                "in",
                "where",
                "source",
                "position",
                "rotation",
                "transform",
                "entries",
                "identity",
                "identities",
            ],
        }
    }
}
