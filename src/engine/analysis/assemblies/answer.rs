//! The report from the ends of all paths.

mod certificate;
mod closest;
mod describe;
mod elsewhere;
mod paired;
mod real;

pub(super) use describe::grouped;
pub(super) use real::real_solution;

use super::Wanted;
use super::family::{C, Coordinates, KnownBound, size};
use super::report::{AssembliesReport, ByName, ComplexAssembly, Continuum, Fit, ListedJoint};
use super::search::GenericSolutions;
use super::track::{END, End, Ends, Local, ParameterHomotopy, are_one};
use crate::algebra::SiUnit;
use crate::geometry::Quaternion;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate};
use crate::number::Number;
use crate::number::tolerance::{DOUBLE, ROUNDING};
use crate::solve::Watch;
use crate::system::{Held, HeldPlatform, System, SystemWork};
use real::{complex_key, key, order, tidied, tidied_complex};

/// Points that Newton's method reached from so many starts.
pub(super) type Starts<'a> = dyn Fn(usize) -> Vec<Configuration<f64>> + 'a;

/// The question in real numbers.
pub(super) struct TargetProblem<'a> {
    pub mechanism: &'a Mechanism,
    pub coordinates: &'a Coordinates,
    /// Number of ways in which universal joints stand in each pose.
    pub flips: usize,
    pub held: &'a Held<f64>,
    pub asked: &'a Configuration<f64>,
    pub bound: Option<&'a KnownBound>,
    pub system: System<f64>,
    pub watch: &'a Watch<'a>,
    /// True if the search for generic solutions was stopped.
    pub interrupted: bool,
}

/// A real solution before it gets its number.
pub(super) struct Found {
    pub point: Configuration<f64>,
    pub key: Vec<f64>,
    /// 0 for a sample of a set.
    pub multiplicity: usize,
    /// The dimension of the set it belongs to.
    pub dimension: usize,
}

impl Found {
    fn new(
        coordinates: &Coordinates,
        point: Configuration<f64>,
        (multiplicity, dimension): (usize, usize),
    ) -> Self {
        Found {
            key: key(&point, coordinates),
            point,
            multiplicity,
            dimension,
        }
    }
}

/// A distinct finite end with the number of paths that lead there.
struct Group {
    x: Vec<C>,
    paths: usize,
    singular: bool,
    /// The dimension of the set of solutions through it.
    dimension: usize,
}

/// Solutions gathered for a report.
#[derive(Default)]
pub(super) struct Gathered {
    pub found: Vec<Found>,
    complex: Vec<(Vec<f64>, ComplexAssembly)>,
    /// Simple real solutions to which no path led.
    pub unexpected: usize,
    /// Multiple solutions to which no path led.
    pub multiple: usize,
    /// Real solutions that several ends are.
    merged: usize,
}

impl TargetProblem<'_> {
    /// The report for the ends of all paths, and for points that Newton's method reached from
    /// starts. `homotopy` stays at the target inputs.
    pub fn answer(
        &self,
        generic: &GenericSolutions,
        fit: Fit,
        ends: &Ends,
        (mut homotopy, starts): (Option<ParameterHomotopy<'_>>, &Starts<'_>),
        wanted: Wanted,
    ) -> AssembliesReport {
        let mut work = self.system.work();
        let (asked, half_a_turn_away): (Vec<&End>, Vec<&End>) =
            (ends.ends.iter()).partition(|end| end.point().is_none_or(|x| self.has_held_angles(x)));
        let mut groups = self.grouped(&asked, homotopy.as_mut());
        let conjugates = match fit == Fit::Finite && homotopy.is_some() && !self.interrupted {
            true => self.pair(&mut groups, &mut work),
            false => 0,
        };
        let mut gathered = Gathered::default();
        for group in groups.iter().filter(|g| g.dimension == 0) {
            match self.real(&group.x, group.singular, &mut work) {
                Some(point) => {
                    let found = Found::new(self.coordinates, point, (group.paths, 0));
                    gathered.found.push(found);
                }
                None if wanted.all_complex => {
                    let x = tidied_complex(&group.x, self.coordinates);
                    let condition = match (&mut homotopy, group.paths) {
                        (Some(homotopy), 1) => {
                            let (residual, jacobian) = homotopy.evaluated(END, &x);
                            describe::condition(residual.len(), homotopy.unknowns(), &jacobian)
                        }
                        _ => None,
                    };
                    let solution = self.complex(&x, (group.paths, condition));
                    gathered.complex.push((complex_key(&x), solution));
                }
                None => {}
            }
        }
        if let Some(homotopy) = &mut homotopy {
            gathered.merged = self.merge(&mut gathered.found, homotopy);
        }
        let mut report = self.empty(generic);
        report.interrupted = self.interrupted || self.watch.is_stopped();
        let sets: Vec<&Group> = groups.iter().filter(|g| g.dimension > 0).collect();
        if let Some(homotopy) = &mut homotopy {
            self.look_elsewhere(&mut gathered, (&fit, generic, wanted), homotopy, starts);
            let sampled = gathered.found.iter().any(|f| f.dimension > 0);
            if !sampled && !sets.is_empty() {
                // a set that attracts no start: from the ends themselves
                let points = sets
                    .iter()
                    .filter_map(|g| self.real_near(&g.x, homotopy))
                    .collect();
                self.add(&mut gathered, points, homotopy, (&fit, false));
            }
        }
        let nearest = match gathered.found.is_empty() && !report.interrupted {
            true => {
                let starts: Vec<&Vec<C>> = groups.iter().map(|g| &g.x).collect();
                self.nearest(&starts, &mut work)
            }
            false => None,
        };
        if let (Some((point, true)), Some(homotopy)) = (&nearest, &mut homotopy) {
            // an assembly after all, to which no path led
            self.add(&mut gathered, vec![point.clone()], homotopy, (&fit, true));
            gathered.unexpected += gathered.found.len();
        }
        let Gathered {
            mut found,
            mut complex,
            ..
        } = gathered;
        // what is isolated comes first, then samples of the largest sets
        order(&mut found, |f| &f.key);
        found.sort_by_key(|f| (f.multiplicity == 0, std::cmp::Reverse(f.dimension)));
        order(&mut complex, |solution| &solution.0);
        report.half_a_turn_away = half_a_turn_away.len();
        let isolated = groups.iter().filter(|g| g.dimension == 0);
        report.complex = match fit {
            Fit::TooManyHeld | Fit::AlwaysMultiple | Fit::Endless => {
                found.iter().map(|f| f.multiplicity).sum()
            }
            _ => isolated.clone().map(|g| g.paths).sum(),
        };
        report.continua = continua(&sets, &found);
        report.not_isolated = sets.iter().map(|g| g.paths).sum();
        report.unexpected = match fit {
            Fit::Finite => gathered.unexpected,
            _ => 0,
        };
        report.fit = fit;
        let count = |one: End| ends.ends.iter().filter(|end| **end == one).count();
        let (lost, gone) = (count(End::Lost), count(End::Gone));
        // what was added is where paths led that were lost, or far out on every way
        let beyond = conjugates.saturating_sub(lost);
        report.lost = lost.saturating_sub(conjugates);
        report.at_infinity = count(End::Infinite) + gone.saturating_sub(beyond);
        report.conjugates = beyond.saturating_sub(gone);
        report.singular =
            isolated.filter(|g| g.paths > 1).count() + gathered.merged + gathered.multiple;
        report.retried = ends.retries;
        report.paths = ends.paths;
        report.steps = ends.steps;
        report.complex_assemblies = complex.into_iter().map(|(_, solution)| solution).collect();
        self.describe(&mut report, found, wanted.certificates, &mut work);
        if let (true, Some((near, _))) = (report.assemblies.is_empty(), &nearest) {
            report.closest = self.closest(near);
        }
        report.interrupted |= self.watch.is_stopped();
        report
    }

    pub(super) fn real(
        &self,
        x: &[C],
        singular: bool,
        work: &mut SystemWork<f64>,
    ) -> Option<Configuration<f64>> {
        real_solution(
            x,
            singular,
            self.coordinates,
            &self.system,
            work,
            self.asked,
        )
    }

    /// True if each held roll, pitch or yaw has its value, false if one is half a turn from it.
    fn has_held_angles(&self, x: &[C]) -> bool {
        let joints = self.coordinates.free_joints.len();
        let poses = x[joints..].chunks_exact(7);
        (self.coordinates.free_platforms.iter().zip(poses)).all(|(&p, x)| {
            let coordinates = self.held.platforms[p].coordinates();
            let rotation = Quaternion([x[0], x[1], x[2], x[3]]).rotation();
            let along =
                |(c, value): &(PoseCoordinate, f64)| c.along(&rotation, C::from_f64(*value));
            (coordinates.iter().filter_map(along)).all(|along| along.re > ROUNDING)
        })
    }

    /// Merges real solutions that are one, as two conjugate complex ones whose real part is
    /// assembled; one is kept, with the multiplicity of all. Returns the number of the others.
    fn merge(&self, found: &mut Vec<Found>, homotopy: &mut ParameterHomotopy<'_>) -> usize {
        let mut kept: Vec<Found> = Vec::new();
        let mut points: Vec<Vec<C>> = Vec::new();
        let mut merged = 0;
        for f in found.drain(..) {
            let x = self.coordinates.flat(&f.point);
            match points.iter().position(|y| are_one(homotopy, END, y, &x)) {
                Some(place) => {
                    let one = &mut kept[place];
                    merged += usize::from(one.multiplicity == 1);
                    one.multiplicity += f.multiplicity;
                    let x = Local::new(homotopy, true).refined(&x);
                    let at = self.coordinates.placed(&x, self.asked);
                    one.point = tidied(at.map(|z| z.re), self.coordinates, false);
                    one.key = key(&one.point, self.coordinates);
                }
                None => {
                    kept.push(f);
                    points.push(x);
                }
            }
        }
        *found = kept;
        merged
    }

    fn empty(&self, generic: &GenericSolutions) -> AssembliesReport {
        let platforms = self.mechanism.platforms().iter().zip(&self.held.platforms);
        let joints = self.mechanism.joints().iter().zip(&self.held.joints);
        AssembliesReport {
            mechanism: self.mechanism.name().into(),
            variables: joints
                .enumerate()
                .map(|(j, (joint, &held))| ListedJoint {
                    name: joint.name.clone(),
                    unit: SiUnit::of_coordinate(joint.kind.is_angle()),
                    held,
                    periodic: self.mechanism.repeats(j) && joint.limits.is_none(),
                    winding: self.coordinates.winds(j),
                })
                .chain(self.mechanism.closing_joints().iter().map(|joint| {
                    let angle = joint.kind.is_angle();
                    ListedJoint {
                        name: joint.name.clone(),
                        unit: SiUnit::of_coordinate(angle),
                        held: false,
                        periodic: angle,
                        winding: false,
                    }
                }))
                .collect(),
            held_platforms: platforms
                .filter(|(_, held)| **held == HeldPlatform::Pose)
                .map(|(platform, _)| platform.name.clone())
                .collect(),
            characteristic_length: self.mechanism.characteristic_length(),
            generic: generic.count(),
            bound: self.bound.map(|b| b.count),
            bound_source: self.bound.map(|b| format!("{}: {}", b.structure, b.source)),
            flips: Some(self.flips).filter(|flips| *flips > 1),
            search: generic.search.clone(),
            ..AssembliesReport::default()
        }
    }

    /// Distinct finite ends.
    fn grouped(
        &self,
        ends: &[&End],
        mut homotopy: Option<&mut ParameterHomotopy<'_>>,
    ) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for end in ends {
            let (x, singular) = match end {
                End::Regular(x) => (x, false),
                End::Singular(x) => (x, true),
                _ => continue,
            };
            // simple solutions are distinct already; an end where solutions meet and that could not be
            // refined has half the digits
            let near = |y: &[C]| self.coordinates.within(DOUBLE * (1.0 + size(x)), x, y);
            match (groups.iter_mut()).find(|g| singular && g.singular && near(&g.x)) {
                Some(group) => group.paths += 1,
                None => {
                    let dimension = match (&mut homotopy, singular) {
                        (Some(homotopy), true) => Local::new(homotopy, false).dimension(x),
                        _ => 0,
                    };
                    groups.push(Group {
                        x: x.clone(),
                        paths: 1,
                        singular,
                        dimension,
                    });
                }
            }
        }
        groups
    }

    fn complex(&self, x: &[C], (multiplicity, condition): (usize, Option<f64>)) -> ComplexAssembly {
        let at = self.coordinates.placed(x, self.asked);
        let pair = |z: &C| [z.re, z.im];
        let joints = self.mechanism.joints().iter().map(|j| j.name.clone());
        let platforms = self.mechanism.platforms().iter().map(|p| p.name.clone());
        let poses = at.platforms.iter().map(|pose| {
            let position = self.mechanism.to_ground(pose.position);
            let parts = position.0.iter().chain(&pose.orientation.0);
            parts.map(pair).collect()
        });
        ComplexAssembly {
            joints: ByName(joints.zip(at.joints.iter().map(pair)).collect()),
            platforms: ByName(platforms.zip(poses).collect()),
            multiplicity,
            condition,
        }
    }
}

/// Sets of solutions by dimension, the largest first.
fn continua(sets: &[&Group], found: &[Found]) -> Vec<Continuum> {
    let dimensions = (sets.iter().map(|g| g.dimension)).chain(found.iter().map(|f| f.dimension));
    let mut dimensions: Vec<usize> = dimensions.filter(|d| *d > 0).collect();
    dimensions.sort_by(|a, b| b.cmp(a));
    dimensions.dedup();
    let continua = dimensions.into_iter().map(|dimension| Continuum {
        dimension,
        paths: (sets.iter().filter(|g| g.dimension == dimension))
            .map(|g| g.paths)
            .sum(),
        samples: (found.iter().enumerate())
            .filter(|(_, f)| f.dimension == dimension)
            .map(|(i, _)| i + 1)
            .collect(),
    });
    continua.collect()
}
