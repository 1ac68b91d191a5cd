//! One configuration after another for rows of held values.

mod measured;
mod rows;

use std::sync::{Mutex, PoisonError};

use super::preparation::with_joint;
use super::{AskError, Question, Role};
use crate::algebra::BATCH;
use crate::analysis::solver::Follower;
use crate::linear::DENSE_LIMIT;
use crate::solve::{Watch, each};
use crate::system::{self, check_count};
pub use measured::{Jacobians, ManyMeasured};
use rows::BlockOfRows;
pub(super) use rows::RowSeries;

/// The most rows that are followed from the start; they decide where following begins again, and so belong to the answer.
const ROWS: usize = 256;

/// As many rows repay writing down the program that follows them side by side.
const FEW: usize = 1000;

/// Configurations for rows of held values.
#[derive(Clone, Debug, PartialEq)]
pub struct Many {
    /// The columns: the joints, then x, y, z (m) and roll, pitch, yaw (rad) of each platform.
    pub names: Vec<String>,
    /// Row by row; not a number in rows that were not reached.
    pub values: Vec<f64>,
    /// For each row, true if it was reached.
    pub reached: Vec<bool>,
    /// The rows that were not reached, and why.
    pub lost: Vec<(usize, Unreached)>,
    /// True if the work was stopped before it was done; then rows are missing at the end, of unsorted values all.
    pub interrupted: bool,
}

/// Reason for which a row was not reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreached {
    /// A value is infinite or not a number.
    NotFinite,
    /// No path along which the mechanism keeps to its branch leads there from the row before or from the beginning.
    NoPath,
    /// A search found no assembly there.
    NotFound,
}

impl Question {
    /// The configuration for each row of values of the named coordinates, which are held: `values` are row by row, in m
    /// and rad.
    ///
    /// The path begins at the configuration of the question, in its mode, and goes straight from row to row, in steps that
    /// are certain to keep to the branch, so each row is on the branch of the row before it unless the path between them
    /// is lost; after at most 256 rows it begins again.
    /// Unsorted values of one coordinate, most of them far from the one before, are followed from the least to the greatest.
    /// For 1,000 rows and more, 32 paths are followed at a time in the widest vector registers of the processor,
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
        let mechanism = &**self.mechanism();
        let known = self.mechanism().clone();
        let more = (names.iter()).fold(known, |mechanism, name| with_joint(mechanism, name));
        if mechanism.joints().len() < more.joints().len() {
            return self.about(more).solve_many(names, values, watch);
        }
        let followers = names.iter().map(|name| mechanism.follower(name));
        let followers: Vec<_> = followers.collect();
        if followers.iter().any(Option::is_some) {
            let (mut names, mut values) = (names.to_vec(), values.to_vec());
            for (i, follower) in followers.iter().enumerate() {
                let Some(follower) = follower else { continue };
                names[i].clone_from(&mechanism.joints()[follower.joint].name);
                let column = values.iter_mut().skip(i).step_by(names.len());
                column.for_each(|value| *value = follower.joint_at(*value));
            }
            return self.solve_many(&names, &values, watch);
        }
        let plain = system::Question::new(mechanism);
        let mut coordinates = Vec::new();
        let mut begins = self.clone();
        for name in names {
            let (coordinate, _) = (plain.value(name, "home"))?;
            if coordinates.contains(&coordinate) {
                return Err(AskError::TwoColumns(name.clone()));
            }
            coordinates.push(coordinate);
            if !self.of(Role::Hold).any(|(_, held)| held.name == *name) {
                begins = begins.hold(name, "home");
            }
        }
        let question = begins.resolved()?;
        check_count(&question)?;
        let question = question.with_spins_still();
        let start = begins.start(&question, watch)?;
        let mut all = RowSeries::new(&question, &coordinates, values, start, watch);
        let rows = match names.len() {
            0 => 0,
            width => {
                assert!(values.len().is_multiple_of(width), "values are whole rows");
                values.len() / width
            }
        };
        all.order = all.order(rows);
        // of many unknowns no program makes the inverse by which motions are certain to keep to their branches
        let follower = (rows >= FEW && all.system.unknowns().len() <= DENSE_LIMIT)
            .then(|| Follower::new(&question, &all.start, &coordinates).ok())
            .flatten();
        let most = ROWS * follower.as_ref().map_or(1, |_| BATCH);
        // blocks of the same size, for cores to share
        let block = rows.div_ceil(rows.div_ceil(most).max(1)).max(1);
        let width = all.columns.len();
        // not filled with what is hardly ever left: pages of so many are had where rows are written
        let (mut found, mut reached) = (vec![0.0; rows * width], vec![false; rows]);
        let blocks = (found.chunks_mut(block * width)).zip(reached.chunks_mut(block));
        let blocks = blocks.enumerate().map(|(number, (values, reached))| {
            Mutex::new(BlockOfRows {
                first: number * block,
                columns: &all.columns,
                values,
                reached,
            })
        });
        let blocks: Vec<Mutex<BlockOfRows>> = blocks.collect();
        let followed = each(blocks.len(), &(), |(), number| {
            let block = &mut *blocks[number]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            let followed = match &follower {
                Some(follower) => all.side_by_side(follower, block),
                None => all.one_by_one(block),
            };
            followed.then(|| block.rest())
        });
        drop(blocks);
        let interrupted = followed.iter().any(Option::is_none);
        if interrupted {
            let before = followed.iter().take_while(|block| block.is_some()).count();
            let left = if all.order.is_empty() {
                (before * block).min(rows)
            } else {
                0
            };
            all.order.clear();
            found.truncate(left * width);
            reached.truncate(left);
        }
        let mut many = Many {
            names: all.columns.iter().map(|of| of.name(mechanism)).collect(),
            values: found,
            reached,
            lost: Vec::new(),
            interrupted,
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
        let lost = (0..many.reached.len()).filter(|row| !many.reached[*row]);
        many.lost = lost
            .map(|row| {
                let values = &values[row * names.len()..(row + 1) * names.len()];
                match values.iter().all(|value| value.is_finite()) {
                    true => (row, Unreached::NoPath),
                    false => (row, Unreached::NotFinite),
                }
            })
            .collect();
        Ok(many)
    }
}
