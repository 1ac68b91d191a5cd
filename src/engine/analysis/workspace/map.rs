//! The map: reached solutions by modes, aspects and cells.

mod cells;
mod report;
mod table;

pub use cells::{AxisReport, Cells, MapNode};
pub use report::{
    AspectReport, BoundaryPoint, Conditioned, HeldReport, HomeReport, ModeReport, WorkspaceReport,
};

use std::collections::HashMap;

use super::aspects::{self, NodeSet};
use super::boundary::{EdgeCrossing, named};
use super::flood::{EdgeLink, ReachedSet};
use super::home::Home;
use super::problem::{Grid, MapProblem};
use crate::algebra::SiUnit;
use crate::mechanism::{PoseCoordinate, Variable, turn_near};
use crate::number::sorting::sort_by;
use crate::number::tolerance::ROUNDING;
use crate::solve::each;
use crate::system::{Coordinate, NamedUnit};

/// Solutions with their modes and aspects.
pub(super) struct WorkspaceMap<'a> {
    pub problem: &'a MapProblem<'a>,
    pub grid: &'a Grid,
    pub reached_set: &'a ReachedSet,
    /// For each solution its mode, from 0; none of modes that are nowhere within limits.
    pub mode: Vec<Option<usize>>,
    modes: usize,
    /// For each solution the first solution of its aspect.
    pub aspect: Vec<Option<usize>>,
}

/// Part of an edge over which a solution belongs to its region in a direction; half if not known.
type Cuts = HashMap<(usize, usize), f64>;

impl<'a> WorkspaceMap<'a> {
    pub fn new(
        problem: &'a MapProblem<'a>,
        grid: &'a Grid,
        reached_set: &'a ReachedSet,
        aspect: Vec<Option<usize>>,
    ) -> Self {
        let mut within = vec![false; reached_set.len()];
        // of each mode the solution at its first node, with the least joints
        let mut first: Vec<Option<usize>> = vec![None; reached_set.len()];
        let order = |a: usize, b: usize| {
            let node = |s: usize| reached_set.solution(s).node;
            let joints = |s: usize| brought(problem, reached_set.configuration(s).joints, true);
            let joint_order = || {
                let (a, b) = (joints(a), joints(b));
                let pairs = a.iter().zip(&b);
                // equal but for rounding is equal
                let differ = |(a, b): &(&f64, &f64)| (**a - **b).abs() > ROUNDING;
                let mut differing = pairs.into_iter().filter(differ);
                let order = differing.next().map(|(a, b)| a.total_cmp(b));
                order.unwrap_or(std::cmp::Ordering::Equal)
            };
            node(a).cmp(&node(b)).then_with(joint_order)
        };
        for s in 0..reached_set.len() {
            let root = reached_set.roots[s];
            within[root] |= reached_set.solution(s).within;
            match first[root] {
                Some(known) if order(known, s).is_le() => {}
                _ => first[root] = Some(s),
            }
        }
        let mut roots: Vec<(usize, usize)> = (first.iter().enumerate())
            .filter(|(root, _)| within[*root])
            .filter_map(|(root, first)| Some((root, (*first)?)))
            .collect();
        sort_by(&mut roots, |a, b| order(a.1, b.1).then(a.0.cmp(&b.0)));
        let mut numbers = vec![None; reached_set.len()];
        for (number, (root, _)) in roots.iter().enumerate() {
            numbers[*root] = Some(number);
        }
        WorkspaceMap {
            mode: reached_set
                .roots
                .iter()
                .map(|root| numbers[*root])
                .collect(),
            modes: roots.len(),
            aspect,
            problem,
            grid,
            reached_set,
        }
    }

    pub fn report(&self, crossings: &[EdgeCrossing], home: Option<&Home>) -> WorkspaceReport {
        let mechanism = self.problem.mechanism;
        let unit = |of: Coordinate| SiUnit::of_coordinate(of.is_angle(mechanism));
        let name = |of: &Coordinate| of.name(mechanism);
        let axes = self.problem.axes.iter().enumerate();
        let held = self.held();
        let mut cuts = Cuts::new();
        for crossing in crossings {
            cuts.insert((crossing.solution, crossing.direction), crossing.part);
            let link = self.reached_set.solution(crossing.solution).links[crossing.direction];
            if let EdgeLink::To(other) = link {
                let other = (other as usize, crossing.direction ^ 1);
                cuts.insert(other, 1.0 - crossing.part);
            }
        }
        let mut of_modes: Vec<Vec<usize>> = vec![Vec::new(); self.modes];
        for (s, mode) in self.mode.iter().enumerate() {
            if let Some(mode) = mode {
                of_modes[*mode].push(s);
            }
        }
        let node = |s: &usize| self.reached_set.solution(*s).node;
        let whole = |s: &usize| self.reached_set.solution(*s).within;
        let of_mode = |mode: usize| move |s: &usize| self.mode[*s] == Some(mode) && whole(s);
        let all = (0..self.reached_set.len()).filter(whole);
        let reached = NodeSet::new(self.grid, all.map(|s| node(&s)));
        let inside = self.reached_set.solutions().filter(|(_, of)| of.within);
        let links = inside.flat_map(|(_, solution)| &solution.links);
        let unsure = links.filter(|link| **link == EdgeLink::Stuck).count();
        let (aspects, numbers) = self.aspects(&cuts);
        let home_report = |home: &Home| {
            let [known, within] = home.solutions(self.reached_set, &self.mode);
            HomeReport {
                at: home.at.clone(),
                mode: known.and_then(|s| Some(self.mode[s]? + 1)),
                // an aspect is numbered by its first solution
                aspect: within.and_then(|s| numbers[self.aspect[s]?]),
            }
        };
        WorkspaceReport {
            mechanism: mechanism.name().to_owned(),
            variables: Variable::joints(mechanism),
            axes: axes
                .map(|(i, axis)| AxisReport {
                    name: name(&axis.coordinate),
                    unit: unit(axis.coordinate),
                    from: axis.from,
                    to: axis.to,
                    nodes: self.grid.count(i),
                })
                .collect(),
            held: (held.into_iter())
                .map(|(of, value)| HeldReport {
                    name: name(&of),
                    unit: unit(of),
                    value,
                })
                .collect(),
            following: self
                .following()
                .map(|(p, c)| NamedUnit::of(mechanism, Coordinate::Pose(p, c)))
                .collect(),
            inputs: self.problem.inputs.iter().map(name).collect(),
            outputs: self.problem.outputs.iter().map(name).collect(),
            nodes: self.grid.len(),
            reached: reached.count(),
            unit: (self.problem.axes.iter().map(|axis| unit(axis.coordinate)))
                .fold(SiUnit::ONE, SiUnit::times),
            size: (self.problem.axes.iter().map(|a| a.to - a.from)).product(),
            reached_size: self.size(&reached, &whole, &cuts),
            modes: each(self.modes, &(), |(), mode| {
                let of = &of_modes[mode];
                let nodes = NodeSet::new(self.grid, of.iter().map(node)).count();
                let within = of.iter().filter(|s| whole(s));
                let within = NodeSet::new(self.grid, within.map(node));
                let first = of.first().map(node);
                let at_first = of.iter().take_while(|s| Some(node(s)) == first);
                let joints = at_first.map(|s| {
                    brought(
                        self.problem,
                        self.reached_set.configuration(*s).joints,
                        true,
                    )
                });
                ModeReport {
                    mode: mode + 1,
                    nodes,
                    within: within.count(),
                    size: self.size(&within, &of_mode(mode), &cuts),
                    repeated: of.len() - nodes,
                    joints: joints
                        .min_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal))
                        .unwrap_or_default(),
                }
            }),
            cells: self.cells(&numbers),
            aspects,
            curves: Vec::new(),
            points: crossings
                .iter()
                .filter(|crossing| !crossing.again)
                .filter_map(|crossing| {
                    let node = self.reached_set.solution(crossing.solution).node;
                    let mut at = self.grid.values(node);
                    let along = crossing.direction / 2;
                    let next = self.grid.neighbour(node, crossing.direction)?;
                    let end = self.grid.values(next)[along];
                    at[along] += crossing.part * (end - at[along]);
                    Some(BoundaryPoint {
                        kind: named(self.problem, crossing.kind),
                        ends_reach: crossing.kind.ends_reach(),
                        mode: self.mode[crossing.solution]? + 1,
                        at,
                        joints: brought(self.problem, &crossing.at.joints, false),
                    })
                })
                .collect(),
            unsure,
            parts: aspects::parts(self.grid.dimensions()),
            searched: [0; 2],
            probed: [0; 2],
            outside: 0,
            seed: 0,
            home: home.map(home_report),
            interrupted: false,
            normalising_length: mechanism.characteristic_length(),
        }
    }

    /// Coordinates held but not mapped, with their values.
    fn held(&self) -> Vec<(Coordinate, f64)> {
        let question = &self.problem.question;
        let (held, start) = (question.held().joints, question.start());
        let joints = (0..held.len()).filter(|joint| held[*joint]);
        let joints = joints.map(|joint| (Coordinate::Joint(joint), start.joints[joint]));
        let platforms = (0..start.platforms.len()).flat_map(|platform| {
            let values = question.held_values(platform).into_iter();
            values.map(move |(c, value)| (Coordinate::Pose(platform, c), value))
        });
        let mapped = |of: &Coordinate| self.problem.axes.iter().any(|axis| axis.coordinate == *of);
        let all = joints.chain(platforms);
        all.filter(|(of, _)| !mapped(of)).collect()
    }

    /// Coordinates of platforms that are neither mapped nor held.
    pub fn following(&self) -> impl Iterator<Item = (usize, PoseCoordinate)> {
        let platforms = 0..self.problem.mechanism.platforms().len();
        let all = platforms.flat_map(|p| PoseCoordinate::ALL.map(|c| (p, c)));
        all.filter(|&(p, c)| {
            let values = self.problem.question.held_values(p);
            !values.iter().any(|(held, _)| *held == c)
        })
    }

    /// Size of the part of a region in which a solution satisfies `belongs`, in the units of the mapped coordinates.
    fn size(
        &self,
        region: &NodeSet,
        belongs: &(dyn Fn(&usize) -> bool + Sync),
        cuts: &Cuts,
    ) -> f64 {
        let reach = |node: usize, direction: usize| {
            let solutions = self.reached_set.at(node).filter(belongs);
            let cut = |s: usize| cuts.get(&(s, direction)).copied().unwrap_or(0.5);
            solutions.map(cut).fold(0.0, f64::max)
        };
        aspects::size(self.grid, region, &reach)
    }

    /// The aspects, and for the first solution of each its number.
    fn aspects(&self, cuts: &Cuts) -> (Vec<AspectReport>, Vec<Option<usize>>) {
        let mut of: Vec<(usize, Vec<usize>)> = Vec::new();
        let mut places = vec![None; self.reached_set.len()];
        for (s, aspect) in self.aspect.iter().enumerate() {
            if let (Some(first), Some(_)) = (*aspect, self.mode[s]) {
                let place = *places[first].get_or_insert_with(|| {
                    of.push((first, Vec::new()));
                    of.len() - 1
                });
                of[place].1.push(s);
            }
        }
        let indicators = |s: usize| &self.reached_set.solution(s).indicators;
        let sign = |x: f64, known: bool| match (known, x < 0.0) {
            (false, _) => 0,
            (_, true) => -1,
            (_, false) => 1,
        };
        let mut all: Vec<(usize, AspectReport)> = each(of.len(), &(), |(), i| {
            let (first, ref solutions) = of[i];
            let belongs = |s: &usize| self.aspect[*s] == Some(first);
            let region = NodeSet::new(
                self.grid,
                solutions.iter().map(|s| self.reached_set.solution(*s).node),
            );
            let finite: Vec<usize> = (solutions.iter().copied())
                .filter(|s| indicators(*s).condition.is_finite())
                .collect();
            // of nodes that are as good but for rounding the first
            let first_of = |wanted: f64| {
                let of = |s: usize| indicators(s).condition;
                let mut alike = finite
                    .iter()
                    .filter(|s| (of(**s) / wanted - 1.0).abs() < ROUNDING);
                alike.next().map(|s| Conditioned {
                    at: self.grid.values(self.reached_set.solution(*s).node),
                    condition: of(*s),
                })
            };
            let conditions = finite.iter().map(|s| indicators(*s).condition);
            let report = AspectReport {
                aspect: 0,
                mode: self.mode[first].map_or(0, |mode| mode + 1),
                nodes: solutions.len(),
                size: self.size(&region, &belongs, cuts),
                direct: sign(indicators(first).direct, self.problem.tells_direct()),
                inverse: sign(indicators(first).inverse, self.problem.tells_inverse()),
                best: first_of(conditions.clone().fold(f64::INFINITY, f64::min)),
                worst: first_of(conditions.fold(0.0, f64::max)),
            };
            (first, report)
        });
        sort_by(&mut all, |a, b| {
            let order = a.1.mode.cmp(&b.1.mode).then(b.1.nodes.cmp(&a.1.nodes));
            order.then_with(|| {
                let node = |first: usize| self.reached_set.solution(first).node;
                node(a.0).cmp(&node(b.0)).then(a.0.cmp(&b.0))
            })
        });
        let mut numbers = places;
        for (i, (first, _)) in all.iter().enumerate() {
            numbers[*first] = Some(i + 1);
        }
        let reports = all
            .into_iter()
            .enumerate()
            .map(|(i, (_, report))| AspectReport {
                aspect: i + 1,
                ..report
            });
        (reports.collect(), numbers)
    }
}

/// The joints, angles in the turn of home and within limits, or in (−π, π]; all of the latter kind where modes are compared.
fn brought(problem: &MapProblem, joints: &[f64], plain: bool) -> Vec<f64> {
    let mut joints = joints.to_vec();
    bring(problem, &mut joints, plain);
    joints
}

fn bring(problem: &MapProblem, joints: &mut [f64], plain: bool) {
    for (joint, value) in joints.iter_mut().enumerate() {
        if problem.turns[joint] {
            *value = match plain {
                true => turn_near(*value, ROUNDING),
                false => problem.by_home(joint, *value),
            };
        }
    }
}
