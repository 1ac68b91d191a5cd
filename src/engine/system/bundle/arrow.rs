//! A bundle linearised at a point, with what is left for the shared numbers.

use super::elimination::{Blocks, Eliminated};
use super::shared::Reduced;

/// A bundle linearised at a point.
#[derive(Clone, Debug)]
pub struct Arrow {
    pub(super) blocks: Vec<Blocks>,
    pub(super) rank: Option<usize>,
    /// The rows by which shared numbers stay near values.
    pub(super) near: Reduced,
}

impl Arrow {
    /// Every configuration eliminated, what its targets leave open damped by λ, and what is left for the shared numbers.
    pub(super) fn eliminated(&self, damping: f64) -> (Vec<Eliminated>, Reduced) {
        let mut reduced = self.near.clone();
        let eliminated = self.blocks.iter().map(|block| {
            let (eliminated, left) = block.eliminated(self.rank, damping);
            left.conditions
                .iter()
                .for_each(|row| reduced.condition(row));
            left.targets.iter().for_each(|row| reduced.square(row));
            eliminated
        });
        (eliminated.collect(), reduced)
    }

    fn reduced(&self) -> Reduced {
        self.eliminated(0.0).1
    }

    /// Number of closures that repeat others of the same configuration, whatever the shared numbers are.
    pub fn repeated(&self) -> usize {
        self.blocks.iter().map(Blocks::repeated).sum()
    }

    /// Number of independent conditions of the closures on the shared numbers.
    pub fn conditions(&self) -> usize {
        self.reduced().conditions()
    }

    /// Directions of the shared numbers, in their units, that neither closures nor targets determine while some stand still.
    pub fn open(&self, still: impl IntoIterator<Item = usize>) -> Vec<Vec<f64>> {
        let mut reduced = self.reduced();
        still
            .into_iter()
            .for_each(|number| reduced.near(number, 0.0));
        reduced.open()
    }

    /// For each shared number the root of the sum of squares of the changes of all weighted targets, for a change of it by its
    /// unit with every configuration closed again.
    pub fn sensitivities(&self) -> Vec<f64> {
        self.reduced().sensitivities()
    }

    /// The conditions that the closures leave for a step of the shared numbers in their units, one row each: coefficients, and
    /// what is left now.
    pub fn rows(&self) -> Vec<Vec<f64>> {
        self.reduced().rows()
    }
}
