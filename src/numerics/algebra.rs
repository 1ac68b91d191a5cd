//! Expressions such as `"90 deg - phi1"` or `"b - l1*cos(theta1)"`.
//!
//! An [`Expression`] is parsed once, its names are resolved with [`Expression::try_resolve`], and it is then evaluated
//! over any [`Number`](crate::number::Number). Every part has its position in the text, so that any problem can refer
//! to it.

mod affine;
mod arithmetic;
mod arrangement;
mod display;
mod evaluation;
mod inferred_unit;
mod measure;
mod parser;
mod si_unit;
mod straight_line;
mod symbolic;
mod trigonometric;
mod unit;
mod vocabulary;
mod words;

pub use affine::{Affine, NonAffine};
pub use arrangement::{Arranged, arrange};
pub use evaluation::{EvaluationError, EvaluationErrorKind, LARGEST};
pub use measure::{LARGEST_BARE, Measure, MeasureError, MeasureErrorKind};
pub use parser::shown;
pub use parser::{MAX_HEIGHT, MAX_NESTING, ParseError, ParseErrorKind};
pub use si_unit::{SiUnit, SiUnitError};
pub use straight_line::{
    BATCH, Batch, Decision, LEAST_PIVOT, Operation, OperationIndex, Pivot, Recorded, Registers,
    eliminate, evaluate, needed, record, run,
};
pub use symbolic::{Symbolic, with_letters};
pub use trigonometric::{Atom, Budget, ByUnknowns, Key, Monomial, Powers, Trigonometric, Wave};
pub use unit::{Unit, ends_with_one_unit};
pub use vocabulary::{Constant, Function, is_name, is_reserved};
pub use words::words;

use std::ops::Range;

/// An expression whose names are of type `N`: text when just read, something resolved later.
///
/// Two expressions are equal when they are the same tree, wherever they are in a text.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(rename = "Expression", with = "WrittenExpression")
)]
pub struct Expression<N = String> {
    /// The outermost operation, with its operands.
    pub node: Node<N>,
    /// Its place: bytes of the text it was parsed from, or of the file when it is part of a description.
    pub span: Range<usize>,
}

/// A number, or an expression as text.
#[cfg(feature = "schema")]
#[derive(schemars::JsonSchema)]
#[schemars(untagged)]
#[allow(dead_code)]
enum WrittenExpression {
    Number(f64),
    Text(String),
}

/// An error in an expression, with its place.
#[derive(Debug, Clone, thiserror::Error, PartialEq)]
#[error("{kind}")]
pub struct ExpressionError<K> {
    /// The smallest part that is wrong; empty at the end of a text.
    pub span: Range<usize>,
    /// Kind of error.
    pub kind: K,
}

/// A node of the tree.
#[derive(Debug, Clone, PartialEq)]
pub enum Node<N> {
    /// A plain number.
    Number(f64),
    /// A number with a unit, as written: `60 deg` holds 60.
    Quantity(f64, Unit),
    /// `pi`, `deg` or `rad`.
    Constant(Constant),
    /// A parameter, a joint variable or a local name.
    Name(N),
    /// `-x`
    Negate(Box<Expression<N>>),
    /// An operation such as `x + y`.
    Binary(Operator, Box<Expression<N>>, Box<Expression<N>>),
    /// `f(x)` or `f(x, y)`, with as many arguments as the function takes.
    Call(Function, Vec<Expression<N>>),
}

/// An operator between two expressions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}

impl<N: PartialEq> PartialEq for Expression<N> {
    fn eq(&self, other: &Self) -> bool {
        self.node == other.node
    }
}

impl Expression<String> {
    /// Reads an expression. Spans count bytes of `text`.
    pub fn parse(text: &str) -> Result<Self, ParseError> {
        parser::parse(text, false)
    }

    /// Parses an expression whose names are quantities, such as `top.x`, `velocity:l1` or `[left+0.5,0.2].x`.
    pub fn parse_quantity(text: &str) -> Result<Self, ParseError> {
        parser::parse(text, true)
    }
}

impl<N> Expression<N> {
    /// The expression that is only a number, without a place.
    pub fn number(value: f64) -> Self {
        Node::Number(value).at(0..0)
    }

    /// The expression that is only a name, without a place.
    pub fn name(name: N) -> Self {
        Node::Name(name).at(0..0)
    }

    /// The value, if the expression is only a number.
    pub fn as_number(&self) -> Option<f64> {
        match self.node {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// True for the number 0 alone; an expression with the value 0 is not evaluated.
    pub fn is_zero(&self) -> bool {
        self.as_number() == Some(0.0)
    }

    /// The direct subexpressions, in the order in which they are written.
    pub fn operands(&self) -> impl DoubleEndedIterator<Item = &Expression<N>> {
        let (first, second, arguments): (Option<&Self>, Option<&Self>, &[Self]) = match &self.node {
            Node::Negate(x) => (Some(x), None, &[]),
            Node::Binary(_, x, y) => (Some(x), Some(y), &[]),
            Node::Call(_, arguments) => (None, None, arguments),
            _ => (None, None, &[]),
        };
        first.into_iter().chain(second).chain(arguments)
    }

    /// Every occurrence of a name, in the order they are written, with its place.
    pub fn names(&self) -> impl Iterator<Item = (&N, &Range<usize>)> {
        // most expressions are single numbers or names, for which nothing is allocated
        let (mut first, mut waiting) = (Some(self), Vec::new());
        std::iter::from_fn(move || {
            while let Some(expression) = first.take().or_else(|| waiting.pop()) {
                match &expression.node {
                    Node::Name(name) => return Some((name, &expression.span)),
                    Node::Number(_) | Node::Quantity(..) | Node::Constant(_) => {}
                    _ => waiting.extend(expression.operands().rev()),
                }
            }
            None
        })
    }

    /// Replaces every name by its meaning according to `resolve`; returns all errors if there are any.
    pub fn try_resolve<M, E>(
        &self,
        mut resolve: impl FnMut(&N, &Range<usize>) -> Result<M, E>,
    ) -> Result<Expression<M>, Vec<E>> {
        let mut errors = Vec::new();
        let mut resolve = |name: &N, span: &Range<usize>| {
            resolve(name, span).map_err(|error| errors.push(error)).ok()
        };
        let resolved = self.rebuilt(&|span| span, &mut resolve);
        resolved.filter(|_| errors.is_empty()).ok_or(errors)
    }

    /// The expression with every span mapped by `place`.
    pub fn relocate(&self, place: &impl Fn(Range<usize>) -> Range<usize>) -> Self
    where
        N: Clone,
    {
        let same = self.rebuilt(place, &mut |name, _| Some(name.clone()));
        same.expect("every name is kept")
    }

    /// The tree with other spans and names. Visits every name even after an error, so that all errors are reported.
    fn rebuilt<M>(
        &self,
        place: &impl Fn(Range<usize>) -> Range<usize>,
        resolve: &mut impl FnMut(&N, &Range<usize>) -> Option<M>,
    ) -> Option<Expression<M>> {
        let node = match &self.node {
            Node::Number(value) => Node::Number(*value),
            Node::Quantity(value, unit) => Node::Quantity(*value, *unit),
            Node::Constant(constant) => Node::Constant(*constant),
            Node::Name(name) => Node::Name(resolve(name, &self.span)?),
            Node::Negate(x) => Node::negated(x.rebuilt(place, resolve)?),
            Node::Binary(operator, x, y) => {
                let (x, y) = (x.rebuilt(place, resolve), y.rebuilt(place, resolve));
                Node::binary(*operator, x?, y?)
            }
            Node::Call(function, arguments) => {
                let arguments = arguments.iter().map(|x| x.rebuilt(place, resolve));
                let arguments: Vec<Option<_>> = arguments.collect();
                Node::Call(*function, arguments.into_iter().collect::<Option<_>>()?)
            }
        };
        Some(node.at(place(self.span.clone())))
    }
}

impl<N> Node<N> {
    /// `x operator y`
    pub fn binary(operator: Operator, x: Expression<N>, y: Expression<N>) -> Self {
        Node::Binary(operator, Box::new(x), Box::new(y))
    }

    /// `-x`
    pub fn negated(x: Expression<N>) -> Self {
        Node::Negate(Box::new(x))
    }

    /// Gives the node the place `span`.
    pub fn at(self, span: Range<usize>) -> Expression<N> {
        Expression { node: self, span }
    }
}
