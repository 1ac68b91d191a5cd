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

/// Up to so many singular values rotations of pairs of columns are faster than an iteration.
const FEW: usize = 6;

/// The lengths of the columns, or of the rows if these are fewer, once they are made orthogonal, largest first.
fn lengths_when_orthogonal(rows: usize, columns: usize, entries: &[f64]) -> Vec<f64> {
    let (length, mut vectors) = match columns <= rows {
        true => (rows, entries.to_vec()),
        false => {
            let row = |i: usize| entries.iter().skip(i).step_by(rows).copied();
            (columns, (0..rows).flat_map(row).collect())
        }
    };
    orthogonalise(length, &mut vectors, |_, _, _| {});
    let mut lengths: Vec<f64> = vectors.chunks_exact(length).map(norm).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    lengths
}

/// Makes vectors of one length orthogonal by rotations of pairs (Hestenes 1958); `turned` gets each pair with cosine and
/// sine.
pub(super) fn orthogonalise(
    length: usize,
    vectors: &mut [f64],
    mut turned: impl FnMut([usize; 2], f64, f64),
) {
    const SWEEPS: usize = 40;
    for _ in 0..SWEEPS {
        let mut still = true;
        for q in 1..vectors.len() / length.max(1) {
            let (before, after) = vectors.split_at_mut(q * length);
            let second = &mut after[..length];
            for (p, first) in before.chunks_exact_mut(length).enumerate() {
                let (a, b, along) = (dot(first, first), dot(second, second), dot(first, second));
                if along.is_nan() || along.abs() <= f64::EPSILON * (a * b).sqrt() {
                    continue;
                }
                still = false;
                let zeta = (b - a) / (2.0 * along);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = cosine * tangent;
                rotate(first, second, cosine, sine);
                turned([p, q], cosine, sine);
            }
        }
        if still {
            break;
        }
    }
}

/// Rotates a pair of vectors.
pub(super) fn rotate(first: &mut [f64], second: &mut [f64], cosine: f64, sine: f64) {
    for (x, y) in first.iter_mut().zip(second) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

/// The singular values of a column-major matrix, largest first.
pub fn singular_values(rows: usize, columns: usize, entries: &[f64]) -> Vec<f64> {
    match rows.min(columns) {
        // of a single row or column its length
        1 => vec![norm(entries)],
        2..=FEW => lengths_when_orthogonal(rows, columns, entries),
        _ => Decomposition::of(rows, columns, entries).values,
    }
}

/// a·b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// √(a·a).
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// x ← x + factor·y.
pub fn add(x: &mut [f64], factor: f64, y: &[f64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x += factor * y);
}

/// A x for a column-major matrix of so many rows.
pub fn product(entries: &[f64], rows: usize, x: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; rows];
    for (column, x) in entries.chunks_exact(rows.max(1)).zip(x) {
        add(&mut product, *x, column);
    }
    product
}

/// Orthonormal basis of what the given vectors span, leaving out what is within the tolerance of
/// depending on the others.
pub fn orthonormal(vectors: &[Vec<f64>], tolerance: f64) -> Vec<Vec<f64>> {
    let mut left: Vec<Vec<f64>> = vectors.to_vec();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    while let Some(best) =
        (0..left.len()).max_by(|&i, &j| norm(&left[i]).total_cmp(&norm(&left[j])))
    {
        let mut next = left.swap_remove(best);
        let before = norm(&next);
        if before <= tolerance {
            break;
        }
        // once more, for what cancellation left of the others
        remove(&mut next, &basis);
        let length = norm(&next);
        next.iter_mut().for_each(|x| *x /= length);
        for other in &mut left {
            remove(other, std::slice::from_ref(&next));
        }
        basis.push(next);
    }
    basis
}

/// Orthonormal basis of all that is orthogonal to orthonormal vectors of `size` components.
pub fn complement(basis: &[Vec<f64>], size: usize) -> Vec<Vec<f64>> {
    let mut known: Vec<Vec<f64>> = basis.to_vec();
    let mut missing: Vec<Vec<f64>> = Vec::new();
    for _ in basis.len()..size {
        // the unit vector that the known ones explain worst
        let explained = |i: usize| known.iter().map(|v| v[i] * v[i]).sum::<f64>();
        let unexplained = |i: usize| 1.0 - explained(i);
        let worst = (0..size).max_by(|&i, &j| unexplained(i).total_cmp(&unexplained(j)));
        let best = worst.expect("size > 0");
        let mut next = vec![0.0; size];
        next[best] = 1.0;
        remove(&mut next, &known);
        remove(&mut next, &known);
        let length = norm(&next);
        next.iter_mut().for_each(|x| *x /= length);
        known.push(next.clone());
        missing.push(next);
    }
    missing
}

/// What is left of a vector without its components along orthonormal ones.
pub fn remove(vector: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis {
        let along = dot(vector, direction);
        add(vector, -along, direction);
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

    #[test]
    fn singular_values_of_a_small_matrix_are_those_of_its_decomposition_in_either_shape() {
        // a diagonal of 3, 2 and 1e-9 between two reflections I − 2 u uᵀ/u·u
        let reflected = |u: &[f64], v: &mut [f64]| {
            let factor = -2.0 * dot(u, v) / dot(u, u);
            add(v, factor, u);
        };
        let known = [3.0, 2.0, 1e-9];
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for j in 0..3 {
            let mut weights = [0.0; 3];
            weights[j] = 1.0;
            reflected(&[0.3, -0.8, 0.4], &mut weights);
            let mut column = vec![0.0; 5];
            for k in 0..3 {
                column[k] = known[k] * weights[k];
            }
            reflected(&[0.2, 0.5, -0.1, 0.7, 0.9], &mut column);
            columns.push(column);
        }
        let tall = columns.concat();
        let flat: Vec<f64> = (0..5)
            .flat_map(|i| columns.iter().map(move |c| c[i]))
            .collect();
        for (rows, width, entries) in [(5, 3, &tall), (3, 5, &flat)] {
            let found = singular_values(rows, width, entries);
            assert_eq!(found.len(), 3);
            for (found, known) in found.iter().zip(known) {
                assert!((found - known).abs() < 1e-14 * 3.0, "{found} {known}");
            }
        }
        assert_eq!(
            singular_values(2, 2, &[1.0, 1.0, 2.0, 2.0])[1].max(1e-15),
            1e-15
        );
    }
}
