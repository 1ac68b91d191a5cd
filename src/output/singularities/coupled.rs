//! What is said of outputs that may hide what their positions lose.

use super::names;
use crate::analysis::singularities::Coupled;

/// That the outputs are whole poses with fewer freedoms than directions, and how to ask about a part.
pub fn note(coupled: &[Coupled]) -> Option<String> {
    let first = coupled.first()?;
    let all: Vec<String> = coupled.iter().map(|c| c.output.clone()).collect();
    let freedoms = match first.freedoms {
        1 => "1 freedom".to_owned(),
        n => format!("{n} freedoms"),
    };
    let taken = match all.len() {
        1 => format!(
            "the output {} is taken with its turning, and has {freedoms} for more directions than that",
            first.output
        ),
        _ => format!(
            "the outputs {} are taken with their turning, and have fewer freedoms than directions",
            names(&all)
        ),
    };
    let lost: Vec<String> = coupled
        .iter()
        .filter_map(|c| match c.origin_loses? {
            0 => None,
            1 => Some(format!("the origin of {} alone loses 1 freedom", c.output)),
            n => Some(format!(
                "the origin of {} alone loses {n} freedoms",
                c.output
            )),
        })
        .collect();
    let hidden = match lost.is_empty() {
        true => "what its position alone loses does not show".to_owned(),
        false => format!("{} here", names(&lost)),
    };
    let coordinates: Vec<String> = (first.coordinates.iter())
        .map(|c| format!("--output {c}"))
        .collect();
    let coordinates = match coordinates.is_empty() {
        true => String::new(),
        false => format!(", or for coordinates of it with {}", coordinates.join(" ")),
    };
    Some(format!(
        "{taken}: {hidden}. Ask for its position with --point {}{coordinates}.",
        first.output
    ))
}

/// The note as a line of text.
pub(super) fn line(coupled: &[Coupled]) -> String {
    note(coupled).map_or(String::new(), |note| format!("note: {note}\n"))
}
