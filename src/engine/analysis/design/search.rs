//! The search for dimensions: Levenberg and Marquardt's method from many random starts.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::pinned::PinnedFourBar;
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::SAME;
use crate::number::{real, sorting::sort_by};
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
pub(super) const EXACT: f64 = 1e-20;

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
            let zero = EXACT * self.size * self.size;
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

    /// Random numbers in their ranges: lengths of the order of the task's size first of all.
    pub(super) fn numbers(&self, rng: &mut Pcg64) -> Vec<f64> {
        let ranges = self.ranges.iter().zip(&self.angles);
        ranges
            .map(|(&(low, high), angle)| {
                let part = rng.random::<f64>();
                let even = low + (high - low) * part;
                if *angle || low == high {
                    return even;
                }
                // from a twentieth of the size to five times that, evenly by the logarithm
                let far = self.size * real::pow(100.0, rng.random::<f64>()) * 0.05;
                let signed = if rng.random::<bool>() { far } else { -far };
                let far = if low < 0.0 { signed } else { far };
                if (low..=high).contains(&far) {
                    far
                } else {
                    even
                }
            })
            .collect()
    }

    /// A random configuration, far from assembled.
    pub(super) fn random(&self, rng: &mut Pcg64) -> Configuration<f64> {
        let mut at = self.mechanism.home();
        for (joint, value) in self.mechanism.joints().iter().zip(&mut at.joints) {
            let random = 2.0 * rng.random::<f64>() - 1.0;
            *value += match joint.kind.is_angle() {
                true => PI * random,
                false => 0.5 * self.size * random,
            };
        }
        at
    }

    fn start(&self, own: bool, rng: &mut Pcg64) -> Option<Bundled> {
        /// Random configurations from which the first position is closed at most.
        const FIRST: usize = 5;
        let numbers = match own {
            true => self.bundle.file(),
            false => self.numbers(rng),
        };
        let configurations = match (self.ranges.is_empty(), self.free_driver) {
            (true, _) => self.each_alone(&numbers, rng),
            (false, Some(driver)) => self.along(driver, &numbers, rng),
            (false, None) => {
                let mut closer = self.bundle.closer(&numbers)?;
                let first = (0..FIRST).find_map(|_| closer.closed(0, self.random(rng)));
                let first = first?;
                let mut at = first.clone();
                let others = (1..self.positions).map(|position| {
                    at = closer.closed(position, at.clone())?;
                    Some(at.clone())
                });
                [Some(first)].into_iter().chain(others).collect()
            }
        };
        Some(Bundled {
            configurations: configurations?,
            numbers,
        })
    }

    /// For each position the nearest of many configurations, in all assemblies that random starts lead to.
    fn each_alone(&self, numbers: &[f64], rng: &mut Pcg64) -> Option<Vec<Configuration<f64>>> {
        const STARTS: usize = 12;
        let mut samples = Vec::new();
        if let Some(driver) = self.free_driver {
            for _ in 0..STARTS {
                let of = self.samples(driver, numbers, rng);
                samples.extend(of.into_iter().flat_map(|(samples, _)| samples));
            }
        }
        let mut closer = self.bundle.closer(numbers)?;
        let each = (0..self.positions).map(|position| {
            let mut samples = samples.clone();
            if self.free_driver.is_none() {
                let random = (0..STARTS).map(|_| self.random(rng));
                samples.extend(random.filter_map(|at| closer.closed(position, at)));
            }
            let squares = self.bundle.squares_at(position, numbers, &samples);
            let all = samples.into_iter().zip(squares);
            let nearest = all.min_by(|a, b| a.1.total_cmp(&b.1));
            nearest.map(|(at, _)| at)
        });
        each.collect()
    }

    /// Configurations at evenly spaced values of the driving joint, and true if it goes round.
    fn samples(
        &self,
        driver: usize,
        numbers: &[f64],
        rng: &mut Pcg64,
    ) -> Option<(Vec<Configuration<f64>>, bool)> {
        const SAMPLES: usize = 48;
        let angle = self.mechanism.joints()[driver].kind.is_angle();
        let stride = match angle {
            true => TAU / SAMPLES as f64,
            false => 2.0 * self.size / SAMPLES as f64,
        };
        let mut closer = self.plain.as_ref()?.closer(numbers)?;
        let first = closer.closed(0, self.random(rng))?;
        let mut samples = vec![first.clone()];
        let mut round = angle;
        for sign in [1.0, -1.0] {
            let mut at = first.clone();
            while samples.len() < SAMPLES {
                at.joints[driver] += sign * stride;
                match closer.closed(0, at.clone()) {
                    Some(next) => at = next,
                    None => {
                        round = false;
                        break;
                    }
                }
                match sign > 0.0 {
                    true => samples.push(at.clone()),
                    false => samples.insert(0, at.clone()),
                }
            }
        }
        Some((samples, round))
    }

    /// Samples of one motion, of which those are taken that are nearest to the targets when they are passed one after another at
    /// an even pace.
    fn along(
        &self,
        driver: usize,
        numbers: &[f64],
        rng: &mut Pcg64,
    ) -> Option<Vec<Configuration<f64>>> {
        let (samples, round) = self.samples(driver, numbers, rng)?;
        let count = samples.len();
        let squares: Vec<Vec<f64>> = (0..self.positions)
            .map(|position| self.bundle.squares_at(position, numbers, &samples))
            .collect();
        let mut best: Option<(f64, Vec<usize>)> = None;
        let parts = [1.0, 0.6, 0.3, 0.15].map(|part| part * (0.8 + 0.4 * rng.random::<f64>()));
        for pace in parts.iter().flat_map(|part| [*part, -part]) {
            for begin in 0..count {
                let place = |position: usize| {
                    let part = position as f64 / self.positions as f64;
                    let place = begin as f64 + pace * part * count as f64;
                    let whole = place.round() as i64;
                    match round {
                        true => whole.rem_euclid(count as i64) as usize,
                        false => whole.clamp(0, count as i64 - 1) as usize,
                    }
                };
                let places: Vec<usize> = (0..self.positions).map(place).collect();
                let sum = places.iter().zip(&squares).map(|(i, of)| of[*i]).sum();
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, places));
                }
            }
        }
        let (_, places) = best?;
        Some(places.into_iter().map(|i| samples[i].clone()).collect())
    }
}
