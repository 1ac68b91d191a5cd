//! Test for two solutions of one branch.

use super::{System, SystemWork};
use crate::linear::{DENSE_LIMIT, norm, relative_change};
use crate::mechanism::Configuration;
use crate::number::tolerance::LONGEST_STEP;
use crate::solve::Equations;

/// Largest ‖J⁻¹(J₀ − J)‖ between two solutions for which they are on one branch. Where rows are quadratic, two
/// solutions for the same held values differ by 2 at least.
pub const BRANCH_CHANGE: f64 = 0.5;

impl System<f64> {
    /// True if a solution is certainly on the branch of another one for held values near by: the Jacobian J at it and
    /// J₀ at the other one meet ‖J⁻¹(J₀ − J)‖ ≤ ½, as along a followed curve
    /// ([`Continuation`](crate::solve::Continuation)). Of a large Jacobian only the change along the step is compared.
    pub fn is_on_branch_of(
        &self,
        from: &Configuration<f64>,
        to: &Configuration<f64>,
        work: &mut SystemWork<f64>,
    ) -> bool {
        let back = self.difference(to, from);
        let way = norm(&back);
        if way.is_nan() || way > LONGEST_STEP {
            return false;
        }
        if back.len() > DENSE_LIMIT {
            self.linearise(to, work);
            self.factorise(0.0, work);
            self.residual(&self.displaced(to, &back), work);
            self.step(work);
            // J⁻¹(J₀ − J) along the step is twice what Newton's method from the other end misses this one by
            let missed = self.step_mut(work).iter().zip(&back);
            let missed: Vec<f64> = missed.map(|(step, back)| 2.0 * (step + back)).collect();
            return norm(&missed) <= BRANCH_CHANGE * way;
        }
        self.linearise(from, work);
        let before = self.dense_jacobian(work);
        self.linearise(to, work);
        let here = self.dense_jacobian(work);
        relative_change(self.rows(), &here, &before) <= BRANCH_CHANGE
    }
}
