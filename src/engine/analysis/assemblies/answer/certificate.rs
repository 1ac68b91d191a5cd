//! Interval certificates: a box around an assembly in which exactly one solution exists.
//!
//! Krawczyk 1969, with the test of Moore 1977: for f in a chart round the assembly y = 0, a matrix
//! C ≈ f′(0)⁻¹ and a box Y, if K(Y) = −C f(0) + (1 − C f′(Y)) Y lies inside Y, then Y holds one zero
//! of f and only one. Where closures are redundant, f is made of independent rows: the certificate
//! then says that these vanish at one point of the box, not that the others do.

use nalgebra::DMatrix;

use crate::geometry::{Quaternion, Vector3};
use crate::linear::{INDEPENDENT, norm, remove};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::number::{Interval, Number};
use crate::solve::Equations;
use crate::system::{Held, System, SystemWork, Unknown, enclosed};

/// The interval version of a question.
pub(crate) struct Certifier {
    system: System<Interval>,
    work: SystemWork<Interval>,
    rows: Vec<usize>,
    length: f64,
    scales: Vec<f64>,
}

impl Certifier {
    /// For the target inputs and a choice of as many rows as unknowns. `None` if a dimension has no
    /// enclosure.
    pub fn new(mechanism: &Mechanism, held: &Held<f64>, rows: &[usize]) -> Option<Self> {
        let dimensions = enclosed(mechanism)?;
        let real = mechanism.dimensions();
        let held = held.map(Interval::point);
        let system = System::new(&dimensions, &held);
        if rows.len() != system.unknowns().len() {
            return None;
        }
        Some(Certifier {
            work: system.work(),
            system,
            rows: rows.to_vec(),
            length: real.characteristic_length,
            scales: real.joint_scales.clone(),
        })
    }

    /// Takes other rows, if they are as many.
    pub fn with_rows(&mut self, rows: &[usize]) -> &mut Self {
        if rows.len() == self.rows.len() {
            self.rows.copy_from_slice(rows);
        }
        self
    }

    /// The largest radius, of those tried, in which the assembly is proved to be the only one; why
    /// there is none.
    pub fn certify(&mut self, at: &Configuration<f64>, largest: f64) -> Result<f64, &'static str> {
        let n = self.rows.len();
        if n == 0 {
            return Ok(largest);
        }
        let centre = at.map(Interval::point);
        let zero = vec![Interval::point(0.0); n];
        let Some((residual, jacobian)) = self.evaluate(&centre, &zero) else {
            return Err("the closures have no enclosure here");
        };
        let middle = DMatrix::from_fn(n, n, |i, j| jacobian[j * n + i].real());
        let Some(inverse) = middle.try_inverse() else {
            return Err("singular: solutions meet here");
        };
        let times = |i: usize, column: &dyn Fn(usize) -> Interval| {
            (0..n).fold(Interval::point(0.0), |sum, k| {
                sum + Interval::point(inverse[(i, k)]) * column(k)
            })
        };
        let offset: Vec<Interval> = (0..n).map(|i| -times(i, &|k| residual[k])).collect();
        let away = offset.iter().map(|x| x.magnitude()).fold(0.0, f64::max);
        let mut radius = largest;
        while radius > 2.0 * away.max(1e-15) {
            let y = Interval {
                low: -radius,
                high: radius,
            };
            let boxed = self.boxed(at, y);
            if let Some((_, jacobian)) = self.evaluate(&boxed, &vec![y; n]) {
                let spread = spreads(&inverse, &jacobian);
                // y is symmetric about zero, so only the largest entries of 1 − C f′(Y) count
                let reached = |(offset, spread): (&Interval, &f64)| {
                    (offset.magnitude() + (radius * spread).next_up()).next_up()
                };
                if (offset.iter().zip(&spread))
                    .map(reached)
                    .all(|x| x < radius)
                {
                    return Ok(radius);
                }
            }
            radius /= 4.0;
        }
        Err(
            "near-singular: no box is small enough to hold one solution and large enough for rounding",
        )
    }

    /// All configurations whose chart coordinates are within `y`.
    fn boxed(&self, at: &Configuration<f64>, y: Interval) -> Configuration<Interval> {
        let mut boxed = at.map(Interval::point);
        for unknown in self.system.unknowns() {
            match *unknown {
                Unknown::Joint(j) => boxed.joints[j] += y * Interval::point(self.scales[j]),
                Unknown::Twist(platform, 0) => {
                    let pose = &boxed.platforms[platform];
                    let shift = y * Interval::point(self.length);
                    boxed.platforms[platform] = PlatformPose {
                        orientation: pose.orientation.turned_by(&Vector3([y; 3])),
                        position: pose.position + Vector3([shift; 3]),
                    };
                }
                Unknown::Twist(..) => {}
            }
        }
        boxed
    }

    /// Residuals and Jacobian of the chosen rows in the chart, the Jacobian column-major.
    ///
    /// The chart is the Cayley map of ω. Its derivative turns dω into the rotation rate
    /// (dω + ω/2 × dω)/(1 + ω·ω/4).
    fn evaluate(
        &mut self,
        at: &Configuration<Interval>,
        y: &[Interval],
    ) -> Option<(Vec<Interval>, Vec<Interval>)> {
        let mut at = at.clone();
        for platform in &mut at.platforms {
            // enclosures of the unit quaternion; f64 components are unit to rounding only
            let Quaternion(q) = platform.orientation;
            platform.orientation = Quaternion(q).normalised();
        }
        self.system.linearise(&at, &mut self.work);
        let all = self.system.rows();
        let dense = self.system.dense_jacobian(&self.work);
        let residual: Vec<Interval> = self
            .rows
            .iter()
            .map(|&r| self.system.residual_of(&self.work)[r])
            .collect();
        let n = self.rows.len();
        let mut chosen: Vec<Interval> = Vec::with_capacity(n * n);
        for j in 0..n {
            chosen.extend(self.rows.iter().map(|&r| dense[j * all + r]));
        }
        let half = Interval::point(0.5);
        for (j, unknown) in self.system.unknowns().iter().enumerate() {
            let Unknown::Twist(_, 0) = unknown else {
                continue;
            };
            let c = Vector3([0, 1, 2].map(|i| y[j + i] * half));
            if c == Vector3::zero() {
                continue;
            }
            let factor = Interval::point(1.0)
                / (Interval::point(1.0)
                    + c.0.iter().fold(Interval::point(0.0), |s, x| s + square(*x)));
            for r in 0..n {
                let row = Vector3([0, 1, 2].map(|i| chosen[(j + i) * n + r]));
                for i in 0..3 {
                    let unit: Vector3<Interval> = Vector3::unit(i);
                    let rate = (unit + c.cross(&unit)).times(factor);
                    chosen[(j + i) * n + r] = row.dot(&rate);
                }
            }
        }
        let finite = |x: &Interval| x.is_finite();
        (residual.iter().all(finite) && chosen.iter().all(finite)).then_some((residual, chosen))
    }
}

/// For each row i an upper bound of Σⱼ |δᵢⱼ − Σₖ Cᵢₖ Jₖⱼ| over all J in a matrix of intervals,
/// column-major.
///
/// With midpoints M and radii R of J it is |1 − C M| + |C| R, and n additions and products in floating
/// point err by no more than n ε of the sum of absolute values (Rump 1999; Higham 2002, §3.1: half of
/// that).
fn spreads(inverse: &DMatrix<f64>, jacobian: &[Interval]) -> Vec<f64> {
    let n = inverse.nrows();
    let error = 4.0 * (n + 2) as f64 * f64::EPSILON;
    let mut spread = vec![0.0; n];
    let (mut product, mut around, mut summed) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let columns = || inverse.as_slice().chunks_exact(n);
    for (j, jacobian) in jacobian.chunks_exact(n).enumerate() {
        for sums in [&mut product, &mut around, &mut summed] {
            sums.fill(0.0);
        }
        for (x, column) in jacobian.iter().zip(columns()) {
            let middle = 0.5 * x.low + 0.5 * x.high;
            let radius = (x.high - middle).max(middle - x.low).next_up();
            for (i, c) in column.iter().enumerate() {
                product[i] += c * middle;
                around[i] += c.abs() * radius;
                summed[i] += c.abs() * middle.abs();
            }
        }
        for (i, spread) in spread.iter_mut().enumerate() {
            let one = if i == j { 1.0 } else { 0.0 };
            let rounding = error * (summed[i] + 1.0);
            *spread += (one - product[i]).abs() + around[i] + rounding;
        }
    }
    // all terms are positive: what is lost of their sum is a part of it
    let whole = |sum: f64| sum * (1.0 + error) + f64::MIN_POSITIVE;
    spread.into_iter().map(whole).collect()
}

fn square(x: Interval) -> Interval {
    let x = x.abs();
    x * x
}

/// The first rows, in order, that are independent of those before: as many as there are unknowns,
/// or fewer where the Jacobian loses rank. Column-major, rows × columns.
pub(crate) fn independent_rows(rows: usize, columns: usize, dense: &[f64]) -> Vec<usize> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut chosen = Vec::new();
    for r in 0..rows {
        let mut row: Vec<f64> = (0..columns).map(|j| dense[j * rows + r]).collect();
        let size = norm(&row);
        // twice, for the digits that one Gram–Schmidt pass loses
        remove(&mut row, &basis);
        remove(&mut row, &basis);
        let left = norm(&row);
        if left > INDEPENDENT * size.max(1e-3) && basis.len() < columns {
            basis.push(row.iter().map(|x| x / left).collect());
            chosen.push(r);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound holds what interval arithmetic finds entry by entry, and little more.
    #[test]
    fn the_spread_of_a_product_is_bounded_as_interval_arithmetic_bounds_it() {
        let n = 6;
        let entry = |k: usize| ((k * 37 + 11) % 17) as f64 / 7.0 - 1.1;
        let middle = DMatrix::from_fn(n, n, |i, j| {
            entry(i * n + j) + if i == j { 3.0 } else { 0.0 }
        });
        let inverse = middle.clone().try_inverse().unwrap();
        for radius in [0.0, 1e-9, 1e-3] {
            let jacobian: Vec<Interval> = (middle.iter())
                .map(|x| Interval::around(*x, radius))
                .collect();
            let spread = spreads(&inverse, &jacobian);
            for i in 0..n {
                let exact: f64 = (0..n)
                    .map(|j| {
                        let one = Interval::point(if i == j { 1.0 } else { 0.0 });
                        let sum = (0..n).fold(one, |sum, k| {
                            sum - Interval::point(inverse[(i, k)]) * jacobian[j * n + k]
                        });
                        sum.magnitude()
                    })
                    .sum();
                assert!(
                    spread[i] <= exact + 1e-12,
                    "{radius}: {} {exact}",
                    spread[i]
                );
                assert!(
                    spread[i] >= exact - 1e-12,
                    "{radius}: {} {exact}",
                    spread[i]
                );
                // never less than a member of the family of matrices gives
                let corner: f64 = (0..n)
                    .map(|j| {
                        let sum: f64 = (0..n)
                            .map(|k| {
                                let end = if inverse[(i, k)] > 0.0 { 1.0 } else { -1.0 };
                                inverse[(i, k)] * (middle[(k, j)] + end * radius)
                            })
                            .sum();
                        (if i == j { 1.0 } else { 0.0 } - sum).abs()
                    })
                    .sum();
                assert!(spread[i] >= corner);
            }
        }
    }
}
