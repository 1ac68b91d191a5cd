//! `linkwork solve`

use clap::Args;
use linkwork::analysis::assembly::{AssemblySettings, Outcome};
use linkwork::ask::{Mode, Solved};

use super::asked::Asked;
use super::format::Written;
use super::search::{Search, mode};
use super::source::Source;
use super::watched::watched;
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
    /// Assemble this mode: numbered as `assemblies` lists it at the home values of what is held, then followed to the
    /// values held
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
        let mut posed = self.asked.pose(&loaded);
        self.search.pose(&mut posed)?;
        let mode = self.mode.map_or(Mode::Nearest, Mode::Number);
        let question = posed.question.clone().mode(mode);
        let settings = AssemblySettings::default();
        let solved = watched(|watch| question.solve(&settings, watch));
        let report = match solved.map_err(|error| posed.refusal(&error))? {
            Solved::Ended(report) => report,
            Solved::Lost(lost) => {
                return Ok(Answer {
                    data: self.format.shown(&*lost),
                    remarks: loaded.warnings(),
                    yes: false,
                });
            }
        };
        let warning = report.warning();
        let warning = warning.map(|warning| format!("warning: {warning}\n"));
        Ok(Answer {
            data: self.format.shown(&*report),
            remarks: loaded.warnings() + &warning.unwrap_or_default(),
            yes: report.outcome == Outcome::Converged,
        })
    }
}
