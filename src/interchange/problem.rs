//! What can be wrong with a file of another program.

use std::ops::Range;

/// Something wrong with a file of another program, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportProblem {
    /// What is wrong.
    pub kind: ImportProblemKind,
    /// The bytes of the text it concerns; none if it concerns the whole file.
    pub span: Option<Range<usize>>,
}

/// A file, those it includes, and everything that is wrong with them.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongFile {
    /// Names and texts; the first is the file that was asked for.
    pub files: Vec<(String, String)>,
    /// What is wrong, with the file it is wrong in.
    pub problems: Vec<(usize, ImportProblem)>,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum ImportProblemKind {
    /// It is not XML.
    Syntax {
        /// The reader's words.
        message: String,
    },
    /// Nothing stands in it.
    Empty,
    /// Elements stand in one another too deeply.
    TooDeep {
        /// The most levels there may be.
        most: usize,
    },
    /// The outermost element is another one.
    NotThisFormat {
        /// The one that is there.
        found: String,
        /// Those that could be.
        expected: &'static [&'static str],
    },
    /// A macro that has not been expanded.
    Macro {
        /// The element.
        element: String,
    },
    /// An attribute or element that must be there is not.
    Missing {
        /// The element.
        element: String,
        /// What it needs.
        needs: String,
    },
    /// A text that is not as many numbers as it should be.
    NotNumbers {
        /// The text.
        text: String,
        /// How many there should be.
        count: usize,
    },
    /// A word that is none of those known.
    UnknownWord {
        /// The word.
        word: String,
        /// Those known.
        known: &'static [&'static str],
    },
    /// Something that linkwork has no word for.
    Unsupported {
        /// What it is.
        what: String,
        /// What to do.
        help: &'static str,
    },
    /// A name given twice.
    Duplicate {
        /// What bears it.
        noun: &'static str,
        /// The name.
        name: String,
    },
    /// A name that nothing bears.
    Unknown {
        /// What should bear it.
        noun: &'static str,
        /// The name.
        name: String,
        /// A similar name.
        suggestion: Option<String>,
    },
    /// An axis of no direction.
    NoAxis {
        /// The joint.
        joint: String,
        /// How the format writes an axis.
        example: &'static str,
    },
    /// A quaternion or a pair of axes that gives no orientation.
    NoOrientation {
        /// The text.
        text: String,
    },
    /// Two joints lead to one link.
    TwoParents {
        /// The link.
        link: String,
        /// The joints.
        joints: [String; 2],
    },
    /// Every link hangs on another one.
    NoRoot {
        /// Links that stand on themselves.
        links: Vec<String>,
    },
    /// Links that hang on none and are not joined.
    SeveralRoots {
        /// The links.
        links: Vec<String>,
    },
    /// Links that stand on themselves.
    Cycle {
        /// The links.
        links: Vec<String>,
    },
    /// Joints that follow one another in a circle, or one that follows two.
    FollowsTwo {
        /// The joint.
        joint: String,
    },
    /// Joints that follow one another in a circle.
    FollowsItself {
        /// The joint.
        joint: String,
    },
    /// A keyframe with another number of values than the joints have.
    WrongKeyframe {
        /// The keyframe.
        name: String,
        /// How many values it has.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A file to be included that cannot be.
    NotIncluded {
        /// The file.
        file: String,
        /// Why not.
        reason: String,
    },
    /// What the reader of the format says.
    Reader {
        /// Its words.
        message: String,
    },
    /// A number beyond all that a mechanism can have.
    TooLarge {
        /// What has it.
        of: String,
    },
    /// Nothing moves.
    NothingMoves,
}

impl ImportProblemKind {
    /// The problem, at a place.
    pub(super) fn at(self, span: Range<usize>) -> ImportProblem {
        ImportProblem {
            kind: self,
            span: Some(span),
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
