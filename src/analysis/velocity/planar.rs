//! What only planar mechanisms have: transmission angles and instant centres.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use crate::geometry::Vector3;
use crate::mechanism::{Body, Configuration, Frame, Mechanism};
use crate::system::{
    Drive, FrameTwists, Holdable, LoopPart, MechanismLoop, Motion, Neighbourhood, Twist, loops,
};

/// How well a driven joint moves the output link of a loop in a plane.
///
/// The coupler passes a force along the line between its hinges. Its *pressure angle* is the one
/// between that line and the way the output link moves at their hinge; the *transmission angle* is
/// 90° less that, at a rocker the acute angle between coupler and rocker (Alt 1932).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Transmission {
    /// The closure of the loop.
    pub closure: String,
    /// The joint that drives: one that is held, or that another loop settles.
    pub driven: String,
    /// The joint by which the output link is held.
    pub output: String,
    /// The joint between coupler and output link.
    pub between: String,
    /// Transmission angle, in rad, from 0 to π/2.
    pub transmission_angle: f64,
    /// Pressure angle, in rad.
    pub pressure_angle: f64,
}

/// The point about which a body turns beside another, at the instant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InstantCentre {
    /// The two bodies.
    pub bodies: [String; 2],
    /// The point, in m, in the plane through the origin of ground; `None` if it is at infinity.
    pub point: Option<[f64; 3]>,
    /// Unit vector towards it if it is at infinity: across the relative motion.
    pub at_infinity: Option<[f64; 3]>,
}

/// What counts as zero beside one, dimensionless.
const ZERO: f64 = 1e-9;

/// Beyond so many bodies only the centres beside the ground are listed.
const MANY_BODIES: usize = 12;

/// Of each loop in which three joints are left when the held ones, and those that other such loops
/// settle, are given: the dyads of which planar linkages are built up.
pub(super) fn transmission(
    near: &mut Neighbourhood,
    at: &Configuration<f64>,
    held: &[Holdable],
) -> Vec<Transmission> {
    let length = near.mechanism().characteristic_length();
    let found = loops(near, at);
    let is_held = |part: &&LoopPart| {
        let [joint] = part.joints[..] else {
            return false;
        };
        part.twists.len() == 1 && held.contains(&Holdable::Joint(joint))
    };
    let parts = found.iter().flat_map(|one| &one.parts);
    let mut known: Vec<Vec<String>> = parts.filter(is_held).map(|p| p.names.clone()).collect();
    let mut angles: Vec<Option<Vec<Transmission>>> = vec![None; found.len()];
    let dyad = |one: &MechanismLoop, known: &[Vec<String>]| {
        let free = one.parts.iter().filter(|part| !known.contains(&part.names));
        free.clone().count() == 3 && free.clone().all(|part| part.twists.len() == 1)
    };
    while let Some(i) = (0..found.len()).find(|&i| angles[i].is_none() && dyad(&found[i], &known)) {
        angles[i] = Some(of_loop(&found[i], &known, length));
        known.extend(found[i].parts.iter().map(|part| part.names.clone()));
    }
    angles.into_iter().flatten().flatten().collect()
}

/// The known joints of a loop that has three others, each with whether these follow forwards:
/// one that is alone drives the link beyond it, the ends of several the links towards the others,
/// unless that is the ground.
fn drivers(found: &MechanismLoop, known: &[Vec<String>]) -> Vec<(usize, bool)> {
    let parts = &found.parts;
    let count = parts.len();
    let is_known = |i: usize| known.contains(&parts[i % count].names);
    let mut drivers = Vec::new();
    for i in (0..count).filter(|&i| is_known(i)) {
        let [before, after] = [is_known(i + count - 1), is_known(i + 1)];
        let moves = |forwards: bool| {
            let beyond = if forwards { i + 1 } else { i };
            found.bodies[beyond % count] != Body::Ground
        };
        match (before, after) {
            (true, true) => {}
            (false, false) => drivers.push((i, found.bodies[i] == parts[i].bodies[0])),
            (true, false) if moves(true) => drivers.push((i, true)),
            (false, true) if moves(false) => drivers.push((i, false)),
            _ => {}
        }
    }
    drivers
}

fn of_loop(found: &MechanismLoop, known: &[Vec<String>], length: f64) -> Vec<Transmission> {
    let Some(normal) = normal(found.parts.iter().flat_map(|part| &part.twists)) else {
        return vec![];
    };
    let parts = &found.parts;
    let driven = drivers(found, known)
        .into_iter()
        .filter_map(|(i, forwards)| {
            let others = (1..parts.len()).map(|k| &parts[(i + k) % parts.len()]);
            let mut others: Vec<&LoopPart> =
                others.filter(|part| !known.contains(&part.names)).collect();
            if !forwards {
                others.reverse();
            }
            let hinge = |part: &LoopPart| {
                let (omega, velocity) = split(&part.twists[0]);
                let speed = omega.dot(&omega);
                (speed > ZERO).then(|| omega.cross(&velocity).times(length / speed))
            };
            let (first, second) = (hinge(others[0])?, hinge(others[1])?);
            let force = second - first;
            let motion = match hinge(others[2]) {
                Some(post) => normal.cross(&(second - post)),
                None => split(&others[2].twists[0]).1,
            };
            let sizes = force.norm() * motion.norm();
            if sizes <= ZERO * length * motion.norm().max(ZERO) {
                return None;
            }
            let along = force.dot(&motion).abs();
            let across = force.cross(&motion).norm();
            let pressure_angle = across.atan2(along);
            Some(Transmission {
                closure: found.closure.clone(),
                driven: parts[i].names[0].clone(),
                output: others[2].names[0].clone(),
                between: others[1].names[0].clone(),
                transmission_angle: FRAC_PI_2 - pressure_angle,
                pressure_angle,
            })
        });
    driven.collect()
}

fn split(twist: &[f64; 6]) -> (Vector3<f64>, Vector3<f64>) {
    let [a, b, c, x, y, z] = *twist;
    (Vector3([a, b, c]), Vector3([x, y, z]))
}

/// The unit normal of the plane in which all twists (ω; v/L) move; `None` if there is none.
fn normal<'a>(twists: impl Iterator<Item = &'a [f64; 6]> + Clone) -> Option<Vector3<f64>> {
    let size = |twist: &[f64; 6]| twist.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = twists.clone().map(size).fold(0.0, f64::max);
    let turning = twists.clone().map(|twist| split(twist).0);
    let most = turning.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    if most.norm() <= ZERO * largest {
        return None;
    }
    let normal = most.times(1.0 / most.norm());
    let in_plane = |twist: &[f64; 6]| {
        let (omega, velocity) = split(twist);
        let across = omega.cross(&normal).norm();
        across.max(velocity.dot(&normal).abs()) <= ZERO * largest
    };
    let mut twists = twists;
    twists.all(in_plane).then_some(normal)
}

/// Instant centres for the rates given; without any for the one input there is.
pub(super) fn centres(
    mechanism: &Mechanism,
    motion: &mut Motion,
    at: &Configuration<f64>,
    drive: &Drive,
) -> Vec<InstantCentre> {
    let rates = match (
        drive.rates.iter().any(|rate| *rate != 0.0),
        drive.rates.len(),
    ) {
        (true, _) => drive.rates.clone(),
        (false, 1) => vec![1.0],
        _ => return vec![],
    };
    let rates = motion.rates(&rates).to_vec();
    let bodies = mechanism.bodies();
    let frames: Vec<Frame> = bodies
        .iter()
        .map(|&body| mechanism.body_frame(body))
        .collect();
    let twists = FrameTwists::new(mechanism.dimensions(), motion.unknowns(), &frames);
    let mut placement = twists.placement();
    twists.place(at, &mut placement);
    let length = mechanism.characteristic_length();
    let at_origin = |i: usize, rates: &[f64]| {
        let Twist { omega, velocity } = twists.twist(i, &placement, rates);
        let velocity = velocity - omega.cross(&twists.origin(i, &placement));
        let ([a, b, c], [x, y, z]) = (omega.0, velocity.times(1.0 / length).0);
        [a, b, c, x, y, z]
    };
    let at_input: Vec<[f64; 6]> = (0..frames.len()).map(|i| at_origin(i, &rates)).collect();
    // planar for a moment only is not enough: every joint and every input must keep the plane
    let mut all = at_input.clone();
    let joints = (0..mechanism.joints().len()).map(|joint| {
        let mut rates = vec![0.0; rates.len()];
        rates[joint] = 1.0;
        rates
    });
    let alone: Vec<Vec<f64>> = joints.collect();
    let inputs = (0..drive.rates.len()).map(|input| {
        let mut given = vec![0.0; drive.rates.len()];
        given[input] = 1.0;
        motion.rates(&given).to_vec()
    });
    for rates in inputs.chain(alone) {
        all.extend((0..frames.len()).map(|i| at_origin(i, &rates)));
    }
    if normal(all.iter()).is_none() {
        return vec![];
    }
    let largest = at_input
        .iter()
        .flatten()
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut centres = Vec::new();
    for i in 0..bodies.len() {
        for j in i + 1..bodies.len() {
            if bodies.len() > MANY_BODIES && bodies[i] != Body::Ground {
                continue;
            }
            let relative: [f64; 6] = std::array::from_fn(|k| at_input[j][k] - at_input[i][k]);
            let (omega, velocity) = split(&relative);
            let (point, at_infinity) = if omega.norm() > ZERO * largest {
                let speed = omega.dot(&omega);
                (Some(omega.cross(&velocity).times(length / speed)), None)
            } else if velocity.norm() > ZERO * largest {
                let plane = normal(at_input.iter()).unwrap_or(Vector3::unit(2));
                let across = plane.cross(&velocity);
                (None, Some(across.times(1.0 / across.norm())))
            } else {
                // the two move as one
                continue;
            };
            centres.push(InstantCentre {
                bodies: [bodies[i], bodies[j]].map(|body| mechanism.body_name(body)),
                point: point.map(|p| p.0),
                at_infinity: at_infinity.map(|v| v.0),
            });
        }
    }
    centres
}
