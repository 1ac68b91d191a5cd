//! Words about closing a mechanism before it is analysed.

use super::document::{Document, Report};
use super::quantity::{degrees, quantity};
use crate::description::listed;
use crate::linear::SPECTRUM_LIMIT;
use crate::system::{Analysed, NotClosed, WidestGap};

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

/// What is least at a closest approach of a mechanism with rods.
pub(super) const SQUARED_LENGTHS: &str = "a rod of length L whose ends are d apart counts by (d² − L²)/2, not by d − L: \
     closest is where the sum of the squares of all closure rows is least";

/// How far the pose given was off.
pub(super) fn given(given: &WidestGap, kept: bool) -> String {
    let free = match kept {
        true => "",
        false => {
            ", which moved actuated joints too, because it closes nowhere with their values in the file"
        }
    };
    format!(
        "The pose given was not assembled: closure `{}` was open by {}; it was assembled first{free}.",
        given.closure,
        gap(given.distance, given.angle)
    )
}

/// Whether an answer is about the values that the file holds: those of a rounded pose may change a
/// little, but a file that cannot be assembled was answered for another mechanism.
pub fn is_about_the_file(kept: bool, given: Option<&WidestGap>, length: f64) -> bool {
    kept || given.is_none_or(|given| !given.is_wide(length))
}

/// The remark that joints are outside their limits; empty if none is.
pub fn limits_warning(outside: &[String]) -> String {
    match outside {
        [] => String::new(),
        [one] => format!("warning: {one} is outside its limits\n"),
        many => format!("warning: {} are outside their limits\n", listed(many)),
    }
}

impl<R: Report> Report for Analysed<R> {
    fn document(&self) -> Document {
        match self {
            Analysed::Closed(report) => report.document(),
            Analysed::NotClosed(open) => open.document(),
            Analysed::TooLarge(large) => Document::new(&large.mechanism, too_large(large.unknowns)),
        }
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        self.report().map_or(Vec::new(), Report::sentences)
    }

    fn lists(&self) -> Vec<(&'static str, Vec<String>)> {
        self.report().map_or(Vec::new(), Report::lists)
    }
}

impl Report for NotClosed {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        Document::new(&self.mechanism, sentence(self))
    }
}

fn too_large(unknowns: usize) -> String {
    format!(
        "Not analysed: the mechanism has {unknowns} unknowns, and this analysis is limited to \
         {SPECTRUM_LIMIT}. Analyse a part of it."
    )
}

fn sentence(open: &NotClosed) -> String {
    let held = match open.held.is_empty() {
        true => String::new(),
        false => format!(" with {} held", listed(&open.held)),
    };
    let left = match &open.left {
        Some(left) => format!(
            ": at the closest approach closure {} is open by {}",
            left.closure,
            gap(left.distance, left.angle)
        ),
        None => String::new(),
    };
    format!(
        "Not assembled{held}{left}. Only an assembled mechanism can be analysed: hold other \
         values, start elsewhere, or free a joint that is held; `linkwork solve` says more."
    )
}
