//! Where motions went so far, and where they will be next.

use crate::algebra::{BATCH, Registers};

/// Orders of extrapolation: none, constant moves, moves that change linearly and quadratically.
const ORDERS: usize = 4;

/// A number for each motion.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Row([f64; BATCH]);

impl Row {
    const ZERO: Row = Row([0.0; BATCH]);
}

/// The latest solutions, with the backward differences m, ∇m, ∇²m of the moves m that led there.
///
/// Extrapolation of order p adds the first p of them; each motion has the order that would have missed its latest move
/// least.
#[derive(Clone, Debug)]
pub(super) struct Past {
    known: Vec<Known>,
    /// 1 where a difference is added, otherwise 0.
    added: [Row; ORDERS - 1],
}

/// The past of one number.
#[derive(Clone, Debug)]
struct Known {
    register: usize,
    latest: Row,
    differences: [Row; ORDERS - 1],
}

impl Past {
    /// None, of the numbers in these registers.
    pub fn none(of: &[usize], registers: &Registers) -> Self {
        let known = of.iter().map(|&register| Known {
            register,
            latest: Row(*registers.rows(register)),
            differences: [Row::ZERO; ORDERS - 1],
        });
        Past {
            known: known.collect(),
            added: [Row::ZERO; ORDERS - 1],
        }
    }

    /// Forgets where a motion came from; its numbers are the latest.
    pub fn forget(&mut self, motion: usize, registers: &Registers) {
        for known in &mut self.known {
            known.latest.0[motion] = registers.rows(known.register)[motion];
            (known.differences.iter_mut()).for_each(|row| row.0[motion] = 0.0);
        }
        (self.added.iter_mut()).for_each(|row| row.0[motion] = 0.0);
    }

    /// Puts the latest numbers of a motion back.
    pub fn restore(&self, motion: usize, registers: &mut Registers) {
        for known in &self.known {
            registers.rows_mut(known.register)[motion] = known.latest.0[motion];
        }
    }

    /// Puts the numbers of motions where they will be next.
    #[inline(always)]
    pub fn predict(&self, going: &[bool; BATCH], registers: &mut Registers) {
        for known in &self.known {
            let next = registers.rows_mut(known.register);
            for i in 0..BATCH {
                let mut sum = known.latest.0[i];
                for (difference, added) in known.differences.iter().zip(&self.added) {
                    sum += added.0[i] * difference.0[i];
                }
                next[i] = if going[i] { sum } else { next[i] };
            }
        }
    }

    /// Takes in where motions are now.
    #[inline(always)]
    pub fn learn(&mut self, reached: &[bool; BATCH], registers: &Registers) {
        let mut errors = [Row::ZERO; ORDERS];
        for known in &mut self.known {
            let now = registers.rows(known.register);
            let Known {
                latest,
                differences,
                ..
            } = known;
            for i in 0..BATCH {
                let mut difference = now[i] - latest.0[i];
                latest.0[i] = if reached[i] { now[i] } else { latest.0[i] };
                errors[0].0[i] += difference * difference;
                for (before, error) in differences.iter_mut().zip(&mut errors[1..]) {
                    let next = difference - before.0[i];
                    before.0[i] = if reached[i] { difference } else { before.0[i] };
                    difference = next;
                    error.0[i] += difference * difference;
                }
            }
        }
        // order p is added to where a higher one missed less than all up to p
        let mut behind = errors;
        for p in (0..ORDERS - 1).rev() {
            for i in 0..BATCH {
                behind[p].0[i] = behind[p].0[i].min(behind[p + 1].0[i]);
            }
        }
        let mut least = errors[0];
        for p in 0..ORDERS - 1 {
            for i in 0..BATCH {
                least.0[i] = least.0[i].min(errors[p].0[i]);
                let added = if behind[p + 1].0[i] < least.0[i] { 1.0 } else { 0.0 };
                let row = &mut self.added[p].0[i];
                *row = if reached[i] { added } else { *row };
            }
        }
    }
}
