//! Design files.

use super::*;
use crate::description::expectation::form;
use crate::description::{DesignDescription, DesignGoal, Varied};

impl DesignDescription {
    pub(super) const GROUP: FieldGroup = FieldGroup {
        word: "Design",
        form: form!(
            "a design",
            &[
                "version",
                "name",
                "mechanism",
                "vary",
                "positions",
                "contains",
                "motion"
            ],
            &[
                "weights",
                "tolerances",
                "at_least",
                "at_most",
                "minimise",
                "maximise",
                "outputs",
                "order"
            ]
        ),
    };

    /// Reads the text of a design file, or returns all its problems of form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, FileReader { mut problems, .. }) = read_with(text, |reader, piece| {
            reader.file(piece, Self::GROUP, FileReader::design)
        });
        sort_by_key(&mut problems, |problem| {
            (problem.span.start, problem.span.end)
        });
        match description {
            Some(description) if problems.is_empty() => Ok(description),
            _ => Err(problems),
        }
    }
}

impl FileReader {
    fn design(&mut self, f: &mut Fields) -> DesignDescription {
        let name: Option<Spanned<String>> = self.field(f, "name", Expected::TEXT);
        DesignDescription {
            name: name.unwrap_or_default(),
            mechanism: self.field(f, "mechanism", Expected::TEXT),
            vary: self.named(f, "vary", Noun::Varied, Self::varied),
            positions: f.take("positions").map_or_else(Vec::new, |piece| {
                let expected = Expected::Said("a list of positions `{…}`");
                self.list(piece, expected, Self::position)
            }),
            weights: self.named(f, "weights", Noun::Target, Self::each),
            tolerances: self.named(f, "tolerances", Noun::Target, Self::each),
            contains: self.named(f, "contains", Noun::Target, |reader, piece| {
                reader.vector(piece, Expected::RANGE)
            }),
            motion: self.named(f, "motion", Noun::Input, |reader, piece| {
                reader.vector(piece, Expected::RANGE)
            }),
            at_least: self.named(f, "at_least", Noun::Output, Self::entry),
            at_most: self.named(f, "at_most", Noun::Output, Self::entry),
            outputs: f.take("outputs").map_or_else(Vec::new, |piece| {
                let expected =
                    Expected::Said("a list of outputs, such as `[\"arm.x\", \"arm.y\"]`");
                self.list(piece, expected, |reader, piece| {
                    reader.text(piece, Expected::TEXT)
                })
            }),
            goals: [
                self.goals(f, "minimise", false),
                self.goals(f, "maximise", true),
            ]
            .concat(),
            any_order: f.take("order").is_some_and(|piece| {
                let expected = Expected::Said("`Kept` or `Any`");
                self.bare_word(piece, expected, &["Kept", "Any"], |word| word) == Some("Any")
            }),
        }
    }

    fn named<'a, T>(
        &mut self,
        fields: &mut Fields<'a>,
        field: &str,
        noun: Noun,
        read: impl Fn(&mut Self, RawValue<'a>) -> Option<T>,
    ) -> Vec<Named<T>> {
        let piece = fields.take(field);
        piece.map_or_else(Vec::new, |piece| self.map(piece, noun, read))
    }

    /// One figure, or a list of them.
    fn goals(&mut self, fields: &mut Fields, field: &str, greatest: bool) -> Vec<DesignGoal> {
        let pieces = fields
            .take(field)
            .map_or_else(Vec::new, |piece| match piece.shape() {
                PieceShape::List => piece.elements(),
                _ => vec![piece],
            });
        let figures = pieces.into_iter();
        let figures = figures.filter_map(|piece| self.text(piece, Expected::TEXT));
        figures
            .map(|figure| DesignGoal { figure, greatest })
            .collect()
    }

    /// A range, a list of values, or an expression.
    fn varied(&mut self, piece: RawValue) -> Option<Varied> {
        Some(match piece.shape() {
            PieceShape::Tuple => Varied::Range(self.vector(piece, Expected::RANGE)?),
            PieceShape::List if piece.elements().is_empty() => {
                self.wrong_type(piece, Expected::Said("at least one value"));
                return None;
            }
            PieceShape::List => Varied::OneOf(self.list(piece, Expected::ENTRY, Self::entry)),
            _ => Varied::Equal(self.entry(piece)?),
        })
    }

    /// One entry, or a list of them.
    fn each(&mut self, piece: RawValue) -> Option<Vec<Entry>> {
        match piece.shape() {
            PieceShape::List => Some(self.list(piece, Expected::ENTRY, Self::entry)),
            _ => Some(vec![self.entry(piece)?]),
        }
    }

    fn position(&mut self, piece: RawValue) -> Option<Vec<Named<Vec<Entry>>>> {
        Some(self.map(piece, Noun::Target, |reader, piece| {
            if !matches!(piece.shape(), PieceShape::Tuple) {
                return Some(vec![reader.entry(piece)?]);
            }
            let elements = piece.elements();
            match elements.len() {
                2 | 3 => elements.into_iter().map(|of| reader.entry(of)).collect(),
                found => {
                    let expected = Expected::Said("coordinates `(x, y)` or `(x, y, z)`");
                    reader.wrong_length(piece, expected, 2, found)
                }
            }
        }))
    }
}
