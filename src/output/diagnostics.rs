//! The problems of a mechanism file, each with the offending lines and the offending text underlined.

use std::borrow::Cow;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use crate::description::{FileError, Lines, Problem, Severity, count};

/// Longer lines are not shown: nobody could read them, and laying them out takes long.
const MAX_WIDTH: usize = 2000;

/// Whether to use colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Letters only.
    Plain,
    /// With the colours of a terminal.
    Coloured,
}

/// All problems of a file and how many there are.
pub fn render(error: &FileError, style: Style) -> String {
    let renderer = match style {
        Style::Plain => Renderer::plain(),
        Style::Coloured => Renderer::styled(),
    }
    .decor_style(DecorStyle::Ascii);
    let page = Page {
        path: error.path.display().to_string(),
        text: &error.text,
        lines: Lines::new(&error.text),
    };
    let (shown, more) = error.shown();
    let mut rendered: Vec<String> = shown
        .iter()
        .map(|problem| renderer.render(&page.report(problem)))
        .collect();
    rendered.push(summary(error, more));
    rendered.join("\n\n") + "\n"
}

/// `3 problems in four_bar.ron`
fn summary(error: &FileError, hidden: usize) -> String {
    let errors = error
        .problems
        .iter()
        .filter(|problem| problem.severity() == Severity::Error)
        .count();
    let warnings = error.problems.len() - errors;
    let what = match (errors, warnings) {
        (errors, 0) => count(errors, "problem"),
        (0, warnings) => count(warnings, "warning"),
        _ => format!(
            "{} and {}",
            count(errors, "problem"),
            count(warnings, "warning")
        ),
    };
    let hidden = match hidden {
        0 => String::new(),
        _ => format!(", {hidden} of them not shown"),
    };
    format!("{what} in {}{hidden}", error.path.display())
}

struct Page<'a> {
    path: String,
    text: &'a str,
    lines: Lines<'a>,
}

impl Page<'_> {
    fn report(&self, problem: &Problem) -> Vec<Group<'_>> {
        let level = match problem.severity() {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let title = level.primary_title(problem.kind.title());
        let mut group = match self.excerpt(problem) {
            Some(excerpt) => title.element(excerpt),
            None => {
                let (line, column) = self.lines.position(problem.span.start);
                title.element(Level::NOTE.message(format!("at {}:{line}:{column}", self.path)))
            }
        };
        if let Some(help) = problem.kind.help() {
            group = group.element(Level::HELP.message(help));
        }
        vec![group]
    }

    /// The lines from the first to the last place of a problem; the unconcerned ones among them are folded.
    fn excerpt(&self, problem: &Problem) -> Option<Snippet<'_, annotate_snippets::Annotation<'_>>> {
        let places =
            || std::iter::once(&problem.span).chain(problem.related.iter().map(|(span, _)| span));
        let first = places()
            .map(|span| self.lines.position(span.start).0)
            .min()?;
        let last = places().map(|span| self.lines.position(span.end).0).max()?;
        let window = self.lines.start(first)..self.lines.start(last + 1);
        let source = &self.text[window.clone()];
        if places().any(|span| self.width_at(span) > MAX_WIDTH) {
            return None;
        }
        let within = |span: &Range<usize>| span.start - window.start..span.end - window.start;
        let label = Some(problem.kind.label())
            .filter(|label| !label.is_empty())
            .map(Cow::Owned);
        let main = AnnotationKind::Primary
            .span(within(&problem.span))
            .label(label);
        let related = problem.related.iter().map(|(span, note)| {
            AnnotationKind::Context
                .span(within(span))
                .label(note.label())
        });
        let snippet = Snippet::source(source)
            .line_start(first)
            .path(self.path.clone());
        Some(snippet.annotation(main).annotations(related))
    }

    /// The bytes of all lines that a place touches.
    fn width_at(&self, span: &Range<usize>) -> usize {
        let (first, last) = (
            self.lines.position(span.start).0,
            self.lines.position(span.end).0,
        );
        self.lines.start(last + 1) - self.lines.start(first)
    }
}
