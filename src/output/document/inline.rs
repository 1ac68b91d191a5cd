//! Texts within a line: names between back quotes.

/// A piece of text: as it stands, or a name or command that stood between back quotes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<'a> {
    Plain(&'a str),
    Quoted(&'a str),
}

/// The pieces of a text; a back quote without a partner is plain.
pub fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('`') {
        let Some(length) = rest[start + 1..].find('`').filter(|length| *length > 0) else {
            break;
        };
        pieces.push(Piece::Plain(&rest[..start]));
        pieces.push(Piece::Quoted(&rest[start + 1..start + 1 + length]));
        rest = &rest[start + length + 2..];
    }
    pieces.push(Piece::Plain(rest));
    pieces.retain(|piece| *piece != Piece::Plain(""));
    pieces
}

/// The text on one line.
pub fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
