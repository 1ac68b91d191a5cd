//! `linkwork statics`

use clap::Args;
use linkwork::analysis::statics::{StaticsSettings, statics};
use linkwork::mechanism::Mechanism;
use linkwork::output::{closing as analysed, statics as output};
use linkwork::system::{Load, LoadError};

use super::asked::{Asked, refusal};
use super::format::Written;
use super::source::{Assignment, Source};
use super::watched::watched;
use super::{Answer, Refusal, style};

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
        let mechanism = &loaded.mechanism;
        let question = self.asked.question(mechanism)?;
        let mut load = Load::default();
        for assignment in &self.wrench {
            let Assignment { name, value } = assignment;
            load = (load.wrench(&question, name, value))
                .map_err(|error| wrong(mechanism, &error, assignment, "--wrench"))?;
        }
        for assignment in &self.load {
            let Assignment { name, value } = assignment;
            load = (load.joint(&question, name, value))
                .map_err(|error| wrong(mechanism, &error, assignment, "--load"))?;
        }
        let report = watched(|watch| statics(&question, &load, &StaticsSettings::default(), watch))
            .map_err(|error| refusal(&error, None))?;
        let yes = report.report();
        let warning = yes.map(|report| analysed::limits_warning(&report.outside_limits));
        let yes = yes.is_some_and(|report| report.unbalanced.is_empty());
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes,
        })
    }
}

fn wrong(mechanism: &Mechanism, error: &LoadError, given: &Assignment, option: &str) -> Refusal {
    let (complaint, part) = output::complaint(mechanism, error, option);
    Refusal(complaint.render_in(&given.given(option), &part, style()))
}
