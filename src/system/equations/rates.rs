//! What following a solution along a change of the inputs needs beyond Newton's method.

use super::{System, Work};
use crate::linear::Factorable;
use crate::solve::Equations;

impl<T: Factorable> System<T> {
    /// The step last computed, in the order of the unknowns, dimensionless.
    pub fn step_of<'a>(&self, work: &'a Work<T>) -> &'a [T] {
        &work.step
    }

    /// The step −J⁺r for another residual and the factors last made.
    pub fn step_for(&self, residual: &[T], work: &mut Work<T>) -> f64 {
        work.residual.copy_from_slice(residual);
        self.step(work)
    }
}
