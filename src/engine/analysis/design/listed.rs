//! Designs of which numbers are taken from lists of values.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::search::{FULLY, FoundEnd, MET, SearchedEnds, Task};
use crate::number::sorting::sort_by;
use crate::solve::{Stage, Watch, each};
use crate::system::Bundle;

/// A search through combinations of listed values, counted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Listed {
    /// Designs with free values from which it began.
    pub begun: usize,
    /// Fits with one more number at a listed value.
    pub fits: usize,
    /// Those of them that could not be assembled on the way from the values before.
    pub lost: usize,
    /// Different combinations of listed values that were completed.
    pub completed: usize,
    /// Combinations that there are.
    pub combinations: f64,
    /// True if no fit that was begun is left without its rest.
    pub exhausted: bool,
}

impl Listed {
    /// Listed values that are tried for each number, those nearest to its fitted value.
    pub const NEAREST: usize = 3;
}

impl Task<'_> {
    /// The closures and targets with numbers that have listed values kept at those of a design.
    pub(super) fn kept(&self, numbers: &[f64]) -> Cow<'_, Bundle<'_>> {
        let mut ranges = self.ranges.clone();
        let listed = self.listed.iter().enumerate();
        let listed = listed.filter(|(_, values)| !values.is_empty());
        listed.for_each(|(i, _)| ranges[i] = (numbers[i], numbers[i]));
        match ranges == self.ranges {
            true => Cow::Borrowed(&self.bundle),
            false => Cow::Owned(self.bundle.clone().within(ranges)),
        }
    }

    /// Numbers that stand still where listed values are kept.
    pub(super) fn still(&self) -> impl Iterator<Item = usize> {
        let all = self.listed.iter().zip(&self.ranges).enumerate();
        let still = all.filter(|(_, (values, (low, high)))| !values.is_empty() || low == high);
        still.map(|(i, _)| i)
    }

    /// Takes numbers with lists from these: each in turn is kept at one of the nearest values, and the others are fitted again, the
    /// fits with the least sum of squares first.
    pub fn take_listed(&self, all: &mut SearchedEnds, watch: &Watch) -> Listed {
        /// Designs from which it begins, combinations after which it ends, and fits at most.
        const BEGUN: usize = 8;
        const COMPLETED: usize = 24;
        const FITS: usize = 600;
        let numbers = 0..self.listed.len();
        let order: Vec<usize> = numbers.filter(|i| !self.listed[*i].is_empty()).collect();
        let sizes = order.iter().map(|i| self.listed[*i].len() as f64);
        let mut open: Vec<(FoundEnd, usize)> = Vec::new();
        open.extend(all.found.iter().take(BEGUN).map(|end| (end.clone(), 0)));
        let mut listed = Listed {
            begun: open.len(),
            fits: 0,
            lost: 0,
            completed: 0,
            combinations: sizes.product(),
            exhausted: false,
        };
        let zero = MET * self.size * self.size;
        let mut ends: Vec<FoundEnd> = Vec::new();
        while listed.completed < COMPLETED && listed.fits < FITS {
            // of fits that meet all targets the one with most numbers kept
            let rank =
                |(end, kept): &(FoundEnd, usize)| (end.squares.max(zero), order.len() - kept);
            let next = (0..open.len()).min_by(|a, b| {
                let [a, b] = [a, b].map(|i| rank(&open[*i]));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            });
            listed.exhausted = next.is_none();
            let Some(next) = next.filter(|_| !watch.stops(Stage::Starts, listed.fits, None)) else {
                break;
            };
            let (end, kept) = open.remove(next);
            let Some(&number) = order.get(kept) else {
                let same =
                    |of: &FoundEnd| order.iter().all(|&i| of.at.numbers[i] == end.at.numbers[i]);
                listed.completed += usize::from(!ends.iter().any(same));
                self.add(&mut ends, end);
                continue;
            };
            let x = end.at.numbers[number];
            let mut values = self.listed[number].clone();
            sort_by(&mut values, |a, b| (a - x).abs().total_cmp(&(b - x).abs()));
            values.truncate(Listed::NEAREST);
            let fits = each(values.len(), &(), |(), i| {
                self.with_value(&end, &order[..=kept], values[i])
            });
            listed.fits += fits.len();
            listed.lost += fits.iter().filter(|end| end.is_none()).count();
            open.extend(fits.into_iter().flatten().map(|end| (end, kept + 1)));
        }
        sort_by(&mut ends, |a, b| a.squares.total_cmp(&b.squares));
        (ends.iter_mut().enumerate()).for_each(|(class, end)| end.class = class);
        all.found = ends;
        listed
    }

    /// The fit with the last of some numbers at a value, and all of them kept.
    fn with_value(&self, from: &FoundEnd, kept: &[usize], value: f64) -> Option<FoundEnd> {
        /// Steps in which the value is reached, with all closures closed.
        const STEPS: usize = 8;
        let number = *kept.last()?;
        let (mut at, before) = (from.at.clone(), from.at.numbers[number]);
        for step in 1..=STEPS {
            at.numbers[number] = match step {
                STEPS => value,
                _ => before + (value - before) * step as f64 / STEPS as f64,
            };
            at = self.bundle.closed(at)?;
        }
        let mut ranges = self.ranges.clone();
        kept.iter()
            .for_each(|&i| ranges[i] = (at.numbers[i], at.numbers[i]));
        let bundle = self.bundle.clone().within(ranges);
        Some(FoundEnd {
            reached: from.reached,
            ..Self::fitted(&bundle, at, FULLY, 0)
        })
    }
}
