//! Solutions where the Jacobian loses rank.

use nalgebra::{DMatrix, DVector};

use crate::linear::Svd;

/// One step to a solution where the singular values vanish that are below `lost` beside the largest, by
/// deflation: r = 0 in the range of the Jacobian J, and P J v = 0 for its null vectors v and the projection
/// P off that range (Leykin, Verschelde and Zhao 2006). To a set of such solutions it leads straight across.
/// `None` if something is not finite.
///
/// `linearised` gives r and J, column-major, at the point displaced by a vector.
pub fn deflating_step(
    columns: usize,
    lost: f64,
    mut linearised: impl FnMut(&[f64]) -> (Vec<f64>, Vec<f64>),
) -> Option<Vec<f64>> {
    /// Distance of the differences that give curvatures.
    const APART: f64 = 1e-4;
    /// Along a null vector of no more curvature, beside the largest or in the errors of differences, there may
    /// be a set of solutions.
    const FLAT: f64 = 1e-3;
    const ROUNDED: f64 = 1e-6;
    let (residual, jacobian) = linearised(&vec![0.0; columns]);
    if !residual.iter().chain(&jacobian).all(|x| x.is_finite()) {
        return None;
    }
    let rows = residual.len();
    let svd = Svd::of(rows, columns, &jacobian);
    let largest = svd.values.first().copied().unwrap_or(0.0);
    let counts = |value: &&f64| **value > lost * largest;
    let rank = svd.values.iter().take(rows).filter(counts).count();
    let matrix = |size: usize, of: &[Vec<f64>]| DMatrix::from_fn(size, of.len(), |i, j| of[j][i]);
    let range = matrix(rows, &svd.left[..rank]);
    let free = matrix(columns, &svd.right[rank..]);
    let along = |b: DMatrix<f64>| {
        let seen = range.transpose() * &b;
        b - &range * seen
    };
    let mut step = DVector::zeros(columns);
    let seen = range.transpose() * DVector::from_vec(residual);
    for (i, right) in svd.right[..rank].iter().enumerate() {
        step -= DVector::from_column_slice(right) * (seen[i] / svd.values[i]);
    }
    if free.ncols() > 0 && rank < rows {
        let slope = along(DMatrix::from_vec(rows, columns, jacobian) * &free);
        let mut bent = DMatrix::zeros(slope.len(), free.ncols());
        for (j, mut bent) in bent.column_iter_mut().enumerate() {
            let mut side = |distance: f64| {
                let shift = free.column(j) * distance;
                DMatrix::from_vec(rows, columns, linearised(shift.as_slice()).1)
            };
            let change = along((side(APART) - side(-APART)) * &free / (2.0 * APART));
            bent.copy_from_slice(change.as_slice());
        }
        let slope = DVector::from_column_slice(slope.as_slice());
        let bent = bent.svd(true, true);
        let flat = (FLAT * bent.singular_values.max()).max(ROUNDED);
        step -= &free * bent.solve(&slope, flat).ok()?;
    }
    let finite = step.iter().all(|x| x.is_finite());
    finite.then(|| step.as_slice().to_vec())
}
