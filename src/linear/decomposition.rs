use super::vectors::{add, complement, dot, product};
use super::{Svd, rank};

/// The singular value decomposition A = U·Σ·Vᵀ of a dense matrix, cut at the rank tolerance.
///
/// Source: Golub and Van Loan, §2.4 and §5.5.
#[derive(Clone, Debug)]
pub struct Decomposition {
    rows: usize,
    columns: usize,
    /// All singular values.
    values: Vec<f64>,
    /// The vectors of those that count.
    left: Vec<Vec<f64>>,
    right: Vec<Vec<f64>>,
}

impl Decomposition {
    /// Decomposes a column-major matrix.
    pub fn of(rows: usize, columns: usize, entries: &[f64]) -> Self {
        Decomposition::cut(rows, columns, entries, rank)
    }

    /// The same, cut at a rank that is known: what lies beyond it is treated as zero, however large.
    pub fn of_rank(rows: usize, columns: usize, entries: &[f64], rank: usize) -> Self {
        Decomposition::cut(rows, columns, entries, |values| rank.min(values.len()))
    }

    fn cut(rows: usize, columns: usize, entries: &[f64], rank: impl Fn(&[f64]) -> usize) -> Self {
        let Svd {
            mut left,
            mut values,
            mut right,
        } = Svd::of(rows, columns, entries);
        values.truncate(rows.min(columns));
        let rank = rank(&values);
        left.truncate(rank);
        right.truncate(rank);
        Decomposition {
            rows,
            columns,
            left,
            right,
            values,
        }
    }

    /// The numerical rank.
    pub fn rank(&self) -> usize {
        self.left.len()
    }

    /// Singular values, largest first.
    pub fn singular_values(&self) -> &[f64] {
        &self.values
    }

    /// Ratio of the largest to the smallest singular value that counts; 1 if none does.
    pub fn condition(&self) -> f64 {
        match self.rank() {
            0 => 1.0,
            rank => self.values[0] / self.values[rank - 1],
        }
    }

    /// A⁺b: of the vectors nearest to a solution of A x = b the shortest.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.columns];
        for ((u, v), value) in self.left.iter().zip(&self.right).zip(&self.values) {
            add(&mut x, dot(u, b) / value, v);
        }
        x
    }

    /// det(Uᵀ B V Σ⁻¹) of another matrix B of the same shape, column-major; 1 for A itself.
    pub fn determinant_beside(&self, entries: &[f64]) -> f64 {
        let rank = self.rank();
        let images = self.right.iter().map(|v| product(entries, self.rows, v));
        let images: Vec<Vec<f64>> = images.collect();
        nalgebra::DMatrix::from_fn(rank, rank, |i, j| {
            dot(&self.left[i], &images[j]) / self.values[j]
        })
        .determinant()
    }

    /// The unit vectors u and v of the smallest singular value that counts: A v = σ u.
    pub fn weakest(&self) -> Option<(&[f64], &[f64])> {
        Some((self.left.last()?, self.right.last()?))
    }

    /// The smallest singular value that counts; infinite if none does.
    pub fn smallest(&self) -> f64 {
        match self.rank() {
            0 => f64::INFINITY,
            rank => self.values[rank - 1],
        }
    }

    /// Orthonormal basis of the vectors with A x = 0.
    pub fn null_space(&self) -> Vec<Vec<f64>> {
        complement(&self.right, self.columns)
    }

    /// Orthonormal basis of the vectors with xᵀ A = 0.
    pub fn left_null_space(&self) -> Vec<Vec<f64>> {
        complement(&self.left, self.rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_rank_two_has_both_null_spaces_and_the_shortest_solution() {
        // columns (1,0,1,0), (0,1,0,1), their sum
        let a = [1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let decomposition = Decomposition::of(4, 3, &a);
        assert_eq!(decomposition.rank(), 2);
        let null = decomposition.null_space();
        assert_eq!((null.len(), decomposition.left_null_space().len()), (1, 2));
        assert!((null[0][0] - null[0][1]).abs() < 1e-14 && (null[0][0] + null[0][2]).abs() < 1e-14);
        for w in decomposition.left_null_space() {
            for column in a.chunks_exact(4) {
                assert!(dot(&w, column).abs() < 1e-14);
            }
        }
        let x = decomposition.solve(&[1.0, 2.0, 1.0, 2.0]);
        assert!(
            (x[0] - 0.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14,
            "{x:?}"
        );
        assert!((x[2] - 1.0).abs() < 1e-14);
    }
}
