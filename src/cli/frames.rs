//! `linkwork frames`

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use linkwork::analysis::frames::{AxesReport, FramesReport, FramesSettings, frames, joint_axes};
use linkwork::analysis::rounding::posed;
use linkwork::ask::Question;
use linkwork::description::{
    AxesDescription, Convention, Description, LoadError, MAX_BYTES, is_mechanism,
};
use linkwork::mechanism::Mechanism;
use linkwork::output::frames as output;
use linkwork::output::rounding::{Prefaced, sentence};
use linkwork::system::Analysed;

use super::progress::watched;
use super::read::{called, text};
use super::report_format::{Format, with_file};
use super::{Answer, Refusal, lines};

/// Derive Denavit–Hartenberg tables from joint axes, or joint axes from tables.
///
/// The file gives the axes at home: `Axes(version: 1, name: "…", joints: { "q1": Revolute(point: (0, 0, 0), direction:
/// (0, 0, 1), home: 0), "q2": Prismatic(direction: (1, 0, 0)), … }, base: […], tool: […])`. Where joints name the bodies
/// they connect, as in `between: ("ground", "crank")`, loops are cut, at the joints of `cut: ["q3"]` or else where
/// that gives the simplest tables.
///
/// For a mechanism file the answer is the joint axes of its tables, where it is assembled; with --steps or --convention
/// also the tables that follow from these axes.
#[derive(Args)]
#[command(
    after_help = "Example: linkwork frames mechanisms/axes/puma560.ron --convention standard --format ron"
)]
pub struct Frames {
    /// The file of joint axes, or a mechanism file; `-` reads standard input
    file: PathBuf,
    /// The convention of the tables; that of the file, or else modified
    #[arg(long, value_enum)]
    convention: Option<Convention>,
    /// Report the 14 steps of the Denavit–Hartenberg algorithm one by one
    #[arg(long)]
    steps: bool,
    /// Format of the answer
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = with_file())]
    format: Format,
}

impl Frames {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let (path, text) = (called(&self.file), text(&self.file, MAX_BYTES)?);
        if is_mechanism(&text) {
            return self.axes_of_mechanism(&path, text);
        }
        let refused = |problems| Refusal::from(LoadError::wrong(&path, text.clone(), problems));
        let mut axes = AxesDescription::read(&text).map_err(refused)?;
        let exact = axes.tables().and_then(posed).ok();
        let rounding = exact
            .as_ref()
            .and_then(|(_, mechanism)| mechanism.rounding());
        let note = lines("note", rounding.map(sentence));
        if let (
            Some(_),
            Some((
                Description {
                    coordinates: Some(of),
                    ..
                },
                _,
            )),
        ) = (rounding, &exact)
        {
            axes = of.axes.clone();
        }
        let report = frames(&axes, &self.settings()).map_err(refused)?;
        let mut answer = self.tables(&report)?.after(note);
        if !report.warnings.is_empty() {
            answer = answer.after(refused(report.warnings).0);
        }
        Ok(answer)
    }

    fn settings(&self) -> FramesSettings {
        FramesSettings {
            convention: self.convention,
        }
    }

    fn tables(&self, report: &FramesReport) -> Result<Answer, Refusal> {
        let document = output::document(report, self.steps);
        self.format.answer_by(report, document)
    }

    /// Writes the axes of tables, and other tables of these if they are asked for.
    fn axes_of_mechanism(&self, path: &Path, text: String) -> Result<Answer, Refusal> {
        let (text, description) = Mechanism::read_text(path, text)?;
        let (_, mechanism) =
            posed(description).map_err(|problems| LoadError::wrong(path, text, problems))?;
        let mechanism = Arc::new(mechanism);
        let question = Question::new(mechanism.clone());
        let (at, gap) = match watched(|watch| question.closed(watch)) {
            Ok(Analysed::Closed(closed)) => (closed.configuration, false),
            _ => (mechanism.home(), true),
        };
        let axes = joint_axes(&mechanism, &at).map_err(|error| output::no_axes(&error))?;
        let mut answer = match self.steps || self.convention.is_some() {
            false => {
                let axes = AxesReport::from(axes);
                self.format.answer(&Prefaced::new(&mechanism, axes))?
            }
            true => {
                // the axes have no text of their own that could be pointed at
                let report = frames(&axes, &self.settings()).map_err(|problems| {
                    let titles = problems.iter().map(|problem| problem.kind.title());
                    Refusal(lines("error", titles))
                })?;
                self.tables(&report)?
            }
        };
        if gap {
            answer.yes = false;
            answer = answer.after(lines("warning", [output::NOT_ASSEMBLED.to_owned()]));
        }
        Ok(answer)
    }
}
