//! Names that a mechanism file may use.

use std::collections::{HashMap, HashSet};

use super::remark::Remark;
use crate::description::{GROUND, first_free, variable_name};

/// Names given so far.
#[derive(Default)]
pub(super) struct Names {
    variables: HashSet<String>,
    bodies: HashSet<String>,
    /// The name given to the platform for which another one was requested.
    pub platforms: HashMap<String, String>,
    /// The name given to the frame for which another one was requested.
    pub frames: HashMap<String, String>,
    /// What had to be renamed.
    pub renamed: Vec<Remark>,
}

impl Names {
    /// A name for a joint variable: letters, digits and underscores.
    pub fn variable(&mut self, wanted: &str) -> String {
        let free = |name: &str| !self.variables.contains(name);
        let name = first_free(&variable_name(wanted), "_", free);
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

    /// A name for a frame, or for the chain that ends there.
    pub fn frame(&mut self, wanted: &str) -> String {
        let name = self.body(wanted);
        self.frames.insert(wanted.to_owned(), name.clone());
        name
    }

    fn body(&mut self, wanted: &str) -> String {
        let name = first_free(&fit(wanted), "_", |name| !self.bodies.contains(name));
        self.bodies.insert(name.clone());
        self.note("link", wanted, &name);
        name
    }

    fn note(&mut self, noun: &'static str, wanted: &str, name: &str) {
        if wanted != name {
            let (from, to) = (wanted.to_owned(), name.to_owned());
            self.renamed.push(Remark::Renamed { noun, from, to });
        }
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
