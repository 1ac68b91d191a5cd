//! Mechanisms written another way as documents.

use super::document::{Document, Report, Section};
use crate::analysis::convert::{Conversion, ConversionNote, ConvertError, CutError};
use crate::description::quoted;

use super::complaint::Complaint;

/// The converted file, with what it says differently.
impl Report for Conversion {
    fn document(&self) -> Document {
        let file = self.description.to_ron().unwrap_or_default();
        let file = Section::new("Mechanism file").code("ron", file);
        Document::new(&self.description.name.value, "")
            .notes(self.notes.iter().map(note))
            .section(file)
    }
}

/// A line for each note.
pub fn notes(notes: &[ConversionNote]) -> String {
    let lines = notes.iter().map(|of| format!("note: {}\n", note(of)));
    lines.collect()
}

fn note(note: &ConversionNote) -> String {
    match note {
        ConversionNote::Renamed { from, to } => format!("the frame `{from}` is now `{to}`"),
        ConversionNote::Dropped { closed_form, joint } => format!(
            "the closed form `{closed_form}` is left out: it names `{joint}`, which has become a closure"
        ),
        ConversionNote::DriveLost { joint } => format!(
            "`{joint}` was driven but no longer has a variable: hold another joint with --hold"
        ),
        ConversionNote::LimitsLost { joint } => {
            format!("`{joint}` had limits but no longer has a variable: its limits are lost")
        }
        ConversionNote::Variables { closure, joints } if joints.is_empty() => {
            format!("the closure `{closure}` joins its frames rigidly and needs no variables")
        }
        ConversionNote::Variables { closure, joints } => {
            format!(
                "the closure `{closure}` has become table rows with the variables {}",
                quoted(joints)
            )
        }
    }
}

/// What is said where neither a convention nor a cut is asked for.
pub fn nothing_asked() -> Complaint {
    Complaint::with_help(
        "nothing to convert: give a convention or a joint to cut".into(),
        "",
        "give --convention modified or standard, or --cut JOINT, or both".into(),
    )
}

/// Why a mechanism is not converted, unless it is what came out that is wrong. `possible` are the joints that can be cut.
pub fn complaint(error: &ConvertError, possible: &[String]) -> Complaint {
    let (title, help) = match error {
        ConvertError::Cut(error) => {
            let (title, help) = because(error);
            let instead = match possible {
                [] => "no joint of this mechanism can be cut".to_owned(),
                names => format!("joints that can be cut: {}", quoted(names)),
            };
            let help = help.map_or(instead.clone(), |help| format!("{help}; {instead}"));
            (title, Some(help))
        }
        ConvertError::Wrong(_) => (error.to_string(), None),
    };
    Complaint::new(title, "", help)
}

/// Where tables cannot be rearranged as they are written, axes can.
const BY_AXES: &str = "`linkwork frames FILE --format ron` gives the joint axes; with \
     `cut: [\"JOINT\"]` in that file, `linkwork frames` makes tables cut at that joint";

fn because(error: &CutError) -> (String, Option<String>) {
    let title = match error {
        CutError::UnknownJoint { name, .. } => format!("there is no joint `{name}`"),
        error => error.to_string(),
    };
    let help = match error {
        CutError::UnknownJoint {
            suggestion: Some(meant),
            ..
        } => Some(format!("did you mean `{meant}`?")),
        CutError::AlreadyCut { .. } => Some("name a joint that has a variable".into()),
        CutError::SharedRow { .. } | CutError::NotRows { .. } => Some(BY_AXES.into()),
        _ => None,
    };
    (title, help)
}
