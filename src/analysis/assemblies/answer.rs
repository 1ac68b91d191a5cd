//! From the ends of the paths to the report.

use super::Wanted;
use super::bound::KnownBound;
use super::carry::{End, Ends};
use super::certificate::{Certificate, Certifier, independent_rows};
use super::coordinates::{C, Coordinates};
use super::real::{key, named_joints, named_poses, order, real_solution};
use super::report::{AssembliesReport, Assembly, ClosestApproach, ComplexAssembly, Fit, Named};
use super::solutions::GenericSolutions;
use crate::linear::Spectrum;
use crate::mechanism::{Configuration, Mechanism};
use crate::number::Number;
use crate::solve::{Equations, Newton};
use crate::system::{Gap, Held, System, Work};

/// The question in real numbers.
pub(super) struct Question<'a> {
    pub mechanism: &'a Mechanism,
    pub coordinates: &'a Coordinates,
    pub held: &'a Held<f64>,
    pub asked: &'a Configuration<f64>,
    pub bound: Option<&'a KnownBound>,
    pub system: System<f64>,
}

/// A real solution before it gets its number.
struct Found {
    point: Configuration<f64>,
    key: Vec<f64>,
    multiplicity: usize,
}

impl Question<'_> {
    /// The report for the ends of all paths, and for points that Newton's method reached from many
    /// starts where paths are not the whole answer.
    pub fn answer(
        &self,
        generic: &GenericSolutions,
        fit: Fit,
        ends: &Ends,
        starts: Vec<Configuration<f64>>,
        wanted: Wanted,
    ) -> AssembliesReport {
        let mut work = self.system.work();
        let grouped = self.grouped(&ends.ends);
        let mut found: Vec<Found> = Vec::new();
        let mut complex_assemblies = Vec::new();
        let real = |x: &[C], singular: bool, work: &mut Work<f64>| {
            real_solution(
                x,
                singular,
                self.coordinates,
                &self.system,
                work,
                self.asked,
            )
        };
        for (x, multiplicity, singular) in &grouped {
            match real(x, *singular, &mut work) {
                Some(point) => found.push(Found {
                    key: key(&point, self.coordinates),
                    point,
                    multiplicity: *multiplicity,
                }),
                None if wanted.all_complex => {
                    complex_assemblies.push(self.complex(x, *multiplicity));
                }
                None => {}
            }
        }
        let multiplicity = usize::from(fit == Fit::TooManyHeld);
        for point in starts {
            let x = self.coordinates.flatten(&point.map(C::from_f64));
            if let Some(point) = real(&x, false, &mut work)
                && !found.iter().any(|f| self.same(&f.point, &point))
            {
                let key = key(&point, self.coordinates);
                found.push(Found {
                    point,
                    key,
                    multiplicity,
                });
            }
        }
        // what is isolated comes first
        found.sort_by(|a, b| {
            let sample = |f: &Found| f.multiplicity == 0;
            sample(a)
                .cmp(&sample(b))
                .then_with(|| order(&a.key, &b.key))
        });
        let mut report = self.empty(generic);
        let infinite = |e: &&End| **e == End::Infinite;
        report.complex = match fit {
            Fit::TooManyHeld => found.len(),
            _ => grouped
                .iter()
                .map(|(_, multiplicity, _)| multiplicity)
                .sum(),
        };
        report.fit = fit;
        report.at_infinity = ends.ends.iter().filter(infinite).count();
        report.lost = ends.ends.iter().filter(|e| **e == End::Lost).count();
        report.singular = grouped.iter().filter(|(.., singular)| *singular).count();
        report.retried = ends.retries;
        report.paths = ends.paths;
        report.steps = ends.steps;
        report.evaluations = ends.evaluations;
        report.complex_assemblies = complex_assemblies;
        self.describe(&mut report, found, wanted.certificates, &mut work);
        if report.assemblies.is_empty() {
            let starts: Vec<&Vec<C>> = grouped.iter().map(|(x, ..)| x).collect();
            report.closest = self.closest(&starts, &mut work);
        }
        report.complete = report.completeness();
        report
    }

    fn same(&self, a: &Configuration<f64>, b: &Configuration<f64>) -> bool {
        let flat = |c: &Configuration<f64>| self.coordinates.flatten(&c.map(C::from_f64));
        self.coordinates.same(&flat(a), &flat(b))
    }

    fn empty(&self, generic: &GenericSolutions) -> AssembliesReport {
        AssembliesReport {
            assemblies: Vec::new(),
            complex_assemblies: Vec::new(),
            complex: 0,
            real: 0,
            at_infinity: 0,
            singular: 0,
            lost: 0,
            retried: 0,
            paths: 0,
            generic: generic.count(),
            bound: self.bound.map(|b| b.count),
            bound_source: self.bound.map(|b| format!("{}: {}", b.structure, b.source)),
            steps: 0,
            evaluations: 0,
            fit: Fit::Finite,
            seeds: generic.seeds,
            quiet_seeds: generic.quiet_seeds,
            loops: generic.loops,
            quiet_loops: generic.quiet_loops,
            exhausted: generic.exhausted,
            seed: generic.seed,
            complete: String::new(),
            independent_rows: None,
            closest: None,
        }
    }

    /// Distinct finite ends with their multiplicity and whether solutions meet there.
    fn grouped(&self, ends: &[End]) -> Vec<(Vec<C>, usize, bool)> {
        let mut groups: Vec<(Vec<C>, usize, bool)> = Vec::new();
        for end in ends {
            let (x, singular) = match end {
                End::Regular(x) => (x, false),
                End::Singular(x) => (x, true),
                End::Infinite | End::Lost => continue,
            };
            let near = |y: &[C]| match singular {
                // the endgame gives about half the digits
                true => self.coordinates.difference(x, y) < 1e-5,
                false => self.coordinates.same(x, y),
            };
            match groups
                .iter_mut()
                .find(|(y, _, s)| *s == singular && near(y))
            {
                Some(group) => group.1 += 1,
                None => groups.push((x.clone(), 1, singular)),
            }
        }
        groups
    }

    fn complex(&self, x: &[C], multiplicity: usize) -> ComplexAssembly {
        let mut at = self.asked.map(C::from_f64);
        self.coordinates.unflatten(x, &mut at);
        let pair = |z: &C| [z.re, z.im];
        let joints = self.mechanism.joints().iter().map(|j| j.name.clone());
        let platforms = self.mechanism.platforms().iter().map(|p| p.name.clone());
        let poses = at.platforms.iter().map(|pose| {
            let parts = pose.position.0.iter().chain(&pose.orientation.0);
            parts.map(pair).collect()
        });
        ComplexAssembly {
            joints: Named(joints.zip(at.joints.iter().map(pair)).collect()),
            platforms: Named(platforms.zip(poses).collect()),
            multiplicity,
        }
    }

    /// Numbers, conditions, determinants and certificates.
    fn describe(
        &self,
        report: &mut AssembliesReport,
        found: Vec<Found>,
        certify: bool,
        work: &mut Work<f64>,
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
        for (k, (f, dense)) in found.iter().zip(&jacobians).enumerate() {
            let values = Spectrum::of(rows, columns, dense).values;
            let (first, last) = (values.first().copied(), values.last().copied());
            let condition = match (first, last) {
                (Some(a), Some(b)) if rows >= columns && b > 1e-12 * a && f.multiplicity == 1 => {
                    Some(a / b)
                }
                (None, _) => Some(1.0),
                _ => None,
            };
            let sign = match chosen.len() == columns && f.multiplicity == 1 {
                true => determinant_sign(rows, columns, dense, &chosen),
                false => 0,
            };
            // half the way to the next assembly keeps the boxes apart
            let others = found.iter().enumerate().filter(|(i, _)| *i != k);
            let gap = others
                .map(|(_, o)| gap(self.coordinates, &f.point, &o.point))
                .fold(f64::INFINITY, f64::min);
            let certificate = match (&mut certifier, f.multiplicity) {
                (_, 0) => {
                    Certificate::Failed("one of infinitely many: others are arbitrarily near")
                }
                (_, 2..) => Certificate::Failed("singular: solutions meet here"),
                (Some(certifier), _) => certifier.certify(&f.point, (0.49 * gap).min(0.01)),
                (None, _) if certify => {
                    Certificate::Failed("singular: too few independent closure rows")
                }
                (None, _) => Certificate::Failed("not asked for"),
            };
            let joints = self.mechanism.joints().iter().zip(&f.point.joints);
            report.assemblies.push(Assembly {
                mode: k + 1,
                joints: named_joints(self.mechanism, &f.point),
                platforms: named_poses(self.mechanism, &f.point),
                condition,
                determinant_sign: sign,
                multiplicity: f.multiplicity,
                certified: matches!(certificate, Certificate::Unique(_)),
                radius: match certificate {
                    Certificate::Unique(radius) => Some(radius),
                    Certificate::Failed(_) => None,
                },
                uncertified_because: match certificate {
                    Certificate::Unique(_) => None,
                    Certificate::Failed(reason) => Some(reason.into()),
                },
                within_limits: joints
                    .into_iter()
                    .all(|(joint, value)| joint.allows(*value)),
                shares_platform_pose_with: (0..found.len())
                    .filter(|&i| i != k && shares_pose(self.coordinates, &f.key, &found[i].key))
                    .map(|i| i + 1)
                    .collect(),
            });
        }
        report.real = report.assemblies.len();
    }

    /// The smallest gaps that Newton's method from many real starts leaves.
    fn closest(&self, starts: &[&Vec<C>], work: &mut Work<f64>) -> Option<ClosestApproach> {
        let newton = Newton::default();
        let mut best: Option<(f64, Configuration<f64>)> = None;
        let lifted = starts.iter().map(|x| {
            let mut at = self.asked.map(C::from_f64);
            self.coordinates.unflatten(x, &mut at);
            let mut point = at.map(|z| z.re);
            for pose in &mut point.platforms {
                let q = pose.orientation.normalised();
                if q.0.iter().all(|x| x.is_finite()) {
                    pose.orientation = q;
                }
            }
            point
        });
        for mut point in std::iter::once(self.asked.clone()).chain(lifted) {
            let mut trial = point.clone();
            let report = newton.solve(&self.system, &mut point, &mut trial, work);
            // ties are settled by the order of starts; a clearly smaller gap wins
            if report.size.squares.is_finite()
                && best
                    .as_ref()
                    .is_none_or(|(least, _)| report.size.squares < least * (1.0 - 1e-6))
            {
                best = Some((report.size.squares, point));
            }
        }
        let (_, point) = best?;
        let gaps = Gap::of(self.mechanism, &point);
        let width = |gap: &Gap| gap.size(self.mechanism);
        let names = self.mechanism.closures().iter().map(|c| c.name.clone());
        let gaps: Vec<(String, Gap)> = names.zip(gaps).collect();
        let worst = gaps
            .iter()
            .max_by(|a, b| width(&a.1).total_cmp(&width(&b.1)))?;
        let worst = worst.0.clone();
        Some(ClosestApproach {
            gaps: Named(gaps),
            worst,
            joints: named_joints(self.mechanism, &point),
            platforms: named_poses(self.mechanism, &point),
        })
    }
}

fn gap(coordinates: &Coordinates, a: &Configuration<f64>, b: &Configuration<f64>) -> f64 {
    let flat = |c: &Configuration<f64>| coordinates.flatten(&c.map(C::from_f64));
    coordinates.difference(&flat(a), &flat(b))
}

fn shares_pose(coordinates: &Coordinates, a: &[f64], b: &[f64]) -> bool {
    let joints = coordinates.free_joints.len();
    !coordinates.free_platforms.is_empty()
        && (a[joints..].iter().zip(&b[joints..])).all(|(a, b)| (a - b).abs() < 1e-6)
}

fn determinant_sign(rows: usize, columns: usize, dense: &[f64], chosen: &[usize]) -> i8 {
    let square = nalgebra::DMatrix::from_fn(columns, columns, |i, j| dense[j * rows + chosen[i]]);
    let determinant = square.determinant();
    if determinant > 0.0 {
        1
    } else if determinant < 0.0 {
        -1
    } else {
        0
    }
}
