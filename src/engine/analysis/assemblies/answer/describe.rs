//! Data of each assembly in the report: number, condition, sign of det J and certificate.

use nalgebra::{ComplexField, DMatrix};

use super::certificate::{Certifier, independent_rows};
use super::real::{named_joints, named_poses};
use super::{Found, TargetProblem};
use crate::analysis::assemblies::family::C;
use crate::analysis::assemblies::report::{AssembliesReport, Assembly};
use crate::linear::{SOLVED, rank_of};
use crate::solve::{Equations, Stage};
use crate::system::SystemWork;

impl TargetProblem<'_> {
    /// Numbers, conditions, determinants and certificates.
    pub(crate) fn describe(
        &self,
        report: &mut AssembliesReport,
        found: Vec<Found>,
        certify: bool,
        work: &mut SystemWork<f64>,
    ) {
        let (rows, columns) = (self.system.rows(), self.system.unknowns().len());
        let jacobians: Vec<Vec<f64>> = (found.iter())
            .map(|f| {
                self.system.linearise(&f.point, work);
                self.system.dense_jacobian(work)
            })
            .collect();
        // one choice of rows for all assemblies, or signs could not be compared
        let chosen = (jacobians.iter())
            .map(|dense| independent_rows(rows, columns, dense))
            .max_by(|a, b| a.len().cmp(&b.len()).then(b.cmp(a)))
            .unwrap_or_default();
        if rows > columns && chosen.len() == columns {
            report.independent_rows = Some((columns, rows));
        }
        let mut certifier = match certify && chosen.len() == columns {
            true => Certifier::new(self.mechanism, self.held, &chosen),
            false => None,
        };
        let flat = |f: &Found| self.coordinates.flat(&f.point);
        let flat: Vec<Vec<C>> = found.iter().map(flat).collect();
        let poses = self.poses(&flat);
        for (k, (f, dense)) in found.iter().zip(&jacobians).enumerate() {
            let stopped = (self.watch).stops(Stage::Certificates, k, Some(found.len()));
            let condition = match f.multiplicity == 1 || columns == 0 {
                true => condition(rows, columns, dense),
                false => None,
            };
            let sign = match chosen.len() == columns && f.multiplicity == 1 {
                true => determinant_sign(rows, columns, dense, &chosen),
                false => 0,
            };
            // half the way to the next assembly keeps the boxes apart
            let others = flat.iter().enumerate().filter(|(i, _)| *i != k);
            let gap = others
                .map(|(_, other)| self.coordinates.difference(&flat[k], other))
                .fold(f64::INFINITY, f64::min);
            let certificate = match (&mut certifier, f.multiplicity) {
                _ if stopped => Err("interrupted"),
                (_, 0) => Err("one of infinitely many: others are arbitrarily close"),
                (_, 2..) => Err(
                    "singular: solutions meet here, or are too close for double precision to separate",
                ),
                (Some(certifier), _) => {
                    let largest = (0.49 * gap).min(0.01);
                    let common = certifier.with_rows(&chosen).certify(&f.point, largest);
                    // the common rows may depend on one another here
                    let own = || independent_rows(rows, columns, dense);
                    common.or_else(|_| certifier.with_rows(&own()).certify(&f.point, largest))
                }
                (None, _) if certify => Err("singular: too few independent closure rows"),
                (None, _) => Err("not asked for"),
            };
            let joints = self.mechanism.joints().iter().zip(&f.point.joints);
            let outside_limits: Vec<String> = joints
                .filter(|(joint, value)| !joint.allows(**value))
                .map(|(joint, _)| joint.name.clone())
                .collect();
            report.assemblies.push(Assembly {
                mode: k + 1,
                joints: named_joints(self.mechanism, &f.point),
                cut: self.mechanism.cut_joints(),
                platforms: named_poses(self.mechanism, &f.point, f.multiplicity == 1),
                centre: self.mechanism.dimensions().centre,
                condition,
                determinant_sign: sign,
                multiplicity: f.multiplicity,
                dimension: f.dimension,
                certified: certificate.is_ok(),
                radius: certificate.ok(),
                uncertified_because: certificate.err().map(|reason| match gap < 1e-4 {
                    true => format!(
                        "{reason}; another assembly is {gap:.1e} away, which double precision barely separates"
                    ),
                    false => reason.into(),
                }),
                within_limits: outside_limits.is_empty(),
                outside_limits,
                shares_platform_pose_with: (poses.iter())
                    .filter(|modes| modes.contains(&(k + 1)))
                    .flat_map(|modes| modes.iter().copied().filter(|mode| *mode != k + 1))
                    .collect(),
            });
        }
        report.poses = poses;
        report.real = report.assemblies.len();
    }

    /// Numbers, from 1, of the solutions in each pose of the platforms to be found, if there are any.
    fn poses(&self, flat: &[Vec<C>]) -> Vec<Vec<usize>> {
        let coordinates = self.coordinates;
        if coordinates.free_platforms.is_empty() {
            return Vec::new();
        }
        let pose = |mode: usize| coordinates.pose_of(&flat[mode - 1]);
        grouped(flat.len(), |known, mode| {
            coordinates.same_pose(pose(known), pose(mode))
        })
    }
}

/// Numbers from 1 to `count`, each with those that are the same as the first of them.
pub(crate) fn grouped(count: usize, same: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for number in 1..=count {
        match groups.iter_mut().find(|group| same(group[0], number)) {
            Some(group) => group.push(number),
            None => groups.push(vec![number]),
        }
    }
    groups
}

/// Quotient of the largest and the smallest singular value of a column-major matrix; `None` if its
/// columns depend on one another.
pub(super) fn condition<T>(rows: usize, columns: usize, dense: &[T]) -> Option<f64>
where
    T: ComplexField<RealField = f64>,
{
    if columns == 0 || rows < columns {
        return (columns == 0).then_some(1.0);
    }
    let values = DMatrix::from_column_slice(rows, columns, dense).singular_values();
    (values.min() > SOLVED * values.max()).then(|| values.max() / values.min())
}

/// Sign of det J on the equations chosen for all assemblies; 0 where they depend on one another.
fn determinant_sign(rows: usize, columns: usize, dense: &[f64], chosen: &[usize]) -> i8 {
    let square = DMatrix::from_fn(columns, columns, |i, j| dense[j * rows + chosen[i]]);
    if rank_of(columns, columns, square.as_slice()) < columns {
        return 0;
    }
    let determinant = square.determinant();
    i8::from(determinant > 0.0) - i8::from(determinant < 0.0)
}
