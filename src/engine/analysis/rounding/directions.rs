//! Axes of a drawing that are parallel, or at right angles, but for their rounding.

use super::parts::LinkedLoops;
use super::{EXPLAINED, Numbers};
use crate::algebra::Measure;
use crate::description::WrittenVector;
use crate::geometry::Vector3;

/// The direction of an axis as a drawing gives it.
struct WrittenAxis {
    /// One direction, or the two points that it leads through.
    vectors: Vec<WrittenVector>,
    direction: Vector3<f64>,
    /// The most by which it may be turned, in rad.
    off: f64,
}

impl Numbers<'_> {
    fn vector(&self, of: &WrittenVector) -> Vector3<f64> {
        Vector3(of.literals.map(|(i, sign)| sign * self.literals[i].value()))
    }

    /// The axes whose numbers belong to a part.
    fn axes(&self, part: &LinkedLoops) -> Vec<WrittenAxis> {
        let vectors = self.description.written_vectors();
        let joints = vectors.chunk_by(|(a, _), (b, _)| a == b);
        let axis = |vectors: &[(String, Option<WrittenVector>)]| {
            let vectors: Option<Vec<WrittenVector>> = vectors.iter().map(|(_, v)| *v).collect();
            let mut vectors = vectors?;
            let mut numbers = vectors.iter().flat_map(|of| of.literals);
            if !numbers.any(|(i, _)| part.numbers.contains(&i)) {
                return None;
            }
            let direction = match *vectors.iter().map(|of| of.measure).collect::<Vec<_>>() {
                [Measure::Length, Measure::Number] | [Measure::Number] => {
                    vectors = vectors.split_off(vectors.len() - 1);
                    self.vector(&vectors[0])
                }
                [Measure::Length, Measure::Length] => {
                    self.vector(&vectors[1]) - self.vector(&vectors[0])
                }
                _ => return None,
            };
            let length = direction.norm();
            let offs = vectors.iter().map(|of| {
                let offs = Vector3(of.literals.map(|(i, _)| self.off[i].unwrap_or(0.0)));
                offs.norm()
            });
            let off = offs.sum::<f64>() / length;
            let axis = WrittenAxis {
                vectors,
                direction: direction.scaled(1.0 / length),
                off,
            };
            (off > 0.0 && off < 0.1).then_some(axis)
        };
        joints.filter_map(axis).collect()
    }

    /// The numbers of axes of a part that are parallel to one another, and at right angles to others and to those of the
    /// drawing, where their rounding explains the difference.
    pub(super) fn parallel(&self, part: &LinkedLoops) -> Vec<(usize, f64)> {
        let mut left = self.axes(part);
        let units = [0, 1, 2].map(|i| (Vector3::unit(i), 0.0));
        let mut known: Vec<(Vector3<f64>, f64)> = units.to_vec();
        let mut meant = Vec::new();
        while let Some(first) = left.first() {
            let (first, off) = (first.direction, first.off);
            let along =
                |axis: &WrittenAxis| axis.direction.scaled(axis.direction.dot(&first).signum());
            let (group, others): (Vec<WrittenAxis>, Vec<WrittenAxis>) = left
                .into_iter()
                .partition(|axis| (along(axis) - first).norm() <= off + axis.off);
            left = others;
            let sum = group.iter().map(|axis| along(axis).scaled(1.0 / axis.off));
            let mut mean = unit(sum.fold(Vector3::zero(), |sum, of| sum + of));
            let off = group.iter().map(|axis| axis.off).fold(off, f64::min);
            let mut is_meant = group.len() > 1;
            for (other, its) in &known {
                let (angle, near) = (mean.dot(other), off + its);
                if angle.abs() <= near {
                    mean = unit(mean - other.scaled(angle));
                    is_meant = true;
                }
            }
            for (other, its) in &known {
                let same = other.scaled(mean.dot(other).signum());
                if (mean - same).norm() <= off + its {
                    mean = same;
                    is_meant = true;
                }
            }
            known.push((mean, off));
            // an axis that is like no other keeps its numbers free
            for axis in group.iter().filter(|_| is_meant) {
                let along = mean.scaled(axis.direction.dot(&mean).signum());
                meant.extend(self.turned(axis, along).unwrap_or_default());
            }
        }
        meant
    }

    /// The numbers of an axis in another direction, about its middle where it leads through two points; `None` if rounding
    /// does not explain one of them.
    fn turned(&self, axis: &WrittenAxis, to: Vector3<f64>) -> Option<Vec<(usize, f64)>> {
        let given: Vec<Vector3<f64>> = axis.vectors.iter().map(|of| self.vector(of)).collect();
        let turned = match *given {
            [direction] => vec![to.scaled(direction.norm())],
            [a, b] => {
                let (middle, half) = ((a + b).scaled(0.5), to.scaled(0.5 * (b - a).norm()));
                vec![middle - half, middle + half]
            }
            _ => return None,
        };
        let numbers = axis.vectors.iter().zip(turned).flat_map(|(of, to)| {
            let numbers = of.literals.into_iter().zip(to.0);
            numbers.map(|((i, sign), to)| (i, sign * to))
        });
        let explained = |(i, to): (usize, f64)| {
            let change = (to - self.literals[i].value()).abs();
            match self.off[i] {
                Some(off) => (change <= EXPLAINED * off).then_some((i, to)),
                None => (change <= 4.0 * f64::EPSILON).then_some((i, self.literals[i].value())),
            }
        };
        numbers.map(explained).collect()
    }
}

fn unit(of: Vector3<f64>) -> Vector3<f64> {
    of.scaled(1.0 / of.norm())
}
