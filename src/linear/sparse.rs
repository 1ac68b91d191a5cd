use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::{Mat, Side};

use super::Block;
use crate::number::Field;

/// Least squares min ‖J x + r‖ for a large J in which every block of rows touches few unknowns.
///
/// Solves the normal equations (JᴴJ + λ) x = −Jᴴr by a sparse Cholesky factorisation, whose pattern
/// is analysed once, and then corrects x by the residual that is left, because normal equations
/// square the condition number. (Sparse orthogonal factors fill in along chains of loops.)
#[derive(Clone, Debug)]
pub(super) struct SparseNormal<T> {
    size: usize,
    pattern: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    analysis: SymbolicLlt<usize>,
    factors: Option<Llt<usize, T>>,
    values: Vec<T>,
}

impl<T: Field> SparseNormal<T> {
    /// Analyses the pattern of the blocks; extra rows touch all unknowns in `dense`.
    pub fn new(size: usize, blocks: &[Block], extra: &[Vec<usize>]) -> Self {
        let touched = blocks.iter().map(Block::columns).chain(extra.iter().cloned());
        let mut pairs: Vec<Pair<usize, usize>> = touched
            .flat_map(|columns| {
                let lower = columns.clone().into_iter().flat_map(move |col| {
                    let rows = columns.clone().into_iter().filter(move |&row| row >= col);
                    rows.map(move |row| Pair { row, col })
                });
                lower.collect::<Vec<_>>()
            })
            .collect();
        pairs.extend((0..size).map(|i| Pair { row: i, col: i }));
        let (pattern, order) = SymbolicSparseColMat::try_new_from_indices(size, size, &pairs)
            .expect("every index is below the size");
        let analysis = SymbolicLlt::try_new(pattern.as_ref(), Side::Lower)
            .expect("memory for the pattern of a few thousand unknowns");
        SparseNormal {
            size,
            values: Vec::with_capacity(pairs.len()),
            pattern,
            order,
            analysis,
            factors: None,
        }
    }

    /// Factorises JᴴJ + λ. `blocks` gives the columns and entries of every block of rows in the
    /// order of [`SparseNormal::new`], column-major.
    pub fn factorise<'a>(
        &mut self,
        blocks: impl Iterator<Item = (usize, Vec<usize>, &'a [T])>,
        damping: f64,
    ) where
        T: 'a,
    {
        self.values.clear();
        let mut largest = damping.max(f64::MIN_POSITIVE);
        for (rows, columns, entries) in blocks {
            let column = |j: usize| &entries[j * rows..(j + 1) * rows];
            for (j, &col) in columns.iter().enumerate() {
                for (i, &row) in columns.iter().enumerate() {
                    if row >= col {
                        let product = inner(column(i), column(j));
                        largest = largest.max(product.real());
                        self.values.push(product);
                    }
                }
            }
        }
        // a freedom that is left makes JᴴJ singular; the least addition that lets the factorisation
        // through keeps the step short along it
        let mut floor = damping;
        loop {
            let filled = self.values.len();
            self.values.resize(filled + self.size, T::from_f64(floor));
            let matrix = SparseColMat::new_from_argsort(self.pattern.clone(), &self.order, &self.values)
                .expect("the pattern was made of the same entries");
            self.values.truncate(filled);
            let factors = Llt::try_new_with_symbolic(self.analysis.clone(), matrix.as_ref(), Side::Lower);
            self.factors = factors.ok();
            if self.factors.is_some() || floor > largest {
                return;
            }
            floor = (floor * 100.0).max(1e-15 * largest);
        }
    }

    /// Solves (JᴴJ + λ) x = b in place; zero if the factorisation failed (entries not finite).
    pub fn solve(&self, b: &mut [T]) {
        match &self.factors {
            Some(factors) => {
                let mut x = Mat::from_fn(self.size, 1, |i, _| b[i]);
                factors.solve_in_place(x.as_mut());
                for (i, b) in b.iter_mut().enumerate() {
                    *b = x[(i, 0)];
                }
            }
            None => b.fill(T::zero()),
        }
    }
}

fn inner<T: Field>(a: &[T], b: &[T]) -> T {
    let products = a.iter().zip(b).map(|(a, b)| a.conjugate() * *b);
    products.fold(T::zero(), |sum, product| sum + product)
}
