//! Words for what is wrong with an expression.

use super::syntax::shown;
use super::{count, listed, nearest};
use crate::algebra::{
    EvaluationErrorKind, Function, MAX_HEIGHT, MAX_NESTING, ParseErrorKind, Unit,
};

pub(super) fn title(error: &ParseErrorKind) -> String {
    use ParseErrorKind::*;
    match error {
        Empty => "the expression is empty".into(),
        UnexpectedCharacter(c) => format!(
            "the character `{}` has no meaning in an expression",
            shown(*c)
        ),
        ExpectedOperand => "a number, a name or `(` must stand here".into(),
        MissingOperator => "an operator is missing between two values".into(),
        UnknownUnit(unit) => format!("`{unit}` after a number is not a unit"),
        UnclosedParenthesis => "a parenthesis is not closed".into(),
        UnopenedParenthesis => "a parenthesis closes nothing".into(),
        UnexpectedComma => "a comma stands outside the arguments of a function".into(),
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
        Empty => "nothing in it",
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
                listed(&units)
            ));
        }
        UnknownFunction(name) => {
            let functions = Function::ALL.map(Function::word);
            return Some(match alias(name).or_else(|| nearest(name, functions)) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!(
                    "write `*` to multiply; the functions are {}",
                    listed(&functions)
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

pub(super) fn no_value(error: &EvaluationErrorKind) -> String {
    use EvaluationErrorKind::*;
    match error {
        DivisionByZero => "division by zero".into(),
        RootOfNegative(x) => format!("the square root of {x} is not a real number"),
        LogarithmOfNonPositive(x) => format!("the logarithm of {x} is not a real number"),
        OutOfRange(function, x) => format!("`{}` of {x} is not a real number", function.word()),
        PowerOfNegative(x) => format!("a power of {x} that is not whole is not a real number"),
        NotFinite => "the value is not finite".into(),
    }
}
