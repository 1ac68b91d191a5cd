//! Small dense linear algebra for least-squares steps, without allocation once built.
//!
//! [`Qr`] is a rank-revealing orthogonal factorisation over slices; [`Bordered`] chains many small
//! ones and one border, the shape a closed mechanism gives its Jacobian: each leg's passive joints
//! appear in that leg's closures only, and the platforms tie the legs together.

#![expect(
    clippy::assign_op_pattern,
    reason = "`+=` of num_complex is a call, `+` is not"
)]

mod aligned;
mod block;
mod bordered;
mod change;
mod decomposition;
mod elimination;
mod factorable;
mod joined;
mod lu;
mod parts;
mod qr;
mod rows;
#[cfg(feature = "sparse")]
mod sparse;
mod svd;
mod vectors;

pub use crate::number::tolerance::{
    CANCELLED, CURVED, INDEPENDENT, RANK_TOLERANCE, SINGULAR_PLACE, SOLVED, SUSPECT,
};
pub use aligned::axis_aligned;
pub use block::{ColumnBlock, DenseOnly, Filled, NoFactors, SparseStep};
pub use bordered::Bordered;
pub use change::relative_change;
pub use decomposition::{Decomposition, singular_values};
pub use elimination::Elimination;
pub use factorable::Factorable;
pub use joined::{join, root};
pub use qr::Qr;
pub use rows::{RowGroup, dense};
#[cfg(feature = "sparse")]
pub use sparse::SparseNormal;
pub use svd::Svd;
pub use vectors::{add, complement, dot, norm, orthonormal, product, remove, without};
pub use vectors::{orthogonalise, rotate};

/// The most unknowns that are factorised as one dense matrix: of more, sparse factors are faster.
pub const DENSE_LIMIT: usize = 30;

/// Number of singular values (largest first) above the rank tolerance; 0 if the largest is itself rounding.
pub fn rank(singular_values: &[f64]) -> usize {
    let largest = singular_values.first().copied().unwrap_or(0.0);
    singular_values
        .iter()
        .filter(|&&s| s > lost(largest))
        .count()
}

/// True if the first `equations` rows are surely independent at the solution near a point where the Jacobian has these
/// singular values, largest first, and the equations the residual `left`: a singular value that vanishes at the
/// solution is about √`left` here (Newton–Kantorovich; rows and unknowns are scaled so that curvatures are about 1).
pub fn independent(equations: usize, singular_values: &[f64], left: f64) -> bool {
    let left = left.max(f64::EPSILON);
    let largest = singular_values.first().copied().unwrap_or(0.0);
    let sure = |least: f64| least > lost(largest) && least * least > 100.0 * left;
    equations == 0 || (singular_values.get(equations - 1)).is_some_and(|least| sure(*least))
}

/// Singular values up to this are zero: the rank tolerance times the largest one, and no less than rounding.
fn lost(largest: f64) -> f64 {
    (RANK_TOLERANCE * largest).max(CANCELLED)
}

/// The numerical rank of a column-major matrix.
pub fn rank_of(rows: usize, columns: usize, entries: &[f64]) -> usize {
    if rows == 0 || columns == 0 {
        return 0;
    }
    let matrix = nalgebra::DMatrix::from_column_slice(rows, columns, entries);
    rank(matrix.singular_values().as_slice())
}

/// The most columns whose spectrum is computed: it takes seconds for so many, and grows as the cube. Beyond it the
/// groups of rows are eliminated one after another ([`Elimination`]).
pub const SPECTRUM_LIMIT: usize = 500;

/// Numbers in (−1, 1) (Knuth's linear congruential generator).
#[cfg(test)]
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
