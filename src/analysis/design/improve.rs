//! Designs that meet their targets, improved where the targets leave numbers open.

use super::search::{EXACT, FoundEnd, SearchedEnds, Task};
use crate::linear::add;
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::{LeastSquares, LevenbergMarquardt, Watch, each, simplex};
use crate::system::Bundled;

/// What a design costs; `None` for one that is none.
pub type Cost<'a> = dyn Fn(&FoundEnd) -> Option<f64> + Sync + 'a;

impl Task<'_> {
    /// Improves so many of the cheapest ends that meet the targets nearest, where numbers are open: returns their number.
    pub fn improve(
        &self,
        all: &mut SearchedEnds,
        most: usize,
        cost: &Cost,
        watch: &Watch,
    ) -> usize {
        /// Ends of which the costs are compared at most.
        const JUDGED: usize = 60;
        /// Sizes of the first simplices, in units of the numbers.
        const COARSE: [f64; 2] = [0.2, 0.05];
        const FINE: [f64; 3] = [1e-2, 1e-4, 1e-6];
        let Some(least) = all.found.first().map(|of| of.squares) else {
            return 0;
        };
        let zero = EXACT * self.size * self.size;
        let nearest = all.found.iter().take(JUDGED);
        let nearest = nearest.filter(|of| of.squares <= least * (1.0 + SAME) + zero);
        let mut costs: Vec<(f64, &FoundEnd)> = nearest
            .filter(|of| (self.bundle.model(&of.at)).is_some_and(|model| !model.open().is_empty()))
            .filter_map(|of| Some((cost(of)?, of)))
            .collect();
        sort_by(&mut costs, |a, b| a.0.total_cmp(&b.0));
        costs.truncate(most);
        let count = costs.len();
        let first = costs.into_iter().map(|(_, of)| of.clone()).collect();
        let coarse = self.improved_all(first, &COARSE, cost, watch);
        if count > 0 {
            all.found = self.improved_all(coarse, &FINE, cost, watch);
        }
        count
    }

    /// Improves designs: those that are different then, best first.
    fn improved_all(
        &self,
        from: Vec<FoundEnd>,
        sizes: &[f64],
        cost: &Cost,
        watch: &Watch,
    ) -> Vec<FoundEnd> {
        let ends = each(from.len(), &(), |(), i| {
            self.improved(&from[i], sizes, cost, watch)
        });
        let mut ends: Vec<(FoundEnd, f64)> = ends.into_iter().flatten().collect();
        sort_by(&mut ends, |a, b| a.1.total_cmp(&b.1));
        let mut distinct: Vec<FoundEnd> = Vec::new();
        for (end, _) in ends {
            match distinct.iter_mut().find(|of| self.near(&of.at, &end.at)) {
                Some(of) => of.reached += end.reached,
                None => distinct.push(end),
            }
        }
        distinct
    }

    /// The cheapest design to which the simplex method of Nelder and Mead (1965) leads among those that meet the targets, with
    /// what it costs; `None` if the first is none.
    ///
    /// A simplex moves in the numbers that the targets leave open; what it reaches is brought back to the targets by Gauss and
    /// Newton's method. It is begun anew, ever smaller, from where it came to rest.
    fn improved(
        &self,
        from: &FoundEnd,
        sizes: &[f64],
        cost: &Cost,
        watch: &Watch,
    ) -> Option<(FoundEnd, f64)> {
        /// Rounds of one size at most.
        const ROUNDS: usize = 6;
        /// A part of the cost that is worth another round.
        const GAIN: f64 = 1e-4;
        let mut best = (from.clone(), cost(from)?);
        for size in sizes {
            for _ in 0..ROUNDS {
                let open = self.bundle.model(&best.0.at)?.open();
                if open.is_empty() || watch.is_stopped() {
                    return Some(best);
                }
                let (base, before) = best.clone();
                simplex(open.len(), *size, watch, |along| {
                    let found = self.beside(&base, &open, along)?;
                    let costs = cost(&found)?;
                    if costs < best.1 {
                        best = (found, costs);
                    }
                    Some(costs)
                });
                if before - best.1 <= GAIN * before.abs() {
                    break;
                }
            }
        }
        Some(best)
    }

    /// The design some way along open directions of the numbers that meets the targets as well.
    fn beside(&self, from: &FoundEnd, open: &[Vec<f64>], along: &[f64]) -> Option<FoundEnd> {
        let mut step = vec![0.0; self.ranges.len()];
        for (direction, part) in open.iter().zip(along) {
            add(&mut step, *part, direction);
        }
        let method = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 30,
        };
        let start = Bundled {
            numbers: self.bundle.stepped_numbers(&from.at.numbers, &step),
            configurations: from.at.configurations.clone(),
        };
        let end = method.solve(&self.bundle, start);
        let zero = EXACT * self.size * self.size;
        let meets = end.misfit.squares <= from.squares + zero && end.misfit.equations <= EXACT;
        meets.then(|| FoundEnd {
            at: end.point,
            squares: end.misfit.squares,
            ..from.clone()
        })
    }
}
