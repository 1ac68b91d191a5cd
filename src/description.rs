//! The mechanism file, well formed but not yet meaningful.
//!
//! Text becomes a [`Description`] in which every field has the right type, every expression parses and every name
//! is a possible name. Whether the names refer to anything is asked later. All problems of a file are found in one
//! reading; each is a [`Problem`] that points into the text, and one file puts words to them.

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
pub use words::count;

/// The version of the file format that this program reads and writes.
pub const VERSION: u32 = 1;

impl Description {
    /// Reads the text of a mechanism file, or says everything that is wrong with it, in the order of the text.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let (description, mut problems) = reader::read(text);
        if let Some(description) = &description {
            checks::check(description, &mut problems);
        }
        problems.sort_by_key(|problem| (problem.span.start, problem.span.end));
        match description {
            Some(description) if problems.is_empty() => Ok(description),
            _ => Err(problems),
        }
    }
}
