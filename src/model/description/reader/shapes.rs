//! Structures, maps, lists and tuples of whatever the reader asks for.

use std::collections::HashMap;
use std::ops::Range;

use super::*;

/// The fields of a structure that are not taken yet.
pub(super) struct Fields<'a> {
    pub structure: FieldGroup,
    pub span: Range<usize>,
    pieces: Vec<(&'a str, RawValue<'a>)>,
    /// Fields that are there under a misspelt name: they must not be called missing too.
    misspelt: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    pub(super) fn take(&mut self, field: &str) -> Option<RawValue<'a>> {
        let place = self.pieces.iter().position(|(name, _)| *name == field)?;
        Some(self.pieces.swap_remove(place).1)
    }

    /// True if one of some fields is there, rightly spelt or not.
    pub(super) fn gives(&self, fields: &[&str]) -> bool {
        let there = |field| self.pieces.iter().any(|(name, _)| name == field);
        fields
            .iter()
            .any(|field| there(field) || self.misspelt.contains(field))
    }

    /// Place to underline where something is missing: the first byte only, as all of a structure would be too much.
    pub(super) fn head(&self) -> Range<usize> {
        self.span.start..self.span.start + 1
    }
}

impl FileReader {
    /// The contents of the parentheses after a word.
    pub(super) fn content<'a, const N: usize>(
        &mut self,
        whole: RawValue,
        content: Option<RawValue<'a>>,
        expected: Expected,
    ) -> Option<[RawValue<'a>; N]> {
        match content {
            Some(content) => self.tuple(content, expected),
            None => self.wrong_length(whole, expected, N, 0),
        }
    }

    /// Notes that a piece is made of too few or too many parts.
    pub(super) fn wrong_length<T>(
        &mut self,
        piece: RawValue,
        of: Expected,
        expected: usize,
        found: usize,
    ) -> Option<T> {
        let kind = ProblemKind::WrongLength {
            of,
            expected,
            found,
        };
        self.note(kind, piece.span());
        None
    }

    /// Named fields in parentheses, with or without the name of the structure before them.
    pub(super) fn fields<'a>(
        &mut self,
        piece: RawValue<'a>,
        structure: FieldGroup,
    ) -> Option<Fields<'a>> {
        let expected = Expected::Fields(structure);
        let content = match piece.shape() {
            PieceShape::Word { word, content } if word == structure.word => content,
            PieceShape::Word { word, .. } => {
                self.unknown_word(piece, expected, word, vec![structure.word]);
                return None;
            }
            _ => Some(piece),
        };
        let mut fields = Fields {
            structure,
            span: piece.span(),
            pieces: Vec::new(),
            misspelt: Vec::new(),
        };
        let Some(content) = content else {
            return Some(fields);
        };
        let found = match content.shape() {
            PieceShape::Fields => content.fields(),
            PieceShape::Tuple if content.elements().is_empty() => Vec::new(),
            _ => {
                self.wrong_type(content, expected);
                return None;
            }
        };
        let mut first: HashMap<&str, Range<usize>> = HashMap::new();
        for (name, value) in found {
            if let Some(first) = first.get(name.value) {
                let field = name.value.to_owned();
                let problem = ProblemKind::DuplicateField { field }.at(name.span);
                let note = Note::FirstHere(Noun::Field);
                self.problems.push(problem.with(first.clone(), note));
                continue;
            }
            first.insert(name.value, name.span.clone());
            if structure.fields().any(|known| known == name.value) {
                fields.pieces.push((name.value, value));
            } else {
                let meant = nearest(name.value, structure.fields());
                fields.misspelt.extend(meant);
                let kind = ProblemKind::UnknownField {
                    structure,
                    field: name.value.to_owned(),
                    suggestion: meant.map(str::to_owned),
                };
                self.note(kind, name.span);
            }
        }
        Some(fields)
    }

    pub(super) fn require<'a>(
        &mut self,
        fields: &mut Fields<'a>,
        field: &'static str,
    ) -> Option<RawValue<'a>> {
        let piece = fields.take(field);
        if piece.is_none() && !fields.misspelt.contains(&field) {
            let kind = ProblemKind::MissingField {
                structure: fields.structure,
                field,
            };
            self.note(kind, fields.head());
        }
        piece
    }

    /// The value of a field.
    pub(super) fn field<T: FileField>(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        expected: Expected,
    ) -> T {
        let piece = match T::REQUIRED {
            true => self.require(fields, name),
            false => fields.take(name),
        };
        let value = piece.and_then(|piece| T::read(self, piece, expected));
        value.unwrap_or_else(T::absent)
    }

    /// A map from names to things.
    pub(super) fn map<'a, T>(
        &mut self,
        piece: RawValue<'a>,
        noun: Noun,
        read: impl Fn(&mut Self, RawValue<'a>) -> Option<T>,
    ) -> Vec<Named<T>> {
        let PieceShape::Map = piece.shape() else {
            self.wrong_type(piece, Expected::MapOf(noun));
            return Vec::new();
        };
        let mut first: HashMap<String, Range<usize>> = HashMap::new();
        let mut named = Vec::new();
        for (key, value) in piece.pairs() {
            let name = self.text(key, Expected::NameOf(noun));
            // a value is read even if its name is wrong, to find its problems too
            let before = self.problems.len();
            let value = read(self, value);
            let Some(name) = name else { continue };
            if self.problems.len() > before {
                self.broken.insert(name.value.clone());
            }
            if let Some(first) = first.get(&name.value) {
                let problem = ProblemKind::DuplicateName {
                    noun,
                    name: name.value,
                }
                .at(name.span);
                self.problems
                    .push(problem.with(first.clone(), Note::FirstHere(noun)));
                continue;
            }
            first.insert(name.value.clone(), name.span.clone());
            named.extend(value.map(|value| Named { name, value }));
        }
        named
    }

    pub(super) fn list<'a, T>(
        &mut self,
        piece: RawValue<'a>,
        expected: Expected,
        read: impl Fn(&mut Self, RawValue<'a>) -> Option<T>,
    ) -> Vec<T> {
        let PieceShape::List = piece.shape() else {
            self.wrong_type(piece, expected);
            return Vec::new();
        };
        let elements = piece.elements().into_iter();
        elements.filter_map(|element| read(self, element)).collect()
    }

    pub(super) fn tuple<'a, const N: usize>(
        &mut self,
        piece: RawValue<'a>,
        of: Expected,
    ) -> Option<[RawValue<'a>; N]> {
        let PieceShape::Tuple = piece.shape() else {
            self.wrong_type(piece, of);
            return None;
        };
        let elements = piece.elements();
        let found = elements.len();
        match elements.try_into() {
            Ok(tuple) => Some(tuple),
            Err(_) => self.wrong_length(piece, of, N, found),
        }
    }

    pub(super) fn wrong_type(&mut self, piece: RawValue, expected: Expected) {
        let found = piece.found();
        self.note(ProblemKind::WrongType { expected, found }, piece.span());
    }

    pub(super) fn unknown_word(
        &mut self,
        piece: RawValue,
        expected: Expected,
        word: &str,
        known: Vec<&'static str>,
    ) {
        let suggestion = nearest(word, known.iter().copied()).map(str::to_owned);
        let start = piece.span().start;
        let kind = ProblemKind::UnknownWord {
            expected,
            word: word.to_owned(),
            suggestion,
            known,
        };
        self.note(kind, start..start + word.len());
    }

    /// Notes what `ron` refuses in a piece that it had let pass before.
    pub(super) fn split<T>(&mut self, piece: RawValue, result: Result<T, ron::Error>) -> Option<T> {
        let refused = |error| {
            let (error, found) = (Box::new(error), None);
            self.note(ProblemKind::Syntax { error, found }, piece.span());
        };
        result.map_err(refused).ok()
    }
}
