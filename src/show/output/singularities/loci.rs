//! Singularity loci in a box of two coordinates.

use super::{kind_word, note, words};
use crate::analysis::singularities::{Cusp, ImageShape, Kind, Locus, LocusReport};
use crate::description::count;
use crate::mechanism::Variable;
use crate::output::document::{Cell, Document, Section, Table};
use crate::output::quantity::quantity;
use crate::output::report::{Remarks, Report, Rows};

impl Report for LocusReport {
    fn document(&self) -> Document {
        let remarks = Remarks {
            completeness: Some(words::completeness(self)),
            ..Remarks::note(&note(&self.coupled))
        };
        Document::new(&self.mechanism, words::loci(self))
            .yes_if(!self.loci.is_empty())
            .remarks(remarks)
            .note(words::split(&self.inputs, &self.outputs))
            .notes(words::pinned(self))
            .notes(note(&self.coupled))
            .interrupted(self.interrupted, "loci")
            .section(curves(self))
            .sections(cusps(self))
            .method(words::completeness(self))
    }

    /// The points of the loci, then their cusps, in SI units and rad.
    fn rows(&self) -> Option<Rows<'_>> {
        let points = self.loci.iter().enumerate().flat_map(|(i, locus)| {
            let points = locus.points.iter().zip(&locus.joints).zip(&locus.poses);
            let points = points.map(|((point, joints), poses)| (None, point, joints, poses));
            let cusps =
                (locus.cusps.iter()).map(|of| (Some("cusp"), &of.point, &of.joints, &of.poses));
            (points.chain(cusps)).map(move |point| (i, locus, point))
        });
        let shape = |locus: &Locus| match locus.shape {
            ImageShape::Curve => "curve",
            ImageShape::Point => "point",
        };
        let table = Table::of(points)
            .numbers("locus", |(i, ..)| i + 1)
            .words("kind", |(_, locus, _)| kind_word(locus.kind))
            .numbers("type", |(_, of, _)| {
                of.singularity.gosselin_angeles.map(usize::from)
            })
            .words("shape", |(_, locus, (cusp, ..))| {
                cusp.unwrap_or(shape(locus))
            })
            .numbers("configurations", |(_, locus, _)| locus.configurations)
            .values(&self.bounds, |(.., (_, point, ..)), k| point[k])
            .values(&self.variables, |(.., (_, _, joints, _)), k| joints[k])
            .values(&self.pose_variables, |(.., (.., poses)), k| {
                poses.as_flattened()[k]
            });
        Some(table.without_repeats().into())
    }
}

fn curves(report: &LocusReport) -> Section {
    let extent = |k: usize, locus: &Locus| {
        let ([low, high], unit) = (locus.extents[k], report.bounds[k].unit);
        match high - low < 1e-9 {
            true => quantity(low, unit),
            false => [low, high].map(|x| quantity(x, unit)).join(" to "),
        }
    };
    let table = Table::of((1..).zip(&report.loci))
        .numbers("locus", |(i, _)| Cell::Count(i))
        .words("type", |(_, locus)| {
            match locus.singularity.gosselin_angeles {
                Some(kind) => kind.to_string(),
                None => "none".into(),
            }
        })
        .words("kind", |(_, locus)| kind_word(locus.kind))
        .words(&report.bounds[0].name, |(_, locus)| extent(0, locus))
        .words(&report.bounds[1].name, |(_, locus)| extent(1, locus))
        .words("ends", |(_, locus)| words::ends(locus))
        .numbers("points", |(_, locus)| locus.points.len())
        .numbers("over it", |(_, locus)| locus.configurations);
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

fn cusps(report: &LocusReport) -> Option<Section> {
    let loci = (1..).zip(&report.loci);
    let cusps: Vec<(i64, &Locus, &Cusp)> = loci
        .flat_map(|(i, locus)| locus.cusps.iter().map(move |cusp| (i, locus, cusp)))
        .collect();
    let any = |kind: Kind| cusps.iter().any(|(_, locus, _)| locus.kind == kind);
    let meaning = [
        any(Kind::Direct).then(|| {
            "direct: three assemblies meet there, and on a path around it one turns into another without a singularity".to_owned()
        }),
        any(Kind::Inverse).then(|| "inverse: three configurations for the same outputs meet there".to_owned()),
    ];
    let bounds = &report.bounds;
    let boxed = |name: &str| bounds.iter().any(|bound| bound.name == name);
    let joints = report.variables.iter().enumerate();
    let joints: Vec<(usize, &Variable)> = joints.filter(|(_, of)| !boxed(&of.name)).collect();
    let table = Table::of(cusps.iter().copied())
        .numbers("locus", |(i, _, _)| Cell::Count(i))
        .words("kind", |(_, locus, _)| kind_word(locus.kind))
        .quantities(bounds, |(.., cusp), k| cusp.point[k])
        .each(joints.iter().map(|(_, of)| &of.name), |(.., cusp), i| {
            let (k, of) = joints[i];
            Cell::quantity(cusp.joints[k], of.unit)
        });
    (!cusps.is_empty()).then(|| {
        Section::new("Cusps")
            .table(table)
            .list(meaning.into_iter().flatten())
    })
}
