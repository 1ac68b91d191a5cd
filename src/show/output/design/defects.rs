//! Defects of designs in words.

use crate::analysis::design::{Defect, Deviation};
use crate::description::quoted;
use crate::output::quantity::{clause, form, quantity};

/// `0.0123 m (`point.x` in position 4)`
pub(super) fn missed(of: &Deviation) -> String {
    let by = quantity(of.deviation.abs(), of.unit);
    format!("{by} (`{}` in position {})", of.quantity, of.position)
}

/// The defects of a design, in words.
pub(super) fn defects(all: &[Defect]) -> String {
    let words: Vec<String> = all.iter().map(defect).collect();
    words.join("; ")
}

fn defect(defect: &Defect) -> String {
    match defect {
        Defect::Circuit { positions } => {
            let are = are(positions);
            format!("circuit defect: {are} on another circuit than the first")
        }
        Defect::Branch { driver, positions } => {
            let are = are(positions);
            format!("branch defect: {are} beyond a dead position of `{driver}`")
        }
        Defect::Order { order } => {
            let order: Vec<String> = order.iter().map(usize::to_string).collect();
            format!(
                "order defect: the positions are passed in the order {}",
                order.join(" ")
            )
        }
        Defect::Limit { joints, positions } => {
            let (are, joints) = (are(positions), quoted(joints));
            format!("{are} not reached within the limits of {joints}")
        }
        Defect::Assembly { positions } => {
            let are = are(positions);
            format!(
                "{are} in another assembly than the one before: driven joints that move straight there end in a different one"
            )
        }
        Defect::Crossing => {
            "branches cross on the way: it can change into another motion there".into()
        }
        Defect::Motion { input, unit, at } => match at {
            Some(at) => format!("`{input}` stops at {}", quantity(*at, *unit)),
            None => format!("`{input}` does not move through its range"),
        },
        Defect::Condition {
            quantity: name,
            unit,
            bound,
            worst,
            at_least,
        } => {
            let bound = quantity(*bound, *unit);
            let sign = if *at_least { "at least" } else { "at most" };
            match worst {
                Some(worst) => format!(
                    "`{name}` shall be {sign} {bound}, and is {} at worst",
                    quantity(*worst, *unit)
                ),
                None => format!("`{name}` shall be {sign} {bound}, and is not bounded everywhere"),
            }
        }
        Defect::Tolerance { targets } => {
            let missed = targets.iter().map(|of| {
                let most = quantity(of.tolerance.unwrap_or_default(), of.unit);
                format!("{}, more than {most}", missed(of))
            });
            let missed: Vec<String> = missed.collect();
            format!("misses by {}", missed.join(" and "))
        }
        Defect::NotJudged => "its motion could not be judged".into(),
    }
}

/// `position 2 is` or `positions 2 and 3 are`
fn are(of: &[usize]) -> String {
    let positions = form(of.len(), "position", "positions");
    let numbers: Vec<String> = of.iter().map(usize::to_string).collect();
    format!("{positions} {}", clause(&numbers, "is", "are"))
}
