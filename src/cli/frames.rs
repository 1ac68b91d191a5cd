//! `linkwork frames`

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use linkwork::analysis::frames::{AxesReport, FramesSettings, frames, joint_axes};
use linkwork::description::{
    AxesDescription, Convention, FileError, LoadError, Problem, Severity, is_mechanism, load_text,
};
use linkwork::mechanism::Mechanism;
use linkwork::output::{Report, diagnostics, frames as output};
use linkwork::solve::Newton;
use linkwork::system::{Question, close};

use super::format::Format;
use super::watched::watched;
use super::{Answer, Refusal, style};

/// Place Denavit–Hartenberg frames on joint axes and read the tables off them.
///
/// The file gives the axes at home: `Axes(version: 1, name: "…", joints: { "q1": Revolute(point: (0, 0, 0), direction:
/// (0, 0, 1), home: 0), "q2": Prismatic(direction: (1, 0, 0)), … }, base: […], tool: […])`. Where joints say which bodies
/// they connect, as in `between: ("ground", "crank")`, loops are cut, at the joints of `cut: ["q3"]` or else where
/// that gives the simplest tables.
///
/// For a mechanism file it is the other way round: the joint axes that its tables describe, where it is assembled; with
/// --steps or --convention the tables that follow from these axes.
#[derive(Args)]
#[command(
    after_help = "Example: linkwork frames mechanisms/axes/puma560.ron --convention standard --format ron"
)]
pub struct Frames {
    /// The file of joint axes, or a mechanism file.
    file: PathBuf,
    /// The convention of the tables; that of the file, or else modified
    #[arg(long, value_enum)]
    convention: Option<Named>,
    /// Report the 14 steps of the Denavit–Hartenberg algorithm one by one
    #[arg(long)]
    steps: bool,
    /// How to write the answer
    #[arg(long, value_enum, default_value_t = FileFormat::Text)]
    format: FileFormat,
}

/// How often and from which seed a mechanism is closed again whose home is far from closed.
const RESTARTS: usize = 20;
const SEED: u64 = 1;

/// A convention by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Named {
    /// Rows (α(i−1), a(i−1), d(i), θ(i)), z of frame i along joint i.
    Modified,
    /// Rows (θ(i), d(i), a(i), α(i)), z of frame i−1 along joint i.
    Standard,
}

impl From<Named> for Convention {
    fn from(named: Named) -> Self {
        match named {
            Named::Modified => Convention::Modified,
            Named::Standard => Convention::Standard,
        }
    }
}

/// How a mechanism that was made is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FileFormat {
    /// To be read by people.
    Text,
    /// A mechanism file.
    Ron,
    /// To be read by programs: metres and radians with all digits, and the mechanism file.
    Json,
    /// To be read by people, for a page or a report.
    Markdown,
    /// To be read by people, as one page for a browser.
    Html,
}

impl FileFormat {
    /// The report in this format; a file by itself is written by `ron`.
    pub fn shown(
        self,
        report: &impl Report,
        ron: impl FnOnce() -> Result<String, Refusal>,
    ) -> Result<String, Refusal> {
        Ok(match self {
            FileFormat::Ron => ron()?,
            FileFormat::Text => Format::Text.shown(report),
            FileFormat::Json => Format::Json.shown(report),
            FileFormat::Markdown => Format::Markdown.shown(report),
            FileFormat::Html => Format::Html.shown(report),
        })
    }
}

impl Frames {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let refused = |error: LoadError| Refusal(format!("error: {error}\n"));
        let text = load_text(&self.file).map_err(refused)?;
        let wrong = |problems: Vec<Problem>| {
            let error = FileError {
                path: self.file.clone(),
                text: text.clone(),
                problems,
            };
            diagnostics::render(&error, style())
        };
        if is_mechanism(&text) {
            return self.axes_of_mechanism();
        }
        let axes = AxesDescription::read(&text).map_err(|problems| Refusal(wrong(problems)))?;
        self.tables(&axes, &wrong)
    }

    /// From axes to tables. `wrong` puts problems into words.
    fn tables(
        &self,
        axes: &AxesDescription,
        wrong: &dyn Fn(Vec<Problem>) -> String,
    ) -> Result<Answer, Refusal> {
        let settings = FramesSettings {
            convention: self.convention.map(Convention::from),
        };
        let report = frames(axes, &settings).map_err(|problems| Refusal(wrong(problems)))?;
        let unwritten =
            |error| Refusal(format!("error: the mechanism cannot be written: {error}\n"));
        let remarks = match report.warnings.is_empty() {
            true => String::new(),
            false => wrong(report.warnings.clone()),
        };
        let ron = report.description.to_ron();
        let ron = || ron.map_err(unwritten);
        let data = match self.steps {
            true => self.format.shown(&output::WithSteps(report), ron)?,
            false => self.format.shown(&report, ron)?,
        };
        Ok(Answer {
            data,
            remarks,
            yes: true,
        })
    }

    /// From tables to axes.
    fn axes_of_mechanism(&self) -> Result<Answer, Refusal> {
        let mechanism = Mechanism::load(&self.file).map_err(|error| {
            Refusal(match error {
                LoadError::Wrong(error) => diagnostics::render(&error, style()),
                other => format!("error: {other}\n"),
            })
        })?;
        let question = Question::new(&mechanism);
        // without closures every configuration is assembled
        let (at, gap) = match mechanism.closures().is_empty() {
            true => (mechanism.home(), false),
            false => {
                match watched(|watch| close(&question, &Newton::default(), (RESTARTS, SEED), watch))
                {
                    Ok(closed) => (closed.configuration, false),
                    Err(_) => (mechanism.home(), true),
                }
            }
        };
        let axes = joint_axes(&mechanism, &at)
            .map_err(|error| Refusal(output::no_axes(&error).render(style())))?;
        let unwritten = |error| Refusal(format!("error: the axes cannot be written: {error}\n"));
        if self.steps || self.convention.is_some() {
            // the axes have no text of their own that could be pointed at
            let wrong = |problems: Vec<Problem>| {
                let line = |problem: &Problem| {
                    let severity = match problem.severity() {
                        Severity::Error => "error",
                        Severity::Warning => "warning",
                    };
                    format!("{severity}: {}\n", problem.kind.title())
                };
                problems.iter().map(line).collect()
            };
            let mut answer = self.tables(&axes, &wrong)?;
            if gap {
                answer.remarks.insert_str(0, output::NOT_ASSEMBLED);
                answer.yes = false;
            }
            return Ok(answer);
        }
        Ok(Answer {
            data: {
                let ron = axes.to_ron();
                self.format
                    .shown(&AxesReport::from(axes), || ron.map_err(unwritten))?
            },
            remarks: match gap {
                true => output::NOT_ASSEMBLED.into(),
                false => String::new(),
            },
            yes: !gap,
        })
    }
}
