//! One configuration after another for rows of held values.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::{AskError, Question, Role};
use crate::linear::Factorable;
use crate::mechanism::Configuration;
use crate::number::{LANES, Lanes, Packed};
use crate::solve::{Progress, Stage, Watch, each};
use crate::system::{self, Coordinate, MotionTracker, System, check_count};

/// Rows that one lane follows from the start; they decide where following begins again, and so belong to the answer.
const ROWS: usize = 256;

/// The longest step of what is held, in rad or characteristic lengths.
const LONGEST: f64 = 0.2;

/// The shortest step that is tried, over the longest.
const SHORTEST: f64 = 1.0 / 1024.0;

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

/// What follows rows.
struct Follower<'a> {
    coordinates: &'a [Coordinate],
    system: System<f64>,
    wide: System<Lanes>,
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
    /// on the branch of the row before it unless the path between them is lost; every 256th row is reached from the
    /// beginning. Unsorted values of one coordinate, most of them far from the one before, are followed from the least to
    /// the greatest. Eight paths are followed at a time in the lanes of a vector register, on all cores, with the same
    /// results on any number of cores. A row to which no path leads, as beyond a dead point, is not reached.
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
            coordinates.push(coordinate);
            if !self.hold.iter().any(|(held, _)| held == name) {
                begins = begins.hold(name, "home");
            }
        }
        let question = begins.resolved()?;
        check_count(&question).map_err(AskError::Question)?;
        let question = question.with_spins_still();
        let mut follower = Follower {
            coordinates: &coordinates,
            system: question.system(),
            wide: question.system_over(),
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
        follower.order = follower.order(rows);
        let block = LANES * ROWS;
        let blocks = rows.div_ceil(block);
        let done = AtomicUsize::new(0);
        let columns: Vec<Coordinate> = Coordinate::all(mechanism).collect();
        let found = each(blocks, &(), |(), number| {
            let first = number * block;
            let last = rows.min(first + block);
            let done = done.fetch_add(last - first, Ordering::Relaxed);
            let of = Some(rows);
            let stage = Stage::Motion;
            let mut found = Found::none(&columns, last - first);
            if watch.at(Progress { stage, done, of }).is_continue() {
                follower.block(first, last, &mut found);
            }
            found
        });
        let width = columns.len();
        let mut many = Many {
            names: columns.iter().map(|of| of.name(mechanism)).collect(),
            values: vec![f64::NAN; rows * width],
            reached: vec![false; rows],
            interrupted: watch.is_stopped(),
        };
        let found = found.iter();
        let found = found.flat_map(|block| block.values.chunks(width).zip(&block.reached));
        for (place, (values, reached)) in found.enumerate() {
            let row = follower.number(place);
            many.values[row * width..(row + 1) * width].copy_from_slice(values);
            many.reached[row] = *reached;
        }
        Ok(many)
    }
}

/// What was found for some rows.
struct Found<'a> {
    columns: &'a [Coordinate],
    values: Vec<f64>,
    reached: Vec<bool>,
}

impl<'a> Found<'a> {
    fn none(columns: &'a [Coordinate], rows: usize) -> Self {
        Found {
            columns,
            values: vec![f64::NAN; rows * columns.len()],
            reached: vec![false; rows],
        }
    }

    fn put(&mut self, row: usize, at: &Configuration<f64>) {
        let width = self.columns.len();
        let values = &mut self.values[row * width..(row + 1) * width];
        for (value, column) in values.iter_mut().zip(self.columns) {
            *value = column.of(at);
        }
        self.reached[row] = true;
    }
}

impl Follower<'_> {
    /// The number of the row that is followed at a place.
    fn number(&self, place: usize) -> usize {
        (self.order.get(place)).map_or(place, |row| *row as usize)
    }

    fn row(&self, place: usize) -> &[f64] {
        let row = self.number(place);
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

    /// Solves for other held values.
    fn solve<T: Factorable>(
        &self,
        tracker: &mut MotionTracker<T>,
        value: impl Fn(usize) -> T,
    ) -> bool {
        let held = self.coordinates.iter().copied();
        tracker.solve_at(held, value).solved
    }

    /// How far it is from one row of values to another, in rad or characteristic lengths.
    fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        let ways = from.iter().zip(to).zip(&self.scales);
        ways.fold(0.0, |most, ((a, b), scale)| {
            f64::max(most, (b - a).abs() / scale)
        })
    }

    /// The rows from `first` to before `last`, side by side where all lanes can be followed.
    fn block(&self, first: usize, last: usize, found: &mut Found) {
        let length = (last - first).div_ceil(LANES);
        // lanes past the end follow its last row, which is not theirs
        let own = |lane: usize, k: usize| Some(lane * length + k).filter(|row| first + row < last);
        let row = |lane: usize, k: usize| own(lane, k).map_or(last - 1, |row| first + row);
        let mut single = MotionTracker::new(self.system.clone(), self.start.clone());
        let mut at: Vec<Configuration<f64>> = vec![self.start.clone(); LANES];
        let mut wide =
            MotionTracker::new(self.wide.clone(), Configuration::beside(|_| &self.start));
        let mut standing = [true; LANES];
        for k in 0..length {
            let near = |lane: usize| {
                let [before, now] = [k - 1, k].map(|k| self.row(row(lane, k)));
                standing[lane] && self.distance(before, now) <= LONGEST
            };
            // a lane that is lost or goes far stands still meanwhile
            let goes: [bool; LANES] = std::array::from_fn(|lane| k > 0 && near(lane));
            let side_by_side = goes.contains(&true)
                && self.solve(&mut wide, |i| {
                    Lanes::of_parts(|lane| match goes[lane] {
                        true => self.row(row(lane, k))[i],
                        false => self.coordinates[i].of(&at[lane]),
                    })
                });
            let mut moved = !side_by_side;
            for (lane, at) in at.iter_mut().enumerate() {
                let reached = match side_by_side && goes[lane] {
                    true => {
                        wide.configuration().copy_lane(lane, at);
                        true
                    }
                    // one by one, each from where its lane was last, or else from the beginning
                    false => {
                        let to = self.row(row(lane, k));
                        let mut start = self.start.clone();
                        let reached = self.goes(&mut single, at, to)
                            || self.goes(&mut single, &mut start, to) && {
                                *at = start;
                                true
                            };
                        moved |= reached;
                        reached
                    }
                };
                standing[lane] = reached;
                if let (true, Some(row)) = (reached, own(lane, k)) {
                    found.put(row, at);
                }
            }
            if moved {
                wide.restart(&Configuration::beside(|lane| &at[lane]));
            }
        }
    }

    /// Follows the straight path from a configuration to held values; stays there if it cannot be followed.
    fn goes(&self, tracker: &mut MotionTracker, at: &mut Configuration<f64>, to: &[f64]) -> bool {
        let begin: Vec<f64> = self.coordinates.iter().map(|c| c.of(at)).collect();
        let longest = (LONGEST / self.distance(&begin, to)).min(1.0);
        tracker.restart(at);
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
        at.clone_from(tracker.configuration());
        true
    }
}
