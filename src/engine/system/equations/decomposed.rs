//! The Jacobian decomposed: as a whole, or a large one group of rows after another.

use super::{System, SystemWork};
use crate::linear::{Decomposition, RowGroup, SPECTRUM_LIMIT, dense, dot};

impl System<f64> {
    /// True if there are more unknowns than all singular values are computed for.
    pub fn is_large(&self) -> bool {
        self.unknowns.len() > SPECTRUM_LIMIT
    }

    /// The Jacobian last evaluated, decomposed.
    pub fn decomposition(&self, work: &SystemWork<f64>) -> Decomposition {
        self.decomposed(self.unknowns.len(), self.jacobian_rows(work))
    }

    /// Rows over so many columns, decomposed in the way that suits this system.
    pub fn decomposed(&self, columns: usize, groups: Vec<RowGroup>) -> Decomposition {
        if self.is_large() {
            return Decomposition::of_groups(columns, groups);
        }
        let (rows, entries) = dense(columns, &groups);
        Decomposition::of(rows, columns, &entries)
    }

    /// uᵀ J v for the Jacobian last evaluated.
    pub fn form(&self, work: &SystemWork<f64>, u: &[f64], v: &[f64]) -> f64 {
        let mut first = 0;
        let groups = self.jacobian_rows(work).into_iter().map(|group| {
            let u = &u[first..first + group.count];
            first += group.count;
            let columns = group.columns();
            columns
                .map(|(&unknown, column)| v[unknown] * dot(u, column))
                .sum::<f64>()
        });
        groups.sum()
    }

    /// The Jacobian last evaluated as groups of rows, in their order, with the unknowns that each group touches.
    pub fn jacobian_rows(&self, work: &SystemWork<f64>) -> Vec<RowGroup> {
        let blocks = work.jacobian.blocks().iter().map(|filled| RowGroup {
            count: filled.block.rows,
            unknowns: filled.block.unknowns().collect(),
            entries: filled.entries.clone(),
        });
        let shared = self.empty.shared();
        let holds = work.hold_rows.chunks_exact(shared.len().max(1));
        let holds = holds.map(|entries| {
            let touched = shared.iter().copied().zip(entries.iter().copied());
            RowGroup::single(touched.filter(|(_, entry)| *entry != 0.0))
        });
        blocks.chain(holds).collect()
    }
}
