//! All circuits and branches of a mechanism with one freedom.
//!
//! A circuit is all that can be reached without taking the mechanism apart, a branch of it what lies
//! between two dead points of the input.
//! Source: T. R. Chase and J. A. Mirth, Circuits and branches of single-degree-of-freedom planar
//! linkages, 1993.

mod class;
mod course;
mod report;

pub use report::{Branch, Circuit, CircuitsReport, FourBarClass, JointMotion};

use std::ops::ControlFlow;

use super::At;
use super::begin::forwards;
use super::paths::Tracer;
use crate::linear::{dot, norm};
use crate::mechanism::{Configuration, Mechanism, NamedPoint};
use crate::solve::{BranchPoint, Continuation, Place, Stage, Watch};
use crate::system::{Coordinate, Curve, Event, Held, Still, Walk, sets_of_angles};
use class::class;
use course::Course;

/// How to look for circuits.
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitsSettings {
    /// How carefully curves are followed.
    pub continuation: Continuation,
    /// Steps after which a curve is given up.
    pub most_steps: usize,
    /// Points whose paths are looked at.
    pub points: Vec<NamedPoint>,
}

impl Default for CircuitsSettings {
    fn default() -> Self {
        CircuitsSettings {
            continuation: Continuation::default(),
            most_steps: 50_000,
            points: Vec::new(),
        }
    }
}

/// One curve as it was followed.
struct Found {
    places: Vec<At>,
    turnings: Vec<(usize, At)>,
    crossings: Vec<BranchPoint<Configuration<f64>>>,
    closed: bool,
    whole: bool,
    length: f64,
    seeds: usize,
}

/// Follows a curve from every seed that lies on none so far, and from every crossing.
///
/// `held`, which includes what stands `still` so that links do not spin, must leave one freedom. Circuits on which no seed lies are not found: take all assemblies
/// at several values of the input. Of circuits that differ only in the two sets of angles of balls written as three
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
    let mut curve = Curve::new(mechanism, held);
    let method = &settings.continuation;
    let mut traced: Vec<Found> = Vec::new();
    let mut unusable = 0;
    for seed in seeds {
        if watch.is_stopped() {
            break;
        }
        let mut seed = seed.clone();
        let Ok(place) = curve.begin(mechanism, &mut seed, method) else {
            unusable += 1;
            continue;
        };
        // with another set of the angles of a ball everything moves alike
        let mut sets = sets_of_angles(mechanism, (&with_input, still), &seed).into_iter();
        let known = sets.find_map(|mut set| {
            let place = curve.begin(mechanism, &mut set, method).ok()?;
            holding(&mut curve, method, &traced, &place)
        });
        if let Some(known) = known {
            traced[known].seeds += 1;
            continue;
        }
        let place = forwards(mechanism, &curve, place);
        let mut waiting = vec![(place, 1)];
        while let Some((place, seeds)) = waiting.pop() {
            if holding(&mut curve, method, &traced, &place).is_some() {
                continue;
            }
            if watch.is_stopped() {
                break;
            }
            let found = trace(mechanism, &mut curve, place, (settings, watch), seeds);
            for point in &found.crossings {
                for direction in &point.directions {
                    if let Some((place, _)) = method.leave(&mut curve, &point.at, direction) {
                        waiting.push((forwards(mechanism, &curve, place), 0));
                    }
                }
            }
            traced.push(found);
        }
    }
    let all: Vec<Circuit> = (0..traced.len())
        .map(|i| described(mechanism, (&mut curve, method), input, &traced, i))
        .collect();
    let places: Vec<(&[At], bool)> = (traced.iter())
        .map(|found| (&found.places[..], found.closed))
        .collect();
    let paths = settings.points.iter().map(|point| {
        let mut tracer = Tracer::new(mechanism, &curve, point);
        let mut path = tracer.report(&mut curve, method, &places);
        let special = path.cusps.iter_mut().chain(&mut path.double_points);
        for joints in special.flat_map(|point| &mut point.joints) {
            for (joint, value) in joints.iter_mut().enumerate() {
                *value = mechanism.as_given(joint, *value);
            }
        }
        path
    });
    let paths = paths.collect();
    CircuitsReport {
        paths,
        mechanism: mechanism.name().to_owned(),
        input: input.name(mechanism),
        class: class(mechanism, &all),
        circuits: all,
        seeds: seeds.len(),
        unusable,
        characteristic_length: mechanism.characteristic_length(),
        interrupted: watch.is_stopped(),
    }
}

/// The curve that a place lies on.
fn holding(
    curve: &mut Curve,
    method: &Continuation,
    traced: &[Found],
    place: &At,
) -> Option<usize> {
    const SAME: f64 = 1e-6;
    traced.iter().position(|known| {
        known.places.iter().any(|node| {
            let gap = curve.difference_but_turns(&node.at, &place.at);
            if norm(&gap) > 1.5 * method.longest {
                return false;
            }
            let near = |curve: &Curve, at: &At| {
                norm(&curve.difference_but_turns(&at.at, &place.at)) < SAME
            };
            let along = dot(&gap, &node.tangent);
            near(curve, node)
                || (method.step(curve, node, along)).is_ok_and(|(at, _)| near(curve, &at))
        })
    })
}

/// The curve through a place: round it, or from one end to the other.
fn trace(
    mechanism: &Mechanism,
    curve: &mut Curve,
    start: At,
    watched: (&CircuitsSettings, &Watch),
    seeds: usize,
) -> Found {
    // first backwards to an end, if there is one
    let back = start.clone().reversed();
    let (mut found, end) = half(mechanism, curve, back, watched, seeds);
    if !found.closed {
        let begin = end.map_or(start, Place::reversed);
        return half(mechanism, curve, begin, watched, seeds).0;
    }
    // now in the sense it was to have
    found.turnings.reverse();
    found.crossings.reverse();
    let places = found.places.into_iter().rev();
    found.places = places.map(Place::reversed).collect();
    found
}

/// The curve from a place on until it closes or ends; with the limit that it ends at.
fn half(
    mechanism: &Mechanism,
    curve: &mut Curve,
    from: At,
    (settings, watch): (&CircuitsSettings, &Watch),
    seeds: usize,
) -> (Found, Option<At>) {
    let mut found = Found {
        places: vec![from.clone()],
        turnings: Vec::new(),
        crossings: Vec::new(),
        closed: false,
        whole: false,
        length: 0.0,
        seeds,
    };
    let mut walk = Walk::new(mechanism, curve, from, settings.continuation.clone());
    let mut steps = 0;
    let end = walk.follow(curve, |curve, leg| {
        if watch.stops(Stage::Steps, steps, None) {
            return ControlFlow::Break(None);
        }
        steps += 1;
        for (place, event) in &leg.events {
            match event {
                Event::Turning(joint) => found.turnings.push((*joint, place.clone())),
                Event::Branches(point) => found.crossings.push((**point).clone()),
                Event::Closed | Event::Limit { .. } => {
                    found.length = leg.gone_at(curve, place);
                    found.places.push(place.clone());
                    found.whole = true;
                    found.closed = matches!(event, Event::Closed);
                    return ControlFlow::Break((!found.closed).then(|| place.clone()));
                }
                _ => {}
            }
        }
        found.length = leg.gone_at(curve, &leg.to);
        found.places.push(leg.to.clone());
        match steps == settings.most_steps {
            true => ControlFlow::Break(None),
            false => ControlFlow::Continue(()),
        }
    });
    (found, end.ok().flatten())
}

fn described(
    mechanism: &Mechanism,
    (curve, method): (&mut Curve, &Continuation),
    input: Coordinate,
    traced: &[Found],
    i: usize,
) -> Circuit {
    const SAME: f64 = 1e-6;
    let found = &traced[i];
    let platforms: Vec<Course> = match input {
        Coordinate::Joint(_) => Vec::new(),
        _ => Coordinate::all(mechanism)
            .filter(|of| of.platform().is_some())
            .filter_map(|of| Course::of_platform(mechanism, (&mut *curve, method), found, of))
            .collect(),
    };
    let branches = match input {
        Coordinate::Joint(joint) => Course::of_joint(mechanism, joint, found).branches(),
        of => {
            (platforms.iter().find(|course| course.of == of)).map_or(Vec::new(), Course::branches)
        }
    };
    let curve = &*curve;
    let joints: Vec<JointMotion> = (0..mechanism.joints().len())
        .filter(|joint| curve.column(*joint).is_some())
        .map(|joint| Course::of_joint(mechanism, joint, found).motion())
        .collect();
    let crossings = &found.crossings;
    let meets = |other: &Found| {
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
        platforms: platforms.iter().map(Course::motion).collect(),
        crossings: (crossings.iter())
            .map(|point| {
                let joints = point.at.joints.iter().enumerate();
                joints
                    .map(|(joint, x)| mechanism.as_given(joint, *x))
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
