//! Rest positions as documents.

use super::assembly_remarks;
use super::document::{Cell, Document, Section, Table};
use super::drawing::Panel;
use super::quantity::{bound, if_any, number, quantity};
use super::report::Report;
use super::statics::EFFORTS;
use crate::algebra::SiUnit;
use crate::analysis::equilibrium::{
    AllRest, EquilibriumReport, NaturalMode, NoRest, RestPosition, Stability, Stiffness,
};
use crate::description::{count, listed};
use crate::mechanism::{Configuration, Mechanism};
use crate::scene::Scene;
use crate::system::NotAlgebraic;

impl Report for EquilibriumReport {
    fn document(&self) -> Document {
        let answer = assembly_remarks::after_moving(self.pose.moved.as_ref(), sentence(self));
        let several = self.positions.len() > 1;
        let sections = self.positions.iter().enumerate().map(|(i, of)| {
            let title = match several {
                true => format!("Rest position {}: {}", i + 1, stability(of)),
                false => "Rest position".into(),
            };
            position(self, of, Section::new(title))
        });
        Document::new(&self.mechanism, answer)
            .yes_if(!self.positions.is_empty())
            .interrupted(self.interrupted, "")
            .notes(assembly_remarks::notes(&self.pose))
            .notes(self.complete.iter().map(|of| completeness(of, self.seed)))
            .notes(self.not_algebraic.iter().map(not_algebraic))
            .sections(sections)
    }
}

fn sentence(report: &EquilibriumReport) -> String {
    if let Some(why) = report.none {
        return none(why).into();
    }
    match (&report.positions[..], report.starts) {
        ([one], 0) if report.complete.is_none() => {
            let outside = match &one.outside_limits[..] {
                [] => String::new(),
                joints => format!("; outside the limits of {}", listed(joints)),
            };
            format!(
                "Rests {}, with {} of potential energy{outside}.",
                stability(one),
                joules(one.potential)
            )
        }
        (all, starts) => {
            let stable = all.iter().filter(|of| of.stability == Stability::Stable);
            let stable = stable.count();
            let all = count(all.len(), "rest position");
            match &report.complete {
                Some(of) if of.multiple == 0 => format!("{all} found, {stable} stable."),
                Some(_) => {
                    format!(
                        "{all} found, {stable} stable; there may be others, where several meet or are not isolated."
                    )
                }
                None => format!(
                    "{all} found from {starts} random starts (seed {}), {stable} stable; there may be others.",
                    report.seed
                ),
            }
        }
    }
}

/// The account of all solutions.
fn completeness(of: &AllRest, seed: u64) -> String {
    let negative = match of.negative {
        0 => String::new(),
        negative => format!(" ({negative} of them with a negative length of a spring)"),
    };
    let mut ends = vec![format!("{} are real{negative}", of.real)];
    let others = [
        (of.complex, "are complex"),
        (of.at_infinity, "go to infinity"),
        (
            of.multiple,
            "meet others or end where rest positions are not isolated",
        ),
    ];
    let others = others.iter().filter(|(count, _)| *count > 0);
    ends.extend(others.map(|(count, what)| format!("{count} {what}")));
    format!(
        "completeness: {} for generic loads; {} and {} brought no more (seed {seed}), which is evidence and no proof. Followed to these loads, {}",
        count(of.generic, "solution"),
        count(of.quiet, "random loop"),
        count(of.quiet_seeds, "seed"),
        listed(&ends)
    )
}

/// The reason for which only random starts are tried.
fn not_algebraic(why: &NotAlgebraic) -> String {
    let why = match why {
        NotAlgebraic::TorsionSpring(name) => {
            format!("the moment of `{name}` is no algebraic function of the position")
        }
        NotAlgebraic::OneWay(name) => format!("`{name}` acts in one direction only"),
        NotAlgebraic::Force(name) => format!("the force `{name}` is not constant, or has a moment"),
        NotAlgebraic::Joint(name) => format!("`{name}` belongs to a gear or slides as it turns"),
        NotAlgebraic::Platforms => "it has platforms with coordinates of their own".into(),
        NotAlgebraic::Overconstrained => "its closures are not independent".into(),
        NotAlgebraic::Large => "it has too many of them".into(),
    };
    format!("rest positions cannot be counted: {why}")
}

fn none(why: NoRest) -> &'static str {
    match why {
        NoRest::Structure => "Nothing can move.",
        NoRest::Singular => {
            "The start is singular: branches of motion meet there. Start slightly away from it."
        }
        NoRest::Endless => {
            "No rest position was reached: the potential energy falls without end, or to where nothing closes."
        }
        NoRest::NoForce => "A force has no value.",
    }
}

fn stability(of: &RestPosition) -> String {
    let directions = |directions: usize| count(directions, "direction");
    match of.stability {
        Stability::Stable => "in stable equilibrium".into(),
        Stability::Unstable { directions: n } => format!(
            "in unstable equilibrium: the energy falls in {}",
            directions(n)
        ),
        Stability::Undecided { directions: n } => format!(
            "in equilibrium of undecided stability: to second order the energy does not change in {}",
            directions(n)
        ),
    }
}

fn joules(energy: f64) -> String {
    format!("{} J", number(energy))
}

fn position(report: &EquilibriumReport, of: &RestPosition, section: Section) -> Section {
    let unit = |name: &str| {
        let joint = report.units.get(name).copied();
        joint.unwrap_or(SiUnit::RADIAN)
    };
    let joints = Table::of(&of.joints.0).words("joint", |(name, _)| name.as_str());
    let joints = joints.numbers("value", |(name, value)| Cell::quantity(*value, unit(name)));
    let platforms = Table::of(&of.platforms.0)
        .words("platform", |(name, _)| name.as_str())
        .each(["x", "y", "z"], |(_, pose), i| {
            Cell::metres(pose.frame.position[i])
        })
        .each(["roll", "pitch", "yaw"], |(_, pose), i| {
            Cell::radians(pose.roll_pitch_yaw[i])
        });
    let outside = |joints| format!("outside their limits: {joints}");
    let section = section
        .table(joints)
        .table(platforms)
        .text(format!(
            "potential energy {}, forces left over below {} N and N·m",
            joules(of.potential),
            bound(of.left)
        ))
        .text(if_any(&of.outside_limits, outside))
        .section(modes(&of.modes, unit));
    of.stiffness
        .iter()
        .fold(section, |section, of| section.section(matrix(of)))
}

/// The frequency of an oscillation, or how fast the position is left.
fn pace(mode: &NaturalMode) -> String {
    match (mode.frequency, mode.departure) {
        (Some(frequency), _) => format!("{} Hz", number(frequency)),
        (None, Some(rate)) => format!("departs at {} 1/s", number(rate)),
        (None, None) => String::new(),
    }
}

/// Pictures of rest positions with their oscillations: all of a single position, of several the slowest of each. The places
/// between the ends of an oscillation are ghosts; `moving` gives them one after the other, there and back.
pub fn panels(mechanism: &Mechanism, report: &EquilibriumReport, moving: bool) -> Vec<Panel> {
    let several = report.positions.len() > 1;
    let mut panels = Vec::new();
    for (i, position) in report.positions.iter().enumerate() {
        let named = match several {
            true => format!("{}: {}", i + 1, stability(position)),
            false => stability(position),
        };
        let scene = |at: &Configuration<f64>| Scene::of(mechanism, at);
        let panel = |title: String, at: &Configuration<f64>, ghosts| Panel {
            ghosts,
            ..Panel::new(&title, None, scene(at))
        };
        let shown = if several { 1 } else { position.modes.len() };
        for mode in position.modes.iter().take(shown) {
            let title = || format!("{named}, {}", pace(mode));
            match (&mode.swing[..], moving) {
                ([], _) => {}
                (all, true) => {
                    let back = all[1..all.len() - 1].iter().rev();
                    panels.extend(
                        all.iter()
                            .chain(back)
                            .map(|at| panel(title(), at, Vec::new())),
                    );
                }
                ([first, .., last], false) => {
                    let ghosts = vec![scene(first), scene(last)];
                    panels.extend(
                        position
                            .place
                            .iter()
                            .map(|at| panel(title(), at, ghosts.clone())),
                    );
                }
                _ => {}
            }
        }
        if position.modes.is_empty() {
            panels.extend(
                position
                    .place
                    .iter()
                    .map(|at| panel(named.clone(), at, Vec::new())),
            );
        }
    }
    panels
}

fn modes(modes: &[NaturalMode], unit: impl Fn(&str) -> SiUnit) -> Section {
    let shape = |mode: &NaturalMode| {
        let parts = mode.shape.0.iter().filter(|(_, x)| x.abs() > 1e-6);
        let parts = parts.map(|(name, x)| format!("{name} {}", quantity(*x, unit(name))));
        parts.collect::<Vec<_>>().join(", ")
    };
    let table = Table::of(modes).words("frequency", pace);
    Section::new("Small oscillations, without damping").table(table.words("shape", shape))
}

fn matrix(of: &Stiffness) -> Section {
    const MOTIONS: [&str; 6] = ["x", "y", "z", "turn x", "turn y", "turn z"];
    let (what, units, matrix, rows, columns) = match &of.stiffness {
        Some(of) => ("Stiffness", "N, N·m, m and rad", of, EFFORTS, MOTIONS),
        None => (
            "Compliance",
            "m, rad, N and N·m",
            &of.compliance,
            MOTIONS,
            EFFORTS,
        ),
    };
    let table = Table::of(rows.into_iter().zip(matrix))
        .words("", |(name, _)| name)
        .each(columns, |(_, row), i| row[i]);
    Section::new(format!("{what} of {} at its origin, in {units}", of.name)).table(table)
}
