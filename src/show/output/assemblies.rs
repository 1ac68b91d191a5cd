//! All assemblies of a mechanism as a document.

mod completeness;
mod lost;
mod proof;

mod tables;

pub use completeness::completeness;
pub(crate) use proof::reason;

use super::assembly_remarks;
use super::document::{Document, Section};
use super::quantity::{are, clause, form, values};
use super::report::{Remarks, Report};
use crate::analysis::assemblies::{AssembliesReport, ClosestApproach, Continuum, Fit};
use crate::description::{count, listed};
use completeness::accounting;
use tables::{
    PoseGroup, are_posed, by_pose, complex, joints, met, overview, platforms, poses, reasons,
};

impl Report for AssembliesReport {
    fn document(&self) -> Document {
        let nearest = self.closest.iter().map(|closest| nearest(self, closest));
        let proved = self.proof.iter().map(|of| proof::sentence(of, self.real));
        let answer: Vec<String> = [sentence(self)].into_iter().chain(proved).collect();
        let remarks = Remarks {
            complete: Some(completeness(self)),
            ..Remarks::default()
        };
        let document = Document::new(&self.mechanism, answer.join(" "))
            .yes_if(self.real > 0 && !self.may_lack_some())
            .remarks(remarks)
            .interrupted(self.interrupted, "")
            .notes(meeting(self))
            .notes(self.proof.iter().flat_map(proof::notes))
            .section(listing(self))
            .sections(joints(self))
            .sections(platforms(self))
            .section(reasons(self))
            .section(complex(self))
            .sections(self.proof.iter().flat_map(proof::sections))
            .sections(nearest);
        accounting(self)
            .into_iter()
            .fold(document, Document::method)
    }
}

/// Table with a row for each assembly, or for each pose where assemblies share poses.
fn listing(report: &AssembliesReport) -> Section {
    match poses(report) {
        Some(poses) => Section::new(format!("Assemblies by the {}", posed(report, &poses)))
            .table(by_pose(&poses)),
        None => Section::new("Assemblies").table(overview(report)),
    }
}

fn sentence(report: &AssembliesReport) -> String {
    let real = count(report.real, "assembly");
    match (&report.fit, report.real) {
        (_, 0) if report.interrupted => "No assembly was found.".into(),
        _ if report.interrupted => sampled(report).unwrap_or_else(|| found(report.real)),
        (Fit::FreedomLeft(_), 0) => "No assembly was found.".into(),
        (Fit::FreedomLeft(freedom), _) => {
            let left = format!("{} left with what is held", are(*freedom, "freedom"));
            let isolated = isolated(report);
            if isolated == report.real {
                let (found, each) = (found(isolated), form(isolated, "It", "Each"));
                let limit = "at the limit of what is possible";
                return format!("{found} {each} is isolated, {limit}; in general {left}.");
            }
            if report.continua.iter().all(|set| set.dimension < *freedom) {
                let sets = infinitely_many(report);
                let sets = sets.trim_end_matches('.');
                return format!("{sets}, at the limit of what is possible; in general {left}.");
            }
            let listed = match report.real - isolated {
                _ if isolated == 0 => {
                    let samples = form(report.real, "a sample", "samples");
                    format!("{} listed as {samples}", are(report.real, "assembly"))
                }
                samples => format!(
                    "{} and {} of the others are listed",
                    count(isolated, "isolated assembly"),
                    count(samples, "sample")
                ),
            };
            format!("Infinitely many assemblies: {left}. {listed}.")
        }
        (Fit::Endless, n) => {
            let winding = report.variables.iter().filter(|joint| joint.winding);
            let winding: Vec<&str> = winding.map(|joint| joint.name.as_str()).collect();
            let because = match winding.is_empty() {
                true => String::new(),
                false => format!(
                    ", because {} differently after every turn",
                    clause(&winding, "stands", "stand")
                ),
            };
            let are = form(n, "is", "are");
            let listed = match n {
                0 => "none was found to be real".to_owned(),
                _ => format!("{real}, found from random starts, {are} listed"),
            };
            let infinite = "Solutions are infinite in number, whatever values are held";
            format!("{infinite}{because}: {listed}.")
        }
        (Fit::TooManyHeld | Fit::AlwaysMultiple, _) => {
            sampled(report).unwrap_or_else(|| found(report.real))
        }
        (Fit::Finite, _) if !report.continua.is_empty() => infinitely_many(report),
        (Fit::Finite, 0) => format!("No assembly: 0 real of {} complex.", report.complex),
        (Fit::Finite, _) => match sets_of_angles(report) {
            Some((sets, complex)) => {
                let assemblies = report.positions.len();
                let poses = match (2..assemblies).contains(&report.poses.len()) {
                    true => format!(" in {} of the platforms", count(report.poses.len(), "pose")),
                    false => String::new(),
                };
                format!(
                    "{}{poses}: {assemblies} real of {complex} complex. {} is listed with {sets} sets of joint angles, \
                     because a ball written as three rows has two for each of its orientations.",
                    count(assemblies, "assembly"),
                    form(assemblies, "It", "Each"),
                )
            }
            None => {
                let poses = poses(report).map(|poses| format!(" in {}", posed(report, &poses)));
                let (real, complex) = (report.real, report.complex);
                let poses = poses.unwrap_or_default();
                format!(
                    "{}{poses}: {real} real of {complex} complex.",
                    count(real, "assembly")
                )
            }
        },
    }
}

/// The number of sets of angles of each assembly, where it is the same for all, and of complex assemblies that differ in
/// more than such sets.
fn sets_of_angles(report: &AssembliesReport) -> Option<(usize, usize)> {
    let sets = report.positions.first()?.len();
    let alike = report.positions.iter().all(|modes| modes.len() == sets);
    (alike && report.complex.is_multiple_of(sets)).then(|| (sets, report.complex / sets))
}

fn posed(report: &AssembliesReport, poses: &[PoseGroup<'_>]) -> String {
    let poses = count(poses.len(), "pose");
    format!("{poses} of the {}", are_posed(report))
}

fn found(assemblies: usize) -> String {
    let were = form(assemblies, "was", "were");
    format!("{} {were} found.", count(assemblies, "assembly"))
}

fn isolated(report: &AssembliesReport) -> usize {
    let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
    isolated.count()
}

/// The answer where samples of connected assemblies were met and nothing is known of their sets.
fn sampled(report: &AssembliesReport) -> Option<String> {
    let samples = report.assemblies.iter().filter(|a| a.multiplicity == 0);
    let samples = samples.count();
    let isolated = match report.real - samples.min(report.real) {
        0 => String::new(),
        n => format!(" and {}", count(n, "isolated assembly")),
    };
    let (samples_said, are) = (count(samples, "sample"), form(report.real, "is", "are"));
    (samples > 0)
        .then(|| format!("Infinitely many assemblies: {samples_said}{isolated} {are} listed."))
}

/// The answer where assemblies are connected at the inputs asked.
fn infinitely_many(report: &AssembliesReport) -> String {
    let sets = report.continua.iter().map(|set: &Continuum| {
        // a path may stand for several solutions, and be followed again for each
        let dimension = set.dimension;
        let lead = match set.paths {
            0 => String::new(),
            n => format!(
                " to which {} {}",
                count(n, "complex solution"),
                form(n, "leads", "lead")
            ),
        };
        match set.samples.len() {
            0 => format!(
                "a complex set of dimension {dimension}{lead}, in which nothing real was found"
            ),
            n => format!(
                "a set of dimension {dimension}{lead}, with {}",
                count(n, "sample")
            ),
        }
    });
    let isolated = match isolated(report) {
        0 => "Infinitely many connected assemblies".into(),
        n => format!(
            "{} and infinitely many connected ones",
            count(n, "isolated assembly")
        ),
    };
    format!("{isolated} at these inputs: {}.", listed(sets))
}

fn meeting(report: &AssembliesReport) -> Option<String> {
    let mut doubles: Vec<String> = (report.assemblies.iter().filter(|a| a.multiplicity > 1))
        .map(|a| format!("mode {} is {}", a.mode, met(report, a.multiplicity)))
        .collect();
    match report.singular.saturating_sub(doubles.len()) {
        0 => {}
        1 => doubles.push("1 is complex".into()),
        n => doubles.push(format!("{n} are complex")),
    }
    let counted = !matches!(report.fit, Fit::FreedomLeft(_));
    (report.singular > 0 && counted).then(|| {
        let points = count(report.singular, "singular point");
        format!("solutions coincide at {points}: {}", listed(&doubles))
    })
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
        .map(|(name, gap)| format!("{name}: {}", assembly_remarks::gap(gap.distance, gap.angle)));
    let joints = values(&report.variables, closest.joints.values());
    let squared = (closest.squared_lengths).then(|| assembly_remarks::SQUARED_LENGTHS.to_owned());
    Section::new(title).list(gaps).list(joints).list(squared)
}
