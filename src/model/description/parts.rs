//! The contents of a mechanism file, part by part.
//!
//! Parts are equal if their contents are, wherever they are in their files.

mod loads;

pub use loads::*;

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use super::ClosureKind;
use super::file_fields::{declared, part_structures};
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

part_structures!(declared);

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
    #[derive(Default)]
    Role {
        /// Driven: its value is an input.
        Actuated = "Actuated",
        /// Not driven: its value follows.
        #[default]
        Passive = "Passive",
    }
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

impl JointDescription {
    /// A joint without limits that was not read from a file.
    pub fn new(role: Role, home: Entry) -> Self {
        Self {
            role,
            home,
            limits: None,
            span: 0..0,
        }
    }
}

impl ClosureDescription {
    /// A closure without a length that was not read from a file.
    pub fn new(kind: ClosureKind, frames: [String; 2]) -> Self {
        Self {
            kind,
            frames: frames.map(Spanned::nowhere),
            length: None,
            span: 0..0,
        }
    }

    /// The expression of a coupling.
    pub fn coupling(expression: Entry, span: Range<usize>) -> Self {
        let ground = || Spanned::new(GROUND.to_owned(), span.clone());
        Self {
            kind: ClosureKind::Coupling,
            frames: [ground(), ground()],
            length: Some(expression),
            span,
        }
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
            beta: Entry::absent(),
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
    pub fn try_map<F, X>(
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
    pub fn extend(&self, pose: &mut Pose<T>) {
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

    /// The entry of a pose.
    pub fn of<T: Number>(self, pose: &Pose<T>) -> T {
        match self {
            Self::Position(i) => pose.position.0[i],
            Self::Rotation(i, j) => pose.rotation.0[j].0[i],
        }
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
    super::AxisDescription: kind, place, second, role, home, drawn, value, pitch, limits, between;
    ClosureDescription: kind, frames, length;
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
