//! Solutions where the Jacobian loses rank.

use nalgebra::{DMatrix, DVector};

use crate::linear::Svd;
use crate::number::tolerance::{CURVED, DIFFERENCE};

/// Equations at a point, with the slopes set apart that vanish relative to the largest.
struct SplitSlopes {
    residual: DVector<f64>,
    jacobian: DMatrix<f64>,
    svd: Svd,
    /// The range of the Jacobian and its null space, by columns.
    range: DMatrix<f64>,
    free: DMatrix<f64>,
}

impl SplitSlopes {
    /// `None` if something is not finite.
    fn of(columns: usize, lost: f64, (residual, jacobian): (Vec<f64>, Vec<f64>)) -> Option<Self> {
        if !residual.iter().chain(&jacobian).all(|x| x.is_finite()) {
            return None;
        }
        let rows = residual.len();
        let svd = Svd::of(rows, columns, &jacobian);
        let largest = svd.values.first().copied().unwrap_or(0.0);
        let counts = |value: &&f64| **value > lost * largest;
        let rank = svd.values.iter().take(rows).filter(counts).count();
        let matrix =
            |size: usize, of: &[Vec<f64>]| DMatrix::from_fn(size, of.len(), |i, j| of[j][i]);
        Some(SplitSlopes {
            range: matrix(rows, &svd.left[..rank]),
            free: matrix(columns, &svd.right[rank..]),
            residual: DVector::from_vec(residual),
            jacobian: DMatrix::from_vec(rows, columns, jacobian),
            svd,
        })
    }

    /// The part perpendicular to the range.
    fn off(&self, b: DMatrix<f64>) -> DMatrix<f64> {
        let seen = self.range.transpose() * &b;
        b - &self.range * seen
    }

    /// Derivatives of the slopes along the null vectors, in the direction of one of them, by differences.
    fn bent(
        &self,
        null: usize,
        linearised: &mut impl FnMut(&[f64]) -> (Vec<f64>, Vec<f64>),
    ) -> DMatrix<f64> {
        let mut side = |distance: f64| {
            let shift = self.free.column(null) * distance;
            let (rows, columns) = self.jacobian.shape();
            DMatrix::from_vec(rows, columns, linearised(shift.as_slice()).1)
        };
        (side(DIFFERENCE) - side(-DIFFERENCE)) * &self.free / (2.0 * DIFFERENCE)
    }
}

/// A step to a solution at which the singular values below `lost` relative to the largest vanish, by
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
    const SWEEPS: usize = 1000;
    let split = SplitSlopes::of(columns, lost, linearised(&vec![0.0; columns]))?;
    let (range, free) = (&split.range, &split.free);
    let mut step = DVector::zeros(columns);
    let seen = range.transpose() * &split.residual;
    for (i, right) in split.svd.right[..range.ncols()].iter().enumerate() {
        step -= DVector::from_column_slice(right) * (seen[i] / split.svd.values[i]);
    }
    if free.ncols() > 0 && range.ncols() < range.nrows() {
        let slope = split.off(&split.jacobian * free);
        let mut bent = DMatrix::zeros(slope.len(), free.ncols());
        for (j, mut bent) in bent.column_iter_mut().enumerate() {
            bent.copy_from_slice(split.off(split.bent(j, &mut linearised)).as_slice());
        }
        let slope = DVector::from_column_slice(slope.as_slice());
        if !bent.iter().all(|x: &f64| x.is_finite()) {
            return None;
        }
        let bent = bent.try_svd(true, true, f64::EPSILON, SWEEPS)?;
        // along a null vector of less curvature there may be a set of solutions; the nearer, the less do differences mistake
        // its shape for curvature
        let flat = (0.1 * lost).min(1e-3);
        let flat = (flat * bent.singular_values.max()).max(CURVED);
        step -= free * bent.solve(&slope, flat).ok()?;
    }
    let finite = step.iter().all(|x| x.is_finite());
    finite.then(|| step.as_slice().to_vec())
}

/// A step off a saddle of the squares of the equations to where they vanish to second order: at a point where
/// the gap g that is left is perpendicular to all slopes, along the null vector v along which gᵀ H(v, v) is
/// most negative, as rods a little longer than the line between their ends buckle. `None` at a minimum.
pub fn step_off_saddle(
    columns: usize,
    lost: f64,
    mut linearised: impl FnMut(&[f64]) -> (Vec<f64>, Vec<f64>),
) -> Option<Vec<f64>> {
    let split = SplitSlopes::of(columns, lost, linearised(&vec![0.0; columns]))?;
    let left = DMatrix::from_column_slice(split.residual.len(), 1, split.residual.as_slice());
    let gap = split.off(left).column(0).into_owned();
    let size = gap.norm();
    let mut form = DMatrix::zeros(split.free.ncols(), split.free.ncols());
    for (j, mut form) in form.column_iter_mut().enumerate() {
        form.copy_from(&(split.bent(j, &mut linearised).tr_mul(&gap) / size));
    }
    if form.is_empty() || !form.iter().all(|x: &f64| x.is_finite()) {
        return None;
    }
    let eigen = ((&form + form.transpose()) * 0.5).symmetric_eigen();
    let most = eigen.eigenvalues.imin();
    let curvature = eigen.eigenvalues[most];
    let length = (-2.0 * size / curvature).sqrt();
    let step = &split.free * eigen.eigenvectors.column(most) * length;
    (curvature < -CURVED).then(|| step.as_slice().to_vec())
}
