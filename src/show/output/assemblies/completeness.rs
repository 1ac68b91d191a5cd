//! Completeness of a list of assemblies, and the course of the search.

use super::proof;
use crate::analysis::assemblies::{AssembliesReport, Fit};
use crate::description::count;
use crate::linear::RANK_TOLERANCE;
use crate::output::quantity::{form, metres};

/// Completeness of the list and its reasons, in a sentence.
pub fn completeness(report: &AssembliesReport) -> String {
    let proved = (report.proof.as_ref()).filter(|proof| proof.is_complete());
    match (proved.map(proof::completeness), &report.fit) {
        (None, _) => searched(report),
        (Some(proved), Fit::Finite) => {
            format!("{proved}; of all complex solutions, {}", searched(report))
        }
        (Some(proved), _) => proved,
    }
}

fn searched(report: &AssembliesReport) -> String {
    if report.interrupted {
        return format!(
            "interrupted with {} found after {} and {}: assemblies may be missing",
            count(report.generic, "generic solution"),
            count(report.search.seeds, "seed"),
            count(report.search.loops, "loop"),
        );
    }
    match report.fit {
        Fit::Finite => {}
        Fit::FreedomLeft(freedom) => {
            let isolated = match report.generic {
                0 => "",
                1 => "; 1 isolated solution was found beside them",
                n => &format!("; {n} isolated solutions were found beside them"),
            };
            return format!(
                "with {} left, assemblies are in general not finite in number, and any list of them \
                 consists of samples{isolated}; hold {freedom} more {} for a finite list",
                count(freedom, "freedom"),
                form(freedom, "coordinate", "coordinates"),
            );
        }
        Fit::Endless => {
            return "no list of infinitely many solutions can be complete; this one comes from random starts at \
                    the values held, and others may be missing"
                .into();
        }
        Fit::TooManyHeld => {
            return format!(
                "no solution was found for complex inputs nearby: either more is held than can be \
                 chosen freely, and something must be freed, or the dimensions differ too much in size, \
                 and those far below or above {0} m must be changed (what is smaller than \
                 {RANK_TOLERANCE:e} of {0} m has no effect); the list comes from many starts and may be \
                 incomplete",
                report.characteristic_length
            );
        }
        Fit::AlwaysMultiple => {
            return "every solution that was found is multiple for all inputs, as in a shaky \
                    structure, and cannot be followed from input to input; the list comes from many \
                    starts and may be incomplete"
                .into();
        }
    }
    let loops = count(report.search.quiet_loops, "loop");
    let mut quiet = match report.search.lost_in_loops {
        0 => format!("{loops} without a lost path"),
        n => format!("{loops}, each with {} at most,", count(n, "lost path")),
    };
    let seeds = count(report.search.quiet_seeds, "seed");
    quiet = match (report.search.loops, report.search.quiet_seeds) {
        (0, _) => format!(
            "no number of this mechanism can be varied to lead from one solution to another; {seeds}"
        ),
        (_, 0) => quiet,
        _ => format!("{quiet} and {seeds}"),
    };
    let bound = match report.bound {
        Some(bound) if bound == report.generic => {
            format!("equals the known bound of {bound} for this structure")
        }
        Some(bound) => format!("no more than {bound} are possible for this structure"),
        None => "no bound is known for this structure".into(),
    };
    let flips = report.flips.unwrap_or(1);
    let found = match flips {
        1 => format!("{} found", report.generic),
        flips => format!(
            "{} found, {} with universal joints in {flips} ways each",
            report.generic,
            count(report.generic / flips, "pose")
        ),
    };
    let mut parts = match report.search.general {
        Some(infinite) => vec![
            found,
            format!(
                "the 40 poses of a general platform on six rods lead to {}, and no others are isolated",
                match infinite {
                    0 => "these".into(),
                    n => format!("{} here and {n} at infinity", 40 - n),
                }
            ),
        ],
        None if report.search.traced => vec![
            found,
            "the trace test holds for the length of one rod with all points of its cut: no solution that this length \
             moves is missing"
                .into(),
        ],
        None if report.bound == Some(report.generic) => vec![found, bound],
        None => vec![found, format!("{quiet} found no more"), bound],
    };
    if report.search.lost_in_loops > 0 {
        parts.push("solutions whose paths every loop lost may be missing".into());
    }
    if report.search.refuted {
        parts.push(
            "a trace test over the length of one rod failed at every member that was searched: solutions, or points of its cut, \
             are missing"
                .into(),
        );
    }
    if report.search.exhausted {
        parts.push("the search ended at its limits and there may be more".into());
    }
    if let Some(largest) = report.continua.first() {
        parts.push(format!(
            "at these inputs there are infinitely many assemblies, in a set of dimension {}: what is said \
             of the list holds for isolated ones, and of the others it has samples only",
            largest.dimension
        ));
    }
    if report.search.multiple > 0 {
        parts.push(
            "some solutions are multiple for all inputs: these were sought from many starts only, and \
             some of them may be missing"
                .into(),
        );
    }
    if report.unexpected > 0 {
        parts.push(format!(
            "no path led to {} found from other starts: the list may be incomplete",
            count(report.unexpected, "assembly")
        ));
    }
    if report.conjugates > 0 {
        parts.push(format!(
            "{} to which no path led {} the conjugate of another one: the search missed as many, and \
             others may be missing",
            count(report.conjugates, "complex solution"),
            form(report.conjugates, "is", "are each")
        ));
    }
    if report.lost > 0 {
        parts.push(format!(
            "the {} of {} could not be decided: the list may be incomplete",
            form(report.lost, "end", "ends"),
            count(report.lost, "path")
        ));
    }
    parts.join("; ")
}

pub(super) fn accounting(report: &AssembliesReport) -> Vec<String> {
    let mut lines = vec![format!("completeness: {}", completeness(report))];
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
            "; {} with roll or yaw half a turn from the held value",
            report.half_a_turn_away
        );
    }
    if report.not_isolated > 0 {
        solutions += &format!("; {} not isolated", report.not_isolated);
    }
    if report.fit != Fit::Endless {
        lines.push(solutions);
    }
    if report.paths > 0 {
        let retried = match report.retried {
            0 => String::new(),
            n => format!(", with {} by smaller steps", count(n, "repetition")),
        };
        lines.push(format!(
            "{} tracked in {}{retried}",
            count(report.paths, "path"),
            count(report.steps, "step")
        ));
    }
    lines.push(format!(
        "{} and {}, random seed {}",
        count(report.search.seeds, "Newton seed"),
        count(report.search.loops, "monodromy loop"),
        report.search.seed
    ));
    if report.search.related {
        lines.push(
            "the search varied dimensions with their relations kept as parameters and expressions give them: the mechanism may \
             need them to close"
                .into(),
        );
    }
    if report.assemblies.iter().any(|a| a.certified) {
        let length = metres(report.characteristic_length);
        lines.push(format!(
            "a certificate proves that exactly one solution lies within its radius, in rad and, for \
             lengths, in units of {length}"
        ));
    }
    lines.extend(report.proof.iter().flat_map(proof::method));
    if let Some((used, all)) = report.independent_rows {
        lines.push(format!(
            "certificates use {used} independent equations of {all}"
        ));
    }
    lines
}
