//! Commands, one file each. Data goes to stdout, problems to stderr.

mod assemblies;
mod check;
mod compare;
mod convert;
mod design;
mod draw;
mod equilibrium;
mod examples;
mod export;
mod formulas;
mod frames;
mod generate;
mod handout;
mod help;
mod import;
mod live_server;
mod merge;
mod mobility;
mod new;
mod output_files;
mod pictures;
mod progress;
mod question_options;
mod read;
mod report_format;
mod schema;
mod search_options;
mod setup;
mod shipped;
mod simulate;
mod singularities;
mod snap;
mod solve;
mod source;
mod statics;
mod store;
mod study;
mod sweep;
mod velocity;
mod view;
mod words;
mod workspace;

use std::ffi::OsString;
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};

use self::question_options::Asking;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use linkwork::output::complaint::Complaint;
use linkwork::output::diagnostics::Style;

/// Analyses parallel and closed-chain mechanisms described as Denavit–Hartenberg chains.
#[derive(Parser)]
#[command(version, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 success, 1 negative or incomplete answer, 2 invalid input or system error.\n\
     Answers go to stdout, as text or JSON; with exit code 2 there is none, and stderr says why, always as text.";

macro_rules! commands {
    ($($Command:ident: $Type:ty),+ $(,)?) => {
        #[derive(Subcommand)]
        enum Command {
            $($Command($Type),)+
        }

        impl Command {
            fn run(&self) -> Result<Answer, Refusal> {
                match self {
                    $(Command::$Command(command) => command.run(),)+
                }
            }
        }
    };
}

commands! {
    Check: check::Check, Solve: Asking<solve::Solve>, Assemblies: assemblies::Assemblies, Compare: compare::Compare,
    Convert: convert::Convert, Draw: draw::Draw, Frames: frames::Frames, Export: export::Export, Import: import::Import,
    Formulas: Asking<formulas::Formulas>, Generate: generate::Generate, Mobility: Asking<mobility::Mobility>,
    Velocity: Asking<velocity::Velocity>, View: view::View, Statics: Asking<statics::Statics>,
    Equilibrium: Asking<equilibrium::EquilibriumArguments>, Simulate: Asking<simulate::Simulate>, Sweep: Asking<sweep::Sweep>,
    Singularities: Asking<singularities::Singularities>, Workspace: Asking<workspace::Workspace>, Study: study::StudyArguments,
    Merge: merge::Merge, Snap: snap::Snap, Handout: handout::Handout, New: new::New, Examples: examples::Examples,
    Setup: setup::Setup, Design: design::DesignArguments,
}

/// Answer of a command.
struct Answer {
    /// Output on stdout.
    data: String,
    /// Remarks on stderr.
    remarks: String,
    /// False if the answer is negative (exit status 1).
    yes: bool,
}

impl Answer {
    fn yes(data: String, remarks: String) -> Self {
        Answer {
            data,
            remarks,
            yes: true,
        }
    }

    /// Puts remarks before its own.
    fn after(self, remarks: String) -> Self {
        Answer {
            remarks: remarks + &self.remarks,
            ..self
        }
    }
}

/// The reason for which a command has no answer, in words.
struct Refusal(String);

impl Refusal {
    /// An error that is not in an option.
    fn error(said: impl Display) -> Self {
        Refusal(format!("error: {said}\n"))
    }
}

impl From<Complaint> for Refusal {
    fn from(said: Complaint) -> Self {
        Refusal(said.render(style()))
    }
}

/// Lines for stderr: `note: …`.
fn lines(word: &str, said: impl IntoIterator<Item = String>) -> String {
    let lines = said.into_iter().map(|line| format!("{word}: {line}\n"));
    lines.collect()
}

/// The program's commands and options.
fn command() -> clap::Command {
    help::arranged(Arguments::command())
}

/// Request of a command line.
enum Parsed {
    Command(Box<Command>),
    /// The schema of a command's JSON.
    Schema(String),
}

fn parsed(arguments: impl IntoIterator<Item = OsString>) -> Result<Parsed, clap::Error> {
    let mut command = command();
    let mut matches = command.try_get_matches_from_mut(arguments)?;
    if let Some((name, of)) = matches.subcommand()
        && schema::has_one(name)
        && of.get_flag("schema")
        && let Some(schema) = schema::of(name)
    {
        return Ok(Parsed::Schema(schema));
    }
    match Arguments::from_arg_matches_mut(&mut matches) {
        Ok(arguments) => Ok(Parsed::Command(Box::new(arguments.command))),
        Err(error) => Err(error.format(&mut command)),
    }
}

/// Does what the command line asks for; returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let answer = match parsed(arguments) {
        Ok(Parsed::Command(command)) => command.run(),
        Ok(Parsed::Schema(schema)) => Ok(Answer::yes(schema, String::new())),
        Err(error) => {
            let _ = error.print();
            return error.exit_code() as u8;
        }
    };
    match answer {
        Ok(answer) => {
            say(&answer.remarks);
            match write(&answer.data) {
                Ok(()) if progress::was_cut_short() => {
                    say("note: interrupted: the answer has the results found so far\n");
                    1
                }
                Ok(()) => u8::from(!answer.yes),
                Err(error) => {
                    say(&format!("error: the answer cannot be written: {error}\n"));
                    2
                }
            }
        }
        Err(Refusal(problems)) => {
            say(&problems);
            if progress::was_cut_short() { 1 } else { 2 }
        }
    }
}

/// Writes to stdout. A reader who has seen enough, as `head` does, is no error.
fn write(data: &str) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(data.as_bytes());
    match written.and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Writes to stderr; if nobody listens there is nobody to tell.
fn say(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Colours on a terminal, unless the user wants none (<https://no-color.org>).
fn style() -> Style {
    let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    match io::stderr().is_terminal() && !unwanted {
        true => Style::Coloured,
        false => Style::Plain,
    }
}
