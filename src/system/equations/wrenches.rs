//! What the rows of the closures resist.

use super::{System, Work};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Side};

/// The constraint wrenches of a closure: what its rows resist, acting on side B.
#[derive(Clone, Debug)]
pub struct ClosureWrenches<T> {
    /// Where the forces attack on side A and side B, in ground, in m.
    pub points: [Vector3<T>; 2],
    /// Number of the closure's first row among all rows.
    pub first_row: usize,
    /// Each row as (moment; force × characteristic length) in ground: its rate for a twist (ω; v/L) of side B there.
    pub rows: Vec<[T; 6]>,
}

impl<T: Factorable> System<T> {
    /// The wrenches of every closure's rows, at the placement last evaluated.
    pub fn closure_wrenches(
        &self,
        at: &Configuration<T>,
        work: &Work<T>,
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
