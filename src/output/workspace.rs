//! Maps of the workspace as text, JSON, CSV and as pictures.

#[cfg(feature = "plot")]
mod picture;
mod words;

#[cfg(feature = "plot")]
pub use picture::{left_out, svg};
pub use words::{
    also_held, boundary_flat, completeness, empty_side, more_than_a_turn, no_platform, no_range,
    sentence, too_fine, too_many_axes, too_many_cells, wrong_count, wrong_grid,
};

use std::fmt::Write;

use serde::Serialize;

use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{digits, number, quantity, size};
use crate::algebra::SiUnit;
use crate::analysis::workspace::{AspectReport, BoundaryKind, Conditioned, WorkspaceReport};
use crate::description::count;
use crate::mechanism::Mechanism;

/// A map as JSON: the fields of [`WorkspaceReport`] after two sentences, then columns and rows.
pub fn json(report: &WorkspaceReport) -> String {
    #[derive(Serialize)]
    struct Json<'a> {
        sentence: String,
        completeness: String,
        #[serde(flatten)]
        report: &'a WorkspaceReport,
    }
    let json = Json {
        sentence: sentence(report),
        completeness: completeness(report),
        report,
    };
    document(&report.mechanism, &json)
}

fn joint_columns(mechanism: &Mechanism) -> Vec<String> {
    let joints = mechanism.joints().iter();
    joints
        .map(|joint| {
            let unit = if joint.kind.is_angle() { "rad" } else { "m" };
            format!("{} ({unit})", joint.name)
        })
        .collect()
}

/// A name with a comma stands in quotes (RFC 4180).
fn header(columns: &[String]) -> String {
    let fields = columns.iter().map(|name| match name.contains([',', '"']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.clone(),
    });
    fields.collect::<Vec<String>>().join(",") + "\n"
}

/// The nodes as lines of CSV, in m and rad with all digits; the first is the header.
pub fn csv(report: &WorkspaceReport) -> impl Iterator<Item = String> + '_ {
    let columns: Vec<String> = report.columns.iter().map(ToString::to_string).collect();
    let first = header(&columns);
    let rows = report.cells.iter().map(|cell| {
        let fields = cell.row();
        let fields = fields.iter().map(|x| x.map_or(String::new(), digits));
        fields.collect::<Vec<String>>().join(",") + "\n"
    });
    std::iter::once(first).chain(rows)
}

/// The points of the boundary curves as lines of CSV.
pub fn boundary_csv<'a>(
    mechanism: &Mechanism,
    report: &'a WorkspaceReport,
) -> impl Iterator<Item = String> + 'a {
    let axes = report.axes.iter();
    let mut columns = vec!["curve".to_owned(), "kind".into(), "ends reach".into()];
    columns.extend(axes.map(|a| format!("{} ({})", a.name, a.unit)));
    columns.extend(joint_columns(mechanism));
    let rows = report.curves.iter().enumerate().flat_map(|(i, curve)| {
        let start = format!(
            "{},{},{}",
            i + 1,
            words::kind(&curve.kind),
            curve.ends_reach
        );
        let points = curve.points.iter().zip(&curve.joints);
        points.map(move |(point, joints)| {
            let mut line = start.clone();
            for value in point.iter().chain(&curve.slice).chain(joints) {
                // writing to a string cannot fail
                let _ = write!(line, ",{}", digits(*value));
            }
            line + "\n"
        })
    });
    std::iter::once(header(&columns)).chain(rows)
}

/// A map as text.
pub fn text(mechanism: &Mechanism, report: &WorkspaceReport) -> String {
    /// Modes and aspects listed.
    const MOST: usize = 20;
    let mut text = format!(
        "{}\n{}\n{}\n",
        mechanism.name(),
        words::question(report),
        sentence(report)
    );
    let mut table = plain(["mode", "nodes", "within limits", "size", "aspects"]);
    for mode in report.modes.iter().take(MOST) {
        let aspects: Vec<&AspectReport> = report
            .aspects
            .iter()
            .filter(|a| a.mode == mode.mode)
            .collect();
        let aspects = match aspects[..] {
            [] => "none".into(),
            [one] => one.aspect.to_string(),
            [first, .., last] => format!("{} to {}", first.aspect, last.aspect),
        };
        table.add_row([
            mode.mode.to_string(),
            mode.nodes.to_string(),
            mode.within.to_string(),
            words::area(report, mode.size),
            aspects,
        ]);
    }
    align_right(&mut table, [0, 1, 2]);
    if !report.modes.is_empty() {
        text += &format!("\nModes{}\n", more(report.modes.len(), MOST));
        text += &indented(&table.to_string());
        for mode in report.modes.iter().filter(|mode| mode.repeated > 0) {
            let _ = writeln!(
                text,
                "  mode {} meets itself: going round in the box leads from one configuration to \
                 another, at {}",
                mode.mode,
                count(mode.repeated, "node")
            );
        }
        text += &aspects(report, MOST);
    }
    text += &boundary(report);
    text + &format!("\n{}\n", completeness(report))
}

fn more(all: usize, most: usize) -> String {
    match all > most {
        true => format!(", {most} of {all}; --format json has all of them"),
        false => String::new(),
    }
}

fn aspects(report: &WorkspaceReport, most: usize) -> String {
    /// Aspects of fewer nodes are only counted.
    const FEW: usize = 4;
    let mut table = plain([
        "aspect", "mode", "nodes", "size", "direct", "inverse", "best", "at", "worst", "at",
    ]);
    let sign = |sign: i8| match sign {
        0 => "",
        1.. => "+",
        _ => "-",
    };
    let at = |node: &Conditioned| {
        let values = node.at.iter().zip(&report.axes);
        let values = values.map(|(x, axis)| quantity(*x, axis.unit.is_angle()));
        values.collect::<Vec<String>>().join(", ")
    };
    let large = |aspect: &&AspectReport| aspect.nodes >= FEW;
    let listed = report.aspects.iter().filter(large);
    let small = report.aspects.len() - listed.clone().count();
    for aspect in listed.clone().take(most) {
        let mut row = vec![
            aspect.aspect.to_string(),
            aspect.mode.to_string(),
            aspect.nodes.to_string(),
            words::area(report, aspect.size),
            sign(aspect.direct).into(),
            sign(aspect.inverse).into(),
        ];
        for node in [&aspect.best, &aspect.worst] {
            match node {
                Some(node) => row.extend([size(node.condition), at(node)]),
                None => row.extend([String::new(), String::new()]),
            }
        }
        table.add_row(row);
    }
    align_right(&mut table, [0, 1, 2, 6, 8]);
    let few = match (small, listed.clone().next()) {
        (0, _) => String::new(),
        (n, Some(_)) => format!("  and {} of fewer than {FEW} nodes\n", count(n, "aspect")),
        (n, None) => format!("  {} of fewer than {FEW} nodes\n", count(n, "aspect")),
    };
    if report.aspects.is_empty() {
        return String::new();
    }
    let table = match listed.clone().next() {
        Some(_) => indented(&table.to_string()),
        None => String::new(),
    };
    format!(
        "\nAspects{}\n{table}{few}{}",
        more(listed.count(), most),
        words::explanation(report)
    )
}

fn boundary(report: &WorkspaceReport) -> String {
    let mut kinds: Vec<(&BoundaryKind, bool)> = Vec::new();
    for point in &report.points {
        if !kinds.iter().any(|(kind, _)| **kind == point.kind) {
            kinds.push((&point.kind, point.ends_reach));
        }
    }
    if kinds.is_empty() {
        return String::new();
    }
    kinds.sort();
    let mut table = plain(["what", "does", "points", "curves"]);
    for (kind, ends) in kinds {
        let points = report.points.iter().filter(|point| point.kind == *kind);
        let curves = report.curves.iter().filter(|curve| curve.kind == *kind);
        let curves = match report.axes.len() {
            1 => String::new(),
            _ => curves.count().to_string(),
        };
        let does = if ends { "ends modes" } else { "parts aspects" };
        table.add_row([
            words::kind(kind),
            does.into(),
            points.count().to_string(),
            curves,
        ]);
    }
    align_right(&mut table, [2, 3]);
    format!(
        "\nBoundary, located to rounding on the edges of the grid\n{}",
        indented(&table.to_string())
    )
}

fn range(name: &str, from: f64, to: f64, unit: SiUnit, nodes: usize) -> String {
    let value = |x| quantity(x, unit.is_angle());
    format!(
        "{name} from {} to {} in {nodes} nodes",
        value(from),
        value(to)
    )
}

fn percent(part: f64) -> String {
    format!("{} %", number((part * 1e3).round() / 10.0))
}
