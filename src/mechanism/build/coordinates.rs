//! Checks of joint coordinates that need their values.

use std::ops::Range;

use super::Builder;
use crate::algebra::Measure;
use crate::description::{AxesProblem, AxisKind, AxisPlace, Coordinates, Entry, ProblemKind};
use crate::geometry::Vector3;

/// Axes of a universal joint this near to a right angle are perpendicular, in rad.
const PERPENDICULAR: f64 = 1e-9;

impl Builder<'_> {
    /// Axes need a direction, those of universal joints a right angle between them.
    pub(super) fn check_coordinates(&mut self, coordinates: &Coordinates) {
        self.problems.extend(coordinates.warnings.iter().cloned());
        for joint in &coordinates.axes.joints {
            let places = [Some(&joint.value.place), joint.value.second.as_ref()];
            for place in places.into_iter().flatten() {
                self.check_place(&joint.name.value, joint.value.kind, place);
            }
            // a home that is wrong hides what is made of it
            let wanted = match joint.value.kind {
                AxisKind::Revolute | AxisKind::Helical => Measure::Angle,
                AxisKind::Prismatic | AxisKind::Distance => Measure::Length,
                _ => continue,
            };
            let limits = joint
                .value
                .limits
                .iter()
                .flat_map(|(low, high)| [low, high]);
            for limit in limits {
                self.measured(limit, wanted);
            }
        }
    }

    fn check_place(&mut self, joint: &str, kind: AxisKind, place: &AxisPlace) {
        let span = |entries: &[Entry; 3]| entries[0].span.start..entries[2].span.end;
        let (lost, span) = match place {
            AxisPlace::Along(_, direction) => {
                let found = self.vector(direction, Measure::Open);
                (found.is_some_and(|v| v.norm() == 0.0), span(direction))
            }
            AxisPlace::Through(first, second) if kind != AxisKind::Distance => {
                let ends = [first, second].map(|point| self.vector(point, Measure::Length));
                let [first_end, second_end] = ends;
                let along = first_end.zip(second_end).map(|(a, b)| b - a);
                let whole = span(first).start..span(second).end;
                (along.is_some_and(|v| v.norm() == 0.0), whole)
            }
            AxisPlace::Cross(_, [first, second]) => {
                let ends = [first, second].map(|one| self.vector(one, Measure::Open));
                let whole = span(first).start..span(second).end;
                let lost = ends.iter().flatten().any(|v| v.norm() == 0.0);
                if let ([Some(a), Some(b)], false) = (ends, lost) {
                    let angle = (a.dot(&b) / (a.norm() * b.norm())).clamp(-1.0, 1.0).acos();
                    if (angle - std::f64::consts::FRAC_PI_2).abs() > PERPENDICULAR {
                        let joint = joint.to_owned();
                        self.refuse_axes(AxesProblem::NotPerpendicular { joint, angle }, &whole);
                    }
                }
                (lost, whole)
            }
            _ => return,
        };
        if lost {
            let joint = joint.to_owned();
            self.refuse_axes(AxesProblem::NoDirection { joint }, &span);
        }
    }

    fn refuse_axes(&mut self, problem: AxesProblem, span: &Range<usize>) {
        self.refuse(ProblemKind::Axes(Box::new(problem)), span);
    }

    fn vector(&mut self, entries: &[Entry; 3], measure: Measure) -> Option<Vector3<f64>> {
        let values = entries.each_ref().map(|entry| match measure {
            Measure::Open => self.constant(entry),
            _ => self.measured(entry, measure),
        });
        let [Some((_, x)), Some((_, y)), Some((_, z))] = values else {
            return None;
        };
        Some(Vector3([x, y, z]))
    }
}
