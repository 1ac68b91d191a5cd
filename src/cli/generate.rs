//! `linkwork generate`

use std::path::PathBuf;

use clap::Args;
use linkwork::ask::SolverSettings;
use linkwork::output::solver::{Code, Language, Precision};

use super::output_files::{fits, save, written};
use super::question_options::{self, Forces, QuestionOptions};
use super::source::Source;
use super::{Answer, Refusal};

/// Write a solver for one question as source code, C or Rust, without dependencies.
///
/// The inputs of the solver are the held coordinates: the actuated joints, unless --hold and --free say otherwise; at
/// their values the order of elimination is chosen. The solver returns the state: every other joint, and the position and
/// unit quaternion of every platform. It follows the assembly near the start, or the one of --mode. Lengths are in m, angles in rad.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork generate mechanisms/four_bar.ron --lang c --output four_bar.h --with-test\n  \
    linkwork generate mechanisms/three_rps.ron --lang rust --frame top\n  \
    linkwork generate mechanisms/loads/engine.ron --lang c --dynamics --output engine.h --with-test")]
pub struct Generate {
    #[command(flatten)]
    source: Source,
    /// The language
    #[arg(long, value_enum)]
    lang: Language,
    /// The floating-point numbers
    #[arg(long, value_enum, default_value = "double")]
    precision: Precision,
    /// Add the pose of a frame and its twists for unit rates of the inputs, e.g. --frame top.S1
    #[arg(long, value_name = "FRAME")]
    frame: Vec<String>,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write a program that checks the solver at this many configurations computed by linkwork
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "100",
        requires = "output", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    with_test: Option<u32>,
    /// Add a function for the forces that drive the inputs against weights, springs, dampers, given forces and inertia
    #[arg(long)]
    dynamics: bool,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    asked: QuestionOptions,
    /// Solve in this mode, numbered as `assemblies` lists it
    #[arg(long, value_name = "NUMBER")]
    mode: Option<usize>,
}

impl Generate {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let endings: &[&str] = match self.lang {
            Language::C => &["h", "c"],
            Language::Rust => &["rs"],
        };
        let output = self.output.as_deref();
        output
            .map_or(Ok(()), |path| fits(path, endings))
            .map_err(Refusal::error)?;
        let mut posed = self.asked.pose(&self.source)?;
        posed.mode(self.mode);
        self.forces.pose(&mut posed);
        let mechanism = posed.question.mechanism().clone();
        let named = |name: &String| {
            Ok((
                name.clone(),
                question_options::frame(&mechanism, name, "--frame")?,
            ))
        };
        let frames = self.frame.iter().map(named);
        let settings = SolverSettings {
            frames: frames.collect::<Result<_, Refusal>>()?,
            forces: self.dynamics,
        };
        let solver = posed.ask(|question, watch| question.solver_program(&settings, watch))?;
        let code = Code {
            language: self.lang,
            precision: self.precision,
            name: identifier(self.output.as_ref().unwrap_or(&self.source.beside(""))),
        };
        if let (Some(count), Some(path)) = (self.with_test, &self.output) {
            let examples = posed.ask(|question, watch| question.examples(count as usize, watch))?;
            let forces = match self.dynamics {
                true => posed.ask(|question, watch| question.example_forces(&examples, watch))?,
                false => Vec::new(),
            };
            let test = format!("{}_test.{}", code.name, code.language.program_ending());
            let path = path.with_file_name(test);
            save(&path, code.test(&solver, &examples, &forces).as_bytes())?;
        }
        let data = written(code.solver(&solver), output)?;
        Ok(Answer::yes(data, posed.loaded.warnings()))
    }
}

/// A name for functions, from that of a file.
fn identifier(path: &std::path::Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let stem = stem.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    let name = stem.to_ascii_lowercase();
    match name.starts_with(|c: char| c.is_ascii_lowercase()) {
        true => name,
        false => format!("solver_{name}"),
    }
}
