//! Singularities along a motion.

use super::{Once, details, note, words};
use crate::analysis::singularities::AlongReport;
use crate::mechanism::Variable;
use crate::output::csv::{Record, Value};
use crate::output::document::{Document, Report, Section};

impl Report for AlongReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        let crossings = self.crossings.iter().enumerate().map(|(i, crossing)| {
            let title = format!("{}. {}", i + 1, words::place(self, &crossing.moved));
            let said = words::crossing(crossing, self);
            let details = details(&crossing.singularity).into_iter();
            details.fold(Section::new(title).text(said), Section::section)
        });
        Document::new(&self.mechanism, words::ending(self))
            .note(words::split(&self.inputs, &self.outputs))
            .notes(note(&self.coupled))
            .interrupted(self.interrupted, "singularities")
            .sections(crossings)
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        vec![("note", note(&self.coupled))]
    }
}

/// The singularities on the way as rows: the names of the columns, then the values in SI units and
/// rad.
pub fn along_rows(report: &AlongReport) -> (Vec<String>, impl Iterator<Item = Record<'static>>) {
    let own = ["number", "part", "type", "zlatanov", "fold", "branches"];
    let moved = report.moved.iter().map(|m| Variable::new(&m.name, m.unit));
    let moved: Vec<Variable> = moved.collect();
    let once = Once::new(&own, moved.iter().chain(&report.variables));
    let columns = once.columns.clone();
    let rows = report
        .crossings
        .iter()
        .enumerate()
        .map(move |(i, crossing)| {
            let kind = crossing.singularity.gosselin_angeles;
            let zlatanov = crossing.singularity.zlatanov.iter();
            let zlatanov: Vec<&str> = zlatanov.map(|kind| words::letters(*kind)).collect();
            let first = [
                Value::from(i + 1),
                Value::from(crossing.part),
                Value::from(kind.map(usize::from)),
                Value::from(zlatanov.join(" ")),
                Value::from(crossing.fold),
                Value::from(crossing.branches),
            ];
            let values = once.values(crossing.moved.iter().chain(&crossing.joints));
            first.into_iter().chain(values).collect()
        });
    let rows: Vec<Record> = rows.collect();
    (columns, rows.into_iter())
}
