//! A motion as text, JSON, CSV and as pictures.

mod circuits;
#[cfg(feature = "plot")]
mod picture;
mod table;
mod words;

pub use circuits::{circuits_json, circuits_text};
#[cfg(feature = "plot")]
pub use picture::Picture;
pub use table::{Sampled, Table};
pub use words::{
    no_range, no_steps, not_one_freedom, nothing_left, nothing_moves, outside, point_complaint,
    sentence, what_moves,
};

use serde::Serialize;

use super::json::document;
use crate::analysis::sweep::{MotionReport, MotionsReport, SweepReport};
use crate::mechanism::Mechanism;
use crate::system::Variable;

/// One motion with its mode and the rows that are to be shown.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The number of the mode, if it was asked for.
    pub mode: Option<usize>,
    /// What it came to.
    pub report: SweepReport,
    /// The rows.
    pub rows: Sampled,
}

/// The report of motions, with the rows that are shown of them.
pub fn report(mechanism: &Mechanism, table: &Table, motions: &[Motion]) -> MotionsReport {
    let motions = motions.iter().map(|motion| MotionReport {
        mode: motion.mode,
        report: motion.report.clone(),
        columns: table.headings(),
        values: motion.rows.rows().to_vec(),
    });
    MotionsReport {
        mechanism: mechanism.name().into(),
        variables: mechanism.variables(),
        motions: motions.collect(),
    }
}

/// Motions as JSON: the fields of [`MotionsReport`] with a sentence for each motion.
pub fn json(report: &MotionsReport) -> String {
    #[derive(Serialize)]
    struct MotionJson<'a> {
        sentence: String,
        #[serde(flatten)]
        motion: &'a MotionReport,
    }
    #[derive(Serialize)]
    struct MotionsJson<'a> {
        variables: &'a [Variable],
        motions: Vec<MotionJson<'a>>,
    }
    let motions = report.motions.iter().map(|motion| MotionJson {
        sentence: sentence(&motion.report),
        motion,
    });
    let json = MotionsJson {
        variables: &report.variables,
        motions: motions.collect(),
    };
    document(&report.mechanism, &json)
}

/// Motions as text: the sentence, what was met, and some of the rows.
pub fn text(mechanism: &Mechanism, table: &Table, motions: &[Motion]) -> String {
    let mut text = format!("{}\n", mechanism.name());
    for (i, motion) in motions.iter().enumerate() {
        if i > 0 {
            text.push('\n');
        }
        if let Some(mode) = motion.mode {
            text += &format!("Mode {mode}: ");
        }
        text += &format!("{}\n", sentence(&motion.report));
        text += &words::work(&motion.report);
        text += &words::met(mechanism, &motion.report);
        text += &table.text(&motion.rows, motion.report.rows);
    }
    text
}
