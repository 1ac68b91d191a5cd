//! How an assembled mechanism moves, as a document.

use super::closing;
use super::document::{Cell, Column, Document, Matrix, Report, Section, Table, cells};
use super::quantity::{number, short, size};
use crate::analysis::velocity::{
    Axis, FirstOrderOnly, FrameRate, Gain, InputOutput, InstantCentre, Transmission, VelocityReport,
};
use crate::description::{count, listed};

impl Report for VelocityReport {
    fn document(&self) -> Document {
        let gap = (self.given_gap.as_ref()).map(|gap| closing::given(gap, self.kept));
        let jacobian = self.jacobian.as_ref();
        let answer = closing::after_moving(self.moved.as_ref(), sentence(self));
        Document::new(&self.mechanism, answer)
            .notes(gap)
            .notes(closing::beside(self.moved.as_ref()))
            .section(Section::new("Joints").table(joints(self)))
            .sections(self.frames.iter().map(frame))
            .sections(jacobian.map(|j| matrix(j, self.normalising_length)))
            .section(Section::new("Transmission").table(transmission(&self.transmission)))
            .section(Section::new("Instant centres").table(centres(&self.centres)))
    }
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
            " Singular: {} lost; some motion of the inputs moves no output.",
            count(loss, "freedom")
        ),
    };
    match (moving.is_empty(), &report.first_order_only) {
        (_, Some(only)) => infinitesimal(&moving, only) + &lost,
        (true, None) => format!("All inputs stand still.{lost}{doubt}"),
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
             finite. `linkwork mobility` shows which are; the rates are not determined."
        ),
        (false, true) => format!(
            "Not determined: {moving} can move although all inputs stand still, with {freedoms} more \
             than are held. Branches of motion meet here; `linkwork mobility` lists them. Begin slightly \
             away from this configuration."
        ),
        (false, false) => format!(
            "Singular: {freedoms} gained; {moving} can move to first order although all inputs stand \
             still, and the rates are not determined."
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
        (false, _) => format!("Too near {near}; the rates are not determined."),
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

fn joints(report: &VelocityReport) -> Table {
    let mut table = Table::new([
        Column::words("name"),
        Column::words(""),
        Column::numbers("value"),
        Column::numbers("rate"),
        Column::numbers("acceleration"),
    ]);
    for joint in &report.joints {
        let per = |value: Option<f64>, time: &str| match value {
            Some(value) => Cell::quantity(value, format!("{}/{time}", joint.unit)),
            None => "not determined".into(),
        };
        table.row(cells![
            &joint.name,
            if joint.held { "held" } else { "solved" },
            Cell::quantity(joint.value, joint.unit),
            per(joint.rate, "s"),
            per(joint.acceleration, "s²"),
        ]);
    }
    table
}

fn frame(frame: &FrameRate) -> Section {
    let columns = [
        ("position", "m", Some(frame.position)),
        ("v", "m/s", Some(frame.velocity)),
        ("a", "m/s²", frame.acceleration),
        ("ω", "rad/s", Some(frame.angular_velocity)),
        ("dω/dt", "rad/s²", frame.angular_acceleration),
    ];
    let headers = columns.map(|(name, unit, _)| Column::numbers(name).in_unit(unit));
    let mut table = Table::new([Column::words("")].into_iter().chain(headers));
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let values = columns.map(|(_, _, value)| value.map_or("none".into(), |v| v[i].into()));
        table.row([axis.into()].into_iter().chain(values).collect());
    }
    let spins = frame.spins.iter().map(|line| {
        let line = line.map(short).join(", ");
        format!("it spins about ({line}) at any rate; ω does not include that spin")
    });
    Section::new(format!("Frame {} in ground", frame.name))
        .table(table)
        .list(spins)
}

fn matrix(jacobian: &InputOutput, length: f64) -> Section {
    let section = Section::new("Input–output Jacobian");
    if jacobian.rows.is_empty() || jacobian.columns.is_empty() {
        return section.text("nothing held drives an output");
    }
    let named = |axes: &[Axis]| {
        let names = axes
            .iter()
            .map(|axis| format!("{} ({})", axis.name, axis.unit));
        names.collect()
    };
    let condition = match jacobian.condition {
        Some(condition) => size(condition),
        None => format!("infinite: {} lost", count(jacobian.loss, "freedom")),
    };
    let without = match jacobian.followed {
        0 => "",
        rows if rows == jacobian.rows.len() => "",
        _ => "without the points followed: ",
    };
    section
        .matrix(Matrix {
            rows_are: "output".into(),
            rows: named(&jacobian.rows),
            columns: named(&jacobian.columns),
            entries: jacobian.entries.clone(),
        })
        .text(format!(
            "{without}rank {}, condition number {condition}, manipulability {}, with lengths over {} m",
            jacobian.rank,
            number(jacobian.manipulability),
            number(length)
        ))
}

fn transmission(angles: &[Transmission]) -> Table {
    let mut table = Table::new([
        Column::words("driven"),
        Column::words("at"),
        Column::words("output"),
        Column::numbers("transmission angle"),
        Column::numbers("pressure angle"),
    ]);
    for angle in angles {
        table.row(cells![
            &angle.driven,
            &angle.between,
            &angle.output,
            Cell::quantity(angle.transmission_angle, "rad"),
            Cell::quantity(angle.pressure_angle, "rad"),
        ]);
    }
    table
}

fn centres(centres: &[InstantCentre]) -> Table {
    let mut table = Table::new(["bodies", "", "instant centre"].map(Column::words));
    let triple = |v: &[f64; 3]| v.map(short).join(", ");
    for centre in centres {
        let [a, b] = &centre.bodies;
        let place = match (&centre.point, &centre.at_infinity) {
            (Some(point), _) => Cell::vector(*point).in_unit("m"),
            (None, Some(towards)) => format!("at infinity along ({})", triple(towards)).into(),
            (None, None) => "none".into(),
        };
        table.row(cells![a, b, place]);
    }
    table
}
