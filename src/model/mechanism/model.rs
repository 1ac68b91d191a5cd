//! The parts of a mechanism, every name resolved.

use std::sync::Arc;

use crate::algebra::{Affine, Expression, Measure, words};
use crate::description::{ClosureKind, Convention, Displacement, MatrixEntry, Role};
use crate::geometry::Pose;
use crate::number::tolerance::ROUNDING;

/// The meaning of a name in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// The parameter of that index.
    Parameter(usize),
    /// The variable of the joint of that index.
    Joint(usize),
    /// The local name of that index in its closed form.
    Local(usize),
}

/// An expression whose names are resolved.
pub type Formula = Expression<Symbol>;

/// A named constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: Arc<str>,
    /// Its definition; only parameters occur in it.
    pub definition: Formula,
    /// Its value, in m or rad or without unit.
    pub value: f64,
    /// Its dimension, as far as the units in its definition determine it.
    pub measure: Measure,
    /// True if nothing in its definition shows its unit, should it be an angle.
    pub bare: bool,
}

words! {
    /// Kind of motion of a joint variable.
    JointKind {
        /// Revolute: the variable is an angle in rad and occurs in `theta` only.
        Revolute = "revolute",
        /// Prismatic: the variable is a length in m and occurs in `d` or in the length of a `Distance`.
        Prismatic = "prismatic",
        /// Helical: the variable is an angle in rad and occurs in both.
        Helical = "helical",
    }
}

/// A joint variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Actuated or passive.
    pub role: Role,
    /// Its kind, inferred from the columns in which its variable occurs.
    pub kind: JointKind,
    /// Its value in the home configuration, rad or m.
    pub home: f64,
    /// Lowest and highest value, rad or m.
    pub limits: Option<(f64, f64)>,
}

impl JointKind {
    /// True if the variable is an angle (rad); otherwise it is a length (m).
    pub fn is_angle(self) -> bool {
        self != JointKind::Prismatic
    }
}

impl Joint {
    /// The most by which a joint at a limit may be beyond it: solutions are off by rounding.
    pub fn slack(&self) -> f64 {
        match self.limits {
            Some((low, high)) if !self.kind.is_angle() => ROUNDING * low.abs().max(high.abs()),
            _ => ROUNDING,
        }
    }

    /// True if a value is within the limits, where there are any. An angle counts modulo a turn.
    pub fn allows(&self, value: f64) -> bool {
        let Some((low, high)) = self.limits else {
            return true;
        };
        let rounding = self.slack();
        let within = |x: f64| x >= low - rounding && x <= high + rounding;
        if self.kind.is_angle() && self.kind != JointKind::Helical {
            let turn = std::f64::consts::TAU;
            let first = value + turn * ((low - rounding - value) / turn).ceil();
            within(first)
        } else {
            within(value)
        }
    }
}

/// A step of a fixed transform, in m or rad.
pub type FixedStep = Displacement<Formula>;

/// A row of a Denavit–Hartenberg table.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainRow {
    /// Twist of the link (rad).
    pub alpha: Formula,
    /// Length of the link (m).
    pub a: Formula,
    /// Offset along the joint axis (m), affine in the joint variables.
    pub d: Affine<Symbol>,
    /// Angle about the joint axis (rad), affine in the joint variables.
    pub theta: Affine<Symbol>,
    /// Turn about y behind the twist (rad).
    pub beta: Formula,
    /// α, a, d, θ, β as written in the file.
    pub written: [String; 5],
    /// The name of the link behind it, if the file gives one.
    pub link: Option<String>,
}

/// A serial chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Its name, which is also that of its tip frame.
    pub name: String,
    /// The frame to which it is attached.
    pub on: super::Frame,
    /// The convention of its rows.
    pub convention: Convention,
    /// Displacement from that frame to its frame 0.
    pub base: Vec<FixedStep>,
    /// Its table.
    pub rows: Vec<ChainRow>,
    /// Displacement from its last link frame to its tip frame.
    pub tip: Vec<FixedStep>,
}

/// The home of a joint, and its lowest and highest value.
pub(crate) type JointHome = (Formula, Option<[Formula; 2]>);

/// Home values of joints and platforms, and the limits of joints, as written.
#[derive(Clone, Debug)]
pub(crate) struct Homes {
    pub joints: Vec<JointHome>,
    /// For each platform the steps to its home pose.
    pub platforms: Vec<Vec<FixedStep>>,
}

/// A rigid body whose pose is unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Platform {
    /// Its name, which is also that of its own frame.
    pub name: String,
    /// Its pose in the home configuration: ground from platform.
    pub home: Pose<f64>,
    /// Frames fixed in it.
    pub frames: Arc<[(String, Vec<FixedStep>)]>,
}

/// A closure: a broken joint, restored between two frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Its name.
    pub name: String,
    /// The kind of joint.
    pub kind: ClosureKind,
    /// The frames it joins; the joint's axes are their z axes.
    pub frames: [super::Frame; 2],
    /// The length of a `Distance` (m), affine in the joint variables.
    pub length: Option<Affine<Symbol>>,
    /// The expression of joint variables that a `Coupling` makes zero.
    pub relation: Option<Formula>,
    /// Its kind and its first frame as written, where the variables of its joint are rows in front of it and it is rigid.
    pub opened: Option<(ClosureKind, super::Frame)>,
}

impl Closure {
    /// A closure without a length.
    pub(super) fn new(name: String, kind: ClosureKind, frames: [super::Frame; 2]) -> Self {
        Closure {
            name,
            kind,
            frames,
            length: None,
            relation: None,
            opened: None,
        }
    }

    /// Its kind and its frames as the file has them, also where its joint has variables.
    pub fn written(&self) -> (ClosureKind, [super::Frame; 2]) {
        let (kind, first) = self.opened.unwrap_or((self.kind, self.frames[0]));
        (kind, [first, self.frames[1]])
    }
}

/// A printed formula, to be checked against the chains.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedForm {
    /// Its name.
    pub name: String,
    /// Publication in which it is printed.
    pub source: Option<String>,
    /// Local names with their definitions, each after those it uses.
    pub locals: Vec<(String, Formula)>,
    /// The formula.
    pub gives: GivenForm,
}

/// The formula of a closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenForm {
    /// Entries of the transform of one frame seen from another.
    Pose {
        /// The frame.
        of: super::Frame,
        /// The frame it is seen from.
        relative_to: super::Frame,
        /// The entries that are given.
        entries: Vec<(MatrixEntry, Formula)>,
    },
    /// Expressions that vanish at every assembled configuration, with their names.
    Identities(Vec<(String, Formula)>),
}
