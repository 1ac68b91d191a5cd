use std::fmt::Debug;

use crate::number::{Complex, Dual, Field, Interval, Lanes};

/// The columns of one block of rows: unknowns of its own, and shared ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Number of rows.
    pub rows: usize,
    /// Indices of the unknowns that appear in no other block.
    pub own: Vec<usize>,
    /// Indices of the shared unknowns the block touches, in the order of its carried columns.
    pub shared: Vec<usize>,
}

impl Block {
    /// The unknowns of its columns, in their order.
    pub fn unknowns(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.own.iter().chain(&self.shared).copied()
    }
}

/// Least-squares steps for a large matrix made of blocks that touch few unknowns each.
pub trait SparseStep<T>: Clone + Debug + Send + Sync + Sized {
    /// Whether there is such a factorisation; otherwise large matrices are treated as dense.
    const AVAILABLE: bool;
    /// Analyses the pattern of the blocks and of `extra_rows` rows that touch every unknown.
    fn new(unknowns: usize, blocks: &[Block], extra_rows: usize) -> Self;
    /// Factorises the blocks, each column-major, and the extra rows, row after row.
    fn factorise<'a>(
        &mut self,
        blocks: impl Iterator<Item = (&'a Block, &'a [T])>,
        extra: &[T],
        damping: f64,
    ) where
        T: 'a;
    /// The step −J⁺r for the blocks last factorised.
    fn step<'a, I>(&self, blocks: impl Fn() -> I, r: &[T], x: &mut [T])
    where
        T: 'a,
        I: Iterator<Item = (&'a Block, &'a [T])>;
}

/// No sparse factorisation: large matrices are dense, or with `FILLED` filled in block by block and never factorised.
#[derive(Clone, Copy, Debug)]
pub struct NoFactors<const FILLED: bool>;

/// Matrices of any size are dense.
pub type DenseOnly = NoFactors<false>;

impl<T, const FILLED: bool> SparseStep<T> for NoFactors<FILLED> {
    const AVAILABLE: bool = FILLED;
    fn new(_: usize, _: &[Block], _: usize) -> Self {
        NoFactors
    }
    fn factorise<'a>(&mut self, _: impl Iterator<Item = (&'a Block, &'a [T])>, _: &[T], _: f64)
    where
        T: 'a,
    {
        unreachable!("derivatives are taken of residuals; equations are solved over other numbers")
    }
    fn step<'a, I>(&self, _: impl Fn() -> I, _: &[T], _: &mut [T])
    where
        T: 'a,
        I: Iterator<Item = (&'a Block, &'a [T])>,
    {
        unreachable!("never factorised")
    }
}

/// A number for which least-squares steps are computed, with its way to do so for large, sparse matrices.
pub trait Factorable: Field {
    /// The sparse factorisation.
    type Sparse: SparseStep<Self>;
}

impl Factorable for f64 {
    #[cfg(feature = "sparse")]
    type Sparse = super::SparseNormal<f64>;
    #[cfg(not(feature = "sparse"))]
    type Sparse = DenseOnly;
}

impl Factorable for Complex<f64> {
    #[cfg(feature = "sparse")]
    type Sparse = super::SparseNormal<Complex<f64>>;
    #[cfg(not(feature = "sparse"))]
    type Sparse = DenseOnly;
}

impl<T: Field> Factorable for Dual<T> {
    type Sparse = NoFactors<true>;
}

impl Factorable for Interval {
    type Sparse = DenseOnly;
}

impl Factorable for Lanes {
    type Sparse = DenseOnly;
}
