//! Studies: quantities at many points of parameters and coordinates, cut into shards.
//!
//! A row is a function of the mechanism, the question, the points, the seed and its number. Where, when and how often it is
//! worked out changes no byte of it, so that shards put together in their order are the study.

mod measured;
mod points;
mod regions;

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

pub use points::{Points, ScatteredPoints};
pub use regions::regions;

use super::study_error::StudyError;
use super::{AskError, Question, Role};
use crate::algebra::{Measure, SiUnit};
use crate::description::nearest;
use crate::mechanism::{Mechanism, Parameter, Quantity, Variable};
use crate::solve::{Progress, Stage, Watch, each};
use crate::system::{self, Coordinate, QuestionError, check_count};

/// The number of real assemblies, which is no quantity of one configuration.
const ASSEMBLIES: &str = "assemblies";

/// Rows computed at once at most: they are kept until all are done, and take some 200 bytes each.
const MOST_ROWS: usize = 10_000_000;

/// A study: a question with some names varied.
#[derive(Clone)]
pub struct Study {
    question: Question,
    points: Points,
    varied: Vec<StudyVariable>,
    ranges: Vec<ScatteredPoints>,
    /// True if assemblies are counted.
    counted: bool,
    columns: Vec<Variable>,
    /// True if links spin about their own lines.
    spins: bool,
}

/// A varied parameter or coordinate.
#[derive(Clone)]
struct StudyVariable {
    name: String,
    unit: SiUnit,
    /// The index of the parameter.
    parameter: Option<usize>,
}

/// Some rows of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRows {
    /// The columns: the number of the row, the varied values, 1 or 0 as the mechanism assembles or not, the quantities.
    pub columns: Vec<Variable>,
    /// The rows in their order; empty where something is not determined.
    pub rows: Vec<Vec<Option<f64>>>,
    /// True if the work was stopped early; then rows are missing at the end.
    pub interrupted: bool,
}

/// The rows of a shard, from 1, of so many of so many rows: all have the same number but for one.
///
/// # Errors
/// If there is no such shard.
pub fn part_of(rows: usize, shard: usize, of: usize) -> Result<Range<usize>, StudyError> {
    if shard == 0 || shard > of {
        return Err(StudyError::Shard(shard, of));
    }
    // in 128 bits, where the product of two counts has room
    let end = |shard: usize| (rows as u128 * shard as u128 / of as u128) as usize;
    Ok(end(shard - 1)..end(shard))
}

impl StudyVariable {
    fn parameter(index: usize, of: &Parameter) -> Self {
        StudyVariable {
            name: of.name.to_string(),
            unit: match of.measure {
                Measure::Angle => SiUnit::RADIAN,
                Measure::Length => SiUnit::METRE,
                _ => SiUnit::ONE,
            },
            parameter: Some(index),
        }
    }

    fn coordinate(name: &str, of: Coordinate, mechanism: &Mechanism) -> Self {
        StudyVariable {
            name: name.into(),
            unit: SiUnit::of_coordinate(of.is_angle(mechanism)),
            parameter: None,
        }
    }
}

/// The parameter of a name; none if it is the name of a coordinate.
fn parameter<'m>(
    mechanism: &'m Mechanism,
    name: &str,
) -> Result<Option<(usize, &'m Parameter)>, StudyError> {
    let mut parameters = mechanism.parameters().iter().enumerate();
    let found = parameters.find(|(_, of)| *of.name == *name);
    if found.is_none()
        && let Err(QuestionError::UnknownName { suggestion, .. }) =
            system::Question::new(mechanism).value(name, "home")
    {
        let parameters = mechanism.parameters().iter();
        let parameter = nearest(name, parameters.map(|of| &*of.name));
        return Err(StudyError::Unknown {
            name: name.into(),
            suggestion: parameter.map(str::to_owned).or(suggestion),
        });
    }
    Ok(found)
}

/// A value that a parameter is given, with any unit that fits where it stands.
pub(super) fn number(
    mechanism: &Mechanism,
    parameter: usize,
    value: &system::Value,
) -> Result<f64, StudyError> {
    let number = match mechanism.measure_in_use(parameter) {
        Measure::Number | Measure::Open => {
            let units = [Measure::Length, Measure::Angle].into_iter();
            let mut read = units.map(|measure| value.number(mechanism, measure));
            read.find(Result::is_ok)
                .unwrap_or_else(|| value.number(mechanism, Measure::Number))
        }
        known => value.number(mechanism, known),
    };
    number.map_err(|error| StudyError::Value {
        name: mechanism.parameters()[parameter].name.to_string(),
        text: value.to_string(),
        why: error.to_string(),
    })
}

impl Study {
    /// A study of a question: what it reports ([`Question::report`], and `assemblies`, the number of real ones) at points
    /// of what it varies ([`Question::vary`], [`Question::deviate`]).
    ///
    /// # Errors
    /// If the question or the points are wrong.
    pub fn new(question: &Question, points: Points) -> Result<Self, AskError> {
        question.takes("study")?;
        let mechanism = question.mechanism().clone();
        let plain = system::Question::new(&mechanism);
        let (mut varied, mut ranges) = (Vec::new(), Vec::new());
        for (item, demand) in question.distinct(Role::Vary)? {
            let (name, from, to) = (&demand.name, demand.value(0), demand.value(1));
            if let Some((index, parameter)) = parameter(&mechanism, name)? {
                let number = |value| number(&mechanism, index, value);
                ranges.push(ScatteredPoints::Even(number(&from)?, number(&to)?));
                varied.push(StudyVariable::parameter(index, parameter));
                continue;
            }
            let (of, from) =
                (plain.value(name, from)).map_err(item.value(0).wrong(AskError::Named))?;
            let (_, to) = (plain.value(name, to)).map_err(item.value(1).wrong(AskError::Named))?;
            ranges.push(ScatteredPoints::Even(from, to));
            // what follows a joint is that joint
            let name = of.name(&mechanism);
            varied.push(StudyVariable::coordinate(&name, of, &mechanism));
        }
        for (_, demand) in question.distinct(Role::Deviate)? {
            let (name, deviation) = (&demand.name, &demand.value(0));
            if varied.iter().any(|of| of.name == *name) {
                return Err(StudyError::Twice(name.clone()).into());
            }
            let (value, deviation) = match parameter(&mechanism, name)? {
                Some((index, parameter)) => {
                    varied.push(StudyVariable::parameter(index, parameter));
                    (parameter.value, number(&mechanism, index, deviation)?)
                }
                None => {
                    let held = question
                        .of(Role::Hold)
                        .filter(|(_, held)| held.name == *name);
                    let held = held.last().map_or("home".into(), |(_, held)| held.value(0));
                    let value = |value| plain.value(name, value).map_err(AskError::Question);
                    let ((of, mean), (_, deviation)) = (value(&held)?, value(deviation)?);
                    if let Some(follower) = mechanism.follower(name) {
                        return Err(StudyError::Unknown {
                            name: name.clone(),
                            suggestion: Some(mechanism.joints()[follower.joint].name.clone()),
                        }
                        .into());
                    }
                    varied.push(StudyVariable::coordinate(name, of, &mechanism));
                    (mean, deviation)
                }
            };
            if deviation.is_nan() || deviation < 0.0 {
                return Err(StudyError::Deviation(name.clone()).into());
            }
            ranges.push(ScatteredPoints::Normal(value, deviation));
        }
        let wanted = varied.len();
        let width = |given| Err(StudyError::Width { given, wanted }.into());
        match &points {
            _ if wanted == 0 => return Err(StudyError::NothingVaried.into()),
            Points::Sobol(_) if wanted > Points::MOST_SOBOL => {
                return Err(StudyError::Sobol(Points::MOST_SOBOL).into());
            }
            Points::Sobol(count) if *count as u64 >= 1 << 32 => {
                return Err(StudyError::Count.into());
            }
            Points::Grid(_) if question.has(Role::Deviate) => return Err(StudyError::Grid.into()),
            Points::Grid(nodes) if nodes.len() != wanted => {
                return width(format!("{} numbers of nodes", nodes.len()));
            }
            Points::Given(rows) => {
                if let Some(row) = rows.iter().find(|row| row.len() != wanted) {
                    return width(format!("rows of {} values", row.len()));
                }
            }
            _ => {}
        }
        if points.count().is_none_or(|count| count == 0) {
            return Err(StudyError::Count.into());
        }
        let mut question = question.clone();
        let mut counted = false;
        let lists = question.demands.iter_mut();
        for list in lists.filter(|demand| demand.role == Role::Report) {
            let mut parts = Quantity::split(&list.name);
            let before = parts.len();
            parts.retain(|part| part.trim() != ASSEMBLIES);
            counted |= parts.len() < before;
            list.name = parts.join(", ");
        }
        let mut study = Study {
            question,
            points,
            varied,
            ranges,
            counted,
            columns: Vec::new(),
            spins: true,
        };
        (study.columns, study.spins) = study.named()?;
        Ok(study)
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.points.count().unwrap_or_default()
    }

    /// The rows of a shard, from 1, of `of` shards: all have the same number of rows but for one.
    ///
    /// # Errors
    /// If there is no such shard, or it has more rows than are computed at once.
    pub fn shard(&self, shard: usize, of: usize) -> Result<Range<usize>, StudyError> {
        let rows = part_of(self.count(), shard, of)?;
        match rows.len() {
            0..=MOST_ROWS => Ok(rows),
            len => Err(StudyError::TooLong {
                rows: len,
                most: MOST_ROWS,
                shards: self.count().div_ceil(MOST_ROWS),
            }),
        }
    }

    /// All that decides its rows besides the mechanism, as one text.
    pub fn identity(&self) -> String {
        let of = &self.question;
        let asked = (&of.demands, &of.near, &of.mode, of.seed);
        let varied: Vec<&str> = self.varied.iter().map(|of| &*of.name).collect();
        let points = (&self.points, varied, &self.ranges, self.counted);
        format!("{asked:?} {points:?}")
    }

    /// The rows of these numbers, those of a [`shard`](Self::shard), on all cores.
    pub fn rows(&self, range: Range<usize>, watch: &Watch) -> StudyRows {
        let done = AtomicUsize::new(0);
        let of = Some(range.len());
        let rows = each(range.len(), &(), |(), i| {
            let done = done.fetch_add(1, Ordering::Relaxed);
            let stage = Stage::Rows;
            let goes_on = watch.at(Progress { stage, done, of }).is_continue();
            goes_on.then(|| self.row(range.start + i))
        });
        let rows: Vec<Vec<Option<f64>>> = rows.into_iter().map_while(|row| row).collect();
        StudyRows {
            columns: self.columns.clone(),
            interrupted: rows.len() < range.len(),
            rows,
        }
    }

    /// The columns, and true if links spin about their own lines. Both, and the check that the held coordinates fit the
    /// freedoms, are decided once, with the dimensions of the file: they change at special dimensions only.
    fn named(&self) -> Result<(Vec<Variable>, bool), AskError> {
        let mechanism = self.question.mechanism();
        let mut columns = vec![Variable::plain("row")];
        columns.extend(
            self.varied
                .iter()
                .map(|of| Variable::new(&of.name, of.unit)),
        );
        columns.push(Variable::plain("assembled"));
        if self.counted {
            columns.push(Variable::plain(ASSEMBLIES));
        }
        let posed = self.at(&self.point(0), mechanism.clone());
        let held = posed.resolved()?;
        check_count(&held)?;
        let (quantities, _) = posed.measured_by_rates(&held)?;
        columns.extend(quantities.iter().map(|of| Variable::new(&of.name, of.unit)));
        let spins = !held.with_spins_still().still().is_empty();
        Ok((columns, spins))
    }

    fn point(&self, index: usize) -> Vec<f64> {
        self.points.at(index, &self.ranges, self.question.seed)
    }

    fn row(&self, index: usize) -> Vec<Option<f64>> {
        let point = self.point(index);
        let mut row = vec![Some(index as f64)];
        row.extend(point.iter().map(|x| Some(*x)));
        let found = self.made(&point).and_then(|mechanism| {
            let asked = self.at(&point, mechanism);
            asked.measured_here(self.counted, self.spins).ok()
        });
        match found {
            Some(values) => row.extend(values),
            // dimensions that make no mechanism make none that assembles
            None => {
                row.push(Some(0.0));
                row.resize(self.columns.len(), None);
            }
        }
        row.resize(self.columns.len(), None);
        row
    }

    /// The mechanism with the parameters of a point.
    fn made(&self, point: &[f64]) -> Option<Arc<Mechanism>> {
        let named = self.varied.iter().zip(point);
        let given = named.filter_map(|(of, value)| Some((of.parameter?, *value)));
        let given: Vec<(usize, f64)> = given.collect();
        let mechanism = self.question.mechanism();
        match given.is_empty() {
            true => Some(mechanism.clone()),
            false => mechanism.with_values(&given).ok().map(Arc::new),
        }
    }

    /// The question at a point.
    fn at(&self, point: &[f64], mechanism: Arc<Mechanism>) -> Question {
        let named = self.varied.iter().zip(point);
        let coordinates = named.filter(|(of, _)| of.parameter.is_none());
        let asked = self.question.about(mechanism);
        coordinates.fold(asked, |asked, (of, value)| {
            asked.let_go(&of.name).hold(&of.name, *value)
        })
    }
}
