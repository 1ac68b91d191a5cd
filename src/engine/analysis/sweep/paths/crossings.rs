//! Double points: crossings of paths with themselves and one another.

use super::{At, PathPoint, Tracer};
use crate::geometry::Vector3;
use crate::linear::{dot, norm};
use crate::number::tolerance::{ROUNDING, SAME, SOLVED};
use crate::number::{real, sorting::sort_by};
use crate::solve::Continuation;
use crate::system::Curve;

/// A configuration in which the point is there, and the number of its circuit.
type PathPassage = (At, usize);

/// A straight piece between two points of a path.
struct PathPiece {
    curve: usize,
    number: usize,
    ends: [Vector3<f64>; 2],
    low: [f64; 3],
    high: [f64; 3],
}

/// Double points of the paths over some curves; each curve comes with true if it closes.
pub(super) fn double_points(
    tracer: &mut Tracer,
    curve: &mut Curve,
    method: &Continuation,
    curves: &[(&[At], bool)],
) -> Vec<PathPoint> {
    let mut pieces: Vec<PathPiece> = Vec::new();
    for (number, (places, _)) in curves.iter().enumerate() {
        let points: Vec<_> = places.iter().map(|p| tracer.position(&p.at)).collect();
        for (i, pair) in points.windows(2).enumerate() {
            let ends = [pair[0], pair[1]];
            let chord = (ends[1] - ends[0]).norm();
            if chord < ROUNDING * tracer.length {
                continue;
            }
            // the path lies no farther off its chord than 0.3 of it
            let slack = 0.3 * chord;
            let [a, b] = ends.map(|end| end.0);
            pieces.push(PathPiece {
                curve: number,
                number: i,
                ends,
                low: std::array::from_fn(|k| a[k].min(b[k]) - slack),
                high: std::array::from_fn(|k| a[k].max(b[k]) + slack),
            });
        }
    }
    sort_by(&mut pieces, |a, b| a.low[0].total_cmp(&b.low[0]));
    let mut found: Vec<(Vector3<f64>, Vec<PathPassage>)> = Vec::new();
    for (i, a) in pieces.iter().enumerate() {
        let near = pieces[i + 1..].iter().take_while(|b| b.low[0] <= a.high[0]);
        for b in near {
            let apart = (1..3).any(|k| a.low[k] > b.high[k] || b.low[k] > a.high[k]);
            let (places, closed) = curves[a.curve];
            let steps = a.number.abs_diff(b.number);
            let beside = a.curve == b.curve && (steps <= 1 || closed && steps + 2 >= places.len());
            if apart || beside {
                continue;
            }
            let Some([first, second]) = crossing(tracer, curve, method, curves, [a, b]) else {
                continue;
            };
            let position = tracer.position(&first.at);
            let same = |other: &Vector3<f64>| (*other - position).norm() < SAME * tracer.length;
            let place = found.iter().position(|(other, _)| same(other));
            let place = place.unwrap_or_else(|| {
                found.push((position, Vec::new()));
                found.len() - 1
            });
            for passage in [(first, a.curve + 1), (second, b.curve + 1)] {
                let known = found[place].1.iter().any(|(other, _)| {
                    norm(&curve.difference_but_turns(&other.at, &passage.0.at)) < SAME
                });
                if !known {
                    found[place].1.push(passage);
                }
            }
        }
    }
    let mut reported: Vec<PathPoint> = (found.iter_mut())
        .filter(|(_, passages)| passages.len() > 1)
        .map(|(_, passages)| {
            sort_by(passages, |(a, i), (b, j)| {
                let joints = a.at.joints.partial_cmp(&b.at.joints);
                i.cmp(j).then(joints.unwrap_or(std::cmp::Ordering::Equal))
            });
            let passages: Vec<(&At, usize)> = passages.iter().map(|(p, n)| (p, *n)).collect();
            tracer.passed(&passages)
        })
        .collect();
    sort_by(&mut reported, |a, b| {
        let order = a.position.partial_cmp(&b.position);
        order.unwrap_or(std::cmp::Ordering::Equal)
    });
    reported
}

/// The configurations on two pieces in which the point is in one place, with different tangents of its
/// path, by Newton's method.
fn crossing(
    tracer: &mut Tracer,
    curve: &mut Curve,
    method: &Continuation,
    curves: &[(&[At], bool)],
    pieces: [&PathPiece; 2],
) -> Option<[At; 2]> {
    const STEPS: usize = 20;
    let from = pieces.map(|piece| &curves[piece.curve].0[piece.number]);
    let ends = pieces.map(|piece| &curves[piece.curve].0[piece.number + 1]);
    let lengths: [f64; 2] = std::array::from_fn(|k| {
        dot(
            &curve.difference_but_turns(&from[k].at, &ends[k].at),
            &from[k].tangent,
        )
    });
    // where the chords are nearest
    let chords = pieces.map(|piece| piece.ends[1] - piece.ends[0]);
    let gap = pieces[1].ends[0] - pieces[0].ends[0];
    let [s, t] = nearest(&chords, &gap, 1e-12)?;
    let within = |x: f64| x > -1.0 && x < 2.0;
    if !within(s) || !within(t) {
        return None;
    }
    let mut along = [
        s.clamp(0.0, 1.0) * lengths[0],
        t.clamp(0.0, 1.0) * lengths[1],
    ];
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let mut places = Vec::with_capacity(2);
        for k in 0..2 {
            places.push(method.across(curve, from[k], along[k])?);
        }
        let gap = tracer.position(&places[1].at) - tracer.position(&places[0].at);
        let gap = gap.times(1.0 / tracer.length);
        let rates = [0, 1].map(|k: usize| {
            let turned = dot(&places[k].tangent, &from[k].tangent);
            tracer.velocity(&places[k]).times(1.0 / turned)
        });
        let step = nearest(&rates, &gap, SAME)?;
        let size = real::hypot(step[0], step[1]);
        if size < 1e-13 || (size < 1e-10 && size >= 0.5 * before) {
            let inside = (0..2).all(|k| {
                let part = along[k] / lengths[k];
                // a crossing may lie a tenth of a step outside it
                (-0.1..=1.1).contains(&part)
            });
            let apart = norm(&curve.difference_but_turns(&places[0].at, &places[1].at));
            let met = inside && gap.norm() < SOLVED && apart > SAME;
            let [first, second]: [At; 2] = places.try_into().ok()?;
            return met.then_some([first, second]);
        }
        if size > 4.0 * before || !size.is_finite() {
            return None;
        }
        before = size;
        for k in 0..2 {
            along[k] += step[k];
            if !(-1.0..=2.0).contains(&(along[k] / lengths[k])) {
                return None;
            }
        }
    }
    None
}

/// The parameters of the points of two lines that are nearest: s a₀ − t a₁ = gap in the least squares;
/// none where they are as good as parallel.
fn nearest([a, b]: &[Vector3<f64>; 2], gap: &Vector3<f64>, least: f64) -> Option<[f64; 2]> {
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let determinant = aa * bb - ab * ab;
    // a NaN is refused too
    let crosses = determinant > least * least * aa * bb;
    crosses.then(|| {
        let (ag, bg) = (a.dot(gap), b.dot(gap));
        [
            (bb * ag - ab * bg) / determinant,
            (ab * ag - aa * bg) / determinant,
        ]
    })
}
