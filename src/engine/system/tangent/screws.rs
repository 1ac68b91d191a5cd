//! Spaces of twists as screws with pitch.

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use super::neighbourhood::Neighbourhood;
use super::twists::Twist;
use crate::geometry::Vector3;
use crate::linear::{Decomposition, axis_aligned, dot, norm, orthonormal, remove};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};
use crate::number::Number;
use crate::number::sorting::sort_by;
use crate::number::tolerance::STILL;
use crate::number::tolerance::{RANK_TOLERANCE, ROUNDING};

/// The infinitesimal motions of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TwistSpace {
    /// The body: a platform, or a link by its frame.
    pub body: String,
    /// A basis: principal screws first, translations after them.
    pub screws: Vec<Screw>,
    /// The axes about which it spins in local freedoms, which the screws leave out.
    pub spins: Vec<Screw>,
}

/// A twist up to its size, in ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Screw {
    /// Unit vector along the axis, or along the translation.
    pub direction: [f64; 3],
    /// The point of the axis nearest to the origin of ground, in m; `None` for a translation.
    pub point: Option<[f64; 3]>,
    /// Advance in m/rad: zero for a rotation, `None` for a translation, whose pitch is infinite.
    pub pitch: Option<f64>,
}

/// The bodies whose motions are of interest: platforms, or else the links that closures join.
fn carriers(mechanism: &Mechanism) -> Vec<(Body, Frame)> {
    let platforms = 0..mechanism.platforms().len();
    let mut carriers: Vec<(Body, Frame)> = platforms
        .map(|platform| (Body::Platform(platform), Frame::Platform { platform }))
        .collect();
    if carriers.is_empty() {
        let frames = mechanism
            .closures()
            .iter()
            .flat_map(|closure| closure.frames);
        let tips = (0..mechanism.chains().len()).map(|chain| Frame::Tip { chain });
        let open = tips.filter(|_| mechanism.closures().is_empty());
        let mut known = HashSet::from([Body::Ground]);
        for frame in frames.chain(open) {
            let body = mechanism.body(frame);
            if !mechanism.is_added(body) && known.insert(body) {
                carriers.push((body, frame));
            }
        }
    }
    carriers
}

impl Neighbourhood<'_> {
    /// The twists of the platforms, or else of links that closures join, without spins in the local freedoms `idle`.
    pub fn twist_spaces(
        &self,
        at: &Configuration<f64>,
        motions: &[Vec<f64>],
        idle: &[Vec<f64>],
    ) -> Vec<TwistSpace> {
        let mechanism = self.mechanism();
        let length = mechanism.characteristic_length();
        let frames = self.frames();
        let placement = frames.placed(at);
        let places = frames.places();
        let spaces = carriers(mechanism).into_iter().map(|(body, frame)| {
            let place = *places.get(&frame).expect("every frame is planned");
            let origin = frames.origin(place, &placement);
            let at_ground = |omega: Vector3<f64>, velocity: Vector3<f64>| {
                Twist { omega, velocity }
                    .at_ground(&origin, length)
                    .to_vec()
            };
            let lines = spin_lines(
                idle.iter()
                    .map(|m| frames.twist(place, &placement, m).omega),
            );
            let twists: Vec<Vec<f64>> = (motions.iter())
                .map(|motion| {
                    let twist = frames.twist(place, &placement, motion);
                    at_ground(without(&twist.omega, &lines), twist.velocity)
                })
                .collect();
            let spins = lines.iter().map(|line| at_ground(*line, Vector3::zero()));
            TwistSpace {
                body: mechanism.body_name(body),
                screws: principal_screws(mechanism, &twists),
                spins: principal_screws(mechanism, &spins.collect::<Vec<_>>()),
            }
        });
        spaces.collect()
    }
}

/// Orthonormal directions of the axes about which a frame spins at the given angular velocities.
pub fn spin_lines(omegas: impl Iterator<Item = Vector3<f64>>) -> Vec<Vector3<f64>> {
    let omegas: Vec<Vec<f64>> = omegas.map(|omega| omega.0.to_vec()).collect();
    let lines = orthonormal(&omegas, STILL).into_iter();
    lines.map(|w| Vector3([w[0], w[1], w[2]])).collect()
}

/// An angular velocity without the spins about orthonormal directions.
pub fn without<T: Number>(omega: &Vector3<T>, spins: &[Vector3<f64>]) -> Vector3<T> {
    let lines = spins.iter().map(|line| line.map(T::from_f64));
    let along = lines.map(|line| line.times(line.dot(omega)));
    along.fold(*omega, |left, part| left - part)
}

/// Principal screws of wrenches (f; m/L) about the centre, along the force or else the moment.
pub fn wrench_screws(mechanism: &Mechanism, wrenches: &[Vec<f64>]) -> Vec<Screw> {
    principal_screws(mechanism, wrenches)
}

/// Principal screws of a space of twists (ω; v/L) at the centre, then its translations.
///
/// Twists are made unique by taking the part of v that is orthogonal to the translations; the pitch ω·v/ω·ω is then a
/// quadratic form on the space of the ω, and its eigenvectors are the principal screws (Ball 1900; Hunt 1978).
fn principal_screws(mechanism: &Mechanism, twists: &[Vec<f64>]) -> Vec<Screw> {
    let mut space = axis_aligned(twists);
    for twist in &mut space {
        // its axis would be a million lengths away: a translation
        if norm(&twist[..3]) < STILL * norm(&twist[3..]) {
            twist[..3].fill(0.0);
        }
    }
    let omegas: Vec<Vec<f64>> = space.iter().map(|t| t[..3].to_vec()).collect();
    let rotations = axis_aligned(&omegas);
    let turning = Decomposition::of(3, omegas.len(), &omegas.concat());
    let velocity = |weights: &Vec<f64>| -> Vec<f64> {
        let sum = |k: usize| space.iter().zip(weights).map(|(t, w)| t[k] * w).sum();
        (3..6).map(sum).collect()
    };
    // combinations without rotation
    let still: Vec<Vec<f64>> = turning.null_space().iter().map(velocity).collect();
    let translations = axis_aligned(&still);
    let translation_basis = orthonormal(&translations, RANK_TOLERANCE);
    let rotation_basis = orthonormal(&rotations, RANK_TOLERANCE);
    let velocities: Vec<Vec<f64>> = (rotation_basis.iter())
        .map(|omega| {
            let mut velocity = velocity(&turning.solve(omega));
            remove(&mut velocity, &translation_basis);
            velocity
        })
        .collect();
    let mut screws = rotations_of(mechanism, &rotation_basis, &velocities);
    screws.extend(translations.iter().map(|t| {
        let unit = Vector3([t[0], t[1], t[2]]).times(1.0 / norm(t));
        Screw {
            direction: clean(pointing(unit).0, 1.0),
            point: None,
            pitch: None,
        }
    }));
    screws
}

/// The principal screws that turn, the one of least pitch first.
fn rotations_of(
    mechanism: &Mechanism,
    rotation_basis: &[Vec<f64>],
    velocities: &[Vec<f64>],
) -> Vec<Screw> {
    let length = mechanism.characteristic_length();
    let size = rotation_basis.len();
    if size == 0 {
        return Vec::new();
    }
    let pitches = nalgebra::DMatrix::from_fn(size, size, |i, j| {
        let ahead = dot(&rotation_basis[i], &velocities[j]);
        let back = dot(&rotation_basis[j], &velocities[i]);
        let pitch = 0.5 * (ahead + back);
        // equal pitches must not turn the axes
        if pitch.abs() < RANK_TOLERANCE {
            0.0
        } else {
            pitch
        }
    });
    let eigen = pitches.symmetric_eigen();
    let mut screws: Vec<Screw> = (0..size)
        .map(|k| {
            let combine = |parts: &[Vec<f64>]| {
                let mut sum = Vector3::zero();
                for (j, part) in parts.iter().enumerate() {
                    let weight = eigen.eigenvectors[(j, k)];
                    sum += Vector3([part[0], part[1], part[2]]).times(weight);
                }
                sum
            };
            let (omega, velocity) = (combine(rotation_basis), combine(velocities));
            let point = mechanism.foot(omega.cross(&velocity).times(length), &omega);
            let pitch = omega.dot(&velocity) * length;
            Screw {
                direction: clean(pointing(omega).0, 1.0),
                point: Some(clean(point.0, length)),
                pitch: Some(clean([pitch; 3], length)[0]),
            }
        })
        .collect();
    sort_by(&mut screws, |a, b| {
        let pitch = |screw: &Screw| screw.pitch.unwrap_or(f64::INFINITY);
        pitch(a).abs().total_cmp(&pitch(b).abs())
    });
    screws
}

/// The direction or its opposite, the largest component positive.
fn pointing(v: Vector3<f64>) -> Vector3<f64> {
    let largest = v.0.iter().fold(
        0.0,
        |m: f64, &x| if x.abs() > m.abs() + ROUNDING { x } else { m },
    );
    if largest < 0.0 { -v } else { v }
}

fn clean(v: [f64; 3], size: f64) -> [f64; 3] {
    v.map(|x| if x.abs() < ROUNDING * size { 0.0 } else { x })
}
