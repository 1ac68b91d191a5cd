//! How an assembled mechanism moves, as text and as JSON.

use std::fmt::Write;

use serde::Serialize;

use super::closing;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{degrees, number, quantity, short, size};
use crate::analysis::velocity::{
    FirstOrderOnly, FrameRate, Gain, InputOutput, InstantCentre, Transmission, VelocityReport,
};
use crate::description::count;
use crate::description::listed;
use crate::mechanism::Mechanism;

/// The report as JSON: the fields of [`VelocityReport`] after one sentence.
pub fn json(mechanism: &Mechanism, report: &VelocityReport) -> String {
    #[derive(Serialize)]
    struct VelocityJson<'a> {
        sentence: String,
        #[serde(flatten)]
        report: &'a VelocityReport,
    }
    let sentence = sentence(report);
    document(mechanism.name(), &VelocityJson { sentence, report })
}

/// The report as text.
pub fn text(mechanism: &Mechanism, report: &VelocityReport) -> String {
    let mut sections = vec![heading(mechanism, report)];
    if !report.joints.is_empty() {
        sections.push(joints(report));
    }
    sections.extend(report.frames.iter().map(frame));
    sections.extend(
        report
            .jacobian
            .as_ref()
            .map(|j| jacobian(j, report.normalising_length)),
    );
    if !report.transmission.is_empty() {
        sections.push(transmission(&report.transmission));
    }
    if !report.centres.is_empty() {
        sections.push(centres(&report.centres));
    }
    sections.join("\n")
}

/// The answer in one sentence.
fn sentence(report: &VelocityReport) -> String {
    if let Some(gain) = &report.gain {
        return gained(gain, report.inputs.is_empty());
    }
    let doubt = doubt(report);
    if !report.accuracy.tells_rates() {
        return doubt;
    }
    let inputs = report.inputs.iter();
    let moving = inputs.filter(|input| input.rate != 0.0 || input.acceleration != 0.0);
    let moving: Vec<String> = moving
        .map(|input| {
            let (rate, change) = (number(input.rate), number(input.acceleration));
            let unit = input.unit;
            match input.acceleration {
                0.0 => format!("{} at {rate} {unit}/s", input.name),
                _ => format!("{} at {rate} {unit}/s and {change} {unit}/s²", input.name),
            }
        })
        .collect();
    let loss = report.jacobian.as_ref().map_or(0, |jacobian| jacobian.loss);
    let lost = match loss {
        0 => String::new(),
        loss => format!(
            " Singular: {} lost, some motion of the inputs moves no output.",
            count(loss, "freedom")
        ),
    };
    match (moving.is_empty(), &report.first_order_only) {
        (_, Some(only)) => infinitesimal(&moving, only) + &lost,
        (true, None) => format!("Everything held stands still.{lost}{doubt}"),
        (false, None) => format!("Driven: {}.{lost}{doubt}", listed(&moving)),
    }
}

/// What is free although everything held stands still.
fn gained(gain: &Gain, nothing_held: bool) -> String {
    let freedoms = count(gain.freedoms, "freedom");
    let moving = listed(&gain.moving);
    match (nothing_held, gain.finite) {
        (true, true) => format!(
            "Nothing is held, and {moving} can move: {freedoms}. Hold as many coordinates to drive \
             the mechanism."
        ),
        (true, false) => format!(
            "Nothing is held, and {moving} can move to first order: {freedoms}, not all of them \
             finite. `linkwork mobility` says which are; the rates are not determined."
        ),
        (false, true) => format!(
            "Not determined: {moving} can move although everything held stands still, in {freedoms} \
             more than are held. Motions meet here, which `linkwork mobility` lists; ask beside this \
             configuration."
        ),
        (false, false) => format!(
            "Singular: {freedoms} gained, {moving} can move to first order although everything held \
             stands still; the rates are not determined."
        ),
    }
}

/// Rates that belong to no motion.
fn infinitesimal(moving: &[String], only: &FirstOrderOnly) -> String {
    let rates = match moving {
        [] => "rates of what is held".to_owned(),
        moving => format!("rates with {}", listed(moving)),
    };
    let why = match only.gap_after_step {
        Some(gap) => format!("a finite step along them leaves the closures open by {gap:.1e}"),
        None => format!(
            "any accelerations open the closures, at {:.1e} per s²",
            only.mismatch
        ),
    };
    let so = match only.shaky {
        true => "the mechanism cannot move here",
        false => "no motion has them",
    };
    format!(
        "Infinitesimal only: to first order there are {rates}, but {why}; {so}, and there are no \
         accelerations."
    )
}

/// What is uncertain in the digits that are shown; nothing where they are all known.
fn doubt(report: &VelocityReport) -> String {
    /// Six decimals are shown.
    const SHOWN: f64 = 1e-6;
    let accuracy = &report.accuracy;
    let Some(smallest) = accuracy.smallest_singular_value else {
        return String::new();
    };
    let near = format!(
        "a singular configuration: the smallest singular value is {} (with lengths over {} m), and \
         rounding leaves the configuration uncertain by {}",
        size(smallest),
        number(report.normalising_length),
        size(accuracy.configuration)
    );
    let parts = |share: f64| format!("{share:.0e}");
    match (accuracy.tells_rates(), accuracy.tells_accelerations()) {
        (false, _) => format!("Too near {near}, so that the rates are not determined."),
        (true, false) => format!(
            " Too near {near}: rates are known to {} of the largest, accelerations are not \
             determined.",
            parts(accuracy.rates.max(SHOWN))
        ),
        (true, true) if accuracy.rates.max(accuracy.accelerations) > SHOWN => format!(
            " Near {near}: rates are known to {} of the largest, accelerations to {}.",
            parts(accuracy.rates.max(SHOWN)),
            parts(accuracy.accelerations.max(SHOWN))
        ),
        (true, true) => String::new(),
    }
}

fn heading(mechanism: &Mechanism, report: &VelocityReport) -> String {
    let mut text = format!("{}\n{}\n", mechanism.name(), sentence(report));
    if let Some(gap) = &report.given_gap {
        let _ = writeln!(text, "  {}", closing::given(gap, report.kept));
    }
    text
}

fn joints(report: &VelocityReport) -> String {
    let mut table = plain(["name", "", "value", "rate", "acceleration"]);
    for joint in &report.joints {
        let per = |value: Option<f64>, time: &str| match value {
            Some(value) => format!("{} {}/{time}", number(value), joint.unit),
            None => "not determined".into(),
        };
        table.add_row([
            joint.name.as_str(),
            if joint.held { "held" } else { "solved" },
            &quantity(joint.value, joint.unit.is_angle()),
            &per(joint.rate, "s"),
            &per(joint.acceleration, "s²"),
        ]);
    }
    align_right(&mut table, 2..5);
    format!("Joints\n{}", indented(&table.to_string()))
}

fn frame(frame: &FrameRate) -> String {
    let header = [
        "",
        "position (m)",
        "v (m/s)",
        "a (m/s²)",
        "ω (rad/s)",
        "dω/dt (rad/s²)",
    ];
    let mut table = plain(header);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let columns = [
            Some(frame.position),
            Some(frame.velocity),
            frame.acceleration,
            Some(frame.angular_velocity),
            frame.angular_acceleration,
        ];
        let [a, b, c, d, e] =
            columns.map(|column| column.map_or("none".into(), |column| number(column[i])));
        table.add_row([axis, &a, &b, &c, &d, &e]);
    }
    align_right(&mut table, 1..6);
    let spins = frame.spins.iter().map(|line| {
        let line = line.map(short).join(", ");
        format!("it spins about ({line}) at any rate, which ω is without\n")
    });
    let rest: String = spins.collect();
    format!(
        "Frame {} in ground\n{}{}",
        frame.name,
        indented(&table.to_string()),
        indented(&rest)
    )
}

fn jacobian(jacobian: &InputOutput, length: f64) -> String {
    if jacobian.rows.is_empty() || jacobian.columns.is_empty() {
        return "Input–output Jacobian\n  nothing held drives an output\n".into();
    }
    let mut table = comfy_table::Table::new();
    table.load_style(comfy_table::presets::NOTHING);
    let named = jacobian.columns.iter();
    let header = named.map(|column| format!("{} ({})", column.name, column.unit));
    table.add_row(["output".to_owned()].into_iter().chain(header));
    for (row, entries) in jacobian.rows.iter().zip(&jacobian.entries) {
        let name = format!("{} ({})", row.name, row.unit);
        let entries = entries.iter().map(|&entry| number(entry));
        table.add_row([name].into_iter().chain(entries));
    }
    if let Some(first) = table.column_mut(0) {
        first.set_padding((0, 1));
    }
    align_right(&mut table, 1..=jacobian.columns.len());
    let condition = match jacobian.condition {
        Some(condition) => size(condition),
        None => format!("infinite: {} lost", count(jacobian.loss, "freedom")),
    };
    let without = match jacobian.followed {
        0 => "",
        rows if rows == jacobian.rows.len() => "",
        _ => "without the points followed: ",
    };
    let rest = format!(
        "{without}rank {}, condition number {condition}, manipulability {}, with lengths over {} m\n",
        jacobian.rank,
        number(jacobian.manipulability),
        number(length)
    );
    let table = indented(&table.to_string());
    format!("Input–output Jacobian\n{table}{}", indented(&rest))
}

fn transmission(angles: &[Transmission]) -> String {
    let mut table = plain([
        "driven",
        "at",
        "output",
        "transmission angle",
        "pressure angle",
    ]);
    for angle in angles {
        table.add_row([
            &angle.driven,
            &angle.between,
            &angle.output,
            &degrees(angle.transmission_angle),
            &degrees(angle.pressure_angle),
        ]);
    }
    align_right(&mut table, [3, 4]);
    format!("Transmission\n{}", indented(&table.to_string()))
}

fn centres(centres: &[InstantCentre]) -> String {
    let mut table = plain(["bodies", "", "instant centre"]);
    let triple = |v: &[f64; 3]| v.map(short).join(", ");
    for centre in centres {
        let [a, b] = &centre.bodies;
        let place = match (&centre.point, &centre.at_infinity) {
            (Some(point), _) => format!("({}) m", triple(point)),
            (None, Some(towards)) => format!("at infinity along ({})", triple(towards)),
            (None, None) => "none".into(),
        };
        table.add_row([a, b, &place]);
    }
    format!("Instant centres\n{}", indented(&table.to_string()))
}
