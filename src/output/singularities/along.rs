//! Singularities along a motion.

use super::{details, note, words};
use crate::analysis::singularities::AlongReport;
use crate::mechanism::Variable;
use crate::output::document::{Cell, Document, Section, cells};
use crate::output::report::{Remarks, Report, Rows};

impl Report for AlongReport {
    fn document(&self) -> Document {
        let crossings = self.crossings.iter().enumerate().map(|(i, crossing)| {
            let title = format!("{}. {}", i + 1, words::place(self, &crossing.moved));
            let text = words::crossing(crossing, self);
            let details = details(&crossing.singularity).into_iter();
            details.fold(Section::new(title).text(text), Section::section)
        });
        Document::new(&self.mechanism, words::ending(self))
            .yes_if(self.ending.is_whole())
            .remarks(Remarks::note(&note(&self.coupled)))
            .note(words::split(&self.inputs, &self.outputs))
            .notes(note(&self.coupled))
            .interrupted(self.interrupted, "singularities")
            .sections(crossings)
    }

    /// The singularities on the way, in SI units and rad.
    fn rows(&self) -> Option<Rows<'_>> {
        let own = ["number", "part", "type", "zlatanov", "fold", "branches"];
        let moved = self.moved.iter();
        let moved = moved.map(|of| Variable::new(&of.name, of.unit).to_string());
        let joints = self.variables.iter().map(Variable::to_string);
        let columns = own.map(str::to_owned).into_iter().chain(moved);
        let rows = self.crossings.iter().enumerate();
        let rows = rows.map(|(i, crossing)| {
            let singularity = &crossing.singularity;
            let zlatanov = singularity.zlatanov.iter();
            let zlatanov: Vec<&str> = zlatanov.map(|kind| words::letters(*kind)).collect();
            let mut row = cells![
                i + 1,
                crossing.part,
                singularity.gosselin_angeles.map(usize::from),
                zlatanov.join(" "),
                crossing.fold,
                crossing.branches,
            ];
            let values = crossing.moved.iter().chain(&crossing.joints);
            row.extend(values.map(|value| Cell::from(*value)));
            row
        });
        Some(Rows::new(columns.chain(joints), rows).once())
    }
}
