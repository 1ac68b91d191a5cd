//! Weights and tolerances of targets.

use super::DesignError;
use super::figure::in_unit;
use crate::algebra::SiUnit;
use crate::description::{DesignDescription, DesignPart, DesignProblem, Entry, Named, nearest};
use crate::mechanism::Mechanism;
use crate::system::Target;

/// Weights or tolerances of targets.
pub(super) struct Weights<'a> {
    named: &'a [Named<Vec<Entry>>],
    part: fn(usize) -> DesignPart,
}

impl<'a> Weights<'a> {
    /// # Errors
    /// If a name is no target, or the values are not one or one for each position.
    pub(super) fn of(
        named: &'a [Named<Vec<Entry>>],
        part: fn(usize) -> DesignPart,
        asked: &DesignDescription,
        positions: usize,
    ) -> Result<Self, DesignError> {
        for (i, of) in named.iter().enumerate() {
            let name = of.name.value.clone();
            let targets = asked.positions[..positions].iter().flatten();
            let mut targets = targets.map(|of| of.name.value.as_str());
            if !targets.clone().any(|target| target == name) {
                let suggestion = nearest(&name, &mut targets).map(str::to_owned);
                return Err(DesignProblem::NoTarget { name, suggestion }.at(part(i)));
            }
            let values = of.value.len();
            if values != 1 && values != positions {
                let problem = DesignProblem::NotForEach {
                    name,
                    values,
                    positions,
                };
                return Err(problem.of_value(part(i)));
            }
        }
        Ok(Weights { named, part })
    }

    /// The value for a target, if it has one.
    pub(super) fn value(
        &self,
        mechanism: &Mechanism,
        target: &Named<Vec<Entry>>,
        read: &Target,
    ) -> Result<Option<f64>, DesignError> {
        let mut named = self.named.iter().enumerate();
        let Some((i, named)) = named.find(|(_, of)| of.name.value == target.name.value) else {
            return Ok(None);
        };
        let part = (self.part)(i);
        if read.exact {
            let name = target.name.value.clone();
            return Err(DesignProblem::IsGiven { name }.at(part));
        }
        let entry = named
            .value
            .get(read.configuration)
            .unwrap_or(&named.value[0]);
        let unit = match part {
            DesignPart::Weight(_) => SiUnit::ONE,
            _ => read.quantity.unit,
        };
        let value = in_unit(mechanism, unit, entry).map_err(|problem| problem.of_value(part))?;
        if value > 0.0 && value.is_finite() {
            return Ok(Some(value));
        }
        let text = entry.expression.to_string();
        Err(DesignProblem::NotPositive { text }.of_value(part))
    }
}
