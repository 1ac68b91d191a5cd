//! One configuration after another for rows of held values.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::{AskError, Question, Role};
use crate::algebra::BATCH;
use crate::analysis::solver::{Follower, Following};
use crate::mechanism::Configuration;
use crate::solve::{Progress, Stage, Watch, each};
use crate::system::{self, Coordinate, HeldPlatform, MotionTracker, System, check_count};

/// The most rows that are followed from the start; they decide where following begins again, and so belong to the answer.
const ROWS: usize = 256;

/// As many rows repay writing down the program that follows them side by side.
const FEW: usize = 1000;

/// The longest step of what is held, in rad or characteristic lengths.
const LONGEST: f64 = 0.2;

/// The shortest step that is tried, over the longest.
const SHORTEST: f64 = 1.0 / 1024.0;

/// Steps beyond which a row is too far away.
const FARTHEST: f64 = 10_000.0;

/// Configurations for rows of held values.
#[derive(Clone, Debug, PartialEq)]
pub struct Many {
    /// The columns: the joints, then x, y, z (m) and roll, pitch, yaw (rad) of each platform.
    pub names: Vec<String>,
    /// Row by row; not a number in rows that were not reached.
    pub values: Vec<f64>,
    /// Whether each row was reached.
    pub reached: Vec<bool>,
    /// Whether the work was stopped before it was done.
    pub interrupted: bool,
}

/// In how many steps a distance is gone to values; none if they are too far away or no numbers.
fn steps_of(distance: f64, finite: bool) -> usize {
    let steps = match distance <= LONGEST {
        // as most are
        true => 1.0,
        false => (distance / LONGEST).ceil(),
    };
    match finite && steps <= FARTHEST {
        true => (steps as usize).max(1),
        false => 0,
    }
}

/// What follows rows.
struct Rows<'a> {
    question: &'a system::Question<'a>,
    coordinates: &'a [Coordinate],
    columns: Vec<Coordinate>,
    system: System<f64>,
    /// Whether the system takes the values of all coordinates.
    by_value: bool,
    start: Configuration<f64>,
    values: &'a [f64],
    /// The rows in the order in which they are followed; empty for the order in which they are given.
    order: Vec<u32>,
    /// What makes each coordinate dimensionless.
    scales: Vec<f64>,
}

impl Question {
    /// The configuration for each row of values of the named coordinates, which are held: `values` are row by row, in m
    /// and rad.
    ///
    /// The path begins at the configuration of the question, in its mode, and goes straight from row to row, so each row is
    /// on the branch of the row before it unless the path between them is lost; after at most 256 rows it begins again.
    /// Unsorted values of one coordinate, most of them far from the one before, are followed from the least to the greatest.
    /// Where there are 1,000 rows and more, 32 paths are followed at a time in the widest vector registers of the processor,
    /// on all cores, with the same results on any number of cores and in registers of any width. A row to which no path
    /// leads, as beyond a dead point, is not reached.
    ///
    /// # Errors
    /// If the question or a name is wrong, or the mechanism does not assemble where the path begins.
    ///
    /// # Panics
    /// If `values` are not whole rows.
    pub fn solve_many(
        &self,
        names: &[String],
        values: &[f64],
        watch: &Watch,
    ) -> Result<Many, AskError> {
        let mechanism = &*self.mechanism;
        let plain = system::Question::new(mechanism);
        let mut coordinates = Vec::new();
        let mut begins = self.clone();
        for (index, name) in names.iter().enumerate() {
            let (coordinate, _) = (plain.value(name, "home")).map_err(Role::Input.named(index))?;
            if let Some(first) = coordinates.iter().position(|known| *known == coordinate) {
                return Err(AskError::Twice {
                    item: Role::Input.item(index),
                    first: Role::Input.item(first),
                    name: name.clone(),
                });
            }
            coordinates.push(coordinate);
            if !self.hold.iter().any(|(held, _)| held == name) {
                begins = begins.hold(name, "home");
            }
        }
        let question = begins.resolved()?;
        check_count(&question).map_err(AskError::Question)?;
        let question = question.with_spins_still();
        let held = question.held();
        let by_value = |of: &Coordinate| match of.platform() {
            Some(platform) => match &held.platforms[platform] {
                HeldPlatform::Partly(parts) => parts.orientation.is_none(),
                _ => false,
            },
            None => true,
        };
        let mut all = Rows {
            question: &question,
            coordinates: &coordinates,
            columns: Coordinate::all(mechanism).collect(),
            system: question.system(),
            by_value: coordinates.iter().all(by_value),
            start: begins.start(&question, watch)?,
            values,
            order: Vec::new(),
            scales: coordinates.iter().map(|c| c.scale(mechanism)).collect(),
        };
        let rows = match names.len() {
            0 => 0,
            width => {
                assert!(values.len().is_multiple_of(width), "values are whole rows");
                values.len() / width
            }
        };
        all.order = all.order(rows);
        let settings = Following::default();
        let follower = (rows >= FEW)
            .then(|| Follower::new(&question, &all.start, &coordinates, settings).ok())
            .flatten();
        let most = ROWS * follower.as_ref().map_or(1, |_| BATCH);
        // blocks of the same size, for cores to share
        let block = rows.div_ceil(rows.div_ceil(most).max(1)).max(1);
        let width = all.columns.len();
        // not filled with what is hardly ever left: pages of so many are had where rows are written
        let (mut found, mut reached) = (vec![0.0; rows * width], vec![false; rows]);
        let blocks = (found.chunks_mut(block * width)).zip(reached.chunks_mut(block));
        let blocks = blocks.enumerate().map(|(number, (values, reached))| {
            Mutex::new(Block {
                first: number * block,
                columns: &all.columns,
                values,
                reached,
            })
        });
        let blocks: Vec<Mutex<Block>> = blocks.collect();
        let done = AtomicUsize::new(0);
        each(blocks.len(), &(), |(), number| {
            let block = &mut *blocks[number]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            let done = done.fetch_add(block.reached.len(), Ordering::Relaxed);
            let of = Some(rows);
            let stage = Stage::Motion;
            if watch.at(Progress { stage, done, of }).is_continue() {
                match &follower {
                    Some(follower) => all.side_by_side(follower, block),
                    None => all.one_by_one(block),
                }
            }
            block.rest();
        });
        drop(blocks);
        let mut many = Many {
            names: all.columns.iter().map(|of| of.name(mechanism)).collect(),
            values: found,
            reached,
            interrupted: watch.is_stopped(),
        };
        if !all.order.is_empty() {
            let (values, reached) = (many.values.clone(), many.reached.clone());
            let found = values.chunks(width).zip(reached);
            for (&row, (values, reached)) in all.order.iter().zip(found) {
                let row = row as usize;
                many.values[row * width..(row + 1) * width].copy_from_slice(values);
                many.reached[row] = reached;
            }
        }
        Ok(many)
    }
}

/// Rows that are followed from the start.
struct Block<'a> {
    /// The place of the first.
    first: usize,
    columns: &'a [Coordinate],
    values: &'a mut [f64],
    reached: &'a mut [bool],
}

impl Block<'_> {
    fn put(&mut self, row: usize, found: impl Iterator<Item = f64>) {
        let width = self.columns.len();
        let values = self.values[row * width..(row + 1) * width].iter_mut();
        values.zip(found).for_each(|(value, found)| *value = found);
        self.reached[row] = true;
    }

    /// The values of rows that are not reached are no numbers.
    fn rest(&mut self) {
        let values = self.values.chunks_mut(self.columns.len().max(1));
        let rest = values.zip(&*self.reached).filter(|(_, reached)| !**reached);
        rest.for_each(|(values, _)| values.fill(f64::NAN));
    }

    fn put_at(&mut self, row: usize, at: &Configuration<f64>) {
        let columns = self.columns;
        self.put(row, columns.iter().map(|column| column.of(at)));
    }
}

impl Rows<'_> {
    /// The values of the row that is followed at a place.
    fn row(&self, place: usize) -> &[f64] {
        let row = (self.order.get(place)).map_or(place, |row| *row as usize);
        let width = self.coordinates.len();
        &self.values[row * width..(row + 1) * width]
    }

    /// The order of the values of one coordinate, where most rows are far from the one before; else that of the rows. In
    /// several coordinates rows beside each other may lie on two sides of a fold, and no order is better than another.
    fn order(&self, rows: usize) -> Vec<u32> {
        let far = |row: &usize| self.distance(self.row(row - 1), self.row(*row)) > LONGEST;
        let (1, Ok(count)) = (self.coordinates.len(), u32::try_from(rows)) else {
            return Vec::new();
        };
        if 2 * (1..rows).filter(far).count() <= rows {
            return Vec::new();
        }
        let mut order: Vec<u32> = (0..count).collect();
        let value = |row: u32| self.values[row as usize];
        order.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
        order
    }

    /// How far it is from one row of values to another, in rad or characteristic lengths.
    fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        let ways = from.iter().zip(to).zip(&self.scales);
        ways.fold(0.0, |most, ((a, b), scale)| {
            f64::max(most, (b - a).abs() / scale)
        })
    }

    /// In how many steps values are reached from others.
    fn steps(&self, from: &[f64], to: &[f64]) -> usize {
        let finite = to.iter().all(|x| x.is_finite());
        steps_of(self.distance(from, to), finite)
    }

    /// The same for motions side by side, coordinate by coordinate.
    fn steps_of_each(&self, from: &[[f64; BATCH]], to: &[[f64; BATCH]]) -> [usize; BATCH] {
        let (mut farthest, mut finite) = ([0.0; BATCH], [true; BATCH]);
        for ((from, to), scale) in from.iter().zip(to).zip(&self.scales) {
            for i in 0..BATCH {
                farthest[i] = f64::max(farthest[i], (to[i] - from[i]).abs() / scale);
                finite[i] &= to[i].is_finite();
            }
        }
        let mut steps = [0; BATCH];
        (0..BATCH).for_each(|i| steps[i] = steps_of(farthest[i], finite[i]));
        steps
    }

    fn values(&self, at: &Configuration<f64>) -> Vec<f64> {
        self.coordinates.iter().map(|of| of.of(at)).collect()
    }

    /// The rows of a block in as many paths as there are motions side by side.
    fn side_by_side(&self, follower: &Follower, block: &mut Block) {
        let (first, rows) = (block.first, block.reached.len());
        let length = rows.div_ceil(BATCH);
        let mut single = MotionTracker::new(self.system.clone(), self.start.clone());
        let mut motions = follower.motions(&self.start);
        // what is held of each motion, coordinate by coordinate
        let begin = self.values(&self.start);
        let mut here: Vec<[f64; BATCH]> = begin.iter().map(|value| [*value; BATCH]).collect();
        let mut wanted = here.clone();
        for k in 0..length {
            let row = |motion: usize| Some(motion * length + k).filter(|row| *row < rows);
            for motion in 0..BATCH {
                match row(motion).map(|row| self.row(first + row)) {
                    Some(to) => (wanted.iter_mut().zip(to)).for_each(|(of, to)| of[motion] = *to),
                    None => wanted.iter_mut().for_each(|of| of[motion] = f64::NAN),
                }
            }
            let steps = self.steps_of_each(&here, &wanted);
            let mut arrived = [false; BATCH];
            let mut standing = [true; BATCH];
            for step in 1..=steps.into_iter().max().unwrap_or(0) {
                let mut going = [false; BATCH];
                (0..BATCH).for_each(|i| going[i] = standing[i] && step <= steps[i]);
                for (i, (here, wanted)) in here.iter().zip(&wanted).enumerate() {
                    let values = follower.values(&mut motions, i);
                    for motion in (0..BATCH).filter(|motion| going[*motion]) {
                        let (from, to) = (here[motion], wanted[motion]);
                        values[motion] = match steps[motion] - step {
                            0 => to,
                            left => from + 1.0 / (left + 1) as f64 * (to - from),
                        };
                    }
                }
                let solved = follower.solve(&mut motions, &going);
                for (i, here) in here.iter_mut().enumerate() {
                    let values = follower.values(&mut motions, i);
                    for motion in (0..BATCH).filter(|motion| going[*motion] && solved[*motion]) {
                        here[motion] = values[motion];
                    }
                }
                for motion in (0..BATCH).filter(|motion| going[*motion]) {
                    standing[motion] = solved[motion];
                    arrived[motion] = solved[motion] && step == steps[motion];
                    if let (true, Some(row)) = (arrived[motion], row(motion)) {
                        let columns = follower.columns(&motions);
                        block.put(row, columns.map(|column| column[motion]));
                    }
                }
            }
            for motion in (0..BATCH).filter(|motion| steps[*motion] > 0 && !arrived[*motion]) {
                let Some(row) = row(motion) else { continue };
                let values: Vec<f64> = here.iter().map(|of| of[motion]).collect();
                let mut place = Place {
                    at: follower.configuration(&motions, motion, &values),
                    values,
                };
                if self.goes_or_begins(&mut single, &mut place, self.row(first + row)) {
                    block.put_at(row, &place.at);
                }
                follower.put(&mut motions, motion, &place.at);
                for (i, &value) in place.values.iter().enumerate() {
                    follower.values(&mut motions, i)[motion] = value;
                    here[i][motion] = value;
                }
            }
        }
    }

    /// The rows of a block in one path.
    fn one_by_one(&self, block: &mut Block) {
        let mut tracker = MotionTracker::new(self.system.clone(), self.start.clone());
        let mut place = self.begin();
        for row in 0..block.reached.len() {
            if self.goes_or_begins(&mut tracker, &mut place, self.row(block.first + row)) {
                block.put_at(row, &place.at);
            }
        }
    }

    fn begin(&self) -> Place {
        Place {
            values: self.values(&self.start),
            at: self.start.clone(),
        }
    }

    /// Goes to held values from a place, or else from the beginning; stays there if neither leads to them.
    fn goes_or_begins(&self, tracker: &mut MotionTracker, place: &mut Place, to: &[f64]) -> bool {
        let mut begin = self.begin();
        self.goes(tracker, place, to)
            || self.goes(tracker, &mut begin, to) && {
                *place = begin;
                true
            }
    }

    /// Follows the straight path from a place to held values; stays there if it cannot be followed.
    fn goes(&self, tracker: &mut MotionTracker, place: &mut Place, to: &[f64]) -> bool {
        let steps = self.steps(&place.values, to);
        if steps == 0 {
            return false;
        }
        if *tracker.configuration() != place.at {
            tracker.restart(&place.at);
        }
        let begin = &place.values;
        let longest = 1.0 / steps as f64;
        let (mut gone, mut step) = (0.0, longest);
        while gone < 1.0 {
            let next = f64::min(gone + step, 1.0);
            let value = |i: usize| match next {
                1.0 => to[i],
                _ => begin[i] + next * (to[i] - begin[i]),
            };
            let before = tracker.configuration().clone();
            if self.solve(tracker, value) {
                gone = next;
                step = (2.0 * step).min(longest);
                continue;
            }
            tracker.restart(&before);
            step *= 0.5;
            if step < SHORTEST * longest {
                return false;
            }
        }
        place.at.clone_from(tracker.configuration());
        place.values.copy_from_slice(to);
        true
    }

    /// Solves for other held values near by.
    fn solve(&self, tracker: &mut MotionTracker, value: impl Fn(usize) -> f64) -> bool {
        let held = self.coordinates.iter().copied();
        if self.by_value {
            return tracker.solve_at(held, value).solved;
        }
        let values = held
            .enumerate()
            .map(|(i, coordinate)| (coordinate, value(i)));
        let near = self.question.clone().near(tracker.configuration());
        let question = near.at_values(values);
        *tracker = MotionTracker::new(question.system(), question.start());
        tracker.solve(|_| ()).solved
    }
}

/// A configuration, and the held values it was found for.
struct Place {
    at: Configuration<f64>,
    values: Vec<f64>,
}
