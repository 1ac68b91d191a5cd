//! `linkwork compare`

use clap::Args;
use linkwork::analysis::compare::CompareSettings;

use super::question_options::Posed;
use super::report_format::{Format, readable};
use super::search_options::seed;
use super::source::Source;
use super::{Answer, Refusal};

/// Check every closed form of a mechanism file against its chains.
///
/// They are compared at the solved home configuration and at random joint values within the limits; identities, which
/// hold only when the mechanism is assembled, at random assembled configurations.
#[derive(Args)]
#[command(after_help = "Example: linkwork compare mechanisms/three_rps.ron --samples 1000")]
pub struct Compare {
    #[command(flatten)]
    source: Source,
    /// Number of random configurations besides home
    #[arg(long, value_name = "COUNT", default_value_t = CompareSettings::default().samples)]
    samples: usize,
    /// Seed of the random configurations
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = CompareSettings::default().seed)]
    seed: u64,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Compare {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = Posed::new(&self.source)?;
        posed.ask_with(|question| question.seed(self.seed));
        posed.answer(self.format, |question, watch| {
            Ok(question.compare(self.samples, watch))
        })
    }
}
