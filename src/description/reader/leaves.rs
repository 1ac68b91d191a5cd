//! What has no fields of its own: texts, entries, conventions, transforms.

use super::*;
use crate::algebra::Expression;

impl Reader {
    pub(super) fn text(&mut self, piece: Piece, expected: Expected) -> Option<Spanned<String>> {
        let Shape::Text = piece.shape() else {
            self.wrong_type(piece, expected);
            return None;
        };
        let literal = self.split(piece, piece.text())?;
        Some(Spanned::new(literal.text.into_owned(), piece.span()))
    }

    pub(super) fn optional_text(
        &mut self,
        fields: &mut Fields,
        field: &str,
        expected: Expected,
    ) -> Option<Spanned<String>> {
        fields
            .take(field)
            .and_then(|piece| self.text(piece, expected))
    }

    pub(super) fn entry(&mut self, piece: Piece) -> Option<Entry> {
        match piece.shape() {
            Shape::Number => match piece.number() {
                Ok(value) if value.is_finite() => return Some(Entry::number(value, piece.span())),
                Ok(_) => self.problems.push(ProblemKind::NotFinite.at(piece.span())),
                Err(_) => self.wrong_type(piece, Expected::Entry),
            },
            Shape::Text => {
                let literal = self.split(piece, piece.text())?;
                match Expression::parse(&literal.text) {
                    Ok(expression) => {
                        let expression = expression.relocate(&|span| literal.place(span));
                        return Some(Entry {
                            expression,
                            span: piece.span(),
                        });
                    }
                    Err(error) => {
                        let mut span = literal.place(error.span);
                        // Nothing can be underlined in an empty string but its quotes.
                        if literal.text.trim().is_empty() {
                            span = piece.span();
                        }
                        self.problems
                            .push(ProblemKind::Expression(error.kind).at(span));
                    }
                }
            }
            Shape::Word {
                word: "inf" | "inff32" | "inff64" | "NaN" | "NaNf32" | "NaNf64",
                content: None,
            } => {
                self.problems.push(ProblemKind::NotFinite.at(piece.span()));
            }
            _ => self.wrong_type(piece, Expected::Entry),
        }
        None
    }

    pub(super) fn entry_or_zero(&mut self, fields: &mut Fields, field: &str) -> Entry {
        fields
            .take(field)
            .and_then(|piece| self.entry(piece))
            .unwrap_or_else(Entry::absent)
    }

    pub(super) fn entries<const N: usize>(&mut self, pieces: [Piece; N]) -> Option<[Entry; N]> {
        // All of them are read before one that is wrong puts an end to it.
        let entries: Vec<Entry> = pieces
            .map(|piece| self.entry(piece))
            .into_iter()
            .flatten()
            .collect();
        entries.try_into().ok()
    }

    pub(super) fn convention(&mut self, piece: Piece) -> Option<Spanned<Convention>> {
        let Shape::Word {
            word,
            content: None,
        } = piece.shape()
        else {
            self.wrong_type(piece, Expected::Convention);
            return None;
        };
        let convention = Convention::ALL
            .into_iter()
            .find(|convention| convention.word() == word);
        if convention.is_none() {
            let known = Convention::ALL.into_iter().map(Convention::word).collect();
            self.unknown_word(piece, Expected::Convention, word, known);
        }
        convention.map(|convention| Spanned::new(convention, piece.span()))
    }

    pub(super) fn transform_field(
        &mut self,
        fields: &mut Fields,
        field: &str,
    ) -> Vec<Displacement> {
        fields
            .take(field)
            .map_or_else(Vec::new, |piece| self.transform(piece))
    }

    pub(super) fn transform(&mut self, piece: Piece) -> Vec<Displacement> {
        self.list(piece, Expected::Transform, Self::displacement)
    }

    fn displacement(&mut self, piece: Piece) -> Option<Displacement> {
        let Shape::Word { word, content } = piece.shape() else {
            self.wrong_type(piece, Expected::Displacement);
            return None;
        };
        const KNOWN: [&str; 7] = ["Tx", "Ty", "Tz", "Rx", "Ry", "Rz", "T"];
        let Some(known) = KNOWN.into_iter().find(|known| *known == word) else {
            self.unknown_word(piece, Expected::Displacement, word, KNOWN.to_vec());
            return None;
        };
        let expected = Expected::DisplacementEntries(known);
        if known == "T" {
            let pieces = self.content(piece, content, expected)?;
            return self.entries(pieces).map(Displacement::TranslateBy);
        }
        let [entry] = self.content(piece, content, expected)?;
        let entry = self.entry(entry)?;
        let axis = match &known[1..] {
            "x" => Axis::X,
            "y" => Axis::Y,
            _ => Axis::Z,
        };
        Some(match known.starts_with('T') {
            true => Displacement::Translate(axis, entry),
            false => Displacement::Rotate(axis, entry),
        })
    }
}
