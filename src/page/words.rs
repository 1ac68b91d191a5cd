//! Words of a page for motions that end and questions that are refused: sliders and ticks in place of options.

use crate::analysis::sweep::{MetKind, SweepEnd, SweepReport};
use crate::ask::AskError;
use crate::description::listed;
use crate::mechanism::{Configuration, Mechanism, QuantityError};
use crate::output::quantity::quantity;
use crate::output::sweep::sentence;
use crate::system::{Coordinate, QuestionError};

/// Reason for which a motion did not reach its end.
pub fn stopped(report: &SweepReport) -> Option<String> {
    let met = report.met.last().map(|met| &met.kind);
    Some(match (report.ending, met) {
        (ending, _) if ending.is_whole() => return None,
        (
            SweepEnd::Limit | SweepEnd::OutsideLimits,
            Some(MetKind::Limit {
                joint,
                limit,
                unit,
                upper,
            }),
        ) => at_limit(joint, *upper, &quantity(*limit, *unit)),
        (SweepEnd::Fold, Some(MetKind::Fold { locked, .. })) => format!(
            "A dead point of {}. Go back, drag a body across, or choose a way on.",
            listed(locked)
        ),
        (SweepEnd::Crossing | SweepEnd::SingularStart, _) => {
            "Branches meet here. Go back, drag a body the way it should go, or choose a way on."
                .into()
        }
        (SweepEnd::Lost, _) => {
            "The motion cannot be followed farther this way. Go back, or drag a body another way."
                .into()
        }
        _ => sentence(report),
    })
}

/// The joints that are at a limit.
pub fn limits(mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<(String, String)> {
    /// As near as this a joint is at its limit, in rad or characteristic lengths.
    const NEAR: f64 = 1e-6;
    let joints = mechanism.joints().iter().enumerate();
    let there = joints.filter_map(|(joint, of)| {
        let (low, high) = of.limits?;
        let coordinate = Coordinate::Joint(joint);
        let near = NEAR * coordinate.scale(mechanism);
        let value = at.joints[joint];
        let upper = value >= high - near;
        (upper || value <= low + near).then(|| {
            let unit = crate::algebra::SiUnit::of_coordinate(coordinate.is_angle(mechanism));
            let limit = quantity(if upper { high } else { low }, unit);
            (of.name.clone(), at_limit(&of.name, upper, &limit))
        })
    });
    there.collect()
}

fn at_limit(joint: &str, upper: bool, limit: &str) -> String {
    let side = if upper { "upper" } else { "lower" };
    format!("{joint} is at its {side} limit of {limit}.")
}

/// Reason for which there is no answer, and the remedy.
pub fn refused(error: &AskError) -> String {
    match error {
        AskError::Quantity { error, .. } => match &**error {
            QuantityError::Unknown {
                suggestion: Some(meant),
                ..
            } => {
                format!("{error}: did you mean `{meant}`?")
            }
            _ => error.to_string(),
        },
        AskError::Question(QuestionError::TooMany { .. }) => {
            "More is held than the mechanism has freedoms: tick fewer values.".into()
        }
        AskError::NotAssembled(held) if !held.is_empty() => format!(
            "The mechanism does not assemble with {} at these values.",
            listed(held)
        ),
        _ => error.to_string(),
    }
}
