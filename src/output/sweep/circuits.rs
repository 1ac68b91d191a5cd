//! Circuits and branches in words.

use crate::analysis::sweep::{Circuit, CircuitsReport, FourBarClass};
use crate::description::{count, listed};
use crate::output::document::{Cell, Column, Document, Report, Section, Table, cells};
use crate::output::quantity::{number, quantity};

impl Report for CircuitsReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        let seeds = format!(
            "followed from {}: all assemblies at several values of {}{}",
            count(self.seeds, "start"),
            self.input,
            match self.unusable {
                0 => String::new(),
                n => format!("; {n} of them outside limits or singular"),
            }
        );
        Document::new(&self.mechanism, sentence(self))
            .interrupted(self.interrupted, "circuits")
            .sections(self.circuits.iter().map(|circuit| one(self, circuit)))
            .method(seeds)
    }
}

fn class(class: FourBarClass) -> &'static str {
    match class {
        FourBarClass::CrankRocker => "crank-rocker",
        FourBarClass::DoubleCrank => "double crank",
        FourBarClass::DoubleRocker => "double rocker whose coupler turns fully",
        FourBarClass::TripleRocker => "triple rocker",
        FourBarClass::ChangePoint => "4-bar with change points",
    }
}

fn sentence(report: &CircuitsReport) -> String {
    let circuits = report.circuits.len();
    let branches: usize = report.circuits.iter().map(|c| c.branches.len()).sum();
    let crossing = report.circuits.iter().any(|c| !c.crossings.is_empty());
    let what = match crossing {
        true => count(circuits, "curve"),
        false => count(circuits, "circuit"),
    };
    let branches = count(branches, "branch");
    let grashof = match report.class {
        Some(FourBarClass::TripleRocker) => {
            ": a triple rocker; no link turns fully relative to another".into()
        }
        Some(of) => format!(": a {}", class(of)),
        None => String::new(),
    };
    format!("{what} with {branches} for {}{grashof}.", report.input)
}

fn one(report: &CircuitsReport, circuit: &Circuit) -> Section {
    let shape = match (circuit.whole, circuit.closed) {
        (false, _) => "was not followed to its end",
        (true, true) => "closes",
        (true, false) => "goes from limit to limit",
    };
    let title = format!(
        "Circuit {} {shape}; length {} in rad and units of {} m",
        circuit.number,
        number((circuit.length * 1e3).round() / 1e3),
        number(report.characteristic_length)
    );
    let mut table = Table::new([
        Column::words("joint"),
        Column::numbers("turns"),
        Column::numbers("lowest"),
        Column::numbers("highest"),
    ]);
    for joint in &circuit.joints {
        let swings = joint.turns == 0;
        let range = |x: f64| swings.then(|| Cell::quantity(x, joint.unit));
        let turns = match swings {
            true => "swings".into(),
            false => Cell::Count(joint.turns),
        };
        table.row(cells![
            &joint.name,
            turns,
            range(joint.low),
            range(joint.high)
        ]);
    }
    let input = circuit.joints.iter().position(|j| j.name == report.input);
    let is_angle = input.is_some_and(|input| circuit.joints[input].unit.is_angle());
    let branches = circuit.branches.iter().enumerate();
    let branches = branches.map(|(i, branch)| match branch.turns {
        true => format!("branch {}: {} turns fully", i + 1, report.input),
        false => format!(
            "branch {}: {} from {} to {}",
            i + 1,
            report.input,
            quantity(branch.low, is_angle),
            quantity(branch.high, is_angle)
        ),
    });
    let crossings = circuit.crossings.iter();
    let crossings = crossings.filter_map(|joints| joints.get(input?).copied());
    let places = places(crossings, is_angle);
    let others: Vec<String> = circuit.crosses.iter().map(|n| n.to_string()).collect();
    let with = match others.is_empty() {
        true => "other branches".to_owned(),
        false => format!("circuit {}", listed(&others)),
    };
    let crosses = format!("crosses {with} at {} = {}", report.input, listed(&places));
    let crosses = (!places.is_empty()).then_some(crosses);
    Section::new(title)
        .table(table)
        .list(branches.chain(crosses))
}

/// Values in order, each once, with the number of crossings there if there are several: they differ
/// in other joints.
fn places(values: impl Iterator<Item = f64>, is_angle: bool) -> Vec<String> {
    const SAME: f64 = 1e-6;
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let same = values.chunk_by(|a, b| b - a < SAME);
    let named = same.map(|same| match same.len() {
        1 => quantity(same[0], is_angle),
        n => format!("{} ({n} times)", quantity(same[0], is_angle)),
    });
    named.collect()
}
