//! Text → description, noting every problem on the way.
//!
//! Where something is wrong the reader notes it, puts something harmless in its place and goes on.

mod closed_form;
mod leaves;

use std::collections::HashMap;
use std::ops::Range;

use ron::Error;
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::brackets::unclosed;
use super::piece::{Piece, Shape};
use super::*;

/// The description as far as it could be read, and what is wrong with the text.
pub(super) fn read(text: &str) -> (Option<Description>, Vec<Problem>) {
    if text.len() as u64 > MAX_BYTES {
        return (
            None,
            vec![ProblemKind::TooLarge { bytes: text.len() }.at(0..0)],
        );
    }
    // Some editors begin a file with a byte order mark.
    let start = if text.starts_with('\u{feff}') {
        '\u{feff}'.len_utf8()
    } else {
        0
    };
    let mut reader = Reader {
        problems: Vec::new(),
    };
    let description = match check_syntax(text, start) {
        Ok(begin) => reader.mechanism(Piece::new(&text[begin..], begin)),
        Err(problem) => {
            reader.problems.push(problem);
            None
        }
    };
    (description, reader.problems)
}

/// Where the value begins, if the text from `start` on is one RON value.
fn check_syntax(text: &str, start: usize) -> Result<usize, Problem> {
    let body = &text[start..];
    let result = ron::Deserializer::from_str(body).and_then(|mut deserializer| {
        let begin = text.len() - deserializer.remainder().len();
        let read = IgnoredAny::deserialize(&mut deserializer).and_then(|_| deserializer.end());
        read.map_err(|error| deserializer.span_error(error))?;
        Ok(begin)
    });
    result.map_err(|error| {
        if body.trim().is_empty() {
            return ProblemKind::Empty.at(0..text.len());
        }
        let end = error.span.end;
        let offset = start + Lines::new(body).offset(end.line, end.col);
        syntax_problem(text, offset, error.code)
    })
}

fn syntax_problem(text: &str, offset: usize, error: Error) -> Problem {
    let after_end = text.trim_end().len();
    let width = text[offset..].chars().next().map_or(0, char::len_utf8);
    let mut span = offset..offset + width;
    if offset >= after_end {
        span = after_end..after_end;
    }
    if error == Error::ExceededRecursionLimit {
        return ProblemKind::TooDeep.at(span);
    }
    let problem = ProblemKind::Syntax(error).at(span);
    match unclosed(text) {
        Some(bracket)
            if bracket.missed_at >= offset.min(after_end) && bracket.open.start < offset =>
        {
            problem.with(bracket.open, Note::StillOpen)
        }
        _ => problem,
    }
}

struct Reader {
    problems: Vec<Problem>,
}

/// The fields of a structure that are not taken yet.
struct Fields<'a> {
    structure: Structure,
    span: Range<usize>,
    pieces: HashMap<&'a str, Piece<'a>>,
    /// Fields that are there under a misspelt name: they must not be called missing too.
    misspelt: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    fn take(&mut self, field: &str) -> Option<Piece<'a>> {
        self.pieces.remove(field)
    }

    /// Whether one of some fields is there, rightly spelt or not.
    fn gives(&self, fields: &[&str]) -> bool {
        fields
            .iter()
            .any(|field| self.pieces.contains_key(field) || self.misspelt.contains(field))
    }

    /// Where to point at something that is missing: all of a structure would be too much to underline.
    fn head(&self) -> Range<usize> {
        self.span.start..self.span.start + 1
    }
}

impl Reader {
    fn mechanism(&mut self, piece: Piece) -> Option<Description> {
        let mut fields = self.fields(piece, Structure::Mechanism)?;
        if let Some(version) = self.require(&mut fields, "version") {
            let count = self.problems.len();
            self.version(version);
            // A later format may differ in anything; all else would be noise.
            if let Some(Problem {
                kind: ProblemKind::LaterVersion(_),
                ..
            }) = self.problems.get(count)
            {
                self.problems.drain(..count);
                return None;
            }
        }
        let name = self
            .require(&mut fields, "name")
            .and_then(|piece| self.text(piece, Expected::Text));
        Some(Description {
            name: name.unwrap_or_else(|| Spanned::new(String::new(), 0..0)),
            source: self.optional_text(&mut fields, "source", Expected::Text),
            convention: fields
                .take("convention")
                .and_then(|piece| self.convention(piece)),
            parameters: self.named(&mut fields, "parameters", Noun::Parameter, Self::entry),
            joints: self.named(&mut fields, "joints", Noun::Joint, Self::joint),
            chains: self.named(&mut fields, "chains", Noun::Chain, Self::chain),
            platforms: self.named(&mut fields, "platforms", Noun::Platform, Self::platform),
            closures: self.named(&mut fields, "closures", Noun::Closure, Self::closure),
            closed_forms: self.named(
                &mut fields,
                "closed_forms",
                Noun::ClosedForm,
                Self::closed_form,
            ),
        })
    }

    fn version(&mut self, piece: Piece) {
        let Shape::Number = piece.shape() else {
            return self.wrong_type(piece, Expected::Version);
        };
        match piece.number() {
            Ok(number) if number == f64::from(VERSION) => {}
            Ok(number) if number > f64::from(VERSION) && number.fract() == 0.0 => {
                self.problems
                    .push(ProblemKind::LaterVersion(number).at(piece.span()));
            }
            Ok(number) => self
                .problems
                .push(ProblemKind::NotAVersion(number).at(piece.span())),
            Err(_) => self.wrong_type(piece, Expected::Version),
        }
    }

    fn joint(&mut self, piece: Piece) -> Option<JointDescription> {
        let Shape::Word { word, .. } = piece.shape() else {
            self.wrong_type(piece, Expected::Joint);
            return None;
        };
        let (role, structure) = match word {
            "Passive" => (Role::Passive, Structure::Passive),
            "Actuated" => (Role::Actuated, Structure::Actuated),
            _ => {
                self.unknown_word(piece, Expected::Joint, word, vec!["Passive", "Actuated"]);
                return None;
            }
        };
        let mut fields = self.fields(piece, structure)?;
        Some(JointDescription {
            role,
            home: self.entry_or_zero(&mut fields, "home"),
            limits: fields.take("limits").and_then(|piece| {
                let [low, high] = self.tuple(piece, Expected::Limits)?;
                Some((self.entry(low)?, self.entry(high)?))
            }),
            span: fields.span,
        })
    }

    fn chain(&mut self, piece: Piece) -> Option<ChainDescription> {
        let mut fields = self.fields(piece, Structure::Chain)?;
        Some(ChainDescription {
            on: self.optional_text(&mut fields, "on", Expected::Frame),
            convention: fields
                .take("convention")
                .and_then(|piece| self.convention(piece)),
            base: self.transform_field(&mut fields, "base"),
            rows: match fields.take("rows") {
                Some(rows) => self.list(rows, Expected::Rows, Self::row),
                None => Vec::new(),
            },
            tip: self.transform_field(&mut fields, "tip"),
        })
    }

    fn row(&mut self, piece: Piece) -> Option<Row> {
        let mut fields = self.fields(piece, Structure::Row)?;
        Some(Row {
            alpha: self.entry_or_zero(&mut fields, "alpha"),
            a: self.entry_or_zero(&mut fields, "a"),
            d: self.entry_or_zero(&mut fields, "d"),
            theta: self.entry_or_zero(&mut fields, "theta"),
            span: fields.span,
        })
    }

    fn platform(&mut self, piece: Piece) -> Option<PlatformDescription> {
        let mut fields = self.fields(piece, Structure::Platform)?;
        Some(PlatformDescription {
            home: self.transform_field(&mut fields, "home"),
            frames: self.named(
                &mut fields,
                "frames",
                Noun::PlatformFrame,
                |reader, piece| Some(reader.transform(piece)),
            ),
        })
    }

    fn closure(&mut self, piece: Piece) -> Option<ClosureDescription> {
        let Shape::Word { word, content } = piece.shape() else {
            self.wrong_type(piece, Expected::Closure);
            return None;
        };
        let Some(kind) = ClosureKind::ALL
            .into_iter()
            .find(|kind| kind.word() == word)
        else {
            let known = ClosureKind::ALL
                .into_iter()
                .map(ClosureKind::word)
                .collect();
            self.unknown_word(piece, Expected::Closure, word, known);
            return None;
        };
        let expected = Expected::ClosureFrames(kind.word());
        let (frames, length) = match kind {
            ClosureKind::Distance => {
                let [from, to, length] = self.content(piece, content, expected)?;
                ([from, to], Some(length))
            }
            _ => (self.content(piece, content, expected)?, None),
        };
        let [from, to] = frames.map(|frame| self.text(frame, Expected::Frame));
        let length = length.map(|length| self.entry(length));
        Some(ClosureDescription {
            kind,
            frames: [from?, to?],
            length: match length {
                Some(length) => Some(length?),
                None => None,
            },
            span: piece.span(),
        })
    }

    /// What stands in the parentheses behind a word.
    fn content<'a, const N: usize>(
        &mut self,
        whole: Piece,
        content: Option<Piece<'a>>,
        expected: Expected,
    ) -> Option<[Piece<'a>; N]> {
        match content {
            Some(content) => self.tuple(content, expected),
            None => {
                self.problems.push(
                    ProblemKind::WrongLength {
                        of: expected,
                        expected: N,
                        found: 0,
                    }
                    .at(whole.span()),
                );
                None
            }
        }
    }

    /// Named fields in parentheses, with or without the name of the structure before them.
    fn fields<'a>(&mut self, piece: Piece<'a>, structure: Structure) -> Option<Fields<'a>> {
        let expected = Expected::Fields(structure);
        let content = match piece.shape() {
            Shape::Word { word, content } if word == structure.word() => content,
            Shape::Word { word, .. } => {
                self.unknown_word(piece, expected, word, vec![structure.word()]);
                return None;
            }
            _ => Some(piece),
        };
        let mut fields = Fields {
            structure,
            span: piece.span(),
            pieces: HashMap::new(),
            misspelt: Vec::new(),
        };
        let Some(content) = content else {
            return Some(fields);
        };
        let found = match content.shape() {
            Shape::Fields => content.fields(),
            Shape::Tuple if content.elements().is_ok_and(|elements| elements.is_empty()) => {
                Ok(Vec::new())
            }
            _ => {
                self.wrong_type(content, expected);
                return None;
            }
        };
        let mut first: HashMap<&str, Range<usize>> = HashMap::new();
        for (name, value) in self.split(content, found)? {
            if let Some(first) = first.get(name.value) {
                let problem = ProblemKind::DuplicateField {
                    field: name.value.to_owned(),
                }
                .at(name.span);
                self.problems
                    .push(problem.with(first.clone(), Note::FirstHere(Noun::Field)));
                continue;
            }
            first.insert(name.value, name.span.clone());
            if structure.fields().contains(&name.value) {
                fields.pieces.insert(name.value, value);
            } else {
                let field = name.value.to_owned();
                let meant = nearest(&field, structure.fields().iter().copied());
                fields.misspelt.extend(meant);
                let suggestion = meant.map(str::to_owned);
                self.problems.push(
                    ProblemKind::UnknownField {
                        structure,
                        field,
                        suggestion,
                    }
                    .at(name.span),
                );
            }
        }
        Some(fields)
    }

    fn require<'a>(&mut self, fields: &mut Fields<'a>, field: &'static str) -> Option<Piece<'a>> {
        let piece = fields.take(field);
        if piece.is_none() && !fields.misspelt.contains(&field) {
            let kind = ProblemKind::MissingField {
                structure: fields.structure,
                field,
            };
            self.problems.push(kind.at(fields.head()));
        }
        piece
    }

    /// A map from names to things, in the order of the file.
    fn named<'a, T>(
        &mut self,
        fields: &mut Fields<'a>,
        field: &str,
        noun: Noun,
        read: impl Fn(&mut Self, Piece<'a>) -> Option<T>,
    ) -> Vec<Named<T>> {
        let Some(piece) = fields.take(field) else {
            return Vec::new();
        };
        let Shape::Map = piece.shape() else {
            self.wrong_type(piece, Expected::MapOf(noun));
            return Vec::new();
        };
        let mut first: HashMap<String, Range<usize>> = HashMap::new();
        let mut named = Vec::new();
        for (key, value) in self.split(piece, piece.pairs()).unwrap_or_default() {
            let name = self.text(key, Expected::NameOf(noun));
            // What a name stands for is read even if the name is wrong, to find what else is.
            let value = read(self, value);
            let Some(name) = name else { continue };
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

    fn list<'a, T>(
        &mut self,
        piece: Piece<'a>,
        expected: Expected,
        read: impl Fn(&mut Self, Piece<'a>) -> Option<T>,
    ) -> Vec<T> {
        let Shape::List = piece.shape() else {
            self.wrong_type(piece, expected);
            return Vec::new();
        };
        let elements = self.split(piece, piece.elements()).unwrap_or_default();
        elements
            .into_iter()
            .filter_map(|element| read(self, element))
            .collect()
    }

    fn tuple<'a, const N: usize>(
        &mut self,
        piece: Piece<'a>,
        of: Expected,
    ) -> Option<[Piece<'a>; N]> {
        let Shape::Tuple = piece.shape() else {
            self.wrong_type(piece, of);
            return None;
        };
        let elements = self.split(piece, piece.elements())?;
        let found = elements.len();
        let tuple = elements.try_into().ok();
        if tuple.is_none() {
            self.problems.push(
                ProblemKind::WrongLength {
                    of,
                    expected: N,
                    found,
                }
                .at(piece.span()),
            );
        }
        tuple
    }

    fn wrong_type(&mut self, piece: Piece, expected: Expected) {
        self.problems.push(
            ProblemKind::WrongType {
                expected,
                found: piece.found(),
            }
            .at(piece.span()),
        );
    }

    fn unknown_word(
        &mut self,
        piece: Piece,
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
        self.problems.push(kind.at(start..start + word.len()));
    }

    /// Notes what `ron` refuses in a piece that it had let pass before.
    fn split<T>(&mut self, piece: Piece, result: Result<T, Error>) -> Option<T> {
        result
            .map_err(|error| {
                self.problems
                    .push(ProblemKind::Syntax(error).at(piece.span()))
            })
            .ok()
    }
}
