//! A piece of a RON text, and its parts.
//!
//! `ron` reads values without their positions. A slice of the text has a position; so, once `ron` has found the text
//! well formed, values are divided into slices level by level, and `ron` reads the numbers and strings at the ends.

use std::borrow::Cow;
use std::fmt::{self, Formatter};
use std::ops::Range;

use serde::Deserialize;
use serde::de::{Deserializer, Visitor};

use super::lexemes::{Lexemes, parts, trimmed};
use super::{FoundValue, Spanned};

/// A value that `ron` has found to be well formed.
#[derive(Debug, Clone, Copy)]
pub(super) struct RawValue<'a> {
    text: &'a str,
    start: usize,
}

/// Kind of value of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) enum PieceShape<'a> {
    Number,
    Text,
    Character,
    Bytes,
    List,
    Map,
    /// Values in parentheses, without names.
    Tuple,
    /// Values in parentheses, with names.
    Fields,
    /// A word followed by parentheses, with their contents.
    Word {
        word: &'a str,
        content: Option<RawValue<'a>>,
    },
}

/// A text and the position of each of its bytes in the file.
pub(super) struct TextLiteral<'a> {
    pub text: Cow<'a, str>,
    places: BytePlaces,
}

enum BytePlaces {
    /// The text is in the file as it is, from here on.
    Straight(usize),
    /// Place in the file of each byte, and of the end, of an escaped text.
    Escaped(Vec<usize>),
    /// Not known more exactly than the whole literal.
    Whole(Range<usize>),
}

impl<'a> RawValue<'a> {
    /// The value in a text that begins at byte `start` of the file.
    pub fn new(text: &'a str, start: usize) -> Self {
        let value = trimmed(text);
        Self {
            text: value,
            start: start + value.as_ptr() as usize - text.as_ptr() as usize,
        }
    }

    fn part(&self, text: &'a str) -> Self {
        let start = self.place(text).start;
        Self { text, start }
    }

    /// The place of a slice of this piece in the file.
    fn place(&self, slice: &str) -> Range<usize> {
        let start = self.start + (slice.as_ptr() as usize - self.text.as_ptr() as usize);
        start..start + slice.len()
    }

    /// The place of the value in the file.
    pub fn span(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    pub fn shape(&self) -> PieceShape<'a> {
        let mut characters = self.text.chars();
        match characters.next() {
            Some('"') => PieceShape::Text,
            Some('\'') => PieceShape::Character,
            Some('[') => PieceShape::List,
            Some('{') => PieceShape::Map,
            Some('(') => match Lexemes::new(self.text).nth(2) {
                Some(sign) if &self.text[sign.clone()] == ":" => PieceShape::Fields,
                _ => PieceShape::Tuple,
            },
            Some('b')
                if matches!(characters.next(), Some('"' | '\''))
                    || self.text.starts_with("br\"") =>
            {
                PieceShape::Bytes
            }
            _ => match word(self.text) {
                Some((word, rest)) => {
                    let content = Lexemes::new(rest).next().map(|first| &rest[first.start..]);
                    let content = content.filter(|content| content.starts_with('('));
                    PieceShape::Word {
                        word,
                        content: content.map(|content| self.part(content)),
                    }
                }
                None if self.text.starts_with('r') => PieceShape::Text,
                None => PieceShape::Number,
            },
        }
    }

    /// The kind of value found here, for a problem.
    pub fn found(&self) -> FoundValue {
        match self.shape() {
            PieceShape::Number => FoundValue::Number,
            PieceShape::Text => FoundValue::Text,
            PieceShape::Character => FoundValue::Character,
            PieceShape::Bytes => FoundValue::Bytes,
            PieceShape::List => FoundValue::List,
            PieceShape::Map => FoundValue::Map,
            PieceShape::Tuple => FoundValue::Tuple,
            PieceShape::Fields => FoundValue::Fields,
            PieceShape::Word {
                word,
                content: None,
            } => FoundValue::Word(word.to_owned()),
            PieceShape::Word {
                word,
                content: Some(_),
            } => FoundValue::Call(word.to_owned()),
        }
    }

    pub fn number(&self) -> Result<f64, ron::Error> {
        match ron::Value::deserialize(&mut self.deserializer()?)? {
            ron::Value::Number(number) => Ok(number.into_f64()),
            _ => Err(ron::Error::ExpectedFloat),
        }
    }

    pub fn text(&self) -> Result<TextLiteral<'a>, ron::Error> {
        let LentText(text) = LentText::deserialize(&mut self.deserializer()?)?;
        let places = match &text {
            Cow::Borrowed(text) => BytePlaces::Straight(self.place(text).start),
            Cow::Owned(text) => escaped_places(self.text, self.start)
                .filter(|places| places.len() == text.len() + 1)
                .map_or_else(|| BytePlaces::Whole(self.span()), BytePlaces::Escaped),
        };
        Ok(TextLiteral { text, places })
    }

    /// The values of a list or a tuple.
    pub fn elements(&self) -> Vec<RawValue<'a>> {
        let values = parts(self.text).into_iter();
        values.map(|(_, value)| self.part(value)).collect()
    }

    /// The keys and values of a map.
    pub fn pairs(&self) -> Vec<(RawValue<'a>, RawValue<'a>)> {
        let pairs = parts(self.text).into_iter();
        let pairs = pairs.filter_map(|(key, value)| Some((self.part(key?), self.part(value))));
        pairs.collect()
    }

    /// The names and values of named fields in parentheses.
    pub fn fields(&self) -> Vec<(Spanned<&'a str>, RawValue<'a>)> {
        let fields = parts(self.text).into_iter().filter_map(|(name, value)| {
            let (name, value) = (name?, self.part(value));
            Some((Spanned::new(word(name)?.0, self.place(name)), value))
        });
        fields.collect()
    }

    fn deserializer(&self) -> Result<ron::Deserializer<'a>, ron::Error> {
        ron::Deserializer::from_str(self.text).map_err(|error| error.code)
    }
}

impl TextLiteral<'_> {
    /// The bytes of the file in which a range of the text is written.
    pub fn place(&self, range: Range<usize>) -> Range<usize> {
        match &self.places {
            BytePlaces::Straight(start) => start + range.start..start + range.end,
            BytePlaces::Escaped(places) => {
                let last = places.len() - 1;
                places[range.start.min(last)]..places[range.end.min(last)]
            }
            BytePlaces::Whole(span) => span.clone(),
        }
    }
}

/// The word at the start of a text, and the rest.
fn word(text: &str) -> Option<(&str, &str)> {
    let mut deserializer = ron::Deserializer::from_str(text).ok()?;
    let word = deserializer.deserialize_identifier(WordVisitor).ok()?;
    Some((word, deserializer.remainder()))
}

/// Places in the file of the bytes of an escaped string, and of its end.
fn escaped_places(literal: &str, start: usize) -> Option<Vec<usize>> {
    let inner = literal.strip_prefix('"')?;
    let mut places = Vec::new();
    let mut i = 0;
    loop {
        let rest = &inner[i..];
        let place = start + 1 + i;
        let first = rest.chars().next()?;
        let (read, made) = match first {
            '"' => {
                places.push(place);
                return Some(places);
            }
            '\\' => match rest[1..].chars().next()? {
                'x' => (4, 1),
                'u' => {
                    let digits = rest.get(3..rest.find('}')?)?;
                    let character = char::from_u32(u32::from_str_radix(digits, 16).ok()?)?;
                    (digits.len() + 4, character.len_utf8())
                }
                '\n' | '\r' => (
                    rest.len() - rest[1..].trim_start_matches([' ', '\t', '\n', '\r']).len(),
                    0,
                ),
                escaped => (1 + escaped.len_utf8(), 1),
            },
            plain => {
                let length = plain.len_utf8();
                places.extend(place..place + length);
                i += length;
                continue;
            }
        };
        places.extend(std::iter::repeat_n(place, made));
        i += read;
        if !inner.is_char_boundary(i) {
            return None;
        }
    }
}

/// A string, lent where it needs no unescaping.
#[derive(Deserialize)]
#[serde(transparent)]
struct LentText<'a>(#[serde(borrow)] Cow<'a, str>);

struct WordVisitor;

impl<'de> Visitor<'de> for WordVisitor {
    type Value = &'de str;

    fn expecting(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("a word")
    }

    fn visit_borrowed_str<E>(self, word: &'de str) -> Result<Self::Value, E> {
        Ok(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_know_their_places_without_the_comments_around_them() {
        let text = "/* before */ ( a: /* c */ 1.5 /* d */, b: [\"x\" , 'c'] // end\n ) // after";
        let whole = RawValue::new(text, 0);
        let expected = "( a: /* c */ 1.5 /* d */, b: [\"x\" , 'c'] // end\n )";
        assert_eq!(&text[whole.span()], expected);
        let [(a, one), (b, list)] = &whole.fields()[..] else {
            panic!("two fields")
        };
        assert_eq!([&text[a.span.clone()], &text[b.span.clone()]], ["a", "b"]);
        assert_eq!(&text[one.span()], "1.5");
        let elements = list.elements();
        let elements: Vec<_> = elements.iter().map(|x| &text[x.span()]).collect();
        assert_eq!(elements, ["\"x\"", "'c'"]);
    }

    #[test]
    fn shapes_are_told_apart() {
        let found = |text: &str| RawValue::new(text, 0).found();
        assert_eq!(found("-1.5"), FoundValue::Number);
        assert_eq!(found("\"a\""), FoundValue::Text);
        assert_eq!(found("r#\"a\"#"), FoundValue::Text);
        assert_eq!(found("'a'"), FoundValue::Character);
        assert_eq!(found("b\"a\""), FoundValue::Bytes);
        assert_eq!(found("[]"), FoundValue::List);
        assert_eq!(found("{}"), FoundValue::Map);
        assert_eq!(found("(1, 2)"), FoundValue::Tuple);
        assert_eq!(found("( /* c */ a : 2)"), FoundValue::Fields);
        assert_eq!(found("(aθ: 2)"), FoundValue::Fields);
        assert_eq!(found("(r#a: 2)"), FoundValue::Fields);
        assert_eq!(found("true"), FoundValue::Word("true".into()));
        assert_eq!(found("Tx (1)"), FoundValue::Call("Tx".into()));
        assert_eq!(found("base(1)"), FoundValue::Call("base".into()));
    }

    #[test]
    fn places_see_through_escapes() {
        let source = r#""a\u{3b8}\tb\x41\
            c\"d""#;
        let literal = RawValue::new(source, 100).text().unwrap();
        assert_eq!(literal.text, "aθ\tbAc\"d");
        let at = |part: &str| {
            let start = literal.text.find(part).unwrap();
            let place = literal.place(start..start + part.len());
            &source[place.start - 100..place.end - 100]
        };
        assert_eq!(at("a"), "a");
        assert_eq!(at("θ"), r"\u{3b8}");
        assert_eq!(at("b"), "b");
        assert_eq!(
            at("A"),
            r"\x41\
            "
        );
        assert_eq!(at("c"), "c");
        assert_eq!(at("\"d"), "\\\"d");
    }
}
