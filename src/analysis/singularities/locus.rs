//! Singularities in two inputs: loci as curves.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;

use super::along::value;
use super::classify::{Classifier, Singularity};
use super::curve::{LocusCurve, Singular};
use super::{SingularitiesSettings, names, output_names, outputs_of};
use crate::linear::{dot, norm};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::solve::{Continuation, Place, SolutionCurve, Stop};
use crate::system::{
    Driven, Held, Holdable, Lock, System, Walk, random_configuration, with_coordinates,
};

type At = Place<Singular>;

/// The singularity loci in a box of two coordinates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LocusReport {
    /// The inputs that singularities are told of.
    pub inputs: Vec<String>,
    /// The outputs.
    pub outputs: Vec<String>,
    /// The box.
    pub bounds: [Bound; 2],
    /// The curves, those of direct singularities first, sorted by where they begin.
    pub loci: Vec<Locus>,
    /// Random starts that were made for each kind.
    pub starts: usize,
    /// Starts that led to a singular configuration in the box, direct and inverse.
    pub arrived: [usize; 2],
    /// The start that led to the curve found last, direct and inverse.
    pub last_new: [Option<usize>; 2],
    /// The seed of the starts.
    pub seed: u64,
    /// The length that makes the matrices dimensionless, in m.
    pub normalising_length: f64,
}

/// A side of the box.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// The coordinate.
    pub name: String,
    /// rad or m.
    pub unit: &'static str,
    /// Its least value.
    pub from: f64,
    /// Its greatest value.
    pub to: f64,
}

/// Which matrix loses rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// [J; H]: freedoms are gained while the inputs stand still.
    Direct,
    /// [J; O]: inputs move while the outputs stand still.
    Inverse,
}

/// A curve of singular configurations.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Locus {
    /// Which matrix loses rank on it.
    pub kind: Kind,
    /// Whether it closes.
    pub closed: bool,
    /// How its first and its last point end it; the same if it closes.
    pub ends: [LocusEnd; 2],
    /// Its points: the two coordinates, rad or m.
    pub points: Vec<[f64; 2]>,
    /// The joints at its points, rad or m, in the order of the file.
    pub joints: Vec<Vec<f64>>,
    /// Positions (m) and quaternions (w, x, y, z) of the platforms at its points.
    pub poses: Vec<Vec<[f64; 7]>>,
    /// What is singular in its middle.
    pub singularity: Singularity,
    /// Where other loci cross it: the two coordinates.
    pub crossings: Vec<[f64; 2]>,
}

/// How a curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LocusEnd {
    /// Where it began.
    Closed,
    /// At an edge of the box.
    Box,
    /// At a limit of a joint.
    Limit,
    /// In a point that no sure step leads beyond.
    Lost,
}

/// Finds the singularity loci in a box of two coordinates.
///
/// `held` holds what stands still and leaves the two coordinates free; `inputs` are those that
/// singularities are told of. Random configurations are brought onto the augmented system closure and
/// singularity condition by Gauss–Newton steps, and the curve through each that is not on a known one
/// is followed both ways: to its own beginning, an edge of the box or a limit.
///
/// # Errors
/// If links spin about their own lines: then the motion that is gained is not unique. The number of
/// such freedoms is given.
pub fn loci(
    mechanism: &Mechanism,
    held: &Held<f64>,
    sides: [Driven; 2],
    inputs: &[Holdable],
    start: &Configuration<f64>,
    settings: &SingularitiesSettings,
) -> Result<LocusReport, usize> {
    let outputs = outputs_of(mechanism, inputs, settings);
    let mut search = Search {
        mechanism,
        held,
        sides,
        start: start.clone(),
        settings,
        classifier: Classifier::new(mechanism, inputs, &outputs, start),
    };
    let [direct, _] = search.classifier.regular_ranks();
    let spins = search.classifier.direct.columns() - direct;
    if spins > 0 {
        return Err(spins);
    }
    let mut report = LocusReport {
        inputs: names(mechanism, inputs),
        outputs: output_names(mechanism, &outputs),
        bounds: sides.map(|side| Bound {
            name: side.coordinate.name(mechanism),
            unit: match side.coordinate.is_angle(mechanism) {
                true => "rad",
                false => "m",
            },
            from: side.from,
            to: side.to,
        }),
        loci: Vec::new(),
        starts: settings.starts,
        arrived: [0; 2],
        last_new: [None; 2],
        seed: settings.seed,
        normalising_length: mechanism.characteristic_length(),
    };
    let inputs: Vec<Lock> = inputs.iter().copied().map(Lock::Coordinate).collect();
    for (i, (kind, locks)) in [(Kind::Direct, &inputs), (Kind::Inverse, &outputs)]
        .into_iter()
        .enumerate()
    {
        // outputs that leave some motion undetermined everywhere have no such locus
        let regular = search.classifier.regular_ranks()[i];
        if regular < search.classifier.direct.columns() {
            continue;
        }
        let (found, arrived, last) = search.of(kind, locks);
        report.loci.extend(found);
        report.arrived[i] = arrived;
        report.last_new[i] = last;
    }
    Ok(report)
}

struct Search<'m> {
    mechanism: &'m Mechanism,
    held: &'m Held<f64>,
    sides: [Driven; 2],
    start: Configuration<f64>,
    settings: &'m SingularitiesSettings,
    classifier: Classifier<'m>,
}

/// A curve as it was followed.
struct Traced {
    places: Vec<At>,
    ends: [LocusEnd; 2],
    crossings: Vec<At>,
}

impl Search<'_> {
    fn of(&mut self, kind: Kind, locks: &[Lock]) -> (Vec<Locus>, usize, Option<usize>) {
        let mut curve = LocusCurve::new(self.mechanism, self.held, locks);
        let system = System::new(self.mechanism.dimensions(), self.held);
        let (mut arrived, mut last) = (0, None);
        let mut known: Vec<Traced> = Vec::new();
        let mut rng = Pcg64Mcg::seed_from_u64(self.settings.seed);
        let method = &self.settings.continuation;
        for number in 1..=self.settings.starts {
            let mut at = match number {
                1 => self.start.clone(),
                _ => self.random(&mut rng),
            };
            let mut trial = at.clone();
            let mut work = system.work();
            let report = (self.settings.newton).solve(&system, &mut at, &mut trial, &mut work);
            // where it cannot close the gap it ends in a singular point as well
            let finite = at.joints.iter().all(|x| x.is_finite());
            if report.stop != Stop::Solved && !finite {
                continue;
            }
            let columns = curve.locked().columns();
            let decomposition = curve.locked().of_rank(&at, columns);
            let Some(motion) = decomposition.weakest().map(<[f64]>::to_vec) else {
                continue;
            };
            let Some(place) = settled(&mut curve, Singular { at, motion }, method) else {
                continue;
            };
            let mut place = place;
            self.bring_home(&mut place);
            if !self.inside(&place.at.at) {
                continue;
            }
            arrived += 1;
            if known
                .iter()
                .any(|traced| passes(&mut curve, traced, &place, method))
            {
                continue;
            }
            let traced = self.traced(&mut curve, place, method);
            if traced.places.len() > 1 {
                last = Some(number);
                known.push(traced);
            }
        }
        let mut loci: Vec<Locus> = known
            .into_iter()
            .map(|traced| self.locus(kind, traced))
            .collect();
        let order = |locus: &Locus| {
            locus
                .points
                .iter()
                .copied()
                .fold([f64::INFINITY; 2], |a, b| if b < a { b } else { a })
        };
        loci.sort_by(|a, b| {
            order(a)
                .partial_cmp(&order(b))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        (loci, arrived, last)
    }

    /// A random configuration with the two coordinates in the box.
    fn random(&self, rng: &mut Pcg64Mcg) -> Configuration<f64> {
        let mut at = random_configuration(self.mechanism, &self.start, rng);
        for (joint, value) in at.joints.iter_mut().enumerate() {
            if self.held.joints[joint] {
                *value = self.start.joints[joint];
            }
        }
        for side in self.sides {
            let value = side.from + (side.to - side.from) * rng.random::<f64>();
            match side.coordinate {
                Holdable::Joint(joint) => at.joints[joint] = value,
                Holdable::Coordinate(platform, coordinate) => {
                    let pose = at.platforms[platform].pose();
                    let pose = with_coordinates(&pose, [(coordinate, value)]);
                    at.platforms[platform] = PlatformPose::from_pose(&pose);
                }
            }
        }
        at
    }

    /// Brings angles into the box and within limits by whole turns.
    fn bring_home(&self, place: &mut At) {
        let at = &mut place.at.at;
        for (joint, value) in at.joints.iter_mut().enumerate() {
            if self.mechanism.repeats(joint) {
                let side = self
                    .sides
                    .iter()
                    .find(|s| s.coordinate == Holdable::Joint(joint));
                let middle = side.map_or(0.0, |side| 0.5 * (side.from + side.to));
                let turn = std::f64::consts::TAU;
                *value -= turn * ((*value - middle) / turn).round();
            }
        }
        Walk::within_limits(self.mechanism, at);
    }

    /// A coordinate of the box at a configuration; angles of platforms near the middle of the box.
    fn side(&self, at: &Configuration<f64>, side: &Driven) -> f64 {
        let x = value(at, side.coordinate);
        match side.coordinate {
            Holdable::Coordinate(_, c) if c.is_angle() => {
                let middle = 0.5 * (side.from + side.to);
                let turn = std::f64::consts::TAU;
                x - turn * ((x - middle) / turn).round()
            }
            _ => x,
        }
    }

    /// How far a configuration is inside each bound, of the box and then of limits.
    fn margins(&self, at: &Configuration<f64>) -> Vec<f64> {
        let mut margins = Vec::new();
        for side in &self.sides {
            let x = self.side(at, side);
            margins.extend([x - side.from, side.to - x]);
        }
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            let held = self.held.joints[i];
            if let Some((low, high)) = joint.limits.filter(|_| !held) {
                margins.extend([at.joints[i] - low, high - at.joints[i]]);
            }
        }
        margins
    }

    fn inside(&self, at: &Configuration<f64>) -> bool {
        self.margins(at).into_iter().all(|margin| margin >= -1e-9)
    }

    /// The whole curve through a place.
    fn traced(&self, curve: &mut LocusCurve, place: At, method: &Continuation) -> Traced {
        let (mut places, end, mut crossings) = self.half(curve, place.clone(), method);
        if end == LocusEnd::Closed {
            return Traced {
                places,
                ends: [end; 2],
                crossings,
            };
        }
        let (back, start, more) = self.half(curve, place.reversed(), method);
        crossings.extend(more);
        let back = back.into_iter().rev().map(Place::reversed);
        let mut all: Vec<At> = back.collect();
        all.pop();
        all.append(&mut places);
        Traced {
            places: all,
            ends: [start, end],
            crossings,
        }
    }

    /// The curve from a place on in the direction of its tangent.
    fn half(
        &self,
        curve: &mut LocusCurve,
        start: At,
        method: &Continuation,
    ) -> (Vec<At>, LocusEnd, Vec<At>) {
        const STEPS: usize = 100_000;
        let mut places = vec![start.clone()];
        let mut crossings = Vec::new();
        let mut place = start.clone();
        let (mut length, mut gone) = (0.1 * method.longest, 0.0);
        for _ in 0..STEPS {
            let to = match method.step(curve, &place, length) {
                Ok((to, changed)) => {
                    length = method.next_length(length, changed);
                    to
                }
                Err(_) if length > 1e-3 * method.longest => {
                    length *= 0.5;
                    continue;
                }
                Err(_) => match self.beyond(curve, &place, method) {
                    Some((crossing, to)) => {
                        crossings.push(crossing);
                        length = 0.1 * method.longest;
                        to
                    }
                    None if length > method.shortest => {
                        length *= 0.5;
                        continue;
                    }
                    None => return (places, LocusEnd::Lost, crossings),
                },
            };
            gone += norm(&curve.apart(&place.at, &to.at));
            let (before, after) = (self.margins(&place.at.at), self.margins(&to.at.at));
            let left = (before.iter().zip(&after))
                .enumerate()
                .filter(|(_, (b, a))| **a < 0.0 && **a < **b)
                .map(|(i, (b, a))| (i, b.max(0.0) / (b.max(0.0) - a)))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((i, _)) = left {
                let end = match i < 4 {
                    true => LocusEnd::Box,
                    false => LocusEnd::Limit,
                };
                if before[i] > 0.0 {
                    let mut margin = |_: &mut LocusCurve, p: &At| self.margins(&p.at.at)[i];
                    places.push(method.root(curve, &place, &to, &mut margin));
                }
                return (places, end, crossings);
            }
            if let Some(end) = closed(curve, &start, &place, &to, gone, method) {
                places.push(end);
                return (places, LocusEnd::Closed, crossings);
            }
            places.push(to.clone());
            place = to;
        }
        (places, LocusEnd::Lost, crossings)
    }

    /// A crossing of loci just ahead, and the place behind it straight on.
    fn beyond(
        &self,
        curve: &mut LocusCurve,
        place: &At,
        method: &Continuation,
    ) -> Option<(At, At)> {
        let reach = 0.2 * method.longest;
        let point = method.branch_point(curve, &place.at, reach)?;
        let way = curve.difference(&place.at, &point.at);
        if dot(&way, &place.tangent) < 0.9 * norm(&way) {
            return None;
        }
        let along = |d: &Vec<f64>| dot(d, &place.tangent);
        let straight = (point.directions.iter())
            .max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()))
            .filter(|d| along(d).abs() > 0.9)?;
        let sign = along(straight).signum();
        let straight: Vec<f64> = straight.iter().map(|x| sign * x).collect();
        let (to, _) = method.leave(curve, &point.at, &straight)?;
        Some((point.place(curve, &straight), to))
    }

    fn locus(&mut self, kind: Kind, traced: Traced) -> Locus {
        let sides = self.sides;
        let coordinates =
            |search: &Self, place: &At| sides.map(|side| search.side(&place.at.at, &side));
        let middle = &traced.places[traced.places.len() / 2];
        let singularity = self.classifier.at(&middle.at.at);
        let poses = |place: &At| {
            let platforms = place.at.at.platforms.iter();
            platforms
                .map(|pose| {
                    let ([x, y, z], [w, i, j, k]) = (pose.position.0, pose.orientation.0);
                    [x, y, z, w, i, j, k]
                })
                .collect()
        };
        Locus {
            kind,
            closed: traced.ends[1] == LocusEnd::Closed,
            ends: traced.ends,
            points: (traced.places.iter())
                .map(|p| coordinates(self, p))
                .collect(),
            joints: (traced.places.iter())
                .map(|p| p.at.at.joints.clone())
                .collect(),
            poses: traced.places.iter().map(poses).collect(),
            singularity,
            crossings: (traced.crossings.iter())
                .map(|p| coordinates(self, p))
                .collect(),
        }
    }
}

/// The singular place that Gauss–Newton steps of bounded length reach, if they do.
fn settled(curve: &mut LocusCurve, mut point: Singular, method: &Continuation) -> Option<At> {
    const STEPS: usize = 40;
    const LONGEST: f64 = 0.5;
    let regular = curve.unknowns().saturating_sub(1);
    for _ in 0..STEPS {
        let (residual, jacobian) = curve.linearise(&point);
        if !jacobian.iter().chain(&residual).all(|x| x.is_finite()) {
            return None;
        }
        let decomposition = crate::linear::Decomposition::of_rank(
            residual.len(),
            curve.unknowns(),
            &jacobian,
            regular,
        );
        let mut step = decomposition.solve(&residual);
        let size = norm(&step);
        if size < 1e-3 {
            return method.settle(curve, point).ok();
        }
        let factor = (LONGEST / size).min(1.0);
        step.iter_mut().for_each(|x| *x *= -factor);
        point = curve.displaced(&point, &step);
    }
    None
}

/// Whether a curve passes through a place.
fn passes(curve: &mut LocusCurve, traced: &Traced, place: &At, method: &Continuation) -> bool {
    const SAME: f64 = 1e-6;
    let distance =
        |curve: &LocusCurve, i: usize| norm(&curve.apart(&traced.places[i].at, &place.at));
    let nearest = (0..traced.places.len())
        .map(|i| (i, distance(curve, i)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((i, apart)) = nearest.filter(|(_, apart)| *apart < 2.0 * method.longest) else {
        return false;
    };
    if apart < SAME {
        return true;
    }
    // the foot of the place on the pieces beside the nearest point
    let freedoms = curve.closed().unknowns();
    let foot = |curve: &mut LocusCurve, from: &At, to: &At| {
        let tangent = from.tangent[..freedoms].to_vec();
        let mut ahead =
            |curve: &mut LocusCurve, p: &At| dot(&curve.apart(&p.at, &place.at), &tangent);
        if (ahead(curve, from) < 0.0) == (ahead(curve, to) < 0.0) {
            return false;
        }
        let foot = method.root(curve, from, to, &mut ahead);
        norm(&curve.apart(&foot.at, &place.at)) < SAME
    };
    let places = &traced.places;
    (i > 0 && foot(curve, &places[i - 1], &places[i]))
        || (i + 1 < places.len() && foot(curve, &places[i], &places[i + 1]))
}

/// The place between two where the curve comes back to its start.
fn closed(
    curve: &mut LocusCurve,
    start: &At,
    from: &At,
    to: &At,
    gone: f64,
    method: &Continuation,
) -> Option<At> {
    const SAME: f64 = 1e-6;
    let step = norm(&curve.apart(&from.at, &to.at));
    if gone <= 1.5 * step || norm(&curve.apart(&from.at, &start.at)) > 2.0 * step {
        return None;
    }
    let freedoms = curve.closed().unknowns();
    let tangent = start.tangent[..freedoms].to_vec();
    let mut ahead = |curve: &mut LocusCurve, p: &At| dot(&curve.apart(&start.at, &p.at), &tangent);
    if !(ahead(curve, from) < 0.0 && ahead(curve, to) >= 0.0) {
        return None;
    }
    let place = method.root(curve, from, to, &mut ahead);
    let apart = norm(&curve.apart(&start.at, &place.at));
    (apart < SAME && dot(&place.tangent[..freedoms], &tangent) > 0.0).then_some(place)
}
