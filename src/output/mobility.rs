//! What an assembled mechanism can do, as text and as JSON.

mod words;

use std::fmt::Write;

use serde::Serialize;

use super::closing;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{number, signed, size};
use super::screws::twists;
use crate::analysis::mobility::{LoopCount, MobilityReport};
use crate::description::listed;

/// The report as JSON: the fields of [`MobilityReport`] with the answer in sentences.
pub fn json(report: &MobilityReport) -> String {
    #[derive(Serialize)]
    struct MobilityJson<'a> {
        explanation: String,
        redundant_constraints: Vec<String>,
        #[serde(flatten)]
        report: &'a MobilityReport,
    }
    let json = MobilityJson {
        explanation: words::explanation(report),
        redundant_constraints: report.redundancies.iter().map(words::redundancy).collect(),
        report,
    };
    document(&report.mechanism, &json)
}

/// So many branches are shown with their motions.
const SHOWN: usize = 8;

/// The report as text.
pub fn text(report: &MobilityReport) -> String {
    let mut sections = vec![heading(report)];
    if !report.joints.is_empty() {
        sections.push(joints(report));
    }
    if !report.redundancies.is_empty() {
        let lines = report.redundancies.iter();
        let lines: Vec<String> = lines.map(|r| words::redundancy(r) + "\n").collect();
        let frames = "in the first frame of each closure, moments about its point";
        let title = format!("Redundant constraints, {frames}");
        sections.push(format!("{title}\n{}", indented(&lines.concat())));
    }
    if !report.loops.is_empty() {
        sections.push(loops(&report.loops));
    }
    if report.branches.is_empty() {
        sections.push(twists("Infinitesimal motions", &report.twists));
    }
    for (i, branch) in report.branches.iter().enumerate().take(SHOWN) {
        let moving = match branch.moving_joints.as_slice() {
            [] => String::new(),
            joints => format!(", moving {}", listed(joints)),
        };
        let freedoms = crate::description::count(branch.mobility, "freedom");
        let kind = match (branch.cone, branch.approximate) {
            (true, _) => ", a cone of motions in the span of",
            (_, true) => ", motions to about 2 %",
            _ => "",
        };
        let title = format!("Branch {}: {freedoms}{moving}{kind}", i + 1);
        sections.push(match twists(&title, &branch.twists) {
            none if none.is_empty() => title + "\n",
            table => table,
        });
    }
    if report.branches.len() > SHOWN {
        let more = report.branch_count - SHOWN;
        let listed = match report.branch_count - report.branches.len() {
            0 => "listed in the JSON",
            _ => "the first of them listed in the JSON",
        };
        sections.push(format!("{more} more branches, {listed}\n"));
    }
    sections.retain(|section| !section.is_empty());
    sections.join("\n")
}

fn heading(report: &MobilityReport) -> String {
    let mut text = format!("{}\n{}\n", report.mechanism, words::mobility(report));
    let _ = writeln!(
        text,
        "  Kutzbach {} − {} = {}, rank {}, infinitesimal {}, redundant {}",
        report.unknowns,
        report.equations,
        signed(report.kutzbach),
        report.rank,
        report.infinitesimal,
        report.redundant
    );
    let _ = writeln!(
        text,
        "  condition number {} with lengths over {} m",
        size(report.condition),
        number(report.length)
    );
    for freedom in &report.idle_freedoms {
        let _ = writeln!(text, "  not counted: {}", words::idle(freedom));
    }
    for other in &report.elsewhere {
        let _ = writeln!(text, "  {}", words::elsewhere(report, other));
    }
    if let Some(gap) = &report.given {
        let _ = writeln!(text, "  {}", closing::given(gap, report.kept));
    }
    text
}

fn joints(report: &MobilityReport) -> String {
    let said = |names: &[String]| match names {
        [] => "none".to_owned(),
        names => listed(names),
    };
    let (moving, idle) = (said(&report.moving_joints), said(&words::still(report)));
    let spinning = match &report.spinning_joints[..] {
        [] => String::new(),
        names => format!("  spin    {}\n", listed(names)),
    };
    format!("Joints\n  moving  {moving}\n  idle    {idle}\n{spinning}")
}

fn loops(loops: &[LoopCount]) -> String {
    let mut table = plain(["closed by", "joints", "Σf", "Σf − 6", "order λ", "Σf − λ"]);
    for LoopCount {
        closure,
        joints,
        freedoms,
        order,
        kutzbach,
        by_order,
        ..
    } in loops
    {
        let numbers = [*freedoms as i64, *kutzbach, *order as i64, *by_order];
        let [freedoms, kutzbach, order, by_order] = numbers.map(signed);
        let joints = joints.join(" ");
        table.add_row([closure, &joints, &freedoms, &kutzbach, &order, &by_order]);
    }
    align_right(&mut table, 2..6);
    format!("Loops\n{}", indented(&table.to_string()))
}
