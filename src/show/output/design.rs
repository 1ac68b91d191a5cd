//! Designs in words.

use super::document::{Cell, Document, Table, TableOf};
use super::quantity::{clause, form, quantity};
use super::report::{Report, Rows};
use crate::analysis::design::{
    Cognate, Defect, Design, DesignReport, Deviation, Exact, Moves, NotAll,
};
use crate::description::{count, quoted};

/// A sum of squares below this part of what was asked is met exactly.
const MET: f64 = 1e-18;

/// The designs by number with the values that vary.
fn columns<C: Into<Cell>>(
    report: &DesignReport,
    value: impl Fn(&Design, usize) -> C,
) -> TableOf<(usize, &Design)> {
    Table::of((1..).zip(&report.designs))
        .numbers("design", |(i, _)| i)
        .each(report.varied.iter().map(|of| &of.name), |(_, of), k| {
            value(of, k)
        })
}

/// The name of the goal, if there is one.
fn figure(report: &DesignReport) -> Option<&String> {
    report.goal.as_ref().map(|goal| &goal.figure)
}

/// The defects of a design, or how it moves without.
pub fn verdict(report: &DesignReport, design: &Design) -> String {
    let driver = report.driver.as_deref().unwrap_or_default();
    match design.driver {
        _ if !design.defects.is_empty() => defects(&design.defects),
        Moves::Turns => format!("good; `{driver}` turns fully"),
        Moves::Rocks => format!("good; `{driver}` rocks"),
        Moves::Unknown => "good".to_owned(),
    }
}

/// The largest deviation of each unit, and where it is.
pub fn largest(design: &Design) -> String {
    let mut largest: Vec<&Deviation> = Vec::new();
    for of in &design.deviations {
        match largest.iter_mut().find(|known| known.unit == of.unit) {
            Some(known) if of.deviation.abs() > known.deviation.abs() => *known = of,
            Some(_) => {}
            None => largest.push(of),
        }
    }
    let words: Vec<String> = largest.into_iter().map(missed).collect();
    match words.is_empty() {
        true => "0".into(),
        false => words.join(" and "),
    }
}

/// `0.0123 m (`point.x` in position 4)`
fn missed(of: &Deviation) -> String {
    let by = quantity(of.deviation.abs(), of.unit);
    format!("{by} (`{}` in position {})", of.quantity, of.position)
}

/// What comes nearest where no exact solution will do.
fn nearest(report: &DesignReport) -> String {
    let Some(of) = &report.nearest else {
        return String::new();
    };
    format!(
        " The nearest of {} in the ranges misses them by at most {}, with a sum of squares of {}.",
        count(of.starts, "random start"),
        missed(&of.largest),
        squares(of.sum_of_squares)
    )
}

/// The numbers outside of the ranges in the solution that lies least outside.
fn outside(report: &DesignReport, exact: &Exact) -> String {
    let values = exact.least_outside.iter().flatten();
    let pairs = report.varied.iter().zip(values);
    let outside = pairs.filter(|(of, value)| !(of.from..=of.to).contains(*value));
    let words: Vec<String> = outside
        .map(|(of, value)| {
            let [value, from, to] = [*value, of.from, of.to].map(|x| quantity(x, of.unit));
            format!("`{}` would be {value}, outside {from} to {to}", of.name)
        })
        .collect();
    match (words.is_empty(), exact.real) {
        (true, _) => String::new(),
        (_, 1) => format!(" There {}.", words.join(", ")),
        _ => format!(" In the one that lies least outside {}.", words.join(", ")),
    }
}

/// The value of the goal of a design, in words.
fn goal_of(report: &DesignReport, design: &Design) -> String {
    match (&report.goal, design.goal) {
        (Some(goal), Some(value)) => {
            format!(", with {} = {}", goal.figure, quantity(value, goal.unit))
        }
        (Some(goal), None) => format!("; {} is not determined everywhere", goal.figure),
        (None, _) => String::new(),
    }
}

fn answer(report: &DesignReport) -> String {
    let good = (report.designs.iter()).filter(|of| of.defects.is_empty());
    let good = good.count();
    let asked = match report.targets {
        0 => count(report.positions, "position"),
        targets => format!(
            "{} in {}",
            count(targets, "target"),
            count(report.positions, "position")
        ),
    };
    let Some(first) = report.designs.first() else {
        return match &report.exact {
            _ if report.interrupted => {
                format!("Nothing was found for {asked} before the search was stopped.")
            }
            Some(exact) if exact.real == 0 && exact.lost > 0 => {
                let nearest = nearest(report);
                format!("No real mechanism that meets {asked} was found.{nearest}")
            }
            Some(exact) if exact.different == 0 => format!(
                "No mechanism meets {asked}: all exact solutions for other targets go to infinity for these.{}",
                nearest(report)
            ),
            Some(exact) if exact.real == 0 => format!(
                "No real mechanism meets {asked}: all exact solutions found are complex.{}",
                nearest(report)
            ),
            Some(exact) => format!(
                "No mechanism in the ranges meets {asked}: {} outside.{}{}",
                match exact.real {
                    1 => "the one that does lies".to_owned(),
                    real => format!("all {real} that do lie"),
                },
                outside(report, exact),
                nearest(report)
            ),
            None => format!("Nothing was found for {asked}."),
        };
    };
    let met = match first.sum_of_squares < MET {
        true => "meets all of them".to_owned(),
        false => format!(
            "misses them by at most {}, with a sum of squares of {}",
            largest(first),
            squares(first.sum_of_squares)
        ),
    };
    if report.varied.is_empty() {
        return match good {
            0 => format!(
                "This mechanism {met} ({asked}), but {}.",
                defects(&first.defects)
            ),
            _ => format!("This mechanism {met} ({asked}), in one motion without defects."),
        };
    }
    match good {
        0 => format!(
            "No design without defects was found for {asked}; the nearest {met}, but {}.",
            defects(&first.defects)
        ),
        _ => format!(
            "{} without defects for {asked}; the best {met}{}.",
            count(good, "design"),
            goal_of(report, first)
        ),
    }
}

fn squares(sum: f64) -> String {
    match sum < 1e-30 {
        true => "0".into(),
        false => format!("{sum:.6e}"),
    }
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

/// Why random starts were searched although there are as many targets as unknowns.
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

/// The cognates of a design by their numbers in the list.
fn listed(of: &Design) -> String {
    let numbers = of.cognates.iter().map(|of| match of.design {
        Some(number) => number.to_string(),
        None => "not listed".to_owned(),
    });
    numbers.collect::<Vec<String>>().join(", ")
}

/// A cognate by its pivots and lengths.
fn cognate(of: &Cognate) -> String {
    let [a, b] = of.pivots.map(|[x, y]| format!("({x:.6}, {y:.6})"));
    let [ground, first, coupler, second] = of.lengths.map(|x| format!("{x:.6}"));
    format!(
        "pivots {a} and {b} m, ground {ground}, links {first} and {second}, coupler {coupler} m"
    )
}

/// What a design does not do, in words.
fn defects(all: &[Defect]) -> String {
    let words: Vec<String> = all.iter().map(defect).collect();
    words.join("; ")
}

fn defect(defect: &Defect) -> String {
    match defect {
        Defect::Circuit { positions } => {
            let are = are(positions);
            format!("circuit defect: {are} on another circuit than the first")
        }
        Defect::Branch { driver, positions } => {
            let are = are(positions);
            format!("branch defect: {are} beyond a dead position of `{driver}`")
        }
        Defect::Order { order } => {
            let order: Vec<String> = order.iter().map(usize::to_string).collect();
            format!(
                "order defect: the positions are passed in the order {}",
                order.join(" ")
            )
        }
        Defect::Limit { joints, positions } => {
            let (are, joints) = (are(positions), quoted(joints));
            format!("{are} not reached within the limits of {joints}")
        }
        Defect::Assembly { positions } => {
            let are = are(positions);
            format!(
                "{are} in another assembly than the one before: driven joints that move straight there end in a different one"
            )
        }
        Defect::Crossing => {
            "branches cross on the way: it can change into another motion there".into()
        }
        Defect::Motion { input, unit, at } => match at {
            Some(at) => format!("`{input}` stops at {}", quantity(*at, *unit)),
            None => format!("`{input}` does not move through its range"),
        },
        Defect::Condition {
            quantity: name,
            unit,
            bound,
            worst,
            at_least,
        } => {
            let bound = quantity(*bound, *unit);
            let sign = if *at_least { "at least" } else { "at most" };
            match worst {
                Some(worst) => format!(
                    "`{name}` shall be {sign} {bound}, and is {} at worst",
                    quantity(*worst, *unit)
                ),
                None => format!("`{name}` shall be {sign} {bound}, and is not bounded everywhere"),
            }
        }
        Defect::Tolerance { targets } => {
            let missed = targets.iter().map(|of| {
                let most = quantity(of.tolerance.unwrap_or_default(), of.unit);
                format!("{}, more than {most}", missed(of))
            });
            let missed: Vec<String> = missed.collect();
            format!("misses by {}", missed.join(" and "))
        }
        Defect::NotJudged => "its motion could not be judged".into(),
    }
}

/// `position 2 is` or `positions 2 and 3 are`
fn are(of: &[usize]) -> String {
    let positions = form(of.len(), "position", "positions");
    let numbers: Vec<String> = of.iter().map(usize::to_string).collect();
    format!("{positions} {}", clause(&numbers, "is", "are"))
}

impl Report for DesignReport {
    fn document(&self) -> Document {
        let mut document = Document::new(&self.mechanism, answer(self))
            .yes_if(self.designs.iter().any(|of| of.defects.is_empty()));
        if !self.varied.is_empty() {
            let value =
                |design: &Design, k: usize| Cell::quantity(design.values[k], self.varied[k].unit);
            let cognates = self.designs.iter().any(|of| !of.cognates.is_empty());
            let goal = |of: &Design| match (&self.goal, of.goal) {
                (Some(goal), Some(value)) => Cell::quantity(value, goal.unit),
                _ => "unknown".into(),
            };
            let table = columns(self, value)
                .numbers("sum of squares", |(_, of)| squares(of.sum_of_squares))
                .each(figure(self), |(_, of), _| goal(of))
                .each(cognates.then_some("cognates"), |(_, of), _| listed(of))
                .words("verdict", |(_, of)| verdict(self, of));
            document = document.table("Designs", table);
        }
        if let Some(first) = self.designs.first() {
            let table = Table::of(&first.deviations)
                .numbers("position", |of| of.position)
                .numbers("quantity", |of| format!("`{}`", of.quantity))
                .numbers("deviation", |of| quantity(of.deviation, of.unit));
            document = document.table("Deviations of the first", table);
        }
        let met = |of: &Design| of.sum_of_squares < MET;
        let first = self.designs.first();
        if let Some(missing) = first.filter(|of| !met(of)) {
            let pairs = self.varied.iter().zip(&missing.values);
            let ends = pairs.filter(|(of, x)| of.from < of.to && (**x == of.from || **x == of.to));
            let ends: Vec<&str> = ends.map(|(of, _)| of.name.as_str()).collect();
            if !ends.is_empty() {
                let are = ["is at an end of its range", "are at ends of their ranges"];
                document = document.note(format!(
                    "In the first {} {}: wider ones may come nearer.",
                    quoted(&ends),
                    form(ends.len(), are[0], are[1]),
                ));
            }
        }
        if let Some([one, other]) = first.map(|of| &of.cognates[..]) {
            document = document.note(format!(
                "The curve of the first is that of two more four-bars, its cognates (Roberts): {}; and {}.",
                cognate(one),
                cognate(other)
            ));
        }
        if self.undetermined > 0 && !self.varied.is_empty() && first.is_some_and(met) {
            document = document.note(format!(
                "The targets leave {} of the numbers open: more positions would fit, and these designs are some of infinitely many.",
                count(self.undetermined, "combination")
            ));
        }
        if self.interrupted {
            document = document.note("The search was stopped early.");
        }
        if self.more > 0 {
            document = document.note(format!("{} not listed.", count(self.more, "further end")));
        }
        document.method.extend(self.not_all.map(not_all));
        if self.surplus > 0 && !self.varied.is_empty() {
            document.method.push(format!(
                "There are {} more than unknowns, so that in general no mechanism meets all: of the kinds of synthesis the fit by \
                 least squares remains. For all exact designs leave as many out, or vary as many further numbers.",
                count(self.surplus, "target"),
            ));
        }
        match &self.exact {
            _ if self.varied.is_empty() => {}
            Some(exact) => document.method.extend(all_of(exact)),
            None => document.method.push(format!(
                "Least squares from {} (seed {}); {} could not be assembled in all positions. What random starts do not reach is not \
                 found; how many ends beyond the best are listed depends on the seed.",
                count(self.starts, "random start"),
                self.seed,
                count(self.not_assembled, "further start"),
            )),
        }
        let improved = self.goal.as_ref().filter(|goal| goal.improved > 0);
        document.method.extend(improved.map(|goal| {
            format!(
                "{} made as {} as it gets from {} that meet the targets, by the simplex method of Nelder and Mead in what the \
                 targets leave open, begun anew ever smaller; what it does not reach is not found.",
                goal.figure,
                if goal.greatest { "great" } else { "small" },
                count(goal.improved, "design"),
            )
        }));
        document.method.push(match self.straight_moves {
            false => "Circuits, order and dead positions from the whole curve of each mechanism, followed in steps that cannot change \
                      branch."
                .into(),
            true => "With several freedoms limits are those of the positions, and assemblies and bounds those of straight moves of the \
                     driven joints from each position to the next; between these moves nothing was looked at."
                .into(),
        });
        document
    }

    fn rows(&self) -> Option<Rows<'_>> {
        let table = columns(self, |design, k| design.values[k])
            .numbers("sum_of_squares", |(_, of)| of.sum_of_squares)
            .numbers("defects", |(_, of)| of.defects.len())
            .each(figure(self), |(_, of), _| of.goal);
        Some(table.into())
    }

    fn file(&self) -> Option<Result<String, ron::Error>> {
        self.designs.first().map(|design| Ok(design.file.clone()))
    }
}
