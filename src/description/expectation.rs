//! The values expected at each place of a mechanism file.

use super::closure_kind::ClosureKind;
use super::parts::Role;
use super::{AxisKind, LoadKind, Shape};
use crate::algebra::words;

words! {
    /// The kinds of named items, as sentences call them.
    #[allow(missing_docs)]
    Noun {
        Field = "a field",
        Parameter = "a parameter",
        Joint = "a joint",
        Axis = "a joint",
        Body = "a body",
        Point = "a point",
        Chain = "a chain",
        Platform = "a platform",
        PlatformFrame = "a platform frame",
        Closure = "a closure",
        ClosedForm = "a closed form",
        LocalName = "a local name",
        MatrixEntry = "an entry of a pose",
        Identity = "an identity",
        Output = "an output",
        Mass = "a mass",
        Load = "a load",
        Varied = "a number that varies",
        Target = "a target",
    }
}

/// The groups of named fields in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum FieldGroup {
    Mechanism,
    /// A joint variable.
    Variable(Role),
    Chain,
    Row,
    Platform,
    ClosedForm,
    Axes,
    /// A joint given by its axis.
    Joint(AxisKind),
    /// The place of a joint on its second body.
    SecondPlace,
    Point,
    BodyFrame,
    Mass,
    Load(LoadKind),
    Design,
}

/// The value expected at a place of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Expected {
    Fields(FieldGroup),
    Version,
    Text,
    NameOf(Noun),
    Frame,
    Entry,
    MapOf(Noun),
    Rows,
    Transform,
    Displacement,
    /// The entries of the displacement of that word.
    DisplacementEntries(&'static str),
    Joint,
    Limits,
    Convention,
    Closure,
    /// The frames of the closure of that word, and the length of a distance.
    ClosureFrames(ClosureKind),
    Vector,
    RotationRows,
    RotationRow,
    TransformRows,
    TransformRow,
    Axis,
    TwoPoints,
    TwoDirections,
    Role,
    Body,
    Bodies,
    Cuts,
    Inertia,
    Shape,
    /// The dimensions of a shape.
    Sizes(Shape),
    Load,
    Points,
    YesOrNo,
    Table,
    TableRow,
    Range,
    Positions,
    Outputs,
    Coordinates,
    Order,
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

impl FieldGroup {
    /// The name before its fields.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mechanism => "Mechanism",
            Self::Variable(role) => role.word(),
            Self::Chain => "Chain",
            Self::Row => "Row",
            Self::Platform => "Platform",
            Self::ClosedForm => "ClosedForm",
            Self::Axes => "Axes",
            Self::Joint(kind) => kind.word(),
            Self::SecondPlace => "Place",
            Self::Point => "Point",
            Self::BodyFrame => "Body",
            Self::Mass => "Mass",
            Self::Load(kind) => kind.word(),
            Self::Design => "Design",
        }
    }

    /// The fields it may have.
    pub fn fields(self) -> Vec<&'static str> {
        let fields = match self {
            Self::Mechanism => {
                "version name source convention tolerance parameters joints chains platforms closures closed_forms outputs gravity masses loads"
            }
            Self::Variable(_) => "home limits",
            Self::Axes => {
                "version name source convention tolerance parameters joints bodies points base tool cut closed_forms outputs gravity masses loads"
            }
            Self::Joint(kind) => match kind {
                AxisKind::Revolute | AxisKind::Prismatic => {
                    "point direction through frame second home drawn value limits role between"
                }
                AxisKind::Helical => {
                    "point direction through frame pitch home drawn value limits role between"
                }
                AxisKind::Cylindrical | AxisKind::Planar => {
                    "point direction through frame second between"
                }
                AxisKind::Universal => "point directions second between",
                AxisKind::Spherical => "point second between",
                AxisKind::Fixed => "frame second between",
                AxisKind::Distance => "through length home limits role between",
            },
            Self::SecondPlace => "point direction directions through frame",
            Self::Point => "body at frame",
            Self::BodyFrame => "origin frame",
            Self::Mass => "mass centre inertia shape density turned",
            Self::Load(kind) => kind.fields(),
            Self::Design => {
                "version name mechanism vary positions contains motion at_least at_most minimise maximise outputs order"
            }
            Self::Chain => "on convention base rows tip",
            Self::Row => "alpha a d theta link",
            Self::Platform => "home frames",
            Self::ClosedForm => {
                "of in where source position rotation transform entries identity identities"
            }
        };
        fields.split(' ').collect()
    }
}
