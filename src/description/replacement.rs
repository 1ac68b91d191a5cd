//! Another value for a parameter of a file.

use thiserror::Error;

use super::problem::titles;
use super::{Description, Entry, Problem, ProblemKind, Scope, names_of, nearest, place_of};
use crate::algebra::Expression;

/// Why a parameter cannot be given another value.
#[derive(Debug, Clone, Error, PartialEq)]
pub enum ReplacementError {
    /// The file has no such parameter.
    #[error("the file has no parameter `{name}`")]
    UnknownParameter {
        /// The name.
        name: String,
        /// The parameter that was probably meant.
        suggestion: Option<String>,
    },
    /// The value is wrong. Spans count bytes of the text of the value.
    #[error("{}", titles(_0))]
    Value(Vec<Problem>),
}

impl Description {
    /// The same file with another definition of one parameter, an expression that may use the other parameters.
    ///
    /// Problems that appear only when all parameters are known (a cycle, a division by zero) are found later and
    /// then refer to the value in the file that the new one replaces.
    pub fn with_parameter(
        mut self,
        name: &str,
        value: &str,
    ) -> Result<Description, ReplacementError> {
        let names = || names_of(&self.parameters);
        let Some(index) = place_of(&self.parameters, name) else {
            return Err(ReplacementError::UnknownParameter {
                name: name.into(),
                suggestion: nearest(name, names()).map(str::to_owned),
            });
        };
        let expression = Expression::parse(value).map_err(|error| {
            let problem = ProblemKind::Expression(error.kind).at(error.span);
            ReplacementError::Value(vec![problem])
        })?;
        let unknown = |used: &str| match place_of(&self.joints, used).is_some() {
            true => ProblemKind::JointNotAllowed { name: used.into() },
            false => ProblemKind::UnknownName {
                name: used.into(),
                suggestion: nearest(used, names()).map(str::to_owned),
                scope: Scope::Parameters,
            },
        };
        let problems: Vec<Problem> = expression
            .names()
            .filter(|(used, _)| names().all(|known| known != used.as_str()))
            .map(|(used, span)| unknown(used).at(span.clone()))
            .collect();
        if !problems.is_empty() {
            return Err(ReplacementError::Value(problems));
        }
        let span = self.parameters[index].value.span.clone();
        let value = Entry {
            expression: expression.relocate(&|_| span.clone()),
            span,
        };
        if let Some(coordinates) = &mut self.coordinates {
            coordinates.axes.parameters[index].value = value.clone();
        }
        self.parameters[index].value = value;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"Mechanism(version: 1, name: "x", convention: Modified,
        parameters: { "l0": 5, "l1": "l0/5" }, joints: { "q": Passive() },
        chains: { "c": Chain(rows: [(a: "l1", theta: "q")]) })"#;

    fn replaced(name: &str, value: &str) -> Result<Description, ReplacementError> {
        Description::read(FILE).unwrap().with_parameter(name, value)
    }

    #[test]
    fn a_new_value_may_use_other_parameters() {
        let description = replaced("l1", "2*l0").unwrap();
        let value = &description.parameters[1].value;
        assert_eq!(value.expression.to_string(), "2*l0");
        assert_eq!(&FILE[value.span.clone()], "\"l0/5\"");
    }

    #[test]
    fn a_wrong_value_is_pointed_at() {
        let value = |text| match replaced("l1", text) {
            Err(ReplacementError::Value(problems)) => problems,
            other => panic!("{other:?}"),
        };
        assert_eq!(value("1 + $")[0].span, 4..5);
        let [joint, unknown] = &value("q + lO")[..] else {
            panic!("two problems")
        };
        assert!(matches!(joint.kind, ProblemKind::JointNotAllowed { .. }));
        assert_eq!(unknown.span, 4..6);
    }

    #[test]
    fn an_unknown_parameter_is_refused_with_the_nearest_one() {
        let error = replaced("L1", "1").unwrap_err();
        let (name, suggestion) = ("L1".into(), Some("l1".into()));
        assert_eq!(
            error,
            ReplacementError::UnknownParameter { name, suggestion }
        );
    }
}
