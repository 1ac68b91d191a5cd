//! Workspace: the reachable values of some coordinates, by working or assembly mode, with the boundary curves and
//! singularity-free aspects.
//!
//! Assembled configurations are sought from random starts at some nodes of a grid. From there nodes
//! are reached one from another by steps of Newton's method, many side by side, that are short beside
//! what would lead to another solution; where a step is too long, by shorter ones, and at last by the
//! sure steps of [`Continuation`](crate::solve::Continuation). What is connected so is a *mode*: a
//! working mode where coordinates of platforms are mapped, an assembly mode where inputs are. Where a
//! mode ends or a determinant changes sign on an edge of the grid, the point is located to rounding,
//! and the boundary through it is followed. Equal signs of both determinants make an *aspect*.
//!
//! Sources: Borrel and Liégeois 1986, Wenger 1992 (aspects); Wenger and Chablat 1997 (of parallel
//! manipulators, with working modes); Gosselin and Angeles 1990 (singularities); Bohigas, Manubens
//! and Ros 2012 (boundaries by continuation).

mod aspects;
mod boundary;
mod flood;
mod home;
mod map;
mod problem;

pub use boundary::{BoundaryCurve, BoundaryKind, Piece};
pub use map::{
    AspectReport, AxisReport, BoundaryPoint, Cells, Conditioned, HeldReport, HomeReport, MapNode,
    ModeReport, WorkspaceReport,
};

use crate::mechanism::{Configuration, PlatformPose};
use crate::solve::{Pool, Watch};
use crate::system::{Driven, Question};
use boundary::Boundary;
use flood::{Flood, GrowingSet, Metric, ModeSeeds, ReachedSet, Steps};
use home::Home;
use map::WorkspaceMap;
use problem::{Grid, MapProblem};

/// Settings of a workspace map.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkspaceSettings {
    /// Nodes along each mapped coordinate, at least two.
    pub nodes: Vec<usize>,
    /// Nodes at which modes are sought, at most.
    pub searched: usize,
    /// Random starts at each of them.
    pub starts: usize,
    /// Nodes at which a few more starts are made at most, so that small regions are not missed.
    pub probed: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// If true, boundaries are located and followed.
    pub boundaries: bool,
    /// Nodes in modes that are kept at most: each takes about [`cell_bytes`].
    pub most: usize,
}

impl Default for WorkspaceSettings {
    fn default() -> Self {
        WorkspaceSettings {
            nodes: Vec::new(),
            searched: 64,
            starts: 30,
            probed: 10_000,
            seed: 1,
            boundaries: true,
            most: usize::MAX,
        }
    }
}

/// More nodes in modes were reached than may be kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the map would have more than the {most} nodes that may be kept: use a coarser grid or a smaller box"
)]
pub struct TooManyNodes {
    /// Largest number of nodes allowed.
    pub most: usize,
}

/// Bytes that a node in one mode takes at most at a time, roughly.
pub fn cell_bytes(question: &Question, axes: usize) -> usize {
    let mechanism = question.mechanism();
    let (joints, platforms) = (mechanism.joints().len(), mechanism.platforms().len());
    let unknowns = joints + 6 * platforms;
    let kept = 150 + 8 * joints + size_of::<PlatformPose<f64>>() * platforms;
    // beside it first the motions, later numbers and a row of the table
    let motions = 8 * question.held_coordinates().len() * unknowns;
    let row = 65 + 8 * (6 + axes + unknowns);
    kept + motions.max(row)
}

/// Maps a box of coordinates.
///
/// `question` holds the mapped coordinates and all others that must be, at any values of the mapped
/// ones; it must leave no freedom. `known` are assembled configurations to begin with besides those
/// that random starts lead to; `home`, if it is assembled with what is held, is the configuration
/// whose mode and aspect are reported.
///
/// # Errors
/// If more is reached than may be kept.
pub fn workspace(
    question: &Question,
    axes: &[Driven],
    (known, home): (&[Configuration<f64>], Option<&Configuration<f64>>),
    settings: &WorkspaceSettings,
    watch: &Watch,
) -> Result<WorkspaceReport, TooManyNodes> {
    let problem = MapProblem::new(question, axes);
    let counts: Vec<usize> = (0..axes.len())
        .map(|i| settings.nodes.get(i).copied().unwrap_or(50).max(2))
        .collect();
    let grid = Grid::new(axes, &counts);
    let metric = Metric::new(&problem);
    let fill = Flood {
        problem: &problem,
        grid: &grid,
        metric: &metric,
        most: settings.most,
        only: None,
    };
    let nodes = grid.spread(settings.searched);
    let sought = (&nodes[..], settings.starts, settings.seed);
    let mode_seeds = flood::search_modes(&fill, sought, (known, watch));
    let probed = grid.spread(settings.probed);
    let home = home.map(|at| Home::new(fill, at));
    let seeds = (&mode_seeds, home.as_ref());
    let (reached_set, aspects, outside) =
        reached_set(&fill, seeds, (&probed, settings.seed), watch)?;
    let map = WorkspaceMap::new(&problem, &grid, &reached_set, aspects);
    let boundary = Boundary {
        fill: &fill,
        reached_set: &reached_set,
        mode: &map.mode,
    };
    let crossings = match settings.boundaries {
        true => boundary.crossings(watch),
        false => Vec::new(),
    };
    let curves = boundary.curves(&crossings, watch);
    let mut report = map.report(&crossings, home.as_ref());
    report.curves = curves;
    report.searched = [nodes.len(), settings.starts];
    report.probed = [probed.len(), flood::PROBES];
    report.outside = mode_seeds.outside + outside;
    report.seed = settings.seed;
    report.interrupted = watch.is_stopped();
    Ok(report)
}

/// The reached nodes, the aspect of each solution, and the number of seeds outside limits.
fn reached_set(
    fill: &Flood,
    (mode_seeds, home): (&ModeSeeds, Option<&Home>),
    (probed, seed): (&[usize], u64),
    watch: &Watch,
) -> Result<(ReachedSet, Vec<Option<usize>>, usize), TooManyNodes> {
    let mut steps = Steps::new(fill.problem);
    if let Some((node, at)) = mode_seeds.seeds.first() {
        steps = steps.recorded(fill.problem, at, &fill.grid.point(*node));
    }
    let steps = Pool::new(steps);
    let mut reached = GrowingSet::new(fill.grid);
    fill.spread(&mut reached, &steps, &mode_seeds.seeds, watch)?;
    let mut more = flood::probe(fill, &reached, &steps, (probed, seed), watch);
    if let Some(home) = home {
        let new = |(node, at): &(usize, Configuration<f64>)| !reached.has(fill, *node, at.view());
        let seeds = home.seeds().seeds.into_iter();
        more.seeds.extend(seeds.filter(new));
    }
    fill.spread(&mut reached, &steps, &more.seeds, watch)?;
    let mut reached_set = reached.reached_set(fill.grid);
    let (aspects, together) = aspects::joined(fill, &steps, &reached_set, watch);
    // what hangs together on a finer grid is of one mode
    reached_set.connect(together);
    Ok((reached_set, aspects, more.outside))
}
