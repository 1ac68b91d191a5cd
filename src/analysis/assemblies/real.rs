//! The real ones among the ends of the paths.

use super::coordinates::{C, Coordinates, size};
use crate::geometry::RollPitchYaw;
use crate::mechanism::{Configuration, Mechanism};
use crate::number::Number;
use crate::solve::{Equations, Newton, Stop};
use crate::system::{System, Work};

use super::report::{Named, PoseReport};

/// The real configuration at a complex solution, refined; `None` if it is not real.
///
/// `singular` ends are known to the accuracy of the endgame only, and Newton's method cannot
/// improve them.
pub(super) fn real_solution(
    x: &[C],
    singular: bool,
    coordinates: &Coordinates,
    system: &System<f64>,
    work: &mut Work<f64>,
    asked: &Configuration<f64>,
) -> Option<Configuration<f64>> {
    let scale = 1.0 + size(x);
    let imaginary = x.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
    if imaginary > 1e-5 * scale {
        return None;
    }
    let mut lifted = asked.map(C::from_f64);
    coordinates.unflatten(x, &mut lifted);
    let mut point = lifted.map(|z| z.re);
    for &p in &coordinates.free_platforms {
        point.platforms[p].orientation = point.platforms[p].orientation.normalised();
    }
    if singular {
        return (system.residual(&point, work).largest < 1e-7).then(|| tidied(point, coordinates));
    }
    let mut trial = point.clone();
    let report = Newton::default().solve(system, &mut point, &mut trial, work);
    let reached = coordinates.flatten(&point.map(C::from_f64));
    let near = coordinates.difference(x, &reached) <= 2e-5 * scale;
    (report.stop == Stop::Solved && near).then(|| tidied(point, coordinates))
}

/// Angles in (−π, π], quaternions with their first component that is not zero positive.
fn tidied(mut point: Configuration<f64>, coordinates: &Coordinates) -> Configuration<f64> {
    use std::f64::consts::{PI, TAU};
    for &j in &coordinates.free_joints {
        let value = &mut point.joints[j];
        if coordinates.periodic[j] {
            *value -= TAU * (*value / TAU).round();
            // −π and π are one angle: rounding must not decide which is printed
            if *value <= -PI + 1e-9 {
                *value += TAU;
            }
        }
    }
    for &p in &coordinates.free_platforms {
        let q = &mut point.platforms[p].orientation;
        let first = q.0.iter().copied().find(|x| x.abs() > 1e-9);
        if first.is_some_and(|x| x < 0.0) {
            q.0 = q.0.map(|x| -x);
        }
    }
    point
}

/// What solutions are numbered by: unknown joints in the order of the file, then position and
/// quaternion of each platform.
pub(super) fn key(point: &Configuration<f64>, coordinates: &Coordinates) -> Vec<f64> {
    let joints = coordinates
        .free_joints
        .iter()
        .map(|&j| point.joints[j] / coordinates.joint_scales[j]);
    let poses = coordinates.free_platforms.iter().flat_map(|&p| {
        let pose = &point.platforms[p];
        (pose.position.0.map(|x| x / coordinates.length).into_iter()).chain(pose.orientation.0)
    });
    joints.chain(poses).collect()
}

/// Ascending from the first coordinate on; values within 1e-7 of each other count as equal, so that
/// rounding does not decide.
pub(super) fn order(a: &[f64], b: &[f64]) -> std::cmp::Ordering {
    let different = a.iter().zip(b).find(|(a, b)| (*a - *b).abs() > 1e-7);
    different.map_or(std::cmp::Ordering::Equal, |(a, b)| a.total_cmp(b))
}

pub(super) fn named_joints(mechanism: &Mechanism, point: &Configuration<f64>) -> Named<f64> {
    let names = mechanism.joints().iter().map(|j| j.name.clone());
    Named(names.zip(point.joints.iter().copied()).collect())
}

pub(super) fn named_poses(mechanism: &Mechanism, point: &Configuration<f64>) -> Named<PoseReport> {
    let names = mechanism.platforms().iter().map(|p| p.name.clone());
    let poses = point.platforms.iter().map(|pose| {
        let RollPitchYaw { roll, pitch, yaw } =
            RollPitchYaw::from_rotation(&pose.orientation.rotation());
        PoseReport {
            position: pose.position.0,
            quaternion: pose.orientation.0,
            roll_pitch_yaw: [roll, pitch, yaw],
        }
    });
    Named(names.zip(poses).collect())
}
