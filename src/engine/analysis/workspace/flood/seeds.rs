//! Seeds: assembled configurations from which the grid is reached.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::arrivals::Arrivals;
use super::neighbour::Flood;
use super::spread::GrowingSet;
use super::step::{StepStart, Steps};
use crate::analysis::workspace::problem::{Grid, MapProblem};
use crate::mechanism::{Configuration, turn_near};
use crate::solve::{Pool, Stage, Watch, each};
use crate::system::{random_configuration, sets_of_angles, with_coordinates};

/// Seeds found at the nodes that were searched.
#[derive(Default)]
pub(crate) struct ModeSeeds {
    pub seeds: Vec<(usize, Configuration<f64>)>,
    /// Assembled configurations with a joint outside its limits, which are no seeds.
    pub outside: usize,
}

impl ModeSeeds {
    /// Seeds from the solutions at each node. Of the two sets of angles of a ball written as three rows the one on the
    /// side of home is taken, so that no mode is there twice.
    pub fn of(
        fill: &Flood,
        found: impl IntoIterator<Item = (usize, Vec<Configuration<f64>>)>,
    ) -> Self {
        let (problem, mechanism) = (fill.problem, fill.problem.mechanism);
        let sides = mechanism.sides_of_rings(&mechanism.home());
        let on_sides = |node: usize, mut at: Configuration<f64>| {
            // Newton's method may have gone thousands of turns
            for (angle, _) in at.joints.iter_mut().zip(&problem.turns).filter(|of| *of.1) {
                *angle = turn_near(*angle, 0.0);
            }
            let as_home = |set: &Configuration<f64>| {
                let own = mechanism.sides_of_rings(set);
                own.iter().zip(&sides).filter(|(a, b)| a == b).count()
            };
            let question = problem.at(&fill.grid.values(node));
            let sets = sets_of_angles(mechanism, (&question.held(), question.still()), &at);
            // the first of equal ones
            sets.into_iter().rev().max_by_key(as_home).unwrap_or(at)
        };
        let mut mode_seeds = ModeSeeds::default();
        for (node, found) in found {
            for at in found {
                let mut at = match sides.is_empty() {
                    true => at,
                    false => on_sides(node, at),
                };
                let joints = at.joints.iter_mut().enumerate();
                let limited = |joint: usize| mechanism.joints()[joint].limits.is_some();
                for (joint, angle) in joints.filter(|(joint, _)| problem.turns[*joint]) {
                    if limited(joint) {
                        *angle = problem.by_home(joint, *angle);
                    }
                }
                match problem.allows(&at.joints) {
                    true => mode_seeds.seeds.push((node, at)),
                    false => mode_seeds.outside += 1,
                }
            }
        }
        mode_seeds
    }
}

/// Newton's method from random starts at each of some nodes, and from the given configurations.
pub(crate) fn search_modes(
    fill: &Flood,
    (nodes, starts, seed): (&[usize], usize, u64),
    (given, watch): (&[Configuration<f64>], &Watch),
) -> ModeSeeds {
    let (problem, grid) = (fill.problem, fill.grid);
    let mut plain = Steps::new(problem);
    let found = each(nodes.len(), &plain, |steps, i| {
        let stops = watch.stops(Stage::Nodes, i, Some(nodes.len()));
        let count = if stops { 0 } else { starts };
        let seed = seed.wrapping_add(nodes[i] as u64);
        solved(
            fill,
            steps,
            nodes[i],
            starts_at(fill, nodes[i], seed).take(count),
        )
    });
    let here = given.iter().filter_map(|at| {
        let node = nearest(problem, grid, at)?;
        let at = put_in(problem, &grid.values(node), at);
        Some(solved(fill, &mut plain, node, std::iter::once(at)))
    });
    ModeSeeds::of(fill, found.into_iter().chain(here))
}

/// The start of a question at a node, then random ones, with what is held there put in. Each node draws for itself, so that
/// threads do not matter.
fn starts_at(fill: &Flood, node: usize, seed: u64) -> impl Iterator<Item = Configuration<f64>> {
    let (problem, values) = (fill.problem, fill.grid.values(node));
    let around = problem.at(&values).start();
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let first = std::iter::once(around.clone());
    let random = move || random_configuration(problem.mechanism, &around, &mut rng);
    let all = first.chain(std::iter::repeat_with(random));
    all.map(move |at| put_in(problem, &values, &at))
}

/// A node with what Newton's method finds from starts there, each once.
fn solved(
    fill: &Flood,
    steps: &mut Steps,
    node: usize,
    starts: impl Iterator<Item = Configuration<f64>>,
) -> (usize, Vec<Configuration<f64>>) {
    let values = fill.grid.values(node);
    let mut found: Vec<Configuration<f64>> = Vec::new();
    for start in starts {
        let Some(at) = steps.solved(start, &values) else {
            continue;
        };
        let mut known = found.iter();
        let known = known.any(|known| fill.metric.same(known.view(), at.view()));
        // where the mapped coordinates do not determine the motion, spreading cannot start
        if !known && steps.indicators(&at, &values).regular {
            found.push(at);
        }
    }
    (node, found)
}

/// A configuration with the held values of a node put in.
fn put_in(problem: &MapProblem, values: &[f64], at: &Configuration<f64>) -> Configuration<f64> {
    let held = problem.at(values);
    let mut at = at.clone();
    for (platform, pose) in at.platforms.iter_mut().enumerate() {
        let coordinates = held.held_values(platform);
        if !coordinates.is_empty() {
            let with = with_coordinates(&problem.mechanism.in_ground(pose), coordinates);
            *pose = problem.mechanism.from_ground(&with);
        }
    }
    problem.put(&at, values)
}

/// Starts at each node that is probed.
pub(crate) const PROBES: usize = 8;

/// Seeds in small regions not reached yet: from a few random starts at each of many nodes.
pub(crate) fn probe(
    fill: &Flood,
    reached: &GrowingSet,
    steps: &Pool<Steps>,
    (nodes, seed): (&[usize], u64),
    watch: &Watch,
) -> ModeSeeds {
    let found = steps.each(nodes.len(), |steps, i| {
        let node = nodes[i];
        if watch.stops(Stage::Nodes, i, Some(nodes.len())) {
            return (node, Vec::new());
        }
        // other numbers than those drawn above
        let seed = !seed.wrapping_add(node as u64);
        let drawn = starts_at(fill, node, seed).skip(1).take(PROBES);
        let drawn: Vec<Configuration<f64>> = drawn.collect();
        let anywhere = |at| StepStart {
            reach: f64::INFINITY,
            ..fill.here(node, at)
        };
        let starts: Vec<StepStart> = drawn.iter().map(anywhere).collect();
        let mut new: Vec<Configuration<f64>> = Vec::new();
        let mut arrivals = Arrivals::default();
        steps.settle(&starts, &mut arrivals);
        for arrival in arrivals.iter().flatten() {
            let known = |of: &Configuration<f64>| fill.metric.same(of.view(), arrival.at);
            if reached.known(fill, node, arrival).is_none() && !new.iter().any(known) {
                new.push(arrival.at.owned());
            }
        }
        (node, new)
    });
    ModeSeeds::of(fill, found)
}

/// The node nearest to a configuration, if it is in the box.
fn nearest(problem: &MapProblem, grid: &Grid, at: &Configuration<f64>) -> Option<usize> {
    let (mut node, mut stride) = (0, 1);
    for (i, axis) in problem.axes.iter().enumerate() {
        let place =
            ((axis.coordinate.of(problem.mechanism, at) - axis.from) / grid.spacing(i)).round();
        if !(place >= 0.0 && place < grid.count(i) as f64) {
            return None;
        }
        node += stride * place as usize;
        stride *= grid.count(i);
    }
    Some(node)
}
