//! Axes of closures in ground, and their constraint wrenches.

use super::{System, SystemWork};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Side};

/// The axes of one closure in ground.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosureAxes<T> {
    /// Each unknown joint that moves the closure, with ω and the closure's velocity per unit of its scaled variable.
    pub joints: Vec<(usize, Vector3<T>, Vector3<T>)>,
    /// The z axes of the two frames it joins; of frames whose origin alone counts they are not known.
    pub frames: [Vector3<T>; 2],
}

/// The constraint wrenches of a closure: what its rows resist, acting on side B.
#[derive(Clone, Debug)]
pub struct ClosureWrenches<T> {
    /// Points of attack of the forces on side A and side B, in ground, in m.
    pub points: [Vector3<T>; 2],
    /// Number of the closure's first row among all rows.
    pub first_row: usize,
    /// Each row as (moment; force × characteristic length) in ground: its rate for a twist (ω; v/L) of side B there.
    pub rows: Vec<[T; 6]>,
}

impl<T: Factorable> System<T> {
    /// The axes of each closure at a configuration, assembled or not.
    pub fn axes(&self, at: &Configuration<T>, work: &mut SystemWork<T>) -> Vec<ClosureAxes<T>> {
        self.kinematics.place(at, &mut work.placement);
        let placement = &work.placement;
        let closures = self.plans.iter().zip(&self.closures);
        let axes = closures.map(|(plan, closure)| {
            let rows = closure.rows(placement, at);
            let joints = plan.movers.iter().map(|(side, mover, _)| {
                let (omega, v) = placement.twist(mover, rows.velocity_point(*side));
                (mover.joint, omega, v)
            });
            ClosureAxes {
                joints: joints.collect(),
                frames: closure.frames(placement).map(|pose| pose.rotation.0[2]),
            }
        });
        axes.collect()
    }

    /// If every closure is a rod from what is fixed to what moves: both its ends in ground, at the placement last evaluated, and
    /// its length.
    pub(crate) fn rods(
        &self,
        at: &Configuration<T>,
        work: &SystemWork<T>,
    ) -> Option<Vec<([Vector3<T>; 2], T)>> {
        let closures = self.plans.iter().zip(&self.closures);
        let rods = closures.map(|(plan, closure)| {
            let joints = !plan.movers.is_empty() || !plan.extensions.is_empty();
            let mut ends = closure.frames(&work.placement).map(|pose| pose.position);
            match plan.platforms.as_slice() {
                [(side, ..)] if closure.kind.has_length() && !joints => {
                    if *side == Side::A {
                        ends.reverse();
                    }
                    Some((ends, closure.length(&at.joints)))
                }
                _ => None,
            }
        });
        rods.collect()
    }

    /// The wrenches of every closure's rows, at the placement last evaluated.
    pub fn closure_wrenches(
        &self,
        at: &Configuration<T>,
        work: &SystemWork<T>,
    ) -> Vec<ClosureWrenches<T>> {
        let wrenches = self.closures.iter().zip(&self.plans);
        wrenches
            .map(|(closure, plan)| {
                let rows = closure.rows(&work.placement, at);
                let mut wrenches = Vec::with_capacity(plan.rows);
                let put = |_, row| wrenches.push(row);
                rows.twist_rows(Side::B, &Vector3::zero(), self.length, put);
                ClosureWrenches {
                    points: [Side::A, Side::B].map(|side| *rows.velocity_point(side)),
                    first_row: plan.row,
                    rows: wrenches,
                }
            })
            .collect()
    }
}
