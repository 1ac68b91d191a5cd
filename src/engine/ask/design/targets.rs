//! Targets of positions.

use super::DesignError;
use super::figure::{in_unit, no_quantity};
use crate::algebra::SiUnit;
use crate::description::{DesignPart, DesignProblem, Entry, Named, Role};
use crate::mechanism::{Measured, Mechanism, Quantity};
use crate::system::Target;

/// The coordinate of a point in ground as an expression: its offsets may be expressions of unknowns.
fn coordinate(of: &str, axis: &str) -> String {
    let (frame, offsets) = of.split_once('+').unwrap_or((of, ""));
    let frame = frame.trim();
    let numbers = offsets
        .split(',')
        .all(|text| text.trim().parse::<f64>().is_ok());
    if offsets.is_empty() || numbers {
        return format!("[{}].{axis}", of.trim());
    }
    let mut text = format!("[{frame}].{axis}");
    let along = ["1", "0,1", "0,0,1"];
    for (offset, along) in offsets.split(',').zip(along) {
        text += &format!(" + ({offset})*([{frame}+{along}].{axis} - [{frame}].{axis})/(1 m)");
    }
    text
}

pub(super) fn targets_of(
    mechanism: &Mechanism,
    (configuration, boxed): (usize, bool),
    named: &Named<Vec<Entry>>,
    part: DesignPart,
) -> Result<Vec<Target>, DesignError> {
    let name = &named.name.value;
    let values = &named.value;
    let point = match values.len() {
        1 => None,
        count => {
            let frame = name.split('+').next().unwrap_or(name).trim();
            if mechanism.frame(frame).is_none() {
                let name = name.clone();
                return Err(DesignProblem::NotAPoint { name, count }.at(part));
            }
            Some(["x", "y", "z"])
        }
    };
    let mut targets = Vec::new();
    for (i, value) in values.iter().enumerate() {
        let (label, text) = match point {
            None => (name.clone(), name.clone()),
            Some(axes) => (format!("{name}.{}", axes[i]), coordinate(name, axes[i])),
        };
        let read = |text: &str| {
            let read = Quantity::read(mechanism, &label, text);
            read.map_err(|error| no_quantity(error).at(part))
        };
        let plain = read(&text)?;
        let constant = value.expression.names().next().is_none();
        let (quantity, value) = match constant {
            true => {
                let number = in_unit(mechanism, plain.unit, value);
                (plain, number.map_err(|problem| problem.of_value(part))?)
            }
            false => (read(&format!("({text}) - ({})", value.expression))?, 0.0),
        };
        let of_position = |of: &Measured| {
            use crate::mechanism::Order::Value;
            matches!(
                of,
                Measured::Parameter(_) | Measured::Joint(_, Value) | Measured::Place(_, _, Value)
            )
        };
        if !quantity.measured().all(of_position) {
            return Err(DesignProblem::NotOfPosition { name: label }.at(part));
        }
        let given = |joint: usize| mechanism.joints()[joint].role == Role::Actuated;
        let exact = boxed || mechanism.joint(name).is_some_and(given);
        let length = mechanism.characteristic_length();
        let weight = match exact && quantity.unit == SiUnit::METRE {
            true => 1.0 / length,
            false => 1.0,
        };
        targets.push(Target {
            configuration,
            quantity,
            value,
            weight,
            exact,
        });
    }
    Ok(targets)
}

/// The extent of the lengths among the targets, or without any the mechanism's own.
pub(super) fn size(mechanism: &Mechanism, targets: &[Target]) -> f64 {
    let lengths = targets
        .iter()
        .filter(|of| of.quantity.unit == SiUnit::METRE);
    let most = lengths.map(|of| of.value.abs()).fold(0.0, f64::max);
    match most > 0.0 && most.is_finite() {
        true => most,
        false => mechanism.characteristic_length(),
    }
}
