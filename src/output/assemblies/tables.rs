//! Tables of assemblies.

use crate::analysis::assemblies::{AssembliesReport, Assembly, ComplexAssembly, ListedJoint};
use crate::description::listed;
use crate::output::document::{Cell, Column, Section, Table, cells};
use crate::output::quantity::{degrees, number, quantity, size};

/// Columns of joint values that stand beside each other.
const ABREAST: usize = 8;

pub(super) fn times(multiplicity: usize) -> String {
    match multiplicity {
        2 => "double".into(),
        n => format!("{n}-fold"),
    }
}

pub(super) fn overview(report: &AssembliesReport) -> Table {
    let mut table = Table::new([
        Column::numbers("mode"),
        Column::numbers("condition"),
        Column::words("sign of det J"),
        Column::words("limits"),
        Column::words("certificate"),
        Column::words(""),
    ]);
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
        let shared = a.shares_platform_pose_with.iter();
        let shared: Vec<String> = shared.map(usize::to_string).collect();
        let sign = match a.determinant_sign {
            1 => "+",
            -1 => "-",
            _ => "0",
        };
        let limits = match a.outside_limits.is_empty() {
            true => "within".into(),
            false => format!("outside: {}", listed(&a.outside_limits)),
        };
        let same = match shared.is_empty() {
            true => String::new(),
            false => format!("same platform pose as {}", listed(&shared)),
        };
        let condition = Cell::size(a.condition.unwrap_or(f64::INFINITY));
        table.row(cells![a.mode, condition, sign, limits, certificate, same]);
    }
    table
}

/// Values of the joints that are not held.
pub(super) fn joints(report: &AssembliesReport) -> Vec<Section> {
    let variables = report.variables.iter().enumerate();
    let free: Vec<(usize, &ListedJoint)> = variables.filter(|(_, joint)| !joint.held).collect();
    let blocks = free.chunks(ABREAST).enumerate();
    let blocks = blocks.map(|(block, free)| {
        let names = free.iter().map(|(_, joint)| Column::numbers(&joint.name));
        let mut table = Table::new([Column::numbers("mode")].into_iter().chain(names));
        for a in &report.assemblies {
            let values = free.iter().map(|&(j, joint)| {
                let angle = joint.unit.is_angle();
                let text = quantity(settled(a.joints.0[j].1, report, angle), angle);
                // −180° may be within limits where 180° is not
                Cell::from(if joint.periodic { once(text) } else { text })
            });
            table.row([Cell::from(a.mode)].into_iter().chain(values).collect());
        }
        Section::new(if block == 0 {
            "Joints"
        } else {
            "Further joints"
        })
        .table(table)
    });
    blocks.collect()
}

/// Poses of the platforms that are not held.
pub(super) fn platforms(report: &AssembliesReport) -> Vec<Section> {
    let Some(first) = report.assemblies.first() else {
        return Vec::new();
    };
    let parts = first.platforms.0.iter().enumerate();
    let parts = parts.filter(|(_, (name, _))| !report.held_platforms.contains(name));
    let parts = parts.map(|(p, (name, _))| {
        let header = ["mode", "x", "y", "z", "roll", "pitch", "yaw"];
        let mut table = Table::new(header.map(Column::numbers));
        for a in &report.assemblies {
            let (_, pose) = &a.platforms.0[p];
            let position = (pose.position).map(|x| quantity(settled(x, report, false), false));
            let angles = (pose.roll_pitch_yaw).map(|x| once(degrees(settled(x, report, true))));
            let values = position.into_iter().chain(angles).map(Cell::from);
            table.row([Cell::from(a.mode)].into_iter().chain(values).collect());
        }
        Section::new(format!("Platform {name}")).table(table)
    });
    parts.collect()
}

/// Why assemblies are not certified, each reason once.
pub(super) fn reasons(report: &AssembliesReport) -> Section {
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
            let angle = joint.unit.is_angle();
            let [re, im] = parts.map(|x| settled(x, report, angle));
            let (re, im) = match angle {
                true => (re.to_degrees(), im.to_degrees()),
                false => (re, im),
            };
            let unit = if angle { "°" } else { " m" };
            format!("{name} = {}{unit}", complex_number(re, im))
        });
        let platforms = of.platforms.0.iter().map(|(name, numbers)| {
            let parts = numbers.iter().enumerate().map(|(i, parts)| {
                // three lengths, then the quaternion
                let [re, im] = parts.map(|x| settled(x, report, i >= 3));
                complex_number(re, im)
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
fn settled(value: f64, report: &AssembliesReport, angle: bool) -> f64 {
    const ROUNDING: f64 = 1e-10;
    let unit = match angle {
        true => 1.0,
        false => report.characteristic_length,
    };
    match value.abs() < ROUNDING * unit {
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

fn complex_number(re: f64, im: f64) -> String {
    let sign = if im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", number(re), number(im.abs()))
}
