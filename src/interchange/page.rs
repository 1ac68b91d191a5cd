//! An XML text being read: its elements and their problems.

use std::ops::Range;

use roxmltree::{Document, Node};

use super::problem::{ImportProblem, ImportProblemKind};
use crate::description::{Lines, nearest};
use crate::geometry::{Axis, Pose, Quaternion, Rotation, Vector3};

/// The largest depth of nested elements: readers of the formats recurse for each level.
const MOST_LEVELS: usize = 400;

/// Problems gathered while a text is read.
pub(super) struct Problems(pub Vec<ImportProblem>);

/// The elements of a text, if it is XML that is not too deep.
pub(super) fn document(text: &str) -> Result<Document<'_>, ImportProblem> {
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        return Err(ImportProblemKind::Empty.anywhere());
    }
    // what is not XML at all may be no model but anything, and is not shown
    if !text
        .trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('<')
    {
        let message = "it does not begin with `<`".into();
        return Err(ImportProblemKind::Syntax { message }.anywhere());
    }
    // the reader recurses for each level too
    check_depth(text)?;
    let document = Document::parse(text).map_err(|error| {
        let position = error.pos();
        let message = error.to_string();
        // the position is reported separately from the text
        let message = match message.rfind(" at ") {
            Some(end) if message[end..].contains(':') => message[..end].to_owned(),
            _ => message,
        };
        let start = Lines::new(text).offset(position.row as usize, position.col as usize);
        ImportProblemKind::Syntax { message }.at(start..next_char(text, start))
    })?;
    Ok(document)
}

/// Counts opening and closing tags, accurately enough to bound the depth.
fn check_depth(text: &str) -> Result<(), ImportProblem> {
    let bytes = text.as_bytes();
    let mut depth: usize = 0;
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        let start = at + found;
        let rest = &text[start..];
        let skip = |end: &str| rest.find(end).map_or(text.len(), |i| start + i + end.len());
        at = if rest.starts_with("<!--") {
            skip("-->")
        } else if rest.starts_with("<![CDATA[") {
            skip("]]>")
        } else if rest.starts_with("<?") {
            skip("?>")
        } else {
            let end = tag_end(bytes, start);
            if rest.starts_with("</") {
                depth = depth.saturating_sub(1);
            } else if bytes[end.saturating_sub(2).max(start)] != b'/' {
                depth += 1;
            }
            if depth > MOST_LEVELS {
                let problem = ImportProblemKind::TooDeep { most: MOST_LEVELS };
                return Err(problem.at(start..next_char(text, start)));
            }
            end
        };
        if at >= text.len() {
            break;
        }
    }
    Ok(())
}

/// Behind the `>` of a tag; one within quotes does not count.
fn tag_end(bytes: &[u8], start: usize) -> usize {
    let mut quote = None;
    for (i, &byte) in bytes.iter().enumerate().skip(start) {
        match (quote, byte) {
            (None, b'>') => return i + 1,
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), byte) if open == byte => quote = None,
            _ => {}
        }
    }
    bytes.len()
}

fn next_char(text: &str, start: usize) -> usize {
    text[start..]
        .chars()
        .next()
        .map_or(start, |c| start + c.len_utf8())
}

/// Where the start tag of an element stands.
pub(super) fn tag(node: Node) -> Range<usize> {
    let range = node.range();
    let text = node.document().input_text();
    let end = tag_end(text.as_bytes(), range.start).min(range.end);
    range.start..end.max(range.start)
}

/// Where the value of an attribute stands.
fn value_span(node: Node, name: &str) -> Range<usize> {
    let found = node.attribute_node(name).map(|attribute| {
        let range = attribute.range();
        let text = &node.document().input_text()[range.clone()];
        let from = text.find(['"', '\'']).map_or(0, |i| i + 1);
        range.start + from..range.end.saturating_sub(1).max(range.start + from)
    });
    found.unwrap_or_else(|| tag(node))
}

/// The elements in an element, of a name.
pub(super) fn children<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Vec<Node<'a, 'i>> {
    let elements = node.children().filter(|child| child.is_element());
    elements
        .filter(|child| child.tag_name().name() == name)
        .collect()
}

/// The first of them.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(node, name).into_iter().next()
}

impl Problems {
    pub fn say(&mut self, kind: ImportProblemKind, node: Node) {
        self.0.push(kind.at(tag(node)));
    }

    /// Something that linkwork cannot read, and what to do; there is nothing in its place.
    pub fn unsupported<T>(
        &mut self,
        what: impl Into<String>,
        help: &'static str,
        node: Node,
    ) -> Option<T> {
        let what = what.into();
        self.say(ImportProblemKind::Unsupported { what, help }, node);
        None
    }

    /// Something that an element must have.
    pub fn missing(&mut self, node: Node, needs: String) {
        let element = node.tag_name().name().into();
        self.say(ImportProblemKind::Missing { element, needs }, node);
    }

    /// An attribute that must be there.
    pub fn needed<'a>(&mut self, node: Node<'a, '_>, name: &str) -> Option<&'a str> {
        let found = node.attribute(name);
        if found.is_none() {
            self.missing(node, format!("`{name}`"));
        }
        found
    }

    /// An element that must be in another.
    pub fn needed_child<'a, 'i>(&mut self, node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
        let found = child(node, name);
        if found.is_none() {
            self.missing(node, format!("element `{name}`"));
        }
        found
    }

    /// Numbers of an attribute, if it is there.
    pub fn numbers<const N: usize>(&mut self, node: Node, name: &str) -> Option<[f64; N]> {
        let text = node.attribute(name)?;
        let found = parse(text);
        if found.is_none() {
            self.not_numbers(text, N, value_span(node, name));
        }
        found
    }

    pub fn not_numbers(&mut self, text: &str, count: usize, span: Range<usize>) {
        let text = text.chars().take(40).collect();
        let kind = ImportProblemKind::NotNumbers { text, count };
        self.0.push(kind.at(span));
    }

    /// One number of an attribute; it may be infinite.
    pub fn number(&mut self, node: Node, name: &str) -> Option<f64> {
        let text = node.attribute(name)?;
        let found = text.trim().parse().ok().filter(|x: &f64| !x.is_nan());
        if found.is_none() {
            self.not_numbers(text, 1, value_span(node, name));
        }
        found
    }

    /// `xyz` and `rpy` of an element.
    pub fn origin(&mut self, node: Node) -> Pose<f64> {
        let position = self.numbers(node, "xyz").unwrap_or_default();
        let [roll, pitch, yaw] = self.numbers(node, "rpy").unwrap_or_default();
        pose_of(position, [roll, pitch, yaw])
    }

    /// The word of an attribute that must be one of those known.
    pub fn word(
        &mut self,
        node: Node,
        name: &str,
        known: &'static [&'static str],
    ) -> Option<&'static str> {
        let word = self.needed(node, name)?;
        if let Some(found) = known.iter().find(|known| **known == word) {
            return Some(found);
        }
        let word = word.into();
        let problem = ImportProblemKind::UnknownWord { word, known };
        self.0.push(problem.at(value_span(node, name)));
        None
    }

    /// An unknown name in an attribute.
    pub fn unknown(
        &mut self,
        node: Node,
        attribute: &str,
        noun: &'static str,
        name: &str,
        known: &[String],
    ) {
        let suggestion = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
        let problem = ImportProblemKind::Unknown {
            noun,
            name: name.into(),
            suggestion,
        };
        self.0.push(problem.at(value_span(node, attribute)));
    }
}

/// The given number of finite numbers.
pub(super) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers = text
        .split_whitespace()
        .map(|word| word.parse::<f64>().ok().filter(|x| x.is_finite()));
    let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// A position and roll, pitch and yaw as a pose; right angles are exact.
pub(super) fn pose_of(position: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Pose<f64> {
    Pose::translation(Vector3(position))
        * Pose::rotation(Axis::Z, yaw)
        * Pose::rotation(Axis::Y, pitch)
        * Pose::rotation(Axis::X, roll)
}

/// The rotation of a quaternion (w, x, y, z) of any length but zero; right angles are exact.
pub(super) fn turned(quaternion: [f64; 4]) -> Rotation<f64> {
    exact(Quaternion(quaternion).normalised().rotation())
}

/// Entries that differ from 0, 1 and −1 by rounding made exact, so that planar linkages stay planar.
fn exact(rotation: Rotation<f64>) -> Rotation<f64> {
    let clean = |x: f64| {
        let whole = x.round();
        if (x - whole).abs() < 4.0 * f64::EPSILON {
            whole + 0.0
        } else {
            x
        }
    };
    let cleaned = Rotation(rotation.0.map(|column| column.map(clean)));
    let axes = cleaned
        .0
        .iter()
        .filter(|column| column.0.iter().any(|x| x.abs() == 1.0));
    // all three axes are along coordinates, or one is and the others are turned about it
    if axes.count() > 0 { cleaned } else { rotation }
}
