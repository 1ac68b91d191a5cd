//! `linkwork statics`

use clap::Args;
use linkwork::ask::Question;

use super::asked::{Asked, Forces};
use super::format::{Format, readable};
use super::source::Source;
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
    source: Source,
    #[command(flatten)]
    asked: Asked,
    #[command(flatten)]
    forces: Forces,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Statics {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.forces.pose(&mut posed);
        posed.answer(self.format, Question::statics)
    }
}
