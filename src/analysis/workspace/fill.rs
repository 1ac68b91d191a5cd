//! Spreading over the grid from seeds: every node in every mode that regular steps lead to.

use super::asked::Asked;
use super::edge::{Edge, Met, reach};
use super::grid::{Grid, MOST_AXES, MOST_DIRECTIONS};
use super::measure::Measure;
use super::pace::Paced;
use super::step::{Arrival, SURE, Start, Steps};
use crate::linear::{Factorable, norm};
use crate::mechanism::Configuration;
use crate::number::Packed;
use crate::solve::{Pool, each};
use crate::system::Walk;

/// An assembled configuration at a node.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub node: usize,
    pub arrival: Arrival,
    /// Whether all joints are within their limits.
    pub within: bool,
    /// For each direction of the grid.
    pub links: [Link; MOST_DIRECTIONS],
}

/// How a node goes on in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Link {
    /// Not looked at, or out of the box.
    Open,
    /// To this sheet there, by regular motion.
    To(usize),
    /// The mode folds back before the neighbour.
    Fold,
    /// No sure step leads on.
    Stuck,
}

/// All that was reached, in the order in which it was.
pub(super) struct Filled {
    pub sheets: Vec<Sheet>,
    /// For each node its sheets.
    pub of_node: Vec<Vec<usize>>,
    /// For each sheet the first of those connected with it.
    pub roots: Vec<usize>,
    /// Whether there were more sheets than may be kept.
    pub overflow: bool,
}

#[derive(Clone, Copy)]
pub(super) struct Fill<'a> {
    pub asked: &'a Asked<'a>,
    pub grid: &'a Grid,
    pub measure: &'a Measure,
    /// Sheets kept at most.
    pub most: usize,
}

/// A step to be taken: from a sheet in a direction.
pub(super) type Task = (usize, usize);

/// Steps given to one thread at once.
const JOB: usize = 64;

impl Fill<'_> {
    /// Nothing reached yet.
    pub fn nothing(&self) -> Filled {
        Filled {
            sheets: Vec::new(),
            of_node: vec![Vec::new(); self.grid.len()],
            roots: Vec::new(),
            overflow: false,
        }
    }

    /// Spreads from assembled configurations at nodes. The order of work does not depend on the
    /// number of threads: fronts are merged in the order of their steps.
    pub fn spread<T: Factorable + Packed + Send + Sync>(
        &self,
        filled: &mut Filled,
        steps: &Pool<Steps<T>>,
        seeds: &[(usize, Configuration<f64>)],
        told: &mut dyn FnMut(usize),
    ) {
        let starts: Vec<Start> = (seeds.iter())
            .map(|(node, at)| self.here(*node, at))
            .collect();
        let settled = self.settled(steps, &starts);
        let mut front = Vec::new();
        for ((node, _), arrival) in seeds.iter().zip(settled) {
            if let Some(arrival) = arrival
                && self.known(filled, *node, &arrival.at).is_none()
            {
                front.push(self.add(filled, *node, arrival));
            }
        }
        while !front.is_empty() {
            let directions = 0..2 * self.grid.dimensions();
            let tasks = front
                .iter()
                .flat_map(|&s| directions.clone().map(move |d| (s, d)));
            let mut waiting: Vec<Task> = tasks
                .filter(|&(s, d)| self.grid.neighbour(filled.sheets[s].node, d).is_some())
                .collect();
            front = Vec::new();
            while !waiting.is_empty() {
                waiting = self.linked(filled, &waiting);
                let (now, later) = self.chosen(filled, waiting);
                let ends = self.ends(steps, filled, &now);
                for ((s, d), end) in now.into_iter().zip(ends) {
                    self.merge(filled, (s, d), end, &mut front);
                }
                waiting = later;
                told(filled.sheets.len());
                if filled.sheets.len() > self.most {
                    filled.overflow = true;
                    return;
                }
            }
        }
        for s in 0..filled.roots.len() {
            filled.roots[s] = root(&mut filled.roots, s);
        }
    }

    /// A start beside an assembled configuration at a node.
    fn here<'s>(&self, node: usize, at: &'s Configuration<f64>) -> Start<'s> {
        Start {
            from: at,
            along: None,
            reach: 1e-3,
            values: self.grid.point(node),
        }
    }

    pub(super) fn settled<T: Factorable + Packed + Send + Sync>(
        &self,
        steps: &Pool<Steps<T>>,
        starts: &[Start],
    ) -> Vec<Option<Arrival>> {
        let jobs: Vec<&[Start]> = starts.chunks(JOB).collect();
        let ends = steps.each(jobs.len(), |steps, i| {
            let packs = jobs[i].chunks(T::WIDTH);
            packs
                .flat_map(|pack| steps.settle(pack))
                .collect::<Vec<_>>()
        });
        ends.into_iter().flatten().collect()
    }

    fn add(&self, filled: &mut Filled, node: usize, arrival: Arrival) -> usize {
        let mut brought = arrival.at.clone();
        Walk::within_limits(self.asked.mechanism, &mut brought);
        let joints = self.asked.mechanism.joints().iter().zip(&brought.joints);
        let new = filled.sheets.len();
        filled.sheets.push(Sheet {
            node,
            arrival,
            within: joints
                .into_iter()
                .all(|(joint, value)| joint.allows(*value)),
            links: [Link::Open; MOST_DIRECTIONS],
        });
        filled.of_node[node].push(new);
        filled.roots.push(new);
        new
    }

    /// The sheet of a node with this configuration.
    pub fn known(&self, filled: &Filled, node: usize, at: &Configuration<f64>) -> Option<usize> {
        let mut sheets = filled.of_node[node].iter().copied();
        sheets.find(|s| self.measure.same(&filled.sheets[*s].arrival.at, at))
    }

    pub(super) fn change(&self, node: usize, direction: usize) -> (usize, f64) {
        let axis = direction / 2;
        let place = self.grid.place(node, axis);
        let next = if direction.is_multiple_of(2) {
            place - 1
        } else {
            place + 1
        };
        let coordinate = |place| self.grid.coordinate(axis, place);
        (axis, coordinate(next) - coordinate(place))
    }

    /// Links sheets to known ones that lie where both their motions say; what is left.
    fn linked(&self, filled: &mut Filled, tasks: &[Task]) -> Vec<Task> {
        let jobs: Vec<&[Task]> = tasks.chunks(8 * JOB).collect();
        let found = each(jobs.len(), &Vec::new(), |storage, i| {
            let near = jobs[i].iter().map(|&task| self.near(filled, task, storage));
            near.collect::<Vec<Option<usize>>>()
        });
        let mut left = Vec::new();
        for (&(s, d), found) in tasks.iter().zip(found.into_iter().flatten()) {
            match found {
                _ if filled.sheets[s].links[d] != Link::Open => {}
                Some(t) => link(filled, s, d, t),
                None => left.push((s, d)),
            }
        }
        left
    }

    fn near(&self, filled: &Filled, (s, d): Task, storage: &mut Vec<f64>) -> Option<usize> {
        let sheet = &filled.sheets[s];
        let node = self.grid.neighbour(sheet.node, d)?;
        let known = &filled.of_node[node];
        if known.is_empty() || sheet.links[d] != Link::Open {
            return None;
        }
        let (axis, change) = self.change(sheet.node, d);
        let mut near = known.iter().copied().filter(|&t| {
            let both = [&sheet.arrival, &filled.sheets[t].arrival];
            self.measure.linked(both, axis, change, storage)
        });
        let first = near.next()?;
        // two as near are for surer steps to tell apart
        near.next().is_none().then_some(first)
    }

    /// One step to each node from each mode known so far; the others wait for what it finds.
    fn chosen(&self, filled: &mut Filled, waiting: Vec<Task>) -> (Vec<Task>, Vec<Task>) {
        let mut taken = std::collections::HashSet::new();
        waiting.into_iter().partition(|&(s, d)| {
            let node = self.grid.neighbour(filled.sheets[s].node, d);
            taken.insert((node, root(&mut filled.roots, s)))
        })
    }

    fn ends<T: Factorable + Packed + Send + Sync>(
        &self,
        steps: &Pool<Steps<T>>,
        filled: &Filled,
        tasks: &[Task],
    ) -> Vec<End> {
        let jobs: Vec<&[Task]> = tasks.chunks(JOB).collect();
        let arrivals = steps.each(jobs.len(), |steps, i| {
            let starts: Vec<Start> = jobs[i]
                .iter()
                .map(|task| self.start(filled, *task))
                .collect();
            let packs = starts.chunks(T::WIDTH);
            let arrivals = packs.flat_map(|pack| steps.settle(pack));
            let sure = arrivals.zip(jobs[i]).map(|(arrival, &(s, d))| {
                let from = &filled.sheets[s];
                let (axis, change) = self.change(from.node, d);
                let (_, length) = self.measure.motion(&from.arrival, axis, change);
                arrival.filter(|to| self.measure.alike(&from.arrival, to, length))
            });
            sure.collect::<Vec<Option<Arrival>>>()
        });
        let arrivals: Vec<Option<Arrival>> = arrivals.into_iter().flatten().collect();
        let tasks_of = |ends: &[End]| -> Vec<Task> {
            let open = tasks.iter().zip(ends);
            let open = open.filter(|(_, end)| matches!(end, End::Stuck));
            open.map(|(task, _)| *task).collect()
        };
        let mut ends: Vec<End> = (arrivals.into_iter())
            .map(|arrival| arrival.map_or(End::Stuck, End::Arrived))
            .collect();
        // the others by shorter steps
        let unsure = tasks_of(&ends);
        let paced = self.paced(steps, filled, &unsure).into_iter();
        fill_in(
            &mut ends,
            paced.map(|paced| match paced {
                Paced::Arrived(arrival) => End::Arrived(arrival),
                Paced::Fold => End::Fold,
                Paced::Open => End::Stuck,
            }),
        );
        // and what is left by steps along the curve, each of which takes as long as hundreds of these
        let unsure = tasks_of(&ends);
        let met = each(unsure.len(), &(), |(), i| {
            let (s, d) = unsure[i];
            let edge = Edge {
                axis: d / 2,
                values: self.grid.values(filled.sheets[s].node),
                to: self.start_values(filled, (s, d))[d / 2],
            };
            let from = &filled.sheets[s].arrival.at;
            reach(self.asked, self.measure, &edge, from)
        });
        let again: Vec<Start> = (unsure.iter().zip(&met))
            .filter_map(|(task, met)| match met {
                Met::Neighbour(at) => {
                    let node = filled.sheets[task.0].node;
                    let to = self.grid.neighbour(node, task.1).unwrap_or(node);
                    Some(self.here(to, at))
                }
                _ => None,
            })
            .collect();
        let mut again = self.settled(steps, &again).into_iter();
        fill_in(
            &mut ends,
            met.iter().map(|met| match met {
                Met::Neighbour(_) => again.next().flatten().map_or(End::Stuck, End::Arrived),
                Met::Fold(..) => End::Fold,
                _ => End::Stuck,
            }),
        );
        ends
    }

    pub(super) fn start_values(&self, filled: &Filled, (s, d): Task) -> [f64; MOST_AXES] {
        let node = filled.sheets[s].node;
        self.grid
            .point(self.grid.neighbour(node, d).unwrap_or(node))
    }

    fn start<'f>(&self, filled: &'f Filled, (s, d): Task) -> Start<'f> {
        let sheet = &filled.sheets[s];
        let (axis, change) = self.change(sheet.node, d);
        let values = self.start_values(filled, (s, d));
        self.towards(&sheet.arrival, axis, change, values)
    }

    /// A start for a change of one mapped coordinate, which leads to these values.
    pub(super) fn towards<'f>(
        &self,
        from: &'f Arrival,
        axis: usize,
        change: f64,
        values: [f64; MOST_AXES],
    ) -> Start<'f> {
        let (motion, factor) = self.measure.motion(from, axis, change);
        Start {
            from: &from.at,
            along: Some((motion, factor)),
            reach: SURE * factor.abs() * norm(motion),
            values,
        }
    }

    fn merge(&self, filled: &mut Filled, (s, d): Task, end: End, front: &mut Vec<usize>) {
        match end {
            End::Arrived(arrival) => {
                let Some(node) = self.grid.neighbour(filled.sheets[s].node, d) else {
                    return;
                };
                let t = match self.known(filled, node, &arrival.at) {
                    Some(known) => known,
                    None => {
                        let new = self.add(filled, node, arrival);
                        front.push(new);
                        new
                    }
                };
                link(filled, s, d, t);
            }
            End::Fold => filled.sheets[s].links[d] = Link::Fold,
            End::Stuck => filled.sheets[s].links[d] = Link::Stuck,
        }
    }
}

enum End {
    Arrived(Arrival),
    Fold,
    Stuck,
}

/// Puts what was found into the places that are stuck, in order.
fn fill_in(ends: &mut [End], found: impl Iterator<Item = End>) {
    let stuck = ends.iter_mut().filter(|end| matches!(end, End::Stuck));
    stuck.zip(found).for_each(|(end, found)| *end = found);
}

fn link(filled: &mut Filled, s: usize, d: usize, t: usize) {
    filled.sheets[s].links[d] = Link::To(t);
    if filled.sheets[t].links[d ^ 1] == Link::Open {
        filled.sheets[t].links[d ^ 1] = Link::To(s);
    }
    let (a, b) = (root(&mut filled.roots, s), root(&mut filled.roots, t));
    filled.roots[a.max(b)] = a.min(b);
}

/// The first of all that are connected with one.
pub(super) fn root(roots: &mut [usize], mut of: usize) -> usize {
    while roots[of] != of {
        roots[of] = roots[roots[of]];
        of = roots[of];
    }
    of
}
