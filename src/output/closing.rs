//! Words about closing a mechanism before it is analysed.

use serde::Serialize;

use super::json::document;
use super::layout::listed;
use super::quantity::{degrees, quantity};
use crate::mechanism::Mechanism;
use crate::system::{NotClosed, WidestGap};

/// `0.213 m and 4.2°`
pub(super) fn gap(distance: f64, angle: f64) -> String {
    // what rounding leaves of a gap is none
    const NONE: f64 = 1e-9;
    match (distance < NONE, angle < NONE) {
        (_, true) => quantity(distance, false),
        (true, false) => degrees(angle),
        (false, false) => format!("{} and {}", quantity(distance, false), degrees(angle)),
    }
}

/// How far the pose given was off.
pub(super) fn given(given: &WidestGap, kept: bool) -> String {
    let free = match kept {
        true => "",
        false => ", which moved what the file holds too",
    };
    format!(
        "The pose given was not closed: closure `{}` gaped by {}; it was closed first{free}.",
        given.closure,
        gap(given.distance, given.angle)
    )
}

/// Why there is no answer, and what to ask instead.
pub fn not_closed_text(mechanism: &Mechanism, open: &NotClosed) -> String {
    format!("{}\n{}\n", mechanism.name(), sentence(open))
}

fn sentence(open: &NotClosed) -> String {
    let held = match open.held.is_empty() {
        true => String::new(),
        false => format!(" with {} held", listed(&open.held)),
    };
    let left = match &open.left {
        Some(left) => format!(
            ": at the closest approach closure {} gapes by {}",
            left.closure,
            gap(left.distance, left.angle)
        ),
        None => String::new(),
    };
    format!(
        "Not assembled{held}{left}. Only an assembled mechanism can be analysed: ask for other \
         values with --hold, for another start with --guess, or let a joint be found with --free; \
         `linkwork solve` says more."
    )
}

/// The same as JSON.
pub fn not_closed_json(mechanism: &Mechanism, open: &NotClosed) -> String {
    #[derive(Serialize)]
    struct NotClosedJson<'a> {
        closed: bool,
        sentence: String,
        left: Option<&'a WidestGap>,
        held: &'a [String],
    }
    let json = NotClosedJson {
        closed: false,
        sentence: sentence(open),
        left: open.left.as_ref(),
        held: &open.held,
    };
    document(mechanism.name(), &json)
}
