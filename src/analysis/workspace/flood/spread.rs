//! What was reached so far, in the parts of the grid.

use super::arrivals::Moving;
use super::neighbour::{Flood, Step};
use super::reached::{Link, Name, NodeSolution, ReachedSet};
use super::tile::{Task, Tile, Tiling};
use crate::analysis::workspace::problem::Grid;
use crate::mechanism::ConfigurationRef;

/// What was reached so far.
pub(crate) struct Spread {
    pub tiling: Tiling,
    pub tiles: Vec<Tile>,
    /// Solutions of different parts that are linked.
    seams: Vec<[Name; 2]>,
}

impl Spread {
    pub fn new(grid: &Grid) -> Self {
        let tiling = Tiling::new(grid);
        Spread {
            tiles: tiling.tiles(grid),
            seams: Vec::new(),
            tiling,
        }
    }

    pub fn solution(&self, name: Name) -> &NodeSolution {
        &self.tiles[name.tile as usize].solutions.all[name.solution as usize]
    }

    pub fn link_mut(&mut self, name: Name, direction: usize) -> &mut Link {
        &mut self.tiles[name.tile as usize].solutions.all[name.solution as usize].links[direction]
    }

    pub fn link(&mut self, from: Name, direction: usize, to: Name) {
        if from.tile == to.tile {
            let tile = &mut self.tiles[from.tile as usize];
            return tile.link(from.solution as usize, direction, to.solution as usize);
        }
        self.seams.push([from, to]);
        *self.link_mut(from, direction) = Link::To(to);
        let back = self.link_mut(to, direction ^ 1);
        if *back == Link::Open {
            *back = Link::To(from);
        }
    }

    /// The solution of a node with this configuration.
    pub fn known(&self, fill: &Flood, node: usize, at: Moving) -> Option<Name> {
        let tile = &self.tiles[self.tiling.of(fill.grid, node)];
        fill.known(tile.moving_at(fill.grid, node), at)
    }

    /// Whether a solution of a node has this configuration, whatever its motions.
    pub fn has(&self, fill: &Flood, node: usize, at: ConfigurationRef<f64>) -> bool {
        let tile = &self.tiles[self.tiling.of(fill.grid, node)];
        let mut solutions = tile.moving_at(fill.grid, node);
        solutions.any(|(_, known)| fill.metric.same(known.at, at))
    }

    pub fn len(&self) -> usize {
        self.tiles.iter().map(|tile| tile.solutions.all.len()).sum()
    }

    /// The node that a step leads to.
    pub fn ahead(&self, grid: &Grid, (from, direction): Task) -> Option<usize> {
        self.tiles[from.tile as usize].ahead(grid, from.solution as usize, direction)
    }

    /// The way from a solution to its neighbour.
    pub fn step(&self, fill: &Flood, (from, direction): Task) -> Step<'_> {
        self.tiles[from.tile as usize].step(fill, from.solution as usize, direction)
    }

    pub fn reached_set(self, grid: &Grid) -> ReachedSet {
        let tiles = self.tiles.into_iter().map(Tile::finished);
        let bands = self.tiling.bands(grid);
        ReachedSet::new(tiles.collect(), &self.seams, &bands)
    }

    /// Adds what was not reached before.
    pub fn add(&mut self, fill: &Flood, node: usize, arrival: Moving) -> Name {
        let tile = self.tiling.of(fill.grid, node);
        self.tiles[tile].add(fill, node, arrival)
    }

    /// Steps of all parts, in their order, which are no longer kept there.
    pub fn taken(&mut self, of: impl Fn(&mut Tile) -> &mut Vec<Task>) -> Vec<Task> {
        let tiles = self.tiles.iter_mut();
        tiles.flat_map(|tile| std::mem::take(of(tile))).collect()
    }

    /// Defers steps that are not certain.
    pub fn keep(&mut self, tasks: Vec<Task>) {
        for task in tasks {
            self.tiles[task.0.tile as usize].unsure.push(task);
        }
    }
}
