//! The contents of a mechanism file, part by part.
//!
//! Parts are equal if their contents are, wherever they are in their files.

mod loads;

pub use loads::*;

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use super::ClosureKind;
use crate::algebra::{Expression, words};
pub use crate::geometry::Axis;
use crate::geometry::{Pose, Vector3};
use crate::number::Number;

/// A value and its place in the file, in bytes.
#[derive(Debug, Clone, Default)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Range<usize>,
}

/// A value under its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T> {
    /// The name.
    pub name: Spanned<String>,
    /// The named value.
    pub value: T,
}

/// A number or an expression. The spans inside the expression count bytes of the file.
#[derive(Debug, Clone)]
pub struct Entry {
    /// The expression; a plain number is one too.
    pub expression: Expression,
    /// The whole entry, with its quotes.
    pub span: Range<usize>,
}

/// A whole mechanism file. Everything is in the order of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Description {
    /// The name of the mechanism.
    pub name: Spanned<String>,
    /// Its source in the literature.
    pub source: Option<Spanned<String>>,
    /// The convention of the chains that give none.
    pub convention: Option<Spanned<Convention>>,
    /// The most by which any number of the file is off (m), if not half a unit of its last digit.
    pub tolerance: Option<Entry>,
    /// Dimensions and other constants.
    pub parameters: Vec<Named<Entry>>,
    /// The joint variables.
    pub joints: Vec<Named<JointDescription>>,
    /// The serial chains left when the mechanism is broken at some joints.
    pub chains: Vec<Named<ChainDescription>>,
    /// Rigid bodies whose pose is unknown.
    pub platforms: Vec<Named<PlatformDescription>>,
    /// The closures that restore the broken joints.
    pub closures: Vec<Named<ClosureDescription>>,
    /// Formulas to be checked against the chains.
    pub closed_forms: Vec<Named<ClosedFormDescription>>,
    /// Quantities of interest, over joints, coordinates of points, rates and forces.
    pub outputs: Vec<Named<Entry>>,
    /// Masses, springs and forces.
    pub loads: LoadsDescription,
    /// The joint coordinates from which all this was made, if it was.
    pub coordinates: Option<Box<super::JointCoordinates>>,
}

words! {
    /// The convention by which frames are attached in a Denavit–Hartenberg table: a row is T = Rx(alpha) Tx(a) Rz(theta)
    /// Tz(d) in the modified one, T = Rz(theta) Tz(d) Tx(a) Rx(alpha) in the standard one.
    #[derive(Default)]
    #[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
    Convention {
        /// Rows (α(i−1), a(i−1), d(i), θ(i)), z of frame i along joint i (Craig)
        #[default]
        Modified = "Modified",
        /// Rows (θ(i), d(i), a(i), α(i)), z of frame i−1 along joint i (Denavit and Hartenberg)
        Standard = "Standard",
    }

    /// Role of a joint variable: driven or not.
    Role {
        /// Driven: its value is an input.
        Actuated = "Actuated",
        /// Not driven: its value follows.
        Passive = "Passive",
    }
}

/// A joint variable.
#[derive(Debug, Clone)]
pub struct JointDescription {
    /// Actuated or passive.
    pub role: Role,
    /// Its value in the home configuration; 0 if not given.
    pub home: Entry,
    /// Lowest and highest value.
    pub limits: Option<(Entry, Entry)>,
    /// Place of its declaration.
    pub span: Range<usize>,
}

/// A serial chain.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChainDescription {
    /// The frame to which it is attached; ground if not given.
    pub on: Option<Spanned<String>>,
    /// The convention of its rows, if it is not that of the file.
    pub convention: Option<Spanned<Convention>>,
    /// Displacement from that frame to the frame before the first row.
    pub base: Vec<Displacement>,
    /// The Denavit–Hartenberg table.
    pub rows: Vec<RowDescription>,
    /// Displacement from the frame after the last row to the tip.
    pub tip: Vec<Displacement>,
}

/// A row of a Denavit–Hartenberg table. Absent entries are 0.
#[derive(Debug, Clone)]
pub struct RowDescription {
    /// Twist of the link (rad).
    pub alpha: Entry,
    /// Length of the link (m).
    pub a: Entry,
    /// Offset along the joint axis (m).
    pub d: Entry,
    /// Angle about the joint axis (rad).
    pub theta: Entry,
    /// A name for the link behind the row, which is its body.
    pub link: Option<Spanned<String>>,
    /// The place of the row.
    pub span: Range<usize>,
}

/// A step of a transform; a list of them is read left to right. Its entries are as in a file, resolved formulas or
/// numbers.
#[derive(Debug, Clone, PartialEq)]
pub enum Displacement<E = Entry> {
    /// `Tx(e)`, `Ty(e)`, `Tz(e)`: by a length (m) along an axis.
    Translate(Axis, E),
    /// `Rx(e)`, `Ry(e)`, `Rz(e)`: by an angle (rad) about an axis.
    Rotate(Axis, E),
    /// `T(e, e, e)`: by a vector (m).
    TranslateBy([E; 3]),
}

/// A rigid body whose pose is unknown.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlatformDescription {
    /// Its pose in the home configuration.
    pub home: Vec<Displacement>,
    /// Frames fixed in it.
    pub frames: Vec<Named<Vec<Displacement>>>,
}

/// A closure: a broken joint, restored between two frames.
#[derive(Debug, Clone)]
pub struct ClosureDescription {
    /// The kind of joint.
    pub kind: ClosureKind,
    /// The frames it joins; ground twice for a [`ClosureKind::Coupling`].
    pub frames: [Spanned<String>; 2],
    /// The distance (m) of a [`ClosureKind::Distance`], or the expression that a [`ClosureKind::Coupling`] makes zero.
    pub length: Option<Entry>,
    /// The place of the closure.
    pub span: Range<usize>,
}

/// A printed formula, either for the pose of a frame or an identity.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedFormDescription {
    /// The frame whose pose is given; absent only if the form consists of identities.
    pub of: Option<Spanned<String>>,
    /// `in`: the frame in which it is expressed; ground if not given.
    pub relative_to: Option<Spanned<String>>,
    /// `where`: local names.
    pub locals: Vec<Named<Entry>>,
    /// Publication in which it is printed.
    pub source: Option<Spanned<String>>,
    /// The position (m).
    pub position: Option<[Entry; 3]>,
    /// The rotation matrix, row by row.
    pub rotation: Option<[[Entry; 3]; 3]>,
    /// Rotation and position `[R | p]`, row by row.
    pub transform: Option<[[Entry; 4]; 3]>,
    /// Single entries of `[R | p]`.
    pub entries: Vec<(Spanned<MatrixEntry>, Entry)>,
    /// An expression that vanishes at every assembled configuration.
    pub identity: Option<Entry>,
    /// Several of them.
    pub identities: Vec<Named<Entry>>,
}

/// Entry of `[R | p]`; indices count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MatrixEntry {
    /// Row and column of the rotation matrix: `r11` is (0, 0).
    Rotation(usize, usize),
    /// Row of the position: `px` is 0.
    Position(usize),
}

impl<T> Spanned<T> {
    /// `value`, standing at `span`.
    pub fn new(value: T, span: Range<usize>) -> Self {
        Self { value, span }
    }

    /// `value`, which was made and not read from a file.
    pub fn nowhere(value: T) -> Self {
        Self::new(value, 0..0)
    }
}

impl<T> Named<T> {
    /// `value` under a name that was not read from a file.
    pub fn new(name: impl Into<String>, value: T) -> Self {
        let name = Spanned::nowhere(name.into());
        Self { name, value }
    }
}

impl Entry {
    /// The entry that is a plain number.
    pub fn number(value: f64, span: Range<usize>) -> Self {
        let mut expression = Expression::number(value);
        expression.span = span.clone();
        Self { expression, span }
    }

    /// The value 0 of an absent entry.
    pub(crate) fn absent() -> Self {
        Self::number(0.0, 0..0)
    }
}

impl From<Expression> for Entry {
    /// An entry that was not read from a file.
    fn from(expression: Expression) -> Self {
        let span = 0..0;
        Self { expression, span }
    }
}

impl RowDescription {
    /// A row that was not read from a file.
    pub fn new(alpha: Entry, a: Entry, d: Entry, theta: Entry) -> Self {
        let span = 0..0;
        Self {
            alpha,
            a,
            d,
            theta,
            link: None,
            span,
        }
    }
}

impl ChainDescription {
    /// A chain without rows: a frame of its own at a displacement from another one.
    pub fn frame(on: &str, base: Vec<Displacement>) -> Self {
        Self {
            on: (on != GROUND).then(|| Spanned::nowhere(on.to_owned())),
            base,
            ..Self::default()
        }
    }
}

/// The name of the fixed frame.
pub const GROUND: &str = "ground";

impl<E> Displacement<E> {
    /// The words of displacements along and about x, y and z, and by a vector.
    pub(crate) const WORDS: [&str; 7] = ["Tx", "Ty", "Tz", "Rx", "Ry", "Rz", "T"];

    /// The displacement of a word with its entries, if it has as many.
    pub(crate) fn of_word(word: &str, entries: Vec<E>) -> Option<Self> {
        let place = Self::WORDS.iter().position(|known| *known == word)?;
        if place == 6 {
            return Some(Self::TranslateBy(entries.try_into().ok()?));
        }
        let [entry] = <[E; 1]>::try_from(entries).ok()?;
        let axis = [Axis::X, Axis::Y, Axis::Z][place % 3];
        Some(match place < 3 {
            true => Self::Translate(axis, entry),
            false => Self::Rotate(axis, entry),
        })
    }

    /// Its word in a file.
    pub fn word(&self) -> &'static str {
        Self::WORDS[match self {
            Self::Translate(axis, _) => *axis as usize,
            Self::Rotate(axis, _) => 3 + *axis as usize,
            Self::TranslateBy(_) => 6,
        }]
    }

    /// Its lengths or its angle.
    pub fn entries(&self) -> &[E] {
        match self {
            Self::Translate(_, entry) | Self::Rotate(_, entry) => std::slice::from_ref(entry),
            Self::TranslateBy(entries) => entries,
        }
    }

    /// The displacement with other entries. All are tried before an error is returned.
    pub(crate) fn try_map<F, X>(
        &self,
        mut change: impl FnMut(&E) -> Result<F, X>,
    ) -> Result<Displacement<F>, X> {
        Ok(match self {
            Self::Translate(axis, entry) => Displacement::Translate(*axis, change(entry)?),
            Self::Rotate(axis, entry) => Displacement::Rotate(*axis, change(entry)?),
            Self::TranslateBy(entries) => {
                let [x, y, z] = entries.each_ref().map(change);
                Displacement::TranslateBy([x?, y?, z?])
            }
        })
    }
}

impl<T: Number> Displacement<T> {
    /// Makes a pose go on by the displacement.
    pub(crate) fn extend(&self, pose: &mut Pose<T>) {
        match *self {
            Self::Translate(axis, by) => pose.shift(axis, by),
            Self::Rotate(axis, by) => pose.turn(axis, by),
            Self::TranslateBy(by) => pose.position = *pose * Vector3(by),
        }
    }
}

impl MatrixEntry {
    /// Every entry.
    pub fn all() -> impl Iterator<Item = Self> {
        let rotation = (0..9).map(|i| Self::Rotation(i / 3, i % 3));
        rotation.chain((0..3).map(Self::Position))
    }
}

impl Display for MatrixEntry {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match *self {
            Self::Rotation(row, column) => write!(f, "r{}{}", row + 1, column + 1),
            Self::Position(row) => write!(f, "p{}", ["x", "y", "z"][row]),
        }
    }
}

macro_rules! equal_up_to_place {
    ($($part:ty: $($field:ident),+;)+) => {
        $(impl PartialEq for $part {
            fn eq(&self, other: &Self) -> bool {
                $(self.$field == other.$field)&&+
            }
        })+
    };
}

equal_up_to_place! {
    Entry: expression;
    JointDescription: role, home, limits;
    super::AxisDescription: kind, place, second, role, home, drawn, value, pitch, limits, between;
    RowDescription: alpha, a, d, theta, link;
    ClosureDescription: kind, frames, length;
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
