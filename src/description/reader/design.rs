//! Design files.

use super::*;
use crate::description::{DesignDescription, DesignGoal, DesignProblem};

impl DesignDescription {
    /// Reads the text of a design file, or returns all its problems of form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, FileReader { mut problems, .. }) = read_with(text, FileReader::design);
        sort_by_key(&mut problems, |problem| {
            (problem.span.start, problem.span.end)
        });
        match description {
            Some(description) if problems.is_empty() => Ok(description),
            _ => Err(problems),
        }
    }
}

/// The order in which positions are passed.
#[derive(Clone, Copy)]
enum ReadOrder {
    Kept,
    Any,
}

impl FileReader {
    fn design(&mut self, piece: Piece) -> Option<DesignDescription> {
        let mut fields = self.fields(piece, FieldGroup::Design)?;
        if !self.known_version(&mut fields) {
            return None;
        }
        let f = &mut fields;
        let range = |reader: &mut Self, piece: Piece| reader.vector(piece, Expected::Range);
        Some(DesignDescription {
            name: self
                .optional_text(f, "name", Expected::Text)
                .unwrap_or_default(),
            mechanism: self.required_text(f, "mechanism"),
            vary: self.named(f, "vary", Noun::Varied, range),
            positions: f.take("positions").map_or_else(Vec::new, |piece| {
                self.list(piece, Expected::Positions, Self::position)
            }),
            contains: self.named(f, "contains", Noun::Target, range),
            motion: self.named(f, "motion", Noun::Varied, range),
            at_least: self.named(f, "at_least", Noun::Output, Self::entry),
            at_most: self.named(f, "at_most", Noun::Output, Self::entry),
            outputs: f.take("outputs").map_or_else(Vec::new, |piece| {
                self.list(piece, Expected::Outputs, |reader, piece| {
                    reader.text(piece, Expected::Text)
                })
            }),
            goal: self.design_goal(f),
            any_order: f.take("order").is_some_and(|piece| {
                let known = [ReadOrder::Kept, ReadOrder::Any];
                let word = |order| match order {
                    ReadOrder::Kept => "Kept",
                    ReadOrder::Any => "Any",
                };
                let found = self.bare_word(piece, Expected::Order, &known, word);
                matches!(found, Some(ReadOrder::Any))
            }),
        })
    }

    fn design_goal(&mut self, fields: &mut Fields) -> Option<DesignGoal> {
        let small = self.optional_text(fields, "minimise", Expected::Text);
        let great = self.optional_text(fields, "maximise", Expected::Text);
        if let (Some(_), Some(second)) = (&small, &great) {
            let problem = ProblemKind::Design(Box::new(DesignProblem::TwoGoals));
            self.problems.push(problem.at(second.span.clone()));
        }
        let greatest = small.is_none();
        small
            .or(great)
            .map(|figure| DesignGoal { figure, greatest })
    }

    fn position(&mut self, piece: Piece) -> Option<Vec<Named<Vec<Entry>>>> {
        Some(self.map(piece, Noun::Target, |reader, piece| {
            if !matches!(piece.shape(), PieceShape::Tuple) {
                return Some(vec![reader.entry(piece)?]);
            }
            let elements = piece.elements();
            match elements.len() {
                2 | 3 => elements.into_iter().map(|of| reader.entry(of)).collect(),
                found => reader.wrong_length(piece, Expected::Coordinates, 2, found),
            }
        }))
    }
}
