//! All circuits and branches of a mechanism with one freedom.
//!
//! A circuit is all that can be reached without taking the mechanism apart, a branch of it what lies
//! between two dead points of the input.
//! Source: T. R. Chase and J. A. Mirth, Circuits and branches of single-degree-of-freedom planar
//! linkages, 1993.

mod class;
mod course;
mod pairs;
mod report;
mod slice;
mod tracing;

pub use report::{Branch, Circuit, CircuitsReport, FourBarClass, Grashof, JointMotion};
pub use slice::{Slice, Swept};

use super::At;
use super::paths::Tracer;
use crate::linear::norm;
use crate::mechanism::{Configuration, Mechanism, NamedPoint};
use crate::number::tolerance::SAME;
use crate::solve::{Continuation, Watch};
use crate::system::{Coordinate, Curve, Held, Still};
use class::{class, grashof};
use course::JointCourse;
use tracing::{FoundCurve, Tracing};

/// Settings of a search for circuits.
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitsSettings {
    /// Tolerances and step lengths of the continuation.
    pub continuation: Continuation,
    /// Steps after which a curve is given up; ten times as many are made for all curves together.
    pub most_steps: usize,
    /// Points whose paths are searched for cusps and double points.
    pub points: Vec<NamedPoint>,
    /// All configurations at a value of a joint, from which every circuit on which it moves is met, and at more values of
    /// it where they go to infinity between these.
    pub slices: Vec<Slice>,
}

impl CircuitsSettings {
    const CURVES: usize = 10;
}

impl Default for CircuitsSettings {
    fn default() -> Self {
        CircuitsSettings {
            continuation: Continuation::default(),
            most_steps: 20_000,
            points: Vec::new(),
            slices: Vec::new(),
        }
    }
}

/// Follows a curve from every seed that lies on none so far, from every crossing, and from wherever the slice leads.
///
/// `held`, which includes what stands `still` so that links do not spin, must leave one freedom. Without a slice circuits
/// on which no seed lies are not found. Of circuits that differ only in the two sets of angles of balls written as three
/// rows there is one.
pub fn circuits(
    mechanism: &Mechanism,
    (held, still): (&Held<f64>, &[Still]),
    input: Coordinate,
    seeds: &[Configuration<f64>],
    settings: &CircuitsSettings,
    watch: &Watch,
) -> CircuitsReport {
    let mut with_input = held.clone();
    if let Coordinate::Joint(joint) = input {
        with_input.joints[joint] = true;
    }
    let at_rest = (&with_input, still);
    // limits cut circuits into pieces, so that whole ones are looked for first
    let free = mechanism.without_limits();
    let limited = mechanism
        .joints()
        .iter()
        .any(|joint| joint.limits.is_some());
    let mut tracing = Tracing::new(&free, held, at_rest, (settings, watch));
    seeds.iter().for_each(|seed| tracing.take(seed));
    let swept = slice::sweep(&settings.slices, held, &mut tracing, watch);
    if limited {
        let whole = tracing;
        tracing = Tracing::new(mechanism, held, at_rest, (settings, watch));
        for seed in whole
            .traced
            .iter()
            .flat_map(|found| within_limits(mechanism, found))
        {
            tracing.take(&seed);
        }
    }
    let exhausted = tracing.is_exhausted();
    let Tracing {
        mut curve,
        traced,
        unusable,
        ..
    } = tracing;
    let method = &settings.continuation;
    let all: Vec<Circuit> = (0..traced.len())
        .map(|i| described(mechanism, (&mut curve, method), input, &traced, i))
        .collect();
    let mut paths = Vec::new();
    if !settings.points.is_empty() {
        let places: Vec<(Vec<At>, bool)> = (traced.iter())
            .map(|found| (found.restored(&mut curve, method), found.closed))
            .collect();
        let places: Vec<(&[At], bool)> = places.iter().map(|(p, c)| (&p[..], *c)).collect();
        paths.extend(settings.points.iter().map(|point| {
            let mut tracer = Tracer::new(mechanism, &curve, point);
            let mut path = tracer.report(&mut curve, method, &places);
            let special = path.cusps.iter_mut().chain(&mut path.double_points);
            for joints in special.flat_map(|point| &mut point.joints) {
                for (joint, value) in joints.iter_mut().enumerate() {
                    *value = mechanism.as_given(joint, *value);
                }
            }
            path
        }));
    }
    CircuitsReport {
        paths,
        mechanism: mechanism.name().to_owned(),
        input: input.name(mechanism),
        class: class(mechanism, &all),
        grashof: (traced.first()).and_then(|found| grashof(mechanism, &found.places.first()?.at)),
        circuits: all,
        seeds: seeds.len(),
        unusable,
        swept,
        exhausted,
        characteristic_length: mechanism.characteristic_length(),
        interrupted: watch.is_stopped(),
    }
}

/// A configuration of each piece of a curve that lies within limits.
fn within_limits(mechanism: &Mechanism, found: &FoundCurve) -> Vec<Configuration<f64>> {
    let inside = |at: &&At| {
        let mut joints = at.at.joints.clone();
        mechanism.turn_to_limits(&mut joints);
        mechanism.outside_limits(&joints).next().is_none()
    };
    let pieces = found.places.chunk_by(|a, b| inside(&a) == inside(&b));
    let middles = pieces.map(|piece| &piece[piece.len() / 2]);
    // a piece between two places holds a place where a joint turns back
    let turnings = found.turnings.iter().map(|(_, place)| place);
    let seeds = middles.chain(turnings).filter(inside);
    seeds.map(|place| place.at.clone()).collect()
}

fn described(
    mechanism: &Mechanism,
    (curve, method): (&mut Curve, &Continuation),
    input: Coordinate,
    traced: &[FoundCurve],
    i: usize,
) -> Circuit {
    let found = &traced[i];
    let platforms: Vec<JointCourse> = match input {
        Coordinate::Joint(_) => Vec::new(),
        _ => Coordinate::all(mechanism)
            .filter(|of| of.platform().is_some())
            .filter_map(|of| JointCourse::of_platform(mechanism, (&mut *curve, method), found, of))
            .collect(),
    };
    let branches = match input {
        Coordinate::Joint(joint) => JointCourse::of_joint(mechanism, joint, found).branches(),
        of => (platforms.iter().find(|course| course.of == of))
            .map_or(Vec::new(), JointCourse::branches),
    };
    let curve = &*curve;
    let joints: Vec<JointMotion> = (0..mechanism.joints().len())
        .filter(|joint| curve.column(*joint).is_some())
        .map(|joint| JointCourse::of_joint(mechanism, joint, found).motion())
        .collect();
    let crossings = &found.crossings;
    let meets = |other: &FoundCurve| {
        other.crossings.iter().any(|point| {
            (crossings.iter())
                .any(|own| norm(&curve.difference_but_turns(&own.at, &point.at)) < SAME)
        })
    };
    Circuit {
        number: i + 1,
        closed: found.closed,
        whole: found.whole,
        length: found.length,
        branches,
        joints,
        platforms: platforms.iter().map(JointCourse::motion).collect(),
        crossings: (crossings.iter())
            .map(|point| {
                let joints = point.at.joints.iter().enumerate();
                joints
                    .map(|(joint, x)| mechanism.within_cycle(joint, *x))
                    .collect()
            })
            .collect(),
        crosses: (0..traced.len())
            .filter(|&other| other != i && meets(&traced[other]))
            .map(|other| other + 1)
            .collect(),
        seeds: found.seeds,
        course: (found.places.iter())
            .map(|place| place.at.joints.clone())
            .collect(),
    }
}
