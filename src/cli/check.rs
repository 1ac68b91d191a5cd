//! `linkwork check`

use clap::Args;
use linkwork::analysis::overview::overview;

use super::format::{Format, readable};
use super::source::Source;
use super::{Answer, Refusal};

/// Describe what a mechanism file says, or everything that is wrong with it.
///
/// Prints parameters, joints, the Denavit–Hartenberg tables as a lecture draws them, platforms, closures with the
/// equations they add, loops and the Kutzbach count. Warnings go to stderr.
#[derive(Args)]
#[command(after_help = "Example: linkwork check mechanisms/four_bar.ron --set l2=3.5")]
pub struct Check {
    #[command(flatten)]
    source: Source,
    /// How to write the answer; where there is none, stderr says why as text
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Check {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        loaded.answer(self.format, &overview(&loaded.mechanism))
    }
}
