//! `linkwork mobility`

use clap::Args;
use linkwork::analysis::mobility::MobilitySettings;
use linkwork::ask::{Question, Role};

use super::asked::Asked;
use super::format::{Format, readable};
use super::search::seed;
use super::source::Source;
use super::{Answer, Refusal};

/// Count the freedoms of the assembled mechanism, and say which joints move and what is redundant.
///
/// The mechanism is closed first, at the values that --hold, --free and --guess ask for: they choose the configuration
/// and nothing else. Then everything is free to move, held or not, but what --lock names, which stands still where it
/// is. A freedom counts if a finite step along it closes, not only an infinitesimal one.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork mobility mechanisms/bennett.ron\n  \
    linkwork mobility mechanisms/three_rps.ron --lock actuated\n  \
    linkwork mobility mechanisms/three_rps.ron --hold l1=0.7 --lock l1 --lock l2")]
pub struct Mobility {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Lock a joint, a platform coordinate or a platform where it is; `actuated` locks all actuated joints
    #[arg(long, value_name = "NAME")]
    lock: Vec<String>,
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
        posed.names(Role::Lock, "--lock", &self.lock, Question::lock);
        posed.ask_with(|question| question.seed(self.seed));
        posed.answer(self.format, Question::mobility)
    }
}
