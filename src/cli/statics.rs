//! `linkwork statics`

use clap::Args;
use linkwork::ask::Role;
use linkwork::output::closing as analysed;

use super::asked::Asked;
use super::format::Written;
use super::source::{Assignment, Source};
use super::watched::watched;
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
    /// Force in N and moment in N·m at the origin of a frame, in ground, e.g. --wrench top=0,0,-100,0,0,5
    #[arg(
        long,
        value_name = "FRAME=Fx,Fy,Fz[,Mx,My,Mz]",
        allow_hyphen_values = true
    )]
    wrench: Vec<Assignment>,
    /// Force in N or moment in N·m along a joint variable, e.g. --load phi1=2
    #[arg(long, value_name = "JOINT=FORCE")]
    load: Vec<Assignment>,
    #[command(flatten)]
    format: Written,
}

impl Statics {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mut posed = self.asked.pose(&loaded);
        for given in &self.wrench {
            posed.value(Role::Wrench, "--wrench", given);
            posed.question = posed.question.wrench_text(&given.name, &given.value);
        }
        for given in &self.load {
            posed.value(Role::Load, "--load", given);
            posed.question = posed.question.load(&given.name, &given.value);
        }
        let report = watched(|watch| posed.question.statics(watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let yes = report.report();
        let warning = yes.map(|report| analysed::limits_warning(&report.outside_limits));
        let yes = yes.is_some_and(|report| {
            let (gap, length) = (report.given_gap.as_ref(), report.normalising_length);
            report.unbalanced.is_empty() && analysed::is_about_the_file(report.kept, gap, length)
        });
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes,
        })
    }
}
