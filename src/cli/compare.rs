//! `linkwork compare`

use clap::Args;
use linkwork::analysis::compare::CompareSettings;
use linkwork::ask::Question;

use super::format::Written;
use super::search::seed;
use super::source::Source;
use super::watched::watched;
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
    /// How many random configurations to try beside home
    #[arg(long, value_name = "COUNT", default_value_t = CompareSettings::default().samples)]
    samples: usize,
    /// Seed of the random configurations
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = CompareSettings::default().seed)]
    seed: u64,
    #[command(flatten)]
    format: Written,
}

impl Compare {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let question = Question::new(loaded.mechanism.clone()).seed(self.seed);
        let report = watched(|watch| question.compare(self.samples, watch));
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings(),
            yes: report.agree,
        })
    }
}
