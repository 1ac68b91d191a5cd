//! Design questions.

use pyo3::prelude::*;

use super::report::{ArrayColumn, PythonReport, prefaced};
use super::watched::watched;
use super::{MechanismError, PythonMechanism, QuestionError};
use crate::ask::{Design, DesignError};
use crate::description::{DesignDescription, FileError, ProblemKind};
use crate::output::diagnostics::{self, Style};

/// Dimensions with which a mechanism does what a design file says. The mechanism file that this names is not read.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn design<'py>(
    py: Python<'py>,
    mechanism: &PythonMechanism,
    text: String,
    seed: u64,
    starts: usize,
    approximate: bool,
    solutions: usize,
    most: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<(PythonReport, super::NamedArrays<'py>)> {
    let wrong = |problems| {
        let error = FileError::new("design", text.clone(), problems);
        QuestionError::new_err(diagnostics::render(&error, Style::Plain))
    };
    let design = Design {
        mechanism: mechanism.described()?,
        asked: DesignDescription::read(&text).map_err(wrong)?,
        seed,
        starts,
        own: false,
        approximate,
        solutions,
        most: most.max(1),
    };
    let report = watched(py, progress, true, |watch| design.report(watch))?;
    let report = report.map_err(|error| match error {
        DesignError::Mechanism(problems) => {
            let error = FileError::new("mechanism", mechanism.text.to_string(), problems);
            MechanismError::new_err(diagnostics::render(&error, Style::Plain))
        }
        DesignError::Part {
            part,
            value,
            problem,
        } => wrong(vec![
            ProblemKind::Design(Box::new(problem)).at(design.asked.span(part, value)),
        ]),
    })?;
    let (report, columns) = prefaced(&mechanism.mechanism, report);
    let columns = columns
        .into_iter()
        .map(|column: ArrayColumn| column.into_array(py));
    Ok((report, columns.collect::<PyResult<_>>()?))
}
