//! `linkwork singularities`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::ask::Role;
use linkwork::output::singularities as output;

use super::output_files::{file, save};
use super::question_options::{AnalysisArgs, Posed};
use super::report_format::Format;
use super::search_options::{SearchArgs, mode};
use super::source::Assignment;
use super::{Answer, Refusal};
use linkwork::output::complaint::Ranged;

/// Find singularities: at a configuration, along inputs, or as curves in two inputs.
///
/// The inputs are the held joints, and the outputs the platforms; without platforms, the joints on the ground that are not
/// driven, or else the points where chains are joined. If coordinates of platforms are held or moved, these are the
/// outputs, and the actuated joints are free and are the inputs. Every singularity is located to rounding accuracy and
/// classified by type (Gosselin and Angeles 1, 2, 3; Zlatanov, Fenton and Benhabib), by the freedoms lost and gained, and
/// by what moves.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork singularities mechanisms/parallelogram.ron --hold theta1=0\n  \
    linkwork singularities mechanisms/four_bar.ron --input theta1=0deg..360deg\n  \
    linkwork singularities mechanisms/three_rps.ron --locus l1=0.4..1 --locus l2=0.4..1 --svg loci.svg")]
pub struct Singularities {
    /// Move a joint or coordinate, e.g. --input theta1=0deg..360deg; several move together
    #[arg(long, value_name = "NAME=FROM..TO")]
    input: Vec<Assignment>,
    /// Range of one of the two coordinates in which loci are searched for; give it twice, e.g. --locus l1=0.4..1 --locus l2=0.4..1
    #[arg(long, value_name = "NAME=FROM..TO", conflicts_with_all = ["input", "mode", "follow"])]
    locus: Vec<Assignment>,
    /// An output: a joint, a coordinate of a platform or point (left+0.5,0.2.x), a frame with its orientation, or a point
    /// beside its origin (left+0.5,0.2)
    #[arg(long, value_name = "NAME")]
    output: Vec<String>,
    /// An output: the origin of a frame alone, or a point beside it
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    point: Vec<String>,
    /// Begin in this mode, numbered as `assemblies` lists it where the inputs begin
    #[arg(long, value_name = "NUMBER")]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Continue around folds and straight through crossings of branches
    #[arg(long, requires = "input")]
    follow: bool,
    /// Number of random starts of the search for loci; up to ten times as many while more curves are likely
    #[arg(long, value_name = "NUMBER", default_value_t = SingularitiesSettings::default().starts)]
    starts: usize,
    #[command(flatten)]
    search: SearchArgs,
    /// Draw the loci to a file
    #[arg(long, value_name = "FILE", requires = "locus", value_parser = file(&["svg"]))]
    svg: Option<PathBuf>,
}

impl AnalysisArgs for Singularities {
    const ROWS: bool = true;

    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        let settings = SingularitiesSettings {
            starts: self.starts,
            follow: self.follow,
            ..SingularitiesSettings::default()
        };
        self.search.pose(&mut posed)?;
        posed.names(Role::Output, &self.output);
        posed.names(Role::Point, &self.point);
        posed.ranges(Ranged::Input, &self.input)?;
        posed.mode(self.mode);
        if self.locus.is_empty() {
            return match self.input.is_empty() {
                true => posed.answer(format, |q, watch| q.singularities(&settings, watch)),
                false => posed.answer(format, |q, watch| q.along(&settings, watch)),
            };
        }
        posed.ranges(Ranged::Locus, &self.locus)?;
        let report = posed.ask(|question, watch| question.loci(&settings, watch))?;
        if let Some(path) = &self.svg {
            save(path, output::svg(&report).as_bytes())?;
        }
        posed.loaded.answer(format, &report)
    }
}
