//! Singularities as documents and rows, and loci as pictures.

mod along;
mod coupled;
mod loci;
mod picture;
mod words;

pub use picture::svg;

use super::assembly_remarks;
use super::document::{Document, Section, Table};
use super::quantity::{metres, short, values};
use super::report::{Remarks, Report};
use super::screws::{twist_table, wrench_table};
use crate::analysis::singularities::{
    Distances, Kind, Movement, Resisted, SingularitiesReport, Singularity,
};
use crate::description::listed;
use coupled::note;

impl Report for SingularitiesReport {
    fn document(&self) -> Document {
        let singularity = &self.singularity;
        let answer = words::sentence(singularity, &self.inputs, &self.outputs);
        let at = values(&self.variables, &self.joints);
        let at = (!at.is_empty()).then(|| format!("at {}", at.join(", ")));
        assembly_remarks::document(&self.mechanism, answer, &self.pose, self.normalising_length)
            .remarks(Remarks::note(&note(&self.coupled)))
            .note(words::split(&self.inputs, &self.outputs))
            .notes(note(&self.coupled))
            .notes(assembly_remarks::notes(&self.pose))
            .notes(at)
            .sections(details(singularity))
            .section(distances(&singularity.distances, self.normalising_length))
    }
}

fn details(singularity: &Singularity) -> Vec<Section> {
    let kinds = singularity.zlatanov.iter().copied().map(words::zlatanov);
    let kinds = Section::new("Types of Zlatanov, Fenton and Benhabib").list(kinds);
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
    let joints = (!joints.is_empty()).then(|| format!("joints {}", joints.join(", ")));
    let section = Section::new(title).table(twist_table(spaces));
    section.text(joints.unwrap_or_default())
}

fn wrenches(resisted: &Resisted) -> Section {
    let title = format!(
        "Lost: {} cannot move against this wrench, which is carried without the inputs",
        resisted.output
    );
    Section::new(title).table(wrench_table(&resisted.wrenches))
}

fn distances(distances: &Distances, length: f64) -> Section {
    let rows = [
        ("direct, inputs at rest", distances.direct),
        ("inverse, outputs at rest", distances.inverse),
        ("constraint, nothing held", distances.constraint),
    ];
    let table = Table::of(rows)
        .words("", |(name, _)| name)
        .words("σ", |(_, value)| match value {
            None => "cannot vanish".into(),
            Some(value) if value < 1e-12 => "0".into(),
            Some(value) => format!("{value:.4e}"),
        });
    let title = format!(
        "Distance to singularity: smallest singular values, lengths divided by {}",
        metres(length)
    );
    Section::new(title).table(table)
}

fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Direct => "direct",
        Kind::Inverse => "inverse",
    }
}

fn names(names: &[String]) -> String {
    match names {
        [] => "nothing".into(),
        names => listed(names),
    }
}
