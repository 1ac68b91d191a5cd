//! The options that pose a question, and the one way from a question to its answer.

use clap::Args;
use clap::builder::ValueParser;
use linkwork::algebra::SiUnit;
use linkwork::ask::{AskError, Demand, Mode, Question, Role};
use linkwork::mechanism::{Frame, Mechanism};
use linkwork::output::JsonReport;
use linkwork::output::complaint::{
    Complaint, Door, Given, Ranged, Wording, setting, unknown_frame,
};
use linkwork::solve::Watch;
use linkwork::system;

use super::progress::watched;
use super::report_format::{Format, readable, with_rows};
use super::source::{Assignment, LoadedFile, Source};
use super::words::{self, Options};
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
    pub fn pose(&self, source: &Source) -> Result<Posed, Refusal> {
        let mut posed = Posed::new(source)?;
        posed.names(Role::Free, &self.free);
        posed.values(Role::Hold, &self.hold);
        Ok(posed)
    }
}

#[derive(Args)]
pub struct QuestionOptions {
    #[command(flatten)]
    split: Split,
    /// Start the search at a value, e.g. --guess phi1="-30 deg"
    #[arg(long, value_name = "NAME=VALUE")]
    guess: Vec<Assignment>,
}

impl QuestionOptions {
    /// The question with guesses for what is free.
    pub fn pose(&self, source: &Source) -> Result<Posed, Refusal> {
        let mut posed = self.split.pose(source)?;
        posed.values(Role::Guess, &self.guess);
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
    /// Force in N or moment in N·m along a joint variable, e.g. --load phi1=2; it may follow from time, joints and rates, as
    /// that of a motor does: --load "phi1=20 N*m*(1 - phi1) - 3 N*m*s*velocity:phi1"
    #[arg(long, value_name = "JOINT=FORCE")]
    load: Vec<Assignment>,
    /// Leave out what the file says acts: `weight`, `inertia`, `springs`, `forces`, `friction`, or one by its name
    #[arg(long, value_name = "NAME")]
    without: Vec<String>,
}

impl Forces {
    pub fn are_given(&self) -> bool {
        !self.wrench.is_empty() || !self.load.is_empty()
    }

    pub fn pose(&self, posed: &mut Posed) {
        posed.values(Role::Wrench, &self.wrench);
        posed.values(Role::Load, &self.load);
        posed.names(Role::Without, &self.without);
    }
}

/// An analysis with its own options.
pub trait AnalysisArgs: Args {
    /// True if its answer can be rows.
    const ROWS: bool = false;

    /// The answer to a question with these options.
    fn answer(&self, posed: Posed, format: Format) -> Result<Answer, Refusal>;
}

// a command that asks a question of a mechanism; its help begins with the words of the analysis
#[derive(Args)]
pub struct Asking<A: AnalysisArgs> {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: QuestionOptions,
    #[command(flatten)]
    analysis: A,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = formats(A::ROWS))]
    format: Format,
}

fn formats(rows: bool) -> ValueParser {
    match rows {
        true => with_rows().into(),
        false => readable().into(),
    }
}

impl<A: AnalysisArgs> Asking<A> {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let posed = self.asked.pose(&self.source)?;
        self.analysis.answer(posed, self.format)
    }
}

/// A question with the file and the options that posed it.
pub struct Posed {
    pub loaded: LoadedFile,
    pub question: Question,
    options: Options,
    ranged: Ranged,
}

impl Posed {
    /// The file's own question.
    pub fn new(source: &Source) -> Result<Self, Refusal> {
        let loaded = source.load()?;
        Ok(Posed {
            question: Question::new(loaded.mechanism.clone()),
            loaded,
            options: Options::default(),
            ranged: Ranged::Input,
        })
    }

    pub fn ask_with(&mut self, change: impl FnOnce(Question) -> Question) {
        self.question = change(self.question.clone());
    }

    /// The number that a setting is given, in SI units.
    pub fn setting(
        &self,
        option: &str,
        text: &str,
        unit: SiUnit,
        range: (f64, f64),
    ) -> Result<f64, Refusal> {
        let number = setting(self.question.mechanism(), &text.into(), unit, range);
        number.map_err(|said| refused(&said, option, text, None))
    }

    /// Calls the option of a role by another name than that of the role.
    pub fn spelled(&mut self, role: Role, option: &'static str) {
        self.options.spelled.push((role, option));
    }

    /// Puts the names that an option gives into the question.
    pub fn names(&mut self, role: Role, names: &[String]) {
        let demands = names.iter().map(|name| Demand::named(role, name));
        demands.for_each(|demand| self.question.add(demand));
    }

    /// Puts the values that an option gives to names into the question.
    pub fn values(&mut self, role: Role, values: &[Assignment]) {
        let demand = |given: &Assignment| Demand::new(role, &given.name, [&given.value]);
        let demands = values.iter().map(demand);
        demands.for_each(|demand| self.question.add(demand));
    }

    pub fn mode(&mut self, number: Option<usize>) {
        let mode = number.map_or(Mode::Nearest, Mode::Number);
        self.ask_with(|question| question.mode(mode));
    }

    /// Puts the ranges that an option gives, `NAME=FROM..TO`, into the question.
    pub fn ranges(&mut self, ranged: Ranged, given: &[Assignment]) -> Result<(), Refusal> {
        self.ranged = ranged;
        let role = match ranged {
            Ranged::Vary => Role::Vary,
            Ranged::Input | Ranged::Locus | Ranged::Map => Role::Input,
        };
        for Assignment { name, value } in given {
            let Some((from, to)) = value.split_once("..") else {
                // a wrong name is the first thing to say
                let known = system::Question::new(self.question.mechanism()).value(name, "home");
                let option = self.options.option(role, ranged);
                let said = match known {
                    Err(error) if ranged != Ranged::Vary => self.wording().question(&error),
                    _ => words::no_range(&option, name),
                };
                return Err(refused(&said, &option, name, Some(value)));
            };
            self.question.add(Demand::new(role, name, [from, to]));
        }
        Ok(())
    }

    pub fn ask<'q, R>(
        &'q self,
        work: impl FnOnce(&'q Question, &Watch) -> Result<R, AskError>,
    ) -> Result<R, Refusal> {
        self.ask_of(&self.question, work)
    }

    /// The answer to another question that the same options pose.
    pub fn ask_of<'q, R>(
        &self,
        question: &'q Question,
        work: impl FnOnce(&'q Question, &Watch) -> Result<R, AskError>,
    ) -> Result<R, Refusal> {
        let answer = watched(|watch| work(question, watch));
        answer.map_err(|error| match error {
            AskError::Store(said) => Refusal(said),
            error => Refusal(self.wording().refusal(question, &error, style())),
        })
    }

    pub fn answer<'q, R: JsonReport>(
        &'q self,
        format: Format,
        work: impl FnOnce(&'q Question, &Watch) -> Result<R, AskError>,
    ) -> Result<Answer, Refusal> {
        let report = self.ask(work)?;
        self.loaded.answer(format, &report)
    }

    /// The words for an error, with options that put the question right.
    pub fn complaint(&self, error: &AskError) -> Complaint {
        self.wording().asked(&self.question, error)
    }

    fn wording(&self) -> Wording<'_> {
        Wording {
            door: &self.options,
            ranged: self.ranged,
        }
    }
}

fn refused(said: &Complaint, option: &str, name: &str, value: Option<&str>) -> Refusal {
    Refusal(said.render_in(&Given::new(option, name, value), style()))
}

pub fn frame(mechanism: &Mechanism, name: &str, option: &str) -> Result<Frame, Refusal> {
    let said = |()| refused(&unknown_frame(mechanism, name), option, name, None);
    mechanism.frame(name).ok_or(()).map_err(said)
}
