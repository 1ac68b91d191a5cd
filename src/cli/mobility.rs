//! `linkwork mobility`

use clap::Args;
use linkwork::analysis::mobility::MobilitySettings;
use linkwork::ask::{Question, Role};

use super::question_options::{AnalysisArgs, Posed};
use super::report_format::Format;
use super::search_options::seed;
use super::{Answer, Refusal};

/// Find the mobility of the assembled mechanism, the joints that move, and redundant constraints.
///
/// The mechanism is closed first; --hold, --free and --guess choose the configuration and nothing else. Then every joint is
/// free to move, held or not, except those of --lock, which stand still. A freedom counts if a finite step along it closes,
/// not only an infinitesimal one.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork mobility mechanisms/bennett.ron\n  \
    linkwork mobility mechanisms/three_rps.ron --lock actuated\n  \
    linkwork mobility mechanisms/three_rps.ron --hold l1=0.7 --lock l1 --lock l2")]
pub struct Mobility {
    /// Lock a joint, a platform coordinate or a platform where it is; `actuated` locks all actuated joints
    #[arg(long, value_name = "NAME")]
    lock: Vec<String>,
    /// Seed of all random directions, and of the search for a mode
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = MobilitySettings::default().seed)]
    seed: u64,
}

impl AnalysisArgs for Mobility {
    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        posed.names(Role::Lock, &self.lock);
        posed.ask_with(|question| question.seed(self.seed));
        posed.answer(format, Question::mobility)
    }
}
