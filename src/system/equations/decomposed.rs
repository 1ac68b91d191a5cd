//! The Jacobian decomposed: as a whole, or a large one group of rows after another.

use super::{System, Work};
use crate::linear::{Decomposition, Rows, SPECTRUM_LIMIT, dense, dot};

impl System<f64> {
    /// True if there are more unknowns than all singular values are computed for.
    pub fn is_large(&self) -> bool {
        self.unknowns.len() > SPECTRUM_LIMIT
    }

    /// The Jacobian last evaluated, decomposed.
    pub fn decomposition(&self, work: &Work<f64>) -> Decomposition {
        self.decomposed(self.unknowns.len(), self.jacobian_rows(work))
    }

    /// Rows over so many columns, decomposed in the way that suits this system.
    pub fn decomposed(&self, columns: usize, groups: Vec<Rows>) -> Decomposition {
        if self.is_large() {
            return Decomposition::of_groups(columns, groups);
        }
        let (rows, entries) = dense(columns, &groups);
        Decomposition::of(rows, columns, &entries)
    }

    /// uᵀ J v for the Jacobian last evaluated.
    pub fn form(&self, work: &Work<f64>, u: &[f64], v: &[f64]) -> f64 {
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
    pub fn jacobian_rows(&self, work: &Work<f64>) -> Vec<Rows> {
        let blocks = work.jacobian.blocks().iter().map(|filled| Rows {
            count: filled.block.rows,
            unknowns: filled.block.unknowns().collect(),
            entries: filled.entries.clone(),
        });
        let shared = self.empty.shared();
        let holds = work.hold_rows.chunks_exact(shared.len().max(1));
        let holds = holds.map(|entries| {
            let touched = shared.iter().copied().zip(entries.iter().copied());
            Rows::single(touched.filter(|(_, entry)| *entry != 0.0))
        });
        blocks.chain(holds).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::norm;
    use crate::mechanism::Mechanism;
    use crate::solve::{Equations, Newton, Watch};
    use crate::system::{Held, Question, close};

    /// Singular values and an elimination must agree on every shipped file, with its inputs held and with nothing held.
    #[test]
    fn elimination_finds_the_rank_and_the_motions_that_the_singular_values_have() {
        let folder = format!("{}/mechanisms", env!("CARGO_MANIFEST_DIR"));
        let files = std::fs::read_dir(folder)
            .unwrap()
            .map(|file| file.unwrap().path());
        let mut compared = 0;
        for path in files.filter(|path| path.extension().is_some_and(|e| e == "ron")) {
            let mechanism = Mechanism::load(&path).unwrap();
            let question = Question::new(&mechanism);
            let Ok(closed) = close(&question, &Newton::default(), (40, 1), &Watch::none()) else {
                continue;
            };
            for held in [Held::nothing(&mechanism), question.held()] {
                let system = System::new(mechanism.dimensions(), &held);
                let (columns, rows) = (system.unknowns().len(), system.rows());
                if columns == 0 || rows == 0 {
                    continue;
                }
                let mut work = system.work();
                system.linearise(&closed.configuration, &mut work);
                let jacobian = system.dense_jacobian(&work);
                let expected = Decomposition::of(rows, columns, &jacobian);
                let found = Decomposition::of_groups(columns, system.jacobian_rows(&work));
                assert_eq!(found.rank(), expected.rank(), "{}", path.display());
                for motion in found.null_space() {
                    let image = crate::linear::product(&jacobian, rows, &motion);
                    assert!(norm(&image) < 1e-9, "{}", path.display());
                }
                compared += 1;
            }
        }
        assert!(compared > 50, "{compared}");
    }
}
