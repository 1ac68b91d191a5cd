//! Words for what is wrong with an expression.

use super::syntax::shown;
use super::{count, nearest, quoted};
use crate::algebra::{
    EvaluationErrorKind, Function, LARGEST, MAX_HEIGHT, MAX_NESTING, Measure, MeasureErrorKind,
    ParseErrorKind, Unit,
};

pub(in crate::description) fn title(error: &ParseErrorKind) -> String {
    use ParseErrorKind::*;
    match error {
        Empty => "the expression is empty".into(),
        UnexpectedCharacter(c) => format!(
            "the character `{}` has no meaning in an expression",
            shown(*c)
        ),
        ExpectedOperand => "expected a number, a name or `(`".into(),
        MissingOperator => "an operator is missing between two values".into(),
        UnknownUnit(unit) => format!("`{unit}` after a number is not a unit"),
        UnclosedParenthesis => "a parenthesis is not closed".into(),
        UnopenedParenthesis => "a closing parenthesis has no opening one".into(),
        UnexpectedComma => "there is a comma outside the arguments of a function".into(),
        UnknownFunction(name) => format!("there is no function `{name}`"),
        MissingArguments(function) => format!(
            "the function `{}` needs its argument in parentheses",
            function.word()
        ),
        WrongArgumentCount { function, found } => {
            format!(
                "`{}` takes {}, found {found}",
                function.word(),
                count(function.arity(), "argument")
            )
        }
        PowerOfUnit => {
            "it is not clear whether the power belongs to the number or to its unit".into()
        }
        DoubleStar => "a power is written `^`, not `**`".into(),
        MalformedNumber => "this is not a number".into(),
        NumberTooLarge => "the number is too large".into(),
        TooDeep => format!("the expression is nested more than {MAX_NESTING} levels deep"),
        TooLong => format!("the expression has more than {MAX_HEIGHT} operations in a row"),
    }
}

pub(super) fn label(error: &ParseErrorKind) -> &'static str {
    use ParseErrorKind::*;
    match error {
        Empty => "empty",
        ExpectedOperand => "a value is missing here",
        MissingOperator => "an operator is missing before this",
        UnclosedParenthesis => "opened here",
        UnknownUnit(_) | UnknownFunction(_) => "not known",
        _ => "",
    }
}

pub(super) fn help(error: &ParseErrorKind) -> Option<String> {
    use ParseErrorKind::*;
    let help = match error {
        Empty => "write 0 or leave the field out",
        UnexpectedCharacter('·' | '×' | '∙' | '⋅') => "write `*` to multiply",
        UnexpectedCharacter('−' | '–' | '—') => "write the minus sign of the keyboard, `-`",
        UnexpectedCharacter('÷' | ':') => "write `/` to divide",
        UnexpectedCharacter('°') => "write `deg`, as in `60 deg`",
        UnexpectedCharacter('²' | '³' | '¹' | 'ⁿ') => "write a power with `^`, as in `x^2`",
        UnexpectedCharacter('√') => "write `sqrt(…)`",
        UnexpectedCharacter('[' | ']' | '{' | '}') => "write `(` and `)`",
        MissingOperator => "write `*` to multiply",
        UnknownUnit(_) => {
            let units = Unit::ALL.map(Unit::word);
            return Some(format!(
                "write `*` to multiply; the units are {}",
                quoted(&units)
            ));
        }
        UnknownFunction(name) => {
            let functions = Function::ALL.map(Function::word);
            return Some(match alias(name).or_else(|| nearest(name, functions)) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!(
                    "write `*` to multiply; the functions are {}",
                    quoted(&functions)
                ),
            });
        }
        MissingArguments(function) => return Some(format!("write `{}(…)`", function.word())),
        PowerOfUnit => "write parentheses, as in `(5 mm)^2`",
        TooDeep | TooLong => "name parts of it as parameters",
        _ => return None,
    };
    Some(help.to_owned())
}

/// What other programs call a function.
fn alias(name: &str) -> Option<&'static str> {
    match name {
        "arcsin" => Some("asin"),
        "arccos" => Some("acos"),
        "arctan" => Some("atan"),
        "arctan2" | "Atan2" => Some("atan2"),
        "log" => Some("ln"),
        "norm" => Some("hypot"),
        _ => None,
    }
}

pub(in crate::description) fn no_value(error: &EvaluationErrorKind) -> String {
    use EvaluationErrorKind::*;
    match error {
        DivisionByZero => "division by zero".into(),
        RootOfNegative(x) => format!("the square root of {x} is not a real number"),
        LogarithmOfNonPositive(x) => format!("the logarithm of {x} is not a real number"),
        OutOfRange(function, x) => format!("`{}` of {x} is not a real number", function.word()),
        PowerOfNegative(x) => format!("a non-integer power of {x} is not a real number"),
        TooLarge(x) => {
            format!("the value {x:e} is too large; the limit is {LARGEST:e}")
        }
        NotFinite => "the value is not finite".into(),
    }
}

pub(in crate::description) fn unit(error: &MeasureErrorKind) -> String {
    match error {
        MeasureErrorKind::Wrong { wanted, found } => {
            let (wanted, found) = (measure(*wanted), measure(*found));
            format!("expected {wanted}, found {found}")
        }
        MeasureErrorKind::Mixed => "an angle and a length are mixed".into(),
        MeasureErrorKind::LengthAsAngle(function) => {
            format!("`{}` takes an angle, not a length", function.word())
        }
    }
}

pub(super) fn unit_label(error: &MeasureErrorKind) -> &'static str {
    match error {
        MeasureErrorKind::Wrong { found, .. } => measure(*found),
        MeasureErrorKind::Mixed => "an angle and a length",
        MeasureErrorKind::LengthAsAngle(_) => "a length",
    }
}

pub(super) fn unit_help(error: &MeasureErrorKind) -> &'static str {
    match error {
        MeasureErrorKind::Wrong { wanted, .. } => match wanted {
            Measure::Length => "write m, cm, mm or in; a number without unit is in m",
            Measure::Angle => "write deg or rad; a number without unit is in rad",
            Measure::Force => "write the number alone; it is in N",
            Measure::Moment => "write the number alone; it is in N·m",
            Measure::Number | Measure::Open => "write the number alone",
        },
        MeasureErrorKind::Mixed => "give both the same unit, or none",
        MeasureErrorKind::LengthAsAngle(_) => {
            "write deg or rad, or divide by a length; a number without unit is in rad"
        }
    }
}

fn measure(measure: Measure) -> &'static str {
    match measure {
        Measure::Number | Measure::Open => "a number",
        Measure::Angle => "an angle",
        Measure::Length => "a length",
        Measure::Force => "a force",
        Measure::Moment => "a moment",
    }
}
