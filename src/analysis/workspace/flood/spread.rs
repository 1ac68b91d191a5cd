//! What was reached so far, in the parts of the grid.

use super::arrivals::Moving;
use super::filled::{Filled, Link, Name, Sheet};
use super::neighbour::{Fill, Step};
use super::tile::{Task, Tile, Tiling};
use crate::analysis::workspace::problem::Grid;
use crate::mechanism::ConfigurationRef;

/// What was reached so far.
pub(crate) struct Spread {
    pub tiling: Tiling,
    pub tiles: Vec<Tile>,
    /// Sheets of different parts that are linked.
    seams: Vec<[Name; 2]>,
}

impl Spread {
    /// Nothing yet.
    pub fn new(grid: &Grid) -> Self {
        let tiling = Tiling::new(grid);
        Spread {
            tiles: tiling.tiles(grid),
            seams: Vec::new(),
            tiling,
        }
    }

    pub fn sheet(&self, name: Name) -> &Sheet {
        &self.tiles[name.tile as usize].sheets.all[name.sheet as usize]
    }

    pub fn link_mut(&mut self, name: Name, direction: usize) -> &mut Link {
        &mut self.tiles[name.tile as usize].sheets.all[name.sheet as usize].links[direction]
    }

    /// Links two sheets.
    pub fn link(&mut self, from: Name, direction: usize, to: Name) {
        if from.tile == to.tile {
            let tile = &mut self.tiles[from.tile as usize];
            return tile.link(from.sheet as usize, direction, to.sheet as usize);
        }
        self.seams.push([from, to]);
        *self.link_mut(from, direction) = Link::To(to);
        let back = self.link_mut(to, direction ^ 1);
        if *back == Link::Open {
            *back = Link::To(from);
        }
    }

    /// The sheet of a node with this configuration.
    pub fn known(&self, fill: &Fill, node: usize, at: ConfigurationRef<f64>) -> Option<Name> {
        let tile = &self.tiles[self.tiling.of(fill.grid, node)];
        fill.known(tile.at(fill.grid, node), at)
    }

    pub fn len(&self) -> usize {
        self.tiles.iter().map(|tile| tile.sheets.len()).sum()
    }

    /// The way from a sheet to its neighbour.
    pub fn step(&self, fill: &Fill, (from, direction): Task) -> Step<'_> {
        self.tiles[from.tile as usize].step(fill, from.sheet as usize, direction)
    }

    /// All of it.
    pub fn filled(self, grid: &Grid) -> Filled {
        let tiles = self.tiles.into_iter().map(Tile::finished);
        let bands = self.tiling.bands(grid);
        Filled::new(tiles.collect(), &self.seams, &bands)
    }

    /// Adds what was not reached before.
    pub fn add(&mut self, fill: &Fill, node: usize, arrival: Moving) -> Name {
        let tile = self.tiling.of(fill.grid, node);
        self.tiles[tile].add(fill, node, arrival)
    }

    /// Steps of all parts, in their order, which are no longer kept there.
    pub fn taken(&mut self, of: impl Fn(&mut Tile) -> &mut Vec<Task>) -> Vec<Task> {
        let tiles = self.tiles.iter_mut();
        tiles.flat_map(|tile| std::mem::take(of(tile))).collect()
    }

    /// Puts steps that are not sure by for later.
    pub fn keep(&mut self, tasks: Vec<Task>) {
        for task in tasks {
            self.tiles[task.0.tile as usize].unsure.push(task);
        }
    }
}
