//! `linkwork check`

use clap::Args;
use linkwork::analysis::overview::overview;

use super::format::Written;
use super::source::Source;
use super::{Answer, Refusal};

/// Say what a mechanism file means, or everything that is wrong with it.
///
/// Prints parameters, joints, the Denavit–Hartenberg tables as a lecture draws them, platforms, closures with the
/// equations they add, loops and the Kutzbach count. Warnings go to stderr.
#[derive(Args)]
#[command(after_help = "Example: linkwork check mechanisms/four_bar.ron --set l2=3.5")]
pub struct Check {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    format: Written,
}

impl Check {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let report = overview(&loaded.mechanism);
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings(),
            yes: true,
        })
    }
}
