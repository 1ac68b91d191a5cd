//! A mechanism in closed form: for terminals, for LaTeX, as a RON closed form, as Rust, as JSON.

mod code;
mod latex;
mod notation;
mod ron;
mod text;

pub use code::rust;
pub use latex::latex;
pub use ron::ron;

pub(super) use notation::{Notation, Script};

use crate::algebra::Expression;
use crate::analysis::formulas::{FormulasReport, Meaning};

/// Sentences about what a reader might miss; none for most mechanisms.
fn notes(report: &FormulasReport) -> Vec<String> {
    let mut notes = Vec::new();
    let screws = report
        .letters
        .iter()
        .filter(|l| l.meaning == Meaning::Screw);
    for screw in screws {
        notes.push(format!(
            "{} turns and slides at once: it stands as an angle in sines and cosines, and times its pitch in lengths.",
            screw.name
        ));
    }
    for left_out in &report.left_out {
        notes.push(format!(
            "Left out, as it is too long to be expanded: {left_out}."
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
