//! The mechanism file: well formed, its names not yet resolved.
//!
//! Text becomes a [`Description`] in which every field has the right type, every expression parses and every name
//! is a possible name. Names are resolved later, by [`Mechanism`](crate::mechanism::Mechanism). All problems of a file
//! are found in one reading; each is a [`Problem`] with its place in the text.

use std::collections::HashSet;

mod axes;
mod checks;
mod closure_kind;
mod design;
mod embedded;
mod expectation;
mod file_fields;
mod files;
mod lexemes;
mod lines;
mod literals;
mod naming;
mod numbers;
mod parts;
mod piece;
mod problem;
mod reader;
mod replacement;
pub mod steps;
mod suggestion;
mod words;
mod write;

pub use axes::Graph;
pub use axes::*;
pub(crate) use closure_kind::FREE;
pub use closure_kind::*;
pub use design::{DesignDescription, DesignGoal, DesignPart, Varied};
pub use embedded::{axes_text, mechanism_text};
pub use expectation::*;
pub use files::{FileError, LoadError, load, load_text, load_text_within, text_from};
pub use lines::Lines;
pub use literals::{Literal, WrittenVector, rounding_of_text, roundings};
pub use naming::variable_name;
pub use naming::{GivenNames, first_free, free_variable};
pub use naming::{names_of, place_of};
pub use parts::*;
pub use problem::*;
pub use reader::{is_design, is_mechanism};
pub use replacement::ReplacementError;
pub use suggestion::nearest;
pub use words::joined;
pub use words::{count, listed, quoted};

use crate::number::sorting::sort_by_key;

/// The largest file that is read unless another limit is given, in bytes: it guards against devices and mistaken names,
/// whose contents would fill the memory, and has room for a million joints.
pub const MAX_BYTES: u64 = 1 << 28;

/// The version of the file format that this program reads and writes.
pub const VERSION: u32 = 1;

/// A file as far as it could be read.
pub struct Draft {
    /// The description as far as it could be read; parts with a problem are left out or have harmless values.
    pub description: Description,
    /// The problems of form, in the order of the text.
    pub problems: Vec<Problem>,
    /// Names whose definitions have one of these problems: their meaning is unknown.
    pub doubtful: HashSet<String>,
    /// Names given twice.
    double: HashSet<String>,
    /// Kinds of names of which some may be in unread parts of the file.
    lost: HashSet<Noun>,
}

impl Draft {
    /// Reads the text of a mechanism file as far as possible; nothing of a text without any structure.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, mut problems, mut doubtful) = reader::read(text);
        if let Some(description) = description.as_ref().filter(|d| d.coordinates.is_none()) {
            checks::check(description, &mut problems);
        }
        let mut double = HashSet::new();
        let mut lost = HashSet::new();
        for problem in &problems {
            match &problem.kind {
                ProblemKind::NotAName { name, .. } | ProblemKind::DottedName { name, .. } => {
                    doubtful.insert(name.clone());
                }
                ProblemKind::DuplicateName { name, .. } => {
                    doubtful.insert(name.clone());
                    double.insert(name.clone());
                }
                // a name without its quotes
                ProblemKind::WrongType {
                    expected: Expected::NameOf(_),
                    found: FoundValue::Word(word),
                } => {
                    doubtful.insert(word.clone());
                }
                kind => lost.extend(may_hide(kind)),
            }
        }
        sort_by_key(&mut problems, |problem| {
            (problem.span.start, problem.span.end)
        });
        match description {
            Some(description) => Ok(Draft {
                description,
                problems,
                doubtful,
                double,
                lost,
            }),
            None => Err(problems),
        }
    }

    /// True if a problem of meaning may be a mere consequence of an unread part: a name whose
    /// definition, or the map that holds it, has a problem of form.
    pub fn explains(&self, problem: &Problem) -> bool {
        let doubtful = |name: &str| self.doubtful.contains(name);
        match &problem.kind {
            ProblemKind::UnknownName { name, .. } => {
                let nouns = [Noun::Parameter, Noun::Joint, Noun::LocalName];
                doubtful(name) || nouns.iter().any(|noun| self.lost.contains(noun))
            }
            ProblemKind::UnknownFrame { name, .. } => {
                let mut parts = name.split('.').chain([name.as_str()]);
                let nouns = [Noun::Chain, Noun::Platform];
                parts.any(doubtful) || nouns.iter().any(|noun| self.lost.contains(noun))
            }
            // unreadable rows are counted; only where none are may there be more
            ProblemKind::NoSuchLink { chain, rows, .. } => {
                doubtful(chain) && (*rows == 0 || self.double.contains(chain))
            }
            ProblemKind::DefinitionCycle { names, .. } | ProblemKind::ChainCycle { names } => {
                names.iter().any(|name| self.double.contains(name))
            }
            ProblemKind::NothingToAnalyse => true,
            _ => false,
        }
    }
}

/// The kinds of names that a problem of form may have kept from being read.
fn may_hide(kind: &ProblemKind) -> Vec<Noun> {
    const MAPS: [Noun; 4] = [Noun::Parameter, Noun::Joint, Noun::Chain, Noun::Platform];
    match kind {
        ProblemKind::WrongType {
            expected: Expected::MapOf(noun),
            ..
        } => vec![*noun],
        ProblemKind::UnknownField { structure, .. } => match *structure {
            Description::GROUP => MAPS.to_vec(),
            ClosedFormDescription::GROUP => vec![Noun::LocalName],
            _ => Vec::new(),
        },
        ProblemKind::DuplicateField { .. } | ProblemKind::Syntax { .. } => {
            [&MAPS[..], &[Noun::LocalName]].concat()
        }
        _ => Vec::new(),
    }
}

/// A value, unless there are problems.
pub fn unless<P, T>(problems: Vec<P>, value: T) -> Result<T, Vec<P>> {
    match problems.is_empty() {
        true => Ok(value),
        false => Err(problems),
    }
}

impl Description {
    /// Reads the text of a mechanism file, or returns its problems of form, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let draft = Draft::read(text)?;
        unless(draft.problems, draft.description)
    }
}
