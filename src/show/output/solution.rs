//! An assembled configuration, or why there is none, as a document.

use super::assembly_remarks;
use super::document::{Cell, Document, Section, Table, TableOf};
use super::quantity::{clause, degrees, form, number, quantity, size};
use super::report::Report;
use crate::algebra::SiUnit;
use crate::analysis::assembly::{AssemblyReport, JointVariable, Outcome, PlatformRecord};
use crate::description::{count, listed};
use crate::system::{FrameRecord, Gap};

impl Report for AssemblyReport {
    fn document(&self) -> Document {
        let platforms = self.platforms.0.iter();
        let platforms = platforms.map(|(name, platform)| pose(name, platform));
        let gaps = (!self.is_assembled()).then(|| Section::new("Gaps").table(gaps(self)));
        Document::new(&self.mechanism, sentence(self))
            .yes_if(self.outcome == Outcome::Converged)
            .warnings(self.warning())
            .notes(self.moved.as_ref().map(assembly_remarks::from_start))
            .interrupted(self.interrupted, "other starts")
            .notes(redundant(self))
            .notes(left(self))
            .notes(idle(self))
            .notes(others(self))
            .table("Joints", joints(self))
            .table("Outputs", outputs(self))
            .sections(platforms)
            .table("Frames", tips(self))
            .sections(gaps)
            .method(found(self))
    }
}

fn sentence(report: &AssemblyReport) -> String {
    let gap = |closure: &str| match report.gaps.get(closure) {
        Some(gap) => assembly_remarks::gap(gap.distance, gap.angle),
        None => "0 m".into(),
    };
    match &report.outcome {
        Outcome::Converged => match &report.left {
            None => "Assembled.".into(),
            Some(left) if report.restarts > 0 => format!(
                "Assembled from a random start, with {} left undetermined.",
                count(left.freedoms, "freedom")
            ),
            Some(left) => format!(
                "Assembled as near to the start as possible; {} that nothing holds {} left open.",
                count(left.freedoms, "freedom"),
                form(left.freedoms, "was", "were")
            ),
        },
        Outcome::ConvergedOutsideLimits { joints } => {
            let outside = assembly_remarks::outside_limits(joints).unwrap_or_default();
            format!("Assembled, but {outside}.")
        }
        Outcome::Singular {
            moving,
            closure,
            powerless,
        } => {
            let mut text = format!(
                "Assembled at a singular configuration: to first order {} can still move although all \
                 inputs are held",
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
        Outcome::CannotBeAssembled { worst, .. } if is_fixed(report) => format!(
            "Cannot be assembled with these inputs: nothing is free, and closure {worst} is open by {}.",
            gap(worst)
        ),
        Outcome::CannotBeAssembled {
            worst,
            local_minimum,
        } => format!(
            "Cannot be assembled with these inputs: at the closest approach closure {worst} is \
             open by {}{}.",
            gap(worst),
            match local_minimum {
                true => ", and no small motion reduces the gap",
                false => "",
            }
        ),
        Outcome::GaveUp { worst } => format!(
            "No assembled configuration was found, nor a closest approach; the best attempt leaves \
             closure {worst} open by {}.",
            gap(worst)
        ),
    }
}

/// True if everything is held.
fn is_fixed(report: &AssemblyReport) -> bool {
    let mut platforms = report.platforms.0.iter();
    !any_solved(report) && platforms.all(|(name, _)| report.held.contains(name))
}

/// True if a joint variable is not held. Joints at which loops are cut follow from the others.
fn any_solved(report: &AssemblyReport) -> bool {
    let mut free = report.variables.iter().filter(|joint| !joint.held);
    free.any(|joint| !report.cut.contains(&joint.name))
}

/// Held coordinates that the others determine.
fn redundant(report: &AssemblyReport) -> Option<String> {
    let names = &report.redundant;
    (!names.is_empty()).then(|| {
        format!(
            "the held values agree: {} where the others put {}",
            clause(names, "stands", "stand"),
            form(
                names.len(),
                "it, and is redundant",
                "them, and are redundant"
            ),
        )
    })
}

/// Freedoms that no held coordinate decides, and coordinates that would.
fn left(report: &AssemblyReport) -> Vec<String> {
    let Some(left) = &report.left else {
        return vec![];
    };
    let held = match &report.held[..] {
        [] => "nothing is held".into(),
        held => format!("only {} held", clause(held, "is", "are")),
    };
    let rest = listed(&left.hold);
    let mut notes = vec![format!("{held}; {rest} would determine the rest")];
    if left.singular > 0 {
        notes.push(format!(
            "the configuration is singular: to first order {} more can move",
            count(left.singular, "freedom")
        ));
    }
    notes
}

/// Freedoms that do not matter.
fn idle(report: &AssemblyReport) -> Option<String> {
    let spin = form(
        report.idle,
        "only spins a link about its own line",
        "only spin links about their own lines",
    );
    (report.idle > 0).then(|| format!("{} {spin}", count(report.idle, "freedom")))
}

/// Remark on other configurations with the same inputs, as far as they are not known.
fn others(report: &AssemblyReport) -> Option<String> {
    let solved = any_solved(report) || !report.platforms.0.is_empty();
    let decided = report.is_assembled() && report.left.is_none();
    let may_differ = decided && solved && !report.gaps.is_empty();
    let another = match report.restarts {
        0 => "other assemblies with the same inputs were not searched for",
        _ => {
            "reached from a random start: another seed may lead to another assembly with the \
             same inputs"
        }
    };
    may_differ.then(|| format!("{another}; `linkwork assemblies` lists all of them"))
}

fn found(report: &AssemblyReport) -> String {
    if is_fixed(report) {
        return format!("nothing was solved; residual {}", size(report.residual));
    }
    let restarts = match report.restarts {
        0 => String::new(),
        n => {
            let starts = count(n, "random start");
            format!(", after {starts} with seed {}", report.seed)
        }
    };
    let rods = (report.squared_lengths).then(|| format!("; {}", assembly_remarks::SQUARED_LENGTHS));
    format!(
        "{}{restarts}; residual {}, condition number {}{}",
        count(report.steps, "Newton step"),
        size(report.residual),
        size(report.condition),
        rods.unwrap_or_default()
    )
}

fn joints(report: &AssemblyReport) -> TableOf<(&JointVariable, f64)> {
    type JointRow<'a> = (&'a JointVariable, f64);
    let limits = |(of, _): JointRow| {
        let (low, high) = of.limits?;
        let outside = if of.within_limits { "" } else { ", outside" };
        let [low, high] = [low, high].map(|limit| quantity(limit, of.unit));
        Some(format!("{low} to {high}{outside}"))
    };
    let joints = report.variables.iter();
    let table = Table::of(joints.zip(report.joints.values().copied()))
        .words("name", |(of, _)| &of.name)
        .words("role", |(of, _)| of.role.word().to_lowercase())
        .words("", |(of, _)| if of.held { "held" } else { "solved" });
    values(table, |(of, value)| (value, of.unit)).words("limits", limits)
}

/// Outputs that depend on joints alone.
fn outputs(report: &AssemblyReport) -> Table {
    let outputs = report.outputs.0.iter().zip(&report.output_units);
    let table = Table::of(outputs.map(|((name, value), unit)| (name, *value, *unit)));
    values(
        table.words("name", |(name, ..)| name),
        |(_, value, unit)| (value, unit),
    )
    .into()
}

/// With a quantity, also in rad if it is an angle.
fn values<T: Copy>(table: TableOf<T>, of: impl Fn(T) -> (f64, SiUnit)) -> TableOf<T> {
    let radians =
        |(value, unit): (f64, SiUnit)| unit.is_angle().then(|| format!("{} rad", number(value)));
    table
        .numbers("value", |row| Cell::quantity(of(row).0, of(row).1))
        .numbers("", |row| radians(of(row)))
}

fn pose(name: &str, platform: &PlatformRecord) -> Section {
    let frame = &platform.frame;
    let table = Table::of(0..3)
        .words("", |i: usize| ["x", "y", "z"][i])
        .numbers("position", |i| Cell::metres(frame.position[i]))
        .each(["n", "s", "a"], |i, j| frame.rotation[i][j]);
    let [w, x, y, z] = frame.quaternion.map(number);
    let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
    Section::new(format!("Platform {name}")).table(table).list([
        format!("quaternion w {w}, x {x}, y {y}, z {z}"),
        format!("roll {roll}, pitch {pitch}, yaw {yaw}, with R = Rz(yaw) Ry(pitch) Rx(roll)"),
    ])
}

fn tips(report: &AssemblyReport) -> TableOf<&(String, FrameRecord)> {
    Table::of(&report.frames.0)
        .words("frame", |(frame, _)| frame)
        .each(["x", "y", "z"], |(_, tip), i| Cell::metres(tip.position[i]))
}

fn gaps(report: &AssemblyReport) -> TableOf<&(String, Gap)> {
    Table::of(&report.gaps.0)
        .words("closure", |(closure, _)| closure)
        .numbers("distance", |(_, gap)| Cell::metres(gap.distance))
        .numbers("angle", |(_, gap)| Cell::radians(gap.angle))
}
