//! `linkwork velocity`

use clap::Args;
use linkwork::ask::{Question, Role};

use super::question_options::{AnalysisArgs, Posed};
use super::report_format::Format;
use super::source::Assignment;
use super::{Answer, Refusal};

/// Find rates, accelerations and the input–output Jacobian for given rates of the inputs.
///
/// The mechanism is closed first, at the values the options ask for. Held coordinates are driven: rates in m/s or rad/s,
/// accelerations in m/s² or rad/s²; those without a rate stand still.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork velocity mechanisms/three_rps.ron --rate l1=0.1\n  \
    linkwork velocity mechanisms/four_bar.ron --rate theta1=1 --point left+0.5,0.2")]
pub struct Velocity {
    /// Rate of a held joint or coordinate, e.g. --rate l1=0.1; where the orientation of a platform is held, its angular
    /// velocity about ground axes, e.g. --rate top.wx=0.1
    #[arg(long, value_name = "NAME=RATE")]
    rate: Vec<Assignment>,
    /// Acceleration of a held joint or coordinate, e.g. --acceleration l1=0.02
    #[arg(long, value_name = "NAME=ACCELERATION")]
    acceleration: Vec<Assignment>,
    /// Also report the velocity of a frame's origin, or of a point beside it in its axes, e.g. --point left+0.5,0.2
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    point: Vec<String>,
}

impl AnalysisArgs for Velocity {
    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        posed.values(Role::Rate, &self.rate);
        posed.values(Role::Acceleration, &self.acceleration);
        posed.names(Role::Point, &self.point);
        posed.answer(format, Question::velocity)
    }
}
