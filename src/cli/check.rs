//! `linkwork check`

use clap::Args;
use linkwork::analysis::overview::overview;
use linkwork::output::overview::latex;

use super::report_format::{Format, readable};
use super::source::Source;
use super::{Answer, Refusal};

/// Print what a mechanism file describes, or list every error in it.
///
/// Prints parameters, joints, the Denavit–Hartenberg tables in textbook form, platforms, closures with the
/// equations they add, loops and the Kutzbach count. Warnings go to stderr.
#[derive(Args)]
#[command(after_help = "Example: linkwork check mechanisms/four_bar.ron --set l2=3.5")]
pub struct Check {
    #[command(flatten)]
    source: Source,
    /// Write the Denavit–Hartenberg tables as LaTeX, for the packages booktabs and amsmath
    #[arg(long, conflicts_with = "format")]
    latex: bool,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Check {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let overview = overview(&loaded.mechanism);
        let mut answer = loaded.answer(self.format, &overview)?;
        if self.latex {
            answer.data = latex::tables(&overview, &loaded.mechanism.names_in_formulas());
        }
        Ok(answer)
    }
}
