//! A mechanism in closed form: for terminals, for LaTeX, as a RON closed form, as Rust, as JSON.

mod code;
mod latex;
mod notation;
mod ron;
mod text;

pub use code::rust;
pub use latex::latex;
pub use ron::ron;
pub use text::text;

pub(super) use notation::{Notation, Script};

use super::json::document;
use crate::algebra::Expression;
use crate::analysis::formulas::{FormulasReport, Meaning};

/// The report as JSON, with the mechanism's name and the program's version. Expressions are written as in a file.
pub fn json(report: &FormulasReport) -> String {
    document(&report.mechanism, report)
}

/// Sentences about what a reader might miss; none for most mechanisms.
fn notes(report: &FormulasReport) -> Vec<String> {
    let mut notes = Vec::new();
    let screws = report
        .letters
        .iter()
        .filter(|l| l.meaning == Meaning::Screw);
    for screw in screws {
        notes.push(format!(
            "{} turns and slides at once: as an angle it stands in sines and cosines, times its pitch in lengths.",
            screw.name
        ));
    }
    for left_out in &report.left_out {
        notes.push(format!(
            "Left out, for it is too long to be multiplied out: {left_out}."
        ));
    }
    if !report.simplified {
        notes.push(
            "Some formulas were too long to be simplified; they are printed as sums over angles."
                .into(),
        );
    }
    notes
}

/// Whether the pose of a platform stands in an expression.
fn needs_platform(report: &FormulasReport, expressions: &[&Expression]) -> bool {
    let platform = |name: &str| {
        let mut letters = report.letters.iter();
        letters.any(|letter| letter.meaning == Meaning::Platform && letter.name == name)
    };
    let mut names = expressions.iter().flat_map(|expression| expression.names());
    names.any(|(name, _)| platform(name))
}
