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
use crate::solve::{Conditions, Equations, holds_one};
use crate::system::{Held, System, Unknown, Work, enclosed};

/// The interval version of a question.
pub(crate) struct Certifier {
    system: System<Interval>,
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
        (rows.len() == system.unknowns().len()).then(|| Certifier {
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
    pub fn certify(&self, at: &Configuration<f64>, largest: f64) -> Result<f64, &'static str> {
        const SMALLEST: f64 = 1e-15;
        let n = self.rows.len();
        let mut chart = Chart {
            of: self,
            at,
            inverse: DMatrix::identity(n, n),
        };
        let mut work = chart.work();
        chart.evaluate(&vec![Interval::point(0.0); n], true, &mut work);
        let middle = DMatrix::from_iterator(n, n, work.slopes.iter().map(|x| x.real()));
        let inverse = middle.try_inverse();
        chart.inverse = inverse.ok_or("singular: solutions meet here")?;
        let radii = std::iter::successors(Some(largest), |radius| Some(radius / 4.0));
        let mut radii = radii.take_while(|radius| *radius > SMALLEST);
        let sides = |radius| vec![Interval::around(0.0, radius); n];
        let proved = radii.find(|&radius| holds_one(&chart, &sides(radius), &mut work));
        proved.ok_or(
            "near-singular: no box is small enough to hold one solution and large enough for rounding",
        )
    }
}

/// The chosen rows, multiplied by a matrix, in a chart about an assembly: the Cayley map of ω. Its derivative turns dω into the
/// rotation rate (dω + ω/2 × dω)/(1 + ω·ω/4).
struct Chart<'a> {
    of: &'a Certifier,
    at: &'a Configuration<f64>,
    inverse: DMatrix<f64>,
}

#[derive(Clone)]
struct ChartWork {
    work: Work<Interval>,
    values: Vec<Interval>,
    /// Column-major.
    slopes: Vec<Interval>,
}

impl Chart<'_> {
    /// The configurations with coordinates in a box.
    fn boxed(&self, y: &[Interval]) -> Configuration<Interval> {
        let mut boxed = self.at.map(Interval::point);
        for (unknown, side) in self.of.system.unknowns().iter().zip(0..) {
            match *unknown {
                Unknown::Joint(j) => {
                    boxed.joints[j] += y[side] * Interval::point(self.of.scales[j]);
                }
                Unknown::Twist(platform, 0) => {
                    let part = |i: usize| Vector3([0, 1, 2].map(|k| y[side + i + k]));
                    let pose = &mut boxed.platforms[platform];
                    let Quaternion(q) = pose.orientation.turned_by(&part(0));
                    *pose = PlatformPose {
                        // enclosures of the unit quaternion; f64 components are unit to rounding only
                        orientation: Quaternion(q).normalised(),
                        position: pose.position + part(3).times(Interval::point(self.of.length)),
                    };
                }
                Unknown::Twist(..) => {}
            }
        }
        boxed
    }

    fn times(&self, column: &[Interval]) -> impl Iterator<Item = Interval> {
        let row = |i: usize| {
            let parts = column.iter().enumerate();
            parts.fold(Interval::point(0.0), |sum, (k, x)| {
                sum + Interval::point(self.inverse[(i, k)]) * *x
            })
        };
        (0..column.len()).map(row)
    }
}

impl Conditions for Chart<'_> {
    type Work = ChartWork;

    fn work(&self) -> ChartWork {
        ChartWork {
            work: self.of.system.work(),
            values: Vec::new(),
            slopes: Vec::new(),
        }
    }

    fn evaluate(&self, y: &[Interval], _slopes: bool, work: &mut ChartWork) {
        let Certifier { system, rows, .. } = self.of;
        system.linearise(&self.boxed(y), &mut work.work);
        let (n, all) = (rows.len(), system.rows());
        let residual = system.residual_of(&work.work);
        let residual: Vec<Interval> = rows.iter().map(|&r| residual[r]).collect();
        let dense = system.dense_jacobian(&work.work);
        let chosen = (0..n).flat_map(|j| rows.iter().map(move |&r| j * all + r));
        let mut chosen: Vec<Interval> = chosen.map(|place| dense[place]).collect();
        let (half, one) = (Interval::point(0.5), Interval::point(1.0));
        let square = |x: &Interval| x.abs() * x.abs();
        for (j, unknown) in system.unknowns().iter().enumerate() {
            let Unknown::Twist(_, 0) = unknown else {
                continue;
            };
            let c = Vector3([0, 1, 2].map(|i| y[j + i] * half));
            if c == Vector3::zero() {
                continue;
            }
            let factor = one
                / (one
                    + c.0
                        .iter()
                        .map(square)
                        .fold(Interval::point(0.0), |s, x| s + x));
            for r in 0..n {
                let row = Vector3([0, 1, 2].map(|i| chosen[(j + i) * n + r]));
                for i in 0..3 {
                    let unit: Vector3<Interval> = Vector3::unit(i);
                    let rate = (unit + c.cross(&unit)).times(factor);
                    chosen[(j + i) * n + r] = row.dot(&rate);
                }
            }
        }
        work.values = self.times(&residual).collect();
        let columns = chosen.chunks_exact(n.max(1));
        work.slopes = columns.flat_map(|column| self.times(column)).collect();
    }

    fn possible(&self, work: &ChartWork) -> bool {
        work.values.iter().all(|x| x.is_finite())
    }

    fn values<'a>(&self, work: &'a ChartWork) -> &'a [Interval] {
        &work.values
    }

    fn slopes<'a>(&self, work: &'a ChartWork) -> &'a [Interval] {
        &work.slopes
    }
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
