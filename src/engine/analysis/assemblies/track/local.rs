//! Local structure where the Jacobian loses rank: a multiple solution, or a set of some dimension.
//!
//! The local dimension is that spanned by solutions which Gauss–Newton steps reach from beside a
//! neighbour of the point (at the point itself branches may meet). A null vector is not taken for a
//! motion: a multiple solution attracts what starts beside it.

use super::homotopy::{END, ParameterHomotopy};
use crate::analysis::assemblies::family::{C, size};
use crate::linear::{CANCELLED, RANK_TOLERANCE, Svd, add, dot, independent, norm, singular_values};
use crate::number::real;
use crate::number::tolerance::SUSPECT;
use crate::solve::deflating_step;

/// Distance of neighbours of a point, and of their neighbours.
const BESIDE: [f64; 2] = [0.03, 2e-3];
/// A point that comes back to within this part of the distance it was moved has returned.
const BACK: f64 = 0.1;
const NEIGHBOURS: u64 = 4;

/// The equations at the target inputs as real ones: about real points the real parts, elsewhere real
/// and imaginary parts one after the other.
pub(crate) struct Local<'a, 'f> {
    homotopy: &'a mut ParameterHomotopy<'f>,
    real: bool,
}

/// J and r at a point as real numbers.
struct RealLinear {
    residual: Vec<f64>,
    svd: Svd,
}

impl RealLinear {
    fn largest(&self) -> f64 {
        largest(&self.residual)
    }

    /// Number of singular values that count; none if the largest is itself rounding.
    fn rank(&self, tolerance: f64) -> usize {
        let values = &self.svd.values;
        let threshold = (tolerance * values.first().unwrap_or(&0.0)).max(CANCELLED);
        values.iter().filter(|v| **v > threshold).count()
    }

    /// −J⁺ b with `rank` singular values.
    fn step(&self, b: &[f64], rank: usize) -> Vec<f64> {
        let Svd {
            left,
            values,
            right,
        } = &self.svd;
        let mut x = vec![0.0; right.len()];
        for i in 0..rank {
            add(&mut x, -dot(&left[i], b) / values[i], &right[i]);
        }
        x
    }
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(
        0.0,
        |most, x| if x.is_nan() { *x } else { most.max(x.abs()) },
    )
}

fn scaled(x: &[f64], factor: f64) -> Vec<f64> {
    x.iter().map(|x| x * factor).collect()
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
        let regular = independent(rows, &linear.svd.values, linear.largest());
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
            let Some(beside) = self.settled_beside(x, k, BESIDE[0]) else {
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
        let free = linear.svd.values.len() - linear.rank(SUSPECT);
        if free == 0 {
            return 0;
        }
        let mut steps = Vec::new();
        for k in 0..free as u64 + 3 {
            let Some(beside) = self.settled_beside(x, 16 * (stream + 1) + k, BESIDE[1]) else {
                continue;
            };
            if self.gap(x, &beside) < 10.0 * BESIDE[1] {
                steps.extend(scaled(&self.step_between(x, &beside), 1.0 / BESIDE[1]));
            }
        }
        if steps.is_empty() {
            return 0;
        }
        let columns = self.columns();
        let values = singular_values(columns, steps.len() / columns, &steps);
        // of a curved set they span more than its tangents, which are no more than the null vectors
        let rank = values.iter().filter(|v| **v > BACK).count().min(free);
        rank.div_ceil(self.parts())
    }

    /// A multiple solution to full precision; one of a set of them is moved across the set only. `x` where
    /// that fails.
    pub fn refined(&mut self, x: &[C]) -> Vec<C> {
        const STEPS: usize = 4;
        let mut at = x.to_vec();
        for _ in 0..STEPS {
            // singular values of a solution known to half its digits are so small
            let step = deflating_step(self.columns(), 1e-4, |shift| {
                let beside = self.moved(&at, shift);
                self.evaluated(&beside)
            });
            // a longer one leads to another solution
            let Some(step) = step.filter(|step| largest(step) <= 1e-3) else {
                return x.to_vec();
            };
            at = self.moved(&at, &step);
            if largest(&step) < 1e-15 {
                break;
            }
        }
        at
    }

    /// Multiplicity of an isolated solution, at least: at corank 1 the order to which the equations
    /// vanish along the null vector, at corank k no less than 2ᵏ.
    pub fn order(&mut self, x: &[C]) -> usize {
        let linear = self.linear(x);
        let rank = linear.rank(SUSPECT);
        match self.freedom(&linear, SUSPECT) {
            0 => 1,
            1 => {
                let mut gap = |length: f64| {
                    let mut at = self.moved(x, &scaled(&linear.svd.right[rank], length));
                    for _ in 0..30 {
                        let (residual, _) = self.evaluated(&at);
                        at = self.moved(&at, &linear.step(&residual, rank));
                    }
                    norm(&self.evaluated(&at).0)
                };
                let order = real::log2(gap(0.02) / gap(0.01)).round();
                match order.is_finite() && (2.0..=16.0).contains(&order) {
                    true => order as usize,
                    false => 2,
                }
            }
            k => 1 << k.min(16),
        }
    }

    /// The solution that Gauss–Newton steps reach from beside a point.
    fn settled_beside(&mut self, x: &[C], stream: u64, distance: f64) -> Option<Vec<C>> {
        let step = (0..self.columns()).map(|i| distance * shake(stream, i));
        let start = self.moved(x, &step.collect::<Vec<f64>>());
        self.settled(start)
    }

    /// Gauss–Newton steps of least length to a solution.
    pub fn settled(&mut self, mut at: Vec<C>) -> Option<Vec<C>> {
        const STEPS: usize = 80;
        // the residual of equations that only touch zero where their singular values are lost
        let tolerance = RANK_TOLERANCE * RANK_TOLERANCE;
        let mut best: Option<(f64, Vec<C>)> = None;
        let mut stale = 0;
        for _ in 0..STEPS {
            let linear = self.linear(&at);
            // rounding beside the slopes and the size of the point
            let steepest = linear.svd.values.first().copied().unwrap_or(0.0).max(1.0);
            let error = linear.largest() / (steepest * (1.0 + size(&at)));
            if !error.is_finite() {
                return None;
            }
            if best.as_ref().is_none_or(|(least, _)| error < 0.9 * least) {
                best = Some((error, at.clone()));
                stale = 0;
            } else {
                stale += 1;
            }
            if error == 0.0 || stale > 8 || (stale > 2 && error < tolerance) {
                break;
            }
            let rank = linear.rank(RANK_TOLERANCE);
            let step = linear.step(&linear.residual, rank);
            let shorter = (0.1 / largest(&step)).min(1.0);
            at = self.moved(&at, &scaled(&step, shorter));
        }
        let (error, at) = best?;
        (error <= tolerance).then_some(at)
    }

    /// Corank; complex directions count once.
    fn freedom(&self, linear: &RealLinear, tolerance: f64) -> usize {
        (linear.svd.values.len() - linear.rank(tolerance)).div_ceil(self.parts())
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

    fn moved(&mut self, x: &[C], step: &[f64]) -> Vec<C> {
        let n = self.homotopy.unknowns();
        let part = |i: usize| C::new(step[i], if self.real { 0.0 } else { step[n + i] });
        let step: Vec<C> = (0..n).map(part).collect();
        self.homotopy.moved(END, x, &step)
    }

    fn step_between(&mut self, x: &[C], y: &[C]) -> Vec<f64> {
        let step = self.homotopy.step_between(END, x, y);
        self.as_real(&step)
    }

    /// Real parts, and imaginary ones after them.
    fn as_real(&self, x: &[C]) -> Vec<f64> {
        let imaginary = x.iter().take(if self.real { 0 } else { x.len() });
        let real = x.iter().map(|z| z.re);
        real.chain(imaginary.map(|z| z.im)).collect()
    }

    /// Residual and Jacobian as real numbers, column-major.
    fn evaluated(&mut self, x: &[C]) -> (Vec<f64>, Vec<f64>) {
        let (r, j) = self.homotopy.evaluated(END, x);
        let columns = |turned: C| j.chunks_exact(r.len().max(1)).map(move |of| (of, turned));
        // columns of imaginary unknowns are those of real ones times i
        let sides = [C::new(1.0, 0.0), C::new(0.0, 1.0)].into_iter();
        let all = sides.take(self.parts()).flat_map(columns);
        let all = all.flat_map(|(column, turned)| {
            self.as_real(&column.iter().map(|z| z * turned).collect::<Vec<C>>())
        });
        let jacobian = all.collect();
        (self.as_real(&r), jacobian)
    }

    fn linear(&mut self, x: &[C]) -> RealLinear {
        let (mut residual, jacobian) = self.evaluated(x);
        let mut rows = residual.len();
        if jacobian.iter().any(|x| !x.is_finite()) {
            residual.fill(f64::NAN);
            rows = 0;
        }
        let entries = if rows == 0 { &[] } else { &jacobian[..] };
        let svd = Svd::of(rows, self.columns(), entries);
        RealLinear { residual, svd }
    }
}
