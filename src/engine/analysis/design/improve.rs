//! Designs that meet their targets, improved where the targets leave numbers open.

use super::search::{FoundEnd, MET, SearchedEnds, Task};
use crate::linear::add;
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::{LeastSquares, LevenbergMarquardt, Watch, each, simplex};
use crate::system::{Bundle, Bundled};

/// Cost of a design; `None` for one that is none.
pub type Cost<'a> = dyn Fn(&FoundEnd) -> Option<f64> + Sync + 'a;

impl Task<'_> {
    /// Improves so many of the cheapest ends that meet the targets nearest, where numbers are open, by an estimate of what they cost:
    /// returns their number. The best is improved by the cost itself where the two differ.
    pub fn improve(
        &self,
        all: &mut SearchedEnds,
        most: usize,
        (estimate, cost): (&Cost, &Cost),
        watch: &Watch,
    ) -> usize {
        /// Improved designs that are located to the last digits at most.
        const BEST: usize = 3;
        /// Sizes of the first simplices, in units of the numbers.
        const COARSE: [f64; 2] = [0.2, 0.05];
        const FINE: [f64; 3] = [1e-2, 1e-4, 1e-6];
        let costs = |of: &FoundEnd| Some((of.clone(), estimate(of)?));
        let mut first: Vec<_> = self.open_ends(all).into_iter().filter_map(costs).collect();
        sort_by(&mut first, |a, b| a.1.total_cmp(&b.1));
        first.truncate(most);
        let count = first.len();
        if count > 0 {
            let mut coarse = self.improved_all(&first, &COARSE, estimate, watch);
            coarse.truncate(BEST);
            let mut fine = self.improved_all(&coarse, &FINE, estimate, watch);
            for found in &mut fine {
                if let Some(costs) = cost(&found.0) {
                    if (costs - found.1).abs() > SAME * costs.abs() {
                        *found = self.improved(&(found.0.clone(), costs), &FINE[1..], cost, watch);
                    }
                    break;
                }
            }
            all.found = fine.into_iter().map(|(end, _)| end).collect();
        }
        count
    }

    /// Ends that meet the targets nearest, where numbers are open.
    pub(super) fn open_ends<'e>(&self, all: &'e SearchedEnds) -> Vec<&'e FoundEnd> {
        /// Ends of which the costs are compared at most.
        const JUDGED: usize = 60;
        let least = all.found.first().map_or(0.0, |of| of.squares);
        let zero = MET * self.size * self.size;
        let nearest = all.found.iter().take(JUDGED);
        let nearest = nearest.filter(|of| of.squares <= least * (1.0 + SAME) + zero);
        nearest.filter(|of| !self.open(of).is_empty()).collect()
    }

    /// Improves designs: those that are different then, best first.
    pub(super) fn improved_all(
        &self,
        from: &[(FoundEnd, f64)],
        sizes: &[f64],
        cost: &Cost,
        watch: &Watch,
    ) -> Vec<(FoundEnd, f64)> {
        let mut ends = each(from.len(), &(), |(), i| {
            self.improved(&from[i], sizes, cost, watch)
        });
        sort_by(&mut ends, |a, b| a.1.total_cmp(&b.1));
        let mut distinct: Vec<(FoundEnd, f64)> = Vec::new();
        for end in ends {
            let same = |of: &&mut (FoundEnd, f64)| self.near(&of.0.at, &end.0.at);
            match distinct.iter_mut().find(same) {
                Some(of) => of.0.reached += end.0.reached,
                None => distinct.push(end),
            }
        }
        distinct
    }

    /// The cheapest design to which the simplex method of Nelder and Mead (1965) leads among those that meet the targets, with
    /// what it costs.
    ///
    /// A simplex moves in the numbers that the targets leave open; what it reaches is brought back to the targets by Gauss and
    /// Newton's method. It is begun anew, ever smaller, from where it came to rest.
    fn improved(
        &self,
        from: &(FoundEnd, f64),
        sizes: &[f64],
        cost: &Cost,
        watch: &Watch,
    ) -> (FoundEnd, f64) {
        /// Rounds of one size at most.
        const ROUNDS: usize = 3;
        let mut best = from.clone();
        let bundle = self.kept(&from.0.at.numbers);
        for size in sizes {
            for _ in 0..ROUNDS {
                let open = self.open(&best.0);
                if open.is_empty() || watch.is_stopped() {
                    return best;
                }
                let (base, before) = best.clone();
                simplex(open.len(), *size, watch, |along| {
                    let found = self.displaced(&bundle, &base, &open, along)?;
                    let costs = cost(&found)?;
                    if costs < best.1 {
                        best = (found, costs);
                    }
                    Some(costs)
                });
                // so little is not worth another round
                if before - best.1 <= 1e-4 * before.abs() {
                    break;
                }
            }
        }
        best
    }

    /// Directions of the numbers that the targets leave open.
    fn open(&self, of: &FoundEnd) -> Vec<Vec<f64>> {
        let model = self.bundle.model(&of.at);
        model.map_or_else(Vec::new, |model| model.open(self.still()))
    }

    /// The design some way along open directions of the numbers that meets the targets as well.
    fn displaced(
        &self,
        bundle: &Bundle,
        from: &FoundEnd,
        open: &[Vec<f64>],
        along: &[f64],
    ) -> Option<FoundEnd> {
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
            numbers: bundle.stepped_numbers(&from.at.numbers, &step),
            configurations: from.at.configurations.clone(),
        };
        let end = method.solve(bundle, start);
        let zero = MET * self.size * self.size;
        let meets = end.misfit.squares <= from.squares + zero && end.misfit.equations <= MET;
        meets.then(|| FoundEnd {
            at: end.point,
            squares: end.misfit.squares,
            ..from.clone()
        })
    }
}
