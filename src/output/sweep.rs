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
use crate::analysis::sweep::SweepReport;
use crate::mechanism::Mechanism;

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

/// Motions as JSON: the fields of [`SweepReport`] with a sentence, columns and rows.
pub fn json(mechanism: &Mechanism, table: &Table, motions: &[Motion]) -> String {
    #[derive(Serialize)]
    struct MotionJson<'a> {
        mode: Option<usize>,
        sentence: String,
        #[serde(flatten)]
        report: &'a SweepReport,
        columns: Vec<String>,
        values: &'a [Vec<Option<f64>>],
    }
    #[derive(Serialize)]
    struct MotionsJson<'a> {
        motions: Vec<MotionJson<'a>>,
    }
    let motions = motions.iter().map(|motion| MotionJson {
        mode: motion.mode,
        sentence: sentence(&motion.report),
        report: &motion.report,
        columns: table.columns(),
        values: motion.rows.rows(),
    });
    let motions = motions.collect();
    document(mechanism.name(), &MotionsJson { motions })
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
