//! An assembled configuration, or why there is none.

mod json;

pub use json::{FrameJson, GapJson, PlatformJson, SolutionJson, json};

use std::fmt::Write;

use super::closing;
use super::layout::{align_right, indented, plain};
use super::quantity::{degrees, number, quantity, size};
use crate::analysis::assembly::{AssemblyReport, Outcome};
use crate::description::{count, listed};
use crate::geometry::{Pose, Quaternion, RollPitchYaw};
use crate::mechanism::{Frame, Mechanism};
use crate::system::Question;

/// The report as text.
pub fn text(question: &Question, report: &AssemblyReport) -> String {
    let mechanism = question.mechanism();
    let mut sections = vec![heading(mechanism, report)];
    if !mechanism.joints().is_empty() {
        sections.push(joints(question, report));
    }
    for (i, platform) in mechanism.platforms().iter().enumerate() {
        let title = format!("Platform {}", platform.name);
        sections.push(title + "\n" + &pose(&report.configuration.platforms[i].pose()));
    }
    if !mechanism.chains().is_empty() {
        sections.push(tips(mechanism, report));
    }
    if !is_assembled(&report.outcome) {
        sections.push(gaps(mechanism, report));
    }
    sections.join("\n")
}

/// Whether the configuration closes every loop.
fn is_assembled(outcome: &Outcome) -> bool {
    !matches!(
        outcome,
        Outcome::CannotBeAssembled { .. } | Outcome::GaveUp { .. }
    )
}

/// How the search ended, in one sentence.
pub fn sentence(mechanism: &Mechanism, report: &AssemblyReport) -> String {
    let joint = |i: &usize| mechanism.joints()[*i].name.as_str();
    let closure = |i: usize| mechanism.closures()[i].name.as_str();
    let gap = |i: usize| closing::gap(report.gaps[i].distance, report.gaps[i].angle);
    match &report.outcome {
        Outcome::Converged => "Assembled.".into(),
        Outcome::ConvergedOutsideLimits { joints } => {
            let names: Vec<&str> = joints.iter().map(joint).collect();
            format!("Assembled, but outside the limits of {}.", listed(&names))
        }
        Outcome::Singular {
            moving,
            closure: dependent,
            powerless,
        } => {
            let mut text = format!(
                "Assembled at a singular configuration: {} can still move although all inputs are \
                 held",
                listed(moving)
            );
            if !mechanism.closures().is_empty() {
                let name = closure(*dependent);
                let _ = write!(text, "; equations of closure {name} depend on the others");
            }
            let powerless: Vec<&str> = powerless.iter().map(joint).collect();
            if !powerless.is_empty() {
                let _ = write!(text, "; {} cannot drive it there", listed(&powerless));
            }
            text + "."
        }
        Outcome::CannotBeAssembled {
            worst,
            local_minimum,
        } => {
            let name = closure(*worst);
            let minimum = match local_minimum {
                true => ", and no small motion comes closer",
                false => "",
            };
            let gap = gap(*worst);
            format!(
                "Cannot be assembled with these inputs: at the closest approach closure {name} \
                 gapes by {gap}{minimum}."
            )
        }
        Outcome::GaveUp { worst } => {
            let (name, gap) = (closure(*worst), gap(*worst));
            format!(
                "Gave up: no start led to an assembled configuration or to a closest approach; \
                 the best found leaves closure {name} open by {gap}."
            )
        }
    }
}

/// What is worth a warning about the answer.
pub fn warnings(report: &AssemblyReport) -> Vec<String> {
    let mut warnings = Vec::new();
    if report.near_singular && !matches!(report.outcome, Outcome::Singular { .. }) {
        warnings.push(format!(
            "near a singular configuration: the condition number is {}",
            size(report.condition)
        ));
    }
    warnings
}

fn heading(mechanism: &Mechanism, report: &AssemblyReport) -> String {
    let mut text = format!("{}\n{}\n", mechanism.name(), sentence(mechanism, report));
    let _ = write!(
        text,
        "  {}, residual {}, condition number {}",
        count(report.steps, "step"),
        size(report.residual),
        size(report.condition)
    );
    if report.restarts > 0 {
        let restarts = count(report.restarts, "random start");
        let _ = write!(text, ", {restarts} with seed {}", report.seed);
    }
    text.push('\n');
    if report.idle > 0 {
        let idle = count(report.idle, "freedom");
        let turn = if report.idle == 1 { "turns" } else { "turn" };
        let _ = writeln!(
            text,
            "  {idle} that only {turn} links about their own lines"
        );
    }
    text
}

fn joints(question: &Question, report: &AssemblyReport) -> String {
    let mechanism = question.mechanism();
    let held = question.held();
    let mut table = plain(["name", "role", "", "value", "", "limits"]);
    for (i, joint) in mechanism.joints().iter().enumerate() {
        let value = report.configuration.joints[i];
        let is_angle = joint.kind.is_angle();
        let radians = match is_angle {
            true => format!("{} rad", number(value)),
            false => String::new(),
        };
        let limits = match joint.limits {
            None => String::new(),
            Some((low, high)) => {
                let [low, high] = [low, high].map(|limit| quantity(limit, is_angle));
                let outside = if joint.allows(value) { "" } else { ", outside" };
                format!("{low} to {high}{outside}")
            }
        };
        table.add_row([
            joint.name.as_str(),
            &joint.role.word().to_lowercase(),
            if held.joints[i] { "held" } else { "solved" },
            &quantity(value, is_angle),
            &radians,
            &limits,
        ]);
    }
    align_right(&mut table, [3, 4]);
    format!("Joints\n{}", indented(&table.to_string()))
}

/// Position and orientation of a platform in ground.
fn pose(pose: &Pose<f64>) -> String {
    let [n, s, a] = pose.rotation.0;
    let mut table = plain(["", "position", "n", "s", "a"]);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let numbers = [pose.position, n, s, a].map(|column| number(column.0[i]));
        let [position, n, s, a] = &numbers;
        let position = format!("{position} m");
        table.add_row([axis, &position, n, s, a]);
    }
    align_right(&mut table, 1..5);
    let [w, x, y, z] = Quaternion::from_rotation(&pose.rotation)
        .canonical()
        .0
        .map(number);
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    let [roll, pitch, yaw] = [roll, pitch, yaw].map(degrees);
    let rest = format!(
        "quaternion w {w}, x {x}, y {y}, z {z}\n\
         roll {roll}, pitch {pitch}, yaw {yaw}, with R = Rz(yaw) Ry(pitch) Rx(roll)\n"
    );
    indented(&format!("{table}\n{rest}"))
}

fn tips(mechanism: &Mechanism, report: &AssemblyReport) -> String {
    let mut table = plain(["chain", "x", "y", "z"]);
    for (chain, part) in mechanism.chains().iter().enumerate() {
        let tip = mechanism.transform(Frame::Ground, Frame::Tip { chain }, &report.configuration);
        let [x, y, z] = tip.position.0.map(|value| quantity(value, false));
        table.add_row([&part.name, &x, &y, &z]);
    }
    align_right(&mut table, 1..4);
    format!("Tips of chains\n{}", indented(&table.to_string()))
}

fn gaps(mechanism: &Mechanism, report: &AssemblyReport) -> String {
    let mut table = plain(["closure", "distance", "angle"]);
    for (closure, gap) in mechanism.closures().iter().zip(&report.gaps) {
        let (distance, angle) = (quantity(gap.distance, false), degrees(gap.angle));
        table.add_row([&closure.name, &distance, &angle]);
    }
    align_right(&mut table, [1, 2]);
    format!("Gaps\n{}", indented(&table.to_string()))
}
