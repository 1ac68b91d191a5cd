//! Words about the assembly of a mechanism before it is analysed.

use super::document::Document;
use super::quantity::{clause, degrees, if_any, metres, quantity};
use super::report::{Report, Rows};
use crate::linear::SPECTRUM_LIMIT;
use crate::number::tolerance::ROUNDING;
use crate::system::{Analysed, GivenPose, Moved, NotClosed, TooLarge};

/// `0.213 m and 4.2°`
pub(super) fn gap(distance: f64, angle: f64) -> String {
    // what rounding leaves of a gap is none
    match (distance < ROUNDING, angle < ROUNDING) {
        (_, true) => metres(distance),
        (true, false) => degrees(angle),
        (false, false) => format!("{} and {}", metres(distance), degrees(angle)),
    }
}

/// Measure that is least at a closest approach of a mechanism with rods.
pub(super) const SQUARED_LENGTHS: &str = "a rod of length L whose ends are d apart counts as (d² − L²)/2, not as d − L: \
     closest means the least sum of squares of all closure equations";

/// Gap of the given pose.
pub(super) fn given(pose: &GivenPose) -> Option<String> {
    let moved = match pose.kept {
        true => "",
        false => {
            ", which moved actuated joints too, because it closes nowhere with their values in the file"
        }
    };
    pose.given_gap.as_ref().map(|given| {
        format!(
            "The given pose was not assembled: closure `{}` was open by {}; it was assembled first{moved}.",
            given.closure,
            gap(given.distance, given.angle)
        )
    })
}

/// True if an answer holds for the values in the file: those of a rounded pose may change a
/// little, but a file that cannot be assembled was answered for another mechanism.
fn is_about_the_file(pose: &GivenPose, length: f64) -> bool {
    let given = pose.given_gap.as_ref();
    pose.kept || given.is_none_or(|given| !given.is_wide(length))
}

/// A document on one configuration of a mechanism of that length.
pub(super) fn document(mechanism: &str, answer: String, at: &GivenPose, length: f64) -> Document {
    Document::new(mechanism, after_moving(at.moved.as_ref(), answer))
        .yes_if(is_about_the_file(at, length))
        .warnings(outside_limits(&at.outside_limits))
}

/// The answer, which begins with how far the pose given had to move if that is more than rounding.
pub(super) fn after_moving(moved: Option<&Moved>, answer: String) -> String {
    match moved.filter(|moved| !moved.is_small()) {
        Some(moved) => format!(
            "The given pose is not assembled, and the nearest assembly is not close to it: {}. {answer}",
            way(moved)
        ),
        None => answer,
    }
}

/// Gap of the given pose, and distance of guesses from an assembly beside them.
pub(super) fn notes(pose: &GivenPose) -> impl Iterator<Item = String> {
    given(pose)
        .into_iter()
        .chain(distance_moved(pose.moved.as_ref()))
}

/// Distance of the given pose from an assembly near it.
pub(super) fn distance_moved(moved: Option<&Moved>) -> Option<String> {
    let moved = moved.filter(|moved| moved.is_small())?;
    let way = way(moved);
    Some(format!(
        "assembled near the given pose: {way}, more than any other coordinate"
    ))
}

/// Distance from the start of a search to its end, near or far.
pub(super) fn from_start(moved: &Moved) -> String {
    format!(
        "from the given pose {}, more than any other coordinate",
        way(moved)
    )
}

fn way(moved: &Moved) -> String {
    let distance = quantity(moved.distance, moved.unit);
    format!("{} moved by {distance}", moved.name)
}

/// The warning that joints are outside their limits.
pub fn outside_limits(joints: &[String]) -> Option<String> {
    let [one, many] = ["is outside its limits", "are outside their limits"];
    (!joints.is_empty()).then(|| clause(joints, one, many))
}

impl<R: Report> Report for Analysed<R> {
    fn document(&self) -> Document {
        report(self).document()
    }

    fn rows(&self) -> Option<Rows<'_>> {
        report(self).rows()
    }
}

fn report<R: Report>(analysed: &Analysed<R>) -> &dyn Report {
    match analysed {
        Analysed::Closed(report) => report,
        Analysed::NotClosed(open) => open,
        Analysed::TooLarge(large) => large,
    }
}

impl Report for TooLarge {
    fn document(&self) -> Document {
        let answer = format!(
            "Not analysed: the mechanism has {} unknowns, and this analysis is limited to \
             {SPECTRUM_LIMIT}. Analyse a part of it.",
            self.unknowns
        );
        Document::new(&self.mechanism, answer).yes_if(false)
    }
}

impl Report for NotClosed {
    fn document(&self) -> Document {
        let held = if_any(&self.held, |held| format!(" with {held} held"));
        let left = self.left.as_ref().map(|left| {
            let (closure, gap) = (&left.closure, gap(left.distance, left.angle));
            format!(": at the closest approach closure {closure} is open by {gap}")
        });
        let answer = format!(
            "Not assembled{held}{}. Only an assembled mechanism can be analysed: hold other \
             values, start elsewhere, or free a joint that is held; `linkwork solve` says more.",
            left.unwrap_or_default()
        );
        let document = Document::new(&self.mechanism, answer).yes_if(false);
        document.interrupted(self.interrupted, "")
    }
}
