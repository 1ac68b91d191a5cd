//! `linkwork statics`

use clap::Args;
use linkwork::ask::Question;

use super::question_options::{AnalysisArgs, Forces, Posed};
use super::report_format::Format;
use super::{Answer, Refusal};

/// Find the actuator forces that balance a load, and the reactions in all joints and closures.
///
/// The mechanism is closed first, at the values the options ask for. Weights, springs and forces of the file
/// act too, unless --without leaves them out. Held coordinates carry the load; where joints have friction, the forces are
/// shown between which the mechanism stays at rest. In an overconstrained mechanism, forces that equilibrium does not determine are the
/// minimum-norm choice and are marked.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork statics mechanisms/three_rps.ron --wrench top=0,0,-100\n  \
    linkwork statics mechanisms/four_bar.ron --load phi1=2")]
pub struct Statics {
    #[command(flatten)]
    forces: Forces,
}

impl AnalysisArgs for Statics {
    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.forces.pose(&mut posed);
        posed.answer(format, Question::statics)
    }
}
