//! Backward differences of motions, and extrapolation to their next solutions.

use crate::algebra::{BATCH, Registers};
use crate::system::{LaneNumbers, Mask, choose};

/// Orders of extrapolation: none, constant moves, moves that change linearly and quadratically.
const ORDERS: usize = 4;

/// The latest solutions, with the backward differences m, ∇m, ∇²m of the moves m that led there.
///
/// Extrapolation of order p adds the first p of them; each motion has the order that would have missed its latest move
/// least.
#[derive(Clone, Debug)]
pub(super) struct Past {
    known: Vec<KnownPast>,
    /// 1 where a difference is added, otherwise 0.
    added: [LaneNumbers; ORDERS - 1],
}

/// The past of one number.
#[derive(Clone, Debug)]
struct KnownPast {
    register: usize,
    latest: LaneNumbers,
    differences: [LaneNumbers; ORDERS - 1],
}

impl Past {
    /// A past without moves, for the numbers in these registers.
    pub fn none(of: impl Iterator<Item = usize>, registers: &Registers) -> Self {
        let known = of.map(|register| KnownPast {
            register,
            latest: LaneNumbers(*registers.rows(register)),
            differences: [LaneNumbers::ZERO; ORDERS - 1],
        });
        Past {
            known: known.collect(),
            added: [LaneNumbers::ZERO; ORDERS - 1],
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

    /// The squares of the moves from the latest solutions.
    pub fn moved(&self, registers: &Registers) -> LaneNumbers {
        let mut moved = LaneNumbers::ZERO;
        for known in &self.known {
            let now = registers.rows(known.register);
            (0..BATCH).for_each(|i| {
                let away = now[i] - known.latest.0[i];
                moved.0[i] += away * away;
            });
        }
        moved
    }

    /// Puts the numbers of motions where they will be next.
    #[inline(always)]
    pub fn predict(&self, going: &Mask, registers: &mut Registers) {
        for known in &self.known {
            let mut sum = known.latest;
            for (difference, added) in known.differences.iter().zip(&self.added) {
                for i in 0..BATCH {
                    sum.0[i] += added.0[i] * difference.0[i];
                }
            }
            choose(registers.rows_mut(known.register), &sum.0, going);
        }
    }

    /// Takes in where motions are now.
    #[inline(always)]
    pub fn learn(&mut self, reached: &Mask, registers: &Registers) {
        let mut errors = [LaneNumbers::ZERO; ORDERS];
        let [first, higher @ ..] = &mut errors;
        for known in &mut self.known {
            let now = registers.rows(known.register);
            let mut latest = LaneNumbers::ZERO;
            for (i, now) in now.iter().enumerate() {
                latest.0[i] = now - known.latest.0[i];
                first.0[i] += latest.0[i] * latest.0[i];
            }
            choose(&mut known.latest.0, now, reached);
            for (difference, error) in known.differences.iter_mut().zip(&mut *higher) {
                let mut change = LaneNumbers::ZERO;
                for i in 0..BATCH {
                    change.0[i] = latest.0[i] - difference.0[i];
                    error.0[i] += change.0[i] * change.0[i];
                }
                choose(&mut difference.0, &latest.0, reached);
                latest = change;
            }
        }
        // difference p is added where an order above it missed less than all up to it
        let mut above = errors;
        for p in (1..ORDERS - 1).rev() {
            let [lower, upper] = [p, p + 1].map(|p| above[p]);
            for i in 0..BATCH {
                above[p].0[i] = lower.0[i].min(upper.0[i]);
            }
        }
        let mut least = LaneNumbers([f64::INFINITY; BATCH]);
        for (p, row) in self.added.iter_mut().enumerate() {
            let mut added = LaneNumbers::ZERO;
            for i in 0..BATCH {
                least.0[i] = least.0[i].min(errors[p].0[i]);
                added.0[i] = f64::from(u8::from(above[p + 1].0[i] < least.0[i]));
            }
            choose(&mut row.0, &added.0, reached);
        }
    }
}
