//! What an assembled mechanism can do, as a document.

mod words;

use super::closing;
use super::document::{Cell, Column, Document, Report, Section, Table, cells};
use super::quantity::{number, size};
use super::screws::twist_table;
use crate::analysis::mobility::{BranchReport, LoopCount, MobilityReport};
use crate::description::{count, listed};

/// So many branches are shown with their motions.
const SHOWN: usize = 8;

impl Report for MobilityReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        let idle = self.idle_freedoms.iter();
        let idle = idle.map(|freedom| format!("not counted: {}", words::idle(freedom)));
        let elsewhere = self.elsewhere.iter();
        let elsewhere = elsewhere.map(|other| words::elsewhere(self, other));
        let given = self.given.as_ref();
        let redundant = self.redundancies.iter().map(words::redundancy);
        let motions = match self.branches.is_empty() {
            true => twist_table(&self.twists),
            false => twist_table(&[]),
        };
        let shown = self.branches.iter().enumerate().take(SHOWN);
        let answer = closing::after_moving(self.moved.as_ref(), words::mobility(self));
        let document = Document::new(&self.mechanism, answer)
            .interrupted(self.interrupted, "branches and other assemblies")
            .note(words::counted(self))
            .notes(idle)
            .notes(words::locked(self))
            .notes(elsewhere)
            .notes(given.map(|gap| closing::given(gap, self.kept)))
            .notes(closing::beside(self.moved.as_ref()))
            .section(joints(self))
            .section(
                Section::new(
                    "Redundant constraints, in the first frame of each closure, moments about its point",
                )
                .list(redundant),
            )
            .section(Section::new("Loops").table(loops(&self.loops)))
            .section(Section::new("Infinitesimal motions").table(motions));
        let document = shown.fold(document, |document, (i, of)| {
            // a branch without motions of platforms or links is named all the same
            let section = branch(i, of);
            match section.blocks.is_empty() {
                true => document.section(section.text("no platform or closure moves")),
                false => document.section(section),
            }
        });
        document.section(more_branches(self)).method(format!(
            "condition number {} with lengths over {} m",
            size(self.condition),
            number(self.length)
        ))
    }

    fn sentences(&self) -> Vec<(&'static str, Option<String>)> {
        vec![("explanation", Some(words::explanation(self)))]
    }

    fn lists(&self) -> Vec<(&'static str, Vec<String>)> {
        let redundant = self.redundancies.iter().map(words::redundancy);
        vec![("redundant_constraints", redundant.collect())]
    }
}

fn joints(report: &MobilityReport) -> Section {
    if report.joints.is_empty() {
        return Section::new("Joints");
    }
    let said = |names: &[String]| match names {
        [] => "none".to_owned(),
        names => listed(names),
    };
    let mut table = Table::new([Column::words(""), Column::words("")]);
    table.row(cells!["moving", said(&report.moving_joints)]);
    table.row(cells!["idle", said(&words::still(report))]);
    if !report.spinning_joints.is_empty() {
        table.row(cells!["spinning", listed(&report.spinning_joints)]);
    }
    Section::new("Joints").table(table)
}

fn loops(loops: &[LoopCount]) -> Table {
    let numbers = ["Σf", "Σf − 6", "order λ", "Σf − λ"].map(Column::numbers);
    let words = ["closed by", "joints"].map(Column::words);
    let mut table = Table::new(words.into_iter().chain(numbers));
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
        let [kutzbach, by_order] = [*kutzbach, *by_order].map(Cell::Count);
        table.row(cells![
            closure,
            joints.join(" "),
            *freedoms,
            kutzbach,
            *order,
            by_order
        ]);
    }
    table
}

fn branch(i: usize, branch: &BranchReport) -> Section {
    let moving = match branch.moving_joints.as_slice() {
        [] => String::new(),
        joints => format!(", moving {}", listed(joints)),
    };
    let kind = match (branch.cone, branch.approximate) {
        (true, _) => "; its motions are a cone in the span of",
        (_, true) => "; its motions are known to about 2 %",
        _ => "",
    };
    let freedoms = count(branch.mobility, "freedom");
    let title = format!("Branch {}: {freedoms}{moving}{kind}", i + 1);
    Section::new(title).table(twist_table(&branch.twists))
}

fn more_branches(report: &MobilityReport) -> Section {
    let section = Section::new("");
    if report.branches.len() <= SHOWN {
        return section;
    }
    let more = report.branch_count - SHOWN;
    let listed = match report.branch_count - report.branches.len() {
        0 => "listed in the JSON",
        _ => "the first of them listed in the JSON",
    };
    section.text(format!("{}, {listed}", count(more, "further branch")))
}
