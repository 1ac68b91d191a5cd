//! All assemblies of a mechanism, as text and as JSON.

use std::fmt::Write;

use comfy_table::{Table, presets};
use serde::Serialize;

use super::closing;
use super::json::document;
use super::layout::{align_right, indented};
use super::quantity::{degrees, number, quantity, size};
use crate::analysis::assemblies::{
    AssembliesReport, Assembly, ClosestApproach, ComplexAssembly, Fit, Fold, Progress,
};
use crate::description::count;
use crate::description::listed;
use crate::mechanism::{Coordinate, Mechanism};
use crate::system::{HeldPlatform, Question};

/// Columns of joint values that stand beside each other.
const ABREAST: usize = 8;

/// The report as text.
pub fn text(question: &Question, report: &AssembliesReport) -> String {
    let mechanism = question.mechanism();
    let mut sections = vec![format!(
        "{}\n{}\n{}",
        mechanism.name(),
        sentence(report),
        indented(&accounting(mechanism, report))
    )];
    if !report.assemblies.is_empty() {
        sections.push(overview(report));
        sections.extend(joints(question, report));
        sections.extend(platforms(question, report));
        sections.extend(reasons(report));
    }
    if !report.complex_assemblies.is_empty() {
        sections.push(complex(mechanism, report));
    }
    if let Some(closest) = &report.closest {
        sections.push(nearest(mechanism, closest));
    }
    sections.join("\n")
}

/// The answer in one sentence.
pub fn sentence(report: &AssembliesReport) -> String {
    let real = count(report.real, "assembly").replace("assemblys", "assemblies");
    match (&report.fit, report.real) {
        (Fit::FreedomLeft(_), 0) => "No assembly found.".into(),
        (Fit::FreedomLeft(freedom), _) => format!(
            "The assemblies are not finite in number: {} left with what is held. {real} as samples.",
            match freedom {
                1 => "1 freedom is".into(),
                n => format!("{n} freedoms are"),
            }
        ),
        (Fit::TooManyHeld, _) => format!("{real} found."),
        (Fit::Finite, 0)
            if report
                .closest
                .as_ref()
                .is_some_and(ClosestApproach::is_closed) =>
        {
            format!(
                "0 isolated real of {} complex, but the mechanism assembles: at these inputs \
                 infinitely many assemblies are connected, and one of them is given.",
                report.complex
            )
        }
        (Fit::Finite, 0) => format!("0 real of {} complex: no assembly.", report.complex),
        (Fit::Finite, _) => format!(
            "{real}: {} real of {} complex.",
            report.real, report.complex
        ),
    }
}

fn accounting(mechanism: &Mechanism, report: &AssembliesReport) -> String {
    let mut text = String::new();
    if report.fit == Fit::Finite {
        let doubles: Vec<String> = (report.assemblies.iter().filter(|a| a.multiplicity > 1))
            .map(|a| format!("{} is {}", a.mode, times(a.multiplicity)))
            .collect();
        let _ = write!(
            text,
            "{} complex with multiplicity, {} at infinity, {} lost; {} where solutions meet",
            report.complex, report.at_infinity, report.lost, report.singular
        );
        if !doubles.is_empty() {
            let _ = write!(text, " ({})", listed(&doubles));
        }
        let _ = writeln!(
            text,
            "\n{} in {}, {} followed again",
            count(report.paths, "path"),
            count(report.steps, "step"),
            report.retried
        );
    }
    let _ = writeln!(
        text,
        "{} and {} with random seed {}",
        count(report.seeds, "seed"),
        count(report.loops, "loop"),
        report.seed
    );
    let _ = writeln!(text, "completeness: {}", report.complete);
    if let Some(source) = &report.bound_source {
        let _ = writeln!(text, "bound for {source}");
    }
    if report.assemblies.iter().any(|a| a.certified) {
        let length = quantity(mechanism.characteristic_length(), false);
        let _ = writeln!(
            text,
            "radii of certificates in rad and, for lengths, in units of {length}"
        );
    }
    if let Some((used, all)) = report.independent_rows {
        let _ = writeln!(
            text,
            "certificates use {used} independent ones of {all} closure rows"
        );
    }
    text
}

fn times(multiplicity: usize) -> String {
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

fn overview(report: &AssembliesReport) -> String {
    let header = ["mode", "condition", "side", "limits", "certificate", ""];
    let mut table = table(&header.map(String::from));
    for a in &report.assemblies {
        let certificate = match (a.radius, a.multiplicity) {
            (Some(radius), _) => format!("unique within {radius:.1e}"),
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
            if a.within_limits { "within" } else { "outside" }.into(),
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
fn joints(question: &Question, report: &AssembliesReport) -> Vec<String> {
    let mechanism = question.mechanism();
    let held = question.held();
    let free: Vec<usize> = (0..held.joints.len())
        .filter(|&j| !held.joints[j])
        .collect();
    let blocks = free.chunks(ABREAST).enumerate();
    let blocks = blocks.map(|(block, free)| {
        let names = free.iter().map(|&j| mechanism.joints()[j].name.clone());
        let header: Vec<String> = std::iter::once("mode".into()).chain(names).collect();
        let mut table = table(&header);
        for a in &report.assemblies {
            let values = free.iter().map(|&j| {
                let angle = mechanism.joints()[j].kind.is_angle();
                quantity(a.joints.0[j].1, angle)
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
fn platforms(question: &Question, report: &AssembliesReport) -> Vec<String> {
    let held = question.held();
    let parts = question
        .mechanism()
        .platforms()
        .iter()
        .zip(&held.platforms)
        .enumerate();
    let parts = parts.filter(|(_, (_, held))| **held != HeldPlatform::Pose);
    let parts = parts.map(|(p, (part, _))| {
        let header = ["mode", "x", "y", "z", "roll", "pitch", "yaw"];
        let mut table = table(&header.map(String::from));
        for a in &report.assemblies {
            let (_, pose) = &a.platforms.0[p];
            let position = pose.position.map(|x| quantity(x, false));
            let angles = pose.roll_pitch_yaw.map(degrees);
            table.add_row(
                std::iter::once(a.mode.to_string())
                    .chain(position)
                    .chain(angles),
            );
        }
        align_right(&mut table, 0..7);
        format!("Platform {}\n{}", part.name, indented(&table.to_string()))
    });
    parts.collect()
}

/// Why assemblies are not certified, each reason once.
fn reasons(report: &AssembliesReport) -> Option<String> {
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

fn complex(mechanism: &Mechanism, report: &AssembliesReport) -> String {
    let mut text = String::from("Complex solutions that are not real\n");
    for (
        i,
        ComplexAssembly {
            joints,
            platforms,
            multiplicity,
        },
    ) in report.complex_assemblies.iter().enumerate()
    {
        let multiple = match multiplicity {
            1 => String::new(),
            n => format!(", {}", times(*n)),
        };
        let _ = writeln!(text, "  {}{multiple}", i + 1);
        for ((name, [re, im]), joint) in joints.0.iter().zip(mechanism.joints()) {
            let (re, im) = match joint.kind.is_angle() {
                true => (re.to_degrees(), im.to_degrees()),
                false => (*re, *im),
            };
            let unit = if joint.kind.is_angle() { "°" } else { " m" };
            let _ = writeln!(text, "    {name} = {}{unit}", complex_number(re, im));
        }
        for (name, numbers) in &platforms.0 {
            let parts: Vec<String> = numbers
                .iter()
                .map(|[re, im]| complex_number(*re, *im))
                .collect();
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

fn complex_number(re: f64, im: f64) -> String {
    let sign = if im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", number(re), number(im.abs()))
}

fn nearest(mechanism: &Mechanism, closest: &ClosestApproach) -> String {
    let mut text = match closest.is_closed() {
        true => "One assembly of infinitely many\n".into(),
        false => format!("Closest approach: closure {} gapes most\n", closest.worst),
    };
    for (name, gap) in &closest.gaps.0 {
        let _ = writeln!(text, "  {name}: {}", closing::gap(gap.distance, gap.angle));
    }
    for ((name, value), joint) in closest.joints.0.iter().zip(mechanism.joints()) {
        let _ = writeln!(
            text,
            "  {name} = {}",
            quantity(*value, joint.kind.is_angle())
        );
    }
    text
}

/// `searching: 37 solutions after 480 seeds and 5 loops`
pub fn progress(now: &Progress) -> String {
    format!(
        "searching: {} after {} and {}\n",
        count(now.found, "solution"),
        count(now.seeds, "seed"),
        count(now.loops, "loop")
    )
}

/// The report as JSON: lengths in m, angles in rad, every number with all its digits.
pub fn json(question: &Question, report: &AssembliesReport) -> String {
    document(question.mechanism().name(), report)
}

/// Where a mode ceases to exist, as text.
pub fn fold_text(question: &Question, mode: usize, fold: &Fold) -> String {
    let mechanism = question.mechanism();
    let part = number(100.0 * fold.fraction);
    let mut text = format!(
        "{}\nMode {mode} ceases to exist on the way from home, {part} % of the way: there it meets another mode.\n",
        mechanism.name()
    );
    for (name, value) in &fold.inputs.0 {
        let _ = writeln!(text, "  {name} = {}", input(mechanism, name, *value));
    }
    text += "\nJoints there\n";
    for ((name, value), joint) in fold.joints.0.iter().zip(mechanism.joints()) {
        let _ = writeln!(
            text,
            "  {name} = {}",
            quantity(*value, joint.kind.is_angle())
        );
    }
    text
}

/// An input with its unit: joints and platform coordinates by name, parts of quaternions without.
fn input(mechanism: &Mechanism, name: &str, value: f64) -> String {
    if let Some(joint) = mechanism.joint(name) {
        return quantity(value, mechanism.joints()[joint].kind.is_angle());
    }
    let coordinate = name
        .rsplit_once('.')
        .and_then(|(_, c)| Coordinate::by_name(c));
    coordinate.map_or(number(value), |c| quantity(value, c.is_angle()))
}

/// Where a mode ceases to exist, as JSON: m and rad.
pub fn fold_json(question: &Question, mode: usize, fold: &Fold) -> String {
    #[derive(Serialize)]
    struct FoldJson<'a> {
        outcome: &'static str,
        mode: usize,
        #[serde(flatten)]
        fold: &'a Fold,
    }
    let outcome = "mode_ceases";
    document(
        question.mechanism().name(),
        &FoldJson {
            outcome,
            mode,
            fold,
        },
    )
}
