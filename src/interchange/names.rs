//! Names that a mechanism file may use.

use std::collections::{HashMap, HashSet};

use super::remark::Remark;
use crate::algebra::{is_name, is_reserved};
use crate::description::{GROUND, first_free};

/// Names given so far.
#[derive(Default)]
pub(super) struct Names {
    variables: HashSet<String>,
    bodies: HashSet<String>,
    /// The requested name of each platform.
    platforms: HashMap<String, String>,
    /// The requested name of each frame.
    frames: HashMap<String, String>,
    renamed: Vec<(&'static str, String, String)>,
}

impl Names {
    /// A name for a joint variable: letters, digits and underscores.
    pub fn variable(&mut self, wanted: &str) -> String {
        let allowed = |c: char| c.is_alphanumeric() || c == '_';
        let name = wanted.replace(|c| !allowed(c), "_");
        let possible = |name: &String| is_name(name) && !is_reserved(name);
        let mut names = [name.clone(), format!("q_{name}")].into_iter();
        let name = names.find(possible).unwrap_or("q".into());
        let name = first_free(&name, "_", |name| !self.variables.contains(name));
        self.variables.insert(name.clone());
        self.note("joint", wanted, &name);
        name
    }

    /// A name for a platform.
    pub fn platform(&mut self, wanted: &str) -> String {
        let name = self.body(wanted);
        self.platforms.insert(wanted.to_owned(), name.clone());
        name
    }

    /// The name given to the platform for which `wanted` was requested.
    pub fn of_platform(&self, wanted: &str) -> String {
        let name = self.platforms.get(wanted).cloned();
        name.unwrap_or_else(|| fit(wanted))
    }

    /// A name for a frame, or for the chain that ends there.
    pub fn frame(&mut self, wanted: &str) -> String {
        let name = self.body(wanted);
        self.frames.insert(wanted.to_owned(), name.clone());
        name
    }

    /// The name given to the frame for which `wanted` was requested, if there is one.
    pub fn of_frame(&self, wanted: &str) -> Option<&String> {
        self.frames.get(wanted)
    }

    fn body(&mut self, wanted: &str) -> String {
        let name = first_free(&fit(wanted), "_", |name| !self.bodies.contains(name));
        self.bodies.insert(name.clone());
        self.note("link", wanted, &name);
        name
    }

    fn note(&mut self, noun: &'static str, wanted: &str, name: &str) {
        if wanted != name {
            self.renamed
                .push((noun, wanted.to_owned(), name.to_owned()));
        }
    }

    /// The items that had to be renamed.
    pub fn renamed(self) -> Vec<Remark> {
        let renamed = self.renamed.into_iter();
        renamed
            .map(|(noun, from, to)| Remark::Renamed { noun, from, to })
            .collect()
    }
}

/// A valid name for a chain, platform or frame in place of `wanted`.
pub(super) fn fit(wanted: &str) -> String {
    let name = wanted.trim().replace('.', "_");
    match name.as_str() {
        "" => "frame".into(),
        GROUND => format!("{GROUND}_"),
        _ => name,
    }
}
