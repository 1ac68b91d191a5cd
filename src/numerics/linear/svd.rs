use nalgebra::DMatrix;

use super::parts::Parts;
use super::vectors::{orthogonalise, rotate};
use super::{DENSE_LIMIT, rank};
use crate::number::sorting::order;
use crate::number::tolerance::CANCELLED;

/// A = U·Σ·Vᵀ.
#[derive(Clone, Debug, Default)]
pub struct Svd {
    /// The columns of U, as long as A has rows. Those of singular values zero may be zero.
    pub left: Vec<Vec<f64>>,
    /// The singular values, largest first, one for each column of A.
    pub values: Vec<f64>,
    /// The columns of V, all of them: an orthonormal basis.
    pub right: Vec<Vec<f64>>,
}

impl Svd {
    /// The decomposition of a column-major matrix, with V square also where there are fewer rows than columns.
    ///
    /// The QR iteration of nalgebra 0.35 is wrong by up to a percent for one matrix in some hundreds. A result whose
    /// product is not A to rounding is replaced by slower rotations of pairs of columns (Hestenes 1958).
    ///
    /// Of many columns those that share no row with others are decomposed apart: what is independent costs the sum.
    pub fn of(rows: usize, columns: usize, entries: &[f64]) -> Self {
        match columns > DENSE_LIMIT {
            true => Svd::of_parts(rows, columns, entries),
            false => Svd::of_whole(rows, columns, entries),
        }
    }

    fn of_parts(rows: usize, columns: usize, entries: &[f64]) -> Self {
        // what rounding leaves where nothing is would join parts that share nothing
        let largest = entries.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let nothing = |x: &f64| x.abs() <= f64::EPSILON * largest;
        let entries = entries.iter().map(|x| if nothing(x) { 0.0 } else { *x });
        let entries = &entries.collect::<Vec<f64>>();
        let column = |j: usize| &entries[j * rows..(j + 1) * rows];
        let parts = Parts::new(rows, (0..columns).map(column));
        let mut of: Vec<Vec<usize>> = vec![Vec::new(); parts.members().len()];
        let mut all: Vec<(f64, Vec<f64>, Vec<f64>)> = Vec::new();
        let mut own: Vec<Vec<f64>> = vec![Vec::new(); of.len()];
        for j in 0..columns {
            match parts.within(column(j)) {
                Some((part, column)) => {
                    of[part].push(j);
                    own[part].extend(column);
                }
                None => {
                    let mut alone = vec![0.0; columns];
                    alone[j] = 1.0;
                    all.push((0.0, vec![0.0; rows], alone));
                }
            }
        }
        for (part, (of, own)) in of.iter().zip(&own).enumerate() {
            let Svd {
                left,
                values,
                right,
            } = Svd::of_whole(parts.members()[part].len(), of.len(), own);
            for ((left, value), right) in left.iter().zip(values).zip(right) {
                let mut whole = vec![0.0; columns];
                of.iter().zip(right).for_each(|(&j, x)| whole[j] = x);
                all.push((value, parts.whole(part, left), whole));
            }
        }
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut svd = Svd::default();
        for (value, left, right) in all {
            svd.values.push(value);
            svd.left.push(left);
            svd.right.push(right);
        }
        svd
    }

    fn of_whole(rows: usize, columns: usize, entries: &[f64]) -> Self {
        let mut matrix = DMatrix::zeros(rows.max(columns), columns);
        if rows > 0 && columns > 0 {
            let given = DMatrix::from_column_slice(rows, columns, entries);
            matrix.rows_mut(0, rows).copy_from(&given);
        }
        let mut svd = Svd::by_iteration(&matrix).unwrap_or_else(|| Svd::by_rotations(&matrix));
        svd.left.iter_mut().for_each(|column| column.truncate(rows));
        svd
    }

    /// An orthonormal basis of the directions that the matrix maps to zero.
    pub fn null_space(&self) -> &[Vec<f64>] {
        &self.right[rank(&self.values)..]
    }

    /// `None` if the result is not the matrix to rounding.
    fn by_iteration(matrix: &DMatrix<f64>) -> Option<Self> {
        if matrix.is_empty() || matrix.iter().any(|x| !x.is_finite()) {
            return None;
        }
        // of a tall matrix the triangle, which has the same values and right vectors
        let (svd, u) = match 4 * matrix.nrows() > 5 * matrix.ncols() {
            true => {
                let (q, r) = matrix.clone().qr().unpack();
                let svd = r.svd(true, true);
                let u = q * svd.u.as_ref()?;
                (svd, u)
            }
            false => {
                let mut svd = matrix.clone().svd(true, true);
                let u = svd.u.take()?;
                (svd, u)
            }
        };
        let (u, v) = (&u, svd.v_t.as_ref()?);
        let mut scaled = v.clone();
        for (mut row, value) in scaled.row_iter_mut().zip(&svd.singular_values) {
            row *= *value;
        }
        let size = matrix.norm();
        let apart = (u * scaled - matrix).norm();
        let askew = (v * v.transpose() - DMatrix::identity(v.nrows(), v.nrows())).norm();
        let rounding = CANCELLED * (1.0 + matrix.ncols() as f64);
        (apart <= rounding * size && askew <= rounding).then(|| Svd {
            left: u
                .column_iter()
                .map(|c| c.iter().copied().collect())
                .collect(),
            values: svd.singular_values.iter().copied().collect(),
            right: v.row_iter().map(|r| r.iter().copied().collect()).collect(),
        })
    }

    fn by_rotations(matrix: &DMatrix<f64>) -> Self {
        let columns = matrix.ncols();
        let (mut u, mut v) = (matrix.clone(), DMatrix::<f64>::identity(columns, columns));
        orthogonalise(matrix.nrows(), u.as_mut_slice(), |[p, q], cosine, sine| {
            let (before, after) = v.as_mut_slice().split_at_mut(q * columns);
            rotate(
                &mut before[p * columns..][..columns],
                &mut after[..columns],
                cosine,
                sine,
            );
        });
        let sizes: Vec<f64> = u.column_iter().map(|column| column.norm()).collect();
        let order = order(columns, &|i, j| sizes[j].total_cmp(&sizes[i]));
        let unit = |i: usize| 1.0 / sizes[i].max(f64::MIN_POSITIVE);
        let column = |matrix: &DMatrix<f64>, i: usize, factor: f64| -> Vec<f64> {
            matrix.column(i).iter().map(|x| x * factor).collect()
        };
        Svd {
            left: order.iter().map(|&i| column(&u, i, unit(i))).collect(),
            values: order.iter().map(|&i| sizes[i]).collect(),
            right: order.iter().map(|&i| column(&v, i, 1.0)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::numbers;

    /// The shape of six legs with universal joints: two columns of each leg's own, six of a platform.
    fn legs(next: &mut impl FnMut() -> f64) -> Vec<f64> {
        let mut entries = vec![0.0; 18 * 18];
        for leg in 0..6 {
            let mut vector = || nalgebra::Vector3::new(next(), next(), next());
            let (a, b, arm) = (vector().normalize(), vector(), vector());
            let own = [a, a.cross(&b).normalize()];
            for i in 0..3 {
                let row = 3 * leg + i;
                let unit = nalgebra::Vector3::ith(i, 1.0);
                for (k, own) in own.iter().enumerate() {
                    entries[(2 * leg + k) * 18 + row] = own[i];
                }
                for k in 0..3 {
                    entries[(12 + k) * 18 + row] = arm.cross(&unit)[k];
                }
                entries[(15 + i) * 18 + row] = -1.0;
            }
        }
        entries
    }

    fn error(entries: &[f64], svd: &Svd, rows: usize) -> f64 {
        let columns = svd.values.len();
        let product = |i: usize, j: usize| -> f64 {
            let terms = (0..columns).map(|k| svd.left[k][i] * svd.values[k] * svd.right[k][j]);
            terms.sum()
        };
        let all = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let gaps = all.map(|(i, j)| (product(i, j) - entries[j * rows + i]).abs());
        gaps.fold(0.0, f64::max)
    }

    #[test]
    fn every_matrix_is_the_product_of_its_factors() {
        let mut next = numbers(12345);
        let mut rejected = 0;
        for _ in 0..1500 {
            let entries = legs(&mut next);
            let svd = Svd::of(18, 18, &entries);
            assert!(error(&entries, &svd, 18) < 1e-12);
            assert!(svd.values.is_sorted_by(|a, b| a >= b));
            let matrix = DMatrix::from_column_slice(18, 18, &entries);
            rejected += usize::from(Svd::by_iteration(&matrix).is_none());
        }
        // there is a reason for the check as long as this holds
        assert!(rejected > 0);
    }

    #[test]
    fn rotations_give_what_the_iteration_gives() {
        let mut next = numbers(12345);
        for (rows, columns) in [(5, 3), (3, 5), (4, 4), (1, 1), (7, 1)] {
            let entries: Vec<f64> = (0..rows * columns).map(|_| next()).collect();
            let mut matrix = DMatrix::zeros(rows.max(columns), columns);
            let given = DMatrix::from_column_slice(rows, columns, &entries);
            matrix.rows_mut(0, rows).copy_from(&given);
            let (a, b) = (Svd::of(rows, columns, &entries), Svd::by_rotations(&matrix));
            for (a, b) in a.values.iter().zip(&b.values) {
                assert!((a - b).abs() < 1e-14, "{a} {b}");
            }
            assert!(error(&entries, &b, rows) < 1e-14);
            assert!(error(&entries, &a, rows) < 1e-14);
        }
    }

    #[test]
    fn parts_have_the_singular_values_and_vectors_of_the_whole() {
        let mut next = numbers(12345);
        let (rows, columns, blocks) = (47, 39, 6);
        // rows and columns of each block are spread over the matrix; one row and two columns are zero
        let mut entries = vec![0.0; rows * columns];
        for j in 0..columns {
            for i in (0..rows).filter(|i| i % (blocks + 1) == j % (blocks + 1) && j % 20 != 6) {
                entries[j * rows + i] = if i == 46 { 0.0 } else { next() };
            }
        }
        let (parts, whole) = (
            Svd::of(rows, columns, &entries),
            Svd::of_whole(rows, columns, &entries),
        );
        for (a, b) in parts.values.iter().zip(&whole.values) {
            assert!((a - b).abs() < 1e-13, "{a} {b}");
        }
        assert!(error(&entries, &parts, rows) < 1e-13);
        assert_eq!(parts.null_space().len(), whole.null_space().len());
        for (i, a) in parts.right.iter().enumerate() {
            for (j, b) in parts.right.iter().enumerate() {
                let expected = f64::from(u8::from(i == j));
                assert!(
                    (super::super::dot(a, b) - expected).abs() < 1e-13,
                    "{i} {j}"
                );
            }
        }
    }

    #[test]
    fn a_matrix_with_no_number_in_it_ends() {
        let svd = Svd::of(2, 2, &[1.0, f64::NAN, 0.0, 1.0]);
        assert_eq!(svd.values.len(), 2);
        assert_eq!(Svd::of(0, 2, &[]).values, [0.0, 0.0]);
    }
}
