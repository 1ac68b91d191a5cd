//! The forces in a mechanism as a document.

use super::closing;
use super::document::{Cell, Digits, Document, Table, TableOf};
use super::quantity::{metres, size};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::statics::{AppliedWrench, Force, Reaction, StaticsReport};
use crate::description::{count, listed};

impl Report for StaticsReport {
    fn document(&self) -> Document {
        let length = self.normalising_length;
        let answer = closing::after_moving(self.pose.moved.as_ref(), sentence(self));
        Document::new(&self.mechanism, answer)
            .note(format!(
                "without weight and friction; condition number {}, forces times {} compared with moments",
                size(self.condition),
                metres(length)
            ))
            .notes(closing::notes(&self.pose))
            .table("Loads", loads(self))
            .table("Loads on joints", forces(&self.joint_loads))
            .table("Held, with the force that holds it", forces(&self.actuators))
            .table(
                "Closures, axes of ground, moments about the point given, that of the second frame",
                reactions(&self.closures, length),
            )
            .table(
                "Joints, axes of ground, moments about the point given, the origin of the frame after the joint",
                reactions(&self.joints, length),
            )
    }

    fn is_yes(&self) -> bool {
        self.unbalanced.is_empty()
            && closing::is_about_the_file(&self.pose, self.normalising_length)
    }

    fn warnings(&self) -> Vec<String> {
        Vec::from_iter(closing::outside_limits(&self.pose.outside_limits))
    }
}

fn sentence(report: &StaticsReport) -> String {
    match report.gained {
        0 => balance(report),
        gained => {
            let (freedoms, balance) = (count(gained, "freedom"), balance(report));
            format!("Singular: {freedoms} gained that no held coordinate resists. {balance}")
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
    if report.loads.is_empty() && report.joint_loads.is_empty() {
        return "No load: all forces are zero.".into();
    }
    match report.self_stresses {
        0 => "In equilibrium; all forces are determined.".into(),
        stresses => format!(
            "In equilibrium, but not uniquely: {} without load can be added; values marked * are \
             the minimum-norm choice.",
            count(stresses, "state of stress")
        ),
    }
}

/// With columns of a force and a moment; a `*` stands behind components that are not unique.
fn components<T: Copy>(
    table: TableOf<T>,
    of: impl Fn(T) -> ([f64; 3], [f64; 3], [bool; 6]),
) -> TableOf<T> {
    let names = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];
    (0..).zip(names).fold(table, |table, (i, name)| {
        let component = |row| {
            let (force, moment, unique) = of(row);
            Cell::from(if i < 3 { force[i] } else { moment[i - 3] }).starred(!unique[i])
        };
        table
            .numbers(name, component)
            .in_unit(SiUnit::of_effort(i >= 3))
    })
}

fn loads(report: &StaticsReport) -> TableOf<&AppliedWrench> {
    let table = Table::of(&report.loads).words("on", |load| &load.frame);
    components(table, |load| (load.force, load.moment, [true; 6]))
}

fn forces(forces: &[Force]) -> TableOf<&Force> {
    let table = Table::of(forces)
        .words("name", |force| &force.name)
        .numbers("force", |force| {
            Cell::quantity(force.force, force.unit).starred(!force.unique)
        });
    // a slide is a cylinder, a coordinate of a platform is none
    let slides = |force: &Force| force.unit == SiUnit::NEWTON && !force.name.contains('.');
    match forces.iter().any(slides) {
        true => table.words("", move |force| match force.force {
            _ if !slides(force) => "",
            sense if sense > 0.0 => "pushes",
            sense if sense < 0.0 => "pulls",
            _ => "",
        }),
        false => table,
    }
}

fn reactions(reactions: &[Reaction], length: f64) -> TableOf<&Reaction> {
    let clean = |x: f64| if x.abs() < 1e-9 * length { 0.0 } else { x };
    let table = Table::of(reactions)
        .words("", |of| match of.variables.is_empty() {
            true => of.name.clone(),
            false => of.variables.join(" "),
        })
        .words("from", |of| &of.from)
        .words("on", |of| &of.on)
        .words("at", |of| {
            Cell::vector(of.point.map(clean)).with(Digits::Six)
        })
        .in_unit(SiUnit::METRE);
    components(table, |of| (of.force, of.moment, of.unique))
}
