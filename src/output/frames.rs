//! Words for frames placed on joint axes.

mod steps;

use std::fmt::Write;

use super::complaint::Complaint;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::overview;
use super::quantity::{degrees, number, quantity, short, size};
use crate::analysis::frames::{
    AxesError, AxesReport, CutReport, FramesReport, PlacedChain, PlacedNormal, Way,
};
use crate::analysis::overview::Overview;
use crate::description::{
    AxesDescription, AxisDescription, AxisKind, AxisPlace, Convention, Entry, count, listed,
};
use crate::geometry::Relation;
use crate::linear::RANK_TOLERANCE;

/// Axes this near to parallel get a remark though their normal is used.
const NEARLY_PARALLEL: f64 = 1e-3;

/// Below this a difference is rounding.
const ROUNDING: f64 = 1e-12;

/// The report as text, with the drawn tables of the mechanism it makes, and with the steps by which
/// the frames were placed if asked.
pub fn text(report: &FramesReport, overview: &Overview, steps: bool) -> String {
    let mut sections = vec![overview::heading(overview)];
    if let Some(cuts) = &report.cuts {
        sections.push(cut_section(cuts));
    }
    for chain in &overview.chains {
        sections.push(overview::chain(chain));
        let placed = report
            .chains
            .iter()
            .find(|placed| placed.name == chain.name);
        sections.extend(placed.map(normals));
        if let (Some(placed), true) = (placed, steps) {
            sections.push(steps::steps(
                placed,
                report.convention == Convention::Modified,
            ));
        }
    }
    sections.extend(overview::platforms(overview));
    if !overview.closures.is_empty() {
        sections.push(overview::closures(overview));
    }
    sections.push(accuracy(report));
    sections.join("\n")
}

/// The report as JSON, with the mechanism file as a text.
pub fn json(report: &FramesReport) -> String {
    document(&report.mechanism, report)
}

fn cut_section(cuts: &CutReport) -> String {
    let quoted: Vec<String> = cuts.cut.iter().map(|name| format!("`{name}`")).collect();
    let mut text = match cuts.cut.is_empty() {
        true => String::from("No loops to cut\n"),
        false => format!("Cut at {}\n", listed(&quoted)),
    };
    let balls = cuts.cut.len() - cuts.ways.first().map_or(0, |way| way.cut.len());
    if balls > 0 {
        let _ = writeln!(
            text,
            "  {} cut in any case",
            count(balls, "spherical joint")
        );
    }
    let Some((best, others)) = cuts.ways.split_first() else {
        return text;
    };
    if best.cut.is_empty() {
        return text;
    }
    if cuts.given {
        let _ = writeln!(text, "  as the file asks: {}", simple(best));
        return text;
    }
    let _ = writeln!(text, "  the simplest tables: {}", simple(best));
    const SHOWN: usize = 5;
    for way in others.iter().take(SHOWN) {
        let _ = writeln!(text, "  instead at {}: {}", listed(&way.cut), simple(way));
    }
    if others.len() > SHOWN {
        let more = others.len() - SHOWN;
        let _ = writeln!(text, "  and {}", count(more, "other way"));
    }
    if cuts.more {
        text += "  more ways to cut were not compared\n";
    }
    text
}

fn simple(way: &Way) -> String {
    let entries = match way.entries {
        1 => "1 constant that is not zero".into(),
        number => format!("{number} constants that are not zero"),
    };
    let prismatic = match way.prismatic {
        0 => String::new(),
        number => format!(", {}", count(number, "prismatic joint cut")),
    };
    let rows = count(way.longest, "row");
    format!("{rows} in the longest chain, {entries}{prismatic}")
}

/// What relation the axes have, in words.
pub(super) fn relation(relation: Option<Relation>) -> &'static str {
    match relation {
        None => "free",
        Some(Relation::Skew) => "skew",
        Some(Relation::Intersecting) => "intersecting",
        Some(Relation::Parallel) => "parallel",
        Some(Relation::AntiParallel) => "anti-parallel",
        Some(Relation::Coincident) => "one line",
        Some(Relation::AntiCoincident) => "one line, opposite",
    }
}

/// What gives x1 its sense where frame 0 follows it: the coordinates' x, or their y if the axis lies along x, or the axes
/// themselves where x0 is at a right angle to that.
pub(super) fn sense_of_first(chain: &PlacedChain) -> Option<&'static str> {
    let (free, first) = (chain.normals.first()?, chain.normals.get(1)?);
    if chain.starts_at_base || first.relation != Some(Relation::Intersecting) {
        return None;
    }
    let [x, y, _] = free.x;
    let [along, ..] = chain.axes.first()?.direction;
    Some(match along * along < 0.75 {
        true if x > RANK_TOLERANCE => "x0 within ±90° of the coordinates' x",
        false if y > RANK_TOLERANCE => "x0 within ±90° of the coordinates' y",
        _ => "along z1 × z2",
    })
}

fn choice(normal: &PlacedNormal, k: usize) -> String {
    match normal.relation {
        None => format!("θ{k} = 0, d{k} = 0 at the variable's zero"),
        Some(Relation::Skew) => "none".into(),
        Some(Relation::Intersecting) => format!("sense of x{k}: θ{k} within ±90°"),
        Some(Relation::Parallel | Relation::AntiParallel) => format!("place of x{k}: d{k} = 0"),
        Some(_) => format!("x{k}: θ{k} = 0, d{k} = 0"),
    }
}

/// Where a decision changed what was given, or stands on an edge.
fn remark(normal: &PlacedNormal) -> Option<String> {
    let found = normal.relation?;
    let off = normal.angle.min(std::f64::consts::PI - normal.angle);
    let tolerance = size(RANK_TOLERANCE);
    if found.is_parallel() && off > ROUNDING {
        return Some(format!(
            "taken as parallel: {} rad apart, within {tolerance}",
            size(off)
        ));
    }
    if found.meets() && normal.distance > ROUNDING {
        return Some(format!(
            "taken as meeting: {} m apart, within {tolerance} of the size",
            size(normal.distance)
        ));
    }
    if !found.is_parallel() && off < NEARLY_PARALLEL {
        return Some(format!(
            "nearly parallel: {} rad, beyond {tolerance}; the normal is far off",
            size(off)
        ));
    }
    None
}

fn normals(chain: &PlacedChain) -> String {
    let mut table = plain(["x", "between", "axes", "angle", "distance", "chosen", ""]);
    let last = chain.normals.len() - 1;
    let name = |k: usize| match k.checked_sub(1) {
        None => match chain.starts_at_base {
            true => "base".to_owned(),
            false => "free base".into(),
        },
        Some(k) => match chain.joints.get(k) {
            Some(joint) => joint.clone(),
            None if chain.ends_at_tool => "tool".into(),
            None => "end".into(),
        },
    };
    for (k, normal) in chain.normals.iter().enumerate() {
        let nothing = normal.relation.is_none();
        let shown = |text: String| if nothing { String::new() } else { text };
        let chosen = match (k, nothing) {
            (0, true) => "frame 0 is frame 1 at the variable's zero".into(),
            (0, false) => "none".into(),
            (k, false) if k == last && chain.ends_at_tool => "none".into(),
            (1, false) => match sense_of_first(chain) {
                Some(sense) => format!("sense of x1: {sense}"),
                None => choice(normal, k),
            },
            _ => choice(normal, k),
        };
        table.add_row([
            &k.to_string(),
            &format!("{} – {}", name(k), name(k + 1)),
            relation(normal.relation),
            &shown(degrees(normal.angle)),
            &shown(format!("{} m", number(normal.distance))),
            &chosen,
            &remark(normal).unwrap_or_default(),
        ]);
    }
    align_right(&mut table, [3, 4]);
    let mut text = format!(
        "Common normals of {}\n{}",
        chain.name,
        indented(&table.to_string())
    );
    let slides = chain.axes.iter().zip(&chain.joints);
    for (axis, joint) in slides.filter(|(axis, _)| axis.prismatic) {
        let [x, y, z] = axis.point.map(short);
        let _ = writeln!(
            text,
            "  {joint} slides: its axis has no place and was put through ({x}, {y}, {z}) m"
        );
    }
    text
}

fn accuracy(report: &FramesReport) -> String {
    format!(
        "The tables reproduce the axes given to {} m and {} rad.\n",
        size(report.moved),
        size(report.turned)
    )
}

/// What is said where the axes are those of a configuration that is not assembled.
pub const NOT_ASSEMBLED: &str = "warning: the mechanism could not be assembled near home; these are \
     the axes at home, and what is made from them will not close\n";

/// The axes that the tables of a mechanism describe.
pub fn axes_text(axes: &AxesDescription) -> String {
    let vector = |v: &[Entry; 3]| {
        let shown = v.each_ref().map(|x| match x.expression.as_number() {
            Some(value) => number(value),
            None => x.expression.to_string(),
        });
        format!("({})", shown.join(", "))
    };
    let mut table = plain(["joint", "kind", "point (m)", "direction", "home", "between"]);
    for joint in &axes.joints {
        let axis = &joint.value;
        let (point, direction) = match &axis.place {
            AxisPlace::Along(point, direction) => (
                point.as_ref().map_or("any".into(), vector),
                vector(direction),
            ),
            AxisPlace::Through(first, second) => (vector(first), format!("to {}", vector(second))),
            AxisPlace::Centre(point) => (vector(point), String::new()),
        };
        let between = axis.between.as_ref();
        let between = between.map_or(String::new(), |[a, b]| {
            format!("{} and {}", a.value, b.value)
        });
        table.add_row([
            &joint.name.value,
            &axis.kind.word().to_lowercase(),
            &point,
            &direction,
            &home(axis),
            &between,
        ]);
    }
    format!(
        "{}\nJoint axes\n{}",
        axes.name.value,
        indented(&table.to_string())
    )
}

/// The value of a joint's variable, with its unit.
fn home(axis: &AxisDescription) -> String {
    let value = axis.home.expression.evaluate(&|_| f64::NAN);
    match (axis.kind, value) {
        (AxisKind::Spherical, _) => String::new(),
        (kind, Ok(value)) => quantity(value, kind != AxisKind::Prismatic),
        (_, Err(_)) => axis.home.expression.to_string(),
    }
}

/// The same as JSON: the file of axes as a text.
pub fn axes_json(report: &AxesReport) -> String {
    document(&report.mechanism, report)
}

/// Why the joints of a mechanism are not given by axes.
pub fn no_axes(error: &AxesError) -> Complaint {
    let (title, help) = match error {
        AxesError::Row { chain, row } => (
            format!("row {row} of chain `{chain}` is not one joint with a variable of its own"),
            Some(
                "axes are given for joints that turn or slide, or do both by two variables; give each joint a variable \
                 of its own, or ask `linkwork formulas` for the transforms as they are"
                    .to_owned(),
            ),
        ),
        AxesError::Closure { closure, kind } => (
            format!(
                "the length of the {} closure `{closure}` is not one joint",
                kind.word().to_lowercase()
            ),
            Some("write the length as a constant plus a variable that stands nowhere else".into()),
        ),
        AxesError::TooFew => ("the mechanism has no joints with axes".to_owned(), None),
    };
    Complaint::new(title, "", help)
}
