//! Motions as documents, as rows and as pictures.

mod circuits;
mod course;
mod paths;
mod picture;
mod words;

pub(super) use course::DrawnCourse;
pub use picture::Picture;
pub use words::{certified, sentence};

use super::assembly_remarks;
use super::document::{Cell, Document, Section, Table};
use super::quantity::quantity;
use super::report::{Remarks, Report};
use crate::algebra::SiUnit;
use crate::analysis::sweep::{
    Certificate, Columns, Extreme, Extremum, MetKind, MotionReport, MotionsReport, Row, SweepReport,
};
use crate::mechanism::Variable;
use crate::number::tolerance::WRITTEN_ZERO;

impl Report for MotionsReport {
    fn document(&self) -> Document {
        let interrupted = self.motions.iter().any(|motion| motion.sweep.interrupted);
        let certified = |sweep: &SweepReport| {
            let certificate = sweep.certificate.as_ref();
            certificate.is_none_or(Certificate::is_whole)
        };
        let yes = (self.motions.iter()).all(|m| m.sweep.ending.is_whole() && certified(&m.sweep));
        let document = match &self.motions[..] {
            [one] => {
                let moved = self.moved.as_ref();
                let answer =
                    assembly_remarks::after_moving(moved, mode(one) + &sentence(&one.sweep));
                let document = Document::new(&self.mechanism, answer);
                let document = document.interrupted(interrupted, "");
                let document = document.notes(assembly_remarks::distance_moved(moved));
                let document = document.notes(remarks(one).concat()).sections(parts(one));
                document.method(words::work(&one.sweep))
            }
            several => {
                let whole = several.iter().filter(|m| m.sweep.ending.is_whole()).count();
                let answer = format!(
                    "The curve was followed to its end in {whole} of {} modes.",
                    several.len()
                );
                let sections = several.iter().map(|motion| {
                    let section = Section::new(mode(motion).trim_end_matches(": "));
                    let section = section.text(sentence(&motion.sweep));
                    let section = remarks(motion).into_iter().fold(section, Section::list);
                    let section = parts(motion).into_iter().fold(section, Section::section);
                    section.text(words::work(&motion.sweep))
                });
                let document = Document::new(&self.mechanism, answer);
                let said = several.iter().map(|motion| sentence(&motion.sweep));
                let document = document.interrupted(interrupted, "").sections(sections);
                document.remarks(Remarks {
                    sentences: Some(said.collect()),
                    ..Remarks::default()
                })
            }
        };
        document.yes_if(yes)
    }
}

/// Rows of a motion that text shows at most; more are thinned evenly.
pub const SHOWN: usize = 37;

fn mode(motion: &MotionReport) -> String {
    let mode = motion.mode.map(|mode| format!("Mode {mode}: "));
    mode.unwrap_or_default()
}

/// Remarks on a motion, by kind.
fn remarks(motion: &MotionReport) -> [Vec<String>; 4] {
    [
        words::certified(&motion.sweep),
        words::paced(motion).into_iter().collect(),
        words::poles(motion),
        words::shapes(motion),
    ]
}

/// A motion in detail.
fn parts(motion: &MotionReport) -> Vec<Section> {
    let mut parts = vec![extremes(motion)];
    parts.extend(means(motion));
    parts.extend(words::met(motion));
    parts.extend(paths::sections(&motion.sweep.paths, false));
    parts.push(rows(motion));
    parts
}

/// The least and greatest values of the quantities, and where they are.
fn extremes(motion: &MotionReport) -> Section {
    type ExtremeOf = fn(&Extremum) -> &Option<Extreme>;
    let sides: [(&str, ExtremeOf); 2] =
        [("least", |of| &of.least), ("greatest", |of| &of.greatest)];
    let driven = words::driven(motion);
    let table = Table::of(&motion.extremes).words("quantity", |of| &of.name);
    let table = sides.into_iter().fold(table, |table, (word, side)| {
        let table = table.words(word, move |of| match side(of) {
            Some(found) => {
                let beyond = match (of.at_least, word) {
                    (false, _) => "",
                    (true, "least") => "at most ",
                    (true, _) => "at least ",
                };
                format!("{beyond}{}", quantity(found.value, of.unit))
            }
            None => match (of.constant, of.unbounded.is_empty()) {
                (Some(value), _) if word == "least" => {
                    format!("constant: {}", quantity(value, of.unit))
                }
                (Some(_), _) => String::new(),
                (None, false) => "no bound".into(),
                (None, true) => "not determined".into(),
            },
        });
        table.each(
            driven.iter().map(|of| format!("at {}", of.name)),
            |of, i| {
                let found = side(of).as_ref()?;
                let place = found.inputs.get(i).or(found.joints.first());
                place.map(|x| Cell::quantity(*x, driven[i].unit))
            },
        )
    });
    Section::new("Extremes").table(table)
}

/// Means of forces, powers and energies over the time.
fn means(motion: &MotionReport) -> Option<Section> {
    let known = motion.extremes.iter().filter(|of| of.rms.is_some());
    let known: Vec<&Extremum> = known.collect();
    let cell = |value: Option<f64>, of: &Extremum| value.map(|x| Cell::quantity(x, of.unit));
    let table = Table::of(known.iter().copied())
        .words("quantity", |of| &of.name)
        .numbers("mean", move |of| cell(of.mean, of))
        .numbers("root mean square", move |of| cell(of.rms, of));
    let joules = |value: Option<f64>| value.map(|x| Cell::quantity(x, SiUnit::JOULE));
    let table = match known.iter().any(|of| of.fluctuation.is_some()) {
        true => table
            .numbers("work", move |of| joules(of.work))
            .numbers("fluctuation of energy", move |of| joules(of.fluctuation)),
        false => table,
    };
    (!known.is_empty()).then(|| Section::new("Means over the time").table(table))
}

/// Table of some rows of a motion.
fn rows(motion: &MotionReport) -> Section {
    let (values, all) = (&motion.values, motion.sweep.rows);
    let every = values.len().saturating_sub(1).div_ceil(SHOWN).max(1);
    let last = values.len().saturating_sub(1);
    let shown = values.iter().enumerate();
    let shown = shown.filter(|(i, _)| i.is_multiple_of(every) || *i == last);
    // quaternions are for programs
    let columns = motion.columns.iter().enumerate().skip(1);
    let places = motion.columns.len() - motion.extremes.len();
    let columns = columns.filter(|(i, of)| of.unit != SiUnit::ONE || *i >= places);
    let flat = flat(&motion.columns[..places], values);
    let columns = columns.filter(|(i, _)| !flat.contains(i));
    let (places, columns): (Vec<usize>, Vec<Variable>) =
        columns.map(|(i, of)| (i, of.clone())).unzip();
    let steps = Table::of(shown.map(|(_, row)| row)).words("step", |row| row[0]);
    let table = steps.quantities(&columns, |row, k| row[places[k]]);
    let table = Table::from(table);
    let title = match all > table.rows.len() {
        true => format!(
            "Rows, {} of {all}; CSV and JSON have all of them",
            table.rows.len()
        ),
        false => "Rows".into(),
    };
    Section::new(title).table(table)
}

/// The columns of z, roll and pitch of frames that stay in the plane of x and y: there is nothing to read in them.
fn flat(columns: &[Variable], values: &[Vec<Option<f64>>]) -> Vec<usize> {
    let across = |i: &usize| {
        let (owner, part) = columns[*i].name.rsplit_once('.')?;
        ["z", "roll", "pitch"].contains(&part).then_some(owner)
    };
    let is_zero = |i: &usize| {
        let mut values = values.iter().filter_map(|row| row[*i]);
        values.all(|value| value.abs() < WRITTEN_ZERO)
    };
    let all = (0..columns.len()).filter(|i| across(i).is_some());
    let lies = |i: &usize| {
        let mut own = all.clone().filter(|other| across(other) == across(i));
        own.all(|other| is_zero(&other))
    };
    all.clone().filter(lies).collect()
}

/// The columns of rows as they are found: those of a motion between its mode and the special points.
pub fn row_columns(columns: &Columns) -> Vec<String> {
    let variables = columns.variables().iter().map(Variable::to_string);
    let columns = std::iter::once("mode".to_owned()).chain(variables);
    columns.chain(["met".to_owned()]).collect()
}

/// The values of a row in these columns.
pub fn row_values<'a>(
    columns: &Columns,
    mode: Option<usize>,
    row: &Row<'a>,
) -> impl Iterator<Item = Cell> + use<'a> {
    let met = row.special.map(word);
    let values = columns.values(row).map(Cell::from);
    let first = [Cell::from(mode), Cell::from(row.step)];
    first.into_iter().chain(values).chain([Cell::from(met)])
}

/// Name of a special row in the last column.
fn word(kind: &MetKind) -> &'static str {
    match kind {
        MetKind::Turning { .. } => "turning point",
        MetKind::Fold { .. } => "fold",
        MetKind::Limit { .. } => "limit",
        MetKind::End => "end",
        MetKind::Cusp { .. } => "cusp",
        MetKind::Closed => "closed",
        MetKind::Crossing { .. } => "crossing",
    }
}
