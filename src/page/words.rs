//! The words of the page for motions that end, and for questions that are refused with their remedies: sliders and ticks
//! in place of options.

use crate::algebra::SiUnit;
use crate::analysis::simulation::{NoSimulation, SimulationEnd, SimulationReport};
use crate::analysis::sweep::{MetKind, SweepEnd, SweepReport};
use crate::ask::{AskError, Demand, Question, Remedy, Role, Steering};
use crate::description::{ReplacementError, listed};
use crate::output::complaint::{Complaint, Door, Ranged, Wording};
use crate::output::quantity::quantity;
use crate::output::simulation::{balance, happened, sentence as of_simulation};
use crate::output::sweep::sentence;
use crate::system::QuestionError;

/// Reason for which a motion did not reach its end.
pub fn stopped(report: &SweepReport) -> Option<String> {
    let met = report.met.last().map(|met| &met.kind);
    Some(match (report.ending, met) {
        (ending, _) if ending.is_whole() => return None,
        (
            SweepEnd::Limit | SweepEnd::OutsideLimits,
            Some(MetKind::Limit {
                joint,
                limit,
                unit,
                upper,
            }),
        ) => at_limit(joint, *upper, &quantity(*limit, *unit)),
        (SweepEnd::Fold, Some(MetKind::Fold { locked, .. })) => format!(
            "A dead point of {}. Go back, drag a body across, or choose a way on.",
            listed(locked)
        ),
        (SweepEnd::Crossing | SweepEnd::SingularStart, _) => {
            "Branches meet here. Go back, drag a body the way it should go, or choose a way on."
                .into()
        }
        (SweepEnd::Lost, _) => {
            "The motion cannot be followed farther this way. Go back, or drag a body another way."
                .into()
        }
        _ => sentence(report),
    })
}

/// Reason for which the mechanism cannot be let go.
pub fn not_let_go(report: &SimulationReport) -> Option<String> {
    let SimulationEnd::NotBegun(why) = &report.end else {
        return None;
    };
    Some(match why {
        NoSimulation::Singular => {
            "Branches of motion meet here, and which one is taken is not determined. Move the mechanism a little first.".into()
        }
        NoSimulation::NoMass(names) => format!(
            "{} can move without moving any mass, so that the accelerations are not determined. Give the bodies that move a mass in \
             the file.",
            listed(names)
        ),
        _ => of_simulation(report),
    })
}

/// The motion by itself: how it ended, what happened on the way, and the balance of energies.
pub fn let_go(report: &SimulationReport) -> Vec<String> {
    /// Events that are told.
    const MOST: usize = 12;
    let ended = match report.end {
        SimulationEnd::Singular => format!(
            "After {} branches of motion meet, and which one is taken is not determined. Tick “straight on” to go through.",
            quantity(report.reached, SiUnit::SECOND)
        ),
        _ => of_simulation(report),
    };
    let events = report.events.iter().take(MOST);
    let events = events.map(|of| {
        let time = quantity(of.time, SiUnit::SECOND);
        format!("At {time} {}.", happened(of))
    });
    let more = report.events.len().saturating_sub(MOST);
    let more = (more > 0).then(|| format!("{more} further events."));
    let balance = format!("In all: {}.", balance(report));
    [ended]
        .into_iter()
        .chain(events)
        .chain(more)
        .chain([balance])
        .collect()
}

/// Reason for which a part did not follow a pointer. A pull goes round dead points: where a step ended before one, the next goes on.
pub fn pulled(report: &SweepReport) -> Option<String> {
    match report.ending {
        SweepEnd::Fold => None,
        _ => stopped(report),
    }
}

/// The joints that are at a limit, with words for it.
pub fn limits(steering: &Steering) -> Vec<(String, String)> {
    let there = steering
        .at_limits()
        .into_iter()
        .filter_map(|(joint, upper)| {
            let of = &steering.mechanism().joints()[joint];
            let (low, high) = of.limits?;
            let limit = if upper { high } else { low };
            let limit = quantity(limit, SiUnit::of_coordinate(of.kind.is_angle()));
            Some((of.name.clone(), at_limit(&of.name, upper, &limit)))
        });
    there.collect()
}

fn at_limit(joint: &str, upper: bool, limit: &str) -> String {
    let side = if upper { "upper" } else { "lower" };
    format!("{joint} is at its {side} limit of {limit}.")
}

/// Reason for which there is no answer, and the remedy.
pub fn refused(question: &Question, error: &AskError) -> String {
    match error {
        AskError::Question(QuestionError::TooMany { .. }) => {
            "More is held than the mechanism has freedoms: tick fewer values.".into()
        }
        AskError::NotAssembled(held) if !held.is_empty() => format!(
            "The mechanism does not assemble with {} at these values.",
            listed(held)
        ),
        _ => {
            let wording = Wording {
                door: &ByHand,
                ranged: Ranged::Input,
            };
            in_a_line(wording.asked(question, error))
        }
    }
}

/// A complaint with its remedy.
pub fn in_a_line(said: Complaint) -> String {
    match said.help {
        Some(help) => format!("{}; {help}", said.title),
        None => said.title,
    }
}

/// Reason for which a parameter cannot have a value.
pub fn parameter(name: &str, value: &str, error: &ReplacementError) -> String {
    match error {
        ReplacementError::Value(problems) if !problems.is_empty() => {
            format!(
                "{name} = {value}: {}",
                in_a_line(Complaint::of(&problems[0]))
            )
        }
        _ => error.to_string(),
    }
}

/// The page, where coordinates are held, let go and moved by hand.
pub struct ByHand;

impl Door for ByHand {
    fn option(&self, role: Role, _: Ranged) -> String {
        role.word().into()
    }

    fn remedies(&self, remedies: &[Remedy], _: Ranged) -> String {
        let words: Vec<String> = remedies.iter().map(words).collect();
        words.join(" and ")
    }
}

fn words(remedy: &Remedy) -> String {
    match remedy {
        Remedy::Demand(demand) => demanded(demand),
        Remedy::Role(role) => format!("“{}”", role.word()),
        Remedy::Setting(setting, None) => format!("“{setting}”"),
        Remedy::Setting(setting, Some(value)) => format!("“{setting}” {value}"),
        Remedy::Analysis(analysis, _) => format!("“{analysis}”"),
    }
}

fn demanded(demand: &Demand) -> String {
    let Demand { role, name, .. } = demand;
    match (role, demand.written()) {
        (Role::Free, _) => format!("let go of {name}"),
        (Role::Hold, Some(value)) if value == "home" => format!("hold {name}"),
        (Role::Hold, Some(value)) => format!("hold {name} at {value}"),
        (Role::Input, Some(range)) => format!("move {name} over {range}"),
        (role, Some(value)) => format!("{} {name} = {value}", role.word()),
        (role, None) => format!("{} {name}", role.word()),
    }
}
