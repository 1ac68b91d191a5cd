//! Words for what is wrong with a file of another program.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use super::problem::{ImportProblem, ImportProblemKind};
use crate::description::listed;

impl ImportProblemKind {
    /// What is wrong, in one line.
    pub fn title(&self) -> String {
        match self {
            Self::Syntax { message } => format!("this is not XML: {message}"),
            Self::Empty => "the file is empty".into(),
            Self::TooDeep { most } => {
                format!("elements stand more than {most} levels deep in one another")
            }
            Self::NotThisFormat { found, expected } => {
                format!("the outermost element is `{found}`, not {}", or(expected))
            }
            Self::Macro { element } => format!("`{element}` is a macro, not a part of a robot"),
            Self::Missing { element, needs } => format!("`{element}` has no {needs}"),
            Self::NotNumbers { text, count: 1 } => format!("`{text}` is not a finite number"),
            Self::NotNumbers { text, count } => format!("`{text}` is not {count} finite numbers"),
            Self::UnknownWord { word, .. } => format!("`{word}` is not known here"),
            Self::Unsupported { what, .. } => format!("linkwork cannot read {what}"),
            Self::Duplicate { noun, name } => format!("there are two {noun}s `{name}`"),
            Self::Unknown { noun, name, .. } => format!("there is no {noun} `{name}`"),
            Self::NoAxis { joint, .. } => format!("the axis of joint `{joint}` has no direction"),
            Self::NoOrientation { text } => format!("`{text}` gives no orientation"),
            Self::TwoParents {
                link,
                joints: [a, b],
            } => {
                format!("joints `{a}` and `{b}` both lead to link `{link}`")
            }
            Self::NoRoot { links } => format!(
                "every link hangs on another one: {} stand on themselves",
                quoted(links)
            ),
            Self::SeveralRoots { links } => {
                format!("{} hang on no link and are not joined", quoted(links))
            }
            Self::Cycle { links } => format!("{} stand on themselves", quoted(links)),
            Self::FollowsTwo { joint } => format!("joint `{joint}` follows two others"),
            Self::FollowsItself { joint } => {
                format!("joint `{joint}` follows itself by way of others")
            }
            Self::WrongKeyframe {
                name,
                found,
                expected,
            } => format!("keyframe `{name}` has {found} values, the joints have {expected}"),
            Self::NotIncluded { file, reason } => format!("`{file}` cannot be included: {reason}"),
            Self::Reader { message } => format!("the file cannot be read: {message}"),
            Self::TooLarge { of } => format!("the numbers of `{of}` are too large"),
            Self::NothingMoves => "nothing in the file moves".into(),
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Syntax { .. } | Self::Reader { .. } => return None,
            Self::TooDeep { .. } => "no mechanism is that deep".into(),
            Self::Empty | Self::NotThisFormat { .. } => {
                "linkwork reads URDF, which begins with `robot`, and MJCF, which begins with `mujoco`".into()
            }
            Self::Macro { .. } => "expand the file first: xacro FILE > robot.urdf".into(),
            Self::Missing { .. } => "add it".into(),
            Self::NotNumbers { count: 1, .. } => "write one number, such as 0.5".into(),
            Self::NotNumbers { count, .. } => {
                let example = ["0.5"].repeat(*count).join(" ");
                format!("write {count} numbers with spaces between, such as \"{example}\"")
            }
            Self::UnknownWord { known, .. } => format!("known are {}", or(known)),
            Self::Unsupported { help, .. } => (*help).into(),
            Self::Duplicate { .. } => "give one of them another name".into(),
            Self::Unknown { suggestion, .. } => match suggestion {
                Some(name) => format!("did you mean `{name}`?"),
                None => return None,
            },
            Self::NoAxis { example, .. } => format!("give the axis a direction, such as {example}"),
            Self::NoOrientation { .. } => "give numbers that are not all 0, and axes that are not parallel".into(),
            Self::TwoParents { .. } => "a tree has one joint for each link: leave one of them out, and close the loop with \
                 `loop_joint` or with --loops"
                .into(),
            Self::NoRoot { .. } | Self::Cycle { .. } => {
                "leave out one joint of the circle, and close the loop with `loop_joint` or with --loops".into()
            }
            Self::SeveralRoots { .. } => "join them to one link, with fixed joints if they do not move".into(),
            Self::FollowsTwo { .. } => "leave one of them out".into(),
            Self::FollowsItself { .. } => "let one of the joints follow none".into(),
            Self::WrongKeyframe { .. } => {
                "give one value for each hinge and slide, 4 for a ball, 7 for a free joint".into()
            }
            Self::NotIncluded { .. } => "put the file there, or its content here".into(),
            Self::TooLarge { .. } => "lengths are in m and angles in rad".into(),
            Self::NothingMoves => "a mechanism needs a joint that is not fixed".into(),
        };
        Some(help)
    }
}

fn quoted(names: &[String]) -> String {
    const MOST: usize = 8;
    let mut shown: Vec<String> = names
        .iter()
        .take(MOST)
        .map(|name| format!("`{name}`"))
        .collect();
    if names.len() > MOST {
        shown.push(format!("{} more", names.len() - MOST));
    }
    listed(&shown)
}

fn or(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match quoted.as_slice() {
        [words @ .., last] if !words.is_empty() => format!("{} or {last}", words.join(", ")),
        words => words.join(""),
    }
}

impl Display for ImportProblemKind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(&self.title())?;
        match self.help() {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

impl Display for ImportProblem {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        self.kind.fmt(f)
    }
}

impl Error for ImportProblemKind {}
impl Error for ImportProblem {}
