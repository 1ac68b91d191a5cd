//! `linkwork solve`

use clap::Args;
use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::system::check_count;

use super::asked::{Asked, refusal};
use super::search::{Search, mode};
use super::source::Source;
use super::watched::watched;
use super::format::Written;
use super::{Answer, Refusal};

/// Find the assembled configuration near a guess.
///
/// The actuated joints are held at home and the rest is solved, unless --hold and --free say otherwise. What is held is
/// a joint, a coordinate of a platform (top.x, top.y, top.z, top.roll, top.pitch, top.yaw) or a whole platform. Values
/// are expressions as in the file, or `home`; a platform takes a list of displacements.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork solve mechanisms/four_bar.ron --hold theta1=\"60 deg\"\n  \
    linkwork solve mechanisms/four_bar.ron --mode 2 --hold theta1=\"60 deg\"\n  \
    linkwork solve mechanisms/three_rps.ron --free actuated --hold top.z=0.5 --hold top.roll=0 --hold top.pitch=0")]
pub struct Solve {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Assemble this mode of the home configuration, numbered as `assemblies` lists it there, followed to what is held
    #[arg(long, value_name = "NUMBER", conflicts_with = "guess")]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    #[command(flatten)]
    search: Search,
    #[command(flatten)]
    format: Written,
}

impl Solve {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let question = self.asked.question(&loaded.mechanism)?;
        let mut settings = AssemblySettings {
            seed: self.search.seed,
            ..AssemblySettings::default()
        };
        let mut question = question;
        if let Some(mode) = self.mode {
            check_count(&question).map_err(|error| refusal(&error, None))?;
            let followed = watched(|watch| {
                let solver = self.search.solver(&question, watch)?;
                let followed = solver.follow(mode, &question.start(), &question.held(), watch);
                followed.map_err(|error| Refusal(format!("error: {error}\n")))
            })?;
            match followed.arrived(&loaded.mechanism, mode) {
                Ok(at) => question = question.near(&at),
                Err(lost) => {
                    return Ok(Answer {
                        data: self.format.shown(&*lost),
                        remarks: loaded.warnings(),
                        yes: false,
                    });
                }
            }
            // another start could end in another mode
            settings.restarts = 0;
        }
        let report = watched(|watch| assemble(&question, &settings, watch))
            .map_err(|error| refusal(&error, None))?;
        let warning = report.warning();
        let warning = warning.map(|warning| format!("warning: {warning}\n"));
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes: report.outcome == Outcome::Converged,
        })
    }
}
