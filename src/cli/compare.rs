//! `linkwork compare`: the closed forms of a file beside its chains.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use linkwork::analysis::compare::{CompareSettings, compare};
use linkwork::description::LoadError;
use linkwork::mechanism::Mechanism;
use linkwork::output::comparison;

/// Check every closed form of a mechanism file against its chains.
///
/// Exit code 0 if all agree or there are none, 1 if one does not.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The mechanism file.
    file: PathBuf,
    /// How many random joint values to try beside the home configuration.
    #[arg(long, value_name = "COUNT", default_value_t = CompareSettings::default().samples)]
    samples: usize,
    /// Seed of the random joint values.
    #[arg(long, default_value_t = CompareSettings::default().seed)]
    seed: u64,
    /// How the answer is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// How an answer is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    Text,
    /// For programs.
    Json,
}

/// Compares and prints.
///
/// # Errors
/// If the file cannot be read or is wrong.
pub fn run(args: &Args) -> Result<ExitCode, LoadError> {
    let mechanism = Mechanism::load(&args.file)?;
    let settings = CompareSettings {
        samples: args.samples,
        seed: args.seed,
        ..CompareSettings::default()
    };
    let report = compare(&mechanism, &settings);
    match args.format {
        Format::Text => print!("{}", comparison::text(&mechanism, &report)),
        Format::Json => println!("{:#}", comparison::json(&mechanism, &report)),
    }
    Ok(ExitCode::from(u8::from(!report.agree)))
}
