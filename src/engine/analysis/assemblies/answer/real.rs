//! The real ones among the ends of the paths.

use crate::analysis::assemblies::family::{C, Coordinates, Input, size};
use crate::geometry::RollPitchYaw;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate};
use crate::number::tolerance::{CANCELLED, DOUBLE, ROUNDING, SAME};
use crate::number::{complex, real};
use crate::solve::{Equations, Newton, Stop};
use crate::system::{System, SystemWork};

use crate::analysis::assemblies::report::{ByName, PoseReport};

/// The real configuration at a complex solution, refined; `None` if it is not real.
///
/// A configuration is assembled when Newton's method calls it solved. So two conjugate complex
/// solutions are real, and one, if no more than that is left half way between them.
///
/// Newton's method cannot improve `singular` ends; they are refined already.
pub(crate) fn real_solution(
    x: &[C],
    singular: bool,
    coordinates: &Coordinates,
    system: &System<f64>,
    work: &mut SystemWork<f64>,
    asked: &Configuration<f64>,
) -> Option<Configuration<f64>> {
    let scale = 1.0 + size(x);
    let imaginary = x.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
    if imaginary > DOUBLE * scale {
        return None;
    }
    let mut point = coordinates.real_part(x, asked);
    // far away rounding leaves more
    let left = CANCELLED * scale / steepness(&point, coordinates);
    let newton = Newton {
        tolerance: Newton::default().tolerance.max(left),
        ..Newton::default()
    };
    if singular {
        let left = system.residual(&point, work).largest;
        return (left <= newton.tolerance).then(|| tidied(point, coordinates, false));
    }
    let mut trial = point.clone();
    let report = newton.solve(system, &mut point, &mut trial, work);
    let reached = coordinates.flat(&point);
    let near = coordinates.difference(x, &reached) <= 2e-5 * scale;
    (report.stop == Stop::Solved && near).then(|| tidied(point, coordinates, true))
}

/// The least cos(pitch) of platforms with a roll or yaw held: by it these angles, and their rows,
/// are turned more than the platform is.
fn steepness(point: &Configuration<f64>, coordinates: &Coordinates) -> f64 {
    let turned = coordinates.inputs.iter().filter_map(|input| match *input {
        Input::Target(p, PoseCoordinate::Roll | PoseCoordinate::Yaw) => Some(p),
        _ => None,
    });
    let steepest = turned.map(|p| real::cos(PoseCoordinate::Pitch.of(&point.platforms[p].pose())));
    steepest.fold(1.0, |least, cos| least.min(cos.abs()).max(f64::EPSILON))
}

/// Distance from −π within which an angle is reported as π. Where solutions meet, only half the digits are sure.
fn rounding(sure: bool) -> f64 {
    if sure { ROUNDING } else { SAME }
}

/// Angles in (−π, π], quaternions with their first component that is not zero positive. `sure`
/// where solutions do not meet.
pub(crate) fn tidied(
    mut point: Configuration<f64>,
    coordinates: &Coordinates,
    sure: bool,
) -> Configuration<f64> {
    let rounding = rounding(sure);
    for &j in &coordinates.free_joints {
        point.joints[j] = coordinates.principal(j, point.joints[j], rounding);
    }
    for &p in &coordinates.free_platforms {
        let q = &mut point.platforms[p].orientation;
        let first = q.0.iter().copied().find(|x| x.abs() > rounding);
        if first.is_some_and(|x| x < 0.0) {
            q.0 = q.0.map(|x| -x);
        }
    }
    point
}

/// Complex angles with their real part in (−π, π], complex quaternions with the first component
/// that is not zero on the right half of the complex plane.
pub(crate) fn tidied_complex(x: &[C], coordinates: &Coordinates) -> Vec<C> {
    let mut x = x.to_vec();
    for (z, &j) in x.iter_mut().zip(&coordinates.free_joints) {
        z.re = coordinates.principal(j, z.re, SAME);
    }
    for pose in x[coordinates.free_joints.len()..].chunks_exact_mut(7) {
        let first = pose[..4].iter().find(|z| complex::norm(**z) > SAME);
        let left = first.is_some_and(|z| match z.re.abs() > SAME {
            true => z.re < 0.0,
            false => z.im < 0.0,
        });
        if left {
            pose[..4].iter_mut().for_each(|z| *z = -*z);
        }
    }
    x
}

/// Key by which complex solutions are ordered: real and imaginary part of one unknown after the other,
/// in the order of [`key`].
pub(crate) fn complex_key(x: &[C]) -> Vec<f64> {
    x.iter().flat_map(|z| [z.re, z.im]).collect()
}

/// Key by which solutions are numbered: unknown joints in the order of the file, then position and
/// quaternion of each platform.
pub(crate) fn key(point: &Configuration<f64>, coordinates: &Coordinates) -> Vec<f64> {
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

/// Ascending from the first coordinate on; values within 1e-6 of the next ones count as equal, so that rounding does not
/// decide.
///
/// Comparing pairs in that manner would be no order: of three values the outer ones may differ although the middle one
/// equals both.
pub(crate) fn order<T>(found: &mut [T], key: impl Fn(&T) -> &[f64]) {
    order_from(0, found, &key);
}

fn order_from<T>(place: usize, found: &mut [T], key: &impl Fn(&T) -> &[f64]) {
    let at = |x: &T| key(x).get(place).copied();
    if found.len() < 2 || found.iter().any(|x| at(x).is_none()) {
        return;
    }
    let value = |x: &T| at(x).unwrap_or_default();
    found.sort_by(|a, b| value(a).total_cmp(&value(b)));
    for alike in found.chunk_by_mut(|a, b| value(b) - value(a) <= SAME) {
        order_from(place + 1, alike, key);
    }
}

/// Joint values by name, angles by the turn that is within their limits if one is.
pub(crate) fn named_joints(mechanism: &Mechanism, point: &Configuration<f64>) -> ByName<f64> {
    let mut all = mechanism.all_joints(point);
    for (j, (_, value)) in (0..mechanism.joints().len()).zip(&mut all.0) {
        *value = mechanism.by_limits(j, *value);
    }
    all
}

pub(crate) fn named_poses(
    mechanism: &Mechanism,
    point: &Configuration<f64>,
    sure: bool,
) -> ByName<PoseReport> {
    use std::f64::consts::{PI, TAU};
    let names = mechanism.platforms().iter().map(|p| p.name.clone());
    let poses = point.platforms.iter().map(|pose| {
        let RollPitchYaw { roll, pitch, yaw } =
            RollPitchYaw::from_rotation(&pose.orientation.rotation());
        let once = |angle: f64| match angle <= -PI + rounding(sure) {
            true => angle + TAU,
            false => angle,
        };
        PoseReport {
            position: mechanism.to_ground(pose.position).0,
            quaternion: pose.orientation.0,
            roll_pitch_yaw: [once(roll), pitch, once(yaw)],
        }
    });
    ByName(names.zip(poses).collect())
}
