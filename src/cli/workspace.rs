//! `linkwork workspace`

use std::f64::consts::TAU;
use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::workspace::{WorkspaceError, WorkspaceSettings, cell_bytes, workspace};
use linkwork::mechanism::{Configuration, Coordinate, Mechanism};
use linkwork::output::workspace as output;
use linkwork::system::{
    Driven, Holdable, Mobility, Question, QuestionError, check_count, too_large,
};

use super::asked::{Split, refusal};
use super::format::Format;
use super::range::{RangeWords, ranges};
use super::search::Search;
use super::source::{Assignment, Source};
use super::watched::watched;
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

/// Bytes that a map takes at most.
const MOST_BYTES: f64 = 4e9;
/// Random starts made at most.
const MOST_STARTS: usize = 1_000_000;

impl Workspace {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mechanism = &loaded.mechanism;
        let axes = self.axes(mechanism)?;
        let question = self.question(mechanism, &axes)?;
        let nodes = self.nodes(&question, &axes)?;
        let counts = [
            (
                self.starts,
                "--starts",
                "random starts are made at each node searched",
            ),
            (self.searched, "--search", "nodes are searched"),
        ];
        for (count, option, what) in counts {
            if count == 0 || count > MOST_STARTS {
                return Err(Refusal(format!(
                    "error: {count} {what}: give {option} from 1 to {MOST_STARTS}\n"
                )));
            }
        }
        if self.boundary && axes.len() == 1 {
            return Err(Refusal(output::boundary_flat().render(style())));
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
        let known = self.known(&question)?;
        let settings = WorkspaceSettings {
            nodes,
            searched: self.searched,
            starts: self.starts,
            seed: self.search.seed,
            most: (MOST_BYTES / cell_bytes(&question, axes.len()) as f64) as usize,
            ..WorkspaceSettings::default()
        };
        let report = watched(|watch| workspace(&question, &axes, &known, &settings, watch));
        let report = report.map_err(|error| match error {
            WorkspaceError::TooMany { most } => {
                Refusal(output::too_many_cells(most, MOST_BYTES).render(style()))
            }
        })?;
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

    /// The mapped coordinates with their ranges.
    fn axes(&self, mechanism: &Mechanism) -> Result<Vec<Driven>, Refusal> {
        let question = Question::new(mechanism);
        for assignment in &self.map {
            if let Err(error) = question.value(&assignment.name, "home")
                && let Some(complaint) = output::no_platform(mechanism, &error)
            {
                let given = assignment.given("--map");
                let part = linkwork::output::option::Part::Name;
                return Err(Refusal(complaint.render_in(&given, &part, style())));
            }
        }
        let words = RangeWords {
            no_range: output::no_range,
            refused: output::empty_side,
        };
        // a range that is no number is refused too
        let refuse = |a: f64, b: f64| a >= b || !(b - a).is_finite();
        let axes = ranges(mechanism, "--map", &self.map, refuse, &words)?;
        // what comes round again is mapped once
        let turns = |axis: &Driven| match axis.coordinate {
            Holdable::Joint(joint) => mechanism.repeats(joint),
            of => of.is_angle(mechanism),
        };
        let round = |axis: &&Driven| turns(axis) && axis.to - axis.from > TAU * (1.0 + 1e-9);
        if let Some(axis) = axes.iter().find(round) {
            let name = axis.coordinate.name(mechanism);
            return Err(Refusal(output::more_than_a_turn(&name).render(style())));
        }
        match axes.len() {
            1..=3 => Ok(axes),
            n => Err(Refusal(output::too_many_axes(mechanism, n).render(style()))),
        }
    }

    /// The question with the mapped coordinates in the middle of their ranges. Where coordinates of
    /// platforms are mapped or held the actuated joints are free.
    fn question<'a>(
        &self,
        mechanism: &'a Mechanism,
        axes: &[Driven],
    ) -> Result<Question<'a>, Refusal> {
        let held = self.split.question(mechanism)?;
        let platform = |h: &Holdable| !matches!(h, Holdable::Joint(_));
        let mapped = axes.iter().map(|axis| axis.coordinate);
        let inverse = mapped.chain(held.held_coordinates()).any(|h| platform(&h));
        let asked = self.split.demanded();
        let mut question = match inverse {
            true => self.split.released(mechanism)?,
            false => held,
        };
        for (assignment, axis) in self.map.iter().zip(axes) {
            let given = assignment.given("--map");
            let of_platform = |name: &str| match axis.coordinate {
                Holdable::Coordinate(platform, _) => mechanism.platforms()[platform].name == name,
                _ => false,
            };
            if asked
                .iter()
                .any(|name| *name == assignment.name || of_platform(name))
            {
                let (complaint, part) = output::also_held(&assignment.name);
                return Err(Refusal(complaint.render_in(&given, &part, style())));
            }
            // all digits, so that the value is the one that was read
            let middle = format!("{:?}", 0.5 * (axis.from + axis.to));
            let held = question.hold(&assignment.name, &middle);
            question = held.map_err(|error| refusal(&error, Some(given)))?;
        }
        if let Some(large) = too_large(mechanism) {
            return Err(Refusal(format!(
                "error: the mechanism has {} unknowns, too many for a map: ask about a part of it\n",
                large.unknowns
            )));
        }
        // roll and yaw turn about one axis there, and do not tell a map
        for axis in axes {
            if let Holdable::Coordinate(platform, c) = axis.coordinate
                && c.is_angle()
                && (question.held_coordinates().iter())
                    .any(|held| matches!(held, Holdable::Turn(of, _) if *of == platform))
            {
                let platform = mechanism.platforms()[platform].name.clone();
                return Err(refusal(&QuestionError::AnglesLocked { platform }, None));
            }
        }
        let names: Vec<String> = self.map.iter().map(|map| map.name.clone()).collect();
        check_count(&question).map_err(|error| {
            let missing = match error {
                QuestionError::TooFew { .. } if inverse => missing(&question),
                _ => Vec::new(),
            };
            match output::wrong_count(&error, &names, &missing) {
                Some(complaint) => Refusal(complaint.render(style())),
                None => refusal(&error, None),
            }
        })?;
        Ok(question)
    }

    /// Nodes along each coordinate.
    fn nodes(&self, question: &Question, axes: &[Driven]) -> Result<Vec<usize>, Refusal> {
        let nodes = match self.grid[..] {
            [] => vec![[200, 60, 24][axes.len() - 1]; axes.len()],
            [one] => vec![one; axes.len()],
            _ => self.grid.clone(),
        };
        if nodes.len() != axes.len() || nodes.iter().any(|n| *n < 2) {
            return Err(Refusal(
                output::wrong_grid(&nodes, axes.len()).render(style()),
            ));
        }
        let all: f64 = nodes.iter().map(|n| *n as f64).product();
        let bytes = all * cell_bytes(question, axes.len()) as f64;
        match bytes > MOST_BYTES {
            true => Err(Refusal(
                output::too_fine(all, bytes, MOST_BYTES).render(style()),
            )),
            false => Ok(nodes),
        }
    }

    /// All assemblies in the middle of the box, if they are asked for.
    fn known(&self, question: &Question) -> Result<Vec<Configuration<f64>>, Refusal> {
        if !self.assemblies {
            return Ok(Vec::new());
        }
        let wanted = Wanted {
            certificates: false,
            all_complex: false,
            starts: false,
        };
        let like = question.start();
        let report = watched(|watch| {
            let solver = self.search.solver(question, watch)?;
            Ok(solver.at_targets(&like, &question.held(), wanted, watch))
        })?;
        let found = report.assemblies.iter();
        Ok(found
            .map(|assembly| assembly.configuration(&like))
            .collect())
    }
}

/// Coordinates of platforms that are to be mapped or held too.
fn missing(question: &Question) -> Vec<String> {
    let mechanism = question.mechanism();
    let held = question.held_coordinates();
    let platforms = 0..mechanism.platforms().len();
    let coordinates = platforms.flat_map(|platform| {
        let all = Coordinate::ALL.into_iter();
        all.map(move |c| Holdable::Coordinate(platform, c))
    });
    let candidates: Vec<Holdable> = held.iter().copied().chain(coordinates).collect();
    let Some(mobility) = Mobility::near(mechanism, &question.start()) else {
        return Vec::new();
    };
    let chosen = mobility.independent(mechanism, &candidates).into_iter();
    let new = chosen.filter(|c| !held.contains(c));
    new.map(|c| c.name(mechanism)).collect()
}
