//! Designs in words.

mod defects;
mod picture;
mod searched;

pub use picture::{front, panel, panels_moving};

use super::document::{Cell, Document, Table, TableOf};
use super::quantity::{form, quantity};
use super::report::{Report, Rows};
use crate::analysis::design::{Cognate, DesignReport, Deviation, Exact, FoundDesign, Goal, Moves};
use crate::description::{count, quoted};
use crate::number::tolerance::ROUNDING;
use defects::{defects, missed};

/// True if a design meets all targets but for rounding.
fn meets(of: &FoundDesign) -> bool {
    of.sum_of_squares < ROUNDING * ROUNDING
}

/// Designs in a table at most.
const SHOWN: usize = 10;

/// So many of the designs by number with the values that vary.
fn columns<C: Into<Cell>>(
    report: &DesignReport,
    shown: usize,
    value: impl Fn(&FoundDesign, usize) -> C,
) -> TableOf<(usize, &FoundDesign)> {
    Table::of((1..).zip(report.designs.iter().take(shown)))
        .numbers("design", |(i, _)| i)
        .each(report.varied.iter().map(|of| &of.name), |(_, of), k| {
            value(of, k)
        })
}

/// The goals.
fn goals(report: &DesignReport) -> impl Iterator<Item = &Goal> + Clone {
    report.goal.iter().chain(&report.second_goal)
}

/// The names of the goals.
fn figures(report: &DesignReport) -> impl Iterator<Item = &String> {
    goals(report).map(|goal| &goal.figure)
}

/// The values of a design for the goals.
fn worth(of: &FoundDesign) -> [Option<f64>; 2] {
    [of.goal, of.second_goal]
}

/// The defects of a design, or how it moves without.
pub fn verdict(report: &DesignReport, design: &FoundDesign) -> String {
    let driver = report.driver.as_deref().unwrap_or_default();
    match design.driver {
        _ if !design.defects.is_empty() => defects(&design.defects),
        Moves::Turns => format!("good; `{driver}` turns fully"),
        Moves::Rocks => format!("good; `{driver}` rocks"),
        Moves::Unknown => "good".to_owned(),
    }
}

/// The largest deviation of each unit, and where it is.
pub fn largest(design: &FoundDesign) -> String {
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

/// The nearest design where no exact solution will do.
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
fn goal_of(report: &DesignReport, design: &FoundDesign) -> String {
    if report.second_goal.is_some() && report.exact.is_none() {
        return ", and none is beaten by another one in both goals".into();
    }
    let said = goals(report)
        .zip(worth(design))
        .map(|(goal, value)| match value {
            Some(value) => format!(", with {} = {}", goal.figure, quantity(value, goal.unit)),
            None => format!("; {} is not determined everywhere", goal.figure),
        });
    said.collect()
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
    let met = match meets(first) {
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

/// The cognates of a design by their numbers in the list.
fn listed(of: &FoundDesign) -> String {
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

impl Report for DesignReport {
    fn document(&self) -> Document {
        let mut document = Document::new(&self.mechanism, answer(self))
            .yes_if(self.designs.iter().any(|of| of.defects.is_empty()));
        if !self.varied.is_empty() {
            let value = |design: &FoundDesign, k: usize| {
                Cell::quantity(design.values[k], self.varied[k].unit)
            };
            let cognates = self.designs.iter().any(|of| !of.cognates.is_empty());
            let goal = |of: &FoundDesign, k: usize| match (goals(self).nth(k), worth(of)[k]) {
                (Some(goal), Some(value)) => Cell::quantity(value, goal.unit),
                _ => "unknown".into(),
            };
            let table = columns(self, SHOWN, value)
                .numbers("sum of squares", |(_, of)| squares(of.sum_of_squares))
                .each(figures(self), |(_, of), k| goal(of, k))
                .each(cognates.then_some("cognates"), |(_, of), _| listed(of))
                .words("verdict", |(_, of)| verdict(self, of));
            let title = match self.designs.len() {
                all if all > SHOWN => {
                    format!("Designs, {SHOWN} of {all}; CSV and JSON have all of them")
                }
                _ => "Designs".into(),
            };
            document = document.table(&title, table);
        }
        if let Some(first) = self.designs.first() {
            let table = Table::of(&first.deviations)
                .numbers("position", |of| of.position)
                .numbers("quantity", |of| format!("`{}`", of.quantity))
                .numbers("deviation", |of| quantity(of.deviation, of.unit));
            document = document.table("Deviations of the first", table);
        }
        let first = self.designs.first();
        if let Some(missing) = first.filter(|of| !meets(of)) {
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
        if self.undetermined > 0 && !self.varied.is_empty() && first.is_some_and(meets) {
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
        document.method.extend(searched::searched(self));
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
        let table = columns(self, usize::MAX, |design, k| design.values[k])
            .numbers("sum_of_squares", |(_, of)| of.sum_of_squares)
            .numbers("defects", |(_, of)| of.defects.len())
            .each(figures(self), |(_, of), k| worth(of)[k]);
        Some(table.into())
    }

    fn file(&self) -> Option<Result<String, ron::Error>> {
        self.designs.first().map(|design| Ok(design.file.clone()))
    }
}
