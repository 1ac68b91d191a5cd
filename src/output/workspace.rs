//! Maps of the workspace as documents, as rows and as pictures.

#[cfg(feature = "plot")]
mod picture;
mod words;

#[cfg(feature = "plot")]
pub use picture::{left_out, svg};
pub use words::{completeness, sentence};

use super::csv::{Record, Value};
use super::document::{Cell, Column, Document, Report, Section, Table, cells};
use super::quantity::{number, quantity};
use crate::algebra::SiUnit;
use crate::analysis::workspace::{AspectReport, BoundaryKind, Conditioned, WorkspaceReport};
use crate::description::count;
use crate::mechanism::Variable;

/// Modes and aspects shown at most.
const MOST: usize = 20;

impl Report for WorkspaceReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        Document::new(&self.mechanism, sentence(self))
            .note(words::question(self))
            .interrupted(self.interrupted, "nodes, modes and boundaries")
            .section(modes(self))
            .section(aspects(self))
            .section(boundary(self))
            .method(completeness(self))
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        vec![("completeness", Some(completeness(self)))]
    }
}

/// The nodes as rows: the names of the columns, then the values in SI units and rad. An aspect is
/// missing for a node outside limits or on a singularity.
pub fn node_rows(
    report: &WorkspaceReport,
) -> (Vec<String>, impl Iterator<Item = Record<'static>> + '_) {
    let columns = report.cells.columns.iter().map(Variable::to_string);
    let rows = report.cells.iter();
    let rows = rows.map(|cell| cell.values().map(Value::from).collect());
    (columns.collect(), rows)
}

/// The points of the boundary curves as rows, in the same way.
pub fn boundary_rows(
    report: &WorkspaceReport,
) -> (Vec<String>, impl Iterator<Item = Record<'static>> + '_) {
    let own = ["curve", "kind", "ends reach"].map(str::to_owned);
    let axes = report.axes.iter();
    let axes = axes.map(|axis| Variable::new(&axis.name, axis.unit).to_string());
    let joints = report.variables.iter().map(Variable::to_string);
    let columns = own.into_iter().chain(axes).chain(joints).collect();
    let rows = report.curves.iter().enumerate().flat_map(|(i, curve)| {
        let points = curve.points.iter().zip(&curve.joints);
        points.map(move |(point, joints)| {
            let first = [
                Value::from(i + 1),
                Value::from(words::kind(&curve.kind)),
                Value::from(curve.ends_reach),
            ];
            let values = point.iter().chain(&curve.slice).chain(joints);
            let values = values.map(|value| Value::from(*value));
            first.into_iter().chain(values).collect()
        })
    });
    (columns, rows)
}

fn modes(report: &WorkspaceReport) -> Section {
    let mut table = Table::new([
        Column::numbers("mode"),
        Column::numbers("nodes"),
        Column::numbers("within limits"),
        Column::words("size"),
        Column::words("aspects"),
    ]);
    for mode in report.modes.iter().take(MOST) {
        let aspects = report.aspects.iter().filter(|a| a.mode == mode.mode);
        let aspects: Vec<usize> = aspects.map(|aspect| aspect.aspect).collect();
        let aspects = match aspects[..] {
            [] => "none".into(),
            [one] => one.to_string(),
            [first, .., last] => format!("{first} to {last}"),
        };
        let size = words::area(report, mode.size);
        table.row(cells![mode.mode, mode.nodes, mode.within, size, aspects]);
    }
    let repeated = report.modes.iter().filter(|mode| mode.repeated > 0);
    let repeated = repeated.map(|mode| {
        format!(
            "mode {} meets itself: going round in the box leads from one configuration to another, \
             at {}",
            mode.mode,
            count(mode.repeated, "node")
        )
    });
    Section::new(format!("Modes{}", more(report.modes.len())))
        .table(table)
        .list(repeated)
}

fn more(all: usize) -> String {
    match all > MOST {
        true => format!(", {MOST} of {all}; JSON has all of them"),
        false => String::new(),
    }
}

fn aspects(report: &WorkspaceReport) -> Section {
    /// Aspects of fewer nodes are only counted.
    const FEW: usize = 4;
    let mut table = Table::new([
        Column::numbers("aspect"),
        Column::numbers("mode"),
        Column::numbers("nodes"),
        Column::words("size"),
        Column::words("direct"),
        Column::words("inverse"),
        Column::numbers("best"),
        Column::words("at"),
        Column::numbers("worst"),
        Column::words("at"),
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
    let (large, small): (Vec<&AspectReport>, Vec<_>) = report
        .aspects
        .iter()
        .partition(|aspect| aspect.nodes >= FEW);
    for aspect in large.iter().take(MOST) {
        let best = aspect.best.as_ref();
        let worst = aspect.worst.as_ref();
        table.row(cells![
            aspect.aspect,
            aspect.mode,
            aspect.nodes,
            words::area(report, aspect.size),
            sign(aspect.direct),
            sign(aspect.inverse),
            best.map(|node| Cell::size(node.condition)),
            best.map(at),
            worst.map(|node| Cell::size(node.condition)),
            worst.map(at),
        ]);
    }
    let few = match (small.len(), large.is_empty()) {
        (0, _) => None,
        (n, false) => Some(format!(
            "and {} of fewer than {FEW} nodes",
            count(n, "aspect")
        )),
        (n, true) => Some(format!("{} of fewer than {FEW} nodes", count(n, "aspect"))),
    };
    let section = Section::new(format!("Aspects{}", more(large.len())));
    match report.aspects.is_empty() {
        true => section,
        false => section
            .table(table)
            .list(few.into_iter().chain(words::explanation(report))),
    }
}

fn boundary(report: &WorkspaceReport) -> Section {
    let mut kinds: Vec<(&BoundaryKind, bool)> = Vec::new();
    for point in &report.points {
        if !kinds.iter().any(|(kind, _)| **kind == point.kind) {
            kinds.push((&point.kind, point.ends_reach));
        }
    }
    kinds.sort();
    let mut table = Table::new([
        Column::words("what"),
        Column::words("does"),
        Column::numbers("points"),
        Column::numbers("curves"),
    ]);
    for (kind, ends) in kinds {
        let points = report.points.iter().filter(|point| point.kind == *kind);
        let curves = report.curves.iter().filter(|curve| curve.kind == *kind);
        let curves = (report.axes.len() > 1).then(|| curves.count());
        let does = if ends {
            "ends modes"
        } else {
            "separates aspects"
        };
        table.row(cells![words::kind(kind), does, points.count(), curves]);
    }
    Section::new("Boundary, located to rounding on the edges of the grid").table(table)
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
