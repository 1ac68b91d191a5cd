//! Reports as Python sees them.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyList;

use super::asked::GivenQuestion;
use super::words::Refused;
use crate::analysis::assembly::AssemblySettings;
use crate::analysis::formulas::FormulasSettings;
use crate::analysis::overview::overview;
use crate::analysis::sweep::Row;
use crate::ask::Solved;
use crate::mechanism::{Frame, Mechanism};
use crate::output::complaint::unknown_frame;
use crate::output::document::Cell;
use crate::output::rounding::Prefaced;
use crate::output::sweep::{SHOWN, row_columns, row_values};
use crate::output::{AnyReport, JsonReport, Rows, html, markdown, text};
use crate::solve::Watch;

#[pyclass(frozen, name = "Report", module = "linkwork._linkwork")]
pub struct PythonReport(Box<dyn AnyReport + Send + Sync>);

#[pymethods]
impl PythonReport {
    /// False if the answer is negative (exit status 1).
    #[getter]
    fn yes(&self) -> bool {
        self.0.is_yes()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    fn json(&self) -> String {
        self.0.json()
    }

    fn text(&self) -> String {
        text::render(&self.0.document())
    }

    fn markdown(&self) -> String {
        markdown::render(&self.0.document())
    }

    fn html(&self) -> String {
        html::fragment(&self.0.document())
    }
}

pub struct ArrayColumn {
    name: String,
    numbers: Vec<f64>,
    texts: Vec<String>,
}

impl ArrayColumn {
    fn named(names: Vec<String>) -> Vec<ArrayColumn> {
        let empty = |name| ArrayColumn {
            name,
            numbers: Vec::new(),
            texts: Vec::new(),
        };
        names.into_iter().map(empty).collect()
    }

    fn of(rows: Rows) -> Vec<ArrayColumn> {
        let mut columns = ArrayColumn::named(rows.columns);
        rows.rows
            .for_each(|row| ArrayColumn::row(&mut columns, row));
        columns
    }

    fn row(columns: &mut [ArrayColumn], row: impl IntoIterator<Item = Cell>) {
        let cells = columns.iter_mut().zip(row);
        cells.for_each(|(column, cell)| column.push(cell));
    }

    fn push(&mut self, cell: Cell) {
        let row = self.numbers.len();
        self.numbers.push(match cell {
            Cell::Count(count) => count as f64,
            Cell::Number { value, .. } => value,
            _ => f64::NAN,
        });
        if let Cell::Text(text) = cell {
            self.texts.resize(row, String::new());
            self.texts.push(text);
        }
    }

    /// Its name with the unit, and numbers as an array without a copy, or texts.
    pub fn into_array<'py>(mut self, py: Python<'py>) -> PyResult<(String, Bound<'py, PyAny>)> {
        let array = match self.texts.is_empty() {
            true => PyArray1::from_vec(py, self.numbers).into_any(),
            false => {
                self.texts.resize(self.numbers.len(), String::new());
                PyList::new(py, self.texts)?.into_any()
            }
        };
        Ok((self.name, array))
    }
}

pub fn prefaced<R: JsonReport + Send + Sync + 'static>(
    mechanism: &Mechanism,
    report: R,
) -> (PythonReport, Vec<ArrayColumn>) {
    let columns = report.rows().map_or_else(Vec::new, ArrayColumn::of);
    (
        PythonReport(Box::new(Prefaced::new(mechanism, report))),
        columns,
    )
}

/// Asks the question that has this name.
pub fn answer(
    what: &str,
    asked: &GivenQuestion,
    mechanism: &Mechanism,
    watch: &Watch,
) -> Result<(PythonReport, Vec<ArrayColumn>), Refused> {
    let (question, settings) = (&asked.question, &asked.settings);
    let singularities = &settings.singularities;
    Ok(match what {
        "check" => prefaced(mechanism, overview(mechanism)),
        "solve" => match question.solve(&AssemblySettings::default(), watch)? {
            Solved::Ended(ended) => prefaced(mechanism, *ended),
            Solved::Lost(lost) => prefaced(mechanism, *lost),
        },
        "assemblies" => prefaced(mechanism, question.assemblies(settings.assemblies, watch)?),
        "mobility" => prefaced(mechanism, question.mobility(watch)?),
        "velocity" => prefaced(mechanism, question.velocity(watch)?),
        "statics" => prefaced(mechanism, question.statics(watch)?),
        "equilibrium" => prefaced(
            mechanism,
            question.equilibrium(&settings.equilibrium, watch)?,
        ),
        "simulate" => prefaced(mechanism, question.simulation(&settings.simulation, watch)?),
        "singularities" => prefaced(mechanism, question.singularities(singularities, watch)?),
        "along" => prefaced(mechanism, question.along(singularities, watch)?),
        "loci" => prefaced(mechanism, question.loci(singularities, watch)?),
        "workspace" => prefaced(mechanism, question.workspace(&settings.workspace, watch)?),
        "compare" => prefaced(mechanism, question.compare(settings.compare.samples, watch)),
        "formulas" => {
            let frame = |name: &Option<String>| {
                let frame = |name: &String| {
                    let frame = mechanism.frame(name);
                    frame.ok_or_else(|| Refused::Said(unknown_frame(mechanism, name)))
                };
                name.as_ref().map(frame).transpose()
            };
            let (of, relative_to) = (frame(&settings.of)?, frame(&settings.relative_to)?);
            let settings = FormulasSettings {
                transform: of.map(|of| (of, relative_to.unwrap_or(Frame::Ground))),
                ..FormulasSettings::default()
            };
            prefaced(mechanism, question.formulas(&settings)?)
        }
        "circuits" => prefaced(mechanism, question.circuits(watch)?),
        "sweep" => return motions(asked, mechanism, watch),
        _ => unreachable!("the questions of the package are these"),
    })
}

/// Rows of motions are kept as columns, and few of them in the report.
fn motions(
    asked: &GivenQuestion,
    mechanism: &Mechanism,
    watch: &Watch,
) -> Result<(PythonReport, Vec<ArrayColumn>), Refused> {
    let all = asked.question.motions(&asked.settings.sweep, watch)?;
    let names = all.columns();
    let mut columns = ArrayColumn::named(row_columns(&names));
    let mut sink = |mode: Option<usize>, row: &Row| {
        ArrayColumn::row(&mut columns, row_values(&names, mode, row));
    };
    let report = all.report(SHOWN, &mut sink, watch);
    let report = Prefaced::new(mechanism, report);
    Ok((PythonReport(Box::new(report)), columns))
}
