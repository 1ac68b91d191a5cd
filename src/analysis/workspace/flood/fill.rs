//! Spreading over the grid from seeds: every node in every mode that regular steps lead to.

use super::super::TooManyNodes;
use super::arrivals::{Arrivals, Moving};
use super::edge::{Edge, Met};
use super::neighbour::{Flood, Step, in_packs, one_each};
use super::pace::End;
use super::reached::{Link, Name};
use super::spread::Spread;
use super::step::{Start, Steps};
use super::tile::{Task, Tile};
use crate::mechanism::Configuration;
use crate::solve::{Pool, Stage, Watch, each};

/// Parts of the grid spread over between two progress reports.
const PARTS: usize = 64;

/// Solutions looked up by one thread at once.
const JOB: usize = 128;

impl Flood<'_> {
    /// Spreads from assembled configurations at nodes: in all parts of the grid at once as far as
    /// single steps lead, then over their seams; last, where single steps are too long. What comes
    /// of several parts is merged in their order, whatever the number of threads.
    ///
    /// # Errors
    /// If more is reached than may be kept.
    pub fn spread(
        &self,
        spread: &mut Spread,
        steps: &Pool<Steps>,
        seeds: &[(usize, Configuration<f64>)],
        watch: &Watch,
    ) -> Result<(), TooManyNodes> {
        let starts: Vec<Start> = (seeds.iter())
            .map(|(node, at)| self.here(*node, at))
            .collect();
        let settled = self.settled(steps, &starts);
        let settled = settled.iter().flat_map(Arrivals::iter);
        for ((node, _), arrival) in seeds.iter().zip(settled) {
            if let Some(arrival) = arrival
                && spread.known(self, *node, arrival).is_none()
            {
                spread.add(self, *node, arrival);
            }
        }
        loop {
            self.grow(spread, steps, watch)?;
            if watch.is_stopped() {
                return Ok(());
            }
            let mut seams = spread.taken(|tile| &mut tile.seams);
            let mut failed = Vec::new();
            while !seams.is_empty() && !watch.stops(Stage::Reached, spread.len(), None) {
                let (now, later) = self.chosen(spread, seams);
                let arrivals = self.steps(spread, steps, &now);
                let arrivals = arrivals.iter().flat_map(Arrivals::iter);
                for (task, arrival) in now.iter().zip(arrivals) {
                    match arrival {
                        Some(arrival) => self.arrive(spread, *task, arrival),
                        None => failed.push(*task),
                    }
                }
                seams = later;
            }
            spread.keep(failed);
            if watch.is_stopped() {
                return Ok(());
            }
            if spread.tiles.iter().any(Tile::grows) {
                continue;
            }
            let unsure = spread.taken(|tile| &mut tile.unsure);
            let (now, later) = self.chosen(spread, unsure);
            if now.is_empty() || watch.stops(Stage::Reached, spread.len(), None) {
                return Ok(());
            }
            spread.keep(later);
            for (task, end) in now.iter().zip(self.ends(spread, steps, &now, watch)) {
                match end {
                    End::Arrived(arrival) => self.arrive(spread, *task, arrival.moving()),
                    End::Fold => *spread.link_mut(task.0, task.1) = Link::Fold,
                    End::Stuck => *spread.link_mut(task.0, task.1) = Link::Stuck,
                }
            }
        }
    }

    /// Spreads within each part independently.
    fn grow(
        &self,
        spread: &mut Spread,
        steps: &Pool<Steps>,
        watch: &Watch,
    ) -> Result<(), TooManyNodes> {
        for first in (0..spread.tiles.len()).step_by(PARTS) {
            if watch.stops(Stage::Reached, spread.len(), None) {
                break;
            }
            let here = spread.tiles[first..].iter_mut().take(PARTS);
            let growing: Vec<&mut Tile> = here.filter(|tile| tile.grows()).collect();
            if growing.is_empty() {
                continue;
            }
            steps.each_of(growing, |steps, tile| tile.grow(self, steps));
            let reached = spread.len();
            if reached > self.most {
                return Err(TooManyNodes { most: self.most });
            }
        }
        Ok(())
    }

    /// Links steps to known solutions, then chooses one step to each node from each mode; the others
    /// wait for what it finds.
    fn chosen(&self, spread: &mut Spread, tasks: Vec<Task>) -> (Vec<Task>, Vec<Task>) {
        let jobs: Vec<&[Task]> = tasks.chunks(JOB).collect();
        let found = each(jobs.len(), &Vec::new(), |storage, i| {
            let near = jobs[i].iter().map(|&task| {
                let node = spread.ahead(self.grid, task)?;
                let tile = &spread.tiles[spread.tiling.of(self.grid, node)];
                let there = tile.moving_at(self.grid, node);
                self.near(&spread.step(self, task), there, storage)
            });
            near.collect::<Vec<Option<Name>>>()
        });
        let mut left = Vec::new();
        for (&(from, d), found) in tasks.iter().zip(found.into_iter().flatten()) {
            match found {
                _ if spread.solution(from).links[d] != Link::Open => {}
                Some(to) => spread.link(from, d, to),
                None => left.push((from, d)),
            }
        }
        one_each(left, |&task| {
            let node = spread.ahead(self.grid, task);
            let Name { tile, solution } = task.0;
            (node, spread.tiles[tile as usize].root(solution as usize))
        })
    }

    /// Single steps, where they are sure.
    fn steps(&self, spread: &Spread, steps: &Pool<Steps>, tasks: &[Task]) -> Vec<Arrivals> {
        in_packs(steps, tasks, |steps, pack| {
            let planned = pack.iter().map(|task| spread.step(self, *task));
            let (mut arrivals, mut storage) = Default::default();
            self.sure(
                steps,
                &planned.collect::<Vec<Step>>(),
                &mut arrivals,
                &mut storage,
            );
            arrivals
        })
    }

    /// Where single steps are too long: by shorter ones, then along the curve, which is far slower.
    fn ends(
        &self,
        spread: &Spread,
        steps: &Pool<Steps>,
        tasks: &[Task],
        watch: &Watch,
    ) -> Vec<End> {
        let mut ends = self.paced(steps, spread, tasks);
        let open = tasks.iter().zip(&ends);
        let open = open.filter(|(_, end)| matches!(end, End::Stuck));
        let unsure: Vec<Task> = open.map(|(task, _)| *task).collect();
        let met = each(unsure.len(), &(), |(), i| {
            if watch.stops(Stage::Reached, spread.len(), None) {
                return Met::Nothing;
            }
            let step = spread.step(self, unsure[i]);
            let edge = Edge {
                axis: step.axis,
                values: self.grid.values(spread.solution(unsure[i].0).node),
                to: step.to[step.axis],
            };
            self.reach(&edge, &step.from.at.owned())
        });
        let again: Vec<Start> = (unsure.iter().zip(&met))
            .filter_map(|(&task, met)| match met {
                Met::Neighbour(at) => Some(self.here(spread.ahead(self.grid, task)?, at)),
                _ => None,
            })
            .collect();
        let again = self.settled(steps, &again);
        let mut again = again.iter().flat_map(Arrivals::iter);
        let found = met.iter().map(|met| match met {
            Met::Neighbour(_) => match again.next().flatten() {
                Some(arrival) => End::Arrived(arrival.arrival()),
                None => End::Stuck,
            },
            Met::Fold(..) => End::Fold,
            _ => End::Stuck,
        });
        let stuck = ends.iter_mut().filter(|end| matches!(end, End::Stuck));
        stuck.zip(found).for_each(|(end, found)| *end = found);
        ends
    }

    fn arrive(&self, spread: &mut Spread, (from, d): Task, arrival: Moving) {
        let Some(node) = spread.ahead(self.grid, (from, d)) else {
            return;
        };
        let known = spread.known(self, node, arrival);
        let to = known.unwrap_or_else(|| spread.add(self, node, arrival));
        spread.link(from, d, to);
    }
}
