//! The forces in a mechanism as a document.

use super::closing;
use super::document::{Cell, Column, Digits, Document, Report, Section, Table, cells};
use super::quantity::{number, size};
use crate::analysis::statics::{Force, Reaction, StaticsReport};
use crate::description::{count, listed};

impl Report for StaticsReport {
    fn document(&self) -> Document {
        let gap = (self.given_gap.as_ref()).map(|gap| closing::given(gap, self.kept));
        let loads = Section::new("Loads, at the frame's origin").table(loads(self));
        let on_joints = Section::new("Loads on joints").table(forces(&self.joint_loads));
        let held =
            Section::new("Held, with the force that holds it").table(forces(&self.actuators));
        let closures = Section::new(
            "Closures, axes of ground, moments about the point given, that of the second frame",
        );
        let joints = Section::new(
            "Joints, axes of ground, moments about the point given, the origin of the frame after the joint",
        );
        let length = self.normalising_length;
        let answer = closing::after_moving(self.moved.as_ref(), sentence(self));
        Document::new(&self.mechanism, answer)
            .note(format!(
                "without weight and friction; condition number {}, forces times {} m compared with moments",
                size(self.condition),
                number(length)
            ))
            .notes(gap)
            .notes(closing::beside(self.moved.as_ref()))
            .sections([loads, on_joints, held])
            .section(closures.table(reactions(&self.closures, length)))
            .section(joints.table(reactions(&self.joints, length)))
    }
}

/// The answer in one or two sentences.
fn sentence(report: &StaticsReport) -> String {
    match report.gained {
        0 => balance(report),
        gained => format!(
            "Singular: {} gained that no held coordinate resists. {}",
            count(gained, "freedom"),
            balance(report)
        ),
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

/// The components of forces and moments.
const COMPONENTS: [(&str, &str); 6] = [
    ("Fx", "N"),
    ("Fy", "N"),
    ("Fz", "N"),
    ("Mx", "N·m"),
    ("My", "N·m"),
    ("Mz", "N·m"),
];

fn components() -> impl Iterator<Item = Column> {
    COMPONENTS
        .map(|(name, unit)| Column::numbers(name).in_unit(unit))
        .into_iter()
}

fn loads(report: &StaticsReport) -> Table {
    let mut table = Table::new([Column::words("on")].into_iter().chain(components()));
    for load in &report.loads {
        let values = load.force.iter().chain(&load.moment);
        let values = values.map(|&value| Cell::number(value));
        table.row(
            [Cell::from(&load.frame)]
                .into_iter()
                .chain(values)
                .collect(),
        );
    }
    table
}

fn mark(unique: bool) -> &'static str {
    if unique { "" } else { "*" }
}

fn forces(forces: &[Force]) -> Table {
    let mut table = Table::new([Column::words("name"), Column::numbers("force")]);
    for force in forces {
        let value = Cell::quantity(force.force, force.unit).marked(mark(force.unique));
        table.row(cells![&force.name, value]);
    }
    table
}

fn reactions(reactions: &[Reaction], length: f64) -> Table {
    let names = ["", "from", "on"].map(Column::words).into_iter();
    let point = Column::words("at").in_unit("m");
    let mut table = Table::new(names.chain([point]).chain(components()));
    for reaction in reactions {
        let name = match reaction.variables.is_empty() {
            true => reaction.name.clone(),
            false => reaction.variables.join(" "),
        };
        let clean = |x: f64| if x.abs() < 1e-9 * length { 0.0 } else { x };
        let point = Cell::vector(reaction.point.map(clean)).with(Digits::Six);
        let mut row = cells![name, &reaction.from, &reaction.on, point];
        let values = reaction.force.iter().chain(&reaction.moment);
        let values = values.zip(reaction.unique);
        row.extend(values.map(|(&value, unique)| Cell::number(value).marked(mark(unique))));
        table.row(row);
    }
    table
}
