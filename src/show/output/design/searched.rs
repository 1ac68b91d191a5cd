//! Searches for designs in words: how complete their lists are.

use crate::analysis::design::{DesignReport, Exact, Goal, Listed, NotAll};
use crate::description::count;

/// The search for designs, in sentences.
pub(super) fn searched(report: &DesignReport) -> Vec<String> {
    let mut said: Vec<String> = report.not_all.map(not_all).into_iter().collect();
    if report.varied.is_empty() {
        return said;
    }
    if report.surplus > 0 {
        said.push(format!(
            "There are {} more than unknowns, so that in general no mechanism meets all: of the kinds of synthesis the fit by \
             least squares remains. For all exact designs leave as many out, or vary as many further numbers.",
            count(report.surplus, "target"),
        ));
    }
    match &report.exact {
        Some(exact) => said.extend(all_of(exact)),
        None => said.push(format!(
            "Least squares from {} (seed {}); {} could not be assembled in all positions. What random starts do not reach is not \
             found; how many ends beyond the best are listed depends on the seed.",
            count(report.starts, "random start"),
            report.seed,
            count(report.not_assembled, "further start"),
        )),
    }
    said.extend(report.listed.as_ref().map(listed));
    said.extend(improved(report));
    said
}

/// The choice of listed values.
fn listed(of: &Listed) -> String {
    format!(
        "Numbers with lists were fitted freely first; then from {} one after another was kept at each of the {} listed values \
         nearest to its own and the others were fitted again, least sums of squares first: {}, of which {} could not be assembled. \
         {} of {} listed values {} completed{}; the others were not tried.",
        count(of.begun, "such design"),
        Listed::NEAREST,
        count(of.fits, "fit"),
        of.lost,
        of.completed,
        match of.combinations {
            1.0 => "1 combination of".to_owned(),
            all => format!("{all} combinations of"),
        },
        if of.completed == 1 { "was" } else { "were" },
        if of.exhausted {
            ""
        } else {
            ", the best by these sums"
        },
    )
}

/// The improvement of goals.
fn improved(report: &DesignReport) -> Option<String> {
    let how = |goal: &Goal| {
        let how = if goal.greatest { "great" } else { "small" };
        format!("{} made as {how} as it gets", goal.figure)
    };
    let first = report.goal.as_ref().filter(|goal| goal.improved > 0)?;
    let front = report.second_goal.as_ref().map(|second| {
        format!(
            "; {}; then the first again with the second bounded at evenly spaced values between (Haimes, Lasdon and Wismer 1971), \
             beginning at the best designs before",
            how(second)
        )
    });
    Some(format!(
        "{} from {} that meet the targets, by the simplex method of Nelder and Mead in what the targets leave open, begun anew \
         ever smaller{}; what it does not reach is not found.",
        how(first),
        count(first.improved, "design"),
        front.unwrap_or_default(),
    ))
}

/// The completeness of an exact synthesis, in sentences.
fn all_of(exact: &Exact) -> Vec<String> {
    if let Some(triples) = &exact.triples {
        let lost = match exact.lost {
            0 => String::new(),
            lost => format!(", {} lost on every way", count(lost, "path")),
        };
        return vec![
            format!(
                "For generic points {} of cognates, {} with either link driving (Wampler, Morgan and Sommese 1992): found by \
                 monodromy, and stored with the program.",
                count(triples.generic, "triple"),
                count(exact.generic, "four-bar"),
            ),
            format!(
                "For these points {} of {} arrived, {} went to infinity{lost}: {} different, {} real; of their {} {} outside the \
                 ranges.",
                exact.arrived,
                count(triples.generic, "path"),
                exact.at_infinity,
                count(triples.different, "triple"),
                triples.real,
                count(exact.real, "four-bar"),
                exact.outside,
            ),
        ];
    }
    if exact.quiet == 0 {
        return vec![format!(
            "Stopped while all solutions for generic targets were sought, of which {} had been found; none was followed to these \
             targets.",
            exact.classes,
        )];
    }
    let linkages = match exact.classes == exact.generic {
        true => String::new(),
        false => format!(
            " ({} with those that differ by signs of lengths, senses of axes or an exchange of links only)",
            count(exact.generic, "complex solution"),
        ),
    };
    let lost = match exact.lost {
        0 => String::new(),
        lost => format!(
            ", {} to a singular solution or lost on {} ways",
            count(lost, "path"),
            Exact::WAYS
        ),
    };
    vec![
        format!(
            "For generic targets {}{linkages}: found by monodromy, and {} through other targets, on which {} lost, brought \
             none beside them. A random way finds more with probability ½ at least if any that are connected with these \
             are missing; no bound is known.",
            count(exact.classes, "linkage"),
            count(exact.quiet, "random way"),
            match exact.lost_quietly {
                0 => "no path was".to_owned(),
                1 => "1 path was".to_owned(),
                lost => format!("{lost} paths were"),
            },
        ),
        format!(
            "For these targets {} arrived, {} went to infinity{lost}: {} different, {} real, {} of these outside the ranges.",
            count(exact.arrived, "path"),
            exact.at_infinity,
            count(exact.different, "linkage"),
            exact.real,
            exact.outside,
        ),
    ]
}

/// The reason for a search from random starts although there are as many targets as unknowns.
fn not_all(why: NotAll) -> String {
    match why {
        NotAll::More { than } => format!(
            "There are more than {than} linkages for generic targets: not all were sought, but least squares were made small."
        ),
        NotAll::Lost { found } => format!(
            "The search for all solutions lost paths on every way through other targets, with {} found for generic targets: least \
             squares were made small instead.",
            count(found, "linkage")
        ),
    }
}
