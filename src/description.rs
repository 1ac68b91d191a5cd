//! The mechanism file, well formed but not yet meaningful.
//!
//! Text becomes a [`Description`] in which every field has the right type, every expression parses and every name
//! is a possible name. Whether the names refer to anything is asked later. All problems of a file are found in one
//! reading; each is a [`Problem`] that points into the text, and one file puts words to them.

use std::collections::HashSet;

mod brackets;
mod checks;
mod expectation;
mod lines;
mod load;
mod parts;
mod piece;
mod problem;
mod reader;
mod replacement;
mod suggestion;
mod words;
mod write;

pub use expectation::*;
pub use lines::Lines;
pub use load::{FileError, LoadError, MAX_BYTES, load};
pub use parts::*;
pub use problem::*;
pub use replacement::ReplacementError;
pub use suggestion::nearest;
pub use words::{count, listed};

/// The version of the file format that this program reads and writes.
pub const VERSION: u32 = 1;

/// A file as far as it could be read.
pub struct Draft {
    /// What could be read; parts with a problem are left out or hold something harmless.
    pub description: Description,
    /// What is wrong with the form of the file, in the order of the text.
    pub problems: Vec<Problem>,
    /// Names whose definitions have one of these problems: what they stand for is not known.
    pub doubtful: HashSet<String>,
}

impl Draft {
    /// Reads the text of a mechanism file as far as possible; nothing of a text without any structure.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, mut problems, mut doubtful) = reader::read(text);
        if let Some(description) = &description {
            checks::check(description, &mut problems);
        }
        let names = problems.iter().filter_map(|problem| match &problem.kind {
            ProblemKind::NotAName { name, .. }
            | ProblemKind::DottedName { name, .. }
            | ProblemKind::DuplicateName { name, .. } => Some(name.clone()),
            _ => None,
        });
        doubtful.extend(names);
        problems.sort_by_key(|problem| (problem.span.start, problem.span.end));
        match description {
            Some(description) => Ok(Draft {
                description,
                problems,
                doubtful,
            }),
            None => Err(problems),
        }
    }

    /// Whether a problem with the meaning may be there only because a part could not be read: a name whose
    /// definition, or the map that holds it, has a problem of form.
    pub fn explains(&self, problem: &Problem) -> bool {
        let doubtful = |name: &str| self.doubtful.contains(name);
        match &problem.kind {
            ProblemKind::UnknownName { name, .. } => {
                let nouns = [Noun::Parameter, Noun::Joint, Noun::LocalName];
                doubtful(name) || nouns.into_iter().any(|noun| self.lost(noun, name))
            }
            ProblemKind::UnknownFrame { name, .. } => {
                let owner = name.split('.').next().unwrap_or(name);
                let mut parts = name.split('.').chain([name.as_str()]);
                let nouns = [Noun::Chain, Noun::Platform];
                parts.any(doubtful) || nouns.into_iter().any(|noun| self.lost(noun, owner))
            }
            // unreadable rows are counted; only where none are may there be more
            ProblemKind::NoSuchLink { chain, rows, .. } => {
                doubtful(chain) && (*rows == 0 || self.is_double(chain))
            }
            ProblemKind::DefinitionCycle { names, .. } | ProblemKind::ChainCycle { names } => {
                names.iter().any(|name| self.is_double(name))
            }
            ProblemKind::NothingToAnalyse => true,
            _ => false,
        }
    }

    fn is_double(&self, wanted: &str) -> bool {
        let double = |problem: &Problem| match &problem.kind {
            ProblemKind::DuplicateName { name, .. } => name == wanted,
            _ => false,
        };
        self.problems.iter().any(double)
    }

    /// Whether a name of a kind may have been given where it was not read.
    fn lost(&self, noun: Noun, wanted: &str) -> bool {
        self.problems.iter().any(|problem| match &problem.kind {
            ProblemKind::WrongType { expected, found } => match found {
                Found::Word(word) if *expected == Expected::NameOf(noun) => word == wanted,
                _ => *expected == Expected::MapOf(noun),
            },
            ProblemKind::UnknownField { structure, .. } => match noun {
                Noun::LocalName => *structure == Structure::ClosedForm,
                _ => *structure == Structure::Mechanism,
            },
            ProblemKind::DuplicateField { .. } | ProblemKind::Syntax { .. } => true,
            _ => false,
        })
    }
}

impl Description {
    /// Reads the text of a mechanism file, or says what is wrong with its form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let draft = Draft::read(text)?;
        match draft.problems.is_empty() {
            true => Ok(draft.description),
            false => Err(draft.problems),
        }
    }
}
