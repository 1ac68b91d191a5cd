//! Parts of the grid; one thread spreads over each independently.

use super::arrivals::{Arrivals, Moving};
use super::neighbour::{Flood, Step, one_each};
use super::reached::{Link, Name, NodeSolution, NodeSolutions};
use super::step::Steps;
use crate::algebra::BATCH;
use crate::analysis::workspace::problem::{Grid, MOST_AXES, MOST_DIRECTIONS};
use crate::linear::{join, root};

/// How the grid is parted.
pub(crate) struct Tiling {
    /// Nodes along each side of a part, at most.
    sides: [usize; MOST_AXES],
    counts: [usize; MOST_AXES],
}

impl Tiling {
    pub fn new(grid: &Grid) -> Self {
        /// Nodes of a part, about: fronts in it are to fill several packs.
        const NODES: f64 = 2000.0;
        let wanted = NODES.powf(1.0 / grid.dimensions() as f64).ceil() as usize;
        let mut tiling = Tiling {
            sides: [1; MOST_AXES],
            counts: [1; MOST_AXES],
        };
        for axis in 0..grid.dimensions() {
            let nodes = grid.count(axis);
            let side = nodes.div_ceil(nodes.div_ceil(wanted));
            (tiling.sides[axis], tiling.counts[axis]) = (side, nodes.div_ceil(side));
        }
        tiling
    }

    /// How many parts and nodes there are for each place along the last axis; these follow one another.
    pub fn bands(&self, grid: &Grid) -> Vec<(usize, usize)> {
        let last = grid.dimensions() - 1;
        let tiles = self.counts[..last].iter().product();
        let nodes: usize = (0..last).map(|axis| grid.count(axis)).product();
        let sides = (0..self.counts[last]).map(|place| {
            let side = self.sides[last];
            side.min(grid.count(last) - place * side)
        });
        sides.map(|side| (tiles, side * nodes)).collect()
    }

    /// The part with a node.
    pub fn of(&self, grid: &Grid, node: usize) -> usize {
        let axes = (0..grid.dimensions()).rev();
        axes.fold(0, |tile, axis| {
            tile * self.counts[axis] + grid.place(node, axis) / self.sides[axis]
        })
    }

    /// All parts, nothing reached in them yet.
    pub fn tiles(&self, grid: &Grid) -> Vec<Tile> {
        (0..self.counts.iter().product())
            .map(|number| {
                let (mut low, mut sides) = ([0; MOST_AXES], [1; MOST_AXES]);
                let mut left = number;
                for axis in 0..grid.dimensions() {
                    low[axis] = left % self.counts[axis] * self.sides[axis];
                    sides[axis] = self.sides[axis].min(grid.count(axis) - low[axis]);
                    left /= self.counts[axis];
                }
                Tile {
                    number,
                    low,
                    sides,
                    solutions: NodeSolutions::default(),
                    motions: Vec::new(),
                    last: vec![None; sides.iter().product()],
                    before: Vec::new(),
                    roots: Vec::new(),
                    front: Vec::new(),
                    seams: Vec::new(),
                    unsure: Vec::new(),
                }
            })
            .collect()
    }
}

/// A step to be taken: from a solution in a direction.
pub(crate) type Task = (Name, usize);

/// A part of the grid with what was reached in it, in the order in which it was.
pub(crate) struct Tile {
    number: usize,
    low: [usize; MOST_AXES],
    sides: [usize; MOST_AXES],
    pub solutions: NodeSolutions,
    /// The motions of its solutions, one after another.
    motions: Vec<f64>,
    /// For each of its nodes the last solution there, and for each solution the one before it.
    last: Vec<Option<u32>>,
    before: Vec<Option<u32>>,
    /// For each solution the first, so far as is known, of those connected with it in here.
    roots: Vec<usize>,
    /// Solutions that no steps were made from yet.
    front: Vec<usize>,
    /// Steps that lead out of it.
    pub seams: Vec<Task>,
    /// Steps in it that are too long to be sure.
    pub unsure: Vec<Task>,
}

impl Tile {
    pub fn grows(&self) -> bool {
        !self.front.is_empty()
    }

    fn place(&self, grid: &Grid, node: usize) -> Option<usize> {
        let (mut place, mut stride) = (0, 1);
        for axis in 0..grid.dimensions() {
            let along = grid.place(node, axis).checked_sub(self.low[axis])?;
            if along >= self.sides[axis] {
                return None;
            }
            place += stride * along;
            stride *= self.sides[axis];
        }
        Some(place)
    }

    fn solutions_at(&self, grid: &Grid, node: usize) -> impl Iterator<Item = usize> {
        let last = self.place(grid, node).and_then(|place| self.last[place]);
        let solutions = std::iter::successors(last, |solution| self.before[*solution as usize]);
        solutions.map(|solution| solution as usize)
    }

    /// The solutions at a node with their configurations and motions.
    pub fn moving_at(&self, grid: &Grid, node: usize) -> impl Iterator<Item = (Name, Moving<'_>)> {
        let solutions = self.solutions_at(grid, node);
        solutions.map(|solution| (self.name(solution), self.moving(solution)))
    }

    /// The way from a solution to its neighbour.
    pub fn step(&self, fill: &Flood, solution: usize, direction: usize) -> Step<'_> {
        fill.step(
            self.solutions.all[solution].node,
            self.moving(solution),
            direction,
        )
    }

    pub fn ahead(&self, grid: &Grid, solution: usize, direction: usize) -> Option<usize> {
        grid.neighbour(self.solutions.all[solution].node, direction)
    }

    fn name(&self, solution: usize) -> Name {
        Name::new(self.number, solution)
    }

    /// A solution with its motions.
    pub fn moving(&self, solution: usize) -> Moving<'_> {
        let length = self.motions.len() / self.solutions.all.len();
        Moving {
            at: self.solutions.at.get(solution),
            motions: &self.motions[solution * length..][..length],
            indicators: &self.solutions.all[solution].indicators,
        }
    }

    /// Its solutions, and for each the first of those connected with it in here.
    pub fn finished(mut self) -> (NodeSolutions, Vec<usize>) {
        let roots = (0..self.solutions.all.len()).map(|solution| root(&mut self.roots, solution));
        let roots = roots.collect();
        (self.solutions, roots)
    }

    /// A name for what a solution is connected with, so far as is known.
    pub fn root(&mut self, solution: usize) -> Name {
        let root = root(&mut self.roots, solution);
        self.name(root)
    }

    /// Adds what was not reached before, at one of its nodes.
    pub fn add(&mut self, fill: &Flood, node: usize, arrival: Moving) -> Name {
        let new = self.solutions.all.len();
        if new == 0 {
            // if one node of a part is reached, most of its nodes are
            let nodes = self.last.len();
            self.solutions.all.reserve(nodes);
            self.solutions.at.reserve(nodes, arrival.at);
            self.motions.reserve(nodes * arrival.motions.len());
        }
        let solution = NodeSolution {
            node,
            within: fill.problem.allows(arrival.at.joints),
            indicators: arrival.indicators.clone(),
            links: [Link::Open; MOST_DIRECTIONS],
        };
        if fill.goes_on_from(&solution) {
            self.front.push(new);
        }
        self.solutions.all.push(solution);
        self.solutions.at.push(arrival.at);
        self.motions.extend(arrival.motions);
        let place = self.place(fill.grid, node);
        let place = place.expect("a node of this part");
        let name = self.name(new);
        self.before.push(self.last[place].replace(name.solution));
        self.roots.push(new);
        name
    }

    pub fn link(&mut self, from: usize, direction: usize, to: usize) {
        let (from_name, to_name) = (self.name(from), self.name(to));
        self.solutions.all[from].links[direction] = Link::To(to_name);
        let back = &mut self.solutions.all[to].links[direction ^ 1];
        if *back == Link::Open {
            *back = Link::To(from_name);
        }
        join(&mut self.roots, from, to);
    }

    /// Spreads within the part as far as single steps are certain not to change branch.
    pub fn grow(&mut self, fill: &Flood, steps: &mut Steps) {
        let mut storage = Vec::new();
        let mut arrivals = Arrivals::default();
        while self.grows() && self.solutions.all.len() <= fill.most {
            let front = std::mem::take(&mut self.front);
            let mut waiting = self.inside(fill.grid, &front);
            while !waiting.is_empty() {
                waiting.retain(|&(s, d)| !self.linked(fill, s, d, &mut storage));
                let (now, later) = one_each(waiting, |&(s, d)| {
                    let node = self.ahead(fill.grid, s, d);
                    (node, root(&mut self.roots, s))
                });
                for pack in now.chunks(BATCH) {
                    let planned = pack.iter().map(|&(s, d)| self.step(fill, s, d));
                    let planned: Vec<Step> = planned.collect();
                    fill.sure(steps, &planned, &mut arrivals, &mut storage);
                    for (&(s, d), arrival) in pack.iter().zip(arrivals.iter()) {
                        match arrival {
                            Some(arrival) => self.arrive(fill, s, d, arrival),
                            None => self.unsure.push((self.name(s), d)),
                        }
                    }
                }
                waiting = later;
            }
        }
    }

    /// The steps from solutions to neighbours in here; those that lead out are kept.
    fn inside(&mut self, grid: &Grid, front: &[usize]) -> Vec<(usize, usize)> {
        let mut inside = Vec::new();
        for &s in front {
            for d in 0..2 * grid.dimensions() {
                match self.ahead(grid, s, d) {
                    None => {}
                    Some(node) if self.place(grid, node).is_some() => inside.push((s, d)),
                    Some(_) => self.seams.push((self.name(s), d)),
                }
            }
        }
        inside
    }

    /// Whether a solution is linked, or can be with the one that both tangent predictions agree on.
    fn linked(&mut self, fill: &Flood, s: usize, d: usize, storage: &mut Vec<f64>) -> bool {
        let solution = &self.solutions.all[s];
        if solution.links[d] != Link::Open {
            return true;
        }
        let Some(node) = self.ahead(fill.grid, s, d) else {
            return true;
        };
        let near = fill.near(
            &self.step(fill, s, d),
            self.moving_at(fill.grid, node),
            storage,
        );
        if let Some(near) = near {
            self.link(s, d, near.solution as usize);
        }
        near.is_some()
    }

    fn arrive(&mut self, fill: &Flood, s: usize, d: usize, arrival: Moving) {
        let Some(node) = self.ahead(fill.grid, s, d) else {
            return;
        };
        let known = fill.known(self.moving_at(fill.grid, node), arrival);
        let to = known.unwrap_or_else(|| self.add(fill, node, arrival));
        self.link(s, d, to.solution as usize);
    }
}
