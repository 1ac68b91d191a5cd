//! What is wrong with a file of another program, with the offending text underlined.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::diagnostics::Style;
use crate::description::{Lines, count};
use crate::interchange::{ImportProblem, WrongFile};

/// Longer lines are not shown.
const MAX_WIDTH: usize = 400;

/// More problems are not shown.
const MAX_SHOWN: usize = 50;

/// All problems and how many there are.
pub fn render(wrong: &WrongFile, style: Style) -> String {
    let renderer = match style {
        Style::Plain => Renderer::plain(),
        Style::Coloured => Renderer::styled(),
    };
    let renderer = renderer.decor_style(DecorStyle::Ascii);
    let shown = wrong.problems.iter().take(MAX_SHOWN);
    let shown = shown.map(|(file, problem)| one(&renderer, &wrong.files[*file], problem));
    let mut parts: Vec<String> = shown.collect();
    let hidden = wrong.problems.len().saturating_sub(MAX_SHOWN);
    let more = match hidden {
        0 => String::new(),
        _ => format!(", {hidden} of them not shown"),
    };
    let name = wrong.files.first().map_or("", |(name, _)| name);
    parts.push(format!(
        "{} in {name}{more}",
        count(wrong.problems.len(), "problem")
    ));
    parts.join("\n\n") + "\n"
}

fn one(renderer: &Renderer, (name, text): &(String, String), problem: &ImportProblem) -> String {
    let title = Level::ERROR.primary_title(problem.to_string());
    let mut group = match &problem.span {
        None => title.element(Level::NOTE.message(format!("in {name}"))),
        Some(span) => {
            let lines = Lines::new(text);
            let (first, column) = lines.position(span.start);
            let window = lines.start(first)..lines.start(first + 1);
            let line = &text[window.clone()];
            if line.len() > MAX_WIDTH || line.trim().is_empty() {
                title.element(Level::NOTE.message(format!("at {name}:{first}:{column}")))
            } else {
                let end = span
                    .end
                    .min(window.start + line.trim_end().len())
                    .max(span.start);
                let within = span.start - window.start..end - window.start;
                let snippet = Snippet::source(line).line_start(first).path(name.as_str());
                title.element(snippet.annotation(AnnotationKind::Primary.span(within)))
            }
        }
    };
    if let Some(help) = problem.kind.help() {
        group = group.element(Level::HELP.message(help));
    }
    renderer.render(&[group])
}
