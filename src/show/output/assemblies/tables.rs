//! Tables of assemblies.

use crate::algebra::SiUnit;
use crate::analysis::assemblies::{AssembliesReport, Assembly, ComplexAssembly, Fit, ListedJoint};
use crate::description::listed;
use crate::number::tolerance::NOT_PRINTED;
use crate::output::document::{Cell, Section, Table, TableOf};
use crate::output::quantity::{number, quantity, runs, shown, size, with_unit};

/// Columns of joint values that stand beside each other.
const ABREAST: usize = 8;

pub(super) fn times(multiplicity: usize) -> String {
    match multiplicity {
        2 => "double".into(),
        n => format!("{n}-fold"),
    }
}

/// Number of solutions that meet in an assembly. Where freedoms are left it lies on a set of complex solutions and has
/// no such number; where no paths are counted, its equations give the least one.
pub(super) fn met(report: &AssembliesReport, multiplicity: usize) -> String {
    match report.fit {
        Fit::FreedomLeft(_) => "singular".into(),
        Fit::Finite if report.search.multiple == 0 => times(multiplicity),
        _ => format!("at least {}", times(multiplicity)),
    }
}

/// Assemblies in one pose of the platforms.
pub(super) struct PoseGroup<'r> {
    number: usize,
    modes: Vec<&'r Assembly>,
}

/// Name of the things that stand alike in assemblies of one pose.
pub(super) fn are_posed(report: &AssembliesReport) -> &'static str {
    let found = |(name, _): &(String, _)| !report.held_platforms.contains(name);
    let mut assemblies = report.assemblies.iter();
    match report.positions.is_empty() && assemblies.any(|a| a.platforms.0.iter().any(found)) {
        true => "platforms",
        false => "bodies",
    }
}

/// The positions of the bodies where assemblies share them, or the poses where there are several and assemblies share them;
/// otherwise a row for each assembly tells as much.
pub(super) fn poses(report: &AssembliesReport) -> Option<Vec<PoseGroup<'_>>> {
    let (poses, least) = match report.positions.is_empty() {
        true => (&report.poses, 2),
        false => (&report.positions, 1),
    };
    let shared = (least..report.assemblies.len()).contains(&poses.len());
    let poses = (1..).zip(poses).map(|(number, modes)| PoseGroup {
        number,
        modes: (report.assemblies.iter())
            .filter(|a| modes.contains(&a.mode))
            .collect(),
    });
    let all: Vec<PoseGroup> = shared.then(|| poses.collect())?;
    (all.iter().all(|pose| !pose.modes.is_empty())).then_some(all)
}

pub(super) fn by_pose<'p>(poses: &'p [PoseGroup<'_>]) -> Table {
    let numbers = |pose: &PoseGroup| {
        let modes: Vec<usize> = pose.modes.iter().map(|a| a.mode).collect();
        runs(&modes).join(", ")
    };
    let condition = |pose: &PoseGroup| {
        let of = pose.modes.iter();
        let of = of.map(|a| a.condition.unwrap_or(f64::INFINITY));
        let least = of.clone().fold(f64::INFINITY, f64::min);
        let ends = [least, of.fold(0.0, f64::max)].map(size);
        match ends[0] == ends[1] {
            true => ends[0].clone(),
            false => format!("{} to {}", ends[0], ends[1]),
        }
    };
    let part = |pose: &PoseGroup, of: fn(&Assembly) -> bool, words: &str, none: &str| {
        let n = pose.modes.iter().filter(|a| of(a)).count();
        match n {
            0 => none.to_owned(),
            n if n == pose.modes.len() => words.to_owned(),
            n => format!("{n} {words}"),
        }
    };
    Table::of(poses)
        .numbers("pose", |pose: &'p PoseGroup| pose.number)
        .numbers("modes", |pose| pose.modes.len())
        .words("which", numbers)
        .words("condition", condition)
        .words("limits", |pose| {
            part(pose, |a| a.within_limits, "within", "outside")
        })
        .words("certificate", |pose| {
            part(pose, |a| a.certified, "unique", "none")
        })
        .into()
}

pub(super) fn overview(report: &AssembliesReport) -> TableOf<&Assembly> {
    let certificate = |a: &Assembly| match (a.radius, a.multiplicity) {
        (Some(radius), _) => format!("unique within {radius:.1e}"),
        (None, 0) if a.dimension > 0 => {
            format!("none: a sample of a set of dimension {}", a.dimension)
        }
        (None, 0) => "none: a sample".into(),
        (None, 1) => "none".into(),
        (None, n) => format!("none: {}", met(report, n)),
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
        let others = &a.shares_platform_pose_with;
        let numbers = others.iter().map(usize::to_string);
        (!others.is_empty()).then(|| format!("same platform pose as {}", listed(numbers)))
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

pub(super) fn joints(report: &AssembliesReport) -> Vec<Section> {
    let variables = report.variables.iter().enumerate();
    let free: Vec<(usize, &ListedJoint)> = variables.filter(|(_, joint)| !joint.held).collect();
    let blocks = free.chunks(ABREAST).enumerate().map(|(block, free)| {
        let modes = Table::of(&report.assemblies).numbers("mode", |a| a.mode);
        let table = modes.each(free.iter().map(|(_, joint)| &joint.name), |a, k| {
            let (j, joint) = free[k];
            let value = settled(a.joints.0[j].1, report, joint.unit);
            let text = quantity(value, joint.unit);
            // −180° may be within limits where 180° is not
            if joint.periodic {
                positive_half_turn(text)
            } else {
                text
            }
        });
        let title = match block {
            0 => "Joints",
            _ => "Further joints",
        };
        Section::new(title).table(table)
    });
    blocks.collect()
}

pub(super) fn platforms(report: &AssembliesReport) -> Vec<Section> {
    const HEADER: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
    let Some(first) = report.assemblies.first() else {
        return Vec::new();
    };
    let parts = first.platforms.0.iter().enumerate();
    let parts = parts.filter(|(_, (name, _))| !report.held_platforms.contains(name));
    let poses = poses(report);
    // the first assembly of a pose stands for all
    let (title, rows): (&str, Vec<(usize, &Assembly)>) = match &poses {
        Some(poses) => {
            let first = poses.iter().map(|pose| (pose.number, pose.modes[0]));
            ("pose", first.collect())
        }
        None => {
            let all = report.assemblies.iter();
            ("mode", all.map(|a| (a.mode, a)).collect())
        }
    };
    let parts = parts.map(|(p, (name, _))| {
        let numbered = Table::of(rows.iter().copied()).numbers(title, |(number, _)| number);
        let table = numbered.each(HEADER, |(_, a), i| {
            let (_, pose) = &a.platforms.0[p];
            let (value, unit) = match i {
                0..3 => (pose.position[i], SiUnit::METRE),
                _ => (pose.roll_pitch_yaw[i - 3], SiUnit::RADIAN),
            };
            positive_half_turn(quantity(settled(value, report, unit), unit))
        });
        Section::new(format!("Platform {name}")).table(table)
    });
    parts.collect()
}

/// Reasons for which assemblies are not certified, each once.
pub(super) fn reasons(report: &AssembliesReport) -> Section {
    let mut reasons: Vec<(&str, Vec<usize>)> = Vec::new();
    for a in &report.assemblies {
        let Some(reason) = &a.uncertified_because else {
            continue;
        };
        match reasons.iter_mut().find(|(known, _)| known == reason) {
            Some((_, modes)) => modes.push(a.mode),
            None => reasons.push((reason, vec![a.mode])),
        }
    }
    let lines = reasons.iter();
    let lines = lines.map(|(reason, modes)| format!("{}: {reason}", listed(runs(modes))));
    Section::new("Not certified").list(lines)
}

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
            let [position, quaternion] = [position, quaternion].map(|of| of.join(", "));
            format!("{name}: position {position} m, quaternion {quaternion}")
        });
        let title = format!("{}{multiple}, condition {condition}", i + 1);
        Section::new(title).list(joints.chain(platforms))
    };
    let solutions = report.complex_assemblies.iter().enumerate().map(one);
    solutions.fold(Section::new(title), Section::section)
}

/// A value with rounding of zero removed: solutions are good to some 1e-12 rad or
/// characteristic lengths, and rounding differs from one way to them to another.
fn settled(value: f64, report: &AssembliesReport, unit: SiUnit) -> f64 {
    let scale = match unit {
        SiUnit::METRE => report.characteristic_length,
        _ => 1.0,
    };
    match value.abs() < NOT_PRINTED * scale {
        true => 0.0,
        false => value,
    }
}

/// Half a turn is printed one way, also where it is a little less than half a turn backwards.
fn positive_half_turn(angle: String) -> String {
    match angle.as_str() {
        "-180°" => "180°".into(),
        _ => angle,
    }
}

fn complex_number([re, im]: [f64; 2]) -> String {
    let sign = if im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", number(re), number(im.abs()))
}
