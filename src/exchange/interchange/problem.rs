//! Problems of a file of another program, and their words.

use std::ops::Range;

use thiserror::Error;

use crate::description::{Lines, joined, listed};

/// A problem of a file of another program, with its place.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{kind}")]
pub struct ImportProblem {
    /// Kind of problem.
    pub kind: ImportProblemKind,
    /// The bytes of the text it concerns; none if it concerns the whole file.
    pub span: Option<Range<usize>>,
}

/// A file, the files it includes, and all their problems.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}", self.lines().join("\n"))]
pub struct WrongFile {
    /// Names and texts; the first is the main file.
    pub files: Vec<(String, String)>,
    /// The problems, each with the index of its file.
    pub problems: Vec<(usize, ImportProblem)>,
}

impl WrongFile {
    /// All problems, one line each: `file:line:column: problem (hint)`.
    pub fn lines(&self) -> Vec<String> {
        let line = |(file, problem): &(usize, ImportProblem)| {
            let (name, text) = &self.files[*file];
            let place = problem.span.as_ref().map_or(String::new(), |span| {
                let (line, column) = Lines::new(text).position(span.start);
                format!("{line}:{column}:")
            });
            let help = problem.kind.help();
            let help = help.map_or(String::new(), |help| format!(" ({help})"));
            format!("{name}:{place} {problem}{help}")
        };
        self.problems.iter().map(line).collect()
    }
}

/// The kinds of problems, in one line each.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum ImportProblemKind {
    #[error("this is not XML: {message}")]
    Syntax { message: String },
    #[error("the file is empty")]
    Empty,
    #[error("elements are nested more than {most} levels deep")]
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
    /// A text that does not consist of the right number of finite numbers.
    #[error(
        "`{text}` is not {}",
        if *count == 1 { "a finite number".into() } else { format!("{count} finite numbers") }
    )]
    NotNumbers { text: String, count: usize },
    #[error("unknown word `{word}`")]
    UnknownWord {
        word: String,
        known: Vec<&'static str>,
    },
    #[error("linkwork cannot read {what}")]
    Unsupported { what: String, help: &'static str },
    #[error("there are two {} `{name}`", plural(noun))]
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
        /// Example of an axis as the format writes it.
        example: &'static str,
    },
    /// A quaternion or a pair of axes that gives no orientation.
    #[error("`{text}` does not define an orientation")]
    NoOrientation { text: String },
    #[error("joints `{}` and `{}` both lead to link `{link}`", joints[0], joints[1])]
    TwoParents { link: String, joints: [String; 2] },
    #[error("no link is the root: {} form a cycle", quoted(links))]
    NoRoot { links: Vec<String> },
    #[error("{} have no parent and are not connected", quoted(links))]
    SeveralRoots { links: Vec<String> },
    #[error("{} form a cycle", quoted(links))]
    Cycle { links: Vec<String> },
    #[error("the couplings of joint `{joint}` and those it follows contradict one another")]
    Contradiction { joint: String },
    #[error("joint `{joint}` follows itself through other joints")]
    FollowsItself { joint: String },
    #[error("keyframe `{name}` has {found} values, the joints have {expected}")]
    WrongKeyframe {
        name: String,
        found: usize,
        expected: usize,
    },
    #[error("`{file}` cannot be included: {reason}")]
    NotIncluded { file: String, reason: String },
    #[error("`{file}` lies outside the folder of the model and is not read")]
    Outside { file: String },
    /// The message of the reader of the format.
    #[error("the file cannot be read: {message}")]
    Reader { message: String },
    /// A number larger than any mechanism can have.
    #[error("the numbers of `{of}` are too large")]
    TooLarge { of: String },
    #[error("nothing in the file moves")]
    NothingMoves,
}

fn plural(noun: &str) -> String {
    match noun.strip_suffix('y') {
        Some(stem) => format!("{stem}ies"),
        None => format!("{noun}s"),
    }
}

impl ImportProblemKind {
    /// A hint on how to correct it.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Syntax { .. } | Self::Reader { .. } => return None,
            Self::NotNumbers { count: 1, .. } => "write one number, such as 0.5",
            Self::NotNumbers { count, .. } => {
                let example = ["0.5"].repeat(*count).join(" ");
                return Some(format!(
                    "write {count} numbers separated by spaces, such as \"{example}\""
                ));
            }
            Self::UnknownWord { known, .. } => {
                return Some(format!("possible words are {}", or(known)));
            }
            Self::Unknown { suggestion, .. } => {
                return Some(format!("did you mean `{}`?", suggestion.as_ref()?));
            }
            Self::NoAxis { example, .. } => {
                return Some(format!("give the axis a direction, such as {example}"));
            }
            Self::TooDeep { .. } => "remove the nesting",
            Self::NotThisFormat { found, .. } if found == "mujocoinclude" => {
                "this is a part of a model: give the file that includes it"
            }
            Self::Empty | Self::NotThisFormat { .. } => {
                "linkwork reads URDF, which begins with `robot`, MJCF, which begins with `mujoco`, and SDF, which begins with \
                 `sdf`"
            }
            Self::Macro { .. } => "expand the file first: xacro FILE > robot.urdf",
            Self::Missing { .. } => "add it",
            Self::Unsupported { help, .. } => help,
            Self::Duplicate { .. } => "give one of them another name",
            Self::NoOrientation { .. } => {
                "give numbers that are not all 0, and axes that are not parallel"
            }
            Self::TwoParents { .. } => {
                "a tree has one joint for each link: remove one of them, and close the loop with \
                 `loop_joint` or in a file of loops"
            }
            Self::NoRoot { .. } | Self::Cycle { .. } => {
                "remove one joint of the cycle, and close the loop with `loop_joint` or in a file of loops"
            }
            Self::SeveralRoots { .. } => {
                "connect them to one link, with fixed joints if they do not move"
            }
            Self::Contradiction { .. } => "remove one of them",
            Self::FollowsItself { .. } => "let one of these joints follow no other",
            Self::WrongKeyframe { .. } => {
                "give one value for each hinge and slide, 4 for a ball, 7 for a free joint"
            }
            Self::Outside { .. } => {
                "`--include-from DIR` lets files be read from another folder too"
            }
            Self::NotIncluded { .. } => "put the file there, or its contents here",
            Self::TooLarge { .. } => "lengths are in m and angles in rad",
            Self::NothingMoves => "a mechanism needs a joint that is not fixed",
        };
        Some(help.to_owned())
    }

    pub(super) fn at(self, span: Range<usize>) -> ImportProblem {
        let span = Some(span);
        ImportProblem { kind: self, span }
    }

    pub(super) fn anywhere(self) -> ImportProblem {
        let span = None;
        ImportProblem { kind: self, span }
    }
}

fn quoted(names: &[String]) -> String {
    const MOST: usize = 8;
    let shown = names.iter().take(MOST).map(|name| format!("`{name}`"));
    let more = (names.len() > MOST).then(|| format!("{} more", names.len() - MOST));
    listed(shown.chain(more))
}

fn or(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    joined(&quoted, "or")
}
