//! Singularities along a motion.

use super::{details, note, words};
use crate::analysis::singularities::{AlongReport, Crossing};
use crate::output::document::{Document, Section, Table};
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
        let zlatanov = |(_, of): (usize, &Crossing)| {
            let kinds = of.singularity.zlatanov.iter();
            let letters: Vec<&str> = kinds.map(|kind| words::letters(*kind)).collect();
            letters.join(" ")
        };
        let table = Table::of((1..).zip(&self.crossings))
            .numbers("number", |(i, _)| i)
            .numbers("part", |(_, of)| of.part)
            .numbers("type", |(_, of)| {
                of.singularity.gosselin_angeles.map(usize::from)
            })
            .words("zlatanov", zlatanov)
            .words("fold", |(_, of)| of.fold)
            .words("branches", |(_, of)| of.branches)
            .values(&self.moved, |(_, of), k| of.moved[k])
            .values(&self.variables, |(_, of), k| of.joints[k]);
        Some(table.without_repeats().into())
    }
}
