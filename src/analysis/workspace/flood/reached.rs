//! What was reached, in the order of its nodes.

use std::ops::Range;

use super::configurations::Configurations;
use super::metric::Metric;
use crate::analysis::workspace::problem::{Indicators, MOST_DIRECTIONS};
use crate::linear::{join, root};
use crate::mechanism::ConfigurationRef;
use crate::solve::each;

/// An assembled configuration at a node.
#[derive(Clone, Debug)]
pub(crate) struct NodeSolution {
    pub node: usize,
    pub indicators: Indicators,
    /// Whether all joints are within their limits.
    pub within: bool,
    /// For each direction of the grid.
    pub links: [Link; MOST_DIRECTIONS],
}

/// Solutions of one part of the grid.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeSolutions {
    pub all: Vec<NodeSolution>,
    pub at: Configurations,
}

/// Which solution of which part of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Name {
    pub tile: u32,
    pub solution: u32,
}

/// How a node goes on in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Link {
    /// Not examined yet, or outside the box.
    Open,
    /// To this solution there, by regular motion.
    To(Name),
    /// The mode folds back before the neighbour.
    Fold,
    /// No step that is certain not to change branch leads on.
    Stuck,
}

/// All that was reached, numbered in the order of the nodes.
pub(crate) struct ReachedSet {
    tiles: Vec<NodeSolutions>,
    names: Vec<Name>,
    /// The numbers by name.
    numbers: Vec<Vec<usize>>,
    /// For each node its first solution, and their number at the end.
    firsts: Vec<usize>,
    /// For each solution its node, and whether all its joints are within their limits.
    pub nodes: Vec<usize>,
    pub within: Vec<bool>,
    /// For each solution one of those connected with it, the same for all of them.
    pub roots: Vec<usize>,
    /// In the order of their nodes.
    pub bands: Vec<Band>,
}

/// Parts of the grid whose nodes follow one another, and so do the numbers of their solutions.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    tiles: Range<usize>,
    pub numbers: Range<usize>,
}

impl ReachedSet {
    /// `tiles` are the solutions of each part of the grid, each with the first connected with it in
    /// there; `seams` connect others; `bands` are the numbers of parts and nodes of each.
    pub fn new(
        tiles: Vec<(NodeSolutions, Vec<usize>)>,
        seams: &[[Name; 2]],
        bands: &[(usize, usize)],
    ) -> Self {
        let nodes = bands.iter().map(|(_, nodes)| nodes).sum();
        let mut counts = vec![0; nodes];
        let all = || tiles.iter().flat_map(|(solutions, _)| &solutions.all);
        all().for_each(|solution| counts[solution.node] += 1);
        let mut firsts = vec![0; nodes + 1];
        for (node, count) in counts.iter().enumerate() {
            firsts[node + 1] = firsts[node] + count;
        }
        let len = firsts[nodes];
        let mut reached_set = ReachedSet {
            names: vec![Name::new(0, 0); len],
            numbers: Vec::with_capacity(tiles.len()),
            nodes: vec![0; len],
            within: vec![false; len],
            roots: vec![0; len],
            bands: Vec::with_capacity(bands.len()),
            tiles: Vec::with_capacity(tiles.len()),
            firsts,
        };
        let mut next = reached_set.firsts.clone();
        for (tile, (solutions, roots)) in tiles.into_iter().enumerate() {
            let numbers: Vec<usize> = (solutions.all.iter())
                .map(|at| {
                    next[at.node] += 1;
                    next[at.node] - 1
                })
                .collect();
            for (i, (&number, at)) in numbers.iter().zip(&solutions.all).enumerate() {
                reached_set.names[number] = Name::new(tile, i);
                reached_set.nodes[number] = at.node;
                reached_set.within[number] = at.within;
                reached_set.roots[number] = numbers[roots[i]];
            }
            reached_set.numbers.push(numbers);
            reached_set.tiles.push(solutions);
        }
        let (mut tile, mut node) = (0, 0);
        for (tiles, nodes) in bands {
            reached_set.bands.push(Band {
                tiles: tile..tile + tiles,
                numbers: reached_set.firsts[node]..reached_set.firsts[node + nodes],
            });
            (tile, node) = (tile + tiles, node + nodes);
        }
        let seams = seams.iter().map(|ends| ends.map(|s| reached_set.number(s)));
        let seams: Vec<[usize; 2]> = seams.collect();
        reached_set.connect(seams);
        reached_set
    }

    /// The solutions of a band with their numbers, in the order in which they are kept.
    pub fn kept(
        &self,
        band: &Band,
    ) -> impl Iterator<Item = (usize, &NodeSolution, ConfigurationRef<'_, f64>)> {
        band.tiles.clone().flat_map(|tile| {
            let (solutions, numbers) = (&self.tiles[tile], &self.numbers[tile]);
            let all = numbers.iter().zip(&solutions.all).enumerate();
            all.map(|(i, (number, solution))| (*number, solution, solutions.at.get(i)))
        })
    }

    pub fn connect(&mut self, pairs: Vec<[usize; 2]>) {
        (pairs.into_iter()).for_each(|[a, b]| join(&mut self.roots, a, b));
        for s in 0..self.roots.len() {
            self.roots[s] = root(&mut self.roots, s);
        }
    }

    /// For each solution the first of its aspect: of those of its signs that links connect with it;
    /// none outside limits and on singularities.
    pub fn aspects(&self) -> Vec<Option<usize>> {
        let parts = each(self.tiles.len(), &(), |(), tile| self.aspects_in(tile));
        let mut roots: Vec<usize> = (0..self.len()).collect();
        let mut parted = vec![false; self.len()];
        for (numbers, (within, _)) in self.numbers.iter().zip(&parts) {
            for (&number, root) in numbers.iter().zip(within) {
                if let Some(root) = *root {
                    (roots[number], parted[number]) = (numbers[root], true);
                }
            }
        }
        for [a, b] in parts.into_iter().flat_map(|(_, across)| across) {
            join(&mut roots, self.number(a), self.number(b));
        }
        let mut firsts = vec![None; self.len()];
        let all = parted
            .into_iter()
            .enumerate()
            .map(|(s, parted)| parted.then(|| *firsts[root(&mut roots, s)].get_or_insert(s)));
        all.collect()
    }

    /// For each solution of a part of the grid one of its aspect connected with it in there, the
    /// same for all of them; and what of its signs is linked with it elsewhere.
    fn aspects_in(&self, tile: usize) -> (Vec<Option<usize>>, Vec<[Name; 2]>) {
        let solutions = &self.tiles[tile].all;
        let kinds: Vec<Option<Signs>> = solutions.iter().map(signs).collect();
        let mut roots: Vec<usize> = (0..solutions.len()).collect();
        let mut across = Vec::new();
        for (s, solution) in solutions
            .iter()
            .enumerate()
            .filter(|(s, _)| kinds[*s].is_some())
        {
            for link in &solution.links {
                let Link::To(other) = *link else {
                    continue;
                };
                match other.tile as usize == tile {
                    true if kinds[s] == kinds[other.solution as usize] => {
                        join(&mut roots, s, other.solution as usize);
                    }
                    false if kinds[s] == signs(self.named(other)) => {
                        across.push([Name::new(tile, s), other]);
                    }
                    _ => {}
                }
            }
        }
        let all = kinds.iter().enumerate();
        let all = all.map(|(s, kind)| kind.map(|_| root(&mut roots, s)));
        (all.collect(), across)
    }

    pub fn len(&self) -> usize {
        self.names.len()
    }

    pub fn solution(&self, number: usize) -> &NodeSolution {
        self.named(self.names[number])
    }

    pub fn configuration(&self, number: usize) -> ConfigurationRef<'_, f64> {
        let name = self.names[number];
        self.tiles[name.tile as usize]
            .at
            .get(name.solution as usize)
    }

    pub fn named(&self, name: Name) -> &NodeSolution {
        &self.tiles[name.tile as usize].all[name.solution as usize]
    }

    /// The signs of a solution; none outside limits and on singularities.
    pub fn signs(&self, number: usize) -> Option<Signs> {
        signs(self.solution(number))
    }

    pub fn solutions(&self) -> impl Iterator<Item = (usize, &NodeSolution)> + Clone {
        (0..self.len()).map(|s| (s, self.solution(s)))
    }

    /// How many of something all solutions together have.
    pub fn count(&self, of: impl Fn(&NodeSolution) -> usize + Sync) -> usize {
        let counts = each(self.tiles.len(), &(), |(), tile| {
            self.tiles[tile].all.iter().map(&of).sum::<usize>()
        });
        counts.into_iter().sum()
    }

    pub fn number(&self, name: Name) -> usize {
        self.numbers[name.tile as usize][name.solution as usize]
    }

    pub fn at(&self, node: usize) -> Range<usize> {
        self.firsts[node]..self.firsts[node + 1]
    }

    /// The solution of a node with this configuration.
    pub fn known(&self, metric: &Metric, node: usize, at: ConfigurationRef<f64>) -> Option<usize> {
        let solutions = self.at(node);
        let same = solutions.filter(|s| metric.same(self.configuration(*s), at));
        let apart = |s: &usize| metric.apart(self.configuration(*s), at);
        // two modes may meet there
        same.min_by(|a, b| apart(a).total_cmp(&apart(b)))
    }
}

impl Name {
    pub fn new(tile: usize, solution: usize) -> Self {
        let short = |number: usize| u32::try_from(number).expect("as many do not fit in memory");
        Name {
            tile: short(tile),
            solution: short(solution),
        }
    }
}

/// Whether the determinants of direct and inverse singularities are negative, alike in an aspect.
pub(crate) type Signs = [bool; 2];

/// The signs of a solution; none outside limits and on singularities.
pub(crate) fn signs(solution: &NodeSolution) -> Option<Signs> {
    signs_of(&solution.indicators, solution.within)
}

/// The same of indicators, within limits or not.
pub(crate) fn signs_of(indicators: &Indicators, within: bool) -> Option<Signs> {
    let inside = within && indicators.direct != 0.0 && indicators.inverse != 0.0;
    inside.then_some([indicators.direct < 0.0, indicators.inverse < 0.0])
}
