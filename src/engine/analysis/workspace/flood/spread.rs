//! Solutions reached so far, in the order of discovery.

use super::arrivals::TangentSolutionRef;
use super::configurations::Configurations;
use super::neighbour::{EdgeStep, Flood};
use super::reached::{EdgeLink, NodeSolution, ReachedSet, SolutionNumber};
use crate::analysis::workspace::problem::{Grid, MOST_DIRECTIONS};
use crate::linear::{join, root};
use crate::mechanism::ConfigurationRef;

/// A step to be taken: from a solution in a direction.
pub(crate) type GridTask = (usize, usize);

/// Solutions reached so far, and the steps that remain.
#[derive(Default)]
pub(crate) struct GrowingSet {
    solutions: Vec<NodeSolution>,
    at: Configurations,
    /// The motions of all solutions, one after another.
    motions: Vec<f64>,
    /// For each node the last solution there, and for each solution the one before it.
    last: Vec<Option<SolutionNumber>>,
    before: Vec<Option<SolutionNumber>>,
    /// For each solution the first known of those connected with it.
    roots: Vec<usize>,
    /// Solutions that no steps were made from yet.
    front: Vec<usize>,
    /// Steps that are too long to be sure.
    pub unsure: Vec<GridTask>,
}

impl GrowingSet {
    pub fn new(grid: &Grid) -> Self {
        GrowingSet {
            last: vec![None; grid.len()],
            ..GrowingSet::default()
        }
    }

    pub fn len(&self) -> usize {
        self.solutions.len()
    }

    pub fn solution(&self, number: usize) -> &NodeSolution {
        &self.solutions[number]
    }

    pub fn link_mut(&mut self, number: usize, direction: usize) -> &mut EdgeLink {
        &mut self.solutions[number].links[direction]
    }

    pub fn link(&mut self, from: usize, direction: usize, to: usize) {
        *self.link_mut(from, direction) = EdgeLink::To(short(to));
        let back = self.link_mut(to, direction ^ 1);
        if *back == EdgeLink::Open {
            *back = EdgeLink::To(short(from));
        }
        join(&mut self.roots, from, to);
    }

    /// The first known of all solutions connected with this one.
    pub fn root(&mut self, number: usize) -> usize {
        root(&mut self.roots, number)
    }

    /// A solution with its motions.
    fn moving(&self, number: usize) -> TangentSolutionRef<'_> {
        let length = self.motions.len() / self.solutions.len();
        TangentSolutionRef {
            at: self.at.get(number),
            motions: &self.motions[number * length..][..length],
            indicators: &self.solutions[number].indicators,
        }
    }

    /// The solutions at a node with their configurations and motions.
    pub fn moving_at(&self, node: usize) -> impl Iterator<Item = (usize, TangentSolutionRef<'_>)> {
        let before = |number: &SolutionNumber| self.before[*number as usize];
        let numbers = std::iter::successors(self.last[node], before);
        numbers.map(|number| (number as usize, self.moving(number as usize)))
    }

    /// The solution of a node with this configuration.
    pub fn known(&self, fill: &Flood, node: usize, at: TangentSolutionRef) -> Option<usize> {
        let mut solutions = self.moving_at(node);
        let known = solutions.find(|(_, known)| fill.metric.meets(*known, at));
        known.map(|(number, _)| number)
    }

    /// True if a solution of a node has this configuration, whatever its motions.
    pub fn has(&self, fill: &Flood, node: usize, at: ConfigurationRef<f64>) -> bool {
        let mut solutions = self.moving_at(node);
        solutions.any(|(_, known)| fill.metric.same(known.at, at))
    }

    /// The node that a step leads to.
    pub fn ahead(&self, grid: &Grid, (from, direction): GridTask) -> Option<usize> {
        grid.neighbour(self.solutions[from].node, direction)
    }

    /// The way from a solution to its neighbour, of zero length if there is none.
    pub fn step(&self, grid: &Grid, (from, direction): GridTask) -> EdgeStep<'_> {
        let (node, axis) = (self.solutions[from].node, direction / 2);
        let next = grid.neighbour(node, direction).unwrap_or(node);
        let to = grid.point(next);
        let here = grid.coordinate(axis, grid.place(node, axis));
        EdgeStep {
            from: self.moving(from),
            axis,
            to,
            change: to[axis] - here,
        }
    }

    /// Adds an arrival if it is new.
    pub fn add(&mut self, fill: &Flood, node: usize, arrival: TangentSolutionRef) -> usize {
        let new = self.solutions.len();
        let solution = NodeSolution {
            node,
            within: fill.problem.allows(arrival.at.joints),
            indicators: arrival.indicators.clone(),
            links: [EdgeLink::Open; MOST_DIRECTIONS],
        };
        if fill.goes_on_from(&solution) {
            self.front.push(new);
        }
        self.solutions.push(solution);
        self.at.push(arrival.at);
        self.motions.extend(arrival.motions);
        self.before.push(self.last[node].replace(short(new)));
        self.roots.push(new);
        new
    }

    /// The steps from all that is new.
    pub fn onward(&mut self, grid: &Grid) -> Vec<GridTask> {
        let directions = 0..2 * grid.dimensions();
        let front = std::mem::take(&mut self.front).into_iter();
        let steps = front.flat_map(|new| directions.clone().map(move |d| (new, d)));
        steps
            .filter(|step| self.ahead(grid, *step).is_some())
            .collect()
    }

    pub fn reached_set(mut self, grid: &Grid) -> ReachedSet {
        self.motions = Vec::new();
        for number in 0..self.len() {
            self.roots[number] = self.root(number);
        }
        ReachedSet::new(grid.len(), self.solutions, &self.at, &self.roots)
    }
}

fn short(number: usize) -> SolutionNumber {
    SolutionNumber::try_from(number).expect("as many do not fit in memory")
}
