//! Options that give coordinates ranges, `NAME=FROM..TO`.

use linkwork::mechanism::Mechanism;
use linkwork::output::option::{Complaint, Part};
use linkwork::system::{Driven, Question, QuestionError};

use super::asked::refusal;
use super::source::{Assignment, once};
use super::{Refusal, style};

/// What is said of a value that is no range, and of the range that is refused.
pub struct RangeWords {
    pub no_range: fn(&str) -> (Complaint, Part),
    pub refused: fn(&str, &str) -> (Complaint, Part),
}

/// The ranges of an option; `refuse` tells whether one is no use.
pub fn ranges(
    mechanism: &Mechanism,
    option: &str,
    given: &[Assignment],
    refuse: fn(f64, f64) -> bool,
    words: &RangeWords,
) -> Result<Vec<Driven>, Refusal> {
    once(option, given)?;
    let question = Question::new(mechanism);
    let mut ranges = Vec::new();
    for assignment in given {
        let given = assignment.given(option);
        // a wrong name is the first thing to say
        let name = &assignment.name;
        (question.value(name, "home")).map_err(|error| refusal(&error, Some(given)))?;
        let Some((first, last)) = assignment.value.split_once("..") else {
            let (complaint, part) = (words.no_range)(name);
            return Err(Refusal(complaint.render_in(&given, &part, style())));
        };
        let end = |text: &str, at: usize| {
            (question.value(name, text))
                .map_err(|error| within(&error, assignment, option, text, at))
        };
        let (coordinate, from) = end(first, 0)?;
        let (_, to) = end(last, first.len() + 2)?;
        if refuse(from, to) {
            let (complaint, part) = (words.refused)(name, first);
            return Err(Refusal(complaint.render_in(&given, &part, style())));
        }
        ranges.push(Driven {
            coordinate,
            from,
            to,
        });
    }
    Ok(ranges)
}

/// A wrong end of a range, underlined where it stands.
fn within(
    error: &QuestionError,
    assignment: &Assignment,
    option: &str,
    text: &str,
    at: usize,
) -> Refusal {
    let (complaint, _) = linkwork::output::question::complaint(error);
    let part = Part::Value(at..at + text.len());
    let given = assignment.given(option);
    Refusal(complaint.render_in(&given, &part, style()))
}
