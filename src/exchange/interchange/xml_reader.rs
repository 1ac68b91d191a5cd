//! An XML text being read: its elements and their problems.

use std::ops::Range;

use quick_xml::Reader;
use quick_xml::events::Event;
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
    Document::parse(text).map_err(|error| {
        let position = error.pos();
        let mut message = error.to_string();
        // the position is reported separately from the text
        if let Some(end) = message
            .rfind(" at ")
            .filter(|&at| message[at..].contains(':'))
        {
            message.truncate(end);
        }
        let start = Lines::new(text).offset(position.row as usize, position.col as usize);
        ImportProblemKind::Syntax { message }.at(start..next_char(text, start))
    })
}

/// The text as strict XML, with everything in its place: other readers pass over blanks before the declaration, and over
/// `--` in comments.
pub(super) fn strict(mut text: String) -> String {
    let mut at = 0;
    while let Some(start) = text[at..].find("<!--").map(|found| at + found + 4) {
        let end = text[start..].find("-->").map_or(text.len(), |n| start + n);
        let comment = &text[start..end];
        if comment.contains("--") || comment.ends_with('-') {
            let comment = comment.replace('-', "~");
            text.replace_range(start..end, &comment);
        }
        at = end;
    }
    let start = text.len() - text.trim_start().len();
    let end = text[start..].find("?>").map_or(0, |end| start + end + 2);
    if start > 0 && text[start..].starts_with("<?xml ") {
        text.replace_range(start..end, &" ".repeat(end - start));
    }
    text
}

/// Refuses elements that are nested too deeply.
fn check_depth(text: &str) -> Result<(), ImportProblem> {
    let mut reader = Reader::from_str(text);
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_unmatched_ends = true;
    let mut depth: usize = 0;
    loop {
        let start = reader.buffer_position() as usize;
        match reader.read_event() {
            Ok(Event::Start(_)) => depth += 1,
            Ok(Event::End(_)) => depth = depth.saturating_sub(1),
            // whatever else is wrong here ends the document for the other reader too
            Ok(Event::Eof) | Err(_) => return Ok(()),
            Ok(_) => {}
        }
        if depth > MOST_LEVELS {
            let problem = ImportProblemKind::TooDeep { most: MOST_LEVELS };
            return Err(problem.at(start..next_char(text, start)));
        }
    }
}

/// Position behind the `>` of a tag; one within quotes does not count.
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

/// Place of the start tag of an element.
pub(super) fn tag(node: Node) -> Range<usize> {
    let range = node.range();
    let text = node.document().input_text();
    let end = tag_end(text.as_bytes(), range.start).min(range.end);
    range.start..end.max(range.start)
}

/// Place of the value of an attribute.
fn value_span(node: Node, name: &str) -> Range<usize> {
    let found = node.attribute_node(name);
    found.map_or_else(|| tag(node), |attribute| attribute.range_value())
}

/// The elements in an element, of a name.
pub(super) fn children<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Vec<Node<'a, 'i>> {
    let named = |child: &Node| child.is_element() && child.tag_name().name() == name;
    node.children().filter(named).collect()
}

/// The first of them.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(node, name).into_iter().next()
}

impl Problems {
    /// Forgets what was said after the first so many; true if there was something.
    pub fn forget_after(&mut self, count: usize) -> bool {
        let more = self.0.len() > count;
        self.0.truncate(count);
        more
    }

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

    /// A name that is given again.
    pub fn duplicate(&mut self, noun: &'static str, name: &str, node: Node) {
        let name = name.to_owned();
        self.say(ImportProblemKind::Duplicate { noun, name }, node);
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
        self.values(node, name, N)?.try_into().ok()
    }

    /// The numbers of an attribute, `count` of them, if it is there.
    pub fn values(&mut self, node: Node, name: &str, count: usize) -> Option<Vec<f64>> {
        self.parsed(node.attribute(name)?, count, value_span(node, name))
    }

    /// The finite numbers of a text, `count` of them.
    pub fn parsed(&mut self, text: &str, count: usize, span: Range<usize>) -> Option<Vec<f64>> {
        let found = parse(text).filter(|numbers| numbers.len() == count);
        if found.is_none() {
            self.not_numbers(text, count, span);
        }
        found
    }

    pub fn not_numbers(&mut self, text: &str, count: usize, span: Range<usize>) {
        let text = text.chars().take(40).collect();
        let kind = ImportProblemKind::NotNumbers { text, count };
        self.0.push(kind.at(span));
    }

    /// A number of an attribute; it may be infinite.
    pub fn number(&mut self, node: Node, name: &str) -> Option<f64> {
        let text = node.attribute(name)?;
        let found = text.trim().parse().ok().filter(|x: &f64| !x.is_nan());
        if found.is_none() {
            self.not_numbers(text, 1, value_span(node, name));
        }
        found
    }

    /// The unit vector along an axis, written as in the example.
    pub fn axis(
        &mut self,
        along: [f64; 3],
        joint: &str,
        example: &'static str,
        node: Node,
    ) -> Option<Vector3<f64>> {
        let found = direction(along);
        if found.is_none() {
            let joint = joint.to_owned();
            self.say(ImportProblemKind::NoAxis { joint, example }, node);
        }
        found
    }

    /// `xyz` and `rpy` of an element.
    pub fn origin(&mut self, node: Node) -> Pose<f64> {
        let position = self.numbers(node, "xyz").unwrap_or_default();
        let [roll, pitch, yaw] = self.numbers(node, "rpy").unwrap_or_default();
        pose_of(position, [roll, pitch, yaw])
    }

    /// The meaning of an attribute that must be one of the known words.
    pub fn word<T: Copy>(
        &mut self,
        node: Node,
        name: &str,
        known: &[(&'static str, T)],
    ) -> Option<T> {
        let word = self.needed(node, name)?;
        let found = known.iter().find(|(known, _)| *known == word);
        if found.is_none() {
            let (word, known) = (word.into(), known.iter().map(|(word, _)| *word).collect());
            let problem = ImportProblemKind::UnknownWord { word, known };
            self.0.push(problem.at(value_span(node, name)));
        }
        found.map(|(_, meaning)| *meaning)
    }

    /// The object that an attribute names, if it was found.
    pub fn known<'k, T>(
        &mut self,
        found: Option<T>,
        (node, attribute): (Node, &str),
        (noun, name): (&'static str, &str),
        known: impl Iterator<Item = &'k str>,
    ) -> Option<T> {
        if found.is_none() {
            let problem = ImportProblemKind::Unknown {
                noun,
                name: name.into(),
                suggestion: nearest(name, known).map(str::to_owned),
            };
            self.0.push(problem.at(value_span(node, attribute)));
        }
        found
    }
}

/// The version of the format that a file says it has, unless it says none that can be read.
pub(super) fn version(root: Node) -> Option<(u32, u32)> {
    let (major, minor) = root.attribute("version")?.trim().split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// Finite numbers.
pub(super) fn parse(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.parse::<f64>().ok().filter(|x| x.is_finite());
    text.split_whitespace().map(number).collect()
}

/// The unit vector along three numbers, if they give a direction.
pub(super) fn direction([x, y, z]: [f64; 3]) -> Option<Vector3<f64>> {
    let v = Vector3([x, y, z]);
    let largest = x.abs().max(y.abs()).max(z.abs());
    if !largest.is_finite() || largest < 1e-12 {
        return None;
    }
    let scaled = v.times(1.0 / largest);
    Some(scaled.times(1.0 / scaled.norm()))
}

/// The coordinate axis most across a direction.
pub(super) fn least_along(axis: &Vector3<f64>) -> usize {
    let size = |i: usize| axis.0[i].abs();
    (0..3).fold(0, |i, j| if size(j) < size(i) { j } else { i })
}

/// A rotation that turns z into a direction; axes of coordinates stay exact.
pub(super) fn along_z(axis: &Vector3<f64>) -> Pose<f64> {
    // the coordinate axis most across the direction becomes x as nearly as it can
    let e = Vector3::unit(least_along(axis));
    let across = e - axis.times(axis.dot(&e));
    let x = across.times(1.0 / across.norm());
    Pose {
        rotation: Rotation([x, axis.cross(&x), *axis]),
        position: Vector3::zero(),
    }
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
    let clean = |x: f64| match x.round() {
        whole if (x - whole).abs() < 4.0 * f64::EPSILON => whole + 0.0,
        _ => x,
    };
    let cleaned = Rotation(rotation.0.map(|column| column.map(clean)));
    // all three axes are along coordinates, or one is and the others are turned about it
    let planar = cleaned.0.iter().flat_map(|c| c.0).any(|x| x.abs() == 1.0);
    if planar { cleaned } else { rotation }
}
