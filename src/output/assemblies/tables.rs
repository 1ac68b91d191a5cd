//! Tables of assemblies.

use crate::algebra::SiUnit;
use crate::analysis::assemblies::{AssembliesReport, Assembly, ComplexAssembly, ListedJoint};
use crate::description::listed;
use crate::output::document::{Cell, Section, Table, TableOf};
use crate::output::quantity::{number, quantity, shown, size, with_unit};

/// Columns of joint values that stand beside each other.
const ABREAST: usize = 8;

pub(super) fn times(multiplicity: usize) -> String {
    match multiplicity {
        2 => "double".into(),
        n => format!("{n}-fold"),
    }
}

pub(super) fn overview(report: &AssembliesReport) -> TableOf<&Assembly> {
    let certificate = |a: &Assembly| match (a.radius, a.multiplicity) {
        (Some(radius), _) => format!("unique within {radius:.1e}"),
        (None, 0) if a.dimension > 0 => {
            format!("none: a sample of a set of dimension {}", a.dimension)
        }
        (None, 0) => "none: a sample".into(),
        (None, 1) => "none".into(),
        (None, n) => format!("none: {}", times(n)),
    };
    let sign = |a: &Assembly| match a.determinant_sign {
        1 => "+",
        -1 => "-",
        _ => "0",
    };
    let limits = |a: &Assembly| match a.outside_limits.is_empty() {
        true => "within".into(),
        false => format!("outside: {}", listed(&a.outside_limits)),
    };
    let shared = |a: &Assembly| {
        let others = a.shares_platform_pose_with.iter();
        let others: Vec<String> = others.map(usize::to_string).collect();
        (!others.is_empty()).then(|| format!("same platform pose as {}", listed(&others)))
    };
    Table::of(&report.assemblies)
        .numbers("mode", |a| a.mode)
        .numbers("condition", |a| {
            Cell::size(a.condition.unwrap_or(f64::INFINITY))
        })
        .words("sign of det J", sign)
        .words("limits", limits)
        .words("certificate", certificate)
        .words("", shared)
}

/// Values of the joints that are not held.
pub(super) fn joints(report: &AssembliesReport) -> Vec<Section> {
    let variables = report.variables.iter().enumerate();
    let free: Vec<(usize, &ListedJoint)> = variables.filter(|(_, joint)| !joint.held).collect();
    let blocks = free.chunks(ABREAST).enumerate().map(|(block, free)| {
        let modes = Table::of(&report.assemblies).numbers("mode", |a| a.mode);
        let table = free.iter().fold(modes, |table, &(j, joint)| {
            table.numbers(&joint.name, |a| {
                let value = settled(a.joints.0[j].1, report, joint.unit);
                let text = quantity(value, joint.unit);
                // −180° may be within limits where 180° is not
                if joint.periodic { once(text) } else { text }
            })
        });
        let title = match block {
            0 => "Joints",
            _ => "Further joints",
        };
        Section::new(title).table(table)
    });
    blocks.collect()
}

/// Poses of the platforms that are not held.
pub(super) fn platforms(report: &AssembliesReport) -> Vec<Section> {
    const HEADER: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
    let Some(first) = report.assemblies.first() else {
        return Vec::new();
    };
    let parts = first.platforms.0.iter().enumerate();
    let parts = parts.filter(|(_, (name, _))| !report.held_platforms.contains(name));
    let parts = parts.map(|(p, (name, _))| {
        let modes = Table::of(&report.assemblies).numbers("mode", |a| a.mode);
        let table = (0..).zip(HEADER).fold(modes, |table, (i, title)| {
            table.numbers(title, |a| {
                let (_, pose) = &a.platforms.0[p];
                let (value, unit) = match i {
                    0..3 => (pose.position[i], SiUnit::METRE),
                    _ => (pose.roll_pitch_yaw[i - 3], SiUnit::RADIAN),
                };
                once(quantity(settled(value, report, unit), unit))
            })
        });
        Section::new(format!("Platform {name}")).table(table)
    });
    parts.collect()
}

/// Why assemblies are not certified, each reason once.
pub(super) fn reasons(report: &AssembliesReport) -> Section {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for a in &report.assemblies {
        let Some(reason) = &a.uncertified_because else {
            continue;
        };
        match reasons.iter_mut().find(|(known, _)| known == reason) {
            Some((_, modes)) => modes.push(a.mode.to_string()),
            None => reasons.push((reason, vec![a.mode.to_string()])),
        }
    }
    let lines = reasons
        .iter()
        .map(|(reason, modes)| format!("{}: {reason}", listed(modes)));
    Section::new("Not certified").list(lines)
}

/// Complex solutions, if they were asked for.
pub(super) fn complex(report: &AssembliesReport) -> Section {
    let title = "Complex solutions that are not real";
    let one = |(i, of): (usize, &ComplexAssembly)| {
        let multiple = match of.multiplicity {
            1 => String::new(),
            n => format!(", {}", times(n)),
        };
        let condition = of.condition.map_or("infinite".into(), size);
        let joints = of.joints.0.iter().zip(&report.variables);
        let joints = joints.map(|((name, parts), joint)| {
            let parts = parts.map(|x| shown(settled(x, report, joint.unit), joint.unit));
            format!("{name} = {}", with_unit(&complex_number(parts), joint.unit))
        });
        let platforms = of.platforms.0.iter().map(|(name, numbers)| {
            let parts = numbers.iter().enumerate().map(|(i, parts)| {
                // three lengths, then the quaternion
                let unit = if i < 3 { SiUnit::METRE } else { SiUnit::ONE };
                complex_number(parts.map(|x| settled(x, report, unit)))
            });
            let parts: Vec<String> = parts.collect();
            let (position, quaternion) = parts.split_at(3.min(parts.len()));
            format!(
                "{name}: position {} m, quaternion {}",
                position.join(", "),
                quaternion.join(", ")
            )
        });
        let title = format!("{}{multiple}, condition {condition}", i + 1);
        Section::new(title).list(joints.chain(platforms))
    };
    let solutions = report.complex_assemblies.iter().enumerate().map(one);
    solutions.fold(Section::new(title), Section::section)
}

/// What is left of a zero after rounding is a zero: solutions are good to some 1e-12 rad or
/// characteristic lengths, and what rounding leaves differs from one way to them to another.
fn settled(value: f64, report: &AssembliesReport, unit: SiUnit) -> f64 {
    const ROUNDING: f64 = 1e-10;
    let scale = match unit {
        SiUnit::METRE => report.characteristic_length,
        _ => 1.0,
    };
    match value.abs() < ROUNDING * scale {
        true => 0.0,
        false => value,
    }
}

/// Half a turn is printed one way, also where it is a little less than half a turn backwards.
fn once(angle: String) -> String {
    match angle.as_str() {
        "-180°" => "180°".into(),
        _ => angle,
    }
}

fn complex_number([re, im]: [f64; 2]) -> String {
    let sign = if im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", number(re), number(im.abs()))
}
