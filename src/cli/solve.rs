//! `linkwork solve`

use clap::Args;
use linkwork::analysis::assembly::AssemblySettings;
use linkwork::ask::Solved;

use super::question_options::{AnalysisArgs, Posed};
use super::report_format::Format;
use super::search_options::{SearchArgs, mode};
use super::{Answer, Refusal};

/// Find the assembled configuration near a guess.
///
/// The actuated joints are held at home and the rest is solved, unless --hold and --free say otherwise. A joint, a
/// coordinate of a platform (top.x, top.y, top.z, top.roll, top.pitch, top.yaw) or of a point, or a whole platform can
/// be held. Values are expressions as in the file, or `home`; a platform takes a list of displacements. If fewer
/// coordinates are held than the mechanism has freedoms, the rest changes as little from the start as closure allows,
/// in rad and characteristic lengths, and the answer gives the number of freedoms left open.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork solve mechanisms/four_bar.ron --hold theta1=\"60 deg\"\n  \
    linkwork solve mechanisms/four_bar.ron --mode 2 --hold theta1=\"60 deg\"\n  \
    linkwork solve mechanisms/three_rps.ron --free actuated --hold top.z=0.5 --hold top.roll=0 --hold top.pitch=0")]
pub struct Solve {
    /// Assemble this mode, numbered as `assemblies` lists it at the home values of the held coordinates, and follow it to
    /// their given values
    #[arg(long, value_name = "NUMBER", conflicts_with = "guess")]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    #[command(flatten)]
    search: SearchArgs,
}

impl AnalysisArgs for Solve {
    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.search.pose(&mut posed)?;
        posed.mode(self.mode);
        let settings = AssemblySettings::default();
        match posed.ask(|question, watch| question.solve(&settings, watch))? {
            Solved::Ended(report) => posed.loaded.answer(format, &*report),
            Solved::Lost(lost) => posed.loaded.answer(format, &*lost),
        }
    }
}
