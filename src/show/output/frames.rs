//! Frames placed on joint axes as a document.

mod steps;

use super::report::Report;

use super::complaint::Complaint;
use super::coordinates;
use super::document::{Document, Section, Table};
use super::overview;
use super::quantity::{degrees, metres, size, triple};
use crate::analysis::frames::{
    AxesError, AxesReport, CutChoice, CutReport, FramesReport, PlacedChain, PlacedNormal,
};
use crate::analysis::overview::overview;
use crate::description::{Convention, count, listed, quoted};
use crate::geometry::Relation;
use crate::linear::RANK_TOLERANCE;
use crate::mechanism::Mechanism;
use crate::number::tolerance::WRITTEN_ZERO;

impl Report for FramesReport {
    fn document(&self) -> Document {
        document(self, false)
    }

    fn file(&self) -> Option<Result<String, ron::Error>> {
        Some(self.description.to_ron())
    }
}

/// Frames, with the steps by which they were placed if these are wanted.
pub fn document(report: &FramesReport, steps: bool) -> Document {
    // the file that was made is a valid mechanism
    let overview = Mechanism::new(&report.description).map(|mechanism| overview(&mechanism));
    let warnings = report.warnings.iter().map(|problem| problem.kind.title());
    let mut document = Document::new(&report.mechanism, accuracy(report)).warnings(warnings);
    let Ok(overview) = overview else {
        return document;
    };
    document = document
        .notes(overview.source.clone())
        .sections(report.cuts.as_ref().map(cut_section));
    for chain in &overview.chains {
        document = document.section(overview::chain(chain));
        let mut placed = report.chains.iter();
        let placed = placed.find(|placed| placed.name == chain.name);
        document = document.sections(placed.map(normals));
        if let (Some(placed), true) = (placed, steps) {
            let modified = report.convention == Convention::Modified;
            document = document.section(steps::steps(placed, modified));
        }
    }
    document
        .sections(overview::platforms(&overview))
        .section(overview::closures(&overview))
}

fn cut_section(cuts: &CutReport) -> Section {
    let title = match cuts.cut.is_empty() {
        true => "No loops to cut".to_owned(),
        false => format!("Cut at {}", quoted(&cuts.cut)),
    };
    let balls = cuts.cut.len() - cuts.ways.first().map_or(0, |way| way.cut.len());
    let mut lines = Vec::new();
    if balls > 0 {
        lines.push(format!("{} always cut", count(balls, "spherical joint")));
    }
    match cuts.ways.split_first() {
        None => {}
        Some((best, _)) if best.cut.is_empty() => {}
        Some((best, _)) if cuts.given => {
            lines.push(format!("as the file specifies: {}", simple(best)));
        }
        Some((best, others)) => {
            const SHOWN: usize = 5;
            lines.push(format!("the simplest tables: {}", simple(best)));
            let shown = others.iter().take(SHOWN);
            lines.extend(
                shown.map(|way| format!("alternatively at {}: {}", listed(&way.cut), simple(way))),
            );
            if others.len() > SHOWN {
                lines.push(format!(
                    "and {}",
                    count(others.len() - SHOWN, "other choice")
                ));
            }
            if cuts.more {
                lines.push("further choices were not compared".into());
            }
        }
    }
    match lines.is_empty() {
        true => Section::new("").text(title),
        false => Section::new(title).list(lines),
    }
}

fn simple(way: &CutChoice) -> String {
    let entries = count(way.entries, "non-zero constant");
    let prismatic = match way.prismatic {
        0 => String::new(),
        number => format!(", {}", count(number, "prismatic joint cut")),
    };
    let rows = count(way.longest, "row");
    format!("{rows} in the longest chain, {entries}{prismatic}")
}

/// Relation of the axes, in words.
pub(super) fn relation(relation: Option<Relation>) -> &'static str {
    match relation {
        None => "free",
        Some(Relation::Skew) => "skew",
        Some(Relation::Intersecting) => "intersecting",
        Some(Relation::Parallel) => "parallel",
        Some(Relation::AntiParallel) => "anti-parallel",
        Some(Relation::Coincident) => "one line",
        Some(Relation::AntiCoincident) => "one line, opposite",
        Some(Relation::NearlyParallel) => "nearly parallel",
    }
}

/// Direction that gives x1 its sense where frame 0 follows it: the coordinates' x, or their y if the axis lies along x,
/// or the axes themselves where x0 is at a right angle to that.
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
        Some(Relation::NearlyParallel) => format!("β{k}, and the place of x{k}: d{k} = 0"),
        Some(_) => format!("x{k}: θ{k} = 0, d{k} = 0"),
    }
}

/// Remark on a decision that changed the given axes, or is close to the tolerance.
fn remark(normal: &PlacedNormal) -> Option<String> {
    let found = normal.relation?;
    let off = normal.angle.min(std::f64::consts::PI - normal.angle);
    let tolerance = size(RANK_TOLERANCE);
    if found.is_parallel() && off > WRITTEN_ZERO {
        return Some(format!(
            "treated as parallel: {} rad apart, within {tolerance}",
            size(off)
        ));
    }
    if found.meets() && normal.distance > WRITTEN_ZERO {
        return Some(format!(
            "treated as intersecting: {} m apart, within {tolerance} of the size",
            size(normal.distance)
        ));
    }
    (found == Relation::NearlyParallel).then(|| {
        format!(
            "{} rad apart, beyond {tolerance}: β in place of the common normal, which lies far away",
            size(off)
        )
    })
}

fn normals(chain: &PlacedChain) -> Section {
    type Numbered<'c> = (usize, &'c PlacedNormal);
    let last = chain.normals.len() - 1;
    let name = |k: usize| match k.checked_sub(1) {
        None if chain.starts_at_base => "base",
        None => "free base",
        Some(k) => match chain.joints.get(k) {
            Some(joint) => joint,
            None if chain.ends_at_tool => "tool",
            None => "end",
        },
    };
    let chosen = |(k, normal): Numbered| match (k, normal.relation.is_none()) {
        (0, true) => "frame 0 is frame 1 at the variable's zero".into(),
        (0, false) => "none".into(),
        (k, false) if k == last && chain.ends_at_tool => "none".into(),
        (1, false) => match sense_of_first(chain) {
            Some(sense) => format!("sense of x1: {sense}"),
            None => choice(normal, k),
        },
        _ => choice(normal, k),
    };
    let table = Table::of(chain.normals.iter().enumerate())
        .words("x", |(k, _)| k)
        .words("between", |(k, _)| format!("{} – {}", name(k), name(k + 1)))
        .words("axes", |(_, normal)| relation(normal.relation))
        .numbers("angle", |(_, normal)| {
            normal.relation.map(|_| degrees(normal.angle))
        })
        .numbers("distance", |(_, normal)| {
            normal.relation.map(|_| metres(normal.distance))
        })
        .words("chosen", chosen)
        .words("", |(_, normal)| remark(normal));
    let slides = chain.axes.iter().zip(&chain.joints);
    let slides = slides.filter(|(axis, _)| axis.prismatic);
    let slides = slides.map(|(axis, joint)| {
        let point = triple(&axis.point);
        format!("{joint} slides: the position of its axis is free; it was placed through {point} m")
    });
    Section::new(format!("Common normals of {}", chain.name))
        .table(table)
        .list(slides)
}

fn accuracy(report: &FramesReport) -> String {
    format!(
        "The tables reproduce the axes given to {} m and {} rad.",
        size(report.moved),
        size(report.turned)
    )
}

/// The warning where the axes are those of a configuration that is not assembled.
pub const NOT_ASSEMBLED: &str = "the mechanism could not be assembled near home; these are the axes at home, and \
     tables made from them will not close";

impl Report for AxesReport {
    fn document(&self) -> Document {
        Document::new(&self.mechanism, "").section(coordinates::section(&self.axes))
    }

    fn file(&self) -> Option<Result<String, ron::Error>> {
        Some(self.axes.to_ron())
    }
}

/// Reason for which the joints of a mechanism are not given by axes.
pub fn no_axes(error: &AxesError) -> Complaint {
    let complaint = Complaint::new(error.to_string());
    match error {
        AxesError::Row { .. } => complaint.help(
            "give each joint a variable of its own, so that it turns, slides, or does both by two variables; or ask \
             `linkwork formulas` for the transforms as they are",
        ),
        AxesError::Closure { .. } => complaint
            .help("write the length as a constant plus a variable that occurs nowhere else"),
        AxesError::TooFew => complaint,
    }
}
