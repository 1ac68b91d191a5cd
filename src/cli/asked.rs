//! The options that pose a question, and the one way from a question to its answer.

use clap::Args;
use linkwork::ask::{AskError, Item, Mode, Question, Role};
use linkwork::mechanism::{Frame, Mechanism};
use linkwork::output::JsonReport;
use linkwork::output::complaint::{Complaint, Given};
use linkwork::solve::Watch;
use linkwork::system::{self, QuestionError};

use super::format::Format;
use super::source::{Assignment, Loaded, Source, once};
use super::watched::watched;
use super::words::question::{
    at_home, complaint, complaint_of, freed_in_vain, held_at, unknown_frame,
};
use super::words::{self, Ranged};
use super::{Answer, Refusal, style};

#[derive(Args)]
pub struct Split {
    /// Hold a joint, a coordinate of a platform or of a point, or a platform, at a value, e.g. --hold theta1="60 deg" or --hold left+0.5,0.2.x=3
    #[arg(long, value_name = "NAME=VALUE")]
    hold: Vec<Assignment>,
    /// Solve for a joint instead of holding it, e.g. --free l1; `actuated` frees all actuated joints
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
}

impl Split {
    /// The question about a mechanism that these options pose.
    pub fn pose(&self, source: &Source) -> Result<Posed<'_>, Refusal> {
        let mut posed = Posed::new(source)?;
        posed.names(Role::Free, "--free", &self.free, Question::free);
        posed.values(Role::Hold, "--hold", &self.hold, Question::hold);
        Ok(posed)
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
    /// As [`Split::pose`], with guesses for free coordinates.
    pub fn pose(&self, source: &Source) -> Result<Posed<'_>, Refusal> {
        let mut posed = self.split.pose(source)?;
        posed.values(Role::Guess, "--guess", &self.guess, Question::guess);
        Ok(posed)
    }
}

#[derive(Args)]
pub struct Forces {
    /// Force in N and moment in N·m, in ground, at a frame's origin or at a point beside it in its axes, e.g. --wrench
    /// top=0,0,-100,0,0,5 or --wrench left+0.5,0.2=0,-10,0
    #[arg(
        long,
        value_name = "FRAME[+X,Y,Z]=Fx,Fy,Fz[,Mx,My,Mz]",
        allow_hyphen_values = true
    )]
    wrench: Vec<Assignment>,
    /// Force in N or moment in N·m along a joint variable, e.g. --load phi1=2
    #[arg(long, value_name = "JOINT=FORCE")]
    load: Vec<Assignment>,
}

impl Forces {
    pub fn are_given(&self) -> bool {
        !self.wrench.is_empty() || !self.load.is_empty()
    }

    pub fn pose<'o>(&'o self, posed: &mut Posed<'o>) {
        posed.values(
            Role::Wrench,
            "--wrench",
            &self.wrench,
            Question::wrench_text,
        );
        posed.values(Role::Load, "--load", &self.load, Question::load);
    }
}

/// A question with the file and the options that posed it.
pub struct Posed<'o> {
    pub loaded: Loaded,
    pub question: Question,
    given: Vec<(Role, Given<'o>)>,
    ranges: Ranged,
}

impl<'o> Posed<'o> {
    /// The file's own question.
    pub fn new(source: &Source) -> Result<Self, Refusal> {
        let loaded = source.load()?;
        Ok(Posed {
            question: Question::new(loaded.mechanism.clone()),
            loaded,
            given: Vec::new(),
            ranges: Ranged::Input,
        })
    }

    pub fn ask_with(&mut self, change: impl FnOnce(Question) -> Question) {
        self.question = change(self.question.clone());
    }

    /// Puts the names that an option gives into the question.
    pub fn names(
        &mut self,
        role: Role,
        option: &'o str,
        names: &'o [String],
        put: impl Fn(Question, String) -> Question,
    ) {
        for name in names {
            self.given.push((role, Given::new(option, name, None)));
            self.ask_with(|question| put(question, name.clone()));
        }
    }

    /// Adds values that an option gives to names.
    pub fn values(
        &mut self,
        role: Role,
        option: &'o str,
        values: &'o [Assignment],
        put: impl Fn(Question, String, String) -> Question,
    ) {
        for given in values {
            self.given.push((role, given.given(option)));
            self.ask_with(|question| put(question, given.name.clone(), given.value.clone()));
        }
    }

    pub fn mode(&mut self, number: Option<usize>) {
        let mode = number.map_or(Mode::Nearest, Mode::Number);
        self.ask_with(|question| question.mode(mode));
    }

    /// The ranges of an option, `NAME=FROM..TO`, as inputs.
    pub fn ranges(&mut self, ranges: Ranged, given: &'o [Assignment]) -> Result<(), Refusal> {
        for (name, from, to) in self.varied(ranges, given)? {
            self.ask_with(|question| question.input(name, from, to));
        }
        Ok(())
    }

    pub fn varied(
        &mut self,
        ranges: Ranged,
        given: &'o [Assignment],
    ) -> Result<Vec<(String, String, String)>, Refusal> {
        let option = ranges.option();
        self.ranges = ranges;
        once(option, given)?;
        let mut varied = Vec::new();
        for assignment in given {
            let name = &assignment.name;
            self.given.push((Role::Input, assignment.given(option)));
            let Some((from, to)) = assignment.value.split_once("..") else {
                // a wrong name is the first thing to say
                let known = system::Question::new(self.question.mechanism()).value(name, "home");
                let said = match known {
                    Err(error) if ranges != Ranged::Vary => complaint(&error),
                    _ => words::no_range(ranges, name),
                };
                return Err(refused(&said, Some(assignment.given(option))));
            };
            varied.push((name.clone(), from.to_owned(), to.to_owned()));
        }
        Ok(varied)
    }

    pub fn ask<'q, R>(
        &'q self,
        work: impl FnOnce(&'q Question, &Watch) -> Result<R, AskError>,
    ) -> Result<R, Refusal> {
        let answer = watched(|watch| work(&self.question, watch));
        answer.map_err(|error| self.refusal(&error))
    }

    pub fn answer<'q, R: JsonReport>(
        &'q self,
        format: Format,
        work: impl FnOnce(&'q Question, &Watch) -> Result<R, AskError>,
    ) -> Result<Answer, Refusal> {
        let report = self.ask(work)?;
        self.loaded.answer(format, &report)
    }

    /// The error in the held coordinates, with options that correct it.
    pub fn complaint(&self, error: &QuestionError) -> Complaint {
        held_wrong(&self.question, &self.given, error)
    }

    /// The error in the question, under its option if it is in one.
    fn refusal(&self, error: &AskError) -> Refusal {
        if let AskError::Store(said) = error {
            return Refusal(said.clone());
        }
        let (said, given) = said(&self.question, &self.given, self.ranges, error);
        refused(&said, given)
    }
}

/// The error in a question posed by options, and the option that it is in, if it is in one.
pub fn said<'o>(
    question: &Question,
    given: &[(Role, Given<'o>)],
    ranges: Ranged,
    error: &AskError,
) -> (Complaint, Option<Given<'o>>) {
    let option = error.item().and_then(|item| option(given, item));
    let said = match error {
        AskError::Question(error) => held_wrong(question, given, error),
        _ => words::complaint(question.mechanism(), ranges, error, option, &|names| {
            let held = held(&question.clone().free("actuated"), names);
            let freed = freed(given).filter(|freed| names.iter().any(|name| name == freed));
            let freed: Vec<String> = freed.map(|name| format!("--free {name}")).collect();
            match freed.is_empty() {
                true => held,
                false => format!("{held} without {}", freed.join(" ")),
            }
        }),
    };
    (said, option)
}

fn held_wrong(question: &Question, given: &[(Role, Given)], error: &QuestionError) -> Complaint {
    let freed: Vec<&str> = freed(given).collect();
    freed_in_vain(error, &freed)
        .unwrap_or_else(|| complaint_of(error, &|names| held(question, names)))
}

/// The names that are freed.
fn freed<'o>(given: &[(Role, Given<'o>)]) -> impl Iterator<Item = &'o str> {
    let freed = given.iter().filter(|(role, _)| *role == Role::Free);
    freed.map(|(_, given)| given.name)
}

fn option<'o>(given: &[(Role, Given<'o>)], item: Item) -> Option<Given<'o>> {
    let role = match item.role {
        Role::From | Role::To => Role::Input,
        role => role,
    };
    let mut of_role = given.iter().filter(|(of, _)| *of == role);
    of_role.nth(item.index).map(|(_, given)| *given)
}

/// The options that hold coordinates where the mechanism assembles.
fn held(question: &Question, names: &[String]) -> String {
    (question.holdable(names)).map_or_else(|| at_home(names), |holdable| held_at(&holdable))
}

fn refused(said: &Complaint, given: Option<Given>) -> Refusal {
    Refusal(match given {
        Some(given) => said.render_in(&given, style()),
        None => said.render(style()),
    })
}

pub fn frame(mechanism: &Mechanism, name: &str, option: &str) -> Result<Frame, Refusal> {
    mechanism.frame(name).ok_or_else(|| {
        let given = Given::new(option, name, None);
        refused(&unknown_frame(mechanism, name), Some(given))
    })
}
