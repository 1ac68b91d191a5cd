//! `--format`, and how a report becomes an answer.

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use linkwork::output::{AnyReport, Document, JsonReport, Report, html, markdown, text};

use super::output_files::rows;
use super::{Answer, Refusal, lines};

/// Format of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For reading in a terminal
    Text,
    /// The resulting mechanism file
    Ron,
    /// For programs: SI units and radians, all digits
    Json,
    /// Rows, written as they are computed: SI units and radians, all digits
    Csv,
    /// For a page or a report
    Markdown,
    /// One page for a browser
    Html,
}

impl Format {
    /// The whole report in this format; nothing in one that consists of rows, or of a file.
    pub fn shown(self, report: &impl JsonReport, document: &Document) -> String {
        match self {
            Format::Text => text::render(document),
            Format::Json => report.json(),
            Format::Markdown => markdown::render(document),
            Format::Html => html::render(document),
            Format::Csv | Format::Ron => String::new(),
        }
    }

    pub fn answer(self, report: &impl JsonReport) -> Result<Answer, Refusal> {
        self.answer_by(report, report.document())
    }

    /// As [`Format::answer`], with another document.
    pub fn answer_by(
        self,
        report: &impl JsonReport,
        document: Document,
    ) -> Result<Answer, Refusal> {
        let mut answer = Answer {
            data: self.shown(report, &document),
            remarks: lines("warning", document.warnings),
            yes: !document.no,
        };
        match (self, report.rows(), report.file()) {
            (Format::Csv, Some(all), _) => {
                let whole = rows(all)?;
                answer.remarks += &beside_rows(report, whole);
                answer.yes &= whole;
            }
            (Format::Csv, None, _) => {
                let help = "choose another --format; rows come with --input, --locus or --follow";
                let title = "this answer has no rows";
                return Err(Refusal::error(format!("{title}\n  = help: {help}")));
            }
            (Format::Ron, _, Some(file)) => {
                let said = |error| format!("the file cannot be written: {error}");
                answer.data = file.map_err(|error| Refusal::error(said(error)))?;
            }
            _ => {}
        }
        Ok(answer)
    }
}

/// Note on stderr where only rows are written.
pub fn beside_rows(report: &impl Report, whole: bool) -> String {
    if !whole {
        let said = "interrupted: the rows end before the answer does";
        return lines("note", [said.to_owned()]);
    }
    let Document {
        answer,
        notes,
        method,
        no,
        ..
    } = report.document();
    let answer = no.then_some(answer);
    lines("note", answer.into_iter().chain(notes).chain(method))
}

pub fn readable() -> impl TypedValueParser<Value = Format> {
    all_but(&[Format::Csv, Format::Ron])
}

pub fn with_rows() -> impl TypedValueParser<Value = Format> {
    all_but(&[Format::Ron])
}

pub fn with_file() -> impl TypedValueParser<Value = Format> {
    all_but(&[Format::Csv])
}

fn all_but(without: &[Format]) -> impl TypedValueParser<Value = Format> + use<> {
    let formats = Format::value_variants().iter();
    let formats = formats.filter(|format| !without.contains(format));
    PossibleValuesParser::new(formats.filter_map(ValueEnum::to_possible_value))
        .try_map(|name| Format::from_str(&name, false))
}
