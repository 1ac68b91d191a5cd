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
    /// Improves so many of the cheapest ends that meet the targets nearest, where numbers are open, by an estimate of what they cost:
    /// returns their number. The best is improved by the cost itself where the two differ.
    pub fn improve(
        &self,
        all: &mut SearchedEnds,
        most: usize,
        (estimate, cost): (&Cost, &Cost),
        watch: &Watch,
    ) -> usize {
        /// Ends of which the costs are compared at most.
        const JUDGED: usize = 60;
        /// Improved designs that are located to the last digits at most.
        const BEST: usize = 3;
        /// Sizes of the first simplices, in units of the numbers.
        const COARSE: [f64; 2] = [0.2, 0.05];
        const FINE: [f64; 3] = [1e-2, 1e-4, 1e-6];
        let Some(least) = all.found.first().map(|of| of.squares) else {
            return 0;
        };
        let zero = EXACT * self.size * self.size;
        let nearest = all.found.iter().take(JUDGED);
        let nearest = nearest.filter(|of| of.squares <= least * (1.0 + SAME) + zero);
        let mut first: Vec<(FoundEnd, f64)> = nearest
            .filter(|of| (self.bundle.model(&of.at)).is_some_and(|model| !model.open().is_empty()))
            .filter_map(|of| Some((of.clone(), estimate(of)?)))
            .collect();
        sort_by(&mut first, |a, b| a.1.total_cmp(&b.1));
        first.truncate(most);
        let count = first.len();
        let mut coarse = self.improved_all(&first, &COARSE, estimate, watch);
        if count > 0 {
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

    /// Improves designs: those that are different then, best first.
    fn improved_all(
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
        /// A part of the cost that is worth another round.
        const GAIN: f64 = 1e-4;
        let mut best = from.clone();
        for size in sizes {
            for _ in 0..ROUNDS {
                let model = self.bundle.model(&best.0.at);
                let open = model.map_or_else(Vec::new, |model| model.open());
                if open.is_empty() || watch.is_stopped() {
                    return best;
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
        best
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
