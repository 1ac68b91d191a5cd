//! The common normal of consecutive axes, and the links that lead along it.

use super::NEARLY_PARALLEL;
use crate::geometry::{CommonNormal, Line, Pose, Relation, Rotation, Vector3};
use crate::linear::RANK_TOLERANCE;
use crate::number::real;
use crate::number::tolerance::SUMMED;

/// The common normal between two consecutive axes, with the choices made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// Relation of the axes; at the ends, where only one axis is, `None` if nothing given fixes the normal.
    pub relation: Option<Relation>,
    /// The angle in rad between the directions as given, in [0, π].
    pub angle: f64,
    /// The distance in m between the lines as given.
    pub distance: f64,
    /// Unit vector along the normal: x_k. Where axes are nearly parallel, along the line from the first foot to the second.
    pub x: Vector3<f64>,
    /// z at its start and at its end.
    pub z: [Vector3<f64>; 2],
    /// Its feet, on axis k and on axis k + 1.
    pub feet: [Vector3<f64>; 2],
}

impl Normal {
    /// A normal without length or twist.
    pub(super) fn nothing(x: Vector3<f64>, z: Vector3<f64>, at: Vector3<f64>) -> Self {
        Normal {
            relation: None,
            angle: 0.0,
            distance: 0.0,
            x,
            z: [z, z],
            feet: [at, at],
        }
    }

    pub(super) fn frame(&self, side: usize) -> Pose<f64> {
        let (x, z) = ([self.x, self.end()][side], self.z[side]);
        Pose {
            rotation: Rotation([x, z.cross(&x), z]),
            position: self.feet[side],
        }
    }

    /// y before and after the turn by β, which is about it.
    pub(super) fn y(&self) -> Vector3<f64> {
        let y = self.z[1].cross(&self.x);
        y.times(1.0 / y.norm())
    }

    /// x after the turn by β.
    pub(super) fn end(&self) -> Vector3<f64> {
        match self.relation {
            Some(Relation::NearlyParallel) => self.y().cross(&self.z[1]),
            _ => self.x,
        }
    }

    /// α, the angle from the first axis to the second about x, less β.
    pub(super) fn alpha(&self) -> f64 {
        let twisted = match self.relation {
            Some(Relation::NearlyParallel) => self.x.cross(&self.y()),
            _ => self.z[1],
        };
        angle_about(&self.x, &self.z[0], &twisted)
    }

    /// β, the angle about y that leads on to the second axis where axes are nearly parallel.
    pub(super) fn beta(&self) -> f64 {
        match self.relation {
            Some(Relation::NearlyParallel) => angle_about(&self.y(), &self.x, &self.end()),
            _ => 0.0,
        }
    }

    /// a, the length.
    pub(super) fn a(&self) -> f64 {
        (self.feet[1] - self.feet[0]).dot(&self.x)
    }
}

/// The angle from `u` to `v` about a unit vector perpendicular to both, in (−π, π].
pub(super) fn angle_about(axis: &Vector3<f64>, u: &Vector3<f64>, v: &Vector3<f64>) -> f64 {
    let angle = real::atan2(u.cross(v).dot(axis), u.dot(v));
    match angle {
        // rounding of a half turn must not change its sign
        _ if angle < -std::f64::consts::PI + SUMMED => -angle,
        _ => angle,
    }
}

/// A vector turned about a unit vector (Rodrigues).
pub(super) fn turned(v: &Vector3<f64>, about: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sin, cos) = crate::number::Number::sin_cos(angle);
    v.times(cos) + about.cross(v).times(sin) + about.times(about.dot(v) * (1.0 - cos))
}

/// The part of the first of these vectors perpendicular to `z` that is not lost, as a unit vector.
pub(super) fn perpendicular<const N: usize>(
    z: &Vector3<f64>,
    vectors: [Vector3<f64>; N],
) -> Vector3<f64> {
    let parts = vectors.map(|v| v - z.times(v.dot(z)));
    // of two orthogonal unit vectors at least one keeps half of itself
    let found = parts.iter().find(|part| part.norm() > 0.5);
    let part = found.copied().unwrap_or(parts[0]);
    part.times(1.0 / part.norm())
}

/// A common normal is far away from where the axes are beyond so many times the size of the chain.
const FAR: f64 = 10.0;

/// The link between axes that are parallel but for the digits of a file, whose common normal is far away: in the plane
/// normal to the first axis where d = 0, to where the second meets it.
///
/// Source: S. A. Hayati, M. Mirmirani, Improving the absolute positioning accuracy of robot manipulators, J. Robotic
/// Systems 2, 1985.
pub(super) fn nearly_parallel(
    x: Vector3<f64>,
    start: Vector3<f64>,
    next: &Line,
    common: &CommonNormal,
    (z, length): (Vector3<f64>, f64),
) -> Option<Normal> {
    let angle = common.angle.min(std::f64::consts::PI - common.angle);
    let away = (common.feet[0] - start).norm();
    if common.relation.is_parallel() || angle > NEARLY_PARALLEL || away <= FAR * length {
        return None;
    }
    let along = (start - next.point).dot(&z) / next.direction.dot(&z);
    let end = next.point + next.direction.times(along);
    let link = end - start;
    let apart = link.norm();
    Some(Normal {
        relation: Some(Relation::NearlyParallel),
        angle: common.angle,
        distance: common.distance,
        x: match apart > RANK_TOLERANCE * length {
            true => perpendicular(&z, [link.times(1.0 / apart)]),
            false => x,
        },
        z: [z, next.direction],
        feet: [start, end],
    })
}

/// The link that leads from a frame to a line along the frame's x axis: x meets the line at a right
/// angle and not behind the origin. `None` if there is none.
pub(super) fn link(
    x: &Vector3<f64>,
    z: &Vector3<f64>,
    origin: &Vector3<f64>,
    axis: &Line,
    length: f64,
) -> Option<Normal> {
    if axis.direction.dot(x).abs() > RANK_TOLERANCE {
        return None;
    }
    let foot = axis.foot(origin);
    // perpendicular to x and within the tolerance of the line
    let a = match (foot - *origin).dot(x) {
        a if a.abs() <= RANK_TOLERANCE * length => 0.0,
        a => a,
    };
    // the point of the axis nearest to the x axis: x and the axis meet there or nowhere
    let at = *origin + x.times(a);
    if a < 0.0 || axis.distance(&at) > RANK_TOLERANCE * length {
        return None;
    }
    let twist = angle_about(x, z, &axis.direction);
    let parallel = z.cross(&axis.direction).norm() <= RANK_TOLERANCE;
    let same = z.dot(&axis.direction) > 0.0;
    let (relation, direction) = match (parallel, same, a == 0.0) {
        (true, true, true) => (Relation::Coincident, *z),
        (true, true, false) => (Relation::Parallel, *z),
        (true, false, true) => (Relation::AntiCoincident, -*z),
        (true, false, false) => (Relation::AntiParallel, -*z),
        (false, _, true) => (Relation::Intersecting, turned(z, x, twist)),
        (false, _, false) => (Relation::Skew, turned(z, x, twist)),
    };
    Some(Normal {
        relation: Some(relation),
        angle: twist.abs(),
        distance: a,
        x: *x,
        z: [*z, direction],
        feet: [*origin, at],
    })
}
