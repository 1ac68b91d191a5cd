//! Words for the parts of a file.

use std::fmt::{self, Display, Formatter};

use crate::description::{
    AxisKind, ClosureKind, Expected, FieldGroup, FoundValue, LoadKind, Noun, Scope, Shape,
};

impl Display for Noun {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl Display for FieldGroup {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Mechanism => "a mechanism",
            Self::Variable(_) => "a joint",
            Self::Axes => "a file of joint coordinates",
            Self::Joint(AxisKind::Distance) => "a rod",
            Self::Joint(kind) => return write!(f, "a {} joint", kind.word().to_lowercase()),
            Self::SecondPlace => "the place on the second body",
            Self::Point => "a point",
            Self::BodyFrame => "a body",
            Self::Design => "a design",
            Self::Chain => "a chain",
            Self::Row => "a row",
            Self::Platform => "a platform",
            Self::ClosedForm => "a closed form",
            Self::Mass => "a mass",
            Self::Load(LoadKind::Friction) => "friction",
            Self::Load(kind) => return write!(f, "a {}", kind.word().to_lowercase()),
        })
    }
}

impl Display for Scope {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Parameters => "not a parameter",
            Self::ParametersAndJoints => "neither a parameter nor a joint",
            Self::ClosedForm => "neither a parameter nor a joint nor a local name",
            Self::Outputs => "neither a parameter, a joint, a coordinate of a point nor a quantity",
        })
    }
}

impl Expected {
    /// Elements of a tuple.
    pub(in crate::description) fn unit(self) -> &'static str {
        match self {
            Self::ClosureFrames(ClosureKind::Coupling) => "expression",
            Self::ClosureFrames(kind) if kind.has_length() => "value",
            Self::ClosureFrames(_) => "frame",
            Self::RotationRows | Self::TransformRows => "row",
            Self::TwoPoints => "point",
            Self::TwoDirections => "direction",
            Self::Bodies => "body",
            Self::Points => "point",
            Self::Sizes(_) => "dimension",
            _ => "entry",
        }
    }
}

impl Display for Expected {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Fields(structure) => return write!(f, "{structure}, `{}(…)`", structure.word()),
            Self::NameOf(noun) => return write!(f, "the name of {noun}"),
            Self::MapOf(noun) => {
                return write!(
                    f,
                    "a map in which each name is followed by {}",
                    content(*noun)
                );
            }
            Self::DisplacementEntries(word) => return write!(f, "`{word}(…)`"),
            Self::ClosureFrames(kind) if kind.has_length() => {
                return write!(f, "`{}(frame, frame, length)`", kind.word());
            }
            Self::ClosureFrames(ClosureKind::Coupling) => "`Coupling(expression)`",
            Self::ClosureFrames(kind) => return write!(f, "`{}(frame, frame)`", kind.word()),
            Self::Sizes(shape) => match shape {
                Shape::Rod => "`Rod(length)`",
                Shape::Plate => "`Plate(a, b)`",
                Shape::Cylinder => "`Cylinder(radius, length)`",
                Shape::Box => "`Box(a, b, c)`",
                Shape::Sphere => "`Sphere(radius)`",
            },
            Self::Inertia => "moments of inertia `(Ixx, Iyy, Izz, Ixy, Ixz, Iyz)`",
            Self::Shape => "a shape such as `Rod(…)` or `Box(…)`",
            Self::Load => "`Spring(…)`, `Force(…)` or `Friction(…)`",
            Self::Points => "two points `(\"crank\", \"ground+0.1,0,0\")`",
            Self::YesOrNo => "`true` or `false`",
            Self::Table => "a list of rows `[(0, 10), (0.1, 12)]`, or the name of a CSV file",
            Self::TableRow => "a row `(value, force)`",
            Self::Version => "the number of the file format",
            Self::Text => "a string",
            Self::Frame => "the name of a frame",
            Self::Entry => "a number or an expression",
            Self::Rows => "a list of rows",
            Self::Transform => "a list of displacements",
            Self::Displacement => "a displacement such as `Tx(…)` or `Rz(…)`",
            Self::Joint => "`Passive(…)` or `Actuated(…)`",
            Self::Limits => "limits `(lowest, highest)`",
            Self::Convention => "`Modified` or `Standard`",
            Self::Closure => "a closure such as `Revolute(frame, frame)`",
            Self::Vector => "a vector `(x, y, z)`",
            Self::RotationRows => "a rotation matrix",
            Self::RotationRow => "a row of a rotation matrix",
            Self::TransformRows => "a transform",
            Self::TransformRow => "a row of a transform",
            Self::Axis => "a joint such as `Revolute(…)`, `Prismatic(…)` or `Spherical(…)`",
            Self::TwoPoints => "two points `((x, y, z), (x, y, z))`",
            Self::TwoDirections => "two directions `((x, y, z), (x, y, z))`",
            Self::Role => "`Passive` or `Actuated`",
            Self::Body => "the name of a body",
            Self::Bodies => "two bodies `(\"ground\", \"crank\")`",
            Self::Cuts => "a list of joints",
            Self::Range => "a range `(least, greatest)`",
            Self::Outputs => "a list of outputs, such as `[\"arm.x\", \"arm.y\"]`",
            Self::Positions => "a list of positions `{…}`",
            Self::Coordinates => "coordinates `(x, y)` or `(x, y, z)`",
            Self::Order => "`Kept` or `Any`",
        })
    }
}

fn content(noun: Noun) -> &'static str {
    match noun {
        Noun::Parameter | Noun::LocalName | Noun::MatrixEntry | Noun::Identity | Noun::Output => {
            "a number or an expression"
        }
        Noun::Varied => "a range `(least, greatest)`",
        Noun::Target => "a value or the coordinates of a point",
        Noun::Joint => "`Passive(…)` or `Actuated(…)`",
        Noun::Axis => "a joint such as `Revolute(…)`, `Prismatic(…)` or `Spherical(…)`",
        Noun::Body => "`(origin: (x, y, z))`",
        Noun::Point => "`(body: \"…\", at: (x, y, z))`",
        Noun::Chain => "`Chain(…)`",
        Noun::Platform => "`Platform(…)`",
        Noun::PlatformFrame => "a list of displacements",
        Noun::Closure => "a closure",
        Noun::ClosedForm => "`ClosedForm(…)`",
        Noun::Mass => "`(mass: …)`",
        Noun::Load => "`Spring(…)`, `Force(…)` or `Friction(…)`",
        Noun::Field => "a value",
    }
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
