//! Defects of designs.

use std::collections::BTreeSet;

use super::{Judge, Observed};
use crate::analysis::design::{Defect, DesignCourse};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::ROUNDING;

impl Judge<'_> {
    /// Positions beyond limits of joints.
    pub(super) fn outside(
        &self,
        mechanism: &Mechanism,
        positions: &[Configuration<f64>],
        defects: &mut Vec<Defect>,
    ) {
        let mut beyond: Vec<(usize, usize)> = Vec::new();
        for (i, at) in positions.iter().enumerate() {
            let mut joints = at.joints.clone();
            mechanism.turn_to_limits(&mut joints);
            beyond.extend(
                mechanism
                    .outside_limits(&joints)
                    .map(|joint| (joint, i + 1)),
            );
        }
        if !beyond.is_empty() {
            let different = |of: fn(&(usize, usize)) -> usize| {
                let all: BTreeSet<usize> = beyond.iter().map(of).collect();
                all.into_iter()
            };
            let joints = different(|of| of.0);
            let joints = joints.map(|joint| mechanism.joints()[joint].name.clone());
            let joints = joints.collect();
            let positions = different(|of| of.1).collect();
            defects.push(Defect::Limit { joints, positions });
        }
    }

    /// Circuits, branches and order of the positions.
    pub(super) fn judge(
        &self,
        mechanism: &Mechanism,
        course: &DesignCourse,
        defects: &mut Vec<Defect>,
    ) {
        let numbers = |places: Vec<usize>| places.into_iter().map(|i| i + 1).collect::<Vec<_>>();
        let elsewhere = course.elsewhere();
        if !elsewhere.is_empty() {
            let mut limits = course.limits.clone();
            limits.sort_unstable();
            limits.dedup();
            defects.push(match limits.is_empty() {
                true => Defect::Circuit {
                    positions: numbers(elsewhere),
                },
                false => Defect::Limit {
                    joints: (limits.iter())
                        .map(|joint| mechanism.joints()[*joint].name.clone())
                        .collect(),
                    positions: numbers(elsewhere),
                },
            });
        }
        let beyond = course.beyond_dead();
        if let (false, Some(driver)) = (beyond.is_empty(), self.read.driver) {
            defects.push(Defect::Branch {
                driver: mechanism.joints()[driver].name.clone(),
                positions: numbers(beyond),
            });
        }
        let ordered = self.read.driven || self.asked.any_order;
        if course.elsewhere().is_empty() && !ordered && !course.in_order() {
            defects.push(Defect::Order {
                order: numbers(course.order()),
            });
        }
        if course.crosses {
            defects.push(Defect::Crossing);
        }
    }

    /// The bounds that are not kept.
    pub(super) fn bounded(&self, seen: &[Vec<Observed>], defects: &mut Vec<Defect>) {
        for (bound, seen) in self.bounds.iter().zip(seen) {
            let (limit, at_least) = (bound.bound, bound.at_least);
            let worst = bound.figure.of(seen);
            let slack = ROUNDING * (1.0 + limit.abs());
            let kept = worst.is_some_and(|worst| match at_least {
                true => worst >= limit - slack,
                false => worst <= limit + slack,
            });
            if !kept {
                defects.push(Defect::Condition {
                    quantity: bound.figure.name.clone(),
                    unit: bound.figure.unit,
                    bound: limit,
                    worst,
                    at_least,
                });
            }
        }
    }
}
