//! Singularities as text, JSON and CSV, and loci as pictures.

mod coupled;
#[cfg(feature = "plot")]
mod picture;
mod refusals;
mod words;

pub use coupled::note;
#[cfg(feature = "plot")]
pub use picture::svg;
pub use refusals::{
    empty_side, no_side, not_two_sides, nothing_to_drive, spinning, unknown_output,
};
pub use words::{completeness, ending, pinned};

use std::fmt::Write;

use serde::Serialize;

use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{digits, number, quantity, short};
use super::screws::{screw_words, twists};
use crate::analysis::singularities::{
    AlongReport, Distances, Kind, LocusReport, Movement, Resisted, Shape, SingularitiesReport,
    Singularity,
};
use crate::description::{count, listed};
use crate::mechanism::Mechanism;

/// What is special about a configuration as JSON: the fields of [`SingularitiesReport`] after one
/// sentence and the [`note`] on its outputs.
pub fn json(mechanism: &Mechanism, report: &SingularitiesReport) -> String {
    #[derive(Serialize)]
    struct Json<'a> {
        sentence: String,
        note: Option<String>,
        #[serde(flatten)]
        report: &'a SingularitiesReport,
    }
    let json = Json {
        sentence: words::sentence(&report.singularity, &report.inputs, &report.outputs),
        note: note(&report.coupled),
        report,
    };
    document(mechanism.name(), &json)
}

/// What is special about a configuration as text.
pub fn text(mechanism: &Mechanism, report: &SingularitiesReport) -> String {
    let singularity = &report.singularity;
    let mut text = format!(
        "{}\n{}\n{}\n{}",
        mechanism.name(),
        words::split(&report.inputs, &report.outputs),
        words::sentence(singularity, &report.inputs, &report.outputs),
        coupled::line(&report.coupled)
    );
    if let Some(gap) = &report.given_gap {
        text += &format!("{}\n", super::closing::given(gap, report.kept));
    }
    let values = mechanism.joints().iter().zip(&report.joints);
    let values = values.map(|(joint, value)| {
        format!(
            "{} = {}",
            joint.name,
            quantity(*value, joint.kind.is_angle())
        )
    });
    let values: Vec<String> = values.collect();
    if !values.is_empty() {
        text += &format!("At {}\n", values.join(", "));
    }
    text += &details(singularity);
    text + &distances(&singularity.distances, report.normalising_length)
}

/// Types, motions and wrenches.
fn details(singularity: &Singularity) -> String {
    let mut text = String::new();
    for kind in &singularity.zlatanov {
        let _ = writeln!(text, "  {}", words::zlatanov(*kind));
    }
    if let Some(gained) = &singularity.gained {
        text += &movement("Gained, while the inputs stand still", gained);
    }
    if let Some(idle) = &singularity.idle_inputs {
        text += &movement("Moves while the outputs stand still", idle);
    }
    for resisted in &singularity.resisted {
        text += &wrenches(resisted);
    }
    text
}

fn movement(title: &str, movement: &Movement) -> String {
    let mut text = match movement.twists.iter().all(|space| space.screws.is_empty()) {
        true => format!("{title}\n"),
        false => twists(title, &movement.twists),
    };
    let joints = movement.joints.iter().map(|moving| match moving.rate {
        Some(rate) => format!("{} {}", moving.joint, short(rate)),
        None => moving.joint.clone(),
    });
    let joints: Vec<String> = joints.collect();
    if !joints.is_empty() {
        let _ = writeln!(text, "  joints {}", joints.join(", "));
    }
    text
}

fn wrenches(resisted: &Resisted) -> String {
    let mut table = plain(["wrench", "along", "through (m)", "pitch"]);
    for screw in &resisted.wrenches {
        let [kind, along, through, pitch] = screw_words(screw);
        let kind = match kind.as_str() {
            "turn" => "force",
            "shift" => "moment",
            _ => "wrench",
        };
        table.add_row([kind, &along, &through, &pitch]);
    }
    format!(
        "Lost: {} cannot move against this; it is borne without the inputs\n{}",
        resisted.output,
        indented(&table.to_string())
    )
}

fn distances(distances: &Distances, length: f64) -> String {
    let mut table = plain(["", "σ"]);
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
        table.add_row([name, &value]);
    }
    format!(
        "Distance to singularity: smallest singular values, lengths over {} m\n{}",
        number(length),
        indented(&table.to_string())
    )
}

/// A motion along inputs as JSON: the fields of [`AlongReport`] after one sentence and the [`note`] on
/// its outputs.
pub fn along_json(mechanism: &Mechanism, report: &AlongReport) -> String {
    #[derive(Serialize)]
    struct Json<'a> {
        sentence: String,
        note: Option<String>,
        #[serde(flatten)]
        report: &'a AlongReport,
    }
    let json = Json {
        sentence: words::ending(report),
        note: note(&report.coupled),
        report,
    };
    document(mechanism.name(), &json)
}

/// A motion along inputs as text.
pub fn along_text(mechanism: &Mechanism, report: &AlongReport) -> String {
    let mut text = format!(
        "{}\n{}\n{}\n{}",
        mechanism.name(),
        words::split(&report.inputs, &report.outputs),
        words::ending(report),
        coupled::line(&report.coupled)
    );
    for (i, crossing) in report.crossings.iter().enumerate() {
        let _ = writeln!(
            text,
            "\n{}. {}: {}",
            i + 1,
            words::place(report, &crossing.moved),
            words::crossing(crossing, report)
        );
        text += &indented(&details(&crossing.singularity));
    }
    text
}

/// The singularities on the way as CSV, in m and rad with all digits.
pub fn along_csv(mechanism: &Mechanism, report: &AlongReport) -> String {
    let mut columns: Vec<String> = ["number", "part", "type", "zlatanov", "fold", "branches"]
        .map(str::to_owned)
        .to_vec();
    let own = columns.len();
    columns.extend(
        report
            .moved
            .iter()
            .map(|m| field(&format!("{} ({})", m.name, m.unit))),
    );
    columns.extend(joint_columns(mechanism));
    let once = once(&mut columns, own);
    let mut text = columns.join(",") + "\n";
    for (i, crossing) in report.crossings.iter().enumerate() {
        let kind = crossing.singularity.gosselin_angeles;
        let zlatanov = crossing.singularity.zlatanov.iter();
        let zlatanov: Vec<&str> = zlatanov.map(|kind| words::letters(*kind)).collect();
        let mut fields = vec![
            (i + 1).to_string(),
            crossing.part.to_string(),
            kind.map_or(String::new(), |kind| kind.to_string()),
            zlatanov.join(" "),
            crossing.fold.to_string(),
            crossing.branches.to_string(),
        ];
        let values = crossing.moved.iter().chain(&crossing.joints);
        let values = values.zip(&once).filter(|(_, once)| **once);
        fields.extend(values.map(|(value, _)| digits(*value)));
        text += &(fields.join(",") + "\n");
    }
    text
}

/// A name with a comma stands in quotes (RFC 4180).
fn field(name: &str) -> String {
    match name.contains([',', '"']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.to_owned(),
    }
}

fn joint_columns(mechanism: &Mechanism) -> Vec<String> {
    let joints = mechanism.joints().iter();
    joints
        .map(|joint| {
            let unit = if joint.kind.is_angle() { "rad" } else { "m" };
            field(&format!("{} ({unit})", joint.name))
        })
        .collect()
}

/// Leaves out what comes again after the first columns, and tells which of those that follow stay: a
/// coordinate that moves or bounds the box is also a joint or part of a pose.
fn once(columns: &mut Vec<String>, own: usize) -> Vec<bool> {
    let stays: Vec<bool> = (0..columns.len())
        .map(|i| !columns[..i].contains(&columns[i]))
        .collect();
    let mut of = stays.iter();
    columns.retain(|_| of.next().copied().unwrap_or(true));
    stays[own..].to_vec()
}

fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Direct => "direct",
        Kind::Inverse => "inverse",
    }
}

/// Loci as JSON: the fields of [`LocusReport`] after two sentences and the [`note`] on its outputs.
pub fn locus_json(mechanism: &Mechanism, report: &LocusReport) -> String {
    #[derive(Serialize)]
    struct Json<'a> {
        sentence: String,
        completeness: String,
        note: Option<String>,
        #[serde(flatten)]
        report: &'a LocusReport,
    }
    let json = Json {
        sentence: words::loci(report),
        completeness: words::completeness(report),
        note: note(&report.coupled),
        report,
    };
    document(mechanism.name(), &json)
}

/// Loci as text: each curve with its extent.
pub fn locus_text(mechanism: &Mechanism, report: &LocusReport) -> String {
    let mut text = format!(
        "{}\n{}\n{}\n{}{}",
        mechanism.name(),
        words::split(&report.inputs, &report.outputs),
        words::loci(report),
        words::pinned(report).map_or(String::new(), |said| said + "\n"),
        coupled::line(&report.coupled)
    );
    if !report.loci.is_empty() {
        let [a, b] = report.bounds.each_ref().map(|bound| bound.name.as_str());
        let mut table = plain(["locus", "type", "kind", a, b, "ends", "points", "over it"]);
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
            table.add_row([
                (i + 1).to_string(),
                kind.map_or("none".into(), |kind| kind.to_string()),
                kind_word(locus.kind).into(),
                extent(0),
                extent(1),
                words::ends(locus),
                locus.points.len().to_string(),
                locus.configurations.to_string(),
            ]);
        }
        align_right(&mut table, [0, 6, 7]);
        text += &indented(&table.to_string());
        if report.loci.iter().any(|locus| locus.configurations > 1) {
            text += "  Over a locus so many curves of configurations were found, which look alike in the box.\n";
        }
        let crossings: usize = report.loci.iter().map(|locus| locus.crossings.len()).sum();
        if crossings > 0 {
            let crossings = count(crossings, "crossing");
            let _ = writeln!(text, "  {crossings} of loci passed straight through");
        }
    }
    text += &format!("{}\n", words::completeness(report));
    text
}

/// Points of loci as CSV, in m and rad with all digits.
pub fn locus_csv(mechanism: &Mechanism, report: &LocusReport) -> String {
    let mut columns: Vec<String> = ["locus", "kind", "type", "shape", "configurations"]
        .map(str::to_owned)
        .to_vec();
    let own = columns.len();
    let sides = report.bounds.iter();
    columns.extend(sides.map(|bound| field(&format!("{} ({})", bound.name, bound.unit))));
    columns.extend(joint_columns(mechanism));
    for platform in mechanism.platforms() {
        let parts = ["x (m)", "y (m)", "z (m)", "qw", "qx", "qy", "qz"];
        columns.extend(parts.map(|part| field(&format!("{}.{part}", platform.name))));
    }
    let once = once(&mut columns, own);
    let mut text = columns.join(",") + "\n";
    for (i, locus) in report.loci.iter().enumerate() {
        let kind = locus.singularity.gosselin_angeles;
        let kind = kind.map_or(String::new(), |kind| kind.to_string());
        for ((point, joints), poses) in locus.points.iter().zip(&locus.joints).zip(&locus.poses) {
            let _ = write!(
                text,
                "{},{},{kind},{},{}",
                i + 1,
                kind_word(locus.kind),
                match locus.shape {
                    Shape::Curve => "curve",
                    Shape::Point => "point",
                },
                locus.configurations
            );
            let values = point.iter().chain(joints).chain(poses.iter().flatten());
            for (value, _) in values.zip(&once).filter(|(_, once)| **once) {
                let _ = write!(text, ",{}", digits(*value));
            }
            text.push('\n');
        }
    }
    text
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
