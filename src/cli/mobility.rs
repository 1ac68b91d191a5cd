//! `linkwork mobility`

use clap::Args;
use linkwork::analysis::mobility::MobilitySettings;
use linkwork::output::closing as analysed;

use super::asked::Asked;
use super::format::Written;
use super::search::seed;
use super::source::Source;
use super::watched::watched;
use super::{Answer, Refusal};

/// Count the freedoms of the assembled mechanism, and say which joints move and what is redundant.
///
/// The mechanism is closed first, at the values the options ask for; then everything is free to move. A freedom counts
/// if a finite step along it closes, not only an infinitesimal one.
#[derive(Args)]
#[command(after_help = "Example: linkwork mobility mechanisms/bennett.ron")]
pub struct Mobility {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Seed of all random starts and directions
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = MobilitySettings::default().seed)]
    seed: u64,
    #[command(flatten)]
    format: Written,
}

impl Mobility {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let posed = self.asked.pose(&loaded);
        let question = posed.question.clone().seed(self.seed);
        let report = watched(|watch| question.mobility(watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let yes = report.report();
        let warning = yes.map(|report| analysed::limits_warning(&report.outside_limits));
        let yes = yes.is_some_and(|report| {
            analysed::is_about_the_file(report.kept, report.given.as_ref(), report.length)
        });
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes,
        })
    }
}
