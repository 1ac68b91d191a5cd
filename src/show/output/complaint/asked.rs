//! Words for questions that have no answer as posed. The library says what is wrong, and with what remedy, as data; a
//! [`Door`] says how demands, settings and analyses are called there.

use super::door::{Ranged, Wording};
use super::question::{frame_names, meant, no_point, no_quantity};
use super::{Complaint, OptionPart};
use crate::analysis::solver::NoSolver;
use crate::ask::{AskError, Demand, Question, Remedy, Role, Unmeasured, Value};
use crate::description::{self, count, listed};
use crate::mechanism::{Joint, Mechanism};
use crate::output::quantity::number;
use crate::system::{Coordinate, QuestionError};

const ONE_OF_THEM: &str = "give only one of them";

impl Wording<'_> {
    /// The words for a question that has no answer, which are about the demand of [`AskError::item`] if there is one.
    pub fn asked(&self, question: &Question, error: &AskError) -> Complaint {
        let mechanism = &**question.mechanism();
        let said = Complaint::new(error.to_string());
        let demand = error
            .item()
            .and_then(|item| question.demands().get(item.index));
        let written = demand.and_then(Demand::written).unwrap_or_default();
        let role = |other| demand.map_or(other, |demand| demand.role);
        let ranged = self.ranged;
        match error {
            AskError::Named(item, error) => {
                let said = self.question(error);
                let (first, end) = (written.find("..").unwrap_or(written.len()), written.len());
                match item.value {
                    Some(0) => said.at(OptionPart::Value(0..first)),
                    Some(_) => said.at(OptionPart::Value((first + 2).min(end)..end)),
                    None => said,
                }
            }
            AskError::Question(error) => self.freed_in_vain(question, error).unwrap_or_else(|| {
                self.held(error, &|names| self.held_at(question, names))
            }),
            AskError::NotMapped(_, error) => self.question(error),
            AskError::Mapped {
                error,
                mapped,
                missing,
            } => (self.wrong_count(error, mapped, missing)).unwrap_or_else(|| self.question(error)),
            AskError::Drive(_, error) => self.driven(error, role(Role::Rate)),
            AskError::Load(_, error) => self.load(mechanism, error, role(Role::Load)),
            AskError::Motionless { .. } => said.label("stands still").help(
                "follow a frame of a link or of a platform, e.g. the tip of a chain by its name",
            ),
            AskError::UnknownOutput(_, name) => {
                let joints = mechanism.joints().iter().map(|joint| joint.name.clone());
                let known: Vec<String> = frame_names(mechanism).chain(joints).collect();
                said.label("not known").help(meant(name, &known, || {
                    "an output is a joint, a platform coordinate such as `top.x`, a frame, or a point \
                     such as `left+0.5,0.2`"
                        .into()
                }))
            }
            AskError::Point(_, error) => no_point(mechanism, error),
            AskError::Quantity { text, error, .. } => no_quantity(mechanism, text, error),
            AskError::Unmeasured { error, .. } => self.unmeasured(said, error),
            AskError::Unused { takers, .. } => {
                let help = format!("leave it out; it is taken by {}", listed(takers));
                said.label("not used").help(help)
            }
            AskError::AllModes => said.help(format!(
                "choose one by its number, as {} numbers them",
                self.analysis("assemblies")
            )),
            AskError::Duration(_) => said.help(format!(
                "give a time in s, e.g. {}",
                self.setting("duration", Some("2"))
            )),
            AskError::Twice { item, first, .. } => {
                let demands = [first, item].map(|item| question.demands().get(item.index));
                match demands {
                    [Some(first), Some(second)] => self.contradiction(first, second),
                    _ => said,
                }
            }
            AskError::EmptyRange(_, name) => {
                said.label("empty").at(OptionPart::WholeValue).help(match ranged {
                    Ranged::Input => {
                        let from = written.split("..").next().unwrap_or_default().trim();
                        format!(
                            "for one configuration use {} with {}",
                            self.analysis("solve"),
                            self.give(Role::Hold, name, &[from])
                        )
                    }
                    Ranged::Locus | Ranged::Map | Ranged::Vary => format!(
                        "write the lower end first; for one value hold it with {}",
                        self.role(Role::Hold)
                    ),
                })
            }
            AskError::OutsideLimits {
                name,
                limits,
                is_angle,
                ..
            } => {
                let written = |x: f64| match is_angle {
                    true => format!("{}deg", number(x.to_degrees())),
                    false => number(x),
                };
                let (low, high) = (written(limits.0), written(limits.1));
                let within = self.give(Role::Input, name, &[&low, &high]);
                let help = format!("sweep within them, e.g. {within}");
                said.label("outside").at(OptionPart::WholeValue).help(help)
            }
            AskError::AlsoHeld { .. } => said.label("also held").help(ONE_OF_THEM),
            AskError::MoreThanATurn(name) => said.help(format!(
                "one turn covers all values, e.g. {}",
                self.give(Role::Input, name, &["-180deg", "180deg"])
            )),
            AskError::TooManyTurns { name, .. } => {
                let turn = self.give(Role::Input, name, &["0deg", "360deg"]);
                let help = format!("a motion repeats after few turns, often after one: {turn}");
                said.label("too far").at(OptionPart::WholeValue).help(help)
            }
            AskError::NothingMoves(driven) => said.help(format!(
                "give the inputs their ranges, e.g. {}; follow the whole curve with {}; or list circuits with {}",
                self.give(Role::Input, driven.as_deref().unwrap_or("NAME"), &["0deg", "360deg"]),
                self.setting("follow", None),
                self.setting("circuits", None),
            )),
            AskError::NotOneCoordinate => {
                said.help(format!("move the inputs with {}", self.role(Role::Input)))
            }
            AskError::Steps { given, most } => match given {
                0 => Complaint::new("a motion needs at least one step").help(format!(
                    "for example {}; for one configuration use {}",
                    self.setting("steps", Some("100")),
                    self.analysis("solve")
                )),
                _ => Complaint::new(format!("{given} steps are too many: at most {most} are possible")).help(
                    "dead points and crossings between the rows are located exactly, however long the steps are",
                ),
            },
            AskError::Starts { most, .. } => {
                let starts = self.setting("starts", None);
                said.help(match ranged {
                    Ranged::Map => {
                        let search = self.setting("search", None);
                        format!("give {starts} and {search} from 1 to {most}")
                    }
                    Ranged::Input | Ranged::Locus | Ranged::Vary => {
                        format!("give {starts} from 1 to {most}")
                    }
                })
            }
            AskError::NothingLeft(held) => said.help(match held.is_empty() {
                true => format!("{} shows why it cannot move", self.analysis("mobility")),
                false => "hold one coordinate less".into(),
            }),
            AskError::NotOneFreedom(error) => match error {
                QuestionError::TooFew {
                    mobility,
                    held,
                    hold,
                } => {
                    let more = mobility.saturating_sub(held + 1);
                    let most = hold.len().min(more);
                    let prescribed = Remedy::Analysis("sweep", Some(Role::Input));
                    said.help(format!(
                        "hold {} more, e.g. {}; or prescribe the inputs with {}",
                        count(more, "coordinate"),
                        self.held_released(question, &hold[..most]),
                        self.remedies(&[prescribed])
                    ))
                }
                _ => said.help("hold other coordinates"),
            },
            AskError::NotAssembled { .. } => said.help(format!(
                "{} shows the closest approach",
                self.analysis("solve")
            )),
            AskError::NothingToDrive => said.help(format!(
                "hold the driven joints with {}; {} shows whether a mechanism without freedoms is infinitesimally \
                 flexible",
                self.role(Role::Hold),
                self.analysis("mobility")
            )),
            AskError::Sides(given) => said.help(format!(
                "give {} twice, e.g. {}; {}",
                self.role(Role::Input),
                self.remedies(&["a", "b"].map(|name| {
                    Remedy::Demand(Demand::new(Role::Input, name, ["0", "1"]))
                })),
                match given {
                    1 => format!(
                        "for singularities along one coordinate use {}",
                        Wording { ranged: Ranged::Input, ..*self }.give(Role::Input, "NAME", &["FROM", "TO"])
                    ),
                    _ => format!("hold the others with {}", self.role(Role::Hold)),
                }
            )),
            AskError::Axes(0) => said.help(format!(
                "give the coordinates and their ranges, e.g. {}",
                self.remedies(&mappable(mechanism))
            )),
            AskError::Axes(_) => {
                said.help(format!("hold the others with {}", self.role(Role::Hold)))
            }
            AskError::Spinning(_) => said.help(
                "a locus needs a unique motion, and these links have no joint of their own that could be held: \
                 write legs between two ball joints as `Distance` closures",
            ),
            AskError::Grid { .. } => said.help(format!(
                "give one number for all coordinates or one for each, e.g. {}",
                self.setting("grid", Some("60,40"))
            )),
            AskError::TooFine { .. } | AskError::TooMany { .. } => said.help(format!(
                "give a coarser {}, or map a part of the box at a time",
                self.setting("grid", None)
            )),
            AskError::TooLarge { .. } => said.help("analyse a part of it"),
            AskError::NoSolver(none) => said.help(match none {
                NoSolver::NothingUnknown => "`linkwork formulas --rust` writes the frames as functions".into(),
                NoSolver::NothingHeld => format!("{} prints its configuration", self.analysis("solve")),
                NoSolver::Singular { .. } => format!(
                    "choose another one with {}, {} or {}",
                    self.role(Role::Hold),
                    self.role(Role::Guess),
                    self.setting("mode", None)
                ),
                NoSolver::Friction => format!("leave it out with {}", self.give(Role::Without, "friction", &[])),
                NoSolver::Function(_) => format!(
                    "write the force as a table, or leave it out with {}",
                    self.role(Role::Without)
                ),
                NoSolver::Undetermined => format!("hold what drives the mechanism with {}", self.role(Role::Hold)),
            }),
            _ => said,
        }
    }

    /// The words for a quantity that cannot be known.
    fn unmeasured(&self, said: Complaint, error: &Unmeasured) -> Complaint {
        match error {
            Unmeasured::NoInput => said.label("nothing moves").help(match self.ranged {
                Ranged::Vary => format!(
                    "give the rate of what moves, e.g. {}",
                    self.give(Role::Rate, "NAME", &["1"])
                ),
                _ => format!(
                    "move an input, e.g. {}, or report positions and angles only",
                    self.give(Role::Input, "NAME", &["0deg", "360deg"])
                ),
            }),
            Unmeasured::NotHeld { held, .. } => said.label("not held").help(match held.is_empty() {
                true => "only inputs and held coordinates have a force".into(),
                false => format!("report the force that holds one of {}", listed(held)),
            }),
            Unmeasured::Follows { what } => {
                said.label("not known").help(format!("it is an expression of {what}"))
            }
            Unmeasured::NoLoad => said.label("no load").help(format!(
                "give a load with {} or {}",
                self.give(Role::Wrench, "FRAME", &["Fx,Fy,Fz"]),
                self.give(Role::Load, "JOINT", &["FORCE"])
            )),
            Unmeasured::NotSquare { .. } => said.label("not square").help(
                "report `manipulability`, the product of its singular values, which is the size of the \
                 determinant of a square one",
            ),
        }
    }

    /// Remedies that hold coordinates where the mechanism assembles.
    fn held_at(&self, question: &Question, names: &[String]) -> String {
        let held = question.holdable(names);
        let Some(held) = held else {
            return self.each(Role::Hold, names, Some("home"));
        };
        let shortly = |demand: &Demand| {
            let of = Coordinate::all(question.mechanism())
                .find(|of| of.name(question.mechanism()) == demand.name);
            let value = match demand.value(0) {
                Value::Number(value) if of.is_some_and(|of| of.is_angle(question.mechanism())) => {
                    format!("{}deg", short(value.to_degrees()))
                }
                Value::Number(value) => short(value),
                value => value.to_string(),
            };
            Remedy::Demand(Demand::new(Role::Hold, &demand.name, [value]))
        };
        self.remedies(&held.iter().map(shortly).collect::<Vec<_>>())
    }

    /// Remedies that hold coordinates beside free inputs.
    fn held_released(&self, question: &Question, names: &[String]) -> String {
        let held = self.held_at(&question.clone().free("actuated"), names);
        let freed = freed(question).filter(|freed| names.contains(freed));
        let freed: Vec<String> = freed.cloned().collect();
        match freed.is_empty() {
            true => held,
            false => format!("{held} without {}", self.each(Role::Free, &freed, None)),
        }
    }

    /// The words where what has to be held is what was freed by name.
    fn freed_in_vain(&self, question: &Question, error: &QuestionError) -> Option<Complaint> {
        let QuestionError::TooFew { hold, .. } = error else {
            return None;
        };
        let in_vain = hold
            .iter()
            .all(|name| freed(question).any(|freed| freed == name));
        let help = format!("leave out {}", self.each(Role::Free, hold, None));
        (!hold.is_empty() && in_vain).then(|| Complaint::new(error.title()).help(help))
    }

    /// The words where more or less is mapped and held than there are freedoms. `missing` are coordinates that would do.
    /// Nothing where the question's own words will do.
    fn wrong_count(
        &self,
        error: &QuestionError,
        mapped: &[String],
        missing: &[String],
    ) -> Option<Complaint> {
        let is_mapped = |name: &String| mapped.contains(name);
        match error {
            QuestionError::TooMany { free, .. } => {
                let away: Vec<String> = free.iter().filter(|n| is_mapped(n)).cloned().collect();
                let help = format!("do not map {}: the others determine it", listed(&away));
                (!away.is_empty()).then(|| Complaint::new(error.title()).help(help))
            }
            QuestionError::TooFew { .. } => {
                let first = missing.first()?;
                let range = match first.rsplit('.').next() {
                    Some("roll" | "pitch" | "yaw") => ["-90deg", "90deg"],
                    _ => ["-1", "1"],
                };
                let help = format!(
                    "map or hold {} too, e.g. {} or {}",
                    listed(missing),
                    self.give(Role::Hold, first, &["home"]),
                    self.give(Role::Input, first, &range)
                );
                Some(Complaint::new(error.title()).help(help))
            }
            QuestionError::Dependent { free, hold } => {
                let (away, rest): (Vec<String>, Vec<String>) =
                    free.iter().cloned().partition(|name| is_mapped(name));
                let mut ways = vec![format!("do not map {}", listed(&away))];
                if !rest.is_empty() {
                    ways.push(format!("do not hold {}", listed(&rest)));
                }
                let ways = ways.join(" and ");
                let help = format!("{ways}; map or hold {} instead", listed(hold));
                (!away.is_empty()).then(|| Complaint::new(error.title()).help(help))
            }
            _ => None,
        }
    }
}

/// The names that a question frees.
fn freed(question: &Question) -> impl Iterator<Item = &String> {
    let demands = question.demands().iter();
    demands
        .filter(|of| of.role == Role::Free)
        .map(|of| &of.name)
}

/// Four digits, enough to assemble near an assembly.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}

/// Coordinates that can be mapped.
fn mappable(mechanism: &Mechanism) -> Vec<Remedy> {
    let map =
        |name: String, range: [&str; 2]| Remedy::Demand(Demand::new(Role::Input, name, range));
    if let Some(platform) = mechanism.platforms().first() {
        let coordinate = |c| map(format!("{}.{c}", platform.name), ["-1", "1"]);
        return ["x", "y"].map(coordinate).to_vec();
    }
    let driven = |joint: &&Joint| joint.role == description::Role::Actuated;
    let joints = mechanism.joints().iter().filter(driven).take(2);
    let range = |joint: &Joint| match joint.kind.is_angle() {
        true => ["-180deg", "180deg"],
        false => ["0", "1"],
    };
    joints
        .map(|joint| map(joint.name.clone(), range(joint)))
        .collect()
}
