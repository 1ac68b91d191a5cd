//! Designs of which none is beaten in both of two goals.

use super::search::{FoundEnd, SearchedEnds, Task};
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::Watch;

/// Costs of a design by two goals; `None` for one that is none.
pub type Costs<'a> = dyn Fn(&FoundEnd) -> Option<[f64; 2]> + Sync + 'a;

/// Cost of a design that misses a condition, times one and more for how far it misses it.
pub const MISSED: f64 = 1e30;

/// A design with its costs.
type CostedDesign = (FoundEnd, [f64; 2]);

impl Task<'_> {
    /// So many designs along the front of two costs, by bounded objectives (Haimes, Lasdon and Wismer 1971): each cost alone is
    /// made small, beginning at `most` designs; then the first with the second no greater than each of evenly spaced values,
    /// beginning at the best designs known that keep the bound. Returns the number of designs that were given and improved.
    pub fn front(
        &self,
        all: &mut SearchedEnds,
        (points, most): (usize, usize),
        costs: &Costs,
        watch: &Watch,
    ) -> usize {
        /// Designs from which each search with a bound begins.
        const BEGUN: usize = 2;
        let both = |end: &FoundEnd| Some((end.clone(), costs(end)?));
        let mut known: Vec<CostedDesign> =
            self.open_ends(all).into_iter().filter_map(both).collect();
        let count = known.len().min(most);
        let ends =
            [0, 1].map(|one| self.least(&mut known, (one, f64::INFINITY), most, costs, watch));
        let [Some(first), Some((_, [_, lowest]))] = &ends else {
            return 0;
        };
        let highest = first.1[1];
        let steps = points.max(2) - 1;
        let bounds = (0..steps).map(|step| {
            let part = step as f64 / steps as f64;
            lowest + part * (highest - lowest) + SAME * lowest.abs()
        });
        let bounded = bounds.map(|bound| self.least(&mut known, (0, bound), BEGUN, costs, watch));
        let mut front: Vec<CostedDesign> = bounded.flatten().chain([first.clone()]).collect();
        sort_by(&mut front, |(_, a), (_, b)| {
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        });
        all.found.clear();
        // better by less than a millionth of the range is not better
        let (mut least, better) = (f64::INFINITY, 1e-6 * (highest - lowest));
        for (end, both) in front {
            if both[1] < least - better {
                least = both[1];
                let class = all.found.len();
                all.found.push(FoundEnd { class, ..end });
            }
        }
        count
    }

    /// The cheapest design in one of two costs with the other no greater than a bound, which is known then.
    fn least(
        &self,
        known: &mut Vec<CostedDesign>,
        (one, bound): (usize, f64),
        begun: usize,
        costs: &Costs,
        watch: &Watch,
    ) -> Option<CostedDesign> {
        /// Sizes of the simplices, in units of the numbers.
        const SIZES: [f64; 2] = [5e-2, 1e-4];
        let cost = |both: [f64; 2]| match (both[1 - one] - bound) / (1.0 + bound.abs()) {
            beyond if beyond > 0.0 => MISSED * (1.0 + beyond),
            _ => both[one],
        };
        sort_by(known, |(_, a), (_, b)| cost(*a).total_cmp(&cost(*b)));
        let from = known.iter().take(begun);
        let from: Vec<_> = from.map(|(end, both)| (end.clone(), cost(*both))).collect();
        let ends = self.improved_all(&from, &SIZES, &|of| costs(of).map(cost), watch);
        let (end, _) = ends.into_iter().find(|(_, cost)| *cost < MISSED)?;
        let found = (end.clone(), costs(&end)?);
        known.push(found.clone());
        Some(found)
    }
}
