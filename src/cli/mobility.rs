//! `linkwork mobility`

use clap::Args;
use linkwork::analysis::mobility::MobilitySettings;
use linkwork::ask::Question;

use super::asked::Asked;
use super::format::{Format, readable};
use super::search::seed;
use super::source::Source;
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
    /// How to write the answer; where there is none, stderr says why as text
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Mobility {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        posed.ask_with(|question| question.seed(self.seed));
        posed.answer(self.format, Question::mobility)
    }
}
