//! `linkwork handout`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::compare::CompareSettings;
use linkwork::analysis::formulas::FormulasSettings;
use linkwork::analysis::overview::overview;
use linkwork::ask::Question;
use linkwork::output::document::{Block, Section};
use linkwork::output::drawing::{DrawingSettings, Panel, sheet};
use linkwork::output::{Document, Report, html};
use linkwork::scene::Scene;

use super::output_files::{file, save};
use super::question_options::QuestionOptions;
use super::search_options::SearchArgs;
use super::source::Source;
use super::{Answer, Refusal, lines};

/// Write all about a mechanism on one page, to be handed out or projected.
///
/// The page has the drawing, the parameters and tables, the transforms and closures, the solution in closed form where
/// there is one, the file's closed forms with their proofs, all assemblies and the mobility. It is one file, with formulas
/// as MathML; nothing is loaded and no script runs.
#[derive(Args)]
#[command(after_help = "Example: linkwork handout mechanisms/four_bar.ron -o four_bar.html")]
pub struct Handout {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: QuestionOptions,
    #[command(flatten)]
    search: SearchArgs,
    /// File to write [default: beside the mechanism file]
    #[arg(short, long, value_name = "FILE", value_parser = file(&["html", "htm"]))]
    output: Option<PathBuf>,
}

impl Handout {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        let mechanism = posed.loaded.mechanism.clone();
        let mut page = overview(&mechanism).document();
        let drawn = posed.ask(Question::configurations);
        let at = drawn.map_or_else(|_| mechanism.home(), |mut modes| modes.swap_remove(0).1);
        let panel = Panel::new("", None, Scene::of(&mechanism, &at));
        let settings = DrawingSettings {
            labels: true,
            ..DrawingSettings::default()
        };
        let about = format!("{} as it is assembled", mechanism.name());
        let picture = Block::Picture(sheet(&[panel], &settings).svg(), about);
        page.sections
            .insert(0, Section::new("Drawing").block(picture));
        let mut missing = Vec::new();
        let mut add = |title: &str, found: Result<Document, Refusal>| match found {
            Ok(document) => page.sections.push(part(title, document)),
            Err(Refusal(said)) => missing.push(format!("{title}: {}", first(&said))),
        };
        let formulas = posed.question.formulas(&FormulasSettings::default());
        let formulas = formulas.map(|report| report.document());
        add("Formulas", formulas.map_err(Refusal::error));
        let solution = posed.ask(Question::solution);
        add("Closed form", solution.map(|report| report.document()));
        if !mechanism.closed_forms().is_empty() {
            let samples = CompareSettings::default().samples;
            let compared = posed.ask(|q, watch| Ok(q.compare(samples, watch)));
            add("Printed formulas", compared.map(|report| report.document()));
        }
        let assemblies = posed.ask(|q, watch| q.assemblies(Wanted::default(), watch));
        add("Assemblies", assemblies.map(|report| report.document()));
        let mobility = posed.ask(Question::mobility);
        add("Mobility", mobility.map(|report| report.document()));
        let path = (self.output.clone()).unwrap_or_else(|| self.source.beside("html"));
        save(&path, html::render(&page).as_bytes())?;
        let data = format!("{}: open it in a browser.\n", path.display());
        let remarks = posed.loaded.warnings() + &lines("note: left out", missing);
        Ok(Answer::yes(data, remarks))
    }
}

/// A document as a part of another: its answer and notes, then its sections.
fn part(title: &str, document: Document) -> Section {
    let own = Section::new(title)
        .text(document.answer)
        .list(document.notes);
    let sections = document.sections.into_iter();
    sections.fold(own, Section::section).list(document.method)
}

/// The first line of what was said, without the word it begins with.
fn first(said: &str) -> &str {
    let line = said.lines().next().unwrap_or_default();
    line.trim_start_matches("error: ")
}
