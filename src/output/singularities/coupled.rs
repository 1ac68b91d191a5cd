//! Outputs that may hide what their positions lose, in sentences.

use super::names;
use crate::analysis::singularities::Coupled;
use crate::description::{count, listed};

/// That outputs are full poses with fewer freedoms than directions, and how to ask about a part.
pub fn note(coupled: &[Coupled]) -> Option<String> {
    let first = coupled.first()?;
    let all: Vec<String> = coupled.iter().map(|c| c.output.clone()).collect();
    let freedoms = count(first.freedoms, "freedom");
    let taken = match all.len() {
        1 => format!(
            "the output {} is a full pose, of which only {freedoms} can be chosen",
            first.output
        ),
        _ => format!(
            "the outputs {} are full poses, with fewer freedoms than directions",
            names(&all)
        ),
    };
    let lost: Vec<String> = coupled
        .iter()
        .filter_map(|c| match c.origin_loses? {
            0 => None,
            n => Some(format!(
                "the origin of {} alone loses {}",
                c.output,
                count(n, "freedom")
            )),
        })
        .collect();
    let hidden = match lost.is_empty() {
        true => "singularities of its position alone are not reported".to_owned(),
        false => format!("{} here", names(&lost)),
    };
    let coordinates = match first.coordinates.is_empty() {
        true => String::new(),
        false => format!(", or some of {}", listed(&first.coordinates)),
    };
    Some(format!(
        "{taken}: {hidden}. For these take the point `{}` as the output{coordinates}.",
        first.output
    ))
}
