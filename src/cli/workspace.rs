//! `linkwork workspace`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::workspace::WorkspaceSettings;
use linkwork::ask::Mode;
use linkwork::output::{Report, workspace as output};

use super::output_files::{file, rows, save};
use super::question_options::{AnalysisArgs, Posed};
use super::report_format::{Format, beside_rows};
use super::search_options::SearchArgs;
use super::source::Assignment;
use super::words;
use super::{Answer, Refusal, lines, style};
use linkwork::output::complaint::Ranged;

/// Map where the mechanism reaches, in which modes, and what bounds it.
///
/// One, two or three coordinates are mapped on a grid and the others held: coordinates of platforms or points, which frees
/// the actuated joints, or joints. A mode is a set of configurations that regular motion within the box connects: working
/// modes if platforms are mapped, assembly modes if the actuated joints are. Modes end at singularities and at joint
/// limits; the regions of one mode without singularities inside are its aspects. The mode and aspect of the home
/// assembly, or of the one that --guess leads to, are marked. Every node has its condition number.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork workspace mechanisms/five_bar_hand.ron --map hand.x=-0.6..0.8 --map hand.y=-0.1..0.7 --svg map.svg\n  \
    linkwork workspace mechanisms/three_rps.ron --map top.roll=-60deg..60deg --map top.pitch=-60deg..60deg --hold top.z=0.6\n  \
    linkwork workspace mechanisms/five_bar.ron --map theta1=-180deg..180deg --map theta2=-180deg..180deg --format csv")]
pub struct Workspace {
    /// Range of a mapped coordinate, e.g. --map hand.x=-1..1; one to three of them
    #[arg(long, value_name = "NAME=FROM..TO")]
    map: Vec<Assignment>,
    /// Nodes along each mapped coordinate, or one number for all [default: 200, 60 or 24 each]
    #[arg(long, value_name = "NUMBER", value_delimiter = ',')]
    grid: Vec<usize>,
    /// Nodes, spread over the box, that are searched for modes with all --starts; the others get fewer
    #[arg(long = "search", value_name = "NUMBER", default_value_t = WorkspaceSettings::default().searched)]
    searched: usize,
    /// Random starts at each of these nodes
    #[arg(long, value_name = "NUMBER", default_value_t = WorkspaceSettings::default().starts)]
    starts: usize,
    /// Also start from all assemblies in the middle of the box
    #[arg(long)]
    assemblies: bool,
    #[command(flatten)]
    search: SearchArgs,
    /// Write the points of boundary curves as rows, instead of the nodes
    #[arg(long)]
    boundary: bool,
    /// Draw the map to a file
    #[arg(long, value_name = "FILE", value_parser = file(&["svg"]))]
    svg: Option<PathBuf>,
}

impl AnalysisArgs for Workspace {
    const ROWS: bool = true;

    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.search.pose(&mut posed)?;
        posed.ranges(Ranged::Map, &self.map)?;
        if self.boundary && (self.map.len() == 1 || format != Format::Csv) {
            return Err(Refusal(words::no_boundary(self.map.len()).render(style())));
        }
        if self.assemblies {
            posed.ask_with(|question| question.mode(Mode::All));
        }
        let settings = WorkspaceSettings {
            nodes: self.grid.clone(),
            searched: self.searched,
            starts: self.starts,
            ..WorkspaceSettings::default()
        };
        let report = posed.ask(|question, watch| question.workspace(&settings, watch))?;
        let mut drawn = String::new();
        if let Some(path) = &self.svg {
            save(path, output::svg(&report).as_bytes())?;
            let part = output::left_out(&report);
            let part = part.map(|part| format!("{part} in {}", path.display()));
            drawn = lines("note", part);
        }
        let answer = match self.boundary {
            false => posed.loaded.answer(format, &report)?,
            true => {
                let whole = rows(output::boundary_rows(&report))?;
                Answer {
                    data: String::new(),
                    remarks: posed.loaded.warnings() + &beside_rows(&report, whole),
                    yes: report.is_yes() && whole,
                }
            }
        };
        Ok(answer.after(drawn))
    }
}
