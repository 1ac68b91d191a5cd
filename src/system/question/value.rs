//! Values given beside a file, in the words of the file.

use crate::algebra::{EvaluationErrorKind, Expression, Measure, MeasureErrorKind, ParseErrorKind};
use crate::description::nearest;
use crate::geometry::{Axis, Pose, Vector3};
use crate::mechanism::Mechanism;

/// What is wrong with a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueError {
    /// It does not parse.
    Parse(ParseErrorKind),
    /// It uses a name that is no parameter.
    UnknownName {
        /// The name.
        name: String,
        /// The parameter that was probably meant.
        suggestion: Option<String>,
    },
    /// It has no value.
    NoValue(EvaluationErrorKind),
    /// Its unit does not fit.
    Unit(MeasureErrorKind),
    /// It is not a list of displacements.
    NotAPose {
        /// The part that is none.
        part: String,
    },
}

/// The value of an expression over the mechanism's parameters, in m, rad, N or N·m, and per unit of
/// time for a rate.
pub fn number(mechanism: &Mechanism, text: &str, wanted: Measure) -> Result<f64, ValueError> {
    let expression = Expression::parse(text).map_err(|error| ValueError::Parse(error.kind))?;
    let parameters = mechanism.parameters();
    let resolved = expression.try_resolve(|name, _| {
        let found = parameters.iter().find(|parameter| parameter.name == *name);
        found.ok_or_else(|| name.clone())
    });
    match resolved {
        Ok(resolved) => {
            (resolved.check_measure(wanted, &|parameter| parameter.measure))
                .map_err(|error| ValueError::Unit(error.kind))?;
            (resolved.evaluate(&|parameter| parameter.value))
                .map_err(|error| ValueError::NoValue(error.kind))
        }
        Err(names) => {
            let name = names.into_iter().next().unwrap_or_default();
            let known = parameters.iter().map(|parameter| parameter.name.as_str());
            let suggestion = nearest(&name, known).map(str::to_owned);
            Err(ValueError::UnknownName { name, suggestion })
        }
    }
}

/// The pose of a list such as `[Tz(0.5), Rx(10 deg)]`, read left to right as in a file.
pub fn pose(mechanism: &Mechanism, text: &str) -> Result<Pose<f64>, ValueError> {
    let refusal = |part: &str| ValueError::NotAPose {
        part: part.trim().into(),
    };
    let inside = text
        .trim()
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'));
    let inside = inside.ok_or_else(|| refusal(text))?;
    let mut pose = Pose::identity();
    for part in split_outside_parentheses(inside) {
        let (word, arguments) = part.trim().split_once('(').ok_or_else(|| refusal(part))?;
        let arguments = arguments.strip_suffix(')').ok_or_else(|| refusal(part))?;
        let word = word.trim();
        let wanted = match word.starts_with('R') {
            true => Measure::Angle,
            false => Measure::Length,
        };
        let values = split_outside_parentheses(arguments)
            .into_iter()
            .map(|value| number(mechanism, value.trim().trim_matches('"'), wanted))
            .collect::<Result<Vec<f64>, _>>()?;
        let step = match (word, values.as_slice()) {
            ("Tx", &[x]) => Pose::translation(Vector3([x, 0.0, 0.0])),
            ("Ty", &[y]) => Pose::translation(Vector3([0.0, y, 0.0])),
            ("Tz", &[z]) => Pose::translation(Vector3([0.0, 0.0, z])),
            ("T", &[x, y, z]) => Pose::translation(Vector3([x, y, z])),
            ("Rx", &[angle]) => Pose::rotation(Axis::X, angle),
            ("Ry", &[angle]) => Pose::rotation(Axis::Y, angle),
            ("Rz", &[angle]) => Pose::rotation(Axis::Z, angle),
            _ => return Err(refusal(part)),
        };
        pose = pose * step;
    }
    Ok(pose)
}

/// The parts between commas that stand in no parentheses; none if there is only space.
fn split_outside_parentheses(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut depth, mut start) = (0i32, 0);
    for (i, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    if !text[start..].trim().is_empty() {
        parts.push(&text[start..]);
    }
    parts
}
