//! Position of the axes of prismatic joints.
//!
//! A prismatic axis has no place, so it is put where it makes the table simplest (after Paul 1981,
//! "the origin for a prismatic joint is coincident with the next defined link origin"):
//!
//! 1. on the next axis that has a place, if it is parallel to that one;
//! 2. else on the previous axis that has a place, if it is parallel to that one;
//! 3. else through the origin on the next axis, or behind the last revolute joint through the tool's
//!    origin if it then meets the previous axis, or else through the origin on the previous axis.
//!    Where that origin is free too, it is put where offsets become zero.
//!
//! Several prismatic joints in a row follow one another so that their offsets are zero.

use super::{NEARLY_PARALLEL, SerialAxes};
use crate::geometry::{Line, Vector3};

/// Places the run of prismatic axes that begins with index `first`, if there is one. `near` is where
/// the axis before them is left if its own offset is zero; without one, the place of the base.
/// Returns where the first of them starts if all offsets are to be zero and that is not `near`.
pub(super) fn place(
    axes: &SerialAxes,
    lines: &mut [Line],
    first: usize,
    near: Vector3<f64>,
    length: f64,
) -> Option<Vector3<f64>> {
    let slides = axes.joints[first..].iter();
    let end = first + slides.take_while(|joint| joint.is_prismatic()).count();
    let (mut from, mut to) = (first, end);
    if let Some(next) = lines.get(end).copied() {
        while to > from && parallel(&lines[to - 1], &next, length) {
            lines[to - 1].point = next.point;
            to -= 1;
        }
    }
    if let Some(previous) = first.checked_sub(1).map(|k| lines[k]) {
        while from < to && parallel(&lines[from], &previous, length) {
            lines[from].point = previous.point;
            from += 1;
        }
    }
    let step = |k: usize| lines[k].direction.times(axes.joints[k].home_motion().1);
    let steps: Vec<Vector3<f64>> = (from..to).map(step).collect();
    let further = steps.iter().skip(1);
    let after_first = further.fold(Vector3::zero(), |sum, &step| sum + step);
    if end < lines.len() {
        let whole = steps.iter().fold(near, |sum, &step| sum + step);
        let previous = from.checked_sub(1).map(|k| lines[k]);
        let mut point = match (defined_origin(axes, lines, to, length), previous) {
            (Some(origin), _) => origin,
            (None, Some(previous)) if from < to => {
                let along = lines[from].direction;
                free_origin(&previous, &near, &along, &after_first, &lines[to])
            }
            (None, _) => lines[to].foot(&whole),
        };
        for k in (from..to).rev() {
            lines[k].point = point;
            point = point - steps[k - from];
        }
        return (from == first && from < to).then_some(point);
    }
    let through_tool = |line: &Line| {
        let through = axes.tool?.position - after_first;
        let tool = Line::new(through, lines.get(from)?.direction)?;
        let normal = line.common_normal(&tool, length);
        normal.relation.meets().then_some(normal.feet[0])
    };
    let previous = from.checked_sub(1).map(|k| lines[k]);
    let mut point = previous.as_ref().and_then(through_tool).unwrap_or(near);
    for k in from..to {
        lines[k].point = point;
        point += steps[k - from];
    }
    None
}

fn parallel(a: &Line, b: &Line, length: f64) -> bool {
    a.common_normal(b, length).relation.is_parallel()
}

/// The origin on axis k where the normal to the axis behind it fixes it.
fn defined_origin(
    axes: &SerialAxes,
    lines: &[Line],
    k: usize,
    length: f64,
) -> Option<Vector3<f64>> {
    let next = axes.joints.get(k + 1);
    next.filter(|joint| !joint.is_prismatic())?;
    let normal = lines[k].common_normal(&lines[k + 1], length);
    let sine = lines[k].direction.cross(&lines[k + 1].direction).norm();
    (!normal.relation.is_parallel() && sine > NEARLY_PARALLEL).then_some(normal.feet[0])
}

/// A free origin P on the next axis: the slide's axis through P − `rest` either meets the previous
/// axis, or stands off from it at the point `near`, where the offset is zero.
///
/// Seen along the slide both axes are lines in a plane. Where they cross at more than 45° they meet;
/// else the perpendicular to the previous one at `near` crosses the next one well.
fn free_origin(
    previous: &Line,
    near: &Vector3<f64>,
    slide: &Vector3<f64>,
    rest: &Vector3<f64>,
    next: &Line,
) -> Vector3<f64> {
    let seen = |v: Vector3<f64>| v - slide.times(v.dot(slide));
    let (u, v) = (seen(previous.direction), seen(next.direction));
    let between = seen(*near - (next.point - *rest));
    let (sine, cosine) = (slide.dot(&u.cross(&v)), u.dot(&v));
    let along = match sine.abs() > cosine.abs() {
        true => slide.dot(&u.cross(&between)) / sine,
        false if cosine != 0.0 => between.dot(&u) / cosine,
        // the next axis is seen as a point
        false => (*near + *rest - next.point).dot(&next.direction),
    };
    next.point + next.direction.times(along)
}
