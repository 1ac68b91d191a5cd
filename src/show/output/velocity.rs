//! Velocities of an assembled mechanism, as a document.

use super::assembly_remarks;
use super::document::{Cell, Document, Section, Table, TableOf};
use super::quantity::{Quantified, metres, number, size, triple};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::velocity::{
    FirstOrderOnly, FrameRate, Gain, InputOutput, InstantCentre, JointRate, Transmission,
    VelocityReport,
};
use crate::description::{count, listed};

impl Report for VelocityReport {
    fn document(&self) -> Document {
        let jacobian = self.jacobian.as_ref();
        assembly_remarks::document(
            &self.mechanism,
            sentence(self),
            &self.pose,
            self.normalising_length,
        )
        .yes_if(self.is_determined())
        .notes(assembly_remarks::notes(&self.pose))
        .table("Joints", joints(self))
        .sections(self.frames.iter().map(frame))
        .sections(jacobian.map(|j| matrix(j, self.normalising_length)))
        .table("Transmission", transmission(&self.transmission))
        .table("Instant centres", centres(&self.centres))
    }
}

fn sentence(report: &VelocityReport) -> String {
    if let Some(gain) = &report.gain {
        return gained(gain, report.inputs.is_empty());
    }
    let doubt = doubt(report);
    if !report.accuracy.determines_rates() {
        return doubt;
    }
    let inputs = report.inputs.iter();
    let moving = inputs.filter(|input| input.rate != 0.0 || input.acceleration != 0.0);
    let moving = moving.map(|input| {
        let (name, unit) = (&input.name, input.unit);
        let (rate, change) = (number(input.rate), number(input.acceleration));
        match input.acceleration {
            0.0 => format!("{name} at {rate} {unit}/s"),
            _ => format!("{name} at {rate} {unit}/s and {change} {unit}/s²"),
        }
    });
    let moving: Vec<String> = moving.collect();
    let loss = report.jacobian.as_ref().map_or(0, |jacobian| jacobian.loss);
    let lost = match loss {
        0 => String::new(),
        loss => {
            let lost = count(loss, "freedom");
            format!(" Singular: {lost} lost; some motion of the inputs moves no output.")
        }
    };
    match (moving.is_empty(), &report.first_order_only) {
        (_, Some(only)) => infinitesimal(&moving, only) + &lost,
        (true, None) => format!("All inputs stand still.{lost}{doubt}"),
        (false, None) => format!("Driven: {}.{lost}{doubt}", listed(&moving)),
    }
}

/// Freedoms with all held coordinates at rest.
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
    let (gap, mismatch) = (only.gap_after_step, only.mismatch);
    let why = match gap {
        Some(gap) => format!("a finite step along them leaves the closures open by {gap:.1e}"),
        None => format!("any accelerations open the closures, at {mismatch:.1e} per s²"),
    };
    let so = match only.shaky {
        true => "the mechanism cannot move here",
        false => "no finite motion has these rates",
    };
    format!(
        "Infinitesimal only: to first order there are {rates}, but {why}; {so}, and there are no \
         accelerations."
    )
}

/// Uncertainty in the digits that are shown; empty where they are all known.
fn doubt(report: &VelocityReport) -> String {
    /// Six decimals are shown.
    const SHOWN: f64 = 1e-6;
    let accuracy = &report.accuracy;
    let Some(smallest) = accuracy.smallest_singular_value else {
        return String::new();
    };
    let near = format!(
        "a singular configuration: the smallest singular value is {} (with lengths divided by {}), and \
         rounding leaves the configuration uncertain by {}",
        size(smallest),
        metres(report.normalising_length),
        size(accuracy.configuration)
    );
    let parts = |share: f64| format!("{share:.0e}");
    match (
        accuracy.determines_rates(),
        accuracy.determines_accelerations(),
    ) {
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

fn joints(report: &VelocityReport) -> TableOf<&JointRate> {
    let per = |rate: Option<f64>, unit: SiUnit| match rate {
        Some(rate) => Cell::quantity(rate, unit),
        None => "not determined".into(),
    };
    Table::of(report.joints.iter().chain(&report.cut))
        .words("name", |joint| joint.name.as_str())
        .words("", |joint| if joint.held { "held" } else { "solved" })
        .numbers("value", |joint| Cell::quantity(joint.value, joint.unit))
        .numbers("rate", |joint| per(joint.rate, joint.unit.per_second()))
        .numbers("acceleration", |joint| {
            per(joint.acceleration, joint.unit.per_second().per_second())
        })
}

fn frame(frame: &FrameRate) -> Section {
    let [v, ω] = [SiUnit::METRE, SiUnit::RADIAN].map(SiUnit::per_second);
    let columns = [
        ("position", SiUnit::METRE, Some(frame.position)),
        ("v", v, Some(frame.velocity)),
        ("a", v.per_second(), frame.acceleration),
        ("ω", ω, Some(frame.angular_velocity)),
        ("dω/dt", ω.per_second(), frame.angular_acceleration),
    ];
    let axes = Table::of(0..3).words("", |i| ["x", "y", "z"][i]);
    let columns = columns.into_iter();
    let table = columns.fold(axes, |table, (name, unit, value)| {
        let component = |i: usize| value.map_or("none".into(), |v| Cell::from(v[i]));
        table.numbers(name, component).in_unit(unit)
    });
    let spins = frame.spins.iter().map(|line| {
        let line = triple(line);
        format!("it spins about {line} at any rate; ω does not include that spin")
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
    let matrix = Table::of(jacobian.rows.iter().zip(&jacobian.entries))
        .words("output", |(axis, _)| axis.head())
        .values(&jacobian.columns, |(_, row), i| row[i]);
    let condition = match jacobian.condition {
        Some(condition) => size(condition),
        None => format!("infinite: {} lost", count(jacobian.loss, "freedom")),
    };
    let without = match jacobian.followed {
        0 => "",
        rows if rows == jacobian.rows.len() => "",
        _ => "without the points followed: ",
    };
    let directions = jacobian.directions.map(|[first, second, normal]| {
        let [first, second, normal] = [&first, &second, &normal].map(triple);
        format!(
            "1 and 2 are components along {first} and {second} in the plane of motion, n is that along its normal {normal}"
        )
    });
    section.table(matrix).list(directions).text(format!(
        "{without}rank {}, condition number {condition}, manipulability {}, with lengths divided by {}",
        jacobian.rank,
        number(jacobian.manipulability),
        metres(length)
    ))
}

fn transmission(angles: &[Transmission]) -> TableOf<&Transmission> {
    Table::of(angles)
        .words("driven", |angle| &angle.driven)
        .words("at", |angle| &angle.between)
        .words("output", |angle| &angle.output)
        .numbers("transmission angle", |angle| {
            Cell::radians(angle.transmission_angle)
        })
        .numbers("pressure angle", |angle| {
            Cell::radians(angle.pressure_angle)
        })
}

fn centres(centres: &[InstantCentre]) -> TableOf<&InstantCentre> {
    let place = |centre: &InstantCentre| match (&centre.point, &centre.at_infinity) {
        (Some(point), _) => format!("{} m", triple(point)),
        (None, Some(towards)) => format!("at infinity along {}", triple(towards)),
        (None, None) => "none".into(),
    };
    Table::of(centres)
        .words("bodies", |centre| &centre.bodies[0])
        .words("", |centre| &centre.bodies[1])
        .words("instant centre", place)
}
