//! Rows of held values followed, singly or side by side.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::algebra::BATCH;
use crate::analysis::solver::Follower;
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Newton, Progress, Stage, Watch};
use crate::system::{self, Coordinate, HeldPlatform, MotionTracker, System};

/// The longest step of the held coordinates, in rad or characteristic lengths.
const LONGEST: f64 = 0.2;

/// Number of steps for a distance; 0 if the values are too far away or not finite.
fn steps_of(distance: f64, finite: bool) -> usize {
    let steps = match distance <= LONGEST {
        // as most are
        true => 1.0,
        false => (distance / LONGEST).ceil(),
    };
    // a row that is farther away is not reached
    match finite && steps <= 10_000.0 {
        true => (steps as usize).max(1),
        false => 0,
    }
}

/// Rows to be followed, with the question and its equations.
pub(in crate::ask) struct RowSeries<'a> {
    pub question: &'a system::Question<'a>,
    pub coordinates: &'a [Coordinate],
    pub columns: Vec<Coordinate>,
    pub system: System<f64>,
    /// True if the system takes the values of all coordinates.
    pub by_value: bool,
    pub start: Configuration<f64>,
    pub values: &'a [f64],
    /// The rows in the order in which they are followed; empty for the order in which they are given.
    pub order: Vec<u32>,
    /// Unit of each coordinate: 1 rad, or the characteristic length in m.
    pub scales: Vec<f64>,
    pub watch: &'a Watch<'a>,
    /// The number of rows that are done.
    pub done: AtomicUsize,
}

/// A block of rows, followed from the start configuration.
pub(super) struct BlockOfRows<'a> {
    /// The place of the first.
    pub first: usize,
    pub columns: &'a [Coordinate],
    pub values: &'a mut [f64],
    pub reached: &'a mut [bool],
}

impl BlockOfRows<'_> {
    fn put(&mut self, row: usize, found: impl Iterator<Item = f64>) {
        let width = self.columns.len();
        let values = self.values[row * width..(row + 1) * width].iter_mut();
        values.zip(found).for_each(|(value, found)| *value = found);
        self.reached[row] = true;
    }

    /// The values of rows that are not reached are no numbers.
    pub fn rest(&mut self) {
        let values = self.values.chunks_mut(self.columns.len().max(1));
        let rest = values.zip(&*self.reached).filter(|(_, reached)| !**reached);
        rest.for_each(|(values, _)| values.fill(f64::NAN));
    }

    fn put_at(&mut self, mechanism: &Mechanism, row: usize, at: &Configuration<f64>) {
        let columns = self.columns;
        self.put(row, columns.iter().map(|column| column.of(mechanism, at)));
    }
}

impl<'a> RowSeries<'a> {
    /// Rows of values of coordinates that a question holds, in the order in which they are given.
    pub fn new(
        question: &'a system::Question<'a>,
        coordinates: &'a [Coordinate],
        values: &'a [f64],
        start: Configuration<f64>,
        watch: &'a Watch<'a>,
    ) -> Self {
        let (mechanism, held) = (question.mechanism(), question.held());
        let by_value = |of: &Coordinate| match of.platform() {
            Some(platform) => match &held.platforms[platform] {
                HeldPlatform::Partly(parts) => parts.orientation.is_none(),
                _ => false,
            },
            None => true,
        };
        RowSeries {
            question,
            coordinates,
            columns: Coordinate::all(mechanism).collect(),
            system: question.system(),
            by_value: coordinates.iter().all(by_value),
            start,
            values,
            order: Vec::new(),
            scales: coordinates.iter().map(|c| c.scale(mechanism)).collect(),
            watch,
            done: AtomicUsize::new(0),
        }
    }

    /// The values of the row that is followed at a place.
    fn row(&self, place: usize) -> &[f64] {
        let row = (self.order.get(place)).map_or(place, |row| *row as usize);
        let width = self.coordinates.len();
        &self.values[row * width..(row + 1) * width]
    }

    /// The order of the values of one coordinate, where most rows are far from the one before; else that of the rows. In
    /// several coordinates rows beside each other may lie on two sides of a fold, and no order is better than another.
    pub fn order(&self, rows: usize) -> Vec<u32> {
        /// Rows after which the watch is asked.
        const WATCHED: usize = 1 << 16;
        let (1, Ok(count)) = (self.coordinates.len(), u32::try_from(rows)) else {
            return Vec::new();
        };
        let mut far = 0;
        for row in 1..rows {
            if row % WATCHED == 0 && !self.goes_on(0) {
                return Vec::new();
            }
            far += usize::from(self.distance(self.row(row - 1), self.row(row)) > LONGEST);
        }
        if 2 * far <= rows {
            return Vec::new();
        }
        let mut order: Vec<u32> = (0..count).collect();
        let value = |row: u32| self.values[row as usize];
        order.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
        order
    }

    /// Distance of one row of values from another, in rad or characteristic lengths.
    fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        let ways = from.iter().zip(to).zip(&self.scales);
        ways.fold(0.0, |most, ((a, b), scale)| {
            f64::max(most, (b - a).abs() / scale)
        })
    }

    /// Number of steps from one row of values to another; 0 if they are too far away or not finite.
    fn steps(&self, from: &[f64], to: &[f64]) -> usize {
        let finite = to.iter().all(|x| x.is_finite());
        steps_of(self.distance(from, to), finite)
    }

    /// Steps for motions side by side, coordinate by coordinate.
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
        self.coordinates
            .iter()
            .map(|of| of.of(self.question.mechanism(), at))
            .collect()
    }

    /// True if the work continues after so many rows more. Asked at every step: a row may be ten thousand steps away.
    fn goes_on(&self, rows: usize) -> bool {
        let done = self.done.fetch_add(rows, Ordering::Relaxed) + rows;
        let now = Progress {
            stage: Stage::Motion,
            done,
            of: self.values.len().checked_div(self.coordinates.len()),
        };
        self.watch.at(now).is_continue()
    }

    /// The rows of a block in as many paths as there are motions side by side; true if all were followed.
    pub(super) fn side_by_side(&self, follower: &Follower, block: &mut BlockOfRows) -> bool {
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
                if !self.goes_on(0) {
                    return false;
                }
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
                let mut place = SolvedRow {
                    at: follower.configuration(&motions, motion, &values),
                    values,
                };
                if self.goes_or_begins(&mut single, &mut place, self.row(first + row)) {
                    block.put_at(self.question.mechanism(), row, &place.at);
                }
                follower.put(&mut motions, motion, &place.at);
                for (i, &value) in place.values.iter().enumerate() {
                    follower.values(&mut motions, i)[motion] = value;
                    here[i][motion] = value;
                }
            }
            if !self.goes_on((0..BATCH).filter(|i| row(*i).is_some()).count()) {
                return false;
            }
        }
        true
    }

    /// The rows of a block in one path; true if all were followed.
    pub(super) fn one_by_one(&self, block: &mut BlockOfRows) -> bool {
        let mut tracker = MotionTracker::new(self.system.clone(), self.start.clone());
        let mut place = self.begin();
        for row in 0..block.reached.len() {
            if self.goes_or_begins(&mut tracker, &mut place, self.row(block.first + row)) {
                block.put_at(self.question.mechanism(), row, &place.at);
            }
            if !self.goes_on(1) {
                return false;
            }
        }
        true
    }

    /// The configurations of the first rows, as far as they can be followed one after the other, closed to rounding.
    pub fn followed(&self, rows: usize) -> impl Iterator<Item = Configuration<f64>> {
        let mut tracker = MotionTracker::new(self.system.clone(), self.start.clone());
        let (mut place, mut work) = (self.begin(), self.system.work());
        (0..rows).map_while(move |row| {
            let goes = self.goes(&mut tracker, &mut place, self.row(row));
            let (mut at, mut trial) = (place.at.clone(), place.at.clone());
            Newton::default().solve(tracker.system(), &mut at, &mut trial, &mut work);
            goes.then_some(at)
        })
    }

    fn begin(&self) -> SolvedRow {
        SolvedRow {
            values: self.values(&self.start),
            at: self.start.clone(),
        }
    }

    /// Moves to held values from a place, or else from the beginning; stays there if neither leads to them.
    fn goes_or_begins(
        &self,
        tracker: &mut MotionTracker,
        place: &mut SolvedRow,
        to: &[f64],
    ) -> bool {
        let mut begin = self.begin();
        self.goes(tracker, place, to)
            || self.goes(tracker, &mut begin, to) && {
                *place = begin;
                true
            }
    }

    /// Follows the straight path from a place to held values; stays there if it cannot be followed.
    fn goes(&self, tracker: &mut MotionTracker, place: &mut SolvedRow, to: &[f64]) -> bool {
        let steps = self.steps(&place.values, to);
        if steps == 0 {
            return false;
        }
        if *tracker.configuration() != place.at {
            tracker.restart(&place.at);
        }
        let mut work = self.system.work();
        let begin = &place.values;
        let longest = 1.0 / steps as f64;
        let (mut gone, mut step) = (0.0, longest);
        while gone < 1.0 {
            if !self.goes_on(0) {
                return false;
            }
            let next = f64::min(gone + step, 1.0);
            let value = |i: usize| match next {
                1.0 => to[i],
                _ => begin[i] + next * (to[i] - begin[i]),
            };
            let before = tracker.configuration().clone();
            let solved = self.solve(tracker, value);
            let now = tracker.configuration();
            if solved && tracker.system().is_on_branch_of(&before, now, &mut work) {
                gone = next;
                step = (2.0 * step).min(longest);
                continue;
            }
            tracker.restart(&before);
            step *= 0.5;
            if step < 1.0 / 16384.0 * longest {
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
struct SolvedRow {
    at: Configuration<f64>,
    values: Vec<f64>,
}
