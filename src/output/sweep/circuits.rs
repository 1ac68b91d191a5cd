//! Circuits and branches in words.

use serde::Serialize;

use crate::analysis::sweep::{Circuit, CircuitsReport, FourBarClass};
use crate::description::{count, listed};
use crate::mechanism::Mechanism;
use crate::output::json::document;
use crate::output::layout::{align_right, indented, plain};
use crate::output::quantity::{number, quantity};

/// The circuits as JSON: the fields of [`CircuitsReport`] after one sentence.
pub fn circuits_json(mechanism: &Mechanism, report: &CircuitsReport) -> String {
    #[derive(Serialize)]
    struct CircuitsJson<'a> {
        sentence: String,
        #[serde(flatten)]
        report: &'a CircuitsReport,
    }
    let sentence = sentence(report);
    document(mechanism.name(), &CircuitsJson { sentence, report })
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
    let branches = match branches {
        1 => "1 branch".into(),
        n => format!("{n} branches"),
    };
    let grashof = match report.class {
        Some(FourBarClass::TripleRocker) => {
            ": a triple rocker, for no link turns fully beside another".into()
        }
        Some(of) => format!(": a {}", class(of)),
        None => String::new(),
    };
    format!("{what} with {branches} for {}{grashof}.", report.input)
}

/// The circuits as text.
pub fn circuits_text(mechanism: &Mechanism, report: &CircuitsReport) -> String {
    let mut text = format!(
        "{}\n{}\n  followed from {} of all assemblies at several values of {}{}\n",
        mechanism.name(),
        sentence(report),
        count(report.seeds, "seed"),
        report.input,
        match report.unusable {
            0 => String::new(),
            n => format!("; {n} of them outside limits or singular"),
        }
    );
    for circuit in &report.circuits {
        text += &one(mechanism, report, circuit);
    }
    text
}

fn one(mechanism: &Mechanism, report: &CircuitsReport, circuit: &Circuit) -> String {
    let shape = match (circuit.whole, circuit.closed) {
        (false, _) => "was not followed to its end",
        (true, true) => "closes",
        (true, false) => "goes from limit to limit",
    };
    let mut text = format!(
        "\nCircuit {} {shape}; length {} in rad and units of {} m\n",
        circuit.number,
        number((circuit.length * 1e3).round() / 1e3),
        number(report.characteristic_length)
    );
    let mut table = plain(["joint", "turns", "lowest", "highest"]);
    for joint in &circuit.joints {
        let is_angle = joint.unit.is_angle();
        let range = |x: f64| match joint.turns {
            0 => quantity(x, is_angle),
            _ => String::new(),
        };
        let turns = match joint.turns {
            0 => "swings".to_owned(),
            n => n.to_string(),
        };
        table.add_row([
            joint.name.clone(),
            turns,
            range(joint.low),
            range(joint.high),
        ]);
    }
    align_right(&mut table, 1..4);
    text += &indented(&table.to_string());
    let is_angle = (mechanism.joint(&report.input))
        .is_some_and(|joint| mechanism.joints()[joint].kind.is_angle());
    for (i, branch) in circuit.branches.iter().enumerate() {
        text += &match branch.turns {
            true => format!("  branch {}: {} turns fully\n", i + 1, report.input),
            false => format!(
                "  branch {}: {} from {} to {}\n",
                i + 1,
                report.input,
                quantity(branch.low, is_angle),
                quantity(branch.high, is_angle)
            ),
        };
    }
    if !circuit.crossings.is_empty() {
        let input = mechanism.joint(&report.input).unwrap_or(0);
        let places = places(
            circuit.crossings.iter().map(|joints| joints[input]),
            is_angle,
        );
        let others: Vec<String> = circuit.crosses.iter().map(|n| n.to_string()).collect();
        let with = match others.is_empty() {
            true => "other branches".to_owned(),
            false => format!("circuit {}", listed(&others)),
        };
        text += &format!(
            "  crosses {with} at {} = {}\n",
            report.input,
            listed(&places)
        );
    }
    text
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
