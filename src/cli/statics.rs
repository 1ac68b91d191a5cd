//! `linkwork statics`

use clap::Args;
use linkwork::ask::Question;

use super::asked::{Asked, Forces};
use super::format::{Format, readable};
use super::source::Source;
use super::{Answer, Refusal};

/// Find the actuator forces that balance a load, and what every joint has to carry.
///
/// The mechanism is closed first, at the values the options ask for. Bodies have no weight and joints no friction. What
/// is held carries the load; where a mechanism is overconstrained, forces that equilibrium leaves open are those of least
/// norm, and said to be.
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
    /// How to write the answer; where there is none, stderr says why as text
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
