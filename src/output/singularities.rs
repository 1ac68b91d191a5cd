//! Singularities as documents and rows, and loci as pictures.

mod along;
mod coupled;
mod loci;
#[cfg(feature = "plot")]
mod picture;
mod words;

pub use along::along_rows;
pub use coupled::note;
pub use loci::locus_rows;
#[cfg(feature = "plot")]
pub use picture::svg;
pub use words::{completeness, ending, pinned};

use super::csv::Value;
use super::document::{Column, Document, Report, Section, Table, cells};
use super::quantity::{number, quantity, short};
use super::screws::{screw_words, twist_table};
use crate::analysis::singularities::{
    Distances, Kind, Movement, Resisted, SingularitiesReport, Singularity,
};
use crate::description::listed;
use crate::mechanism::Variable;

impl Report for SingularitiesReport {
    fn document(&self) -> Document {
        let singularity = &self.singularity;
        let answer = words::sentence(singularity, &self.inputs, &self.outputs);
        let moved = self.moved.as_ref();
        let answer = super::closing::after_moving(moved, answer);
        let gap = self.given_gap.as_ref();
        let at = self.variables.iter().zip(&self.joints);
        let at = at.map(|(of, x)| format!("{} = {}", of.name, quantity(*x, of.unit.is_angle())));
        let at: Vec<String> = at.collect();
        let at = (!at.is_empty()).then(|| format!("at {}", at.join(", ")));
        Document::new(&self.mechanism, answer)
            .note(words::split(&self.inputs, &self.outputs))
            .notes(note(&self.coupled))
            .notes(gap.map(|gap| super::closing::given(gap, self.kept)))
            .notes(super::closing::beside(moved))
            .notes(at)
            .sections(details(singularity))
            .section(distances(&singularity.distances, self.normalising_length))
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        vec![("note", note(&self.coupled))]
    }
}

/// Types, motions and wrenches.
fn details(singularity: &Singularity) -> Vec<Section> {
    let kinds = singularity.zlatanov.iter();
    let kinds = Section::new("Types of Zlatanov, Fenton and Benhabib")
        .list(kinds.map(|kind| words::zlatanov(*kind)));
    let gained = singularity.gained.as_ref();
    let gained = gained.map(|of| movement("Gained, while the inputs stand still", of));
    let idle = singularity.idle_inputs.as_ref();
    let idle = idle.map(|of| movement("Moves while the outputs stand still", of));
    let parts = [kinds].into_iter().chain(gained).chain(idle);
    parts
        .chain(singularity.resisted.iter().map(wrenches))
        .collect()
}

fn movement(title: &str, movement: &Movement) -> Section {
    let moves = movement.twists.iter().any(|space| !space.screws.is_empty());
    let spaces: &[_] = if moves { &movement.twists } else { &[] };
    let joints = movement.joints.iter().map(|moving| match moving.rate {
        Some(rate) => format!("{} {}", moving.joint, short(rate)),
        None => moving.joint.clone(),
    });
    let joints: Vec<String> = joints.collect();
    let joints = match joints.is_empty() {
        true => String::new(),
        false => format!("joints {}", joints.join(", ")),
    };
    Section::new(title).table(twist_table(spaces)).text(joints)
}

fn wrenches(resisted: &Resisted) -> Section {
    let mut table = Table::new([
        Column::words("wrench"),
        Column::words("along"),
        Column::words("through").in_unit("m"),
        Column::words("pitch"),
    ]);
    for screw in &resisted.wrenches {
        let [kind, along, through, pitch] = screw_words(screw);
        let kind = match kind.as_str() {
            "turn" => "force",
            "shift" => "moment",
            _ => "wrench",
        };
        table.row(cells![kind, along, through, pitch]);
    }
    let title = format!(
        "Lost: {} cannot move against this wrench, which is carried without the inputs",
        resisted.output
    );
    Section::new(title).table(table)
}

fn distances(distances: &Distances, length: f64) -> Section {
    let mut table = Table::new([Column::words(""), Column::words("σ")]);
    let rows = [
        ("direct, inputs at rest", distances.direct),
        ("inverse, outputs at rest", distances.inverse),
        ("constraint, nothing held", distances.constraint),
    ];
    for (name, value) in rows {
        let value = value.map_or("none can vanish".into(), |value| match value < 1e-12 {
            true => "0".into(),
            false => format!("{value:.4e}"),
        });
        table.row(cells![name, value]);
    }
    let title = format!(
        "Distance to singularity: smallest singular values, lengths over {} m",
        number(length)
    );
    Section::new(title).table(table)
}

/// Columns of rows, without those that come again: a coordinate that moves or bounds the box is also
/// a joint or part of a pose.
struct Once {
    columns: Vec<String>,
    stays: Vec<bool>,
}

impl Once {
    /// Columns of their own, then variables of which some may be the same.
    fn new<'a>(own: &[&str], variables: impl IntoIterator<Item = &'a Variable>) -> Self {
        let mut columns: Vec<String> = own.iter().map(|name| (*name).to_owned()).collect();
        let mut stays = Vec::new();
        for variable in variables {
            let name = variable.to_string();
            stays.push(!columns.contains(&name));
            if stays.last() == Some(&true) {
                columns.push(name);
            }
        }
        Once { columns, stays }
    }

    /// The values of the variables that stay.
    fn values<'a>(
        &self,
        values: impl Iterator<Item = &'a f64>,
    ) -> impl Iterator<Item = Value<'static>> {
        let values = values.zip(&self.stays).filter(|(_, stays)| **stays);
        values.map(|(value, _)| Value::from(*value))
    }
}

fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Direct => "direct",
        Kind::Inverse => "inverse",
    }
}

/// The remark that joints are outside their limits.
pub fn limits_remark(report: &SingularitiesReport) -> String {
    super::closing::limits_warning(&report.outside_limits)
}

fn names(names: &[String]) -> String {
    match names {
        [] => "nothing".into(),
        names => listed(names),
    }
}
