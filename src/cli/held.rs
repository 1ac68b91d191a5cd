//! What is held and what is free.

use clap::Args;
use linkwork::mechanism::Mechanism;
use linkwork::output::option::Given;
use linkwork::output::question::complaint;
use linkwork::system::{Question, QuestionError};

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
        let mut question = Question::new(mechanism);
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

/// A question that cannot be put, with the option that is to blame if there is one.
pub fn refusal(error: &QuestionError, given: Option<Given>) -> Refusal {
    let (complaint, part) = complaint(error);
    Refusal(match given {
        Some(given) => complaint.render_in(&given, &part, style()),
        None => complaint.render(style()),
    })
}
