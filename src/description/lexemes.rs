//! Finds the bracket that a RON file leaves open.

use std::ops::Range;

/// An opening bracket that is not closed before another kind of bracket, or the text, ends.
#[derive(Debug, PartialEq)]
pub(super) struct Unclosed {
    /// The opening bracket.
    pub open: Range<usize>,
    /// Where its closing bracket is missing.
    pub missed_at: usize,
}

/// The first unclosed bracket of `text`, outside strings and comments.
pub(super) fn unclosed(text: &str) -> Option<Unclosed> {
    let bytes = text.as_bytes();
    let mut open: Vec<usize> = Vec::new();
    let mut i = 0;
    while i < bytes.len() {
        match bytes[i] {
            b'(' | b'[' | b'{' => open.push(i),
            closing @ (b')' | b']' | b'}') => {
                let last = open.pop()?;
                if partner(bytes[last]) != closing {
                    return Some(Unclosed {
                        open: last..last + 1,
                        missed_at: i,
                    });
                }
            }
            b'"' => i = string_end(bytes, i)?,
            b'r' if matches!(bytes.get(i + 1), Some(b'"' | b'#')) => i = raw_string_end(text, i)?,
            b'\'' => i = character_end(text, i),
            b'/' if bytes.get(i + 1) == Some(&b'/') => {
                i += text[i..].find('\n').unwrap_or(text.len() - i)
            }
            b'/' if bytes.get(i + 1) == Some(&b'*') => i = comment_end(bytes, i)?,
            _ => {}
        }
        i += 1;
    }
    open.pop().map(|last| Unclosed {
        open: last..last + 1,
        missed_at: text.len(),
    })
}

fn partner(open: u8) -> u8 {
    match open {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}

/// The closing quote of the string that begins at `start`.
fn string_end(bytes: &[u8], start: usize) -> Option<usize> {
    let mut i = start + 1;
    while *bytes.get(i)? != b'"' {
        i += if bytes[i] == b'\\' { 2 } else { 1 };
    }
    Some(i)
}

fn raw_string_end(text: &str, start: usize) -> Option<usize> {
    let hashes = text[start + 1..].bytes().take_while(|&b| b == b'#').count();
    let content = start + 1 + hashes;
    if text.as_bytes().get(content) != Some(&b'"') {
        return Some(start);
    }
    let ending = format!("\"{}", "#".repeat(hashes));
    text[content + 1..]
        .find(&ending)
        .map(|i| content + i + ending.len())
}

/// A character is at most an escape long; anything else is a stray apostrophe.
fn character_end(text: &str, start: usize) -> usize {
    let mut characters = text[start + 1..].char_indices();
    match characters.next() {
        Some((_, '\\')) => text[start + 2..]
            .char_indices()
            .skip(1)
            .take(10)
            .find(|&(_, c)| c == '\'')
            .map(|(i, _)| start + 2 + i),
        Some(_) => characters
            .next()
            .filter(|&(_, c)| c == '\'')
            .map(|(i, _)| start + 1 + i),
        None => None,
    }
    .unwrap_or(start)
}

fn comment_end(bytes: &[u8], start: usize) -> Option<usize> {
    let (mut i, mut depth) = (start + 2, 1);
    while depth > 0 {
        match (bytes.get(i)?, bytes.get(i + 1)?) {
            (b'*', b'/') => (i, depth) = (i + 2, depth - 1),
            (b'/', b'*') => (i, depth) = (i + 2, depth + 1),
            _ => i += 1,
        }
    }
    Some(i - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> Option<(usize, usize)> {
        unclosed(text).map(|found| (found.open.start, found.missed_at))
    }

    #[test]
    fn the_bracket_left_open_is_found() {
        assert_eq!(at("(a: [1, 2)"), Some((4, 9)));
        assert_eq!(at("(a: [1, 2]"), Some((0, 10)));
        assert_eq!(at("{ (1) }"), None);
        assert_eq!(at("1)"), None);
    }

    #[test]
    fn brackets_in_strings_comments_and_characters_do_not_count() {
        let text = r##"( "[\"(" r#"("("# '(' '\'' // {
            /* ( /* [ */ */"##;
        assert_eq!(at(text), Some((0, text.len())));
    }
}
