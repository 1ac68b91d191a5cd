//! Names of things: their places in lists, and new ones.

use super::{Description, GROUND, Named};
use crate::algebra::{is_name, is_reserved};

/// The place of a name among named things.
pub fn place_of<T>(named: &[Named<T>], name: &str) -> Option<usize> {
    named.iter().position(|named| named.name.value == name)
}

/// The names of named things.
pub fn names_of<T>(named: &[Named<T>]) -> impl Iterator<Item = &str> {
    named.iter().map(|named| named.name.value.as_str())
}

/// `wanted`, or the first of it with 2, 3, … behind a separator that is free.
pub(crate) fn first_free(wanted: &str, separator: &str, free: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|i| format!("{wanted}{separator}{i}"));
    let mut names = std::iter::once(wanted.to_owned()).chain(numbered);
    names.find(|name| free(name)).unwrap_or_default()
}

/// Other characters than those of names of variables replaced.
fn clean(wanted: &str) -> String {
    wanted.replace(|c| !is_name(&format!("_{c}")), "_")
}

/// A name like `wanted` that expressions may use, with letters, digits, underscores and blanks only.
pub(crate) fn variable_name(wanted: &str) -> String {
    if is_name(wanted) && !is_reserved(wanted) {
        return wanted.to_owned();
    }
    let clean = clean(wanted);
    match is_name(&clean) && !is_reserved(&clean) {
        true => clean,
        false => format!("q_{clean}"),
    }
}

/// As [`variable_name`], but a free name.
pub(crate) fn free_variable(wanted: &str, free: impl Fn(&str) -> bool) -> String {
    let name = variable_name(wanted);
    match free(&name) {
        true => name,
        false => first_free(&format!("q_{}", clean(wanted)), "_", free),
    }
}

impl Description {
    /// True if a chain or platform that is added may have this name.
    pub(crate) fn is_free_body(&self, name: &str) -> bool {
        let taken = place_of(&self.chains, name).or(place_of(&self.platforms, name));
        let rows = self.chains.iter().flat_map(|chain| &chain.value.rows);
        let mut links = rows.filter_map(|row| row.link.as_ref());
        name != GROUND && taken.is_none() && links.all(|link| link.value != name)
    }
}
