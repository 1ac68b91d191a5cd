//! Names that a mechanism file may use.

use std::collections::{HashMap, HashSet};

use super::remark::Remark;
use crate::algebra::{is_name, is_reserved};
use crate::description::GROUND;

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
        let fit = |c: char| {
            if c.is_alphanumeric() || c == '_' {
                c
            } else {
                '_'
            }
        };
        let mut name: String = wanted.chars().map(fit).collect();
        if !is_name(&name) || is_reserved(&name) {
            name = format!("q_{name}");
        }
        if !is_name(&name) || is_reserved(&name) {
            name = "q".into();
        }
        let name = unique(name, &self.variables);
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
        let name = unique(fit(wanted), &self.bodies);
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
    let name: String = wanted
        .trim()
        .chars()
        .map(|c| if c == '.' { '_' } else { c })
        .collect();
    match name.as_str() {
        "" => "frame".into(),
        GROUND => format!("{GROUND}_"),
        _ => name,
    }
}

fn unique(name: String, taken: &HashSet<String>) -> String {
    let mut numbered = (2..).map(|i| format!("{name}_{i}"));
    if !taken.contains(&name) {
        return name;
    }
    numbered.find(|name| !taken.contains(name)).unwrap_or(name)
}
