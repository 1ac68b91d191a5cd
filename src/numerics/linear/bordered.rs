use super::Qr;
use super::lu::Lu;
use super::{ColumnBlock, Factorable, Filled, SparseStep};
use crate::number::Field;

/// Least squares min ‖J x + r‖ for a J made of blocks with unknowns of their own and shared ones.
///
/// Each block is factorised orthogonally over its own unknowns; the rows that are left (a leg's reciprocal wrenches on
/// the platform) form a small border over the shared unknowns. Because the factors are orthogonal the result is the
/// least-squares step of the whole, rank deficient or not. With damping λ > 0, rows √λ·I are added (Levenberg 1944).
#[derive(Clone, Debug)]
pub struct Bordered<T: Factorable> {
    rows: usize,
    blocks: Vec<Filled<T>>,
    factors: Vec<Factor<T>>,
    extra_rows: usize,
    shared: Vec<usize>,
    border: Qr<T>,
    square_border: Lu<T>,
    /// True while the border is solved by its square (LU) factors, false for the orthogonal ones.
    square: bool,
    border_rhs: Vec<T>,
    border_x: Vec<T>,
    sparse: Option<T::Sparse>,
    /// −J⁺ for groups of unknowns, a column for each row; written out when the factors have served as often as that costs.
    inverse: Vec<[T; GROUP]>,
    /// Zeros, of which one becomes 1 for a while.
    unit: Vec<T>,
    /// Number of solutions by these factors.
    served: usize,
}

/// Unknowns that are computed together: products of a matrix and a vector are then made of sums in registers.
const GROUP: usize = 4;

#[derive(Clone, Debug)]
struct Factor<T: Field> {
    /// Places of the block's shared unknowns in the border.
    border_places: Vec<usize>,
    qr: Qr<T>,
    rhs: Vec<T>,
    x: Vec<T>,
}

impl<T: Factorable> Bordered<T> {
    /// A matrix of the given blocks, and below them `extra_rows` rows over the shared unknowns.
    pub fn new(
        unknowns: usize,
        blocks: Vec<ColumnBlock>,
        extra_rows: usize,
        shared: Vec<usize>,
    ) -> Self {
        let place = |unknown: &usize| {
            (shared.iter().position(|s| s == unknown)).expect("blocks share only shared unknowns")
        };
        let rows: usize = blocks.iter().map(|block| block.rows).sum::<usize>() + extra_rows;
        let filled = |block: ColumnBlock| Filled {
            entries: vec![T::zero(); block.rows * block.unknowns().count()],
            block,
        };
        let blocks: Vec<Filled<T>> = blocks.into_iter().map(filled).collect();
        // the sparse factors have no border
        let sparse = (shared.len() > T::Sparse::ABOVE)
            .then(|| T::Sparse::new(unknowns, &blocks, extra_rows));
        let factors = blocks.iter().map(|Filled { block, .. }| {
            let (rows, own) = (block.rows, block.own.len());
            Factor {
                border_places: match sparse {
                    Some(_) => Vec::new(),
                    None => block.shared.iter().map(place).collect(),
                },
                qr: Qr::new(rows + own, own, block.shared.len()),
                rhs: vec![T::zero(); rows + own],
                x: vec![T::zero(); own],
            }
        });
        let (most, width) = match sparse {
            Some(_) => (0, 0),
            None => (rows + unknowns, shared.len()),
        };
        Bordered {
            rows,
            factors: factors.collect(),
            blocks,
            extra_rows,
            border: Qr::new(most, width, 0),
            square_border: Lu::new(width),
            square: false,
            border_rhs: vec![T::zero(); most],
            border_x: vec![T::zero(); width],
            shared,
            inverse: match sparse {
                Some(_) => Vec::new(),
                None => vec![[T::zero(); GROUP]; rows * unknowns.div_ceil(GROUP)],
            },
            unit: vec![T::zero(); rows],
            served: 0,
            sparse,
        }
    }

    /// Counts pivots that are larger than this relative to the largest: where unknowns are known to be determined,
    /// however badly.
    pub fn trust(&mut self, tolerance: f64) {
        self.border.trust(tolerance);
        for factor in &mut self.factors {
            factor.qr.trust(tolerance);
        }
    }

    /// Number of rows: those of the blocks in order, then the extra ones.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of rows below the blocks.
    pub fn extra_rows(&self) -> usize {
        self.extra_rows
    }

    /// The shared unknowns, in the order of the border's columns.
    pub fn shared(&self) -> &[usize] {
        &self.shared
    }

    /// The blocks as filled in.
    pub fn blocks(&self) -> &[Filled<T>] {
        &self.blocks
    }

    /// Every column of every block: its first row, its unknown, its entries.
    pub fn columns(&self) -> impl Iterator<Item = (usize, usize, &[T])> {
        let mut next = 0;
        self.blocks.iter().flat_map(move |filled| {
            let row = next;
            next += filled.block.rows;
            let columns = filled.columns();
            columns.map(move |(unknown, column)| (row, unknown, column))
        })
    }

    /// The entries of block `b` for filling in: column-major, own columns first, then the shared.
    #[inline(always)]
    pub fn block_mut(&mut self, b: usize) -> &mut [T] {
        &mut self.blocks[b].entries
    }

    /// Makes all entries of blocks zero, as at first; factors stay.
    pub fn clear(&mut self) {
        for block in &mut self.blocks {
            block.entries.fill(T::zero());
        }
    }

    /// Factorises the blocks as filled in, then the border; `extra` has the extra rows one after another.
    pub fn factorise(&mut self, extra: &[T], damping: f64) {
        if let Some(sparse) = &mut self.sparse {
            return sparse.factorise(&self.blocks, extra, damping);
        }
        self.served = 0;
        let damped = damping > 0.0;
        let root = T::from_f64(damping.sqrt());
        let mut border_rows = self.extra_rows;
        for (Filled { block, entries }, factor) in self.blocks.iter().zip(&mut self.factors) {
            let (rows, own) = (block.rows, block.own.len());
            let total = if damped { rows + own } else { rows };
            if damped {
                factor.qr.reset(total);
                for (j, column) in entries.chunks_exact(rows.max(1)).enumerate() {
                    let target = factor.qr.column_mut(j);
                    target[..rows].copy_from_slice(column);
                    if j < own {
                        target[rows + j] = root;
                    }
                }
            } else {
                factor.qr.load(rows, entries);
            }
            // rows and unknowns are dimensionless, so a pivot is measured against 1
            factor.qr.factorise(1.0);
            border_rows += total - factor.qr.rank();
        }
        if damped {
            border_rows += self.shared.len();
        }
        self.border.reset(border_rows);
        let mut row = 0;
        for factor in &self.factors {
            let rank = factor.qr.rank();
            for (carried, &place) in factor.qr.carried().zip(&factor.border_places) {
                let left = &carried[rank..];
                self.border.column_mut(place)[row..row + left.len()].copy_from_slice(left);
            }
            row += factor.qr.rows() - rank;
        }
        for i in 0..self.extra_rows {
            for place in 0..self.shared.len() {
                self.border.column_mut(place)[row] = extra[i * self.shared.len() + place];
            }
            row += 1;
        }
        if damped {
            for place in 0..self.shared.len() {
                self.border.column_mut(place)[row + place] = root;
            }
        }
        // the border is usually square, and elimination is faster; without column exchange small pivots do not tell the rank
        self.square = border_rows == self.shared.len()
            && self.square_border.factorise(self.border.entries()) > 1e-3;
        if !self.square {
            self.border.factorise(1.0);
        }
    }

    /// The step −J⁺r in the order of the unknowns, for a residual in that of the rows; may be called again for others.
    pub fn solve(&mut self, r: &[T], x: &mut [T]) {
        if let Some(sparse) = &self.sparse {
            return sparse.step(&self.blocks, r, x);
        }
        self.served += 1;
        if self.served <= self.rows {
            return self.substitute(r, x);
        }
        if self.served == self.rows + 1 {
            self.invert(x);
        }
        let columns = self.inverse.chunks_exact(self.rows.max(1));
        for (x, columns) in x.chunks_mut(GROUP).zip(columns) {
            let mut sums = [T::zero(); GROUP];
            for (column, &r) in columns.iter().zip(r) {
                for (sum, &entry) in sums.iter_mut().zip(column) {
                    *sum = *sum + entry * r;
                }
            }
            for (x, sum) in x.iter_mut().zip(sums) {
                *x = sum;
            }
        }
    }

    /// Writes −J⁺ out, column by column; `x` is storage.
    fn invert(&mut self, x: &mut [T]) {
        let mut unit = std::mem::take(&mut self.unit);
        for row in 0..self.rows {
            unit[row] = T::one();
            self.substitute(&unit, x);
            unit[row] = T::zero();
            for (group, x) in x.chunks(GROUP).enumerate() {
                self.inverse[group * self.rows + row][..x.len()].copy_from_slice(x);
            }
        }
        self.unit = unit;
    }

    fn substitute(&mut self, r: &[T], x: &mut [T]) {
        let mut row = 0;
        let mut border_row = 0;
        for (Filled { block, .. }, factor) in self.blocks.iter().zip(&mut self.factors) {
            let rows = block.rows;
            let r = &r[row..row + rows];
            row += rows;
            // without own unknowns there is nothing to rotate: the rows go to the border
            if block.own.is_empty() {
                negate(r, &mut self.border_rhs[border_row..]);
                border_row += rows;
                continue;
            }
            negate(r, &mut factor.rhs);
            let total = factor.qr.rows();
            factor.rhs[rows..total].fill(T::zero());
            factor.qr.rotate(&mut factor.rhs);
            let left = &factor.rhs[factor.qr.rank()..total];
            self.border_rhs[border_row..border_row + left.len()].copy_from_slice(left);
            border_row += left.len();
        }
        negate(&r[row..], &mut self.border_rhs[border_row..]);
        border_row += self.extra_rows;
        let border_total = self.border.rows();
        self.border_rhs[border_row..border_total].fill(T::zero());
        if self.square {
            self.square_border.solve(&mut self.border_rhs);
            self.border_x
                .copy_from_slice(&self.border_rhs[..self.shared.len()]);
        } else {
            self.border.rotate(&mut self.border_rhs);
            (self.border).back_substitute(&mut self.border_rhs, &mut self.border_x);
        }
        for (&unknown, &value) in self.shared.iter().zip(&self.border_x) {
            x[unknown] = value;
        }
        for (Filled { block, .. }, factor) in self.blocks.iter().zip(&mut self.factors) {
            if block.own.is_empty() {
                continue;
            }
            // row by row: there are few of them, often one, and more shared unknowns
            for (k, b) in factor.rhs[..factor.qr.rank()].iter_mut().enumerate() {
                for (carried, &place) in factor.qr.carried().zip(&factor.border_places) {
                    *b = *b - self.border_x[place] * carried[k];
                }
            }
            (factor.qr).back_substitute(&mut factor.rhs, &mut factor.x);
            for (&unknown, &value) in block.own.iter().zip(&factor.x) {
                x[unknown] = value;
            }
        }
    }

    /// Number of unknowns that the last factorisation left undetermined.
    pub fn nullity(&self) -> usize {
        if let Some(sparse) = &self.sparse {
            return sparse.nullity();
        }
        let blocks = self.blocks.iter().zip(&self.factors);
        let blocks = blocks.map(|(filled, factor)| filled.block.own.len() - factor.qr.rank());
        let free = match self.square {
            true => 0,
            false => self.shared.len() - self.border.rank(),
        };
        blocks.sum::<usize>() + free
    }
}

/// to ← −r, as far as `r` goes.
#[inline(always)]
fn negate<T: Field>(r: &[T], to: &mut [T]) {
    for (to, &r) in to.iter_mut().zip(r) {
        *to = -r;
    }
}
