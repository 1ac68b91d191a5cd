//! Simulated motions as documents and rows.

use super::assembly_remarks;
use super::document::{Cell, Document, Section, Table};
use super::quantity::{Quantified, bound, number, quantity};
use super::report::{Report, Rows};
use crate::algebra::SiUnit;
use crate::analysis::simulation::{
    Happened, Linear, NoSimulation, SimulationEnd, SimulationEvent, SimulationReport,
};
use crate::description::{count, listed};
use crate::system::NamedUnit;

impl Report for SimulationReport {
    fn document(&self) -> Document {
        let answer = assembly_remarks::after_moving(self.pose.moved.as_ref(), sentence(self));
        let document = Document::new(&self.mechanism, answer)
            .yes_if([SimulationEnd::Over, SimulationEnd::Linearised].contains(&self.end))
            .warnings(assembly_remarks::outside_limits(&self.pose.outside_limits))
            .notes(assembly_remarks::notes(&self.pose));
        if self.rows.is_empty() {
            return document;
        }
        if let Some(linear) = &self.linear {
            return document.sections(linearised(linear));
        }
        let kind = match self.stiff {
            true => " (stiff: implicit steps of order 5)",
            false => "",
        };
        document
            .note(balance(self))
            .sections((!self.events.is_empty()).then(|| events(&self.events)))
            .sections([motion(self)])
            .method(format!(
                "{} of the integrator{kind}; closures open by less than {} at the rows",
                count(self.steps, "step"),
                bound(self.residual)
            ))
    }

    fn rows(&self) -> Option<Rows<'_>> {
        let rows = self.rows.iter();
        let rows = rows.map(|row| row.iter().map(|x| Cell::from(*x)).collect());
        Some(Rows::new(self.columns.iter().map(Quantified::head), rows))
    }
}

/// The end of a simulation in a sentence.
pub fn sentence(report: &SimulationReport) -> String {
    let time = quantity(report.reached, SiUnit::SECOND);
    let freedoms = count(report.freedoms, "freedom");
    match &report.end {
        SimulationEnd::Over if report.freedoms == 0 => format!("Moves for {time} as it is driven."),
        SimulationEnd::Over => format!("Moves for {time} with {freedoms}."),
        SimulationEnd::Linearised => {
            format!("Linearised at the start, with {freedoms}: x' = f + A dx + B u, y = y0 + C dx.")
        }
        SimulationEnd::Interrupted => format!("Interrupted after {time} of motion."),
        SimulationEnd::Limit { joint, limit, unit } => {
            let limit = quantity(*limit, *unit);
            format!("After {time} {joint} is at its limit of {limit}, and the simulation ends.")
        }
        SimulationEnd::Singular => format!(
            "After {time} the configuration is singular: branches of motion meet, and which one is taken is \
             not determined. `--through` goes on straight."
        ),
        SimulationEnd::Stuck => format!(
            "After {time} no further step is possible: a force has no value there, or the motion ends."
        ),
        SimulationEnd::NotBegun(why) => not_begun(why),
    }
}

fn not_begun(why: &NoSimulation) -> String {
    match why {
        NoSimulation::Structure => "Nothing can move.".into(),
        NoSimulation::Singular => {
            "The start is singular: branches of motion meet there, and which one is taken \
             is not determined. Start slightly away from it, e.g. with --hold."
                .into()
        }
        NoSimulation::NoCoordinates => {
            "No joints and platform coordinates determine the motion near the start.".into()
        }
        NoSimulation::NoMass(names) => format!(
            "{} can move without moving any mass, so that the accelerations are not determined. Give the bodies \
             that move a mass, or lock these with --lock.",
            listed(names)
        ),
        NoSimulation::Rates => {
            "The rates cannot be had together: the closures tie these coordinates.".into()
        }
        NoSimulation::NoForce => "A force has no value at the start.".into(),
    }
}

/// The energies of a simulation and their balance.
pub fn balance(report: &SimulationReport) -> String {
    let energy = &report.energy;
    let joules = |x: f64| format!("{} J", number(x));
    let lost = match energy.lost > 0.0 {
        true => format!(", {} lost in impacts", joules(energy.lost)),
        false => String::new(),
    };
    let corrected = match energy.corrected > 0.0 {
        true => format!(
            ", where rates were corrected by {} J in all",
            bound(energy.corrected)
        ),
        false => String::new(),
    };
    format!(
        "kinetic and potential energy {} at the start, {} at the end, work of forces and dampers {}{lost}; \
         the balance is kept within {} J at every row{corrected}; kinetic energy up to {}",
        joules(energy.start),
        joules(energy.end),
        joules(energy.supplied),
        bound(energy.error),
        joules(energy.kinetic)
    )
}

/// The matrices of linear equations, with f beside A; D is zero.
fn linearised(of: &Linear) -> [Section; 3] {
    let matrix = |title: &str, rows: &[String], columns: &[String], entries: &[Vec<f64>]| {
        let table = Table::of(rows.iter().zip(entries)).words("", |(name, _)| name);
        Section::new(title).table(table.each(columns, |(_, row), i| row[i]))
    };
    let heads = |of: &Vec<NamedUnit>| of.iter().map(Quantified::head).collect::<Vec<_>>();
    let [states, inputs, outputs] = [&of.states, &of.inputs, &of.outputs].map(heads);
    let rates: Vec<String> = states.iter().map(|name| format!("d/dt {name}")).collect();
    let widened = |(row, f): (&Vec<f64>, &f64)| row.iter().chain([f]).copied().collect();
    let with_f: Vec<Vec<f64>> = of.a.iter().zip(&of.change).map(widened).collect();
    let with_name: Vec<String> = states.iter().cloned().chain(["f".into()]).collect();
    [
        matrix("A, and f", &rates, &with_name, &with_f),
        matrix("B", &rates, &inputs, &of.b),
        matrix("C", &outputs, &states, &of.c),
    ]
}

/// An event of a simulation in words.
pub fn happened(of: &SimulationEvent) -> String {
    match &of.event {
        Happened::Impact { joint, loss, .. } => {
            format!(
                "{joint} comes back from its limit; {} J lost",
                number(*loss)
            )
        }
        Happened::Sticks { joint } => format!("{joint} rests, held by friction"),
        Happened::Slips { joint } => format!("{joint} slips"),
        Happened::Rests { joint, loss, .. } => {
            format!(
                "{joint} comes to rest on its limit; {} J lost",
                number(*loss)
            )
        }
        Happened::Leaves { joint } => format!("{joint} leaves its limit"),
        Happened::Singular => "branches of motion meet; it goes straight through".into(),
    }
}

fn events(events: &[SimulationEvent]) -> Section {
    let table = Table::of(events);
    let table = table.numbers("t", |of| Cell::quantity(of.time, SiUnit::SECOND));
    Section::new("Events").table(table.words("", happened))
}

/// Rows shown at most; more are thinned evenly.
const SHOWN: usize = 21;

fn motion(report: &SimulationReport) -> Section {
    let every = report.rows.len().div_ceil(SHOWN).max(1);
    let last = report.rows.len() - 1;
    let rows = report.rows.iter().enumerate();
    let rows = rows.filter(|(i, _)| i % every == 0 || *i == last);
    let table = Table::of(rows).quantities(&report.columns, |(_, row), i| row[i]);
    Section::new("Motion").table(table)
}
