//! `--format`

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use linkwork::output::{Report, html, json, markdown, text};

/// How an answer is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// To be read by people
    Text,
    /// To be read by programs: SI units and radians with all digits
    Json,
    /// Rows as they come: SI units and radians with all digits
    Csv,
    /// To be read by people, for a page or a report
    Markdown,
    /// To be read by people, as one page for a browser
    Html,
}

impl Format {
    /// The whole report in this format; nothing in one that consists of rows.
    pub fn shown(self, report: &impl Report) -> String {
        match self {
            Format::Text => text::render(&report.shown()),
            Format::Json => json::render(report),
            Format::Markdown => markdown::render(&report.shown()),
            Format::Html => html::render(&report.shown()),
            Format::Csv => String::new(),
        }
    }
}

/// The format of an answer without rows.
#[derive(Args)]
pub struct Written {
    /// How to write the answer; where there is none, stderr says why as text
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = without_rows())]
    format: Format,
}

impl Written {
    /// The whole report in this format.
    pub fn shown(&self, report: &impl Report) -> String {
        self.format.shown(report)
    }
}

/// Every format but the one of rows.
fn without_rows() -> impl TypedValueParser<Value = Format> {
    let formats = Format::value_variants().iter();
    let formats = formats.filter(|format| **format != Format::Csv);
    PossibleValuesParser::new(formats.filter_map(ValueEnum::to_possible_value))
        .try_map(|name| Format::from_str(&name, false))
}
