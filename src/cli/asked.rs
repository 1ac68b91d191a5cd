//! The options that say what is held and where to start.

use clap::Args;
use linkwork::mechanism::{Frame, Mechanism};
use linkwork::output::option::{Complaint, Given, Part};
use linkwork::output::question::{complaint, driven_complaint, unknown_frame};
use linkwork::system::{DriveError, Question, QuestionError};

use super::source::Assignment;
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
    /// What is freed is freed first, so that `--free actuated --hold l1=1` holds one joint.
    pub fn question<'a>(&self, mechanism: &'a Mechanism) -> Result<Question<'a>, Refusal> {
        self.put(Question::new(mechanism))
    }

    /// The same for a mechanism whose joints are held only if --hold says so.
    pub fn released<'a>(&self, mechanism: &'a Mechanism) -> Result<Question<'a>, Refusal> {
        let released = Question::new(mechanism).free("actuated");
        self.put(released.map_err(|error| refusal(&error, None))?)
    }

    /// The names of what is held or freed.
    pub fn demanded(&self) -> Vec<&str> {
        let held = self.hold.iter().map(|assignment| assignment.name.as_str());
        held.chain(self.free.iter().map(String::as_str)).collect()
    }

    fn put<'a>(&self, mut question: Question<'a>) -> Result<Question<'a>, Refusal> {
        for name in &self.free {
            let given = Given {
                option: "--free",
                name,
                value: None,
            };
            question = (question.free(name)).map_err(|error| refusal(&error, Some(given)))?;
        }
        for assignment in &self.hold {
            let Assignment { name, value } = assignment;
            let given = assignment.given("--hold");
            question =
                (question.hold(name, value)).map_err(|error| refusal(&error, Some(given)))?;
        }
        Ok(question)
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
    /// The split, with guesses for what is free.
    pub fn question<'a>(&self, mechanism: &'a Mechanism) -> Result<Question<'a>, Refusal> {
        self.guessed(self.split.question(mechanism)?)
    }

    /// The same for a mechanism whose joints are held only if --hold says so.
    pub fn released<'a>(&self, mechanism: &'a Mechanism) -> Result<Question<'a>, Refusal> {
        self.guessed(self.split.released(mechanism)?)
    }

    fn guessed<'a>(&self, mut question: Question<'a>) -> Result<Question<'a>, Refusal> {
        for assignment in &self.guess {
            let Assignment { name, value } = assignment;
            let given = assignment.given("--guess");
            question =
                (question.guess(name, value)).map_err(|error| refusal(&error, Some(given)))?;
        }
        Ok(question)
    }
}

/// What is wrong with the question, and with the option that asked it, if one did.
pub fn refusal(error: &QuestionError, given: Option<Given>) -> Refusal {
    let (complaint, part) = complaint(error);
    Refusal(match given {
        Some(given) => complaint.render_in(&given, &part, style()),
        None => complaint.render(style()),
    })
}

/// What is wrong with a rate, an acceleration or a force.
pub fn driven(error: &DriveError, given: Given) -> Refusal {
    let (complaint, part) = driven_complaint(error, given.option);
    Refusal(complaint.render_in(&given, &part, style()))
}

/// The frame of that name.
pub fn frame(mechanism: &Mechanism, name: &str, option: &str) -> Result<Frame, Refusal> {
    let known = mechanism.frame(name);
    known.ok_or_else(|| refused_frame(name, option, unknown_frame(mechanism, name)))
}

/// A frame that an option cannot have, with what is wrong with it.
pub fn refused_frame(name: &str, option: &str, (complaint, part): (Complaint, Part)) -> Refusal {
    let given = Given {
        option,
        name,
        value: None,
    };
    Refusal(complaint.render_in(&given, &part, style()))
}
