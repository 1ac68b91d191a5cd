//! The rate at which the Jacobian of the iteration changes, for a bound on the steps that keep to a branch.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{StateVariable, VariablePlan};
use crate::algebra::{Operation, OperationIndex, SiUnit, evaluate};
use crate::linear::{DENSE_LIMIT, norm, singular_values};
use crate::number::tolerance::DIFFERENCE;

/// The rate at which the Jacobian changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Curvature {
    /// Factors that make changes of the inputs, then of the state, dimensionless; 0 where the Jacobian does not depend
    /// on the number.
    pub weights: Vec<f64>,
    /// The largest change of the Jacobian for a unit change of all these found, in the Frobenius norm.
    pub largest: f64,
}

impl VariablePlan<'_> {
    /// Curvature of a Jacobian in these places, from the values of `variables`, the inputs of the operations, at the
    /// start. It is
    /// looked at there and at random configurations: all angles and orientations, lengths within half the size of the
    /// mechanism.
    pub(super) fn curvature(
        &self,
        operations: &[Operation],
        jacobian: &[OperationIndex],
        variables: &[StateVariable],
        start: &[f64],
    ) -> Curvature {
        /// Configurations at which the change is computed.
        const SAMPLES: usize = 24;
        let length = self.mechanism.characteristic_length();
        let last = jacobian.iter().max().map_or(0, |place| place + 1);
        let operations = &operations[..last as usize];
        let used = used(operations, jacobian, variables.len());
        let weight = |variable: &StateVariable| match *variable {
            StateVariable::Orientation(..) => 2.0,
            of if self.is_length(of) => 1.0 / length,
            _ => 1.0,
        };
        let weights: Vec<f64> = (variables.iter().enumerate())
            .map(|(i, variable)| if used[i] { weight(variable) } else { 0.0 })
            .collect();
        let entries = |at: &[f64]| -> Vec<f64> {
            let values = evaluate(operations, at);
            let entries = jacobian.iter();
            entries.map(|&place| values[place as usize]).collect()
        };
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        let mut largest = 0.0f64;
        for sample in 0..SAMPLES {
            let mut at = start.to_vec();
            if sample > 0 {
                self.scatter(variables, &mut at, length, &mut rng);
            }
            let slopes: Vec<Vec<f64>> = (0..at.len())
                .filter(|i| weights[*i] > 0.0)
                .map(|i| {
                    let side = |by: f64| {
                        let mut at = at.clone();
                        at[i] += by;
                        entries(&at)
                    };
                    let step = DIFFERENCE / weights[i];
                    let (low, high) = (side(-step), side(step));
                    let pairs = high.iter().zip(low);
                    pairs.map(|(b, a)| (b - a) / (2.0 * DIFFERENCE)).collect()
                })
                .collect();
            // of many the norm of the whole, which is larger
            let all = slopes.concat();
            let size = match slopes.len() {
                0 => 0.0,
                n if n > DENSE_LIMIT => norm(&all),
                n => singular_values(all.len() / n, n, &all)[0],
            };
            if size.is_finite() {
                largest = largest.max(size);
            }
        }
        Curvature { weights, largest }
    }

    /// Random values about a start.
    fn scatter(
        &self,
        variables: &[StateVariable],
        at: &mut [f64],
        length: f64,
        rng: &mut Pcg64Mcg,
    ) {
        let mut number = |size: f64| size * (2.0 * rng.random::<f64>() - 1.0);
        for (i, variable) in variables.iter().enumerate() {
            match *variable {
                StateVariable::Orientation(_, 0) => {
                    let q = [0, 1, 2, 3].map(|_| number(1.0));
                    let unit = 1.0 / norm(&q).max(0.1);
                    at[i..i + 4].copy_from_slice(&q.map(|x| x * unit));
                }
                StateVariable::Orientation(..) => {}
                of if self.is_length(of) => at[i] += number(0.5 * length),
                _ => at[i] += number(std::f64::consts::PI),
            }
        }
    }

    fn is_length(&self, variable: StateVariable) -> bool {
        variable.unit(self.mechanism) == SiUnit::METRE
    }
}

/// For each of the first inputs of the operations, true if some place depends on it.
fn used(operations: &[Operation], places: &[OperationIndex], inputs: usize) -> Vec<bool> {
    let mut needed = vec![false; operations.len()];
    let mut used = vec![false; inputs];
    for &place in places {
        needed[place as usize] = true;
    }
    for (place, operation) in operations.iter().enumerate().rev() {
        if needed[place] {
            (operation.operands()).for_each(|operand| needed[operand as usize] = true);
            if let Operation::Input(i) = *operation
                && let Some(used) = used.get_mut(i as usize)
            {
                *used = true;
            }
        }
    }
    used
}
