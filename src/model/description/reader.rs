//! Text → description, noting every problem on the way.
//!
//! The reader notes each problem, substitutes a harmless value and continues.

mod axes;
mod closed_form;
mod design;
mod leaves;
mod loads;
mod shapes;
mod syntax;
mod values;

use std::collections::HashSet;
use std::ops::Range;

use super::expectation::GroupForm;
use super::piece::{PieceShape, RawValue};
use super::*;
use crate::number::sorting::sort_by_key;
use shapes::Fields;
use values::{FileField, FileItem};

/// The description as far as it could be read, the problems, and the names affected by them. Joint coordinates become
/// tables.
pub(super) fn read(text: &str) -> (Option<Description>, Vec<Problem>, HashSet<String>) {
    if first_word(text) == Some(AxesDescription::GROUP.word) {
        return match AxesDescription::read(text).and_then(|axes| axes.tables()) {
            Ok(description) => (Some(description), Vec::new(), HashSet::new()),
            Err(problems) => (None, problems, HashSet::new()),
        };
    }
    let (description, reader) = read_with(text, |reader, piece| {
        reader.file(piece, Description::GROUP, Description::of_fields)
    });
    (description, reader.problems, reader.broken)
}

/// The word that a text begins with, if it is one RON value that does.
fn first_word(text: &str) -> Option<&str> {
    let start = text.len() - text.strip_prefix('\u{feff}').unwrap_or(text).len();
    let begin = syntax::begin(text, start)?;
    match RawValue::new(&text[begin..], begin).shape() {
        PieceShape::Word { word, .. } => Some(word),
        _ => None,
    }
}

/// True if a text seems to be a mechanism file, false for a file of joint axes.
pub fn is_mechanism(text: &str) -> bool {
    first_word(text).is_some_and(|word| word == Description::GROUP.word)
}

/// True if a text seems to be a design file.
pub fn is_design(text: &str) -> bool {
    first_word(text).is_some_and(|word| word == DesignDescription::GROUP.word)
}

impl AxesDescription {
    /// Reads the text of a file of joint axes, or returns all its problems of form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, FileReader { mut problems, .. }) = read_with(text, |reader, piece| {
            reader.file(piece, AxesDescription::GROUP, AxesDescription::of_fields)
        });
        if let Some(description) = &description {
            super::checks::check_axes(description, &mut problems);
        }
        sort_by_key(&mut problems, |problem| {
            (problem.span.start, problem.span.end)
        });
        match description {
            Some(description) if problems.is_empty() => Ok(description),
            _ => Err(problems),
        }
    }
}

fn read_with<'a, T>(
    text: &'a str,
    read: impl Fn(&mut FileReader, RawValue<'a>) -> Option<T>,
) -> (Option<T>, FileReader) {
    let mut reader = FileReader::default();
    // Some editors begin a file with a byte order mark.
    let start = text.len() - text.strip_prefix('\u{feff}').unwrap_or(text).len();
    let description = match syntax::check(text, start) {
        Ok(begin) => read(&mut reader, RawValue::new(&text[begin..], begin)),
        Err(problem) => {
            reader.problems.push(*problem);
            None
        }
    };
    (description, reader)
}

#[derive(Default)]
struct FileReader {
    problems: Vec<Problem>,
    broken: HashSet<String>,
}

impl FileReader {
    /// Records a problem.
    fn note(&mut self, kind: ProblemKind, span: Range<usize>) {
        self.problems.push(kind.at(span));
    }

    /// A file of a group of fields, unless it has a later version.
    fn file<T>(
        &mut self,
        piece: RawValue,
        group: FieldGroup,
        read: impl Fn(&mut Self, &mut Fields) -> T,
    ) -> Option<T> {
        let mut fields = self.fields(piece, group)?;
        let known = self.known_version(&mut fields);
        known.then(|| read(self, &mut fields))
    }

    /// Reads the version; false if the file is for a later one.
    fn known_version(&mut self, fields: &mut Fields) -> bool {
        let Some(version) = self.require(fields, "version") else {
            return true;
        };
        let count = self.problems.len();
        self.version(version);
        // A later format may differ in anything; all other problems would be noise.
        let later = self.problems.get(count);
        let later = later.is_some_and(|p| matches!(p.kind, ProblemKind::LaterVersion(_)));
        if later {
            self.problems.drain(..count);
        }
        !later
    }

    fn version(&mut self, piece: RawValue) {
        let number = match piece.shape() {
            PieceShape::Number => piece.number().ok(),
            _ => None,
        };
        match number {
            None => self.wrong_type(piece, Expected::Said("the number of the file format")),
            Some(number) if number == f64::from(VERSION) => {}
            Some(number) if number > f64::from(VERSION) && number.fract() == 0.0 => {
                self.note(ProblemKind::LaterVersion(number), piece.span());
            }
            Some(number) => self.note(ProblemKind::NotAVersion(number), piece.span()),
        }
    }

    fn closure(&mut self, piece: RawValue) -> Option<ClosureDescription> {
        let (known, word) = (&ClosureKind::ALL, ClosureKind::word);
        let (kind, content) = self.word(
            piece,
            Expected::Said("a closure such as `Revolute(frame, frame)`"),
            known,
            word,
        )?;
        let expected = Expected::ClosureFrames(kind);
        if kind == ClosureKind::Coupling {
            let [expression] = self.content(piece, content, expected)?;
            let expression = self.entry(expression)?;
            return Some(ClosureDescription::coupling(expression, piece.span()));
        }
        let (frames, length) = if kind.has_length() {
            let [from, to, length] = self.content(piece, content, expected)?;
            ([from, to], Some(length))
        } else {
            (self.content(piece, content, expected)?, None)
        };
        let [from, to] = frames.map(|frame| self.text(frame, Expected::FRAME));
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
}
