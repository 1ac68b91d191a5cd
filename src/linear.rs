//! Small dense linear algebra for least-squares steps, without allocation once built.
//!
//! [`Qr`] is a rank-revealing orthogonal factorisation over slices; [`Bordered`] chains many small
//! ones and one border, the shape a closed mechanism gives its Jacobian: each leg's passive joints
//! appear in that leg's closures only, and the platforms tie the legs together.

mod bordered;
mod decomposition;
mod lu;
mod qr;

pub use bordered::{Block, Bordered};
pub use decomposition::{Decomposition, complement, dot, norm, orthonormal, remove};
pub use qr::Qr;

/// The one rank tolerance of the program: a direction counts as lost when it is this small beside
/// the largest one.
///
/// Jacobians are dimensionless (lengths are divided by the mechanism's characteristic length). At a
/// double solution a closure residual of 1e-14 leaves the joints uncertain by its square root,
/// 1e-7, and the Jacobian cannot be known better than that.
pub const RANK_TOLERANCE: f64 = 1e-7;

/// Singular values of a column-major matrix, largest first.
pub fn singular_values(rows: usize, columns: usize, entries: &[f64]) -> Vec<f64> {
    if rows == 0 || columns == 0 {
        return Vec::new();
    }
    let matrix = nalgebra::DMatrix::from_column_slice(rows, columns, entries);
    let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// How many singular values count beside the largest, and beside 1, the natural size of a
/// dimensionless Jacobian.
pub fn rank(singular_values: &[f64]) -> usize {
    let largest = singular_values.first().copied().unwrap_or(0.0);
    let threshold = RANK_TOLERANCE * largest.max(f64::MIN_POSITIVE);
    singular_values.iter().filter(|&&s| s > threshold).count()
}

/// Orthonormal basis of the directions that a column-major matrix maps to zero, one `Vec` each.
pub fn null_space(rows: usize, columns: usize, entries: &[f64]) -> Vec<Vec<f64>> {
    if columns == 0 {
        return Vec::new();
    }
    // rows of zeros make the factor V square, so that it spans the null space too
    let tall = rows.max(columns);
    let mut matrix = nalgebra::DMatrix::zeros(tall, columns);
    for (j, column) in entries.chunks_exact(rows.max(1)).take(columns).enumerate() {
        if rows > 0 {
            matrix.view_mut((0, j), (rows, 1)).copy_from_slice(column);
        }
    }
    let svd = matrix.svd(false, true);
    let largest = svd.singular_values.max();
    let v_transposed = svd.v_t.expect("V was asked for");
    (0..columns)
        .filter(|&i| svd.singular_values[i] <= RANK_TOLERANCE * largest)
        .map(|i| v_transposed.row(i).iter().copied().collect())
        .collect()
}
