//! Text → description, noting every problem on the way.
//!
//! The reader notes each problem, substitutes a harmless value and continues.

mod axes;
mod closed_form;
mod leaves;
mod shapes;
mod syntax;

use std::collections::HashSet;

use super::piece::{Piece, Shape};
use super::*;
use shapes::Fields;

/// The description as far as it could be read, the problems, and the names affected by them.
pub(super) fn read(text: &str) -> (Option<Description>, Vec<Problem>, HashSet<String>) {
    let (description, reader) = read_with(text, Reader::mechanism);
    (description, reader.problems, reader.broken)
}

/// The same for a file of joint axes.
pub(super) fn read_axes(text: &str) -> (Option<AxesDescription>, Vec<Problem>) {
    let (description, reader) = read_with(text, Reader::axes);
    (description, reader.problems)
}

/// The word that a text begins with, if it is one RON value that does.
pub(super) fn first_word(text: &str) -> Option<&str> {
    let start = text.len() - text.strip_prefix('\u{feff}').unwrap_or(text).len();
    let within = text.len() as u64 <= MAX_BYTES;
    let begin = within.then(|| syntax::begin(text, start)).flatten()?;
    match Piece::new(&text[begin..], begin).shape() {
        Shape::Word { word, .. } => Some(word),
        _ => None,
    }
}

fn read_with<'a, T>(
    text: &'a str,
    read: impl Fn(&mut Reader, Piece<'a>) -> Option<T>,
) -> (Option<T>, Reader) {
    let mut reader = Reader {
        problems: Vec::new(),
        broken: HashSet::new(),
    };
    if text.len() as u64 > MAX_BYTES {
        let problem = ProblemKind::TooLarge { bytes: text.len() }.at(0..0);
        reader.problems.push(problem);
        return (None, reader);
    }
    // Some editors begin a file with a byte order mark.
    let start = if text.starts_with('\u{feff}') {
        '\u{feff}'.len_utf8()
    } else {
        0
    };
    let description = match syntax::check(text, start) {
        Ok(begin) => read(&mut reader, Piece::new(&text[begin..], begin)),
        Err(problem) => {
            reader.problems.push(*problem);
            None
        }
    };
    (description, reader)
}

struct Reader {
    problems: Vec<Problem>,
    broken: HashSet<String>,
}

impl Reader {
    fn mechanism(&mut self, piece: Piece) -> Option<Description> {
        let mut fields = self.fields(piece, Structure::Mechanism)?;
        if !self.known_version(&mut fields) {
            return None;
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

    /// Reads the version; false if the file is for a later one.
    fn known_version(&mut self, fields: &mut Fields) -> bool {
        let Some(version) = self.require(fields, "version") else {
            return true;
        };
        let count = self.problems.len();
        self.version(version);
        // A later format may differ in anything; all other problems would be noise.
        let later = matches!(
            self.problems.get(count),
            Some(Problem {
                kind: ProblemKind::LaterVersion(_),
                ..
            })
        );
        if later {
            self.problems.drain(..count);
        }
        !later
    }

    fn limits(&mut self, fields: &mut Fields) -> Option<(Entry, Entry)> {
        fields.take("limits").and_then(|piece| {
            let limits = self.tuple(piece, Expected::Limits)?;
            self.entries(limits).map(|[low, high]| (low, high))
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
            limits: self.limits(&mut fields),
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
        let Some(mut fields) = self.fields(piece, Structure::Row) else {
            // it still counts, so that the links after it keep their numbers
            let [alpha, a, d, theta] = std::array::from_fn(|_| Entry::absent());
            let span = piece.span();
            return Some(Row {
                alpha,
                a,
                d,
                theta,
                span,
            });
        };
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
}
