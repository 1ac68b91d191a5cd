use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::simplicial::{
    SimplicialLltRef, SymbolicSimplicialCholesky, factorize_simplicial_numeric_llt,
    factorize_simplicial_numeric_llt_scratch,
};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::traits::ComplexField;
use faer::{Conj, Mat, Par, Side};

use super::{Filled, SparseStep};
use crate::number::Field;

/// Least squares min ‖J x + r‖ for a large J in which every block of rows touches few unknowns.
///
/// Solves the normal equations (JᴴJ + λ) x = −Jᴴr by sparse Cholesky factors of a pattern analysed once, and corrects
/// x by what is left, because normal equations square the condition number. (Orthogonal factors fill in along chains
/// of loops.) The factors are computed column by column: kernels for groups of columns sum in an order that depends on
/// the width of the processor's registers.
#[derive(Clone, Debug)]
pub struct SparseNormal<T> {
    size: usize,
    /// Where each unknown stands in the order of least fill-in.
    places: Vec<usize>,
    /// The upper triangle of JᴴJ + λ in that order.
    pattern: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    analysis: Arc<SymbolicSimplicialCholesky<usize>>,
    factors: Option<Vec<T>>,
    values: Vec<T>,
    extra: Vec<T>,
    damping: f64,
    /// True if the diagonal was raised because JᴴJ + λ was singular to rounding.
    raised: bool,
}

impl<T: Field + ComplexField> SparseStep<T> for SparseNormal<T> {
    fn new(size: usize, blocks: &[Filled<T>], extra_rows: usize) -> Self {
        let pattern = |places: &[usize]| {
            let mut pairs: Vec<Pair<usize, usize>> = Vec::new();
            for Filled { block, .. } in blocks {
                let columns = block.unknowns().map(|unknown| places[unknown]);
                pairs.extend(upper(columns).map(|(_, pair)| pair));
            }
            if extra_rows > 0 {
                pairs.extend(upper(places.iter().copied()).map(|(_, pair)| pair));
            }
            pairs.extend(places.iter().map(|&i| Pair { row: i, col: i }));
            SymbolicSparseColMat::try_new_from_indices(size, size, &pairs)
                .expect("rows and columns are unknowns, all below the size")
        };
        let mut places: Vec<usize> = (0..size).collect();
        let (natural, _) = pattern(&places);
        let (side, order) = (Side::Upper, SymmetricOrdering::Amd);
        let settings = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..Default::default()
        };
        let analysis = factorize_symbolic_cholesky(natural.as_ref(), side, order, settings)
            .expect("the pattern is square and its indices fit; only memory could lack");
        if let Some(order) = analysis.perm() {
            places.copy_from_slice(order.arrays().1);
        }
        let SymbolicCholeskyRaw::Simplicial(analysis) = analysis.raw() else {
            unreachable!("no ratio of work to entries is above infinity");
        };
        let analysis = Arc::new(analysis.clone());
        let (pattern, order) = pattern(&places);
        SparseNormal {
            size,
            places,
            values: Vec::new(),
            extra: Vec::new(),
            damping: 0.0,
            raised: false,
            pattern,
            order,
            analysis,
            factors: None,
        }
    }

    /// JᴴJ + λ = L·Lᴴ.
    fn factorise(&mut self, blocks: &[Filled<T>], extra: &[T], damping: f64) {
        self.values.clear();
        self.extra = extra.to_vec();
        self.damping = damping;
        for Filled { block, entries } in blocks {
            let column = |j: usize| &entries[j * block.rows..(j + 1) * block.rows];
            let columns = block.unknowns().map(|unknown| self.places[unknown]);
            self.values
                .extend(upper(columns).map(|([i, j], _)| inner(column(i), column(j))));
        }
        if !extra.is_empty() {
            let size = self.size;
            let product = |i: usize, j: usize| {
                let rows = extra.chunks_exact(size);
                rows.fold(T::zero(), |sum, row| sum + row[i].conjugate() * row[j])
            };
            let pairs = upper(self.places.iter().copied());
            self.values.extend(pairs.map(|([i, j], _)| product(i, j)));
        }
        let largest = self.values.iter().fold(1.0, |m: f64, x| m.max(x.real()));
        // a freedom left makes JᴴJ singular: the least addition that can be factorised keeps the step short along it
        let mut floor = damping;
        loop {
            let filled = self.values.len();
            self.values.resize(filled + self.size, T::from_f64(floor));
            let matrix =
                SparseColMat::new_from_argsort(self.pattern.clone(), &self.order, &self.values);
            self.values.truncate(filled);
            self.factors = matrix.ok().and_then(|matrix| {
                let mut factors = vec![T::zero(); self.analysis.len_val()];
                let scratch = factorize_simplicial_numeric_llt_scratch::<usize, T>(self.size);
                factorize_simplicial_numeric_llt(
                    &mut factors,
                    matrix.as_ref(),
                    Default::default(),
                    &self.analysis,
                    MemStack::new(&mut MemBuffer::new(scratch)),
                )
                .is_ok()
                .then_some(factors)
            });
            self.raised = floor > damping;
            if self.factors.is_some() || floor > largest {
                return;
            }
            floor = (floor * 100.0).max(1e-15 * largest);
        }
    }

    /// 1 if the diagonal had to be raised, 0 otherwise: a lower bound.
    fn nullity(&self) -> usize {
        usize::from(self.raised)
    }

    /// Zero if the entries were not finite.
    fn step(&self, blocks: &[Filled<T>], r: &[T], x: &mut [T]) {
        // two corrections bring the error of the normal equations down to that of J itself
        const CORRECTIONS: usize = 2;
        x.fill(T::zero());
        let Some(factors) = &self.factors else {
            return;
        };
        let factors = SimplicialLltRef::new(&self.analysis, factors);
        let mut memory = MemBuffer::new(self.analysis.solve_in_place_scratch::<T>(1));
        for _ in 0..=CORRECTIONS {
            let mut slope = Mat::<T>::zeros(self.size, 1);
            let mut row = 0;
            for filled in blocks {
                let mut left = r[row..row + filled.block.rows].to_vec();
                for (unknown, column) in filled.columns() {
                    for (left, entry) in left.iter_mut().zip(column) {
                        *left += *entry * x[unknown];
                    }
                }
                for (unknown, column) in filled.columns() {
                    slope[(self.places[unknown], 0)] -= inner(column, &left);
                }
                row += filled.block.rows;
            }
            for (entries, &r) in self.extra.chunks_exact(self.size).zip(&r[row..]) {
                let left = (entries.iter().zip(&*x)).fold(r, |sum, (a, x)| sum + *a * *x);
                for (i, entry) in entries.iter().enumerate() {
                    slope[(self.places[i], 0)] -= entry.conjugate() * left;
                }
            }
            for (i, x) in x.iter().enumerate() {
                slope[(self.places[i], 0)] -= x.scale(self.damping);
            }
            let stack = MemStack::new(&mut memory);
            factors.solve_in_place_with_conj(Conj::No, slope.as_mut(), Par::Seq, stack);
            for (i, x) in x.iter_mut().enumerate() {
                *x += slope[(self.places[i], 0)];
            }
        }
    }
}

/// Pairs [i, j] of columns whose product is on or above the diagonal, with its row and column.
fn upper(
    columns: impl Iterator<Item = usize> + Clone,
) -> impl Iterator<Item = ([usize; 2], Pair<usize, usize>)> {
    let other = columns.clone().enumerate();
    columns.enumerate().flat_map(move |(j, col)| {
        let rows = other.clone().filter(move |&(_, row)| row <= col);
        rows.map(move |(i, row)| ([i, j], Pair { row, col }))
    })
}

fn inner<T: Field>(a: &[T], b: &[T]) -> T {
    let products = a.iter().zip(b).map(|(a, b)| a.conjugate() * *b);
    products.fold(T::zero(), |sum, product| sum + product)
}
