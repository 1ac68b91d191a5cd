//! Arguments of a call, put into a question.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use super::QuestionError;
use super::words::{Refused, worded};
use crate::analysis::assemblies::Wanted;
use crate::analysis::compare::CompareSettings;
use crate::analysis::singularities::SingularitiesSettings;
use crate::analysis::sweep::{Law, SweepSettings};
use crate::analysis::workspace::WorkspaceSettings;
use crate::ask::{Mode, Question, Role, Value};
use crate::cli::{self, Ranged};
use crate::description::listed;
use crate::mechanism::Mechanism;
use crate::output::complaint::{Complaint, Given};
use crate::solve::Pruning;

/// A number in SI units and rad, or an expression with units as in a file.
#[derive(Clone)]
pub enum Number {
    Number(f64),
    Text(String),
}

/// A name with the ends of its range.
pub(super) type Interval = (String, Value, Value);

impl<'py> FromPyObject<'_, 'py> for Number {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(text) = given.extract::<String>() {
            return Ok(Number::Text(text));
        }
        match given.is_instance_of::<PyBool>() {
            true => Err(PyTypeError::new_err("a truth value is no number")),
            false => Ok(Number::Number(given.extract()?)),
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Number::Number(number) => write!(f, "{number:?}"),
            Number::Text(text) => f.write_str(text),
        }
    }
}

/// Numbers are read as the command line reads them, which refuses angles of many turns without a unit.
impl From<&Number> for Value {
    fn from(given: &Number) -> Self {
        match given {
            Number::Number(number) if !number.is_finite() => Value::Number(*number),
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
pub fn values(name: &str, given: &Bound<PyAny>) -> PyResult<Vec<(String, Number)>> {
    let entries = entries(name, given)?.into_iter();
    let value = |(of, value): (String, Bound<PyAny>)| {
        let number = taken(&format!("{name}[{of:?}]"), VALUE, &value)?;
        Ok((of, number))
    };
    entries.map(value).collect()
}

/// The ends of a range.
fn range(name: &str, given: &Bound<PyAny>) -> PyResult<(Number, Number)> {
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
        QuestionError::new_err(worded(said.help(format!("the laws are {laws}")), None))
    })
}

/// Something that was given, to be shown where it is wrong: the option, its name and its value.
type Part = (Role, &'static str, String, Option<String>);

/// A question with what posed it.
pub struct Asked {
    pub question: Question,
    pub settings: Settings,
    parts: Vec<Part>,
    ranges: Ranged,
}

/// The options that give values to names.
type Put = fn(Question, String, Value) -> Question;
const VALUES: [(&str, Role, Put); 7] = [
    ("hold", Role::Hold, Question::hold),
    ("guess", Role::Guess, Question::guess),
    ("rate", Role::Rate, Question::rate),
    ("acceleration", Role::Acceleration, Question::acceleration),
    ("load", Role::Load, Question::load),
    ("dwell", Role::Dwell, Question::dwell),
    ("wrench", Role::Wrench, |question, name, value| {
        question.wrench_text(name, value.to_string())
    }),
];

type Name = fn(Question, String) -> Question;
const NAMES: [(&str, Role, Name); 6] = [
    ("free", Role::Free, Question::free),
    ("lock", Role::Lock, Question::lock),
    ("output", Role::Output, Question::output),
    ("point", Role::Point, Question::point),
    ("trace", Role::Point, Question::point),
    ("report", Role::Quantity, Question::report),
];

const RANGES: [(&str, Ranged); 3] = [
    ("input", Ranged::Input),
    ("locus", Ranged::Locus),
    ("map", Ranged::Map),
];

impl Asked {
    /// The question of a mechanism with what keywords say, in their order.
    pub fn new(mechanism: Arc<Mechanism>, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut asked = Asked {
            question: Question::new(mechanism),
            settings: Settings::default(),
            parts: Vec::new(),
            ranges: Ranged::Input,
        };
        for (key, value) in given {
            asked.put(&key.extract::<String>()?, &value)?;
        }
        Ok(asked)
    }

    /// Adds the varied names of a study; an error if one is wrong.
    pub fn varied(
        mechanism: Arc<Mechanism>,
        given: &Bound<'_, PyDict>,
        vary: &Bound<'_, PyAny>,
    ) -> PyResult<(Self, Vec<Interval>)> {
        let mut asked = Asked::new(mechanism, given)?;
        asked.ranges = Ranged::Vary;
        let mut varied = Vec::new();
        for (name, ends) in entries("vary", vary)? {
            let (from, to) = range(&format!("vary[{name:?}]"), &ends)?;
            let range = Some(format!("{from}..{to}"));
            asked.parts.push((Role::Input, "vary", name.clone(), range));
            varied.push((name, (&from).into(), (&to).into()));
        }
        Ok((asked, varied))
    }

    fn put(&mut self, key: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
        if let Some((option, role, put)) = VALUES.iter().find(|(option, ..)| *option == key) {
            for (name, number) in values(key, given)? {
                self.change(|question| put(question, name.clone(), (&number).into()));
                let value = Some(number.to_string());
                self.parts.push((*role, option, name, value));
            }
        } else if let Some((option, role, put)) = NAMES.iter().find(|(option, ..)| *option == key) {
            let names = match taken(key, "a name or a list of names", given)? {
                Names::One(name) => vec![name],
                Names::Several(names) => names,
            };
            for name in names {
                self.change(|question| put(question, name.clone()));
                self.parts.push((*role, option, name, None));
            }
        } else if let Some((option, ranges)) = RANGES.iter().find(|(option, _)| *option == key) {
            for (name, ends) in entries(key, given)? {
                let (from, to) = range(&format!("{key}[{name:?}]"), &ends)?;
                self.ranges = *ranges;
                self.change(|question| question.input(&name, &from, &to));
                let range = Some(format!("{from}..{to}"));
                self.parts.push((Role::Input, option, name, range));
            }
        } else {
            self.set(key, given)?;
        }
        Ok(())
    }

    fn set(&mut self, key: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
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
            "duration" => settings.sweep.pace.duration = taken(key, "a number of seconds", given)?,
            "grid" => settings.workspace.nodes = taken(key, "a list of whole numbers", given)?,
            "starts" => {
                settings.workspace.starts = taken(key, COUNT, given)?;
                settings.singularities.starts = settings.workspace.starts;
            }
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

    /// The error in the question, in the words of the command line, under the argument that it is in, if it is in one.
    pub fn refusal(&self, error: &Refused) -> PyErr {
        let parts = self
            .parts
            .iter()
            .map(|(role, option, name, value)| (*role, Given::new(option, name, value.as_deref())));
        let given: Vec<(Role, Given)> = parts.collect();
        QuestionError::new_err(match error {
            Refused::Asked(error) => {
                let (said, given) = cli::said(&self.question, &given, self.ranges, error);
                worded(said, given)
            }
            Refused::Said(said) => worded(said.clone(), None),
        })
    }
}
