//! The answer in sentences.

use super::{Character, MobilityReport};
use crate::description::ClosureKind;
use crate::mechanism::Mechanism;
use crate::system::{Tangent, Unknown};

/// `a`, `a and b`, `a, b and c`.
pub(super) fn list<S: AsRef<str>>(items: &[S]) -> String {
    match items {
        [] => String::new(),
        [one] => one.as_ref().into(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(S::as_ref).collect();
            format!("{} and {}", first.join(", "), last.as_ref())
        }
    }
}

/// A number with four decimals at most, without trailing zeros.
pub(super) fn short(x: f64) -> String {
    let text = format!("{x:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

fn named(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    list(&quoted)
}

fn freedoms(n: usize) -> String {
    match n {
        0 => "no freedom".into(),
        1 => "1 freedom".into(),
        n => format!("{n} freedoms"),
    }
}

/// One sentence for each idle freedom: those of the model, then one for each rod between two balls,
/// which a distance does not model.
pub(super) fn idle_freedoms(
    mechanism: &Mechanism,
    unknowns: &[Unknown],
    tangent: &Tangent,
) -> Vec<String> {
    let idle = super::redundancy::axis_aligned(&tangent.idle);
    let mut sentences: Vec<String> = (idle.iter())
        .map(|motion| {
            let joints: Vec<String> = (unknowns.iter().zip(motion))
                .filter(|(_, rate)| rate.abs() > 1e-6)
                .filter_map(|(unknown, _)| match *unknown {
                    Unknown::Joint(joint) => Some(mechanism.joints()[joint].name.clone()),
                    Unknown::Twist { .. } => None,
                })
                .collect();
            format!("a link spins about its own line ({})", named(&joints))
        })
        .collect();
    let rods = (mechanism.closures().iter()).filter(|c| c.kind == ClosureKind::Distance);
    sentences.extend(rods.map(|rod| format!("rod `{}` spins about its own line", rod.name)));
    sentences
}

pub(super) fn explain(report: &MobilityReport) -> String {
    let mut sentences = vec![mobility(report)];
    sentences.push(count(report));
    if !report.redundant_constraints.is_empty() {
        sentences.push(format!(
            "Redundant {}: {}.",
            if report.redundant == 1 { "is" } else { "are" },
            report.redundant_constraints.join("; ")
        ));
    }
    if !report.idle_freedoms.is_empty() {
        let idle = match &report.idle_freedoms[..] {
            [one] => format!("1 idle freedom: {one}"),
            many => format!(
                "{} idle freedoms, each a spin about a link's own line",
                many.len()
            ),
        };
        sentences.push(format!("Not counted: {idle}."));
    }
    if report.mobility > 0 && !report.idle_joints.is_empty() {
        let stand = if report.idle_joints.len() == 1 {
            "stands"
        } else {
            "stand"
        };
        sentences.push(format!("{} {stand} still.", named(&report.idle_joints)));
    }
    for elsewhere in &report.elsewhere {
        let joints = elsewhere
            .joints
            .iter()
            .map(|(name, value)| format!("{name} = {}", short(*value)));
        sentences.push(format!(
            "The mobility depends on the assembly: near {} the mechanism has {}.",
            joints.collect::<Vec<_>>().join(", "),
            freedoms(elsewhere.mobility),
        ));
    }
    if let Some(gap) = &report.given {
        let free = if report.kept {
            ""
        } else {
            ", driven joints included"
        };
        sentences.push(format!(
            "The pose given was not closed: closure `{}` was open by {:.3e} m and {:.3e} rad; it was closed first{free}.",
            gap.closure, gap.distance, gap.angle
        ));
    }
    sentences.join(" ")
}

fn mobility(report: &MobilityReport) -> String {
    let n = report.mobility;
    let tangent = report.infinitesimal;
    match report.character {
        Character::Structure => "A structure: nothing can move, not even infinitesimally.".into(),
        Character::Regular => format!("The mechanism has {}.", freedoms(n)),
        Character::Shaky => {
            let gap = match report.gap_after_step {
                Some(gap) => format!("a finite step along it leaves a gap of {gap:.1e}"),
                None => "no finite step along it closes".into(),
            };
            format!(
                "Shaky: {} infinitesimal, none finite: {gap}, so the mechanism cannot move.",
                freedoms(tangent)
            )
        }
        Character::Singular => format!(
            "The mechanism has {} here, at a singular configuration with {tangent} infinitesimal ones.",
            freedoms(n)
        ),
        Character::Bifurcation => format!(
            "Bifurcation: {} branches of {} each meet here, where {tangent} are infinitesimal.",
            report.branches.len(),
            freedoms(n)
        ),
        Character::Kinematotropic => {
            let each: Vec<String> = report
                .branches
                .iter()
                .map(|branch| branch.mobility.to_string())
                .collect();
            format!(
                "Kinematotropic: branches of {} freedoms meet here, where {tangent} are infinitesimal: the mobility depends on the branch.",
                list(&each)
            )
        }
    }
}

fn count(report: &MobilityReport) -> String {
    let MobilityReport {
        kutzbach,
        unknowns,
        equations,
        rank,
        redundant,
        ..
    } = report;
    let exact = match redundant {
        0 => "all independent".into(),
        n => format!("{n} of them redundant"),
    };
    format!(
        "Kutzbach's count is {unknowns} - {equations} = {kutzbach}; the {equations} closure equations have rank {rank}, {exact}."
    )
}
