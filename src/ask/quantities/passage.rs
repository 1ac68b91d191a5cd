//! Places of a motion between its rows.

use super::Block;
use crate::analysis::sweep::{Between, Schedule};
use crate::mechanism::{Configuration, Mechanism};
use crate::system::{Driven, Held};

/// A row that was seen.
#[derive(Clone)]
pub(in super::super) struct Seen {
    pub at: Configuration<f64>,
    /// The part of the time that is gone.
    pub time: f64,
    pub values: Vec<Option<f64>>,
}

impl Seen {
    /// A row of a block.
    pub fn of(block: &Block, i: usize) -> Self {
        let (row, time) = block.row(i);
        Seen {
            at: row.configuration.clone(),
            time,
            values: block.values(i).collect(),
        }
    }

    /// Another row in its place.
    pub fn put(&mut self, block: &Block, i: usize) {
        let (row, time) = block.row(i);
        self.at.clone_from(row.configuration);
        self.time = time;
        self.values.clear();
        self.values.extend(block.values(i));
    }
}

/// A motion that is solved anywhere between its rows.
#[derive(Clone, Copy)]
pub(in super::super) struct Passage<'m> {
    pub mechanism: &'m Mechanism,
    pub held: &'m Held<f64>,
    pub inputs: &'m [Driven],
    pub schedule: Option<&'m Schedule>,
    /// The part of the time that is gone at a configuration, where no schedule says it.
    pub time: &'m dyn Fn(&Configuration<f64>) -> f64,
}

impl Passage<'_> {
    /// The way between three rows.
    pub fn between(&self, rows: [&Seen; 3]) -> Option<Between> {
        let [first, _, last] = rows;
        let ends = (self.schedule).map(|of| (of.clone(), [first.time, last.time]));
        let rows = rows.map(|row| &row.at);
        Between::new(self.mechanism, self.held, self.inputs, ends, rows)
    }

    /// The configuration at a part of such a way, and the part of the time that is gone there.
    pub fn at<'b>(
        &self,
        between: &'b mut Between,
        part: f64,
    ) -> Option<(&'b Configuration<f64>, f64)> {
        let when = between.time(part);
        let at = between.at(part)?;
        Some((at, when.unwrap_or_else(|| (self.time)(at))))
    }

    /// The inputs at a configuration.
    pub fn inputs(&self, at: &Configuration<f64>) -> Vec<f64> {
        let inputs = self.inputs.iter();
        inputs
            .map(|input| input.coordinate.of(self.mechanism, at))
            .collect()
    }
}

/// All rows of a motion with what is between them: 2.5 is half way from the third to the fourth.
pub(in super::super) struct Course<'m> {
    passage: Passage<'m>,
    rows: &'m [Seen],
    /// The way about the row of that number, on which was last gone.
    near: Option<(usize, Between)>,
}

impl<'m> Course<'m> {
    pub fn new(passage: Passage<'m>, rows: &'m [Seen]) -> Self {
        Course {
            passage,
            rows,
            near: None,
        }
    }

    /// The row next to a place.
    pub fn row(&self, place: f64) -> &'m Seen {
        &self.rows[(place.round() as usize).min(self.rows.len() - 1)]
    }

    /// The configuration at a place, and the part of the time that is gone there.
    pub fn at(&mut self, place: f64) -> Option<(&Configuration<f64>, f64)> {
        if place == place.round() {
            let row = self.row(place);
            return Some((&row.at, row.time));
        }
        let before = place.floor() as usize;
        let middle = before.clamp(1, self.rows.len().checked_sub(2)?.max(1));
        let about = self.rows.get(middle - 1..=middle + 1)?;
        if (self.near.as_ref()).is_none_or(|(known, _)| *known != middle) {
            let between = self.passage.between([&about[0], &about[1], &about[2]])?;
            self.near = Some((middle, between));
        }
        let (_, between) = self.near.as_mut()?;
        let (half, gone) = (between.middle(), place - before as f64);
        let part = match before < middle {
            true => gone * half,
            false => half + gone * (1.0 - half),
        };
        self.passage.at(between, part)
    }
}
