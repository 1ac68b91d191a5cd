//! Words about closing a mechanism before it is analysed.

use super::document::{Document, Report};
use super::quantity::{degrees, quantity};
use crate::description::listed;
use crate::linear::SPECTRUM_LIMIT;
use crate::system::{Analysed, Moved, NotClosed, WidestGap};

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
        false => ", which moved actuated joints too",
    };
    format!(
        "The pose given was not assembled: closure `{}` was open by {}; it was assembled first{free}.",
        given.closure,
        gap(given.distance, given.angle)
    )
}

/// The answer, which begins with how far the pose given had to move if that is more than rounding.
pub(super) fn after_moving(moved: Option<&Moved>, answer: String) -> String {
    match moved.filter(|moved| !moved.is_small()) {
        Some(moved) => format!(
            "The pose given is not assembled, and the assembly found is not beside it: {}. {answer}",
            way(moved)
        ),
        None => answer,
    }
}

/// How far the guesses moved to an assembly beside them.
pub(super) fn beside(moved: Option<&Moved>) -> Option<String> {
    let moved = moved.filter(|moved| moved.is_small())?;
    Some(format!(
        "assembled beside the pose given: {}, the most",
        way(moved)
    ))
}

fn way(moved: &Moved) -> String {
    let is_angle = moved.unit.is_angle();
    let distance = quantity(moved.distance, is_angle);
    format!("{} moved by {distance}", moved.name)
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
