//! `linkwork velocity`

use clap::Args;
use linkwork::analysis::velocity::{VelocitySettings, velocity};
use linkwork::mechanism::Body;
use linkwork::output::closing as analysed;
use linkwork::output::question::motionless_frame;
use linkwork::system::Drive;

use super::asked::{Asked, driven, frame, refusal, refused_frame};
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
        let mechanism = &loaded.mechanism;
        let question = self.asked.question(mechanism)?;
        once("--rate", &self.rate)?;
        once("--acceleration", &self.acceleration)?;
        let mut drive = Drive::still(&question);
        for assignment in &self.rate {
            let Assignment { name, value } = assignment;
            drive = (drive.rate(&question, name, value))
                .map_err(|error| driven(&error, assignment.given("--rate")))?;
        }
        for assignment in &self.acceleration {
            let Assignment { name, value } = assignment;
            drive = (drive.acceleration(&question, name, value))
                .map_err(|error| driven(&error, assignment.given("--acceleration")))?;
        }
        let points = self.point.iter().map(|name| {
            let frame = frame(mechanism, name, "--point")?;
            match mechanism.body(frame) {
                Body::Ground => Err(refused_frame(name, "--point", motionless_frame(name))),
                _ => Ok(frame),
            }
        });
        let settings = VelocitySettings {
            points: points.collect::<Result<_, _>>()?,
            ..VelocitySettings::default()
        };
        let report = watched(|watch| velocity(&question, &drive, &settings, watch))
            .map_err(|error| refusal(&error, None))?;
        let yes = report.report();
        let warning = yes.map(|report| analysed::limits_warning(&report.outside_limits));
        let yes = yes.is_some_and(|report| report.is_determined());
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes,
        })
    }
}
