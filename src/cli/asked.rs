//! The options that pose a question, and what is said where it has no answer.

use std::sync::Arc;

use clap::Args;
use linkwork::ask::{AskError, Question, Role};
use linkwork::mechanism::{Frame, Mechanism};
use linkwork::output::complaint::{Complaint, Given, Part};
use linkwork::system::{self, QuestionError};

use super::source::{Assignment, Loaded, once};
use super::words::question::{
    at_home, complaint, complaint_of, driven_complaint, freed_in_vain, held_at, motionless_frame,
    unknown_frame,
};
use super::words::{load, loci, map, motion};
use super::{Refusal, style};

#[derive(Args)]
pub struct Split {
    /// Hold a joint or coordinate at a value, e.g. --hold theta1="60 deg"
    #[arg(long, value_name = "NAME=VALUE")]
    hold: Vec<Assignment>,
    /// Let a joint be solved, e.g. --free l1; `actuated` frees all actuated joints
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
}

impl Split {
    /// The question about a mechanism that these options pose.
    pub fn pose<'o>(&'o self, loaded: &Loaded) -> Posed<'o> {
        let mut posed = Posed::new(&loaded.mechanism);
        for name in &self.free {
            posed.name(Role::Free, "--free", name);
            posed.question = posed.question.free(name);
        }
        for given in &self.hold {
            posed.value(Role::Hold, "--hold", given);
            posed.question = posed.question.hold(&given.name, &given.value);
        }
        posed
    }
}

#[derive(Args)]
pub struct Asked {
    #[command(flatten)]
    split: Split,
    /// Start the search at a value, e.g. --guess phi1="-30 deg"
    #[arg(long, value_name = "NAME=VALUE")]
    guess: Vec<Assignment>,
}

impl Asked {
    /// The same with guesses for what is free.
    pub fn pose<'o>(&'o self, loaded: &Loaded) -> Posed<'o> {
        let mut posed = self.split.pose(loaded);
        for given in &self.guess {
            posed.value(Role::Guess, "--guess", given);
            posed.question = posed.question.guess(&given.name, &given.value);
        }
        posed
    }
}

/// What ranges are for, which decides the words.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Ranges {
    /// Inputs that move.
    Input,
    /// Sides of the box of loci.
    Locus,
    /// Mapped coordinates.
    Map,
}

impl Ranges {
    fn option(self) -> &'static str {
        match self {
            Ranges::Input => "--input",
            Ranges::Locus => "--locus",
            Ranges::Map => "--map",
        }
    }
}

/// A question with the options that posed it.
pub struct Posed<'o> {
    pub question: Question,
    given: Vec<(Role, Given<'o>)>,
    ranges: Ranges,
}

impl<'o> Posed<'o> {
    pub fn new(mechanism: &Arc<Mechanism>) -> Self {
        Posed {
            question: Question::new(Arc::clone(mechanism)),
            given: Vec::new(),
            ranges: Ranges::Input,
        }
    }

    /// Remembers an option that gives a name.
    pub fn name(&mut self, role: Role, option: &'o str, name: &'o str) {
        let value = None;
        self.given.push((
            role,
            Given {
                option,
                name,
                value,
            },
        ));
    }

    /// Remembers an option that gives a value to a name.
    pub fn value(&mut self, role: Role, option: &'o str, given: &'o Assignment) {
        self.given.push((role, given.given(option)));
    }

    /// The ranges of an option, `NAME=FROM..TO`.
    pub fn ranges(&mut self, ranges: Ranges, given: &'o [Assignment]) -> Result<(), Refusal> {
        self.ranges = ranges;
        once(ranges.option(), given)?;
        for assignment in given {
            let (name, option) = (&assignment.name, ranges.option());
            self.value(Role::Input, option, assignment);
            let Some((from, to)) = assignment.value.split_once("..") else {
                let mechanism = self.question.mechanism();
                // a wrong name is the first thing to say
                let known = system::Question::new(mechanism).value(name, "home");
                let said = match known {
                    Err(error) => complaint(&error),
                    Ok(_) => match ranges {
                        Ranges::Input => motion::no_range(name),
                        Ranges::Locus => loci::no_side(name),
                        Ranges::Map => map::no_range(name),
                    },
                };
                return Err(refused(said, Some(&assignment.given(option))));
            };
            self.question = self.question.clone().input(name, from, to);
        }
        Ok(())
    }

    /// What is wrong with what is held, with options that put it right.
    pub fn complaint(&self, error: &QuestionError) -> Complaint {
        let freed = self.given.iter().filter(|(role, _)| *role == Role::Free);
        let freed: Vec<&str> = freed.map(|(_, given)| given.name).collect();
        freed_in_vain(error, &freed)
            .unwrap_or_else(|| complaint_of(error, &|names| held(&self.question, names)))
    }

    /// What is wrong with the question, under the option that says so if one does.
    pub fn refusal(&self, error: &AskError) -> Refusal {
        let mechanism = self.question.mechanism();
        let given = |item: &linkwork::ask::Item| {
            let role = match item.role {
                Role::From | Role::To => Role::Input,
                role => role,
            };
            let mut of_role = self.given.iter().filter(|(of, _)| *of == role);
            of_role.nth(item.index).map(|(_, given)| *given)
        };
        let whole = |said: Complaint| Refusal(said.render(style()));
        let plain = |text: String| Refusal(format!("error: {text}\n"));
        match error {
            AskError::Named { item, error } => {
                let given = given(item);
                let said = complaint(error);
                let value = given.and_then(|given| given.value).unwrap_or_default();
                let first = value.find("..").unwrap_or(value.len());
                let part = match item.role {
                    Role::From => Part::Value(0..first),
                    Role::To => Part::Value((first + 2).min(value.len())..value.len()),
                    _ => said.part.clone(),
                };
                refused(said.at(part), given.as_ref())
            }
            AskError::Question(error) => whole(self.complaint(error)),
            AskError::Mapped {
                error,
                mapped,
                missing,
            } => {
                whole(map::wrong_count(error, mapped, missing).unwrap_or_else(|| complaint(error)))
            }
            AskError::NotMapped { item, error } => {
                let said = map::no_platform(mechanism, error);
                let said = said.unwrap_or_else(|| complaint(error));
                refused(said, given(item).as_ref())
            }
            AskError::Drive { item, error } => {
                let given = given(item);
                let option = given.map_or("--rate", |given| given.option);
                refused(driven_complaint(error, option), given.as_ref())
            }
            AskError::Load { item, error } => {
                let given = given(item);
                let option = given.map_or("--load", |given| given.option);
                let said = load::complaint(mechanism, error, option);
                refused(said, given.as_ref())
            }
            AskError::UnknownFrame { item, name } => {
                refused(unknown_frame(mechanism, name), given(item).as_ref())
            }
            AskError::Motionless { item, name } => {
                refused(motionless_frame(name), given(item).as_ref())
            }
            AskError::UnknownOutput { item, name } => {
                let said = loci::unknown_output(mechanism, name);
                refused(said, given(item).as_ref())
            }
            AskError::Traced { item, error } => {
                let said = motion::point_complaint(mechanism, error);
                refused(said, given(item).as_ref())
            }
            AskError::EmptyRange { item, name } => {
                let given = given(item);
                let value = given.and_then(|given| given.value).unwrap_or_default();
                let from = value.split("..").next().unwrap_or_default();
                let said = match self.ranges {
                    Ranges::Input => motion::nothing_moves(name, from),
                    Ranges::Locus => loci::empty_side(name),
                    Ranges::Map => map::empty_side(name, from),
                };
                refused(said, given.as_ref())
            }
            AskError::OutsideLimits {
                item,
                name,
                limits,
                is_angle,
            } => {
                let said = motion::outside(name, *limits, *is_angle);
                refused(said, given(item).as_ref())
            }
            AskError::AlsoHeld { item, name } => {
                let said = match self.ranges {
                    Ranges::Map => map::also_held(name),
                    Ranges::Input | Ranges::Locus => Complaint::with_help(
                        format!("`{name}` is both moved and held"),
                        "also held",
                        "give only one of them".into(),
                    ),
                };
                refused(said, given(item).as_ref())
            }
            AskError::MoreThanATurn { name } => whole(map::more_than_a_turn(name)),
            AskError::NothingMoves { driven } => whole(motion::what_moves(driven.as_deref())),
            AskError::NotOneJoint => whole(motion::what_moves(None)),
            AskError::Steps { given, most } => whole(motion::no_steps(*given, *most, false)),
            AskError::Starts { given, most } => whole(Complaint::with_help(
                format!("{given} random starts, or nodes that are searched"),
                "",
                match self.ranges {
                    Ranges::Map => format!("give --starts and --search from 1 to {most}"),
                    Ranges::Input | Ranges::Locus => format!("give --starts from 1 to {most}"),
                },
            )),
            AskError::NothingLeft { held } => whole(motion::nothing_left(held)),
            AskError::NotOneFreedom(error) => {
                let released = self.question.clone().free("actuated");
                whole(motion::not_one_freedom(error, &|names| {
                    held(&released, names)
                }))
            }
            AskError::NotAssembled { held } => plain(format!(
                "the mechanism does not assemble where the motion is to begin\n  \
                 = help: `linkwork solve` says how near it comes: {}",
                held.join(", ")
            )),
            AskError::NothingToDrive => whole(loci::nothing_to_drive()),
            AskError::Sides(given) => whole(loci::not_two_sides(*given)),
            AskError::Axes(given) => whole(map::too_many_axes(mechanism, *given)),
            AskError::Spinning(spins) => whole(loci::spinning(*spins)),
            AskError::Grid { nodes, axes } => whole(map::wrong_grid(nodes, *axes)),
            AskError::TooFine { nodes, bytes, most } => whole(map::too_fine(*nodes, *bytes, *most)),
            AskError::TooMany { cells, most } => whole(map::too_many_cells(*cells, *most)),
            AskError::TooLarge { unknowns } => plain(format!(
                "the mechanism has {unknowns} unknowns, too many for this analysis: ask about a part of it"
            )),
            AskError::Store(said) => Refusal(said.clone()),
            other => plain(other.to_string()),
        }
    }
}

/// The options that hold coordinates where the mechanism assembles.
fn held(question: &Question, names: &[String]) -> String {
    (question.holdable(names)).map_or_else(|| at_home(names), |holdable| held_at(&holdable))
}

fn refused(said: Complaint, given: Option<&Given>) -> Refusal {
    Refusal(match given {
        Some(given) => said.render_in(given, style()),
        None => said.render(style()),
    })
}

/// The frame of that name.
pub fn frame(mechanism: &Mechanism, name: &str, option: &str) -> Result<Frame, Refusal> {
    mechanism.frame(name).ok_or_else(|| {
        let value = None;
        let given = Given {
            option,
            name,
            value,
        };
        refused(unknown_frame(mechanism, name), Some(&given))
    })
}
