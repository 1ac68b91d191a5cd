//! An assembled configuration, or why there is none.

use std::fmt::Write;

use serde::Serialize;

use super::closing;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{degrees, number, quantity, size};
use crate::analysis::assembly::{AssemblyReport, Outcome, PlatformRecord};
use crate::description::{count, listed};

/// The report as JSON: the fields of [`AssemblyReport`] with the outcome in a sentence.
pub fn json(report: &AssemblyReport) -> String {
    #[derive(Serialize)]
    struct SolutionJson<'a> {
        sentence: String,
        #[serde(flatten)]
        report: &'a AssemblyReport,
    }
    let sentence = sentence(report);
    document(&report.mechanism, &SolutionJson { sentence, report })
}

/// The report as text.
pub fn text(report: &AssemblyReport) -> String {
    let mut sections = vec![heading(report)];
    if !report.joints.is_empty() {
        sections.push(joints(report));
    }
    for (name, platform) in &report.platforms.0 {
        sections.push(format!("Platform {name}\n{}", pose(platform)));
    }
    if !report.frames.is_empty() {
        sections.push(tips(report));
    }
    if !report.is_assembled() {
        sections.push(gaps(report));
    }
    sections.join("\n")
}

/// How the search ended, in one sentence.
pub fn sentence(report: &AssemblyReport) -> String {
    let gap = |closure: &str| match report.gaps.get(closure) {
        Some(gap) => closing::gap(gap.distance, gap.angle),
        None => "0".into(),
    };
    match &report.outcome {
        Outcome::Converged => "Assembled.".into(),
        Outcome::ConvergedOutsideLimits { joints } => {
            format!("Assembled, but outside the limits of {}.", listed(joints))
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
            if let Some(name) = dependent {
                let _ = write!(text, "; equations of closure {name} depend on the others");
            }
            if !powerless.is_empty() {
                let _ = write!(text, "; {} cannot drive it there", listed(powerless));
            }
            text + "."
        }
        Outcome::CannotBeAssembled {
            worst,
            local_minimum,
        } => {
            let minimum = match local_minimum {
                true => ", and no small motion comes closer",
                false => "",
            };
            let gap = gap(worst);
            format!(
                "Cannot be assembled with these inputs: at the closest approach closure {worst} \
                 gapes by {gap}{minimum}."
            )
        }
        Outcome::GaveUp { worst } => {
            let gap = gap(worst);
            format!(
                "Gave up: no start led to an assembled configuration or to a closest approach; \
                 the best found leaves closure {worst} open by {gap}."
            )
        }
    }
}

fn heading(report: &AssemblyReport) -> String {
    let mut text = format!("{}\n{}\n", report.mechanism, sentence(report));
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

fn joints(report: &AssemblyReport) -> String {
    let mut table = plain(["name", "role", "", "value", "", "limits"]);
    for (joint, &value) in report.variables.iter().zip(report.joints.values()) {
        let is_angle = joint.unit.is_angle();
        let radians = match is_angle {
            true => format!("{} rad", number(value)),
            false => String::new(),
        };
        let limits = match joint.limits {
            None => String::new(),
            Some((low, high)) => {
                let [low, high] = [low, high].map(|limit| quantity(limit, is_angle));
                let outside = if joint.within_limits { "" } else { ", outside" };
                format!("{low} to {high}{outside}")
            }
        };
        table.add_row([
            joint.name.as_str(),
            &joint.role.word().to_lowercase(),
            if joint.held { "held" } else { "solved" },
            &quantity(value, is_angle),
            &radians,
            &limits,
        ]);
    }
    align_right(&mut table, [3, 4]);
    format!("Joints\n{}", indented(&table.to_string()))
}

/// Position and orientation of a platform in ground.
fn pose(platform: &PlatformRecord) -> String {
    let frame = &platform.frame;
    let mut table = plain(["", "position", "n", "s", "a"]);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let position = format!("{} m", number(frame.position[i]));
        let [n, s, a] = frame.rotation[i].map(number);
        table.add_row([axis, &position, &n, &s, &a]);
    }
    align_right(&mut table, 1..5);
    let [w, x, y, z] = frame.quaternion.map(number);
    let [roll, pitch, yaw] = platform.roll_pitch_yaw.map(degrees);
    let rest = format!(
        "quaternion w {w}, x {x}, y {y}, z {z}\n\
         roll {roll}, pitch {pitch}, yaw {yaw}, with R = Rz(yaw) Ry(pitch) Rx(roll)\n"
    );
    indented(&format!("{table}\n{rest}"))
}

fn tips(report: &AssemblyReport) -> String {
    let mut table = plain(["chain", "x", "y", "z"]);
    for (chain, tip) in &report.frames.0 {
        let [x, y, z] = tip.position.map(|value| quantity(value, false));
        table.add_row([chain, &x, &y, &z]);
    }
    align_right(&mut table, 1..4);
    format!("Tips of chains\n{}", indented(&table.to_string()))
}

fn gaps(report: &AssemblyReport) -> String {
    let mut table = plain(["closure", "distance", "angle"]);
    for (closure, gap) in &report.gaps.0 {
        let (distance, angle) = (quantity(gap.distance, false), degrees(gap.angle));
        table.add_row([closure, &distance, &angle]);
    }
    align_right(&mut table, [1, 2]);
    format!("Gaps\n{}", indented(&table.to_string()))
}
