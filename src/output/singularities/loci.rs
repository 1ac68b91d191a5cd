//! Singularity loci in a box of two coordinates.

use super::{Once, kind_word, note, words};
use crate::analysis::singularities::{LocusReport, Shape};
use crate::description::count;
use crate::mechanism::Variable;
use crate::output::csv::{Record, Value};
use crate::output::document::{Column, Document, Report, Section, Table, cells};
use crate::output::quantity::quantity;

impl Report for LocusReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        Document::new(&self.mechanism, words::loci(self))
            .note(words::split(&self.inputs, &self.outputs))
            .notes(words::pinned(self))
            .notes(note(&self.coupled))
            .interrupted(self.interrupted, "loci")
            .section(curves(self))
            .method(words::completeness(self))
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        vec![
            ("completeness", Some(words::completeness(self))),
            ("note", note(&self.coupled)),
        ]
    }
}

/// Each curve with its extent.
fn curves(report: &LocusReport) -> Section {
    let [a, b] = report.bounds.each_ref().map(|bound| bound.name.as_str());
    let mut table = Table::new([
        Column::numbers("locus"),
        Column::words("type"),
        Column::words("kind"),
        Column::words(a),
        Column::words(b),
        Column::words("ends"),
        Column::numbers("points"),
        Column::numbers("over it"),
    ]);
    for (i, locus) in report.loci.iter().enumerate() {
        let extent = |k: usize| {
            let [low, high] = locus.extents[k];
            let angle = report.bounds[k].unit.is_angle();
            match high - low < 1e-9 {
                true => quantity(low, angle),
                false => format!("{} to {}", quantity(low, angle), quantity(high, angle)),
            }
        };
        let kind = locus.singularity.gosselin_angeles;
        table.row(cells![
            i + 1,
            kind.map_or("none".into(), |kind| kind.to_string()),
            kind_word(locus.kind),
            extent(0),
            extent(1),
            words::ends(locus),
            locus.points.len(),
            locus.configurations,
        ]);
    }
    let several = report.loci.iter().any(|locus| locus.configurations > 1);
    let several = several.then(|| {
        "over it: curves of configurations that project to the same locus in the box".to_owned()
    });
    let crossings: usize = report.loci.iter().map(|locus| locus.crossings.len()).sum();
    let passed = "of loci passed straight through";
    let crossings = (crossings > 0).then(|| format!("{} {passed}", count(crossings, "crossing")));
    Section::new("Loci")
        .table(table)
        .list(several.into_iter().chain(crossings))
}

/// Points of loci as rows: the names of the columns, then the values in SI units and rad.
pub fn locus_rows(report: &LocusReport) -> (Vec<String>, impl Iterator<Item = Record<'static>>) {
    let own = ["locus", "kind", "type", "shape", "configurations"];
    let sides = report.bounds.iter().map(|b| Variable::new(&b.name, b.unit));
    let sides: Vec<Variable> = sides.collect();
    let variables = sides.iter().chain(&report.variables);
    let once = Once::new(&own, variables.chain(&report.pose_variables));
    let columns = once.columns.clone();
    let loci = report.loci.iter().enumerate();
    let rows = loci.flat_map(move |(i, locus)| {
        let kind = locus.singularity.gosselin_angeles;
        let shape = match locus.shape {
            Shape::Curve => "curve",
            Shape::Point => "point",
        };
        let first = [
            Value::from(i + 1),
            Value::from(kind_word(locus.kind)),
            Value::from(kind.map(usize::from)),
            Value::from(shape),
            Value::from(locus.configurations),
        ];
        let points = locus.points.iter().zip(&locus.joints).zip(&locus.poses);
        let rows = points.map(|((point, joints), poses)| {
            let values = point.iter().chain(joints).chain(poses.iter().flatten());
            let values = once.values(values);
            first.iter().cloned().chain(values).collect()
        });
        rows.collect::<Vec<Record>>()
    });
    (columns, rows)
}
