//! The state in closed form, where the closures can be solved one after another.

use super::VariablePlan;
use super::report::{ClosedProgram, Radicand};
use crate::algebra::{OperationIndex, Recorded};
use crate::mechanism::Configuration;
use crate::number::Number;
use crate::number::tolerance::ROUNDING;
use crate::system::{Branching, ClosedSolution};

/// Writes down what must hold where formulas are evaluated.
#[derive(Default)]
struct Recorder {
    signs: Vec<OperationIndex>,
    radicands: Vec<Radicand>,
    divisors: Vec<(OperationIndex, f64)>,
}

impl Recorder {
    fn divides(&mut self, by: Recorded, part: f64) {
        if by.constant().is_none() {
            self.divisors.push((by.place(), part * by.real().abs()));
        }
    }
}

impl Branching<Recorded> for Recorder {
    fn sign(&mut self, slope: Recorded) -> Recorded {
        let sign = slope.sign();
        self.signs.push(sign.place());
        sign
    }

    fn root(&mut self, radicand: Recorded, size: Recorded) -> Recorded {
        self.radicands.push(Radicand {
            place: radicand.place(),
            size: size.place(),
        });
        radicand.root_or_zero()
    }

    fn angle(&mut self, near: Recorded, sin: Recorded, cos: Recorded, norm: Recorded) -> Recorded {
        self.divides(sin * sin + cos * cos, ROUNDING * ROUNDING);
        let turned = Recorded::angle(sin, cos, near);
        let inverse = Recorded::one() / norm;
        turned.turned(sin * inverse, cos * inverse);
        turned
    }

    fn quotient(&mut self, of: Recorded, over: Recorded) -> Recorded {
        self.divides(over, ROUNDING);
        of / over
    }
}

impl VariablePlan<'_> {
    /// The state in closed form, near the given one.
    pub(super) fn closed(
        &self,
        solution: &ClosedSolution,
        at: &Configuration<Recorded>,
    ) -> Option<ClosedProgram> {
        let mut recorder = Recorder::default();
        let found = solution.solve(self.mechanism, at, &mut recorder).ok()?;
        let Recorder {
            signs,
            radicands,
            divisors,
        } = recorder;
        let state = self.state.iter();
        Some(ClosedProgram {
            state: state
                .map(|variable| variable.of(self.mechanism, &found).place())
                .collect(),
            signs,
            radicands,
            divisors,
        })
    }
}
