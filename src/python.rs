//! The Python module `linkwork._linkwork`: a thin layer over [`ask`](crate::ask) and [`output`](crate::output).
//!
//! The text for Python users is in `python/linkwork/__init__.py`, which gives these few functions signatures and
//! documentation.

mod asked;
mod designed;
mod report;
mod watched;
mod words;

use std::ffi::OsString;
use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat};

use crate::algebra::{LARGEST_BARE, Measure};
use crate::analysis::convert::to_axes;
use crate::ask::{AskError, Points, Study, Unreached};
use crate::description::{Description, FileError, Role};
use crate::mechanism;
use crate::output::Rows;
use crate::output::complaint::Given;
use crate::output::diagnostics::{self, Style};
use crate::output::document::Cell;
use crate::output::drawing::{DrawingSettings, Panel, sheet};
use crate::scene::Scene;
use crate::view::{Viewed, page};
use asked::{GivenQuestion, values};
use report::PythonReport;
use watched::watched;

/// Values of rows that are followed where they are asked for, without a thread beside.
const FEW: usize = 1000;

/// Reason for which a row was not reached.
fn said(why: Unreached) -> &'static str {
    match why {
        Unreached::NotFinite => "a value is not finite",
        Unreached::NoPath => {
            "no path on one branch leads there from the row before or from the start: it is beyond a dead point or out of \
             reach, which search=True tells apart"
        }
        Unreached::NotFound => "no assembly was found there: `solve` says how near it comes",
    }
}

type NamedArrays<'py> = Vec<(String, Bound<'py, PyAny>)>;

create_exception!(
    linkwork,
    Error,
    PyValueError,
    "What is wrong, where, and the remedy, in the words of the command line."
);
create_exception!(
    linkwork,
    MechanismError,
    Error,
    "A mechanism is wrong; the message shows the lines."
);
create_exception!(
    linkwork,
    QuestionError,
    Error,
    "A question cannot be answered as it is put."
);

/// A mechanism as a text describes it.
#[pyclass(frozen, name = "Mechanism", module = "linkwork._linkwork")]
struct PythonMechanism {
    text: Arc<str>,
    /// The text with the parameters that were given when it was read.
    description: Arc<Description>,
    /// Parameters that were given after that.
    set: Vec<(String, f64)>,
    mechanism: Arc<mechanism::Mechanism>,
}

#[pymethods]
impl PythonMechanism {
    /// Reads a text whose errors name it as `name`, and gives parameters other values.
    #[new]
    fn new(text: String, name: &str, parameters: &Bound<'_, PyAny>) -> PyResult<Self> {
        let parameters = values("parameters", parameters)?;
        let style = Style::Plain;
        let description = Description::read(&text).map_err(|_| {
            let wrong = FileError::new(name, &text, mechanism::Mechanism::problems(&text));
            MechanismError::new_err(diagnostics::render(&wrong, style))
        })?;
        let values: Vec<String> = parameters.iter().map(|(_, v)| v.to_string()).collect();
        let set: Vec<Given> = (parameters.iter().zip(&values))
            .map(|((name, _), value)| Given::new("with_parameters", name, Some(value)))
            .collect();
        let made = diagnostics::made(name, &text, description, &set, style);
        let (description, mechanism) = made.map_err(MechanismError::new_err)?;
        Ok(PythonMechanism {
            text: text.into(),
            description: description.into(),
            set: Vec::new(),
            mechanism: mechanism.into(),
        })
    }

    #[getter]
    fn name(&self) -> &str {
        self.mechanism.name()
    }

    /// The joint variables: name, unit, whether it is driven, home, limits.
    #[allow(clippy::type_complexity)]
    fn joints(&self) -> Vec<(String, &'static str, bool, f64, Option<(f64, f64)>)> {
        let joints = self.mechanism.joints().iter();
        let of = |joint: &mechanism::Joint| {
            let unit = if joint.kind.is_angle() { "rad" } else { "m" };
            let driven = joint.role == Role::Actuated;
            (joint.name.clone(), unit, driven, joint.home, joint.limits)
        };
        joints.map(of).collect()
    }

    /// The parameters with their values in m, rad or without unit.
    fn parameters(&self) -> Vec<(String, f64)> {
        let parameters = self.mechanism.parameters().iter();
        parameters.map(|p| (p.name.to_string(), p.value)).collect()
    }

    /// Warnings about the file, in words; empty if there are none.
    fn warnings(&self, name: &str) -> String {
        diagnostics::warnings(&self.mechanism, name, &self.text, Style::Plain)
    }

    /// The mechanism with other values of parameters, where they are plain numbers; none where the text has to be read
    /// again, which also says what is wrong.
    fn with_parameters(&self, parameters: &Bound<'_, PyDict>) -> Option<PythonMechanism> {
        let known = self.mechanism.parameters();
        let mut set = self.set.clone();
        let mut given = Vec::with_capacity(parameters.len());
        for (name, value) in parameters {
            let (name, value) = (
                name.extract::<String>().ok()?,
                value.cast_exact::<PyFloat>().ok()?,
            );
            let (value, place) = (
                value.value(),
                known.iter().position(|of| *of.name == *name)?,
            );
            if value.abs() > LARGEST_BARE && known[place].measure != Measure::Length {
                return None;
            }
            given.push((place, value));
            set.retain(|(of, _)| *of != name);
            set.push((name, value));
        }
        // rounded numbers that close a loop are corrected when the text is read
        let exact = self.mechanism.rounding().is_none() && !given.is_empty();
        let mechanism = exact.then(|| self.mechanism.with_values(&given).ok())??;
        Some(PythonMechanism {
            text: self.text.clone(),
            description: self.description.clone(),
            set,
            mechanism: mechanism.into(),
        })
    }

    /// The mechanism as a file of tables, or of joint coordinates.
    fn ron(&self, axes: bool) -> PyResult<String> {
        let refused = |error: &dyn std::fmt::Display| Error::new_err(error.to_string());
        let description = self.described()?;
        match axes {
            false => description.to_ron().map_err(|e| refused(&e)),
            true => {
                let made = to_axes(&self.mechanism, &description);
                let (axes, _) = made.map_err(|e| refused(&e))?;
                axes.to_ron().map_err(|e| refused(&e))
            }
        }
    }

    fn page(&self, file: &str, set: &Bound<'_, PyAny>) -> PyResult<String> {
        let set = values("parameters", set)?.into_iter();
        Ok(page(&Viewed {
            file: file.into(),
            text: self.text.to_string(),
            set: set.map(|(name, value)| (name, value.to_string())).collect(),
            watch: false,
        }))
    }

    /// Does what the method of that name of a question does. `progress` is called with words, what is done, and of how
    /// much.
    fn ask<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        given: &Bound<'py, PyDict>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(PythonReport, NamedArrays<'py>)> {
        let asked = GivenQuestion::new(self.mechanism.clone(), given)?;
        let long = what != "solve" || asked.settings.numbered;
        let answer = watched(py, progress, long, |watch| {
            report::answer(what, &asked, &self.mechanism, watch)
        })?;
        let (report, columns) = answer.map_err(|error| asked.refusal(&error))?;
        let columns = columns.into_iter().map(|column| column.into_array(py));
        Ok((report, columns.collect::<PyResult<_>>()?))
    }

    /// A picture of the configurations that a question means.
    fn svg(&self, py: Python<'_>, given: &Bound<'_, PyDict>, labels: bool) -> PyResult<String> {
        let asked = GivenQuestion::new(self.mechanism.clone(), given)?;
        let modes = watched(py, None, true, |watch| asked.question.configurations(watch))?;
        let modes = modes.map_err(|error| asked.refusal(&error.into()))?;
        let name = self.mechanism.name();
        let panel = |(mode, at): &(_, _)| Panel::new(name, *mode, Scene::of(&self.mechanism, at));
        let panels: Vec<Panel> = modes.iter().map(panel).collect();
        let settings = DrawingSettings {
            labels,
            ..DrawingSettings::default()
        };
        Ok(sheet(&panels, &settings).svg())
    }

    /// Configurations for rows of held values: the columns, their values row by row, whether each row was reached, and why
    /// not; then the quantities with their units, row by row, and Jacobians with their rows and columns.
    #[allow(clippy::type_complexity, clippy::too_many_arguments)]
    fn solve_many<'py>(
        &self,
        py: Python<'py>,
        given: &Bound<'py, PyDict>,
        names: Vec<String>,
        values: PyReadonlyArray2<'py, f64>,
        jacobian: bool,
        search: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(
        Vec<String>,
        Bound<'py, PyArray2<f64>>,
        Bound<'py, PyArray1<bool>>,
        Vec<(usize, &'static str)>,
        Option<(Vec<(String, String)>, Bound<'py, PyArray2<f64>>)>,
        Option<(Vec<String>, Vec<String>, Bound<'py, PyArray3<f64>>)>,
    )> {
        let asked = GivenQuestion::new(self.mechanism.clone(), given)?;
        let question = &asked.question;
        let measured = jacobian || given.contains("report")?;
        let rows = values.as_slice()?;
        let long = measured || search || rows.len() > FEW;
        let found = watched(py, progress, long, |watch| {
            let mut many = question.solve_many(&names, rows, watch)?;
            if search {
                question.search_many(&names, rows, &mut many, watch)?;
            }
            let measured = measured.then(|| question.measure_many(&names, &many, jacobian, watch));
            Ok::<_, AskError>((many, measured.transpose()?))
        })?;
        let (many, measured) = found.map_err(|error: AskError| asked.refusal(&error.into()))?;
        let (rows, width) = (many.reached.len(), many.names.len());
        let lost = many.lost.iter().map(|(row, why)| (*row, said(*why)));
        let (quantities, jacobians) = match measured {
            None => (None, None),
            Some(of) => {
                let titles = of.columns.iter();
                let titles: Vec<_> = titles
                    .map(|of| (of.name.clone(), of.unit.to_string()))
                    .collect();
                let shape = [rows, titles.len()];
                let values = PyArray1::from_vec(py, of.values).reshape(shape)?;
                let jacobians = of.jacobians.map(|of| {
                    let [outputs, inputs] = [&of.rows, &of.columns].map(|axes| {
                        axes.iter()
                            .map(|axis| axis.name.clone())
                            .collect::<Vec<_>>()
                    });
                    let shape = [rows, outputs.len(), inputs.len()];
                    let entries = PyArray1::from_vec(py, of.entries).reshape(shape)?;
                    Ok::<_, PyErr>((outputs, inputs, entries))
                });
                (Some((titles, values)), jacobians.transpose()?)
            }
        };
        Ok((
            many.names,
            PyArray1::from_vec(py, many.values).reshape([rows, width])?,
            PyArray1::from_vec(py, many.reached),
            lost.collect(),
            quantities,
            jacobians,
        ))
    }

    /// Rows of a study: part of so many, with their columns.
    #[allow(clippy::too_many_arguments)]
    fn study<'py>(
        &self,
        py: Python<'py>,
        given: &Bound<'py, PyDict>,
        vary: &Bound<'py, PyAny>,
        deviate: &Bound<'py, PyAny>,
        kind: &str,
        counts: Vec<usize>,
        rows: Option<PyReadonlyArray2<'py, f64>>,
        part: (usize, usize),
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Vec<(String, Bound<'py, PyArray1<f64>>)>> {
        let count = counts.first().copied().unwrap_or_default();
        let points = match (rows, kind) {
            (Some(rows), _) => {
                let rows = rows.as_array();
                Points::Given(rows.rows().into_iter().map(|row| row.to_vec()).collect())
            }
            (None, "grid") => Points::Grid(counts),
            (None, "latin") => Points::LatinHypercube(count),
            (None, _) => Points::Sobol(count),
        };
        let mut asked = GivenQuestion::new(self.mechanism.clone(), given)?;
        asked.put("vary", vary)?;
        asked.put("deviate", deviate)?;
        let study = Study::new(&asked.question, points);
        let study = study.map_err(|error| asked.refusal(&error.into()))?;
        let range = study.shard(part.0, part.1);
        let range = range.map_err(|error| asked.refusal(&AskError::from(error).into()))?;
        let found = watched(py, progress, true, |watch| study.rows(range, watch))?;
        let columns = found.columns.iter().enumerate().map(|(i, of)| {
            let values = found.rows.iter().map(|row| row[i].unwrap_or(f64::NAN));
            (of.to_string(), PyArray1::from_iter(py, values))
        });
        Ok(columns.collect())
    }
}

impl PythonMechanism {
    /// The description with the parameters that were given.
    fn described(&self) -> PyResult<Description> {
        let mut description = Description::clone(&self.description);
        for (name, value) in &self.set {
            let given = Given::new("with_parameters", name, None);
            description = (description.with_parameter(name, &format!("{value:?}")))
                .map_err(|e| Error::new_err(diagnostics::replacement(&e, &given, Style::Plain)))?;
        }
        Ok(description)
    }
}

/// Columns as comma-separated values, as the command line writes them.
#[pyfunction]
fn csv(titles: Vec<String>, columns: Vec<PyReadonlyArray1<'_, f64>>) -> String {
    let columns: Vec<_> = columns.iter().map(|column| column.as_array()).collect();
    let rows = 0..columns.first().map_or(0, |column| column.len());
    let rows = rows.map(|row| {
        columns
            .iter()
            .map(|column| Cell::from(column[row]))
            .collect()
    });
    crate::output::csv::render(Rows::new(titles, rows))
}

/// The regions of a grid, as `linkwork merge --regions` numbers them.
#[pyfunction]
fn regions<'py>(
    py: Python<'py>,
    grid: Vec<usize>,
    within: Vec<bool>,
) -> PyResult<Bound<'py, PyArray1<u32>>> {
    let found = crate::ask::regions(&grid, &within);
    let found =
        found.ok_or_else(|| PyValueError::new_err("the rows are not those of this grid"))?;
    Ok(PyArray1::from_vec(py, found))
}

#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| crate::cli::run(arguments))
}

#[pymodule]
fn _linkwork(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    watched::begin();
    module.add("Error", py.get_type::<Error>())?;
    module.add("MechanismError", py.get_type::<MechanismError>())?;
    module.add("QuestionError", py.get_type::<QuestionError>())?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<PythonMechanism>()?;
    module.add_class::<PythonReport>()?;
    module.add_function(wrap_pyfunction!(self::csv, module)?)?;
    module.add_function(wrap_pyfunction!(regions, module)?)?;
    module.add_function(wrap_pyfunction!(designed::design, module)?)?;
    module.add_function(wrap_pyfunction!(run, module)?)
}
