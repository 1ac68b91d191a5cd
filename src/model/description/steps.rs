//! Lists of displacements as they are written: put together, undone, and where they lead.

use std::convert::Infallible;
use std::ops::Range;

use super::{Displacement, Entry};
use crate::algebra::{Expression, Function, Node};
use crate::geometry::Axis;
use crate::number::real;

/// The entry 0.
pub fn zero() -> Entry {
    Entry::number(0.0, 0..0)
}

/// −e, as it would be written.
pub fn negated(e: &Entry) -> Entry {
    Entry::from(match e.expression.as_number() {
        Some(x) => Expression::number(0.0 - x),
        None => e.expression.negative(),
    })
}

/// Tx(a)·Rx(α)·Ry(β), without zeros.
pub fn link([a, alpha, beta]: [&Entry; 3]) -> Vec<Displacement> {
    let along = Displacement::Translate(Axis::X, a.clone());
    let [twist, tilt] = [(Axis::X, alpha), (Axis::Y, beta)];
    let about = [twist, tilt].map(|(axis, angle)| Displacement::Rotate(axis, angle.clone()));
    doing_something([along].into_iter().chain(about))
}

/// The steps that move something.
pub fn doing_something(steps: impl IntoIterator<Item = Displacement>) -> Vec<Displacement> {
    let something = |step: &Displacement| !step.entries().iter().all(is_zero);
    steps.into_iter().filter(something).collect()
}

/// The steps that lead back.
pub fn undone(steps: &[Displacement]) -> Vec<Displacement> {
    let undo = |step: &Displacement| step.try_map(|e| Ok::<_, Infallible>(negated(e)));
    let undone: Result<_, Infallible> = steps.iter().rev().map(undo).collect();
    let Ok(undone) = undone;
    undone
}

/// Displacements from the end of some to that of others.
pub(crate) fn between(from: &[Displacement], to: &[Displacement]) -> Vec<Displacement> {
    joined(undone(from).into_iter().chain(to.iter().cloned()))
}

/// Displacements one after the other, what undoes itself left out: neighbours of one kind become one.
pub fn joined(steps: impl IntoIterator<Item = Displacement>) -> Vec<Displacement> {
    let mut joined: Vec<Displacement> = Vec::new();
    for step in steps {
        let merged = match (joined.last(), &step) {
            (Some(Displacement::Rotate(a, x)), Displacement::Rotate(b, y)) if a == b => {
                Some(Displacement::Rotate(*a, sum([x, y])))
            }
            (Some(Displacement::Rotate(..)), _) | (None, _) | (_, Displacement::Rotate(..)) => None,
            (Some(last), step) => {
                let (x, y) = (translation(last), translation(step));
                Some(Displacement::TranslateBy(
                    [0, 1, 2].map(|i| sum([&x[i], &y[i]])),
                ))
            }
        };
        match merged {
            Some(merged) => {
                joined.pop();
                joined.extend(doing_something([merged]));
            }
            None => joined.extend(doing_something([step])),
        }
    }
    joined.into_iter().map(briefly).collect()
}

/// A translation along one axis where it is one.
fn briefly(step: Displacement) -> Displacement {
    let Displacement::TranslateBy(entries) = &step else {
        return step;
    };
    let given: Vec<usize> = (0..3).filter(|&i| !is_zero(&entries[i])).collect();
    match given[..] {
        [i] => Displacement::Translate([Axis::X, Axis::Y, Axis::Z][i], entries[i].clone()),
        _ => step,
    }
}

fn is_zero(entry: &Entry) -> bool {
    entry.expression.fixed_value() == Some(0.0)
}

/// The sum, with the place of the last that is not zero.
pub(crate) fn sum<'a>(terms: impl IntoIterator<Item = &'a Entry>) -> Entry {
    signed_sum(terms.into_iter().map(|term| (1.0, term)))
}

/// Σ factor·term, with the place of the last term that is not zero.
pub(crate) fn signed_sum<'a>(terms: impl IntoIterator<Item = (f64, &'a Entry)>) -> Entry {
    let terms: Vec<(f64, &Entry)> = terms.into_iter().filter(|(_, e)| !is_zero(e)).collect();
    let span = terms.last().map_or(0..0, |(_, entry)| entry.span.clone());
    let expression = Expression::sum(terms.into_iter().map(|(f, entry)| (f, &entry.expression)));
    let entry = match expression.as_number() {
        Some(value) => Entry::length(value),
        None => expression.into(),
    };
    Entry { span, ..entry }
}

/// The vector of a translation; zero for a rotation.
pub(crate) fn translation(step: &Displacement) -> [Entry; 3] {
    let mut vector = [zero(), zero(), zero()];
    match step {
        Displacement::Translate(axis, entry) => vector[*axis as usize] = entry.clone(),
        Displacement::TranslateBy(entries) => vector = entries.clone(),
        Displacement::Rotate(..) => {}
    }
    vector
}

/// A vector seen from where displacements start: turned by their rotations, and moved if it is a point.
pub fn carried(steps: &[Displacement], vector: [Entry; 3], is_point: bool) -> [Entry; 3] {
    steps.iter().rev().fold(vector, |vector, step| match step {
        Displacement::Rotate(axis, angle) => turned(*axis, angle, vector),
        _ if !is_point => vector,
        _ => {
            let by = translation(step);
            [0, 1, 2].map(|i| sum([&by[i], &vector[i]]))
        }
    })
}

/// √3/2 and √2/2 as they are written, so that what a multiple of 30° or 45° turns stays exact.
fn root(value: f64) -> Option<Entry> {
    let squares = [3.0_f64, 2.0].into_iter();
    let mut known = squares.filter(|square| (value.abs() - square.sqrt() / 2.0).abs() < 1e-15);
    let sign = if value < 0.0 { "-" } else { "" };
    let written = Expression::parse(&format!("{sign}sqrt({})/2", known.next()?));
    written.ok().map(Entry::from)
}

fn turned(axis: Axis, angle: &Entry, vector: [Entry; 3]) -> [Entry; 3] {
    let [cos, sin] = [Function::Cos, Function::Sin].map(|function| {
        let value = angle.expression.fixed_value().map(|angle| match function {
            Function::Cos => real::cos(angle),
            _ => real::sin(angle),
        });
        match value {
            Some(value) => root(value).unwrap_or_else(|| Entry::length(value)),
            None => Node::Call(function, vec![angle.expression.clone()])
                .at(0..0)
                .into(),
        }
    });
    let product = |x: &Entry, y: &Entry| Entry::from(x.expression.times(&y.expression));
    let along = axis as usize;
    let (u, v) = ((along + 1) % 3, (along + 2) % 3);
    let mut turned = vector.clone();
    // the second axis turns to the third
    let parts = [&vector[u], &vector[v]].map(|x| (product(&cos, x), product(&sin, x)));
    turned[u] = signed_sum([(1.0, &parts[0].0), (-1.0, &parts[1].1)]);
    turned[v] = signed_sum([(1.0, &parts[0].1), (1.0, &parts[1].0)]);
    turned
}

fn call(function: Function, arguments: [&Entry; 2], span: &Range<usize>) -> Entry {
    let arguments = arguments.map(|entry| entry.expression.clone());
    Node::Call(function, arguments.to_vec())
        .at(span.clone())
        .into()
}

/// The angle of the point (x, y), as a number if these are numbers.
fn angle(y: &Entry, x: &Entry, span: &Range<usize>) -> Entry {
    let entry = match (y.expression.fixed_value(), x.expression.fixed_value()) {
        (Some(y), Some(x)) => Entry::angle(real::atan2(y, x)),
        _ => call(Function::Atan2, [y, x], span),
    };
    let span = span.clone();
    Entry { span, ..entry }
}

/// The turn about z by which x, after rotations that turn z into one of two perpendicular directions, becomes first ×
/// second.
pub(crate) fn onto_normal(
    steps: &[Displacement],
    directions: &[[Entry; 3]; 2],
    side: usize,
) -> Vec<Displacement> {
    let [x, y, z] = carried(&undone(steps), directions[1 - side].clone(), false);
    let [sin, cos] = match side {
        0 => [x, negated(&y)],
        _ => [negated(&x), y],
    };
    doing_something([Displacement::Rotate(Axis::Z, angle(&sin, &cos, &z.span))])
}

/// Rotations that turn z into a direction: about one axis where that does.
pub(crate) fn towards(direction: &[Entry; 3]) -> Vec<Displacement> {
    let [x, y, z] = direction;
    let span = &direction[2].span;
    let steps = match (is_zero(x), is_zero(y)) {
        (_, true) => vec![Displacement::Rotate(Axis::Y, angle(x, z, span))],
        (true, false) => vec![Displacement::Rotate(Axis::X, angle(&negated(y), z, span))],
        (false, false) => {
            let across = match (x.expression.fixed_value(), y.expression.fixed_value()) {
                (Some(x), Some(y)) => Entry::length(real::hypot(x, y)),
                _ => call(Function::Hypot, [x, y], span),
            };
            vec![
                Displacement::Rotate(Axis::Z, angle(y, x, span)),
                Displacement::Rotate(Axis::Y, angle(&across, z, span)),
            ]
        }
    };
    doing_something(steps)
}
