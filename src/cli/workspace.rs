//! `linkwork workspace`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::workspace::WorkspaceSettings;
use linkwork::ask::Mode;
use linkwork::output::workspace as output;

use super::asked::{Ranges, Split};
use super::format::Format;
use super::search::Search;
use super::source::{Assignment, Source};
use super::watched::watched;
use super::words::map;
#[cfg(feature = "plot")]
use super::written::save;
use super::written::{INTERRUPTED_REMARK, rows};
use super::{Answer, Refusal, style};

/// Map where the mechanism reaches, in which modes, and what bounds it.
///
/// One, two or three coordinates are mapped on a grid, the others held: coordinates of platforms, which frees the
/// actuated joints, or joints. What regular motion in the box connects is a mode: a working mode where platforms are
/// mapped, an assembly mode where the actuated joints are. Modes end at singularities and at limits of joints; regions
/// of one mode without singularities inside are its aspects. Every node tells its condition number.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork workspace mechanisms/five_bar_hand.ron --map hand.x=-0.6..0.8 --map hand.y=-0.1..0.7 --svg map.svg\n  \
    linkwork workspace mechanisms/three_rps.ron --map top.roll=-60deg..60deg --map top.pitch=-60deg..60deg --hold top.z=0.6\n  \
    linkwork workspace mechanisms/five_bar.ron --map theta1=-180deg..180deg --map theta2=-180deg..180deg --format csv")]
pub struct Workspace {
    #[command(flatten)]
    source: Source,
    /// A coordinate that is mapped, e.g. --map hand.x=-1..1; one to three
    #[arg(long, value_name = "NAME=FROM..TO")]
    map: Vec<Assignment>,
    #[command(flatten)]
    split: Split,
    /// Nodes along each mapped coordinate, or along all of them [default: 200, 60 or 24 each]
    #[arg(long, value_name = "NUMBER", value_delimiter = ',')]
    grid: Vec<usize>,
    /// Nodes, spread over the box, that are searched for modes; some starts are then made at all nodes
    #[arg(long = "search", value_name = "NUMBER", default_value_t = WorkspaceSettings::default().searched)]
    searched: usize,
    /// Random starts at each node that is searched for modes
    #[arg(long, value_name = "NUMBER", default_value_t = WorkspaceSettings::default().starts)]
    starts: usize,
    /// Also begin with all that `assemblies` finds in the middle of the box
    #[arg(long)]
    assemblies: bool,
    #[command(flatten)]
    search: Search,
    /// How to write the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the points of boundary curves as rows, instead of the nodes
    #[arg(long)]
    boundary: bool,
    /// Draw the map to a file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Workspace {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mut posed = self.split.pose(&loaded);
        self.search.pose(&mut posed)?;
        posed.ranges(Ranges::Map, &self.map)?;
        if self.boundary && self.map.len() == 1 {
            return Err(Refusal(map::boundary_flat().render(style())));
        }
        if self.boundary && self.format != Format::Csv {
            return Err(Refusal(
                "error: --boundary chooses the rows of --format csv; --format json has boundaries too\n".into(),
            ));
        }
        #[cfg(not(feature = "plot"))]
        if self.svg.is_some() {
            return Err(Refusal(
                "error: built without feature `plot`, which draws\n".into(),
            ));
        }
        if self.assemblies {
            posed.question = posed.question.mode(Mode::All);
        }
        let settings = WorkspaceSettings {
            nodes: self.grid.clone(),
            searched: self.searched,
            starts: self.starts,
            ..WorkspaceSettings::default()
        };
        let report = watched(|watch| posed.question.workspace(&settings, watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let mut remarks = loaded.warnings();
        #[cfg(feature = "plot")]
        if let Some(path) = &self.svg {
            save(path, &output::svg(&report))?;
            if let Some(drawn) = output::left_out(&report) {
                remarks += &format!("note: {drawn} in {}\n", path.display());
            }
        }
        let whole = match (self.format, self.boundary) {
            (Format::Csv, true) => rows(output::boundary_rows(&report))?,
            (Format::Csv, false) => rows(output::node_rows(&report))?,
            _ => true,
        };
        let data = self.format.shown(&report);
        remarks += &match self.format {
            Format::Csv if !whole => INTERRUPTED_REMARK.to_owned(),
            Format::Csv => format!("note: {}\n", output::completeness(&report)),
            _ => String::new(),
        };
        Ok(Answer {
            data,
            remarks,
            yes: report.reached > 0 && whole,
        })
    }
}
