//! Dimensions nearest to targets that nothing meets.

use super::report::{Deviation, Nearest};
use super::search::Task;
use crate::solve::Watch;
use crate::system::Target;

impl Task<'_> {
    /// Dimensions nearest to the targets from a few random starts.
    pub fn nearest(&self, watch: &Watch) -> Option<Nearest> {
        const STARTS: usize = 24;
        let few = Task {
            starts: self.starts.min(STARTS),
            ..self.clone()
        };
        let searched = few.search(&|_| true, watch);
        let best = searched.found.first()?;
        let deviations = self.bundle.deviations(&best.at)?;
        let missed = |of: &(&Target, f64)| match of.0.quantity.unit.is_angle() {
            true => of.1.abs(),
            false => of.1.abs() / self.size,
        };
        let most = |a: &(&Target, f64), b: &(&Target, f64)| missed(a).total_cmp(&missed(b));
        let (target, deviation) = deviations.into_iter().max_by(most)?;
        Some(Nearest {
            values: best.at.numbers.clone(),
            sum_of_squares: best.squares,
            largest: Deviation::of(target, deviation),
            starts: searched.starts,
        })
    }
}
