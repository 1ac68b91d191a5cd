//! Elements written one after the other, in nested lines.

use std::fmt::Display;

use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

use crate::geometry::{Pose, Quaternion, Vector3};

/// Elements in the order in which they are written.
#[derive(Default)]
pub(super) struct Xml(Vec<Event<'static>>);

/// The names of an element and of its attributes, which have these values; one whose text is empty is left out.
fn start(names: &str, values: &[&dyn Display]) -> BytesStart<'static> {
    let mut names = names.split(' ');
    let mut start = BytesStart::new(names.next().unwrap_or_default().to_owned());
    for (name, value) in names.zip(values) {
        let value = value.to_string();
        if !value.is_empty() {
            start.push_attribute((name, value.as_str()));
        }
    }
    start
}

impl Xml {
    pub fn comment(&mut self, text: &str) {
        let text = format!(" {} ", text.replace("--", "- -"));
        self.0.push(Event::Comment(BytesText::from_escaped(text)));
    }

    /// Opens an element: `open("joint name type", &[&name, &kind])`.
    pub fn open(&mut self, names: &str, values: &[&dyn Display]) {
        self.0.push(Event::Start(start(names, values)));
    }

    pub fn leaf(&mut self, names: &str, values: &[&dyn Display]) {
        self.0.push(Event::Empty(start(names, values)));
    }

    /// An element with a text in it.
    pub fn leaf_text(&mut self, names: &str, values: &[&dyn Display], text: &str) {
        let start = start(names, values);
        let end = start.to_end().into_owned();
        self.0.push(Event::Start(start));
        self.0.push(Event::Text(BytesText::new(text).into_owned()));
        self.0.push(Event::End(end));
    }

    pub fn close(&mut self, tag: &'static str) {
        self.0.push(Event::End(BytesEnd::new(tag)));
    }

    pub fn append(&mut self, others: Xml) {
        self.0.extend(others.0);
    }

    /// An element around others, if there are any.
    pub fn block(&mut self, tag: &'static str, inside: Xml) {
        if !inside.0.is_empty() {
            self.open(tag, &[]);
            self.append(inside);
            self.close(tag);
        }
    }

    pub fn text(self) -> String {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        for event in self.0 {
            let written: std::io::Result<()> = writer.write_event(event);
            written.expect("memory can be written to");
        }
        String::from_utf8(writer.into_inner()).expect("only text was written") + "\n"
    }
}

/// Numbers with a space between, all digits, no negative zeros.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let values = values.into_iter().map(|value| (value + 0.0).to_string());
    values.collect::<Vec<_>>().join(" ")
}

pub(super) fn vector(v: &Vector3<f64>) -> String {
    numbers(v.0)
}

/// Position and quaternion, empty where they are zero and the identity.
pub(super) fn place(pose: &Pose<f64>) -> [String; 2] {
    let unless = |identity: bool, text: String| if identity { String::new() } else { text };
    let q = Quaternion::from_rotation(&pose.rotation).canonical();
    let zero = |values: &[f64]| values.iter().all(|x| *x == 0.0);
    [
        unless(zero(&pose.position.0), vector(&pose.position)),
        unless(zero(&q.0[1..]), numbers(q.0)),
    ]
}
