//! The search for dimensions: Levenberg and Marquardt's method from many random starts.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::pinned::PinnedFourBar;
use crate::mechanism::Mechanism;
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::{LeastSquares, LevenbergMarquardt, Stage, Watch, each};
use crate::system::{Bundle, Bundled};

/// Positions that a mechanism shall take, with numbers of it unknown.
#[derive(Clone, Debug)]
pub struct Task<'m> {
    /// The mechanism.
    pub mechanism: &'m Mechanism,
    /// Closures and targets of all positions.
    pub bundle: Bundle<'m>,
    /// Closures of one position with the driving joint held, where it drives freely.
    pub plain: Option<Bundle<'m>>,
    /// The ranges of the numbers, in m or rad or without unit.
    pub ranges: Vec<(f64, f64)>,
    /// For each number the values that it may have; none where it may have all of its range.
    pub listed: Vec<Vec<f64>>,
    /// For each number true if it is an angle.
    pub angles: Vec<bool>,
    /// The size of what the targets describe, in m.
    pub size: f64,
    /// Number of positions.
    pub positions: usize,
    /// The joint that drives, unless positions give its values.
    pub free_driver: Option<usize>,
    /// The four-bar whose point shall pass through the targets, if it is one.
    pub path: Option<PinnedFourBar>,
    /// Seed of everything random.
    pub seed: u64,
    /// Starts at most.
    pub starts: usize,
    /// True if the first start is at the dimensions of the file, not random ones.
    pub own: bool,
    /// Starts that lead to the least sum of squares after which the search ends.
    pub again: usize,
}

/// An end of the search.
#[derive(Clone, Debug)]
pub struct FoundEnd {
    /// The numbers and the configuration in each position.
    pub at: Bundled,
    /// The weighted sum of squares of all deviations.
    pub squares: f64,
    /// Number of starts that led to it.
    pub reached: usize,
    /// True if it is a least one, or no better one was found in many steps.
    pub finished: bool,
    /// The linkage that it is: those of one class differ by an exchange of links only, so that another one drives.
    pub class: usize,
}

/// All different ends of a search, by their sums of squares.
#[derive(Clone, Debug, Default)]
pub struct SearchedEnds {
    /// The ends.
    pub found: Vec<FoundEnd>,
    /// Number of starts that could be assembled.
    pub starts: usize,
    /// Number of random dimensions that could not.
    pub not_assembled: usize,
    /// True if it was stopped early.
    pub interrupted: bool,
}

/// A sum of squares below this part of that of the targets' size is rounding: the targets are met.
pub(super) const MET: f64 = 1e-20;

/// Steps at most, and the tolerance, of fits that are rough, and of others.
const ROUGHLY: (u64, f64) = (60, 1e-6);
pub(super) const FULLY: (u64, f64) = (1000, 1e-12);

impl Task<'_> {
    /// Searches until the least sum of squares of an end that `judge` accepts has come again often enough.
    ///
    /// Every start is followed roughly first. Of those that are not at their ends then one after another is followed further while it
    /// is lower than what was accepted: most go along valleys in which nothing is found.
    pub fn search(&self, judge: &dyn Fn(&FoundEnd) -> bool, watch: &Watch) -> SearchedEnds {
        const BATCH: usize = 8;
        /// Ends that are judged, and that are located to the last digits, at most.
        const JUDGED: usize = 60;
        const LISTED: usize = 12;
        let mut all = SearchedEnds::default();
        let mut judged: Vec<(Bundled, bool)> = Vec::new();
        let mut best: Option<f64> = None;
        let mut tried = 0;
        while tried < self.starts {
            if watch.stops(Stage::Starts, tried, Some(self.starts)) {
                all.interrupted = true;
                break;
            }
            let count = BATCH.min(self.starts - tried);
            let ends = each(count, &(), |(), i| self.end(tried + i, watch));
            tried += count;
            for (failed, end) in ends {
                all.not_assembled += failed;
                if let Some(end) = end {
                    all.starts += 1;
                    self.add(&mut all.found, end);
                }
            }
            sort_by(&mut all.found, |a, b| a.squares.total_cmp(&b.squares));
            // unless it is lower, where it ends does not matter
            let lower = |of: &FoundEnd| !of.finished && best.is_none_or(|best| of.squares < best);
            if let Some(place) = all.found.iter().position(lower) {
                let end = all.found.remove(place);
                self.add(&mut all.found, self.finished(end));
                sort_by(&mut all.found, |a, b| a.squares.total_cmp(&b.squares));
            }
            // where so many random dimensions cannot be assembled hardly any can
            const HOPELESS: usize = 900;
            if all.starts == 0 && all.not_assembled > HOPELESS {
                break;
            }
            best = None;
            for found in all.found.iter().filter(|of| of.finished) {
                let known = judged.iter().find(|(at, _)| self.same(at, &found.at));
                let good = match known {
                    Some((_, good)) => *good,
                    None if judged.len() < JUDGED => {
                        let good = judge(found);
                        judged.push((found.at.clone(), good));
                        good
                    }
                    None => false,
                };
                if good {
                    best = Some(found.squares);
                    break;
                }
            }
            let zero = MET * self.size * self.size;
            let again = best.map(|best| {
                let like = all
                    .found
                    .iter()
                    .filter(|found| (found.squares - best).abs() <= 1e-6 * best + zero);
                like.map(|found| found.reached).sum::<usize>()
            });
            if again.is_some_and(|again| again >= self.again) {
                break;
            }
        }
        all.interrupted |= watch.is_stopped();
        if all.found.iter().any(|of| of.finished) {
            all.found.retain(|of| of.finished);
        }
        if all.interrupted {
            return all;
        }
        // those that are listed first to the last digits
        let rest = all.found.split_off(LISTED.min(all.found.len()));
        let first = std::mem::take(&mut all.found);
        let first = each(first.len(), &(), |(), i| self.finished(first[i].clone()));
        for end in first.into_iter().chain(rest) {
            self.add(&mut all.found, end);
        }
        sort_by(&mut all.found, |a, b| a.squares.total_cmp(&b.squares));
        all
    }

    pub(super) fn same(&self, a: &Bundled, b: &Bundled) -> bool {
        self.within(SAME, a, b)
    }

    /// True for ends of searches for a minimum that are one: it is located to half the digits of its value.
    pub(super) fn near(&self, a: &Bundled, b: &Bundled) -> bool {
        self.within(SAME.sqrt(), a, b)
    }

    fn within(&self, tolerance: f64, a: &Bundled, b: &Bundled) -> bool {
        let pairs = a.numbers.iter().zip(&b.numbers).zip(&self.angles);
        let mut near = pairs.map(|((a, b), angle)| match angle {
            true => {
                let turns = ((a - b) / TAU).round();
                (a - b - turns * TAU).abs() < tolerance
            }
            false => (a - b).abs() < tolerance * (self.size + a.abs()),
        });
        near.all(|near| near)
    }

    pub(super) fn add(&self, known: &mut Vec<FoundEnd>, end: FoundEnd) {
        let least = |a: f64, b: f64| (a - b).abs() <= SAME * a.min(b);
        let one = |of: &FoundEnd| {
            self.same(&of.at, &end.at)
                || least(of.squares, end.squares) && self.near(&of.at, &end.at)
        };
        match known.iter_mut().find(|of| one(of)) {
            Some(of) => {
                of.reached += end.reached;
                of.finished |= end.finished;
                if end.squares < of.squares {
                    (of.at, of.squares) = (end.at, end.squares);
                }
            }
            None => known.push(end),
        }
    }

    /// The end to which a start leads, and the number of random dimensions before it that could not be assembled.
    fn end(&self, number: usize, watch: &Watch) -> (usize, Option<FoundEnd>) {
        const TRIES: usize = 60;
        const CANDIDATES: usize = 4;
        let mut rng = Pcg64::seed_from_u64(
            self.seed
                .wrapping_mul(0x9e37_79b9)
                .wrapping_add(number as u64),
        );
        let (mut failed, mut count) = (0, 0);
        let mut best: Option<(f64, Bundled)> = None;
        for _ in 0..TRIES {
            if watch.is_stopped() {
                return (failed, None);
            }
            match self.start(self.own && number == 0, &mut rng) {
                None => failed += 1,
                Some(start) => {
                    count += 1;
                    let squares = self.bundle.misfit(&start).squares;
                    if best.as_ref().is_none_or(|(least, _)| squares < *least) {
                        best = Some((squares, start));
                    }
                    if count == CANDIDATES {
                        break;
                    }
                }
            }
        }
        let rough = |(_, start)| Self::fitted(&self.bundle, start, ROUGHLY, number);
        (failed, best.map(rough))
    }

    /// The end to which so many steps of Levenberg and Marquardt's method at most lead from a point, to a tolerance.
    pub(super) fn fitted(
        bundle: &Bundle,
        from: Bundled,
        (steps, tolerance): (u64, f64),
        class: usize,
    ) -> FoundEnd {
        let method = LevenbergMarquardt {
            damping: 1e-2,
            tolerance,
            steps,
        };
        let end = method.solve(bundle, from);
        FoundEnd {
            at: end.point,
            squares: end.misfit.squares,
            reached: 1,
            finished: end.converged,
            class,
        }
    }

    /// The end to which another one leads.
    fn finished(&self, of: FoundEnd) -> FoundEnd {
        let end = Self::fitted(&self.bundle, of.at, FULLY, of.class);
        FoundEnd {
            finished: true,
            reached: of.reached,
            ..end
        }
    }
}
