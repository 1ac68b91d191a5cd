//! The parameters of a description, and definitions that use one another.

use std::collections::HashMap;

use super::super::model::{Formula, Parameter, Symbol};
use super::super::names::definition_order;
use super::Builder;
use crate::description::{Description, Entry, Named, Note, Noun, ProblemKind, Scope};

impl Builder<'_> {
    pub(super) fn parameters(&mut self, description: &Description) -> Option<Vec<Parameter>> {
        let entries = &description.parameters;
        let none = HashMap::new();
        let formulas: Vec<Option<Formula>> = (entries.iter())
            .map(|named| self.formula(&named.value, Scope::Parameters, &none))
            .collect();
        let formulas: Vec<Formula> = formulas.into_iter().collect::<Option<_>>()?;
        let order = self.order(Noun::Parameter, entries, &formulas, |symbol| match symbol {
            Symbol::Parameter(i) => Some(i),
            _ => None,
        })?;
        for i in order {
            // a parameter without a value makes those defined through it fail for the same reason
            self.values[i] = self.value(&formulas[i])?;
        }
        let parts = entries.iter().zip(formulas).zip(&self.values);
        Some(
            parts
                .map(|((named, definition), &value)| Parameter {
                    name: named.name.value.clone(),
                    definition,
                    value,
                })
                .collect(),
        )
    }

    /// The order in which definitions can be evaluated, or `None` with the cycle recorded.
    pub(super) fn order(
        &mut self,
        noun: Noun,
        entries: &[Named<Entry>],
        formulas: &[Formula],
        definition: impl Fn(Symbol) -> Option<usize>,
    ) -> Option<Vec<usize>> {
        let uses: Vec<Vec<usize>> = (formulas.iter())
            .map(|formula| {
                formula
                    .names()
                    .filter_map(|(symbol, _)| definition(*symbol))
                    .collect()
            })
            .collect();
        match definition_order(&uses) {
            Ok(order) => Some(order),
            Err(cycle) => {
                let names = cycle
                    .iter()
                    .map(|&i| entries[i].name.value.clone())
                    .collect();
                let kind = ProblemKind::DefinitionCycle { noun, names };
                let problem = kind.at(entries[cycle[0]].name.span.clone());
                let rest = cycle[1..].iter().map(|&i| entries[i].name.span.clone());
                let problem =
                    rest.fold(problem, |problem, span| problem.with(span, Note::ThenHere));
                self.problems.push(problem);
                None
            }
        }
    }
}
