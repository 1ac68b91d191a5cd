//! Arguments of a call, put into a question.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use super::QuestionError;
use super::words::{Keywords, Refused, message, worded};
use crate::algebra::SiUnit;
use crate::analysis::assemblies::Wanted;
use crate::analysis::compare::CompareSettings;
use crate::analysis::equilibrium::EquilibriumSettings;
use crate::analysis::simulation::{DURATIONS, SimulationSettings, TOLERANCES};
use crate::analysis::singularities::SingularitiesSettings;
use crate::analysis::sweep::{Law, SweepSettings};
use crate::analysis::workspace::WorkspaceSettings;
use crate::ask::{Demand, Mode, Question, Role, Value};
use crate::description::listed;
use crate::mechanism::Mechanism;
use crate::output::complaint::{Complaint, Ranged, Wording, setting};
use crate::output::diagnostics::Style;
use crate::solve::Pruning;

/// A number in SI units and rad, or an expression with units as in a file.
#[derive(Clone)]
pub enum GivenNumber {
    Number(f64),
    Text(String),
}

impl<'py> FromPyObject<'_, 'py> for GivenNumber {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(text) = given.extract::<String>() {
            return Ok(GivenNumber::Text(text));
        }
        match given.is_instance_of::<PyBool>() {
            true => Err(PyTypeError::new_err("a truth value is no number")),
            false => Ok(GivenNumber::Number(given.extract()?)),
        }
    }
}

impl Display for GivenNumber {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            GivenNumber::Number(number) => write!(f, "{number:?}"),
            GivenNumber::Text(text) => f.write_str(text),
        }
    }
}

/// Numbers are read as the command line reads them, which refuses angles of many turns without a unit.
impl From<&GivenNumber> for Value {
    fn from(given: &GivenNumber) -> Self {
        match given {
            GivenNumber::Number(number) if !number.is_finite() => Value::Number(*number),
            number => Value::Text(number.to_string()),
        }
    }
}

#[derive(FromPyObject)]
enum Names {
    One(String),
    Several(Vec<String>),
}

/// Value of an argument, or an error that names the argument and its types.
fn taken<'a, 'py, T: FromPyObject<'a, 'py>>(
    name: &str,
    wanted: &str,
    given: &'a Bound<'py, PyAny>,
) -> PyResult<T> {
    // Python counts truth values among whole numbers
    let flag = given.is_instance_of::<PyBool>() && wanted != FLAG;
    if !flag && let Ok(taken) = given.extract() {
        return Ok(taken);
    }
    let kind = given.get_type().name()?.to_string();
    let found = match kind.as_str() {
        "NoneType" => "None".into(),
        "int" => {
            return Err(QuestionError::new_err(format!(
                "`{name}` is {wanted}, not {given}"
            )));
        }
        _ if kind.starts_with(['a', 'e', 'i', 'o', 'u']) => format!("an {kind}"),
        _ => format!("a {kind}"),
    };
    Err(PyTypeError::new_err(format!(
        "`{name}` is {wanted}, not {found}"
    )))
}

const VALUE: &str = "a number or a text such as \"60 deg\"";
const COUNT: &str = "a whole number from 0 on";
const FLAG: &str = "True or False";
const TEXT: &str = "a text";

/// Settings of analyses.
#[derive(Default)]
pub struct Settings {
    /// True if a mode is chosen by its number, for which all assemblies are searched.
    pub numbered: bool,
    pub assemblies: Wanted,
    pub singularities: SingularitiesSettings,
    pub sweep: SweepSettings,
    pub workspace: WorkspaceSettings,
    pub compare: CompareSettings,
    pub equilibrium: EquilibriumSettings,
    pub simulation: SimulationSettings,
    pub of: Option<String>,
    pub relative_to: Option<String>,
}

type Entries<'py> = Vec<(String, Bound<'py, PyAny>)>;

/// The values that a mapping gives to names.
fn entries<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Entries<'py>> {
    let entries: Bound<PyDict> = taken(name, "a mapping from names", given)?;
    let named = |(key, value): (Bound<'py, PyAny>, _)| {
        Ok((
            taken(&format!("{name}: the name {key}"), TEXT, &key)?,
            value,
        ))
    };
    entries.iter().map(named).collect()
}

/// The numbers and expressions that a mapping gives to names.
pub fn values(name: &str, given: &Bound<PyAny>) -> PyResult<Vec<(String, GivenNumber)>> {
    let entries = entries(name, given)?.into_iter();
    let value = |(of, value): (String, Bound<PyAny>)| {
        let number = taken(&format!("{name}[{of:?}]"), VALUE, &value)?;
        Ok((of, number))
    };
    entries.map(value).collect()
}

/// The ends of a range.
fn range(name: &str, given: &Bound<PyAny>) -> PyResult<(GivenNumber, GivenNumber)> {
    let ends: Vec<Bound<PyAny>> = taken(name, "two values, (from, to)", given)?;
    match &ends[..] {
        [from, to] => Ok((
            taken(&format!("{name}[0]"), VALUE, from)?,
            taken(&format!("{name}[1]"), VALUE, to)?,
        )),
        _ => {
            let said = format!("`{name}` is two values, (from, to), not {}", ends.len());
            Err(QuestionError::new_err(said))
        }
    }
}

fn law(word: &str) -> PyResult<Law> {
    Law::from_word(word).ok_or_else(|| {
        let said = Complaint::new(format!("`{word}` is no law of motion"));
        let laws = listed(Law::ALL.map(Law::word));
        QuestionError::new_err(worded(&said.help(format!("the laws are {laws}"))))
    })
}

/// A question with what posed it.
pub struct GivenQuestion {
    pub question: Question,
    pub settings: Settings,
    keywords: Keywords,
    ranged: Ranged,
}

/// Keywords of roles that have another name, and of ranges with their use.
const ALIASES: [(&str, Role, Ranged); 2] = [
    ("locus", Role::Input, Ranged::Locus),
    ("map", Role::Input, Ranged::Map),
];

impl GivenQuestion {
    /// The question of a mechanism with what keywords say, in their order.
    pub fn new(mechanism: Arc<Mechanism>, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut asked = GivenQuestion {
            question: Question::new(mechanism),
            settings: Settings::default(),
            keywords: Keywords::default(),
            ranged: Ranged::Input,
        };
        for (key, value) in given {
            asked.put(&key.extract::<String>()?, &value)?;
        }
        Ok(asked)
    }

    /// Puts what a keyword gives into the question or the settings.
    pub fn put(&mut self, key: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let alias = ALIASES.iter().find(|(keyword, ..)| *keyword == key);
        let role = match alias {
            Some((_, role, ranged)) => {
                self.ranged = *ranged;
                Some(*role)
            }
            None if key == "trace" => {
                self.keywords.spelled.push((Role::Point, "of"));
                Some(Role::Point)
            }
            None => Role::from_word(key),
        };
        match role {
            None => self.set(key, given)?,
            Some(role @ (Role::Input | Role::Vary)) => {
                if role == Role::Vary {
                    self.ranged = Ranged::Vary;
                }
                for (name, ends) in entries(key, given)? {
                    let (from, to) = range(&format!("{key}[{name:?}]"), &ends)?;
                    self.question.add(Demand::new(role, name, [&from, &to]));
                }
            }
            Some(
                role @ (Role::Free
                | Role::Lock
                | Role::Output
                | Role::Point
                | Role::Report
                | Role::Without),
            ) => {
                let names = match taken(key, "a name or a list of names", given)? {
                    Names::One(name) => vec![name],
                    Names::Several(names) => names,
                };
                let demands = names.into_iter().map(|name| Demand::named(role, name));
                demands.for_each(|demand| self.question.add(demand));
            }
            Some(role) => {
                for (name, number) in values(key, given)? {
                    self.question.add(Demand::new(role, name, [&number]));
                }
            }
        }
        Ok(())
    }

    fn set(&mut self, key: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let mechanism = self.question.mechanism().clone();
        let number = |unit, range| {
            let value = Value::from(&taken::<GivenNumber>(key, VALUE, given)?);
            let number = setting(&mechanism, &value, unit, range);
            number.map_err(|said| QuestionError::new_err(format!("`{key}`: {}", worded(&said))))
        };
        let settings = &mut self.settings;
        match key {
            "mode" => {
                settings.numbered = true;
                let mode = match given.extract::<String>() {
                    Ok(all) if all == "all" => Mode::All,
                    _ => Mode::Number(taken(key, "a whole number from 1 on, or \"all\"", given)?),
                };
                self.change(|question| question.mode(mode));
            }
            "seed" => {
                let seed = taken(key, COUNT, given)?;
                settings.equilibrium.seed = seed;
                self.change(|question| question.seed(seed));
            }
            "all_complex" => settings.assemblies.all_complex = taken(key, FLAG, given)?,
            "prove" => {
                let prove: bool = taken(key, FLAG, given)?;
                settings.assemblies.proof = prove.then(Pruning::default);
            }
            "follow" => {
                settings.sweep.follow = taken(key, FLAG, given)?;
                settings.singularities.follow = settings.sweep.follow;
            }
            "certify" => settings.sweep.certify = taken(key, FLAG, given)?,
            "straight" => settings.sweep.straightness = taken(key, FLAG, given)?,
            "steps" => settings.sweep.steps = taken(key, COUNT, given)?,
            "law" => settings.sweep.pace.law = law(&taken::<String>(key, TEXT, given)?)?,
            "duration" => {
                settings.sweep.pace.duration = number(SiUnit::SECOND, (f64::MIN, f64::MAX))?;
            }
            "grid" => settings.workspace.nodes = taken(key, "a list of whole numbers", given)?,
            "starts" => {
                settings.workspace.starts = taken(key, COUNT, given)?;
                settings.singularities.starts = settings.workspace.starts;
                settings.equilibrium.starts = settings.workspace.starts;
            }
            "all" => settings.equilibrium.all = taken(key, FLAG, given)?,
            "time" => settings.simulation.duration = number(SiUnit::SECOND, DURATIONS)?,
            "rows" => settings.simulation.rows = taken(key, COUNT, given)?,
            "error" => settings.simulation.tolerance = number(SiUnit::ONE, TOLERANCES)?,
            "restitution" => {
                settings.simulation.restitution = Some(number(SiUnit::ONE, (0.0, 1.0))?);
            }
            "linearise" => settings.simulation.linearised = taken(key, FLAG, given)?,
            "through" => settings.simulation.through = taken(key, FLAG, given)?,
            "search" => settings.workspace.searched = taken(key, COUNT, given)?,
            "samples" => settings.compare.samples = taken(key, COUNT, given)?,
            "of" => settings.of = Some(taken(key, "the name of a frame", given)?),
            "relative_to" => settings.relative_to = Some(taken(key, "the name of a frame", given)?),
            _ => {
                return Err(QuestionError::new_err(format!(
                    "there is no option `{key}`"
                )));
            }
        }
        Ok(())
    }

    fn change(&mut self, change: impl FnOnce(Question) -> Question) {
        self.question = change(self.question.clone());
    }

    /// The exception for an error, under the keyword that is wrong if one is.
    pub fn refusal(&self, error: &Refused) -> PyErr {
        let wording = Wording {
            door: &self.keywords,
            ranged: self.ranged,
        };
        QuestionError::new_err(match error {
            Refused::Asked(error) => message(&wording.refusal(&self.question, error, Style::Plain)),
            Refused::Said(said) => worded(said),
        })
    }
}
