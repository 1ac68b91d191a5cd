//! Random starts of the search for loci, and the places they lead to.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::SingularitiesSettings;
use super::classify::{Classifier, Kind};
use crate::mechanism::{Configuration, turn_near};
use crate::solve::{CurvePoint, Newton, Progress, SolutionCurve, Stage};
use crate::system::{
    Coordinate, Lock, LocusCurve, LocusEnd, Region, Singular, System, Traced, met_at, neared,
    random_configuration, with_coordinates,
};

/// Factor by which more starts than those of the settings are made at most, while more curves are likely.
const MORE: usize = 10;

pub(super) struct LocusSearch<'m> {
    pub region: Region<'m>,
    pub start: Configuration<f64>,
    pub inputs: Vec<Coordinate>,
    pub settings: &'m SingularitiesSettings,
    /// Local freedoms: spins of links about their own lines.
    pub spins: usize,
    pub classifier: Classifier<'m>,
}

/// Curves found from starts.
pub(super) struct FoundCurves {
    pub kind: Kind,
    pub curve: LocusCurve,
    /// Curves, and isolated points as curves of one place, each with how many random starts met it.
    pub known: Vec<(Traced<Singular>, usize)>,
    pub starts: usize,
    /// Number of starts that led into the box.
    pub arrived: usize,
    /// The start that led to the locus found last.
    pub last_new: Option<usize>,
}

/// True if more starts are likely to lead to new curves, by the share of curves met once (Good 1953).
fn more_is_likely(found: &FoundCurves) -> bool {
    /// Number of arrivals below which the share is no evidence.
    const ARRIVALS: usize = 20;
    let once = |(traced, met): &(Traced<Singular>, usize)| *met == 1 && traced.places.len() > 1;
    found.arrived > 0 && (found.arrived < ARRIVALS || found.known.iter().any(once))
}

impl FoundCurves {
    pub fn crossings(&self) -> Vec<Configuration<f64>> {
        let crossings = self.known.iter().flat_map(|(traced, _)| &traced.crossings);
        crossings.map(|place| place.at.at.clone()).collect()
    }
}

impl LocusSearch<'_> {
    /// Curves found from random starts.
    pub fn of(&mut self, kind: Kind, locks: &[Lock]) -> FoundCurves {
        let mut found = FoundCurves {
            kind,
            curve: LocusCurve::new(self.region.mechanism, self.region.held, &self.inputs, locks),
            known: Vec::new(),
            starts: 0,
            arrived: 0,
            last_new: None,
        };
        let system = System::new(self.region.mechanism.dimensions(), self.region.held);
        let mut rng = Pcg64Mcg::seed_from_u64(self.settings.seed);
        for number in 1..=MORE * self.settings.starts {
            let least = number <= self.settings.starts;
            let now = Progress {
                stage: Stage::Loci,
                done: number - 1,
                of: least.then_some(self.settings.starts),
            };
            self.region.now = now;
            if !least && !more_is_likely(&found) || self.region.watch.at(now).is_break() {
                break;
            }
            found.starts = number;
            let mut at = match number {
                1 => self.start.clone(),
                _ => self.random(&mut rng),
            };
            let mut trial = at.clone();
            let mut work = system.work();
            // where it cannot close the gap it ends in a singular point as well
            Newton::default().solve(&system, &mut at, &mut trial, &mut work);
            let Some(arrival) = self.arrival(&mut found.curve, at) else {
                continue;
            };
            found.arrived += 1;
            let before = found.known.len();
            if let Some(locus) = self.locus_through(&mut found, arrival) {
                found.known[locus].1 += 1;
            }
            if found.known.len() > before {
                found.last_new = Some(number);
            }
        }
        found
    }

    /// Starts where loci of the other kind cross, if the configuration is singular of this kind too.
    pub fn at_crossing(&mut self, found: &mut FoundCurves, at: &Configuration<f64>) {
        if !found.kind.is_of(&self.classifier.at(at)) {
            return;
        }
        if let Some(arrival) = self.arrival(&mut found.curve, at.clone()) {
            self.locus_through(found, arrival);
        }
    }

    /// The singular configuration in the box that Gauss–Newton steps lead to, and true if it is isolated; its tangent
    /// then has no meaning.
    ///
    /// If the determinant has an extremum of zero, as for a 5-bar whose cranks part as far as its couplers reach, the
    /// locus is an isolated point: the augmented system loses rank, and each step halves the distance only.
    fn arrival(
        &self,
        curve: &mut LocusCurve,
        at: Configuration<f64>,
    ) -> Option<(CurvePoint<Singular>, bool)> {
        /// The last step, and about as far an isolated point.
        const NEAR: f64 = 1e-3;
        let method = self.region.method;
        let poses = at.platforms.iter();
        let mut parts =
            poses.flat_map(|pose| pose.position.0.into_iter().chain(pose.orientation.0));
        if !at.joints.iter().all(|x| x.is_finite()) || !parts.all(f64::is_finite) {
            return None;
        }
        let columns = curve.locked().columns();
        let decomposition = curve.locked().of_rank(&at, columns);
        let (_, motion) = decomposition.weakest()?;
        let motion = motion.to_vec();
        // at an isolated point the steps are rounding, and have any length
        let point = neared(curve, Singular { at, motion }, |size, residual| {
            size < NEAR || residual.iter().all(|r| r.abs() <= method.tolerance)
        })?;
        let (mut place, isolated) = match method.settle(curve, point.clone()) {
            Ok(place) => (place, false),
            // isolated points take longer to locate: only those near the box are
            Err(_) if self.near_box(&point.at) => {
                let found = method.branch_point(curve, &point, 50.0 * NEAR)?;
                let place = found.place(curve, &vec![0.0; curve.unknowns()]);
                (found.isolated.then_some(place)?, true)
            }
            Err(_) => return None,
        };
        self.bring_home(&mut place.at.at);
        (self.region.inside(&place.at.at)).then_some((place, isolated))
    }

    /// The number of the known locus through a place, which is known from now on.
    fn locus_through(
        &self,
        found: &mut FoundCurves,
        (place, isolated): (CurvePoint<Singular>, bool),
    ) -> Option<usize> {
        let method = self.region.method;
        let curve = &mut found.curve;
        let mut curves = found.known.iter();
        let known = curves.position(|(traced, _)| met_at(curve, traced, &place, method).is_some());
        if known.is_some() {
            return known;
        }
        let traced = match isolated {
            false => self.region.traced(curve, place),
            true => Traced {
                places: vec![place],
                ends: [LocusEnd::Closed; 2],
                crossings: Vec::new(),
            },
        };
        // where no step leads on there is no curve to report
        (isolated || traced.places.len() > 1).then(|| {
            found.known.push((traced, 0));
            found.known.len() - 1
        })
    }

    /// A random configuration with the two coordinates in the box.
    fn random(&self, rng: &mut Pcg64Mcg) -> Configuration<f64> {
        let mut at = random_configuration(self.region.mechanism, &self.start, rng);
        for (joint, value) in at.joints.iter_mut().enumerate() {
            if self.region.held.joints[joint] {
                *value = self.start.joints[joint];
            }
        }
        for side in self.region.sides {
            let value = side.from + (side.to - side.from) * rng.random::<f64>();
            match side.coordinate {
                Coordinate::Joint(joint) => at.joints[joint] = value,
                Coordinate::Pose(platform, coordinate) => {
                    let mechanism = self.region.mechanism;
                    let pose = mechanism.in_ground(&at.platforms[platform]);
                    let pose = with_coordinates(&pose, [(coordinate, value)]);
                    at.platforms[platform] = mechanism.from_ground(&pose);
                }
                // never a side: it has no value
                Coordinate::Turn(..) => {}
            }
        }
        at
    }

    /// Brings angles into the box and within limits by whole turns.
    fn bring_home(&self, at: &mut Configuration<f64>) {
        for (joint, value) in at.joints.iter_mut().enumerate() {
            if self.region.mechanism.repeats(joint) {
                let mut sides = self.region.sides.iter();
                let side = sides.find(|side| side.coordinate == Coordinate::Joint(joint));
                let home = || self.region.mechanism.home_turn(joint);
                let middle = side.map_or_else(home, |side| 0.5 * (side.from + side.to));
                *value = turn_near(*value, middle);
            }
        }
        self.region.mechanism.turn_to_limits(&mut at.joints);
    }

    fn near_box(&self, at: &Configuration<f64>) -> bool {
        let mut at = at.clone();
        self.bring_home(&mut at);
        self.region.sides.iter().all(|side| {
            // within a tenth of the box
            let (x, slack) = (self.region.side(&at, side), 0.1 * (side.to - side.from));
            x >= side.from - slack && x <= side.to + slack
        })
    }
}
