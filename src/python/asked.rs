//! What a call gives, put into a question.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;

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
#[derive(FromPyObject)]
pub enum Number {
    Number(f64),
    Text(String),
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Number::Number(number) => write!(f, "{number:?}"),
            Number::Text(text) => f.write_str(text),
        }
    }
}

impl From<&Number> for Value {
    fn from(given: &Number) -> Self {
        match given {
            Number::Number(number) => Value::Number(*number),
            Number::Text(text) => Value::Text(text.clone()),
        }
    }
}

#[derive(FromPyObject)]
enum Names {
    One(String),
    Several(Vec<String>),
}

/// How analyses work.
#[derive(Default)]
pub struct Settings {
    /// Whether a mode is meant by its number, for which all assemblies are searched.
    pub numbered: bool,
    pub assemblies: Wanted,
    pub singularities: SingularitiesSettings,
    pub sweep: SweepSettings,
    pub workspace: WorkspaceSettings,
    pub compare: CompareSettings,
    pub of: Option<String>,
    pub relative_to: Option<String>,
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

    /// The same with what a study varies, which is wrong where it is.
    pub fn varied(
        mechanism: Arc<Mechanism>,
        given: &Bound<'_, PyDict>,
        vary: &[(String, (Number, Number))],
    ) -> PyResult<Self> {
        let mut asked = Asked::new(mechanism, given)?;
        asked.ranges = Ranged::Vary;
        for (name, (from, to)) in vary {
            let range = Some(format!("{from}..{to}"));
            asked.parts.push((Role::Input, "vary", name.clone(), range));
        }
        Ok(asked)
    }

    fn put(&mut self, key: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
        if let Some((option, role, put)) = VALUES.iter().find(|(option, ..)| *option == key) {
            let pairs: Vec<(String, Number)> = given.cast::<PyDict>()?.items().extract()?;
            for (name, number) in pairs {
                self.change(|question| put(question, name.clone(), (&number).into()));
                let value = Some(number.to_string());
                self.parts.push((*role, option, name, value));
            }
        } else if let Some((option, role, put)) = NAMES.iter().find(|(option, ..)| *option == key) {
            let names = match given.extract()? {
                Names::One(name) => vec![name],
                Names::Several(names) => names,
            };
            for name in names {
                self.change(|question| put(question, name.clone()));
                self.parts.push((*role, option, name, None));
            }
        } else if let Some((option, ranges)) = RANGES.iter().find(|(option, _)| *option == key) {
            let pairs: Vec<(String, (Number, Number))> =
                given.cast::<PyDict>()?.items().extract()?;
            for (name, (from, to)) in pairs {
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
                    Ok(_) => return Err(QuestionError::new_err("a mode is a number or \"all\"")),
                    Err(_) => Mode::Number(given.extract()?),
                };
                self.change(|question| question.mode(mode));
            }
            "seed" => {
                let seed = given.extract()?;
                self.change(|question| question.seed(seed));
            }
            "all_complex" => settings.assemblies.all_complex = given.extract()?,
            "prove" => {
                let prove: bool = given.extract()?;
                settings.assemblies.proof = prove.then(Pruning::default);
            }
            "follow" => {
                settings.sweep.follow = given.extract()?;
                settings.singularities.follow = settings.sweep.follow;
            }
            "certify" => settings.sweep.certify = given.extract()?,
            "straight" => settings.sweep.straightness = given.extract()?,
            "steps" => settings.sweep.steps = given.extract()?,
            "law" => settings.sweep.pace.law = law(&given.extract::<String>()?)?,
            "duration" => settings.sweep.pace.duration = given.extract()?,
            "grid" => settings.workspace.nodes = given.extract()?,
            "starts" => {
                settings.workspace.starts = given.extract()?;
                settings.singularities.starts = settings.workspace.starts;
            }
            "search" => settings.workspace.searched = given.extract()?,
            "samples" => settings.compare.samples = given.extract()?,
            "of" => settings.of = Some(given.extract()?),
            "relative_to" => settings.relative_to = Some(given.extract()?),
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

    /// What is wrong with the question, in the words of the command line, under what says so if something does.
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
