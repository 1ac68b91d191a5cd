//! Mobility of an assembled mechanism, as a document.

mod words;

use super::assembly_remarks;
use super::document::{Document, Section, Table, TableOf};
use super::quantity::{if_any, metres, size};
use super::report::{Remarks, Report};
use super::screws::twist_table;
use crate::analysis::mobility::{BranchReport, LoopCount, MobilityReport};
use crate::description::{count, listed};

/// Branches shown with their motions at most.
const SHOWN: usize = 8;

impl Report for MobilityReport {
    fn document(&self) -> Document {
        let idle = self.idle_freedoms.iter().map(words::idle);
        let elsewhere = self.elsewhere.iter();
        let elsewhere = elsewhere.map(|other| words::elsewhere(self, other));
        let redundant: Vec<String> = self.redundancies.iter().map(words::redundancy).collect();
        let remarks = Remarks {
            explanation: Some(words::explanation(self)),
            redundant_constraints: Some(redundant.clone()),
            ..Remarks::default()
        };
        let twists: &[_] = if self.branches.is_empty() {
            &self.twists
        } else {
            &[]
        };
        let shown = self.branches.iter().enumerate().take(SHOWN);
        let elimination = words::elimination(self);
        assembly_remarks::document(&self.mechanism, words::mobility(self), &self.pose, self.length)
            .remarks(remarks)
            .interrupted(self.interrupted, "branches and other assemblies")
            .notes(words::judged(self))
            .note(words::counted(self))
            .notes(idle.map(|idle| format!("not counted: {idle}")))
            .notes(words::locked(self))
            .notes(elsewhere)
            .notes(assembly_remarks::notes(&self.pose))
            .section(joints(self))
            .section(
                Section::new(
                    "Redundant constraints, in axes of the first frame of each closure, moments about its origin",
                )
                .list(redundant),
            )
            .table("Loops", loops(&self.loops))
            .table("Infinitesimal motions", twist_table(twists))
            .sections(shown.map(|(i, of)| branch(i, of)))
            .section(more_branches(self))
            .method(format!(
                "condition number {} with lengths divided by {}{elimination}",
                size(self.condition),
                metres(self.length)
            ))
    }
}

fn joints(report: &MobilityReport) -> Section {
    if report.joints.is_empty() {
        return Section::new("Joints");
    }
    let still = words::still(report);
    let rows = [
        ("moving", &report.moving_joints, "none"),
        ("idle", &still, "none"),
        ("spinning", &report.spinning_joints, ""),
        ("locked", &report.locked, ""),
    ];
    let shown = rows
        .iter()
        .filter(|(_, names, none)| !(names.is_empty() && none.is_empty()));
    let table = Table::of(shown)
        .words("", |(what, ..)| *what)
        .words("", |(_, names, none)| match names.is_empty() {
            true => (*none).to_owned(),
            false => listed(*names),
        });
    Section::new("Joints").table(table)
}

fn loops(loops: &[LoopCount]) -> TableOf<&LoopCount> {
    Table::of(loops)
        .words("closed by", |of| &of.closure)
        .words("joints", |of| of.joints.join(" "))
        .numbers("Σf", |of| of.freedoms)
        .numbers("Σf − 6", |of| of.kutzbach)
        .numbers("order λ", |of| of.order)
        .numbers("Σf − λ", |of| of.by_order)
}

fn branch(i: usize, branch: &BranchReport) -> Section {
    let moving = if_any(&branch.moving_joints, |joints| format!(", moving {joints}"));
    let kind = match (branch.cone, branch.approximate) {
        (true, _) => "; its motions are a cone in the span of",
        (_, true) => "; its motions are known to about 2 %",
        _ => "",
    };
    let freedoms = count(branch.mobility, "freedom");
    let title = format!("Branch {}: {freedoms}{moving}{kind}", i + 1);
    let section = Section::new(title).table(twist_table(&branch.twists));
    section.or_text("no platform or closure moves")
}

fn more_branches(report: &MobilityReport) -> Section {
    if report.branches.len() <= SHOWN {
        return Section::default();
    }
    let more = count(report.branch_count - SHOWN, "further branch");
    let listed = match report.branch_count - report.branches.len() {
        0 => "listed in the JSON",
        _ => "the first of them listed in the JSON",
    };
    Section::default().text(format!("{more}, {listed}"))
}
