//! The forces in a mechanism as a document.

use super::assembly_remarks;
use super::document::{Cell, Document, Table, TableOf};
use super::quantity::{metres, number, shown, size, with_unit};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::statics::{AppliedWrench, Force, Reaction, Rest, StaticsReport};
use crate::description::{count, listed};

impl Report for StaticsReport {
    fn document(&self) -> Document {
        let length = self.normalising_length;
        let rounding = rounding(self);
        assembly_remarks::document(&self.mechanism, sentence(self), &self.pose, length)
            .yes_if(self.unbalanced.is_empty())
            .note(format!(
                "{}condition number {}, forces multiplied by {} for comparison with moments",
                neglected(self),
                size(self.condition),
                metres(length)
            ))
            .notes(across(self))
            .notes(assembly_remarks::notes(&self.pose))
            .table("Loads", loads(self))
            .table("Loads on joints", forces(&self.joint_loads, [0.0; 2]))
            .table("Springs and forces of the file", forces(&self.springs, [0.0; 2]))
            .table(
                "Friction keeps the mechanism at rest between these forces at each held coordinate, the others held",
                rests(self),
            )
            .table("Held coordinates, with the force that holds each", forces(&self.actuators, rounding))
            .table(
                "Closures: components in ground axes, moments about the given point, the origin of the second frame",
                reactions(&self.closures, length, rounding),
            )
            .table(
                "Joints: components in ground axes, moments about the given point, the origin of the frame after the joint",
                reactions(&self.joints, length, rounding),
            )
    }
}

/// The loads that the forces leave out.
fn neglected(report: &StaticsReport) -> &'static str {
    match (report.weightless, report.rests.is_empty()) {
        (true, true) => "without weight and friction; ",
        (true, false) => "without weight; held coordinates and reactions without friction; ",
        (false, true) => "without friction; ",
        (false, false) => "held coordinates and reactions without friction; ",
    }
}

fn rests(report: &StaticsReport) -> TableOf<&Rest> {
    let end = |force: Option<f64>, of: &Rest| match force {
        Some(force) => Cell::quantity(force, of.unit),
        None => "jams".into(),
    };
    Table::of(&report.rests)
        .words("name", |rest| &rest.name)
        .numbers("from", move |rest| end(rest.least, rest))
        .numbers("to", move |rest| end(rest.greatest, rest))
        .words("", |rest| match rest.self_locking {
            true => "self-locking",
            false => "",
        })
}

fn sentence(report: &StaticsReport) -> String {
    match report.gained {
        0 => balance(report),
        gained => {
            let (freedoms, balance) = (count(gained, "freedom"), balance(report));
            format!("Singular: {freedoms} gained, which no held coordinate resists. {balance}")
        }
    }
}

fn balance(report: &StaticsReport) -> String {
    if !report.unbalanced.is_empty() {
        return format!(
            "Not in equilibrium: no held coordinate resists the load along a motion of {}; the forces \
             shown balance it as nearly as possible.",
            listed(&report.unbalanced)
        );
    }
    if report.loads.is_empty() && report.joint_loads.is_empty() && report.springs.is_empty() {
        return "No load: all forces are zero.".into();
    }
    let across = report.across_plane;
    match report.self_stresses - across {
        0 if across == 0 => "In equilibrium; all forces are determined.".into(),
        0 => "In equilibrium; all forces in the plane of motion are determined.".into(),
        stresses => format!(
            "In equilibrium, but not uniquely: {}{} can be added; values marked * are \
             the minimum-norm choice.",
            count(stresses, "state of self-stress"),
            if across > 0 {
                " in the plane of motion"
            } else {
                ""
            }
        ),
    }
}

/// A note on forces that are not determined across the plane of a planar mechanism.
fn across(report: &StaticsReport) -> Option<String> {
    (report.across_plane > 0).then(|| {
        format!(
            "across the plane of motion the mechanism is overconstrained: {} can be added there, and values marked * are \
             the minimum-norm choice",
            count(report.across_plane, "state of self-stress")
        )
    })
}

/// The force (N) and the moment (N·m) that are rounding relative to the largest of a report.
fn rounding(report: &StaticsReport) -> [f64; 2] {
    let length = report.normalising_length;
    let reactions = report.closures.iter().chain(&report.joints);
    let forces = reactions.flat_map(|of| of.force.into_iter().chain(of.moment.map(|m| m / length)));
    let held = report.actuators.iter().map(|held| match held.unit {
        SiUnit::NEWTON => held.force,
        _ => held.force / length,
    });
    let largest = forces
        .chain(held)
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    [1e-13 * largest, 1e-13 * largest * length]
}

fn without_rounding(value: f64, rounding: f64) -> f64 {
    if value.abs() < rounding { 0.0 } else { value }
}

/// A value with a `*` behind it where it is not unique.
fn starred(value: f64, unit: SiUnit, star: bool) -> Cell {
    match star {
        true => with_unit(&(number(shown(value, unit)) + "*"), unit).into(),
        false => Cell::quantity(value, unit),
    }
}

/// Components of a force and a moment.
pub(super) const EFFORTS: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

/// With columns of a force and a moment; a `*` follows components that are not unique.
fn components<T: Copy>(
    table: TableOf<T>,
    rounding: [f64; 2],
    of: impl Fn(T) -> ([f64; 3], [f64; 3], [bool; 6]),
) -> TableOf<T> {
    (0..).zip(EFFORTS).fold(table, |table, (i, name)| {
        let component = |row| {
            let (force, moment, unique) = of(row);
            let value = if i < 3 { force[i] } else { moment[i - 3] };
            let value = without_rounding(value, rounding[i / 3]);
            starred(value, SiUnit::ONE, !unique[i])
        };
        table
            .numbers(name, component)
            .in_unit(SiUnit::of_effort(i >= 3))
    })
}

fn loads(report: &StaticsReport) -> TableOf<&AppliedWrench> {
    let table = Table::of(&report.loads).words("on", |load| &load.frame);
    components(table, [0.0; 2], |load| (load.force, load.moment, [true; 6]))
}

fn forces(forces: &[Force], rounding: [f64; 2]) -> TableOf<&Force> {
    let clean = move |force: &Force| {
        let is_moment = force.unit != SiUnit::NEWTON;
        without_rounding(force.force, rounding[usize::from(is_moment)])
    };
    let table = Table::of(forces)
        .words("name", |force| &force.name)
        .numbers("force", move |force| {
            starred(clean(force), force.unit, !force.unique)
        });
    // a slide is a cylinder, a coordinate of a platform is none
    let slides = |force: &Force| force.unit == SiUnit::NEWTON && !force.name.contains('.');
    match forces.iter().any(slides) {
        true => table.words("", move |force| match clean(force) {
            _ if !slides(force) => "",
            sense if sense > 0.0 => "pushes",
            sense if sense < 0.0 => "pulls",
            _ => "",
        }),
        false => table,
    }
}

fn reactions(reactions: &[Reaction], length: f64, rounding: [f64; 2]) -> TableOf<&Reaction> {
    let table = Table::of(reactions)
        .words("", |of| match of.variables.is_empty() {
            true => of.name.clone(),
            false => of.variables.join(" "),
        })
        .words("from", |of| &of.from)
        .words("on", |of| &of.on)
        .words("at", |of| {
            let point = of.point.map(|x| without_rounding(x, 1e-9 * length));
            format!("({})", point.map(number).join(", "))
        })
        .in_unit(SiUnit::METRE);
    components(table, rounding, |of| (of.force, of.moment, of.unique))
}
