//! Directions in which an infinitesimal motion is finite to second order.

use nalgebra::DMatrix;
use rand::Rng;

use super::{Neighbourhood, Tangent};
use crate::linear::{add, dot, norm, orthonormal, remove};
use crate::mechanism::Configuration;
use crate::number::tolerance::{DOUBLE, SOLVED, SUMMED, SUSPECT};

/// The quadratic tangent cone: the motions ξ = Σ vᵢ mᵢ with wₖᵀ H(ξ, ξ) = 0 for all wₖ with
/// wₖᵀ J = 0, which every finite motion starts along.
/// Source: Connelly and Whiteley, SIAM J. Discrete Math. 9, 1996; Müller, Mech. Mach. Theory 2019.
pub struct Cone {
    freedoms: usize,
    /// The mᵢ.
    basis: Vec<Vec<f64>>,
    /// For each independent form its coefficients cᵢⱼ of vᵢ vⱼ with i ≤ j, row by row.
    forms: Vec<Vec<f64>>,
}

/// A smooth set of assembled configurations through one where the equations lose rank.
pub struct FlatSet {
    /// Orthonormal basis of its motions there; none if the configuration is isolated.
    pub motions: Vec<Vec<f64>>,
    /// Configurations of it a step away.
    pub beside: Vec<Configuration<f64>>,
}

/// Length of the steps, in rad and characteristic lengths, by which branches and sets of configurations are sought.
pub const SET_STEP: f64 = 0.02;

impl Cone {
    /// The cone at a configuration.
    pub fn of(near: &mut Neighbourhood, tangent: &Tangent) -> Self {
        /// Freedoms beyond which the forms cost more than they are worth.
        const LIMIT: usize = 24;
        let motions = &tangent.motions;
        let n = motions.len();
        let mut cone = Cone {
            freedoms: n,
            basis: motions.clone(),
            forms: vec![],
        };
        // of a large Jacobian the dependencies are not known
        let is_large = near.system().is_large();
        if is_large || !(2..=LIMIT).contains(&n) {
            return cone;
        }
        let dependencies = tangent.decomposition.left_null_space();
        let mut along = |motion: &[f64]| near.second_order(tangent, &dependencies, motion);
        let squares: Vec<Vec<f64>> = motions.iter().map(|motion| along(motion)).collect();
        let mut coefficients: Vec<Vec<f64>> = vec![];
        for i in 0..n {
            coefficients.push(squares[i].clone());
            for j in i + 1..n {
                let sum: Vec<f64> = (motions[i].iter().zip(&motions[j]))
                    .map(|(a, b)| a + b)
                    .collect();
                let both = along(&sum);
                let cross = both.iter().zip(squares[i].iter().zip(&squares[j]));
                coefficients.push(cross.map(|(q, (a, b))| q - a - b).collect());
            }
        }
        let rows: Vec<Vec<f64>> = (0..dependencies.len())
            .map(|k| coefficients.iter().map(|c| c[k]).collect())
            .collect();
        // what is less is truncation of the differences
        cone.forms = orthonormal(&rows, 1e-4);
        cone
    }

    /// Number of independent forms.
    pub fn forms(&self) -> usize {
        self.forms.len()
    }

    /// True if a whole space of motions is on the cone, to the accuracy of extrapolated tangents.
    pub fn contains_all(&self, motions: &[Vec<f64>]) -> bool {
        let on_basis =
            |motion: &Vec<f64>| -> Vec<f64> { self.basis.iter().map(|b| dot(b, motion)).collect() };
        let weights: Vec<Vec<f64>> = match self.forms.is_empty() {
            true => return true,
            false => motions.iter().map(on_basis).collect(),
        };
        // forms have coefficients of unit norm, and tangents are extrapolated
        let zero = |v: &[f64]| self.linearised(v).0.iter().all(|q| q.abs() < 0.03);
        (0..weights.len()).all(|i| {
            zero(&weights[i])
                && weights[..i].iter().all(|other| {
                    let sum: Vec<f64> = weights[i].iter().zip(other).map(|(a, b)| a + b).collect();
                    zero(&sum)
                })
        })
    }

    /// A space of motions that contains the cone: where a combination of the forms vanishes that has
    /// one sign elsewhere. `None` if none is found to have.
    ///
    /// Rods that are stretched straight forbid every motion of their ends to the side, but not that the
    /// links between them turn about their line: their stress makes the form (Connelly and Whiteley
    /// 1996). The combination is sought as a perceptron does, by adding the forms' values at the
    /// motion where it is most negative (Rosenblatt 1958).
    fn flat(&self) -> Option<Vec<Vec<f64>>> {
        /// Forms have coefficients of unit norm.
        const ZERO: f64 = 1e-3;
        const STEPS: usize = 100;
        let n = self.freedoms;
        let matrix = |form: &Vec<f64>| {
            let pairs = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
            let mut matrix = DMatrix::<f64>::zeros(n, n);
            for ((i, j), c) in pairs.zip(form) {
                matrix[(i, j)] += 0.5 * c;
                matrix[(j, i)] += 0.5 * c;
            }
            matrix
        };
        let forms: Vec<DMatrix<f64>> = self.forms.iter().map(matrix).collect();
        let mut weights: Vec<f64> = forms.iter().map(DMatrix::trace).collect();
        for _ in 0..STEPS {
            let size = norm(&weights);
            let parts = forms.iter().zip(&weights);
            let sum = parts.fold(DMatrix::zeros(n, n), |sum, (form, weight)| {
                sum + form * (weight / size)
            });
            // no form, or a size of zero
            if !sum.iter().any(|x| x.abs() > ZERO) {
                return None;
            }
            let eigen = sum.symmetric_eigen();
            let least = eigen.eigenvalues.imin();
            if eigen.eigenvalues[least] > -ZERO {
                let zeros = (0..n).filter(|&i| eigen.eigenvalues[i] < ZERO);
                let motion = |i: usize| {
                    let mut motion = vec![0.0; self.basis[0].len()];
                    for (weight, basis) in eigen.eigenvectors.column(i).iter().zip(&self.basis) {
                        add(&mut motion, *weight, basis);
                    }
                    motion
                };
                return Some(zeros.map(motion).collect());
            }
            let worst: Vec<f64> = eigen.eigenvectors.column(least).iter().copied().collect();
            let (values, _) = self.linearised(&worst);
            add(&mut weights, 1.0, &values);
        }
        None
    }

    /// The smooth set through the configuration, if there is one, whose motions are all those that are not
    /// forbidden to second order, and on which the rank is as low everywhere: then no other assembled
    /// configuration is near. Where a function and its slope vanish on a set, beside which it is curved, it
    /// vanishes nowhere else nearby (the lemma of Morse and Bott).
    ///
    /// `reach` is the length of the steps by which it is tried, and then by shorter ones: the characteristic
    /// length may be many times that of the links that move.
    pub fn set(
        &self,
        near: &mut Neighbourhood,
        from: &Tangent,
        reach: f64,
        rng: &mut impl Rng,
    ) -> Option<FlatSet> {
        let flat = Tangent {
            motions: self.flat()?,
            ..from.clone()
        };
        let beside = match flat.motions.is_empty() {
            true => vec![],
            false => [1.0, 0.1]
                .into_iter()
                .find_map(|part| near.follows(&flat, part * reach, rng))?,
        };
        let as_low = |at: &Configuration<f64>| {
            let decomposition = near.tangent(at.clone()).decomposition;
            let values = decomposition.singular_values();
            let counts = values.iter().filter(|v| **v > SUSPECT * values[0]);
            counts.count() <= from.decomposition.rank()
        };
        beside.iter().all(as_low).then_some(FlatSet {
            motions: flat.motions,
            beside,
        })
    }

    /// True if second order excludes no motion.
    pub fn is_all(&self) -> bool {
        self.forms.is_empty()
    }

    /// A direction on the cone, by Gauss–Newton steps from a random one, if they converge.
    pub fn direction(&self, motions: &[Vec<f64>], rng: &mut impl Rng) -> Option<Vec<f64>> {
        const STEPS: usize = 40;
        let n = self.freedoms;
        let unit = |i: usize| (0..n).map(|j| f64::from(u8::from(i == j))).collect();
        let units: Vec<Vec<f64>> = (0..n).map(unit).collect();
        let mut v = combination(&units, rng);
        let mut left = f64::INFINITY;
        for _ in 0..STEPS {
            let (values, mut slopes) = self.linearised(&v);
            left = norm(&values);
            if left < SOLVED {
                break;
            }
            // by Euler the slope along v is twice the value: a step there would only shorten v
            for (column, &v) in slopes.chunks_exact_mut(values.len()).zip(&v) {
                let along = column.iter_mut().zip(&values);
                along.for_each(|(slope, value)| *slope -= 2.0 * value * v);
            }
            let back = shortest(values.len(), &slopes, &values)?;
            v.iter_mut().zip(&back).for_each(|(v, b)| *v -= b);
            let length = norm(&v);
            if length.is_nan() || length < 1e-3 {
                return None;
            }
            v.iter_mut().for_each(|x| *x /= length);
        }
        let sum = |i: usize| motions.iter().zip(&v).map(|(m, v)| m[i] * v).sum();
        (left < DOUBLE).then(|| (0..motions[0].len()).map(sum).collect())
    }

    /// The forms at v and their derivatives, column-major.
    fn linearised(&self, v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (rows, n) = (self.forms.len(), self.freedoms);
        let mut values = vec![0.0; rows];
        let mut slopes = vec![0.0; rows * n];
        for (k, form) in self.forms.iter().enumerate() {
            let pairs = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
            for ((i, j), c) in pairs.zip(form) {
                values[k] += c * v[i] * v[j];
                slopes[i * rows + k] += c * v[j];
                slopes[j * rows + k] += c * v[i];
            }
        }
        (values, slopes)
    }
}

/// The shortest x with S x = b for a column-major S of few rows: Sᵀ (S Sᵀ)⁻¹ b, damped so that it has a
/// value where S loses rank (Levenberg 1944). Iterated, it need not be exact.
fn shortest(rows: usize, columns: &[f64], b: &[f64]) -> Option<Vec<f64>> {
    let s = DMatrix::from_column_slice(rows, columns.len() / rows, columns);
    let mut gram = &s * s.transpose();
    let damping = SUMMED * gram.trace().max(f64::MIN_POSITIVE);
    (0..rows).for_each(|i| gram[(i, i)] += damping);
    let weights = gram
        .cholesky()?
        .solve(&nalgebra::DVector::from_column_slice(b));
    Some(s.tr_mul(&weights).iter().copied().collect())
}

impl Neighbourhood<'_> {
    /// The assembled configuration that a small step leads to, with the unit direction to it, if it converges.
    pub fn arrive(
        &mut self,
        from: &Tangent,
        direction: &[f64],
        reach: f64,
    ) -> Option<(Configuration<f64>, Vec<f64>)> {
        let start = match self.follow(from, direction, reach) {
            Some(step) => step.at,
            None => {
                let step: Vec<f64> = direction.iter().map(|x| x * reach).collect();
                self.system().displaced(&from.at, &step)
            }
        };
        let at = self.settle(start, reach)?;
        let mut way = self.system().difference(&from.at, &at);
        remove(&mut way, &from.idle);
        let distance = norm(&way);
        way.iter_mut().for_each(|x| *x /= distance);
        (0.05 * reach < distance && distance < 5.0 * reach).then_some((at, way))
    }

    /// Configurations reached by steps in random directions of the span of the motions; `None` if one does not arrive
    /// about where it aims, as where branches meet.
    pub fn follows(
        &mut self,
        at: &Tangent,
        step: f64,
        rng: &mut impl Rng,
    ) -> Option<Vec<Configuration<f64>>> {
        const TRIALS: usize = 6;
        let arrivals = (0..TRIALS).map(|_| {
            let direction = combination(&at.motions, rng);
            self.ahead(at, &direction, step)
        });
        arrivals.collect()
    }

    /// The assembled configuration that a small step leads to, if it lies about where the step aims.
    pub fn ahead(
        &mut self,
        from: &Tangent,
        direction: &[f64],
        step: f64,
    ) -> Option<Configuration<f64>> {
        let (at, way) = self.arrive(from, direction, step)?;
        (dot(&way, direction) > 0.95).then_some(at)
    }
}

/// A random unit vector in the span of orthonormal vectors.
pub fn combination(basis: &[Vec<f64>], rng: &mut impl Rng) -> Vec<f64> {
    let mut direction = vec![0.0; basis[0].len()];
    while norm(&direction) < 0.1 {
        direction.fill(0.0);
        for motion in basis {
            let weight = 2.0 * rng.random::<f64>() - 1.0;
            add(&mut direction, weight, motion);
        }
    }
    let length = norm(&direction);
    direction.iter_mut().for_each(|d| *d /= length);
    direction
}
