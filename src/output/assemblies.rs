//! All assemblies of a mechanism, as text and as JSON.

use std::fmt::Write;

mod tables;

use super::closing;
use super::json::document;
use super::layout::indented;
use super::quantity::{number, quantity};
use crate::analysis::assemblies::{
    AssembliesReport, ClosestApproach, Continuum, Fit, Fold, LostMode, LostReason,
};
use crate::description::count;
use crate::description::listed;
use crate::mechanism::{Coordinate, Variable};
use tables::{complex, joints, overview, platforms, reasons, times};

/// The report as text.
pub fn text(report: &AssembliesReport) -> String {
    let mut sections = vec![format!(
        "{}\n{}\n{}",
        report.mechanism,
        sentence(report),
        indented(&accounting(report))
    )];
    if !report.assemblies.is_empty() {
        sections.push(overview(report));
        sections.extend(joints(report));
        sections.extend(platforms(report));
        sections.extend(reasons(report));
    }
    if !report.complex_assemblies.is_empty() {
        sections.push(complex(report));
    }
    if let Some(closest) = &report.closest {
        sections.push(nearest(report, closest));
    }
    sections.join("\n")
}

/// The answer in one sentence.
pub fn sentence(report: &AssembliesReport) -> String {
    let real = count(report.real, "assembly").replace("assemblys", "assemblies");
    match (&report.fit, report.real) {
        (Fit::FreedomLeft(_), 0) => "No assembly found.".into(),
        (Fit::FreedomLeft(freedom), _) => {
            let left = match freedom {
                1 => "1 freedom is".into(),
                n => format!("{n} freedoms are"),
            };
            let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
            let isolated = isolated.count();
            let listed = match report.real - isolated {
                _ if isolated == 0 => format!("{real} as samples"),
                0 => format!("{real}, all isolated"),
                samples => {
                    let isolated = count(isolated, "isolated assembly");
                    format!(
                        "{} and {} of the others",
                        isolated.replace("assemblys", "assemblies"),
                        count(samples, "sample")
                    )
                }
            };
            format!(
                "The assemblies are not finite in number: {left} left with what is held. {listed}."
            )
        }
        (Fit::TooManyHeld | Fit::AlwaysMultiple, _) => format!("{real} found."),
        (Fit::Finite, _) if !report.continua.is_empty() => infinitely_many(report),
        (Fit::Finite, 0) => format!("0 real of {} complex: no assembly.", report.complex),
        (Fit::Finite, _) => format!(
            "{real}: {} real of {} complex.",
            report.real, report.complex
        ),
    }
}

/// The answer where assemblies are connected at the inputs asked.
fn infinitely_many(report: &AssembliesReport) -> String {
    let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
    let sets = report.continua.iter().map(|set: &Continuum| {
        // a path may stand for several solutions, and be followed again for each
        let ends = match count(set.paths, "complex solution") {
            one if set.paths == 1 => format!("{one} ends"),
            many => format!("{many} end"),
        };
        match set.samples.len() {
            0 => format!(
                "a complex set of dimension {} in which {ends}, of which no real assembly was met",
                set.dimension
            ),
            samples => format!(
                "a set of dimension {} in which {ends}, with {}",
                set.dimension,
                count(samples, "sample")
            ),
        }
    });
    let isolated = count(isolated.count(), "isolated assembly").replace("assemblys", "assemblies");
    format!(
        "{isolated} and infinitely many connected ones at these inputs: {}.",
        listed(&sets.collect::<Vec<_>>())
    )
}

fn accounting(report: &AssembliesReport) -> String {
    let mut text = String::new();
    let mut doubles: Vec<String> = (report.assemblies.iter().filter(|a| a.multiplicity > 1))
        .map(|a| format!("{} is {}", a.mode, times(a.multiplicity)))
        .collect();
    match report.singular.saturating_sub(doubles.len()) {
        0 => {}
        1 => doubles.push("1 is complex".into()),
        n => doubles.push(format!("{n} are complex")),
    }
    let _ = write!(
        text,
        "{} complex with multiplicity, {} at infinity{}, {} lost; {} where solutions meet",
        report.complex,
        report.at_infinity,
        match report.at_infinity {
            0 => "",
            _ => " or beyond 1000 characteristic lengths",
        },
        report.lost,
        report.singular
    );
    if !doubles.is_empty() {
        let _ = write!(text, " ({})", listed(&doubles));
    }
    if report.half_a_turn_away > 0 {
        let _ = write!(
            text,
            "; {} with roll or yaw half a turn from what is held",
            report.half_a_turn_away
        );
    }
    if report.not_isolated > 0 {
        let _ = write!(text, "; {} not isolated", report.not_isolated);
    }
    text.push('\n');
    if report.paths > 0 {
        let _ = writeln!(
            text,
            "{} in {}, {} followed again",
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
        let length = quantity(report.characteristic_length, false);
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

fn nearest(report: &AssembliesReport, closest: &ClosestApproach) -> String {
    let mut text = match closest.local_minimum {
        true => format!("Closest approach: closure {} gapes most\n", closest.worst),
        false => format!(
            "Closest found, though perhaps not closest of all: closure {} gapes most\n",
            closest.worst
        ),
    };
    for (name, gap) in &closest.gaps.0 {
        let _ = writeln!(text, "  {name}: {}", closing::gap(gap.distance, gap.angle));
    }
    for ((name, value), joint) in closest.joints.0.iter().zip(&report.variables) {
        let angle = joint.unit.is_angle();
        let _ = writeln!(text, "  {name} = {}", quantity(*value, angle));
    }
    text
}

/// The report as JSON: lengths in m, angles in rad, every number with all its digits.
pub fn json(report: &AssembliesReport) -> String {
    document(&report.mechanism, report)
}

/// Why a mode was not followed, as JSON.
pub fn lost_json(lost: &LostMode) -> String {
    document(&lost.mechanism, lost)
}

/// Why a mode was not followed, as text.
pub fn lost_text(lost: &LostMode) -> String {
    let LostMode {
        mechanism,
        mode,
        reason,
        ..
    } = lost;
    let percent = |fold: &Fold| number(100.0 * fold.fraction);
    let what = match reason {
        LostReason::Ceases(fold) => format!(
            "Mode {mode} ceases to exist on the way from home, {} % of the way: there it meets another mode.",
            percent(fold)
        ),
        LostReason::MeetsOthers(fold) => format!(
            "Mode {mode} cannot be followed beyond {} % of the way from home, where it meets other \
             assemblies: its number does not tell which of them to follow.",
            percent(fold)
        ),
        LostReason::MeetAtHome { multiplicity } => {
            let what = match multiplicity {
                0 => "one of infinitely many connected assemblies".into(),
                n => format!("{}: {n} assemblies meet there", times(*n)),
            };
            format!(
                "At home mode {mode} is {what}, and its number does not tell which of them to follow. \
                 `assemblies` lists those at the inputs asked; `solve --guess` starts near one of them."
            )
        }
    };
    let mut text = format!("{mechanism}\n{what}\n");
    let (LostReason::Ceases(fold) | LostReason::MeetsOthers(fold)) = reason else {
        return text;
    };
    for (name, value) in &fold.inputs.0 {
        let _ = writeln!(text, "  {name} = {}", input(&lost.variables, name, *value));
    }
    text += "\nJoints there\n";
    for ((name, value), joint) in fold.joints.0.iter().zip(&lost.variables) {
        let _ = writeln!(
            text,
            "  {name} = {}",
            quantity(*value, joint.unit.is_angle())
        );
    }
    text
}

/// An input with its unit: joints and platform coordinates by name, parts of quaternions without.
fn input(variables: &[Variable], name: &str, value: f64) -> String {
    if let Some(joint) = variables.iter().find(|joint| joint.name == name) {
        return quantity(value, joint.unit.is_angle());
    }
    let coordinate = name
        .rsplit_once('.')
        .and_then(|(_, c)| Coordinate::by_name(c));
    coordinate.map_or(number(value), |c| quantity(value, c.is_angle()))
}
