//! `linkwork velocity`

use clap::Args;
use linkwork::ask::Role;
use linkwork::output::closing as analysed;

use super::asked::Asked;
use super::format::Written;
use super::source::{Assignment, Source, once};
use super::watched::watched;
use super::{Answer, Refusal};

/// Find how everything moves when the inputs move: rates, accelerations, Jacobian.
///
/// The mechanism is closed first, at the values the options ask for. What is held is driven: rates in m/s or rad/s,
/// accelerations in m/s² or rad/s²; what is given none stands still.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork velocity mechanisms/three_rps.ron --rate l1=0.1\n  \
    linkwork velocity mechanisms/four_bar.ron --rate theta1=1 --point left")]
pub struct Velocity {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Rate of a held joint or coordinate, e.g. --rate l1=0.1; where the orientation of a platform is held, its angular
    /// velocity about axes of ground, e.g. --rate top.wx=0.1
    #[arg(long, value_name = "NAME=RATE")]
    rate: Vec<Assignment>,
    /// Acceleration of a held joint or coordinate, e.g. --acceleration l1=0.02
    #[arg(long, value_name = "NAME=ACCELERATION")]
    acceleration: Vec<Assignment>,
    /// Follow the origin of a frame too, e.g. --point top.S1
    #[arg(long, value_name = "FRAME")]
    point: Vec<String>,
    #[command(flatten)]
    format: Written,
}

impl Velocity {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mut posed = self.asked.pose(&loaded);
        once("--rate", &self.rate)?;
        once("--acceleration", &self.acceleration)?;
        for given in &self.rate {
            posed.value(Role::Rate, "--rate", given);
            posed.question = posed.question.rate(&given.name, &given.value);
        }
        for given in &self.acceleration {
            posed.value(Role::Acceleration, "--acceleration", given);
            posed.question = posed.question.acceleration(&given.name, &given.value);
        }
        for name in &self.point {
            posed.name(Role::Point, "--point", name);
            posed.question = posed.question.point(name);
        }
        let report = watched(|watch| posed.question.velocity(watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let yes = report.report();
        let warning = yes.map(|report| analysed::limits_warning(&report.outside_limits));
        let yes = yes.is_some_and(|report| {
            let (gap, length) = (report.given_gap.as_ref(), report.normalising_length);
            report.is_determined() && analysed::is_about_the_file(report.kept, gap, length)
        });
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes,
        })
    }
}
