//! Interval certificates: a box round an assembly in which exactly one solution exists.
//!
//! Krawczyk 1969, with the test of Moore 1977: for f in a chart round the assembly y = 0, a matrix
//! C ≈ f′(0)⁻¹ and a box Y, if K(Y) = −C f(0) + (1 − C f′(Y)) Y lies inside Y, then Y holds one zero
//! of f and only one. Where closures are redundant, f is made of independent rows: the certificate
//! then says that these vanish at one point of the box, not that the others do.

use nalgebra::DMatrix;

use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::number::{Interval, Number};
use crate::solve::Equations;
use crate::system::{Held, HeldPlatform, System, Unknown, Work};

/// What the interval test came to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Certificate {
    /// Exactly one solution within this radius.
    Unique(f64),
    /// The test failed.
    Failed(&'static str),
}

/// The interval version of a question.
pub(super) struct Certifier {
    system: System<Interval>,
    work: Work<Interval>,
    rows: Vec<usize>,
    length: f64,
    scales: Vec<f64>,
}

impl Certifier {
    /// For the asked inputs and a choice of as many rows as unknowns. `None` if a dimension has no
    /// enclosure.
    pub fn new(mechanism: &Mechanism, held: &Held<f64>, rows: &[usize]) -> Option<Self> {
        let own = mechanism.independent_parameters().into_iter();
        let own: Vec<Interval> = own
            .map(|i| Interval::point(mechanism.parameters()[i].value))
            .collect();
        let mut dimensions = mechanism
            .dimensions_over(&mechanism.parameters_from(&own).ok()?)
            .ok()?;
        let real = mechanism.dimensions();
        dimensions.characteristic_length = real.characteristic_length;
        dimensions.joint_scales.clone_from(&real.joint_scales);
        let platforms = held.platforms.iter().map(|held| match held {
            HeldPlatform::Free => HeldPlatform::Free,
            HeldPlatform::Pose => HeldPlatform::Pose,
            HeldPlatform::Partly {
                coordinates,
                orientation,
            } => HeldPlatform::Partly {
                coordinates: coordinates
                    .iter()
                    .map(|(c, x)| (*c, Interval::point(*x)))
                    .collect(),
                orientation: orientation.map(|r| {
                    crate::geometry::Rotation(r.0.map(|v| Vector3(v.0.map(Interval::point))))
                }),
            },
        });
        let held = Held {
            joints: held.joints.clone(),
            platforms: platforms.collect(),
        };
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

    /// The largest radius, of those tried, in which the assembly is proved to be the only one.
    pub fn certify(&mut self, at: &Configuration<f64>, largest: f64) -> Certificate {
        let n = self.rows.len();
        if n == 0 {
            return Certificate::Unique(largest);
        }
        let centre = at.map(Interval::point);
        let zero = vec![Interval::point(0.0); n];
        let Some((residual, jacobian)) = self.evaluate(&centre, &zero) else {
            return Certificate::Failed("the closures have no enclosure here");
        };
        let middle = DMatrix::from_fn(n, n, |i, j| jacobian[j * n + i].real());
        let Some(inverse) = middle.try_inverse() else {
            return Certificate::Failed("singular: solutions meet here");
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
                let inside = (0..n).all(|i| {
                    let mut image = offset[i];
                    for j in 0..n {
                        let product = times(i, &|k| jacobian[j * n + k]);
                        let one = Interval::point(if i == j { 1.0 } else { 0.0 });
                        image += (one - product) * y;
                    }
                    image.magnitude() < radius
                });
                if inside {
                    return Certificate::Unique(radius);
                }
            }
            radius /= 4.0;
        }
        Certificate::Failed(
            "near-singular: no box is small enough to hold one solution and large enough for rounding",
        )
    }

    /// All configurations whose chart coordinates are within `y`.
    fn boxed(&self, at: &Configuration<f64>, y: Interval) -> Configuration<Interval> {
        let mut boxed = at.map(Interval::point);
        for unknown in self.system.unknowns() {
            match *unknown {
                Unknown::Joint(j) => boxed.joints[j] += y * Interval::point(self.scales[j]),
                Unknown::Twist {
                    platform,
                    component: 0,
                } => {
                    let pose = &boxed.platforms[platform];
                    let shift = y * Interval::point(self.length);
                    boxed.platforms[platform] = PlatformPose {
                        orientation: pose.orientation.turned_by(&Vector3([y; 3])),
                        position: pose.position + Vector3([shift; 3]),
                    };
                }
                Unknown::Twist { .. } => {}
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
        let dense = self.system.dense_jacobian(&mut self.work);
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
            let Unknown::Twist { component: 0, .. } = unknown else {
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

fn square(x: Interval) -> Interval {
    let x = x.abs();
    x * x
}

/// The first rows, in order, that are independent of those before: as many as there are unknowns,
/// or fewer where the Jacobian loses rank. Column-major, rows × columns.
pub(super) fn independent_rows(rows: usize, columns: usize, dense: &[f64]) -> Vec<usize> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut chosen = Vec::new();
    for r in 0..rows {
        let mut row: Vec<f64> = (0..columns).map(|j| dense[j * rows + r]).collect();
        let size = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        // twice, for the digits that one Gram–Schmidt pass loses
        for _ in 0..2 {
            for b in &basis {
                let along: f64 = b.iter().zip(&row).map(|(b, x)| b * x).sum();
                row.iter_mut().zip(b).for_each(|(x, b)| *x -= along * b);
            }
        }
        let left = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        if left > 1e-6 * size.max(1e-3) && basis.len() < columns {
            basis.push(row.iter().map(|x| x / left).collect());
            chosen.push(r);
        }
    }
    chosen
}
