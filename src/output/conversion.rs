//! Words for mechanisms written another way.

use crate::analysis::convert::{ConversionNote, ConvertError, CutError};
use crate::description::quoted;

use super::complaint::Complaint;

/// A line for each note.
pub fn notes(notes: &[ConversionNote]) -> String {
    let line = |note: &ConversionNote| {
        let said = match note {
            ConversionNote::Renamed { from, to } => format!("the frame `{from}` is now `{to}`"),
            ConversionNote::Dropped { closed_form, joint } => format!(
                "the closed form `{closed_form}` is left out: it names `{joint}`, which is a closure now"
            ),
            ConversionNote::DriveLost { joint } => format!(
                "`{joint}` was driven and has no variable any more: hold another joint with --hold"
            ),
            ConversionNote::LimitsLost { joint } => {
                format!("`{joint}` had limits and has no variable any more: nothing limits it now")
            }
            ConversionNote::Variables { closure, joints } if joints.is_empty() => {
                format!("the closure `{closure}` holds its frames together and has no variable")
            }
            ConversionNote::Variables { closure, joints } => {
                format!(
                    "the closure `{closure}` has become rows with {}",
                    quoted(joints)
                )
            }
        };
        format!("note: {said}\n")
    };
    notes.iter().map(line).collect()
}

/// What is said where neither a convention nor a cut is asked for.
pub fn nothing_asked() -> Complaint {
    Complaint::with_help(
        "nothing is to be changed: the file would come out as it is".into(),
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
                [] => "this way no joint of this mechanism can be cut".to_owned(),
                names => format!("joints that can be cut: {}", quoted(names)),
            };
            let help = help.map_or(instead.clone(), |help| format!("{help}; {instead}"));
            (title, Some(help))
        }
        ConvertError::Wrong(problems) => {
            let titles: Vec<String> = problems.iter().map(|p| p.kind.title()).collect();
            let title = format!("what would come out is no mechanism: {}", titles.join("; "));
            (title, None)
        }
    };
    Complaint::new(title, "", help)
}

/// Where tables cannot be rearranged as they are written, axes can.
const BY_AXES: &str = "`linkwork frames FILE --format ron` gives the joint axes, and tables cut where \
     `cut: [\"JOINT\"]` there says";

fn because(error: &CutError) -> (String, Option<String>) {
    match error {
        CutError::UnknownJoint { name, suggestion } => (
            format!("there is no joint `{name}`"),
            suggestion
                .as_ref()
                .map(|meant| format!("did you mean `{meant}`?")),
        ),
        CutError::AlreadyCut { closure } => (
            format!("the mechanism is broken at `{closure}` already"),
            Some("name a joint that has a variable".into()),
        ),
        CutError::Helical { joint } => (
            format!("the joint `{joint}` is helical, and no closure is"),
            None,
        ),
        CutError::NoRow { joint } => (
            format!("the variable `{joint}` stands in no row of a table"),
            None,
        ),
        CutError::SeveralRows { joint } => (
            format!(
                "the variable `{joint}` stands in several places, and a cut would open only one"
            ),
            None,
        ),
        CutError::SharedRow { joint } => (
            format!("the row of `{joint}` has other variables too, which the cut would free"),
            Some(BY_AXES.into()),
        ),
        CutError::NoLoop { joint } => (
            format!("`{joint}` is in no loop: nothing would hold the links behind it"),
            None,
        ),
        CutError::NotRows { joint, closures } => (
            format!(
                "the links behind `{joint}` are held by {} only, which cannot become rows at the end of its chain",
                quoted(closures)
            ),
            Some(BY_AXES.into()),
        ),
    }
}
