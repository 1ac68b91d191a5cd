//! What is wrong with an expression, in words.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use super::{
    EvaluationError, EvaluationErrorKind, LARGEST, MAX_HEIGHT, MAX_NESTING, Measure, MeasureError,
    MeasureErrorKind, NonAffine, ParseError, ParseErrorKind,
};

impl Display for ParseErrorKind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        use ParseErrorKind::*;
        match self {
            Empty => f.write_str("the expression is empty"),
            UnexpectedCharacter(c) if c.is_control() => write!(
                f,
                "the character `{}` has no meaning in an expression",
                c.escape_default()
            ),
            UnexpectedCharacter(c) => {
                write!(f, "the character `{c}` has no meaning in an expression")
            }
            ExpectedOperand => f.write_str("expected a number, a name or `(`"),
            MissingOperator => f.write_str("an operator is missing between two values"),
            UnknownUnit(unit) => write!(f, "`{unit}` after a number is not a unit"),
            UnclosedParenthesis => f.write_str("a parenthesis is not closed"),
            UnopenedParenthesis => f.write_str("a closing parenthesis has no opening one"),
            UnexpectedComma => f.write_str("there is a comma outside the arguments of a function"),
            UnknownFunction(name) => write!(f, "there is no function `{name}`"),
            MissingArguments(function) => {
                let word = function.word();
                write!(f, "the function `{word}` needs its argument in parentheses")
            }
            WrongArgumentCount { function, found } => {
                let (word, arity) = (function.word(), function.arity());
                let plural = if arity == 1 { "" } else { "s" };
                write!(f, "`{word}` takes {arity} argument{plural}, found {found}")
            }
            PowerOfUnit => f.write_str(
                "it is not clear whether the power belongs to the number or to its unit",
            ),
            DoubleStar => f.write_str("a power is written `^`, not `**`"),
            MalformedNumber => f.write_str("this is not a number"),
            NumberTooLarge => f.write_str("the number is too large"),
            TooDeep => write!(
                f,
                "the expression is nested more than {MAX_NESTING} levels deep"
            ),
            TooLong => write!(
                f,
                "the expression has more than {MAX_HEIGHT} operations in a row"
            ),
        }
    }
}

impl Display for EvaluationErrorKind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        use EvaluationErrorKind::*;
        match self {
            DivisionByZero => f.write_str("division by zero"),
            RootOfNegative(x) => write!(f, "the square root of {x} is not a real number"),
            LogarithmOfNonPositive(x) => write!(f, "the logarithm of {x} is not a real number"),
            OutOfRange(function, x) => {
                write!(f, "`{}` of {x} is not a real number", function.word())
            }
            PowerOfNegative(x) => {
                write!(f, "a non-integer power of {x} is not a real number")
            }
            TooLarge(x) => write!(f, "the value {x:e} is too large; the limit is {LARGEST:e}"),
            NotFinite => f.write_str("the value is not finite"),
        }
    }
}

impl Display for MeasureErrorKind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Wrong { wanted, found } => {
                write!(f, "expected {}, found {}", wanted.words(), found.words())
            }
            Self::Mixed => f.write_str("an angle and a length are mixed"),
            Self::LengthAsAngle(function) => {
                write!(f, "`{}` takes an angle, not a length", function.word())
            }
            Self::BareAngle(value) => {
                let turns = (value / std::f64::consts::TAU).abs();
                write!(
                    f,
                    "{value} without a unit is in rad, which is {turns:.1} turns"
                )
            }
        }
    }
}

impl Measure {
    /// What it is called: `an angle`.
    pub fn words(self) -> &'static str {
        match self {
            Measure::Number | Measure::Open => "a number",
            Measure::Angle => "an angle",
            Measure::Length => "a length",
            Measure::Force => "a force",
            Measure::Moment => "a moment",
        }
    }
}

/// An error that is said as its kind, and knows the bytes of the text that are to blame.
macro_rules! located {
    ($($error:ty)+) => {$(
        impl Display for $error {
            fn fmt(&self, f: &mut Formatter) -> fmt::Result {
                self.kind.fmt(f)
            }
        }

        impl Error for $error {}
    )+};
}

located!(ParseError EvaluationError MeasureError);

impl Error for ParseErrorKind {}
impl Error for EvaluationErrorKind {}
impl Error for MeasureErrorKind {}

impl Display for NonAffine {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("a variable may only be added, subtracted and multiplied by constants here")
    }
}

impl Error for NonAffine {}
