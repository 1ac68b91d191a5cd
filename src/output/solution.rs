//! An assembled configuration, or why there is none, as a document.

use super::closing;
use super::document::{Cell, Column, Document, Report, Section, Table, cells};
use super::quantity::{degrees, number, quantity, size};
use crate::algebra::SiUnit;
use crate::analysis::assembly::{AssemblyReport, Outcome, PlatformRecord};
use crate::description::{count, listed};

impl Report for AssemblyReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        let platforms = self.platforms.0.iter();
        let platforms = platforms.map(|(name, platform)| pose(name, platform));
        let gaps = (!self.is_assembled()).then(|| Section::new("Gaps").table(gaps(self)));
        Document::new(&self.mechanism, sentence(self))
            .interrupted(self.interrupted, "other starts")
            .notes(idle(self))
            .notes(others(self))
            .section(Section::new("Joints").table(joints(self)))
            .sections(platforms)
            .section(Section::new("Tips of chains").table(tips(self)))
            .sections(gaps)
            .method(found(self))
    }
}

/// How the search ended, in one sentence.
fn sentence(report: &AssemblyReport) -> String {
    let gap = |closure: &str| match report.gaps.get(closure) {
        Some(gap) => closing::gap(gap.distance, gap.angle),
        None => "0 m".into(),
    };
    match &report.outcome {
        Outcome::Converged => "Assembled.".into(),
        Outcome::ConvergedOutsideLimits { joints } => {
            let are = match joints.len() {
                1 => "is outside its limits",
                _ => "are outside their limits",
            };
            format!("Assembled, but {} {are}.", listed(joints))
        }
        Outcome::Singular {
            moving,
            closure,
            powerless,
        } => {
            let mut text = format!(
                "Assembled at a singular configuration: {} can still move although all inputs are \
                 held",
                listed(moving)
            );
            if let Some(name) = closure {
                text += &format!("; equations of closure {name} depend on the others");
            }
            if !powerless.is_empty() {
                text += &format!("; {} cannot drive the mechanism there", listed(powerless));
            }
            text + "."
        }
        Outcome::CannotBeAssembled {
            worst,
            local_minimum,
        } => {
            let minimum = match local_minimum {
                true => ", and no small motion reduces the gap",
                false => "",
            };
            format!(
                "Cannot be assembled with these inputs: at the closest approach closure {worst} is \
                 open by {}{minimum}.",
                gap(worst)
            )
        }
        Outcome::GaveUp { worst } => format!(
            "No assembled configuration was found, nor a closest approach; the best attempt leaves \
             closure {worst} open by {}.",
            gap(worst)
        ),
    }
}

/// Freedoms that do not matter.
fn idle(report: &AssemblyReport) -> Option<String> {
    let turn = match report.idle {
        0 => return None,
        1 => "only spins a link about its own line",
        _ => "only spin links about their own lines",
    };
    Some(format!("{} {turn}", count(report.idle, "freedom")))
}

/// What is not known of other configurations with the same inputs.
fn others(report: &AssemblyReport) -> Option<String> {
    let solved = report.variables.iter().any(|joint| !joint.held);
    let may_differ = report.is_assembled() && solved && !report.gaps.is_empty();
    let another = match report.restarts {
        0 => "other assemblies with the same inputs were not looked for",
        _ => {
            "reached from a random start: another seed may lead to another assembly with the \
             same inputs"
        }
    };
    may_differ.then(|| format!("{another}; `linkwork assemblies` lists all of them"))
}

fn found(report: &AssemblyReport) -> String {
    let restarts = match report.restarts {
        0 => String::new(),
        n => format!(
            ", after {} with seed {}",
            count(n, "random start"),
            report.seed
        ),
    };
    let rods = match report.squared_lengths {
        true => format!("; {}", closing::SQUARED_LENGTHS),
        false => String::new(),
    };
    format!(
        "{}{restarts}; residual {}, condition number {}{rods}",
        count(report.steps, "Newton step"),
        size(report.residual),
        size(report.condition)
    )
}

fn joints(report: &AssemblyReport) -> Table {
    let mut table = Table::new([
        Column::words("name"),
        Column::words("role"),
        Column::words(""),
        Column::numbers("value"),
        Column::numbers(""),
        Column::words("limits"),
    ]);
    for (joint, &value) in report.variables.iter().zip(report.joints.values()) {
        let is_angle = joint.unit.is_angle();
        let radians = is_angle.then(|| format!("{} rad", number(value)));
        let limits = joint.limits.map(|(low, high)| {
            let [low, high] = [low, high].map(|limit| quantity(limit, is_angle));
            let outside = if joint.within_limits { "" } else { ", outside" };
            format!("{low} to {high}{outside}")
        });
        table.row(cells![
            &joint.name,
            joint.role.word().to_lowercase(),
            if joint.held { "held" } else { "solved" },
            Cell::quantity(value, joint.unit),
            radians,
            limits
        ]);
    }
    table
}

/// Position and orientation of a platform in ground.
fn pose(name: &str, platform: &PlatformRecord) -> Section {
    let frame = &platform.frame;
    let columns = ["position", "n", "s", "a"].map(Column::numbers);
    let mut table = Table::new([Column::words("")].into_iter().chain(columns));
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let [n, s, a] = frame.rotation[i];
        let position = Cell::quantity(frame.position[i], SiUnit::METRE);
        table.row(cells![axis, position, n, s, a]);
    }
    let [w, x, y, z] = frame.quaternion.map(number);
    let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
    Section::new(format!("Platform {name}")).table(table).list([
        format!("quaternion w {w}, x {x}, y {y}, z {z}"),
        format!("roll {roll}, pitch {pitch}, yaw {yaw}, with R = Rz(yaw) Ry(pitch) Rx(roll)"),
    ])
}

fn tips(report: &AssemblyReport) -> Table {
    let columns = ["x", "y", "z"].map(Column::numbers);
    let mut table = Table::new([Column::words("chain")].into_iter().chain(columns));
    for (chain, tip) in &report.frames.0 {
        let [x, y, z] = tip.position.map(|x| Cell::quantity(x, SiUnit::METRE));
        table.row(cells![chain, x, y, z]);
    }
    table
}

fn gaps(report: &AssemblyReport) -> Table {
    let mut table = Table::new([
        Column::words("closure"),
        Column::numbers("distance"),
        Column::numbers("angle"),
    ]);
    for (closure, gap) in &report.gaps.0 {
        let distance = Cell::quantity(gap.distance, SiUnit::METRE);
        let angle = Cell::quantity(gap.angle, SiUnit::RADIAN);
        table.row(cells![closure, distance, angle]);
    }
    table
}
