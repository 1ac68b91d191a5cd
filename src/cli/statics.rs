//! `linkwork statics`

use clap::Args;
use linkwork::ask::{Question, Role};

use super::asked::Asked;
use super::format::{Format, readable};
use super::source::{Assignment, Source};
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
    /// Force in N and moment in N·m, in ground, at a frame's origin or at a point beside it in its axes, e.g. --wrench
    /// top=0,0,-100,0,0,5 or --wrench left+0.5,0.2=0,-10,0
    #[arg(
        long,
        value_name = "FRAME[+X,Y,Z]=Fx,Fy,Fz[,Mx,My,Mz]",
        allow_hyphen_values = true
    )]
    wrench: Vec<Assignment>,
    /// Force in N or moment in N·m along a joint variable, e.g. --load phi1=2
    #[arg(long, value_name = "JOINT=FORCE")]
    load: Vec<Assignment>,
    /// How to write the answer; where there is none, stderr says why as text
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Statics {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        posed.values(
            Role::Wrench,
            "--wrench",
            &self.wrench,
            Question::wrench_text,
        );
        posed.values(Role::Load, "--load", &self.load, Question::load);
        posed.answer(self.format, Question::statics)
    }
}
