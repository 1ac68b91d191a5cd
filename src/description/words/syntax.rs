//! Words for what `ron` finds wrong with the syntax of a file.

use ron::Error;

use crate::algebra::shown;

/// `found` is the character at which reading stopped.
pub(in crate::description) fn title(error: &Error, found: Option<char>) -> String {
    let title = match (error, found) {
        (Error::Eof, _) => "the file ends unexpectedly",
        (Error::ExpectedComma, Some('=')) | (Error::ExpectedMapColon, _) => "a colon is missing",
        (Error::ExpectedComma, _) => "a comma or a closing bracket is missing",
        (Error::ExpectedIdentifier, Some(')' | ']' | '}')) => "a closing bracket is missing",
        (Error::UnexpectedChar(')' | ']' | '}'), _) => "a value or a closing bracket is missing",
        (Error::ExpectedStructLikeEnd | Error::ExpectedOptionEnd, _) => {
            "a comma or a closing `)` is missing"
        }
        (Error::ExpectedArrayEnd, _) => "a comma or a closing `]` is missing",
        (Error::ExpectedMapEnd, _) => "a comma or a closing `}` is missing",
        (Error::ExpectedIdentifier, _) => "expected the name of a field",
        (Error::ExpectedStringEnd, _) => "a string is not closed by `\"`",
        (Error::InvalidEscape(_), _) => "a string contains `\\` followed by an unknown character",
        (Error::UnclosedBlockComment, _) => "a comment is not closed by `*/`",
        (Error::TrailingCharacters, Some(')' | ']' | '}')) => {
            "a closing bracket has no opening one"
        }
        (Error::TrailingCharacters, _) => "there is text after the end of the mechanism",
        (Error::ExpectedAttribute | Error::ExpectedAttributeEnd, _) => {
            "this is not a RON attribute"
        }
        (Error::IntegerOutOfBounds, _) => "the number is too large",
        (Error::UnexpectedChar(c), _) => {
            return format!("unexpected character `{}`", shown(*c));
        }
        (Error::SuggestRawIdentifier(name), _) => {
            return format!("`{name}` is not the name of a field");
        }
        (Error::NoSuchExtension(name), _) => return format!("there is no RON extension `{name}`"),
        (other, _) => return format!("this is not RON: {}", first_lower(&other.to_string())),
    };
    title.to_owned()
}

fn first_lower(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next();
    first
        .into_iter()
        .flat_map(char::to_lowercase)
        .chain(characters)
        .collect()
}

pub(in crate::description) fn label(error: &Error, found: Option<char>) -> &'static str {
    match (error, found) {
        (Error::Eof, _) => "more is expected here",
        (Error::ExpectedComma, Some('=')) => "not a colon",
        (Error::ExpectedIdentifier, Some(')' | ']' | '}'))
        | (Error::UnexpectedChar(')' | ']' | '}'), _) => "missing before this",
        (
            Error::ExpectedComma
            | Error::ExpectedStructLikeEnd
            | Error::ExpectedOptionEnd
            | Error::ExpectedArrayEnd
            | Error::ExpectedMapEnd
            | Error::ExpectedMapColon,
            _,
        ) => "missing before this",
        (Error::TrailingCharacters, Some(')' | ']' | '}')) => "one too many",
        (Error::TrailingCharacters, _) => "not part of it",
        (Error::ExpectedStringEnd, _) => "opened here",
        _ => "",
    }
}

pub(in crate::description) fn help(error: &Error, found: Option<char>) -> Option<&'static str> {
    match (error, found) {
        (Error::UnexpectedChar('#') | Error::ExpectedAttribute, _) => {
            Some("a comment begins with `//`")
        }
        (Error::ExpectedComma | Error::UnexpectedChar('='), Some('='))
        | (Error::ExpectedMapColon, _) => Some("write `name: value`"),
        (Error::UnexpectedChar('“' | '”' | '„' | '‘' | '’'), _) => {
            Some("write the straight quotes of the keyboard, `\"`")
        }
        (Error::InvalidEscape(_), _) => Some("write `\\\\` for a backslash"),
        (Error::TrailingCharacters, Some(')' | ']' | '}')) => None,
        (Error::TrailingCharacters, _) => Some("a file holds one `Mechanism(…)`"),
        _ => None,
    }
}
