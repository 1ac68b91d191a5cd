//! Straightness of a path.

use serde::{Deserialize, Serialize};

use crate::linear::{Svd, dot};
use crate::number::tolerance::{ROUNDING, SUMMED};
use crate::number::{real, sorting::sort_by};
use crate::solve::summit;

/// The straight line nearest to a path over a motion, and the largest distance from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Straightness {
    /// The point whose path it is.
    pub point: String,
    /// A point of the line, in ground, in m.
    pub through: [f64; 3],
    /// The line's direction: a unit vector.
    pub direction: [f64; 3],
    /// Length of the path along the line, in m.
    pub length: f64,
    /// Largest distance of the path from the line, in m.
    pub deviation: f64,
    /// True if it may be farther, since not all of the curve could be examined.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub at_least: bool,
}

/// The position of a point at a place of a motion.
type PointAt<'f> = dyn FnMut(f64) -> Option<[f64; 3]> + 'f;

impl Straightness {
    /// Straightness of a path through places near to one another. Those where it is farthest from its line, sought
    /// between those known,
    /// join these until none is farther than they are: an exchange after Remez, for a line with both offset and direction free.
    pub(crate) fn along(
        point: &str,
        mut known: Vec<(f64, [f64; 3])>,
        at: &mut PointAt,
    ) -> Option<Self> {
        const ROUNDS: usize = 24;
        for _ in 0..ROUNDS {
            let places: Vec<[f64; 3]> = known.iter().map(|(_, place)| *place).collect();
            let line = Straightness::of(point, &places)?;
            let (begin, end) = places
                .iter()
                .map(|place| line.apart(place)[0])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                    (low.min(x), high.max(x))
                });
            // how far off, and how far beyond either end
            let beyond = |place: &[f64; 3]| {
                let [along, off] = line.apart(place);
                [off - line.deviation, along - end, begin - along]
            };
            let mut more = Vec::new();
            for i in 1..known.len().saturating_sub(1) {
                let [a, b, c] = [i - 1, i, i + 1].map(|i| beyond(&known[i].1));
                let (from, to) = (known[i - 1].0, known[i + 1].0);
                for k in 0..3 {
                    let near = b[k] > -0.5 * line.deviation.max(1e-3 * line.length);
                    if !near || b[k] < a[k] || b[k] < c[k] || to - from < ROUNDING {
                        continue;
                    }
                    let top = summit(from, to, |place| Some(beyond(&at(place)?)[k]));
                    if let Some((place, height)) = top
                        && height > SUMMED * line.length
                        && let Some(found) = at(place)
                    {
                        more.push((place, found));
                    }
                }
            }
            if more.is_empty() {
                return Some(line);
            }
            known.extend(more);
            sort_by(&mut known, |a, b| a.0.total_cmp(&b.0));
        }
        let places: Vec<[f64; 3]> = known.iter().map(|(_, place)| *place).collect();
        Straightness::of(point, &places)
    }

    /// Position of a place along the line, from the point it goes through, and its distance from the line, in m.
    fn apart(&self, place: &[f64; 3]) -> [f64; 2] {
        let from: [f64; 3] = std::array::from_fn(|k| place[k] - self.through[k]);
        let along = dot(&from, &self.direction);
        let off = (0..3).map(|k| from[k] - along * self.direction[k]);
        [along, off.map(|x| x * x).sum::<f64>().sqrt()]
    }

    /// Straightness of places of a path; none if there is no more than one. In its plane the line is the middle of the
    /// narrowest
    /// strip with all places, which has one edge of their convex hull on its border; the plane is that of least squares.
    ///
    /// Source: Houle and Toussaint, Computing the width of a set, 1988.
    fn of(point: &str, places: &[[f64; 3]]) -> Option<Self> {
        let middle: [f64; 3] = std::array::from_fn(|k| {
            let sum: f64 = places.iter().map(|place| place[k]).sum();
            sum / places.len() as f64
        });
        let apart: Vec<[f64; 3]> = (places.iter())
            .map(|place| std::array::from_fn(|k| place[k] - middle[k]))
            .collect();
        let products = (0..9).map(|i| apart.iter().map(|v| v[i / 3] * v[i % 3]).sum());
        let axes = Svd::of(3, 3, &products.collect::<Vec<f64>>());
        if axes.values[0] <= 0.0 || !axes.values[0].is_finite() {
            return None;
        }
        let [u, v] = [0, 1].map(|k| &axes.right[k]);
        let mut flat: Vec<[f64; 2]> = apart.iter().map(|a| [dot(a, u), dot(a, v)]).collect();
        sort_by(&mut flat, |a, b| {
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        });
        let hull = hull(&flat);
        // across each edge of the hull: the normal, and how far the places reach
        let strips = hull
            .iter()
            .zip(hull.iter().cycle().skip(1))
            .filter_map(|(a, b)| {
                let edge = [b[0] - a[0], b[1] - a[1]];
                let length = real::hypot(edge[0], edge[1]);
                let normal = [-edge[1] / length, edge[0] / length];
                let across = |p: &[f64; 2]| normal[0] * (p[0] - a[0]) + normal[1] * (p[1] - a[1]);
                let width = hull.iter().map(across).fold(0.0, f64::max);
                (length > 0.0).then_some((width, normal, *a))
            });
        let (width, [nx, ny], [ax, ay]) = strips.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let inside = [ax + 0.5 * width * nx, ay + 0.5 * width * ny];
        let lift = |x: f64, y: f64| -> [f64; 3] { std::array::from_fn(|k| x * u[k] + y * v[k]) };
        let direction = lift(ny, -nx);
        let through = lift(inside[0], inside[1]);
        let mut line = Straightness {
            point: point.to_owned(),
            through: std::array::from_fn(|k| middle[k] + through[k]),
            direction,
            length: 0.0,
            deviation: 0.0,
            at_least: false,
        };
        let measures = places.iter().map(|place| line.apart(place));
        let (low, high, far) = measures.fold(
            (f64::INFINITY, f64::NEG_INFINITY, 0.0f64),
            |(low, high, far), [along, off]| (low.min(along), high.max(along), far.max(off)),
        );
        (line.length, line.deviation) = (high - low, far);
        Some(line)
    }
}

/// The convex hull of sorted points, in the sense of the clock's opposite (Andrew 1979).
fn hull(sorted: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let half = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = kept[..]
                && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= 0.0
            {
                kept.pop();
            }
            kept.push(*p);
        }
        kept.pop();
        kept
    };
    let mut hull = half(&mut sorted.iter());
    hull.extend(half(&mut sorted.iter().rev()));
    hull
}
