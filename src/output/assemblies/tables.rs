//! Tables of assemblies.

use std::fmt::Write;

use comfy_table::{Table, presets};

use super::super::layout::{align_right, indented};
use super::super::quantity::{degrees, number, quantity, size};
use crate::analysis::assemblies::{AssembliesReport, Assembly, ComplexAssembly, ListedJoint};
use crate::description::listed;

/// Columns of joint values that stand beside each other.
const ABREAST: usize = 8;

pub(super) fn times(multiplicity: usize) -> String {
    match multiplicity {
        2 => "double".into(),
        n => format!("{n}-fold"),
    }
}

fn table(header: &[String]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).add_row(header);
    if let Some(first) = table.column_mut(0) {
        first.set_padding((0, 1));
    }
    table
}

pub(super) fn overview(report: &AssembliesReport) -> String {
    let header = ["mode", "condition", "side", "limits", "certificate", ""];
    let mut table = table(&header.map(String::from));
    for a in &report.assemblies {
        let certificate = match (a.radius, a.multiplicity) {
            (Some(radius), _) => format!("unique within {radius:.1e}"),
            (None, 0) if a.dimension > 0 => {
                format!("none: a sample of a set of dimension {}", a.dimension)
            }
            (None, 0) => "none: a sample".into(),
            (None, 1) => "none".into(),
            (None, n) => format!("none: {}", times(n)),
        };
        let shared: Vec<String> = a
            .shares_platform_pose_with
            .iter()
            .map(usize::to_string)
            .collect();
        table.add_row([
            a.mode.to_string(),
            a.condition.map_or("infinite".into(), size),
            match a.determinant_sign {
                1 => "+",
                -1 => "-",
                _ => "0",
            }
            .into(),
            match a.outside_limits.is_empty() {
                true => "within".into(),
                false => format!("outside: {}", listed(&a.outside_limits)),
            },
            certificate,
            match shared.is_empty() {
                true => String::new(),
                false => format!("same platform pose as {}", listed(&shared)),
            },
        ]);
    }
    align_right(&mut table, [0, 1]);
    format!("Assemblies\n{}", indented(&table.to_string()))
}

/// Values of the joints that are not held.
pub(super) fn joints(report: &AssembliesReport) -> Vec<String> {
    let variables = report.variables.iter().enumerate();
    let free: Vec<(usize, &ListedJoint)> = variables.filter(|(_, joint)| !joint.held).collect();
    let blocks = free.chunks(ABREAST).enumerate();
    let blocks = blocks.map(|(block, free)| {
        let names = free.iter().map(|(_, joint)| joint.name.clone());
        let header: Vec<String> = std::iter::once("mode".into()).chain(names).collect();
        let mut table = table(&header);
        for a in &report.assemblies {
            let values = free.iter().map(|&(j, joint)| {
                let angle = joint.unit.is_angle();
                let text = quantity(settled(a.joints.0[j].1, report, angle), angle);
                // −180° may be within limits where 180° is not
                if joint.periodic { once(text) } else { text }
            });
            table.add_row(std::iter::once(a.mode.to_string()).chain(values));
        }
        align_right(&mut table, 0..header.len());
        let title = if block == 0 {
            "Joints"
        } else {
            "Further joints"
        };
        format!("{title}\n{}", indented(&table.to_string()))
    });
    blocks.collect()
}

/// Poses of the platforms that are not held.
pub(super) fn platforms(report: &AssembliesReport) -> Vec<String> {
    let Some(first) = report.assemblies.first() else {
        return Vec::new();
    };
    let parts = first.platforms.0.iter().enumerate();
    let parts = parts.filter(|(_, (name, _))| !report.held_platforms.contains(name));
    let parts = parts.map(|(p, (name, _))| {
        let header = ["mode", "x", "y", "z", "roll", "pitch", "yaw"];
        let mut table = table(&header.map(String::from));
        for a in &report.assemblies {
            let (_, pose) = &a.platforms.0[p];
            let position = (pose.position).map(|x| quantity(settled(x, report, false), false));
            let angles = (pose.roll_pitch_yaw).map(|x| once(degrees(settled(x, report, true))));
            table.add_row(
                std::iter::once(a.mode.to_string())
                    .chain(position)
                    .chain(angles),
            );
        }
        align_right(&mut table, 0..7);
        format!("Platform {name}\n{}", indented(&table.to_string()))
    });
    parts.collect()
}

/// Why assemblies are not certified, each reason once.
pub(super) fn reasons(report: &AssembliesReport) -> Option<String> {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for Assembly {
        mode,
        uncertified_because,
        ..
    } in &report.assemblies
    {
        let Some(reason) = uncertified_because else {
            continue;
        };
        match reasons.iter_mut().find(|(r, _)| r == reason) {
            Some((_, modes)) => modes.push(mode.to_string()),
            None => reasons.push((reason, vec![mode.to_string()])),
        }
    }
    let lines = reasons
        .iter()
        .map(|(reason, modes)| format!("{}: {reason}\n", listed(modes)));
    let lines = lines.collect::<String>();
    (!lines.is_empty()).then(|| format!("Not certified\n{}", indented(&lines)))
}

pub(super) fn complex(report: &AssembliesReport) -> String {
    let mut text = String::from("Complex solutions that are not real\n");
    for (
        i,
        ComplexAssembly {
            joints,
            platforms,
            multiplicity,
            condition,
        },
    ) in report.complex_assemblies.iter().enumerate()
    {
        let multiple = match multiplicity {
            1 => String::new(),
            n => format!(", {}", times(*n)),
        };
        let condition = condition.map_or("infinite".into(), size);
        let _ = writeln!(text, "  {}{multiple}, condition {condition}", i + 1);
        for ((name, [re, im]), joint) in joints.0.iter().zip(&report.variables) {
            let angle = joint.unit.is_angle();
            let [re, im] = [re, im].map(|x| settled(*x, report, angle));
            let (re, im) = match angle {
                true => (re.to_degrees(), im.to_degrees()),
                false => (re, im),
            };
            let unit = if angle { "°" } else { " m" };
            let _ = writeln!(text, "    {name} = {}{unit}", complex_number(re, im));
        }
        for (name, numbers) in &platforms.0 {
            let parts = numbers.iter().enumerate().map(|(i, parts)| {
                // three lengths, then the quaternion
                let [re, im] = parts.map(|x| settled(x, report, i >= 3));
                complex_number(re, im)
            });
            let parts: Vec<String> = parts.collect();
            let (position, quaternion) = parts.split_at(3.min(parts.len()));
            let _ = writeln!(
                text,
                "    {name}: position {} m, quaternion {}",
                position.join(", "),
                quaternion.join(", ")
            );
        }
    }
    text
}

/// What is left of a zero after rounding is a zero: solutions are good to some 1e-12 rad or
/// characteristic lengths, and what rounding leaves differs from one way to them to another.
fn settled(value: f64, report: &AssembliesReport, angle: bool) -> f64 {
    const ROUNDING: f64 = 1e-10;
    let unit = if angle {
        1.0
    } else {
        report.characteristic_length
    };
    if value.abs() < ROUNDING * unit {
        0.0
    } else {
        value
    }
}

/// Half a turn is printed one way, also where it is a little less than half a turn backwards.
fn once(angle: String) -> String {
    match angle.as_str() {
        "-180°" => "180°".into(),
        _ => angle,
    }
}

fn complex_number(re: f64, im: f64) -> String {
    let sign = if im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", number(re), number(im.abs()))
}
