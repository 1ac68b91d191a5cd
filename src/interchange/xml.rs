//! Elements written one after the other, in nested lines.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

use crate::geometry::{Pose, Quaternion, Vector3};

/// Text of nested elements.
pub(super) struct Xml(Writer<Vec<u8>>);

/// Writing into memory cannot fail.
const IN_MEMORY: &str = "memory can be written to";

impl Xml {
    pub fn new() -> Self {
        Xml(Writer::new_with_indent(Vec::new(), b' ', 2))
    }

    fn event(&mut self, event: Event) -> &mut Self {
        let written: io::Result<()> = self.0.write_event(event);
        written.expect(IN_MEMORY);
        self
    }

    pub fn comment(&mut self, text: &str) -> &mut Self {
        let text = text.replace("--", "- -");
        self.event(Event::Comment(BytesText::from_escaped(format!(" {text} "))))
    }

    pub fn open(&mut self, tag: &str, attributes: &[(&str, String)]) -> &mut Self {
        let start = BytesStart::new(tag).with_attributes(pairs(attributes));
        self.event(Event::Start(start))
    }

    pub fn close(&mut self, tag: &str) -> &mut Self {
        self.event(Event::End(BytesEnd::new(tag)))
    }

    pub fn leaf(&mut self, tag: &str, attributes: &[(&str, String)]) -> &mut Self {
        let start = BytesStart::new(tag).with_attributes(pairs(attributes));
        self.event(Event::Empty(start))
    }

    pub fn text(self) -> String {
        let mut text = String::from_utf8(self.0.into_inner()).expect("only text was written");
        text.push('\n');
        text
    }
}

fn pairs<'a>(attributes: &'a [(&str, String)]) -> impl Iterator<Item = (&'a str, &'a str)> {
    attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()))
}

/// Numbers with a space between, all digits, no negative zeros.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let values = values.into_iter().map(number);
    values.collect::<Vec<_>>().join(" ")
}

/// A number with all digits, zero without sign.
pub(super) fn number(value: f64) -> String {
    (value + 0.0).to_string()
}

pub(super) fn vector(v: &Vector3<f64>) -> String {
    numbers(v.0)
}

/// `pos` and `quat`, unless they are the identity.
pub(super) fn place(pose: &Pose<f64>) -> Vec<(&'static str, String)> {
    let mut attributes = Vec::new();
    if pose.position.0.iter().any(|x| *x != 0.0) {
        attributes.push(("pos", vector(&pose.position)));
    }
    let q = Quaternion::from_rotation(&pose.rotation).canonical();
    if q.0[1..].iter().any(|x| *x != 0.0) {
        attributes.push(("quat", numbers(q.0)));
    }
    attributes
}
