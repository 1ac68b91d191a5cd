//! Lengths that are equal but for their rounding: of tables, and of links between the joints of a drawing.

use super::parts::LinkedLoops;
use super::{EXPLAINED, Numbers};
use crate::algebra::Measure;
use crate::description::WrittenVector;
use crate::geometry::Vector3;
use crate::linear::Decomposition;
use crate::number::sorting::sort_by;
use crate::number::tolerance::ROUNDING;

/// A length with the most by which it is off.
type UncertainLength = (f64, f64);

/// The places of lengths that are equal within their rounding, and their means, in the order of size.
fn alike(lengths: &[UncertainLength]) -> Vec<(Vec<usize>, f64)> {
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    sort_by(&mut order, |a, b| lengths[*a].0.total_cmp(&lengths[*b].0));
    let off = |i: usize| EXPLAINED * lengths[i].1;
    let is_near = |a: &usize, b: &usize| lengths[*b].0 - lengths[*a].0 <= off(*a) + off(*b);
    let groups = order
        .chunk_by(is_near)
        .filter(|group| group.len() > 1)
        .map(|group| {
            let sum: f64 = group.iter().map(|&i| lengths[i].0).sum();
            (group.to_vec(), sum / group.len() as f64)
        });
    let is_explained = |(group, mean): &(Vec<usize>, f64)| {
        group.iter().all(|&i| (lengths[i].0 - mean).abs() <= off(i))
    };
    groups.filter(is_explained).collect()
}

/// A joint of a drawing, with the numbers of its points.
struct DrawnJoint {
    points: Vec<WrittenVector>,
    at: Vector3<f64>,
    /// The direction of its axis; `None` for a centre.
    along: Option<Vector3<f64>>,
}

impl DrawnJoint {
    /// The shortest way from its axis or centre to those of another.
    fn apart(&self, other: &DrawnJoint) -> Vector3<f64> {
        let way = other.at - self.at;
        let across = |way: Vector3<f64>, along: Vector3<f64>| way - along.scaled(way.dot(&along));
        match (self.along, other.along) {
            (Some(a), Some(b)) if a.cross(&b).norm() > ROUNDING => {
                let normal = a.cross(&b);
                normal.scaled(way.dot(&normal) / normal.dot(&normal))
            }
            (Some(along), _) | (None, Some(along)) => across(way, along),
            (None, None) => way,
        }
    }
}

impl Numbers<'_> {
    /// The numbers that a part means, with the lengths that are equal but for their rounding; empty if there are none.
    pub(super) fn equal(&self, part: &LinkedLoops, meant: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let mut all = match self.description.coordinates.is_some() {
            true => self.equal_links(part, meant).unwrap_or_default(),
            false => self.equal_entries(part),
        };
        let found = all.len();
        let others = meant
            .iter()
            .filter(|(i, _)| all.iter().all(|(k, _)| k != i));
        let others: Vec<(usize, f64)> = others.copied().collect();
        all.extend(others.into_iter().filter(|_| found > 0));
        all
    }

    fn equal_entries(&self, part: &LinkedLoops) -> Vec<(usize, f64)> {
        let value = |i: usize| self.literals[i].value();
        let is_length = |&i: &usize| {
            let of = &self.literals[i];
            let off = EXPLAINED * self.off[i].unwrap_or(0.0);
            of.measure == Measure::Length && !of.in_vector && value(i).abs() > off
        };
        let places: Vec<usize> = part.numbers.iter().copied().filter(is_length).collect();
        let lengths = places
            .iter()
            .map(|&i| (value(i).abs(), self.off[i].unwrap_or(0.0)));
        let groups = alike(&lengths.collect::<Vec<UncertainLength>>()).into_iter();
        let equal = groups.flat_map(|(group, mean)| {
            let places = group.into_iter().map(|k| places[k]);
            places.map(move |i| (i, mean)).collect::<Vec<_>>()
        });
        let equal = equal.map(|(i, mean)| (i, mean.copysign(value(i))));
        equal.filter(|(i, to)| *to != value(*i)).collect()
    }

    /// The joints of the drawing whose numbers belong to a part, where other numbers have these values; `None` for the others.
    fn drawn(&self, part: &LinkedLoops, meant: &[(usize, f64)]) -> Vec<Option<DrawnJoint>> {
        let Some(coordinates) = &self.description.coordinates else {
            return Vec::new();
        };
        let value = |i: usize| {
            let other = meant.iter().find(|(of, _)| *of == i);
            other.map_or(self.literals[i].value(), |(_, value)| *value)
        };
        let vector = |of: &WrittenVector| Vector3(of.literals.map(|(i, sign)| sign * value(i)));
        let unit = |of: Vector3<f64>| of.scaled(1.0 / of.norm());
        let vectors = self.description.written_vectors();
        let joints = coordinates.axes.joints.iter().map(|joint| {
            let place = format!("joint {}", joint.name.value);
            let own = vectors.iter().filter(|(of, _)| *of == place);
            let own: Vec<WrittenVector> = own.map(|(_, of)| *of).collect::<Option<_>>()?;
            let is_part =
                |of: &WrittenVector| of.literals.iter().any(|(i, _)| part.numbers.contains(i));
            let measures: Vec<Measure> = own.iter().map(|of| of.measure).collect();
            let (points, along) = match *measures {
                [Measure::Length] => (1, None),
                [Measure::Length, Measure::Number] => (1, Some(vector(&own[1]))),
                [Measure::Length, Measure::Length] => (2, Some(vector(&own[1]) - vector(&own[0]))),
                _ => return None,
            };
            own.iter().any(is_part).then(|| DrawnJoint {
                at: vector(&own[0]),
                points: own[..points].to_vec(),
                along: along.map(unit),
            })
        });
        joints.collect()
    }

    /// The numbers of points for which links that are equally long but for rounding are so: the least change, along the
    /// links; `None` if there are none, or rounding does not explain the change.
    fn equal_links(&self, part: &LinkedLoops, meant: &[(usize, f64)]) -> Option<Vec<(usize, f64)>> {
        const ROUNDS: usize = 8;
        let axes = &self.description.coordinates.as_ref()?.axes;
        let mut joints = self.drawn(part, meant);
        let first = joints.iter().map(|of| of.as_ref().map(|of| of.at));
        let first: Vec<Option<Vector3<f64>>> = first.collect();
        let off = |of: &WrittenVector, along: &Vector3<f64>| -> f64 {
            let parts = of.literals.iter().zip(along.0);
            parts
                .map(|((i, _), x)| x.abs() * self.off[*i].unwrap_or(0.0))
                .sum()
        };
        let share = |a: usize, b: usize| {
            let bodies = [a, b].map(|i| axes.joints[i].value.between.as_ref());
            let [Some(a), Some(b)] = bodies else {
                return false;
            };
            a.iter()
                .any(|of| b.iter().any(|other| of.value == other.value))
        };
        let pairs = (0..joints.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
        let mut links: Vec<(usize, usize)> = Vec::new();
        let mut lengths: Vec<UncertainLength> = Vec::new();
        for (a, b) in pairs.filter(|(a, b)| share(*a, *b)) {
            let (Some(from), Some(to)) = (&joints[a], &joints[b]) else {
                continue;
            };
            let apart = from.apart(to);
            let along = apart.scaled(1.0 / apart.norm());
            let off = off(&from.points[0], &along) + off(&to.points[0], &along);
            if apart.norm() > EXPLAINED * off {
                links.push((a, b));
                lengths.push((apart.norm(), off));
            }
        }
        let groups = alike(&lengths);
        if groups.is_empty() {
            return None;
        }
        let before = |i: usize| {
            let other = meant.iter().find(|(of, _)| *of == i);
            other.map_or(self.literals[i].value(), |(_, value)| *value)
        };
        // what is moved already moves less
        let slack = |joint: &Option<DrawnJoint>| {
            let points = joint.iter().flat_map(|joint| &joint.points);
            let left = points.flat_map(|of| of.literals).map(|(i, _)| {
                let moved = (before(i) - self.literals[i].value()).abs();
                (EXPLAINED * self.off[i].unwrap_or(0.0) - moved).max(0.0)
            });
            left.reduce(f64::min).unwrap_or(0.0)
        };
        let slacks: Vec<f64> = joints.iter().map(slack).collect();
        for _ in 0..ROUNDS {
            let (mut rows, mut wanted) = (Vec::new(), Vec::new());
            for (group, mean) in &groups {
                for &link in group {
                    let (a, b) = links[link];
                    let apart = joints[a].as_ref()?.apart(joints[b].as_ref()?);
                    let along = apart.scaled(1.0 / apart.norm());
                    let mut row = vec![0.0; 3 * joints.len()];
                    for i in 0..3 {
                        row[3 * a + i] = -slacks[a] * along.0[i];
                        row[3 * b + i] = slacks[b] * along.0[i];
                    }
                    rows.push(row);
                    wanted.push(mean - apart.norm());
                }
            }
            let columns = (0..3 * joints.len()).flat_map(|j| rows.iter().map(move |row| row[j]));
            let entries: Vec<f64> = columns.collect();
            let step = Decomposition::of(rows.len(), 3 * joints.len(), &entries).solve(&wanted);
            let steps = step.chunks_exact(3).zip(&slacks);
            for (joint, (step, slack)) in joints.iter_mut().zip(steps) {
                if let Some(joint) = joint {
                    joint.at += Vector3::new(step[0], step[1], step[2]).scaled(*slack);
                }
            }
        }
        let mut equal = Vec::new();
        for (joint, first) in joints.iter().zip(first) {
            let (Some(joint), Some(first)) = (joint, first) else {
                continue;
            };
            let moved = joint.at - first;
            if moved.norm() == 0.0 {
                continue;
            }
            for (i, sign, step) in joint.points.iter().flat_map(|of| {
                let numbers = of.literals.into_iter().zip(moved.0);
                numbers.map(|((i, sign), step)| (i, sign, step))
            }) {
                let written = self.literals[i].value();
                let to = before(i) + sign * step;
                if (to - written).abs() > EXPLAINED * self.off[i].unwrap_or(0.0) {
                    return None;
                }
                equal.push((i, to));
            }
        }
        Some(equal)
    }
}
