//! The parameters as coordinates of a family of mechanisms.

use super::Mechanism;
use super::model::{Formula, Symbol};
use crate::algebra::EvaluationError;
use crate::number::Number;

fn uses(formula: &Formula) -> impl Iterator<Item = usize> {
    formula.names().filter_map(|(symbol, _)| match *symbol {
        Symbol::Parameter(i) => Some(i),
        Symbol::Joint(_) | Symbol::Local(_) => None,
    })
}

impl Mechanism {
    /// The parameters that are defined by numbers alone. The others follow from them, so that a
    /// relation between dimensions (Bennett's, say) survives any change of these.
    pub fn independent_parameters(&self) -> Vec<usize> {
        (0..self.parameters().len())
            .filter(|&i| uses(&self.parameters()[i].definition).next().is_none())
            .collect()
    }

    /// Values of all parameters over any number, from values of the independent ones in the order
    /// of [`Mechanism::independent_parameters`]; those left out have the values of their definitions.
    ///
    /// # Errors
    /// If a definition has no value there.
    pub fn parameters_from<T: Number>(&self, independent: &[T]) -> Result<Vec<T>, EvaluationError> {
        let count = self.parameters().len();
        let mut values: Vec<Option<T>> = vec![None; count];
        for (i, value) in self.independent_parameters().into_iter().zip(independent) {
            values[i] = Some(*value);
        }
        // definitions have no cycles, so every round settles at least one
        for _ in 0..count {
            for i in 0..count {
                let definition = &self.parameters()[i].definition;
                if values[i].is_none() && uses(definition).all(|j| values[j].is_some()) {
                    let value = definition.evaluate(&|symbol| match *symbol {
                        Symbol::Parameter(j) => values[j].unwrap_or(T::zero()),
                        Symbol::Joint(_) | Symbol::Local(_) => T::zero(),
                    })?;
                    values[i] = Some(value);
                }
            }
            if values.iter().all(Option::is_some) {
                break;
            }
        }
        Ok(values.into_iter().map(|v| v.unwrap_or(T::zero())).collect())
    }
}
