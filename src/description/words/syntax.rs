//! Words for what `ron` finds wrong with the syntax of a file.

use ron::Error;

pub(super) fn title(error: &Error) -> String {
    match error {
        Error::Eof => "the file ends in the middle of something".into(),
        Error::ExpectedComma => "a comma or a closing bracket is missing".into(),
        Error::ExpectedStructLikeEnd | Error::ExpectedOptionEnd => {
            "a comma or a closing `)` is missing".into()
        }
        Error::ExpectedArrayEnd => "a comma or a closing `]` is missing".into(),
        Error::ExpectedMapEnd => "a comma or a closing `}` is missing".into(),
        Error::ExpectedMapColon => "a colon is missing".into(),
        Error::ExpectedIdentifier => "the name of a field must stand here".into(),
        Error::ExpectedStringEnd => "a text is not closed by `\"`".into(),
        Error::InvalidEscape(_) => "a text contains `\\` followed by something unknown".into(),
        Error::UnclosedBlockComment => "a comment is not closed by `*/`".into(),
        Error::UnexpectedChar(c) => {
            format!("the character `{}` must not stand here", c.escape_debug())
        }
        Error::TrailingCharacters => "something follows the end of the mechanism".into(),
        Error::SuggestRawIdentifier(name) => format!("`{name}` is not the name of a field"),
        Error::NoSuchExtension(name) => format!("there is no RON extension `{name}`"),
        Error::ExpectedAttribute | Error::ExpectedAttributeEnd => {
            "this is not a RON attribute".into()
        }
        Error::IntegerOutOfBounds => "the number is too large".into(),
        other => format!("this is not RON: {}", first_lower(&other.to_string())),
    }
}

fn first_lower(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(characters).collect()
    })
}

pub(super) fn label(error: &Error) -> &'static str {
    match error {
        Error::Eof => "more must follow",
        Error::ExpectedComma
        | Error::ExpectedStructLikeEnd
        | Error::ExpectedOptionEnd
        | Error::ExpectedArrayEnd
        | Error::ExpectedMapEnd
        | Error::ExpectedMapColon => "missing before this",
        Error::TrailingCharacters => "not part of it",
        _ => "",
    }
}

pub(super) fn help(error: &Error) -> Option<&'static str> {
    match error {
        Error::UnexpectedChar('#') => Some("a comment begins with `//`"),
        Error::UnexpectedChar('=') | Error::ExpectedMapColon => Some("write `name: value`"),
        Error::UnexpectedChar('“' | '”' | '„' | '‘' | '’') => {
            Some("write the straight quotes of the keyboard, `\"`")
        }
        Error::InvalidEscape(_) => Some("write `\\\\` for a backslash"),
        Error::TrailingCharacters => Some("a file holds one `Mechanism(…)`"),
        _ => None,
    }
}
