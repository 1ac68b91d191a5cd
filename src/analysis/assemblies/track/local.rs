//! Local structure where the Jacobian loses rank: a multiple solution, or a set of some dimension.
//!
//! The local dimension is that spanned by solutions which Gauss–Newton steps reach from beside a
//! neighbour of the point (at the point itself branches may meet). A null vector is not taken for a
//! motion: a multiple solution attracts what starts beside it.

use nalgebra::{DMatrix, DVector};

use super::homotopy::ParameterHomotopy;
use crate::analysis::assemblies::family::{C, size};
use crate::linear::{CANCELLED, RANK_TOLERANCE, Svd, independent};
use crate::number::{Number, real};
use crate::solve::deflating_step;

/// Singular values this small relative to the largest may be zero.
const SUSPECT: f64 = 1e-5;
/// Distance of neighbours of a point, and of their neighbours.
const BESIDE: [f64; 2] = [0.03, 2e-3];
/// A point that comes back to within this part of the distance it was moved has returned.
const BACK: f64 = 0.1;
const NEIGHBOURS: u64 = 4;
/// The end of the homotopy, where the target inputs are.
const END: f64 = 1.0;

/// The equations at the target inputs as real ones: about real points the real parts, elsewhere real
/// and imaginary parts one after the other.
pub(crate) struct Local<'a, 'f> {
    homotopy: &'a mut ParameterHomotopy<'f>,
    real: bool,
}

/// J and r at a point as real numbers, with the singular values of J.
struct RealLinear {
    residual: DVector<f64>,
    jacobian: DMatrix<f64>,
    left: DMatrix<f64>,
    values: Vec<f64>,
    right: DMatrix<f64>,
}

impl RealLinear {
    /// Number of singular values that count; none if the largest is itself rounding.
    fn rank(&self, tolerance: f64) -> usize {
        let largest = self.values.first().copied().unwrap_or(0.0);
        let threshold = (tolerance * largest).max(CANCELLED);
        self.values.iter().filter(|v| **v > threshold).count()
    }

    /// J⁺ b with `rank` singular values.
    fn solve(&self, b: &DVector<f64>, rank: usize) -> DVector<f64> {
        let mut x = DVector::zeros(self.jacobian.ncols());
        for i in 0..rank {
            x += self.right.column(i) * (self.left.column(i).dot(b) / self.values[i]);
        }
        x
    }

    /// Orthonormal basis of the null space at that rank.
    fn null_space(&self, rank: usize) -> DMatrix<f64> {
        self.right
            .columns(rank, self.right.ncols() - rank)
            .into_owned()
    }
}

/// Numbers in (−1, 1) without symmetry, the same in every run.
fn shake(stream: u64, i: usize) -> f64 {
    let phase = (1.0 + stream as f64 * 0.7548).mul_add(12.9898, (i as f64 + 1.0) * 78.233);
    let x = real::sin(phase) * 43_758.547;
    2.0 * (x - x.floor()) - 1.0
}

impl<'a, 'f> Local<'a, 'f> {
    /// About points with real coordinates only, or about any.
    pub fn new(homotopy: &'a mut ParameterHomotopy<'f>, real: bool) -> Self {
        Local { homotopy, real }
    }

    /// The dimension of the set of solutions through one where the equations are independent: as many as there are
    /// more unknowns than equations (implicit functions). `None` where they are not.
    pub fn regular(&mut self, x: &[C]) -> Option<usize> {
        let linear = self.linear(x);
        let rows = self.homotopy.varying_rows() * self.parts();
        let regular = independent(rows, &linear.values, linear.residual.amax());
        regular.then(|| (self.columns() - rows) / self.parts())
    }

    /// The dimension of the set of solutions through a solution: 0 if it is isolated.
    pub fn dimension(&mut self, x: &[C]) -> usize {
        if let Some(dimension) = self.regular(x) {
            return dimension;
        }
        let linear = self.linear(x);
        if self.freedom(&linear, SUSPECT) == 0 {
            return 0;
        }
        let mut largest = 0;
        for k in 0..NEIGHBOURS {
            let Some(beside) = self.beside(x, k, BESIDE[0]) else {
                continue;
            };
            if self.gap(x, &beside) > BACK * BESIDE[0] {
                largest = largest.max(self.spread(&beside, k));
            }
        }
        largest
    }

    /// The dimension spanned by the solutions beside a solution.
    fn spread(&mut self, x: &[C], stream: u64) -> usize {
        let linear = self.linear(x);
        let free = linear.values.len() - linear.rank(SUSPECT);
        if free == 0 {
            return 0;
        }
        let mut steps = Vec::new();
        for k in 0..free as u64 + 3 {
            let Some(beside) = self.beside(x, 16 * (stream + 1) + k, BESIDE[1]) else {
                continue;
            };
            if self.gap(x, &beside) < 10.0 * BESIDE[1] {
                steps.push(self.step_between(x, &beside) / BESIDE[1]);
            }
        }
        if steps.is_empty() {
            return 0;
        }
        let values = DMatrix::from_columns(&steps).singular_values();
        // of a curved set they span more than its tangents, which are no more than the null vectors
        let rank = values.iter().filter(|v| **v > BACK).count().min(free);
        match self.real {
            true => rank,
            false => rank.div_ceil(2),
        }
    }

    /// A multiple solution to full precision; one of a set of them is moved across the set only. `x` where
    /// that fails.
    pub fn refined(&mut self, x: &[C]) -> Vec<C> {
        const STEPS: usize = 4;
        const REACH: f64 = 1e-3;
        /// Singular values of a solution known to half its digits are this small.
        const LOST: f64 = 1e-4;
        let mut at = x.to_vec();
        for _ in 0..STEPS {
            let step = deflating_step(self.columns(), LOST, |shift| {
                let beside = self.moved(&at, &DVector::from_column_slice(shift));
                let (residual, jacobian) = self.evaluated(&beside);
                (residual.as_slice().to_vec(), jacobian.as_slice().to_vec())
            });
            let step = step.map(DVector::from_vec);
            let Some(step) = step.filter(|step| step.amax() <= REACH) else {
                return x.to_vec();
            };
            at = self.moved(&at, &step);
            if step.amax() < 1e-15 {
                break;
            }
        }
        at
    }

    /// Multiplicity of an isolated solution, at least: at corank 1 the order to which the equations
    /// vanish along the null vector, at corank k no less than 2ᵏ.
    pub fn order(&mut self, x: &[C]) -> usize {
        const STEP: f64 = 0.02;
        let linear = self.linear(x);
        let rank = linear.rank(SUSPECT);
        let free = linear.null_space(rank);
        let lost = self.freedom(&linear, SUSPECT);
        match lost {
            0 => 1,
            1 => {
                let direction = free.column(0).into_owned();
                let mut gap = |length: f64| {
                    let mut at = self.moved(x, &(&direction * length));
                    for _ in 0..30 {
                        let (residual, _) = self.evaluated(&at);
                        let step = -linear.solve(&residual, rank);
                        at = self.moved(&at, &step);
                    }
                    self.evaluated(&at).0.norm()
                };
                let order = real::log2(gap(STEP) / gap(0.5 * STEP)).round();
                match order.is_finite() && (2.0..=16.0).contains(&order) {
                    true => order as usize,
                    false => 2,
                }
            }
            k => 1 << k.min(16),
        }
    }

    /// The solution that Gauss–Newton steps reach from beside a point.
    fn beside(&mut self, x: &[C], stream: u64, distance: f64) -> Option<Vec<C>> {
        let step = DVector::from_fn(self.columns(), |i, _| distance * shake(stream, i));
        let start = self.moved(x, &step);
        self.settled(start)
    }

    /// Gauss–Newton steps of least length to a solution.
    pub fn settled(&mut self, mut at: Vec<C>) -> Option<Vec<C>> {
        const STEPS: usize = 80;
        const LONGEST: f64 = 0.1;
        /// Residual of equations that only touch zero where their singular values are lost.
        const TOLERANCE: f64 = RANK_TOLERANCE * RANK_TOLERANCE;
        let mut best: Option<(f64, Vec<C>)> = None;
        let mut stale = 0;
        for _ in 0..STEPS {
            let linear = self.linear(&at);
            // rounding beside the slopes and the size of the point
            let steepest = linear.values.first().copied().unwrap_or(0.0).max(1.0);
            let error = linear.residual.amax() / (steepest * (1.0 + size(&at)));
            if !error.is_finite() {
                return None;
            }
            if best.as_ref().is_none_or(|(least, _)| error < 0.9 * least) {
                best = Some((error, at.clone()));
                stale = 0;
            } else {
                stale += 1;
            }
            if error == 0.0 || stale > 8 || (stale > 2 && error < TOLERANCE) {
                break;
            }
            let rank = linear.rank(RANK_TOLERANCE);
            let mut step = -linear.solve(&linear.residual, rank);
            let longest = step.amax();
            if longest > LONGEST {
                step *= LONGEST / longest;
            }
            at = self.moved(&at, &step);
        }
        let (error, at) = best?;
        (error <= TOLERANCE).then_some(at)
    }

    /// Corank; complex directions count once.
    fn freedom(&self, linear: &RealLinear, tolerance: f64) -> usize {
        let lost = linear.values.len() - linear.rank(tolerance);
        match self.real {
            true => lost,
            false => lost.div_ceil(2),
        }
    }

    /// Number of real unknowns.
    fn columns(&self) -> usize {
        self.homotopy.unknowns() * self.parts()
    }

    /// Real numbers of an unknown or an equation.
    fn parts(&self) -> usize {
        if self.real { 1 } else { 2 }
    }

    fn gap(&self, x: &[C], y: &[C]) -> f64 {
        self.homotopy.family.coordinates.difference(x, y)
    }

    fn moved(&mut self, x: &[C], step: &DVector<f64>) -> Vec<C> {
        let n = self.homotopy.unknowns();
        let part = |i: usize| match self.real {
            true => C::from_f64(step[i]),
            false => C::new(step[i], step[n + i]),
        };
        let step: Vec<C> = (0..n).map(part).collect();
        self.homotopy.moved(C::from_f64(END), x, &step)
    }

    fn step_between(&mut self, x: &[C], y: &[C]) -> DVector<f64> {
        let step = self.homotopy.step_between(C::from_f64(END), x, y);
        let n = step.len();
        DVector::from_fn(self.columns(), |i, _| match i < n {
            true => step[i].re,
            false => step[i - n].im,
        })
    }

    /// Residual and Jacobian as real numbers.
    fn evaluated(&mut self, x: &[C]) -> (DVector<f64>, DMatrix<f64>) {
        let (r, j) = self.homotopy.evaluated(C::from_f64(END), x);
        let (m, n) = (r.len(), self.homotopy.unknowns());
        if self.real {
            let residual = DVector::from_fn(m, |i, _| r[i].re);
            return (residual, DMatrix::from_fn(m, n, |i, k| j[k * m + i].re));
        }
        let residual = DVector::from_fn(2 * m, |i, _| if i < m { r[i].re } else { r[i - m].im });
        let jacobian = DMatrix::from_fn(2 * m, 2 * n, |i, k| {
            let z = j[(k % n) * m + i % m];
            match (i < m, k < n) {
                (true, true) | (false, false) => z.re,
                (true, false) => -z.im,
                (false, true) => z.im,
            }
        });
        (residual, jacobian)
    }

    fn linear(&mut self, x: &[C]) -> RealLinear {
        let (residual, jacobian) = self.evaluated(x);
        let (rows, columns) = jacobian.shape();
        let finite = jacobian.iter().all(|x| x.is_finite());
        let svd = match finite {
            true => Svd::of(rows, columns, jacobian.as_slice()),
            false => Svd::of(0, columns, &[]),
        };
        let matrix = |rows: usize, of: &[Vec<f64>]| {
            DMatrix::from_fn(rows, of.len(), |i, j| of[j].get(i).copied().unwrap_or(0.0))
        };
        RealLinear {
            left: matrix(rows, &svd.left),
            values: svd.values,
            right: matrix(columns, &svd.right),
            residual: match finite {
                true => residual,
                false => DVector::from_element(rows, f64::NAN),
            },
            jacobian,
        }
    }
}
