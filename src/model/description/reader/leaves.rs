//! Values without fields of their own: texts, entries, conventions, transforms.

use super::*;
use crate::algebra::{Expression, ParseError};

impl FileReader {
    pub(super) fn text(&mut self, piece: RawValue, expected: Expected) -> Option<Spanned<String>> {
        let PieceShape::Text = piece.shape() else {
            self.wrong_type(piece, expected);
            return None;
        };
        let literal = self.split(piece, piece.text())?;
        Some(Spanned::new(literal.text.into_owned(), piece.span()))
    }

    pub(super) fn entry(&mut self, piece: RawValue) -> Option<Entry> {
        self.entry_of(piece, Expression::parse)
    }

    /// An entry over quantities.
    pub(super) fn quantity(&mut self, piece: RawValue) -> Option<Entry> {
        self.entry_of(piece, Expression::parse_quantity)
    }

    fn entry_of(
        &mut self,
        piece: RawValue,
        parse: fn(&str) -> Result<Expression, ParseError>,
    ) -> Option<Entry> {
        match piece.shape() {
            PieceShape::Number => match piece.number() {
                Ok(value) if value.is_finite() => return Some(Entry::number(value, piece.span())),
                Ok(_) => self.note(ProblemKind::NotFinite, piece.span()),
                Err(_) => self.wrong_type(piece, Expected::ENTRY),
            },
            PieceShape::Text => {
                let literal = self.split(piece, piece.text())?;
                match parse(&literal.text) {
                    Ok(expression) => {
                        let expression = expression.relocate(&|span| literal.place(span));
                        let span = piece.span();
                        return Some(Entry { expression, span });
                    }
                    Err(error) => {
                        let mut span = literal.place(error.span);
                        // Nothing can be underlined in an empty string but its quotes.
                        if literal.text.trim().is_empty() {
                            span = piece.span();
                        }
                        self.note(ProblemKind::Expression(error.kind), span);
                    }
                }
            }
            PieceShape::Word {
                word: "inf" | "inff32" | "inff64" | "NaN" | "NaNf32" | "NaNf64",
                content: None,
            } => self.note(ProblemKind::NotFinite, piece.span()),
            _ => self.wrong_type(piece, Expected::ENTRY),
        }
        None
    }

    pub(super) fn entries<const N: usize>(&mut self, pieces: [RawValue; N]) -> Option<[Entry; N]> {
        // All of them are read before one that is wrong puts an end to it.
        let entries = pieces.map(|piece| self.entry(piece)).into_iter().flatten();
        entries.collect::<Vec<_>>().try_into().ok()
    }

    pub(super) fn vector<const N: usize>(
        &mut self,
        piece: RawValue,
        expected: Expected,
    ) -> Option<[Entry; N]> {
        let vector = self.tuple(piece, expected)?;
        self.entries(vector)
    }

    /// One of the known words, with the parentheses after it.
    pub(super) fn word<'a, T: Copy>(
        &mut self,
        piece: RawValue<'a>,
        expected: Expected,
        known: &[T],
        written: fn(T) -> &'static str,
    ) -> Option<(T, Option<RawValue<'a>>)> {
        let PieceShape::Word { word, content } = piece.shape() else {
            self.wrong_type(piece, expected);
            return None;
        };
        let found = known.iter().find(|known| written(**known) == word);
        if found.is_none() {
            let known = known.iter().copied().map(written).collect();
            self.unknown_word(piece, expected, word, known);
        }
        Some((*found?, content))
    }

    /// One of the known words, without parentheses.
    pub(super) fn bare_word<T: Copy>(
        &mut self,
        piece: RawValue,
        expected: Expected,
        known: &[T],
        written: fn(T) -> &'static str,
    ) -> Option<T> {
        if let PieceShape::Word {
            content: Some(_), ..
        } = piece.shape()
        {
            self.wrong_type(piece, expected);
            return None;
        }
        Some(self.word(piece, expected, known, written)?.0)
    }

    pub(super) fn transform(&mut self, piece: RawValue) -> Vec<Displacement> {
        self.list(piece, Expected::TRANSFORM, |reader, step| {
            reader.displacement(step)
        })
    }

    pub(super) fn displacement(&mut self, piece: RawValue) -> Option<Displacement> {
        let words = &Displacement::<Entry>::WORDS;
        let expected = Expected::Said("a displacement such as `Tx(…)` or `Rz(…)`");
        let (word, content) = self.word(piece, expected, words, |word| word)?;
        let expected = Expected::DisplacementEntries(word);
        let entries = match word {
            "T" => Vec::from(self.content::<3>(piece, content, expected)?),
            _ => Vec::from(self.content::<1>(piece, content, expected)?),
        };
        // all are read before one that is wrong ends it
        let entries: Vec<_> = entries.into_iter().map(|entry| self.entry(entry)).collect();
        Displacement::of_word(word, entries.into_iter().collect::<Option<_>>()?)
    }
}
