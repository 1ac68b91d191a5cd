//! Values at which further coordinates of a question can be held.

use super::{Question, RESTARTS};
use crate::solve::Watch;

/// A coordinate with a value at which it can be held.
#[derive(Clone, Debug, PartialEq)]
pub struct Holdable {
    /// Its name.
    pub name: String,
    /// The value, rad or m; `None` for the value in the file.
    pub value: Option<f64>,
    /// True if it is an angle.
    pub is_angle: bool,
}

impl Question {
    /// Values at which further coordinates can be held: those of the file if the mechanism assembles with
    /// them, otherwise those that they have where it assembles. `None` if no assembly was found.
    pub fn holdable(&self, names: &[String]) -> Option<Vec<Holdable>> {
        let found = |question: &Question| {
            let resolved = question.resolved().ok()?;
            self.nearest(&resolved, RESTARTS, &Watch::none())
        };
        let with_home = names
            .iter()
            .fold(self.clone(), |question, name| question.hold(name, "home"));
        let there = match found(&with_home) {
            Some(_) => None,
            None => Some(found(self)?),
        };
        let resolved = self.resolved().ok()?;
        let holdable = |name: &String| {
            let (coordinate, _) = resolved.value(name, "home").ok()?;
            Some(Holdable {
                name: name.clone(),
                value: there.as_ref().map(|at| coordinate.of(&self.mechanism, at)),
                is_angle: coordinate.is_angle(&self.mechanism),
            })
        };
        names.iter().map(holdable).collect()
    }
}
