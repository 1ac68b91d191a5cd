//! All assemblies of a mechanism as a document.

mod lost;
mod tables;

use super::closing;
use super::document::{Document, Report, Section};
use super::quantity::quantity;
use crate::analysis::assemblies::{AssembliesReport, ClosestApproach, Continuum, Fit};
use crate::description::{count, listed};
use tables::{complex, joints, overview, platforms, reasons, times};

impl Report for AssembliesReport {
    fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    fn document(&self) -> Document {
        let nearest = self.closest.iter().map(|closest| nearest(self, closest));
        let document = Document::new(&self.mechanism, sentence(self))
            .notes(meeting(self))
            .section(Section::new("Assemblies").table(overview(self)))
            .sections(joints(self))
            .sections(platforms(self))
            .section(reasons(self))
            .section(complex(self))
            .sections(nearest);
        accounting(self)
            .into_iter()
            .fold(document, Document::method)
    }
}

/// The answer in one sentence.
fn sentence(report: &AssembliesReport) -> String {
    let real = count(report.real, "assembly");
    match (&report.fit, report.real) {
        (_, 0) if report.interrupted => "No assembly was found.".into(),
        _ if report.interrupted => format!("{real} found."),
        (Fit::FreedomLeft(_), 0) => "No assembly was found.".into(),
        (Fit::FreedomLeft(freedom), _) => {
            let left = match freedom {
                1 => "1 freedom is".into(),
                n => format!("{n} freedoms are"),
            };
            let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
            let isolated = isolated.count();
            if isolated == report.real {
                return format!(
                    "{real} found, isolated at the limit of what is possible, while in general {left} \
                     left with what is held."
                );
            }
            let listed = match report.real - isolated {
                _ if isolated == 0 => format!("{real} listed as samples"),
                samples => format!(
                    "{} and {} of the others listed",
                    count(isolated, "isolated assembly"),
                    count(samples, "sample")
                ),
            };
            format!("Infinitely many assemblies: {left} left with what is held. {listed}.")
        }
        (Fit::TooManyHeld | Fit::AlwaysMultiple, _) => format!("{real} found."),
        (Fit::Finite, _) if !report.continua.is_empty() => infinitely_many(report),
        (Fit::Finite, 0) => format!("No assembly: 0 real of {} complex.", report.complex),
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
    format!(
        "{} and infinitely many connected ones at these inputs: {}.",
        count(isolated.count(), "isolated assembly"),
        listed(&sets.collect::<Vec<_>>())
    )
}

/// Where solutions meet.
fn meeting(report: &AssembliesReport) -> Option<String> {
    let mut doubles: Vec<String> = (report.assemblies.iter().filter(|a| a.multiplicity > 1))
        .map(|a| format!("mode {} is {}", a.mode, times(a.multiplicity)))
        .collect();
    match report.singular.saturating_sub(doubles.len()) {
        0 => {}
        1 => doubles.push("1 is complex".into()),
        n => doubles.push(format!("{n} are complex")),
    }
    (report.singular > 0).then(|| {
        format!(
            "solutions coincide at {}: {}",
            count(report.singular, "singular point"),
            listed(&doubles)
        )
    })
}

/// How the list was found and how complete it is.
fn accounting(report: &AssembliesReport) -> Vec<String> {
    let mut lines = vec![format!("completeness: {}", report.complete)];
    lines.extend((report.bound_source.as_ref()).map(|source| format!("bound for {source}")));
    let mut solutions = format!(
        "{} complex solutions counted with multiplicity, {} at infinity{}, {} lost",
        report.complex,
        report.at_infinity,
        match report.at_infinity {
            0 => "",
            _ => " or beyond 1000 characteristic lengths",
        },
        report.lost
    );
    if report.half_a_turn_away > 0 {
        solutions += &format!(
            "; {} with roll or yaw half a turn from what is held",
            report.half_a_turn_away
        );
    }
    if report.not_isolated > 0 {
        solutions += &format!("; {} not isolated", report.not_isolated);
    }
    lines.push(solutions);
    if report.paths > 0 {
        let retried = match report.retried {
            0 => String::new(),
            n => format!(", {n} of them repeated with smaller steps"),
        };
        lines.push(format!(
            "{} tracked in {}{retried}",
            count(report.paths, "path"),
            count(report.steps, "step")
        ));
    }
    lines.push(format!(
        "{} and {}, random seed {}",
        count(report.seeds, "Newton seed"),
        count(report.loops, "monodromy loop"),
        report.seed
    ));
    if report.assemblies.iter().any(|a| a.certified) {
        let length = quantity(report.characteristic_length, false);
        lines.push(format!(
            "a certificate proves that exactly one solution lies within its radius, in rad and, for \
             lengths, in units of {length}"
        ));
    }
    if let Some((used, all)) = report.independent_rows {
        lines.push(format!(
            "certificates use {used} independent equations of {all}"
        ));
    }
    lines
}

fn nearest(report: &AssembliesReport, closest: &ClosestApproach) -> Section {
    let worst = &closest.worst;
    let title = match closest.local_minimum {
        true => format!("Closest approach: closure {worst} has the widest gap"),
        false => format!(
            "Closest approach found, perhaps not the closest of all: closure {worst} has the widest gap"
        ),
    };
    let gaps = (closest.gaps.0.iter())
        .map(|(name, gap)| format!("{name}: {}", closing::gap(gap.distance, gap.angle)));
    let joints = closest.joints.0.iter().zip(&report.variables);
    let joints = joints.map(|((name, value), joint)| {
        format!("{name} = {}", quantity(*value, joint.unit.is_angle()))
    });
    Section::new(title).list(gaps).list(joints)
}
