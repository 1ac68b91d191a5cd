//! Errors of questions and options, as data: each door words and places them.

mod asked;
mod door;
mod question;

pub use door::{Door, Ranged, Wording};
pub use question::{no_point, no_value, setting, suggested, unknown_frame};

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::description::{Problem, ProblemKind};

/// An option as it was given: `--set l1=2*l0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given<'a> {
    /// The option with its dashes.
    pub option: &'a str,
    /// The name before the equals sign.
    pub name: &'a str,
    /// Text after the equals sign, if there is one.
    pub value: Option<&'a str>,
}

impl<'a> Given<'a> {
    /// An option with its name and its value, if it gives one.
    pub fn new(option: &'a str, name: &'a str, value: Option<&'a str>) -> Self {
        Given {
            option,
            name,
            value,
        }
    }
}

/// An error in words.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Complaint {
    /// The error, in one sentence without a full stop.
    pub title: String,
    /// A few words to stand under the offending part; may be empty.
    pub label: String,
    /// The remedy.
    pub help: Option<String>,
    /// Part of the option that is wrong, if an option is.
    pub part: OptionPart,
}

/// Part of an option.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OptionPart {
    /// The name.
    Name,
    /// Bytes of the value.
    Value(Range<usize>),
    /// The whole value.
    WholeValue,
}

impl Complaint {
    /// A complaint of this title.
    pub fn new(title: impl Into<String>) -> Self {
        Complaint {
            title: title.into(),
            label: String::new(),
            help: None,
            part: OptionPart::Name,
        }
    }

    /// With a few words for the offending part.
    #[must_use]
    pub fn label(self, label: impl Into<String>) -> Self {
        let label = label.into();
        Complaint { label, ..self }
    }

    /// With what to do about it.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        let help = Some(help.into());
        Complaint { help, ..self }
    }

    /// Moves the complaint to another part of the option than its name.
    #[must_use]
    pub fn at(self, part: OptionPart) -> Self {
        Complaint { part, ..self }
    }

    /// The words for a problem of a mechanism file.
    pub fn of(problem: &Problem) -> Self {
        Complaint::kind(&problem.kind)
    }

    /// The words for a kind of problem.
    pub fn kind(kind: &ProblemKind) -> Self {
        Complaint {
            help: kind.help(),
            ..Complaint::new(kind.title()).label(kind.label())
        }
    }
}
