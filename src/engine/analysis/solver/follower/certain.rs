//! A test that motions keep to their branches.

use super::past::Past;
use crate::algebra::{BATCH, Registers};
use crate::number::tolerance::LONGEST_STEP;
use crate::system::{BRANCH_CHANGE, LaneNumbers, Mask, bits, choose};

/// For each motion the last solution tested, and the distance from it within which others are certainly on its branch.
///
/// With β the norm of the inverse of the Jacobian there and K that of its derivative there is one solution within a
/// distance of 1/βK (Newton and Kantorovich).
#[derive(Clone, Debug)]
pub(super) struct Certain {
    /// The numbers that the Jacobian depends on, with their weights.
    known: Vec<(usize, f64, LaneNumbers)>,
    /// The Jacobian, row by row.
    jacobian: Vec<LaneNumbers>,
    /// The square of the distance.
    reach: LaneNumbers,
}

/// Jacobians and their left inverses, row by row, by the registers in which they are.
pub(super) struct LaneJacobians<'r> {
    pub jacobian: &'r [usize],
    pub inverse: &'r [usize],
    pub unknowns: usize,
    /// The norm of the derivative of the Jacobian.
    pub curvature: f64,
}

impl LaneJacobians<'_> {
    /// For each motion (βK)², infinite where there is no inverse.
    fn sizes(&self, registers: &Registers) -> LaneNumbers {
        let mut size = LaneNumbers::ZERO;
        for &register in self.inverse {
            let entries = registers.rows(register);
            (0..BATCH).for_each(|i| size.0[i] += entries[i] * entries[i]);
        }
        for size in &mut size.0 {
            let finite = size.is_finite() && !self.inverse.is_empty();
            *size = if finite {
                *size * self.curvature * self.curvature
            } else {
                f64::INFINITY
            };
        }
        size
    }
}

impl Certain {
    /// No solution yet, for the numbers in registers with these weights.
    pub fn none<'w>(numbers: impl Iterator<Item = (usize, &'w f64)>, jacobian: usize) -> Self {
        let known = numbers.filter(|(_, weight)| **weight > 0.0);
        Certain {
            known: known
                .map(|(i, weight)| (i, *weight, LaneNumbers::ZERO))
                .collect(),
            jacobian: vec![LaneNumbers::ZERO; jacobian],
            reach: LaneNumbers::ZERO,
        }
    }

    /// The squares of the distances to the present solutions.
    fn apart(&self, registers: &Registers) -> LaneNumbers {
        let mut apart = LaneNumbers::ZERO;
        for (register, weight, from) in &self.known {
            let to = registers.rows(*register);
            (0..BATCH).for_each(|i| {
                let away = weight * (to[i] - from.0[i]);
                apart.0[i] += away * away;
            });
        }
        apart
    }

    /// Solved motions that have come too far or too fast.
    pub fn beyond(&self, solved: &Mask, past: &Past, registers: &Registers) -> Mask {
        let (apart, moved) = (self.apart(registers), past.moved(registers));
        let mut beyond = [0; BATCH];
        for i in 0..BATCH {
            let near = apart.0[i] <= self.reach.0[i] && 100.0 * moved.0[i] <= self.reach.0[i];
            beyond[i] = if near { 0 } else { solved[i] };
        }
        beyond
    }

    /// Motions among `of` that are on their branches by the change of the Jacobian.
    pub fn sure(&self, of: &Mask, now: &LaneJacobians, registers: &Registers) -> Mask {
        let (size, apart) = (now.sizes(registers), self.apart(registers));
        let width = now.unknowns.max(1);
        let rows = (now.jacobian.len() / width).max(1);
        let changes: Vec<LaneNumbers> = (now.jacobian.iter())
            .zip(&self.jacobian)
            .map(|(&register, before)| {
                let now = registers.rows(register);
                LaneNumbers(std::array::from_fn(|i| before.0[i] - now[i]))
            })
            .collect();
        let mut squares = LaneNumbers::ZERO;
        for row in now.inverse.chunks_exact(rows) {
            for c in 0..width {
                let mut sum = LaneNumbers::ZERO;
                for (k, &register) in row.iter().enumerate() {
                    let inverse = registers.rows(register);
                    let change = &changes[k * width + c];
                    (0..BATCH).for_each(|i| sum.0[i] += inverse[i] * change.0[i]);
                }
                (0..BATCH).for_each(|i| squares.0[i] += sum.0[i] * sum.0[i]);
            }
        }
        let mut sure = *of;
        (0..BATCH).for_each(|i| {
            let (square, way) = (squares.0[i], apart.0[i]);
            let changes_little = square <= BRANCH_CHANGE.powi(2) && way <= LONGEST_STEP.powi(2);
            let certain =
                size.0[i].is_finite() && (36.0 * size.0[i] * way <= 1.0 || changes_little);
            sure[i] &= bits(certain);
        });
        sure
    }

    /// Takes the present solutions of some motions.
    pub fn keep(&mut self, which: &Mask, now: &LaneJacobians, registers: &Registers) {
        let size = now.sizes(registers);
        let mut reach = LaneNumbers::ZERO;
        (0..BATCH).for_each(|i| reach.0[i] = 0.64 / (size.0[i] + 1e-30));
        choose(&mut self.reach.0, &reach.0, which);
        for (register, _, from) in &mut self.known {
            choose(&mut from.0, registers.rows(*register), which);
        }
        for (kept, &register) in self.jacobian.iter_mut().zip(now.jacobian) {
            choose(&mut kept.0, registers.rows(register), which);
        }
    }
}
