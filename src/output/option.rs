//! What is wrong with an option of the command line, with the offending part underlined.

use std::borrow::Cow;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::diagnostics::Style;
use crate::description::{Problem, ReplacementError};

/// An option as it was given: `--set l1=2*l0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given<'a> {
    /// The option with its dashes.
    pub option: &'a str,
    /// The name before the equals sign.
    pub name: &'a str,
    /// What follows the equals sign, if there is one.
    pub value: Option<&'a str>,
}

/// What is wrong with something, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    /// What is wrong, in one sentence without a full stop.
    pub title: String,
    /// A few words to stand under the offending part; may be empty.
    pub label: String,
    /// What to do about it.
    pub help: Option<String>,
}

/// Which part of an option is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// The name.
    Name,
    /// Bytes of the value.
    Value(Range<usize>),
    /// The whole value.
    WholeValue,
}

impl Complaint {
    /// The words for a problem of a mechanism file.
    pub fn of(problem: &Problem) -> Self {
        Complaint {
            title: problem.kind.title(),
            label: problem.kind.label(),
            help: problem.kind.help(),
        }
    }

    /// The complaint about a part of an option.
    pub fn render_in(&self, given: &Given, part: &Part, style: Style) -> String {
        let value = given.value.unwrap_or_default();
        let equals = if given.value.is_some() { "=" } else { "" };
        let before = format!("{} {}{equals}", given.option, given.name);
        let source = format!("{before}{value}");
        let span = match part {
            Part::Name => given.option.len() + 1..given.option.len() + 1 + given.name.len(),
            Part::WholeValue => before.len()..source.len(),
            Part::Value(span) => before.len() + span.start..before.len() + span.end,
        };
        let label = Some(self.label.as_str()).filter(|label| !label.is_empty());
        let annotation = AnnotationKind::Primary
            .span(span)
            .label(label.map(Cow::Borrowed));
        let snippet = Snippet::source(source.as_str()).annotation(annotation);
        let title = Level::ERROR.primary_title(self.title.as_str());
        let mut group = title.element(snippet);
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        renderer(style).render(&[group]) + "\n"
    }

    /// The complaint about the options as a whole.
    pub fn render(&self, style: Style) -> String {
        self.at_level(Level::ERROR, style)
    }

    /// The same as a warning, where there is an answer all the same.
    pub fn render_warning(&self, style: Style) -> String {
        self.at_level(Level::WARNING, style)
    }

    fn at_level(&self, level: Level<'static>, style: Style) -> String {
        let title = level.primary_title(self.title.as_str());
        let group = match &self.help {
            Some(help) => title.element(Level::HELP.message(help.as_str())),
            None => annotate_snippets::Group::with_title(title),
        };
        renderer(style).render(&[group]) + "\n"
    }
}

fn renderer(style: Style) -> Renderer {
    let renderer = match style {
        Style::Plain => Renderer::plain(),
        Style::Coloured => Renderer::styled(),
    };
    renderer.decor_style(DecorStyle::Ascii)
}

/// Everything that is wrong with another value for a parameter.
pub fn replacement(error: &ReplacementError, given: &Given, style: Style) -> String {
    match error {
        ReplacementError::UnknownParameter { suggestion, .. } => {
            let complaint = Complaint {
                title: error.to_string(),
                label: "not known".into(),
                help: suggestion
                    .as_ref()
                    .map(|meant| format!("did you mean `{meant}`?")),
            };
            complaint.render_in(given, &Part::Name, style)
        }
        ReplacementError::Value(problems) => {
            let rendered = problems.iter().map(|problem| {
                let part = Part::Value(problem.span.clone());
                Complaint::of(problem).render_in(given, &part, style)
            });
            rendered.collect::<Vec<_>>().join("\n")
        }
    }
}
