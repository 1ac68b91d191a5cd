//! Where the axes of prismatic joints are put.
//!
//! A prismatic axis has no place, so it is put where it makes the table simplest (after Paul 1981,
//! "the origin for a prismatic joint is coincident with the next defined link origin"):
//!
//! 1. on the next axis that has a place, if it is parallel to that one;
//! 2. else on the previous axis that has a place, if it is parallel to that one;
//! 3. else through the origin on the next axis, or behind the last revolute joint through the tool's
//!    origin if it then meets the previous axis, or else through the origin on the previous axis.
//!
//! Several prismatic joints in a row follow one another so that their offsets are zero.

use super::SerialAxes;
use crate::geometry::{Line, Vector3};

/// The axes, with a place for each.
pub(super) fn place(axes: &SerialAxes, length: f64) -> Vec<Line> {
    let mut lines: Vec<Line> = axes.joints.iter().map(|joint| joint.line).collect();
    let mut end = lines.len();
    while let Some(last) = axes.joints[..end].iter().rposition(|joint| joint.is_prismatic()) {
        let before = axes.joints[..last].iter().rposition(|joint| !joint.is_prismatic());
        let first = before.map_or(0, |revolute| revolute + 1);
        place_run(axes, &mut lines, first, last + 1, length);
        end = first;
    }
    lines
}

fn parallel(a: &Line, b: &Line, length: f64) -> bool {
    a.common_normal(b, length).relation.is_parallel()
}

/// Places the axes `first..end`, all prismatic, between revolute ones.
fn place_run(axes: &SerialAxes, lines: &mut [Line], first: usize, end: usize, length: f64) {
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
    let step = |k: usize, lines: &[Line]| {
        let joint = &axes.joints[k];
        lines[k].direction.times(joint.slide * joint.home)
    };
    let start = axes.base.map_or(Vector3::zero(), |base| base.position);
    // a defined origin of the axis: the foot of the normal that it has with the neighbour behind
    // (`other` > k) or before it, else the point nearest to a given one
    let origin = |k: usize, other: Option<usize>, near: Vector3<f64>, lines: &[Line]| {
        let known = |o: usize| o < lines.len() && !axes.joints[o].is_prismatic();
        let normal = other
            .filter(|&o| known(o))
            .map(|o| lines[k].common_normal(&lines[o], length));
        match normal {
            Some(normal) if !normal.relation.is_parallel() => normal.feet[0],
            _ => lines[k].foot(&near),
        }
    };
    if end < lines.len() {
        let near = match from.checked_sub(1) {
            Some(k) => origin(k, k.checked_sub(1), start, lines),
            None => start,
        };
        let mut point = origin(to, Some(to + 1), near, lines);
        for k in (from..to).rev() {
            lines[k].point = point;
            point = point - step(k, lines);
        }
        return;
    }
    let mut point = match from.checked_sub(1) {
        None => start,
        Some(k) => {
            let tool = axes.tool.map(|tool| {
                (from + 1..to).fold(tool.position, |point, k| point - step(k, lines))
            });
            let through_tool = tool
                .filter(|_| from < to)
                .and_then(|tool| Line::new(tool, lines[from].direction))
                .map(|line| line.common_normal(&lines[k], length))
                .filter(|normal| normal.relation.meets());
            match through_tool {
                Some(normal) => normal.feet[1],
                None => origin(k, k.checked_sub(1), tool.unwrap_or(start), lines),
            }
        }
    };
    for k in from..to {
        lines[k].point = point;
        point += step(k, lines);
    }
}
