//! From the ends of the paths to the report.

use std::ops::Range;

use super::Wanted;
use super::bound::KnownBound;
use super::carry::Ends;
use super::coordinates::{C, Coordinates, size};
use super::local::Local;
use super::path::End;
use super::real::{complex_key, key, order, real_solution, tidied_complex};
use super::report::{AssembliesReport, ComplexAssembly, Continuum, Fit, Named};
use super::solutions::GenericSolutions;
use super::way::Way;
use crate::mechanism::{Configuration, Mechanism};
use crate::number::Number;
use crate::system::{Held, System, Work};

/// Starts from which what no path leads to is sought at every question, and where there is a reason
/// to expect it.
const STARTS: usize = 40;
const MANY_STARTS: usize = 400;
/// Samples of a set of one dimension, and how far they are apart at least.
const SAMPLES: usize = 6;
const APART: f64 = 1e-3;

/// Points that Newton's method reached from starts with these numbers.
type Starts<'a> = dyn Fn(Range<usize>) -> Vec<Configuration<f64>> + 'a;

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
pub(super) struct Found {
    pub point: Configuration<f64>,
    pub key: Vec<f64>,
    /// 0 for a sample of a set.
    pub multiplicity: usize,
    /// The dimension of the set it belongs to.
    pub dimension: usize,
}

/// A distinct finite end with the number of paths that lead there.
struct Group {
    x: Vec<C>,
    paths: usize,
    /// How many solutions meet there: as many as paths, or more where that can be seen.
    multiplicity: usize,
    singular: bool,
    /// The dimension of the set of solutions through it.
    dimension: usize,
}

/// What was gathered for a report.
#[derive(Default)]
struct Gathered {
    found: Vec<Found>,
    complex: Vec<(Vec<f64>, ComplexAssembly)>,
    /// Real solutions by themselves to which no path led.
    unexpected: usize,
    /// Multiple solutions to which no path led.
    multiple: usize,
}

impl Question<'_> {
    /// The report for the ends of all paths, and for points that Newton's method reached from
    /// starts with the given numbers. `way` stays at the asked inputs.
    pub fn answer(
        &self,
        generic: &GenericSolutions,
        fit: Fit,
        ends: &Ends,
        (mut way, starts): (Option<Way<'_>>, &Starts<'_>),
        wanted: Wanted,
    ) -> AssembliesReport {
        let mut work = self.system.work();
        let groups = self.grouped(&ends.ends, way.as_mut());
        let mut gathered = Gathered::default();
        for group in groups.iter().filter(|g| g.dimension == 0) {
            match self.real(&group.x, group.singular, &mut work) {
                Some(point) => gathered.found.push(Found {
                    key: key(&point, self.coordinates),
                    point,
                    multiplicity: group.multiplicity,
                    dimension: 0,
                }),
                None if wanted.all_complex => {
                    let x = tidied_complex(&group.x, self.coordinates);
                    let solution = self.complex(&x, group.paths);
                    gathered.complex.push((complex_key(&x), solution));
                }
                None => {}
            }
        }
        let mut report = self.empty(generic);
        let sets: Vec<&Group> = groups.iter().filter(|g| g.dimension > 0).collect();
        if let Some(way) = &mut way {
            self.look_elsewhere(&mut gathered, (&fit, generic, wanted), way, starts);
            let sampled = gathered.found.iter().any(|f| f.dimension > 0);
            if !sampled && !sets.is_empty() {
                // a set that attracts no start: from the ends themselves
                let points = sets.iter().filter_map(|g| self.beside(&g.x, way)).collect();
                self.add(&mut gathered, points, way, (&fit, false));
            }
        }
        let Gathered {
            mut found,
            mut complex,
            unexpected,
            multiple,
        } = gathered;
        // what is isolated comes first
        found.sort_by(|a, b| {
            let sample = |f: &Found| f.multiplicity == 0;
            (sample(a).cmp(&sample(b)))
                .then(b.dimension.cmp(&a.dimension))
                .then_with(|| order(&a.key, &b.key))
        });
        complex.sort_by(|a, b| order(&a.0, &b.0));
        let infinite = |e: &&End| **e == End::Infinite;
        let isolated = groups.iter().filter(|g| g.dimension == 0);
        report.complex = match fit {
            Fit::TooManyHeld | Fit::AlwaysMultiple => found.iter().map(|f| f.multiplicity).sum(),
            _ => isolated.clone().map(|g| g.paths).sum(),
        };
        report.continua = continua(&sets, &found);
        report.not_isolated = sets.iter().map(|g| g.paths).sum();
        report.unexpected = match fit {
            Fit::Finite => unexpected,
            _ => 0,
        };
        report.fit = fit;
        report.at_infinity = ends.ends.iter().filter(infinite).count();
        report.lost = ends.ends.iter().filter(|e| **e == End::Lost).count();
        report.singular = isolated.filter(|g| g.singular).count() + multiple;
        report.retried = ends.retries;
        report.paths = ends.paths;
        report.steps = ends.steps;
        report.evaluations = ends.evaluations;
        report.complex_assemblies = complex.into_iter().map(|(_, solution)| solution).collect();
        self.describe(&mut report, found, wanted.certificates, &mut work);
        if report.assemblies.is_empty() {
            let starts: Vec<&Vec<C>> = groups.iter().map(|g| &g.x).collect();
            report.closest = self.closest(&starts, &mut work);
        }
        report.complete = report.completeness();
        report
    }

    fn real(&self, x: &[C], singular: bool, work: &mut Work<f64>) -> Option<Configuration<f64>> {
        real_solution(
            x,
            singular,
            self.coordinates,
            &self.system,
            work,
            self.asked,
        )
    }

    fn is_at(&self, x: &[C], found: &Found) -> bool {
        let y = self.coordinates.flatten(&found.point.map(C::from_f64));
        self.coordinates.same(x, &y)
    }

    /// Adds what Newton's method finds at the asked inputs itself.
    fn look_elsewhere(
        &self,
        gathered: &mut Gathered,
        (fit, generic, wanted): (&Fit, &GenericSolutions, Wanted),
        way: &mut Way<'_>,
        starts: &Starts<'_>,
    ) {
        let many = matches!(fit, Fit::TooManyHeld | Fit::AlwaysMultiple) || generic.multiple > 0;
        let first = if many { MANY_STARTS } else { STARTS };
        if !(many || wanted.starts || matches!(fit, Fit::FreedomLeft(_))) {
            return;
        }
        let expected = many || *fit != Fit::Finite;
        self.add(gathered, starts(0..first), way, (fit, expected));
    }

    /// A real solution beside a complex point.
    fn beside(&self, x: &[C], way: &mut Way<'_>) -> Option<Configuration<f64>> {
        let mut start: Vec<C> = x.iter().map(|z| C::from_f64(z.re)).collect();
        self.coordinates.settle(&mut start);
        if start.iter().any(|z| !z.re.is_finite()) {
            return None;
        }
        let x = Local::new(way, true).settled(start)?;
        let mut at = self.asked.map(C::from_f64);
        self.coordinates.unflatten(&x, &mut at);
        Some(at.map(|z| z.re))
    }

    /// Adds solved points: by themselves, or as samples of a set.
    fn add(
        &self,
        gathered: &mut Gathered,
        points: Vec<Configuration<f64>>,
        way: &mut Way<'_>,
        (fit, expected): (&Fit, bool),
    ) {
        let mut work = self.system.work();
        for point in points {
            let x = self.coordinates.flatten(&point.map(C::from_f64));
            let samples: Vec<&Found> = gathered.found.iter().filter(|f| f.dimension > 0).collect();
            if *fit != Fit::Finite && samples.len() >= SAMPLES {
                break;
            }
            let apart = |f: &Found, x: &[C]| {
                let y = self.coordinates.flatten(&f.point.map(C::from_f64));
                self.coordinates.difference(x, &y)
            };
            if gathered
                .found
                .iter()
                .any(|f| f.dimension == 0 && self.is_at(&x, f))
            {
                continue;
            }
            let mut local = Local::new(way, true);
            let dimension = local.dimension(&x);
            let order_of = local.order(&x);
            let (x, multiplicity) = match (dimension, order_of) {
                (0, 1) => (x, 1),
                (0, n) => (local.refined(&x), n),
                _ => (x, 0),
            };
            let alike = samples.iter().filter(|f| f.dimension == dimension);
            let enough = dimension > 0
                && (alike.clone().count() >= SAMPLES
                    || alike.clone().any(|f| apart(f, &x) < APART));
            let known = (gathered.found.iter()).any(|f| f.dimension == 0 && self.is_at(&x, f));
            if enough || known {
                continue;
            }
            let Some(point) = self.real(&x, multiplicity != 1, &mut work) else {
                continue;
            };
            gathered.multiple += usize::from(multiplicity > 1);
            gathered.unexpected += usize::from(dimension == 0 && !expected);
            gathered.found.push(Found {
                key: key(&point, self.coordinates),
                point,
                multiplicity,
                dimension,
            });
        }
    }

    fn empty(&self, generic: &GenericSolutions) -> AssembliesReport {
        AssembliesReport {
            assemblies: Vec::new(),
            complex_assemblies: Vec::new(),
            complex: 0,
            real: 0,
            at_infinity: 0,
            singular: 0,
            not_isolated: 0,
            continua: Vec::new(),
            unexpected: 0,
            multiple: generic.multiple,
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

    /// Distinct finite ends.
    fn grouped(&self, ends: &[End], mut way: Option<&mut Way<'_>>) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for end in ends {
            let (x, singular) = match end {
                End::Regular(x) => (x, false),
                End::Singular(x) => (x, true),
                End::Infinite | End::Lost => continue,
            };
            let near = |y: &[C]| match singular {
                // an end that could not be refined has half the digits
                true => self.coordinates.difference(x, y) < 1e-5 * (1.0 + size(x)),
                false => self.coordinates.same(x, y),
            };
            match (groups.iter_mut()).find(|g| g.singular == singular && near(&g.x)) {
                Some(group) => {
                    group.paths += 1;
                    group.multiplicity = group.multiplicity.max(group.paths);
                }
                None => {
                    let (dimension, multiplicity) = match (&mut way, singular) {
                        (Some(way), true) => {
                            let mut local = Local::new(way, false);
                            (local.dimension(x), local.order(x))
                        }
                        _ => (0, 1),
                    };
                    groups.push(Group {
                        x: x.clone(),
                        paths: 1,
                        multiplicity,
                        singular,
                        dimension,
                    });
                }
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
