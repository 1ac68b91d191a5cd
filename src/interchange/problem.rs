//! What can be wrong with a file of another program, and the words for it.

use std::ops::Range;

use thiserror::Error;

use crate::description::{Lines, listed};

/// Something wrong with a file of another program, and where.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{kind}")]
pub struct ImportProblem {
    /// What is wrong.
    pub kind: ImportProblemKind,
    /// The bytes of the text it concerns; none if it concerns the whole file.
    pub span: Option<Range<usize>>,
}

/// A file, those it includes, and everything that is wrong with them.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}", self.lines().join("\n"))]
pub struct WrongFile {
    /// Names and texts; the first is the file that was asked for.
    pub files: Vec<(String, String)>,
    /// What is wrong, with the file it is wrong in.
    pub problems: Vec<(usize, ImportProblem)>,
}

impl WrongFile {
    /// Everything that is wrong, one line each: `file:line:column: what is wrong (what to do)`.
    pub fn lines(&self) -> Vec<String> {
        let line = |(file, problem): &(usize, ImportProblem)| {
            let (name, text) = &self.files[*file];
            let place = problem.span.as_ref().map_or(String::new(), |span| {
                let (line, column) = Lines::new(text).position(span.start);
                format!("{line}:{column}: ")
            });
            let help = problem.kind.help();
            let help = help.map_or(String::new(), |help| format!(" ({help})"));
            let separator = if place.is_empty() { ": " } else { ":" };
            format!("{name}{separator}{place}{problem}{help}")
        };
        self.problems.iter().map(line).collect()
    }
}

/// What can be wrong, in one line each.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum ImportProblemKind {
    #[error("this is not XML: {message}")]
    Syntax { message: String },
    #[error("the file is empty")]
    Empty,
    #[error("elements stand more than {most} levels deep in one another")]
    TooDeep { most: usize },
    #[error("the outermost element is `{found}`, not {}", or(expected))]
    NotThisFormat {
        found: String,
        expected: &'static [&'static str],
    },
    /// A macro that has not been expanded.
    #[error("`{element}` is a macro, not a part of a robot")]
    Macro { element: String },
    /// An attribute or element that must be there is not.
    #[error("`{element}` has no {needs}")]
    Missing { element: String, needs: String },
    /// A text that is not as many finite numbers as it should be.
    #[error("`{text}` is not {}", numbers(*count))]
    NotNumbers { text: String, count: usize },
    #[error("`{word}` is not known here")]
    UnknownWord {
        word: String,
        known: &'static [&'static str],
    },
    #[error("linkwork cannot read {what}")]
    Unsupported { what: String, help: &'static str },
    #[error("there are two {noun}s `{name}`")]
    Duplicate { noun: &'static str, name: String },
    #[error("there is no {noun} `{name}`")]
    Unknown {
        noun: &'static str,
        name: String,
        /// A similar name.
        suggestion: Option<String>,
    },
    #[error("the axis of joint `{joint}` has no direction")]
    NoAxis {
        joint: String,
        /// How the format writes an axis.
        example: &'static str,
    },
    /// A quaternion or a pair of axes that gives no orientation.
    #[error("`{text}` gives no orientation")]
    NoOrientation { text: String },
    #[error("joints `{}` and `{}` both lead to link `{link}`", joints[0], joints[1])]
    TwoParents { link: String, joints: [String; 2] },
    #[error(
        "every link hangs on another one: {} stand on themselves",
        quoted(links)
    )]
    NoRoot { links: Vec<String> },
    #[error("{} hang on no link and are not joined", quoted(links))]
    SeveralRoots { links: Vec<String> },
    #[error("{} stand on themselves", quoted(links))]
    Cycle { links: Vec<String> },
    #[error("joint `{joint}` follows two others")]
    FollowsTwo { joint: String },
    #[error("joint `{joint}` follows itself by way of others")]
    FollowsItself { joint: String },
    #[error("keyframe `{name}` has {found} values, the joints have {expected}")]
    WrongKeyframe {
        name: String,
        found: usize,
        expected: usize,
    },
    #[error("`{file}` cannot be included: {reason}")]
    NotIncluded { file: String, reason: String },
    /// The words of the reader of the format.
    #[error("the file cannot be read: {message}")]
    Reader { message: String },
    /// A number beyond all that a mechanism can have.
    #[error("the numbers of `{of}` are too large")]
    TooLarge { of: String },
    #[error("nothing in the file moves")]
    NothingMoves,
}

impl ImportProblemKind {
    /// What is wrong, in one line.
    pub fn title(&self) -> String {
        self.to_string()
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Syntax { .. } | Self::Reader { .. } => return None,
            Self::NotNumbers { count: 1, .. } => "write one number, such as 0.5",
            Self::NotNumbers { count, .. } => {
                let example = ["0.5"].repeat(*count).join(" ");
                return Some(format!(
                    "write {count} numbers with spaces between, such as \"{example}\""
                ));
            }
            Self::UnknownWord { known, .. } => return Some(format!("known are {}", or(known))),
            Self::Unknown { suggestion, .. } => {
                return Some(format!("did you mean `{}`?", suggestion.as_ref()?));
            }
            Self::NoAxis { example, .. } => {
                return Some(format!("give the axis a direction, such as {example}"));
            }
            Self::TooDeep { .. } => "no mechanism is that deep",
            Self::Empty | Self::NotThisFormat { .. } => {
                "linkwork reads URDF, which begins with `robot`, and MJCF, which begins with `mujoco`"
            }
            Self::Macro { .. } => "expand the file first: xacro FILE > robot.urdf",
            Self::Missing { .. } => "add it",
            Self::Unsupported { help, .. } => help,
            Self::Duplicate { .. } => "give one of them another name",
            Self::NoOrientation { .. } => {
                "give numbers that are not all 0, and axes that are not parallel"
            }
            Self::TwoParents { .. } => {
                "a tree has one joint for each link: leave one of them out, and close the loop with \
                 `loop_joint` or with --loops"
            }
            Self::NoRoot { .. } | Self::Cycle { .. } => {
                "leave out one joint of the circle, and close the loop with `loop_joint` or with --loops"
            }
            Self::SeveralRoots { .. } => {
                "join them to one link, with fixed joints if they do not move"
            }
            Self::FollowsTwo { .. } => "leave one of them out",
            Self::FollowsItself { .. } => "let one of the joints follow none",
            Self::WrongKeyframe { .. } => {
                "give one value for each hinge and slide, 4 for a ball, 7 for a free joint"
            }
            Self::NotIncluded { .. } => "put the file there, or its content here",
            Self::TooLarge { .. } => "lengths are in m and angles in rad",
            Self::NothingMoves => "a mechanism needs a joint that is not fixed",
        };
        Some(help.to_owned())
    }

    /// The problem, at a place.
    pub(super) fn at(self, span: Range<usize>) -> ImportProblem {
        ImportProblem {
            span: Some(span),
            ..self.anywhere()
        }
    }

    /// The problem of the whole file.
    pub(super) fn anywhere(self) -> ImportProblem {
        ImportProblem {
            kind: self,
            span: None,
        }
    }
}

fn numbers(count: usize) -> String {
    match count {
        1 => "a finite number".into(),
        _ => format!("{count} finite numbers"),
    }
}

fn quoted(names: &[String]) -> String {
    const MOST: usize = 8;
    let shown = names.iter().take(MOST).map(|name| format!("`{name}`"));
    let more = (names.len() > MOST).then(|| format!("{} more", names.len() - MOST));
    listed(&shown.chain(more).collect::<Vec<_>>())
}

fn or(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match quoted.as_slice() {
        [words @ .., last] if !words.is_empty() => format!("{} or {last}", words.join(", ")),
        words => words.join(""),
    }
}
