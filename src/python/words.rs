//! Words of the command line as Python takes them.

use crate::ask::AskError;
use crate::output::complaint::{Complaint, Given};
use crate::output::diagnostics::Style;

pub enum Refused {
    Asked(AskError),
    Said(Complaint),
}

impl From<AskError> for Refused {
    fn from(error: AskError) -> Self {
        Refused::Asked(error)
    }
}

/// A complaint whose remedies name keywords of Python.
pub fn worded(mut said: Complaint, given: Option<Given>) -> String {
    said.help = said.help.as_deref().map(keywords);
    let rendered = match given {
        Some(given) => said.render_in(&given, Style::Plain),
        None => said.render(Style::Plain),
    };
    let rendered = rendered.trim_end();
    rendered.strip_prefix("error: ").unwrap_or(rendered).into()
}

/// `--hold a=1` as `hold={"a": "1"}`, `--input a=0..1` as `input={"a": ("0", "1")}`, `--free a` as `free="a"`, and
/// commands as methods.
fn keywords(help: &str) -> String {
    let help = help.replace("`linkwork ", "`.");
    let mut parts = help.split("--");
    let mut words = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let ends = |c: char| !(c.is_alphanumeric() || c == '-');
        let (option, rest) = part.split_at(part.find(ends).unwrap_or(part.len()));
        let keyword = option.replace('-', "_");
        let value = rest.strip_prefix(' ').unwrap_or_default();
        let end = match value.strip_prefix('\'') {
            Some(quoted) => quoted.find('\'').map_or(value.len(), |end| end + 2),
            None => value.find([' ', ';']).unwrap_or(value.len()),
        };
        let (value, after) = value.split_at(end);
        let value = value.trim_matches('\'').trim_end_matches(',');
        let written = match value.split_once('=') {
            Some((name, value)) => Some(match value.split_once("..") {
                Some((from, to)) => format!("{{\"{name}\": (\"{from}\", \"{to}\")}}"),
                None => format!("{{\"{name}\": \"{value}\"}}"),
            }),
            None if option == "free" && !value.is_empty() => Some(format!("\"{value}\"")),
            None if value.starts_with(|c: char| c.is_ascii_digit()) => Some(value.to_owned()),
            None => None,
        };
        words += &match written {
            Some(value) => format!("{keyword}={value}{after}"),
            None => format!("`{keyword}`{rest}"),
        };
    }
    words
}

#[cfg(test)]
mod tests {
    use super::keywords;

    #[test]
    fn options_become_keywords() {
        let cases = [
            ("free theta1: --free theta1", "free theta1: free=\"theta1\""),
            (
                "hold 1 more, e.g. --hold 'a b=home'; or use `linkwork sweep --input`",
                "hold 1 more, e.g. hold={\"a b\": \"home\"}; or use `.sweep `input``",
            ),
            (
                "e.g. --input t=0deg..360deg; follow with --follow; or --steps 100",
                "e.g. input={\"t\": (\"0deg\", \"360deg\")}; follow with `follow`; or steps=100",
            ),
        ];
        for (option, keyword) in cases {
            assert_eq!(keywords(option), keyword);
        }
    }
}
