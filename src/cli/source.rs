//! The mechanism file a command works on.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use clap::Args;
use linkwork::description::{Description, LoadError, MAX_BYTES};
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::{Complaint, Given};
use linkwork::output::rounding::{Prefaced, sentence};
use linkwork::output::{JsonReport, diagnostics};
use linkwork::view::Viewed;

use super::read::{called, help, is_stdin, text};
use super::report_format::Format;
use super::{Answer, Refusal, lines, style};

#[derive(Args)]
pub struct Source {
    /// The mechanism file: tables, or joint coordinates; `-` reads standard input
    file: PathBuf,
    /// Give a parameter another value: a number or an expression as in the file, e.g. --set l2="3.5 m"
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<Assignment>,
    /// The most by which any number of the file may be off, e.g. --tolerance "0.01 mm"; otherwise half a unit of its last digit
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<String>,
    /// Largest file to read, in bytes: a guard against mistaken files
    #[arg(long, value_name = "BYTES", default_value_t = MAX_BYTES)]
    max_bytes: u64,
}

/// `NAME=VALUE`
#[derive(Clone, Debug)]
pub struct Assignment {
    pub name: String,
    pub value: String,
}

impl FromStr for Assignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((name, value)) if !name.trim().is_empty() => Ok(Assignment {
                name: name.trim().into(),
                value: value.into(),
            }),
            _ => Err("write NAME=VALUE".into()),
        }
    }
}

impl Assignment {
    pub fn given<'a>(&'a self, option: &'a str) -> Given<'a> {
        Given::new(option, &self.name, Some(&self.value))
    }
}

/// Refuses an option that gives two values to one name.
pub fn refuse_repeats(option: &str, given: &[Assignment]) -> Result<(), Refusal> {
    for (i, second) in given.iter().enumerate() {
        if let Some(first) = given[..i].iter().find(|first| first.name == second.name) {
            let [one, other] =
                [first, second].map(|a| format!("`{option} {}={}`", a.name, a.value));
            let title = format!("{one} and {other} contradict one another");
            let said = Complaint::new(title).help("give only one of them");
            return Err(Refusal(said.render_in(&second.given(option), style())));
        }
    }
    Ok(())
}

pub struct LoadedFile {
    path: PathBuf,
    /// The parameters that `--set` gave another value.
    pub set: Vec<String>,
    text: String,
    /// Description of the file, with changes by `--set`.
    pub description: Description,
    pub mechanism: Arc<Mechanism>,
}

impl Source {
    /// A file with other values of parameters.
    pub fn new(file: PathBuf, set: Vec<Assignment>) -> Self {
        Source {
            file,
            set,
            tolerance: None,
            max_bytes: MAX_BYTES,
        }
    }

    /// Reads the file, or says everything that is wrong with it or with `--set`.
    pub fn load(&self) -> Result<LoadedFile, Refusal> {
        let path = called(&self.file);
        let (text, mut description) =
            Mechanism::read_text(&path, text(&self.file, self.max_bytes)?)?;
        refuse_repeats("--set", &self.set)?;
        if let Some(tolerance) = &self.tolerance {
            description = description.with_tolerance(tolerance).ok_or_else(|| {
                let title = format!("`--tolerance {tolerance}` is no length, such as `0.01 mm`");
                Refusal::from(Complaint::new(title))
            })?;
        }
        let set: Vec<Given> = self.set.iter().map(|set| set.given("--set")).collect();
        let made = diagnostics::made(&path, &text, description, &set, style());
        let (description, mechanism) = made.map_err(Refusal)?;
        Ok(LoadedFile {
            path,
            set: self.set.iter().map(|given| given.name.clone()).collect(),
            text,
            description,
            mechanism: Arc::new(mechanism),
        })
    }

    /// The file as a page shows it, with its problems if it has any.
    pub fn viewed(&self) -> Result<Viewed, Refusal> {
        let called = called(&self.file);
        let file = called.file_name().unwrap_or_default();
        let set = self.set.iter();
        Ok(Viewed {
            file: file.to_string_lossy().into_owned(),
            text: text(&self.file, self.max_bytes)?,
            set: set.map(|s| (s.name.clone(), s.value.clone())).collect(),
            watch: false,
        })
    }

    pub fn beside(&self, ending: &str) -> PathBuf {
        match is_stdin(&self.file) {
            true => Path::new("linkwork").with_extension(ending),
            false => self.file.with_extension(ending),
        }
    }
}

/// A file that cannot be read, or everything that is wrong in it.
impl From<LoadError> for Refusal {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Wrong(error) => Refusal(diagnostics::render(&error, style())),
            LoadError::TooLarge { .. } => Refusal::error(format!(
                "{error}\n  = help: --max-bytes allows more, if it is a mechanism"
            )),
            other => {
                let help = help(&other).map(|help| format!("\n  = help: {help}"));
                Refusal::error(format!("{other}{}", help.unwrap_or_default()))
            }
        }
    }
}

impl LoadedFile {
    pub fn answer(&self, format: Format, report: &impl JsonReport) -> Result<Answer, Refusal> {
        let report = self.prefaced(report);
        Ok(format.answer(&report)?.after(self.warnings_beside(format)))
    }

    pub fn excerpt(&self, span: &std::ops::Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    /// A report that says first what the rounding of the file's numbers means.
    pub fn prefaced<R>(&self, report: R) -> Prefaced<R> {
        Prefaced::new(&self.mechanism, report)
    }

    /// The warnings about the file, and what its rounding means; empty if there is nothing to say.
    pub fn warnings(&self) -> String {
        let rounding = self.mechanism.rounding().map(sentence);
        self.warnings_beside(Format::Text) + &lines("note", rounding)
    }

    /// Remarks beside a report that is prefaced and written in a format.
    pub fn warnings_beside(&self, format: Format) -> String {
        match format {
            Format::Csv | Format::Ron => self.warnings(),
            _ => diagnostics::warnings(&self.mechanism, &self.path, &self.text, style()),
        }
    }
}
