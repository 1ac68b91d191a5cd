//! Words for questions that cannot be put, with the options that would put them right.

use super::layout::listed;
use super::option::{Complaint, Part};
use crate::algebra::Expression;
use crate::description::{ProblemKind, Scope, count};
use crate::system::{QuestionError, ValueError};

/// What is wrong with a question, and with which part of the option that asked it, if one did.
pub fn complaint(error: &QuestionError) -> (Complaint, Part) {
    match error {
        QuestionError::UnknownName { name, suggestion } => {
            let help = match suggestion {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => "a coordinate is a joint, `platform.x`, `.y`, `.z`, `.roll`, `.pitch` or \
                         `.yaw`, or a whole platform"
                    .into(),
            };
            let title = format!("`{name}` is neither a joint nor a coordinate of a platform");
            (said(title, "not known", Some(help)), Part::Name)
        }
        QuestionError::NotAJoint { name } => {
            let title = format!("`{name}` is not a joint, and only joints are held by themselves");
            let help = "a platform is free unless it is held with --hold".to_owned();
            (said(title, "not a joint", Some(help)), Part::Name)
        }
        QuestionError::Value { text, error, .. } => value(text, error),
        QuestionError::TooMany {
            mobility,
            held,
            free,
        } => {
            let title = format!(
                "{} too many: the mechanism has {} and {} held",
                held.saturating_sub(*mobility),
                freedoms(*mobility),
                are(*held)
            );
            (said(title, "", Some(release(free))), Part::Name)
        }
        QuestionError::TooFew {
            mobility,
            held,
            hold,
        } => {
            let title = format!(
                "{} too few: the mechanism has {} and {} held",
                mobility.saturating_sub(*held),
                freedoms(*mobility),
                are(*held)
            );
            let help = format!(
                "hold {} too, e.g. {}",
                listed(hold),
                options("--hold", hold, "=home")
            );
            (said(title, "", Some(help)), Part::Name)
        }
        QuestionError::Dependent { free, hold } => {
            let title = format!(
                "the number held is right, but {} cannot be chosen beside the others, and {} {} \
                 undetermined",
                listed(free),
                listed(hold),
                if hold.len() == 1 { "stays" } else { "stay" }
            );
            let help = format!(
                "{}; then hold {}, e.g. {}",
                release(free),
                listed(hold),
                options("--hold", hold, "=home")
            );
            (said(title, "", Some(help)), Part::Name)
        }
    }
}

fn said(title: String, label: &str, help: Option<String>) -> Complaint {
    Complaint {
        title,
        label: label.into(),
        help,
    }
}

fn freedoms(number: usize) -> String {
    match number {
        0 => "no freedom".into(),
        _ => count(number, "freedom"),
    }
}

fn are(held: usize) -> String {
    match held {
        0 => "nothing is".into(),
        1 => "1 coordinate is".into(),
        _ => format!("{held} coordinates are"),
    }
}

/// How to stop holding coordinates: joints are freed, platform coordinates are held only by an option.
fn release(held: &[String]) -> String {
    let (coordinates, joints): (Vec<String>, Vec<String>) =
        held.iter().cloned().partition(|name| name.contains('.'));
    let mut ways = Vec::new();
    if !joints.is_empty() {
        let free = options("--free", &joints, "");
        ways.push(format!("free {}: {free}", listed(&joints)));
    }
    if !coordinates.is_empty() {
        ways.push(format!("leave out --hold {}", listed(&coordinates)));
    }
    ways.join(" and ")
}

/// `--free l1 --free l2`
fn options(option: &str, names: &[String], value: &str) -> String {
    let options = names
        .iter()
        .map(|name| format!("{option} {}", quoted(&format!("{name}{value}"))));
    options.collect::<Vec<_>>().join(" ")
}

/// The word as a shell takes it.
fn quoted(word: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "._=-".contains(c);
    match word.chars().all(safe) {
        true => word.into(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

fn value(text: &str, error: &ValueError) -> (Complaint, Part) {
    // a value that is one expression tells where it is wrong
    let parsed = Expression::parse(text);
    let (kind, part) = match error {
        ValueError::Parse(kind) => {
            let part = match &parsed {
                Err(error) if error.kind == *kind => Part::Value(error.span.clone()),
                _ => Part::WholeValue,
            };
            (ProblemKind::Expression(kind.clone()), part)
        }
        ValueError::UnknownName { name, suggestion } => {
            let place = parsed.as_ref().ok().and_then(|expression| {
                let mut names = expression.names();
                names.find(|(found, _)| *found == name)
            });
            let part = place.map_or(Part::WholeValue, |(_, span)| Part::Value(span.clone()));
            let kind = ProblemKind::UnknownName {
                name: name.clone(),
                suggestion: suggestion.clone(),
                scope: Scope::Parameters,
            };
            (kind, part)
        }
        ValueError::NoValue(kind) => (ProblemKind::NoValue(*kind), Part::WholeValue),
        ValueError::NotAPose { part } => {
            let title = format!("`{part}` is not a pose");
            let help = "a pose is a list such as [Tz(0.5), Rx(10 deg)], or home".to_owned();
            return (said(title, "", Some(help)), Part::WholeValue);
        }
    };
    let complaint = Complaint {
        title: kind.title(),
        label: kind.label(),
        help: match kind {
            // nothing can be declared in an option
            ProblemKind::UnknownName {
                suggestion: None, ..
            } => Some("a value may use the parameters of the file".into()),
            kind => kind.help(),
        },
    };
    (complaint, part)
}
