//! `linkwork snap`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::rounding::snap;

use super::output_files::{file, written};
use super::report_format::{Format, with_file};
use super::source::Source;
use super::{Answer, Refusal};

/// Write the nearest linkage whose loops close exactly, where those of a file close only within the rounding of its numbers.
///
/// A number is off by at most half a unit of its last digit, or by --tolerance. Lists every number that is changed.
#[derive(Args)]
#[command(after_help = "Example: linkwork snap drawing.ron -o exact.ron")]
pub struct Snap {
    #[command(flatten)]
    source: Source,
    /// Write the file here instead of into the answer
    #[arg(short, long, value_name = "FILE", value_parser = file(&["ron"]))]
    output: Option<PathBuf>,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = with_file())]
    format: Format,
}

impl Snap {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let snap = snap(&loaded.description, &loaded.mechanism);
        if let Some(path) = &self.output {
            written(snap.file.clone(), Some(path))?;
        }
        Ok(self
            .format
            .answer(&snap)?
            .after(loaded.warnings_beside(Format::Text)))
    }
}
