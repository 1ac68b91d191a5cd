//! The text of a file and of all files it includes.

use std::ops::Range;

use crate::interchange::problem::{ImportProblem, ImportProblemKind, WrongFile};
use crate::interchange::xml_reader::{document, tag};

/// The largest depth of nested includes.
const MOST_LEVELS: usize = 20;

/// The most bytes that a file and all it includes may have.
pub(super) const MOST_BYTES: usize = 1 << 23;

/// Reads another file by its name.
pub(crate) type Files<'a> = &'a dyn Fn(&str) -> Result<String, NotRead>;

/// Reasons for which an included file is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRead {
    /// It lies outside the folders that files may be read from.
    Outside,
    /// It cannot be read, for this reason.
    Failed(String),
}

/// A text assembled from files.
pub(crate) struct Spliced {
    /// The text, without `include`.
    pub text: String,
    /// The origin of each part of the text: a file and a position in it.
    pieces: Vec<(Range<usize>, usize, usize)>,
    /// The files: names and texts; the first is the main one.
    pub(super) files: Vec<(String, String)>,
}

impl Spliced {
    pub(super) fn of_files(files: Vec<(String, String)>) -> Self {
        Spliced {
            text: String::new(),
            pieces: Vec::new(),
            files,
        }
    }

    /// Adds a part of another text of the same files.
    pub(super) fn copy(&mut self, other: &Spliced, range: Range<usize>) {
        for (piece, file, start) in &other.pieces {
            let part = piece.start.max(range.start)..piece.end.min(range.end);
            if !part.is_empty() {
                let place = self.text.len() + part.start - range.start;
                let origin = start + part.start - piece.start;
                (self.pieces).push((place..place + part.len(), *file, origin));
            }
        }
        self.text += &other.text[range];
    }

    /// Problems of the text as problems of its files.
    pub fn wrong(&self, problems: Vec<ImportProblem>) -> WrongFile {
        let located = problems.into_iter().map(|problem| match &problem.span {
            None => (0, problem),
            Some(span) => {
                let (file, span) = self.locate(span);
                (file, problem.kind.at(span))
            }
        });
        WrongFile {
            problems: located.collect(),
            files: self.files.clone(),
        }
    }

    /// The file from which a place of the text comes, and the place in it.
    fn locate(&self, span: &Range<usize>) -> (usize, Range<usize>) {
        let mut pieces = self.pieces.iter();
        let found = pieces
            .find(|(piece, ..)| piece.contains(&span.start))
            .or(self.pieces.last());
        match found {
            Some((piece, file, start)) => {
                let begin = start + span.start.saturating_sub(piece.start).min(piece.len());
                let end = start + span.end.saturating_sub(piece.start).min(piece.len());
                (*file, begin..end.max(begin))
            }
            None => (0, 0..0),
        }
    }
}

/// The text of a file with all it includes; or a problem, and the file that has it.
pub(crate) fn splice(name: &str, text: &str, files: Files) -> Result<Spliced, WrongFile> {
    let mut spliced = Spliced::of_files(vec![(name.to_owned(), text.to_owned())]);
    match expand(&mut spliced, files, 0, &mut vec![0]) {
        Ok(()) => Ok(spliced),
        Err(wrong) => Err(WrongFile {
            files: spliced.files,
            problems: vec![wrong],
        }),
    }
}

fn expand(
    spliced: &mut Spliced,
    files: Files,
    file: usize,
    open: &mut Vec<usize>,
) -> Result<(), (usize, ImportProblem)> {
    let text = spliced.files[file].1.clone();
    let page = document(&text).map_err(|problem| (file, problem))?;
    let root = page.root_element();
    // of an included file, only the contents of its outermost element
    let inside = match root.first_child().zip(root.last_child()) {
        Some((first, last)) => first.range().start..last.range().end,
        None => 0..0,
    };
    let whole = if file == 0 { 0..text.len() } else { inside };
    let mut at = whole.start;
    for node in root
        .descendants()
        .filter(|node| node.has_tag_name("include"))
    {
        let range = node.range();
        push(spliced, file, &text, at..range.start);
        at = range.end;
        let refuse = |problem: ImportProblemKind| (file, problem.at(tag(node)));
        let Some(name) = node.attribute("file") else {
            let (element, needs) = ("include".into(), "`file`".into());
            return Err(refuse(ImportProblemKind::Missing { element, needs }));
        };
        let failed = |reason: String| ImportProblemKind::NotIncluded {
            file: name.to_owned(),
            reason,
        };
        let is_open = |&file: &usize| file != 0 && spliced.files[file].0 == name;
        if open.iter().any(is_open) || open.len() > MOST_LEVELS {
            return Err(refuse(failed("it includes itself".into())));
        }
        let content = files(name).map_err(|why| match why {
            NotRead::Outside => refuse(ImportProblemKind::Outside { file: name.into() }),
            NotRead::Failed(reason) => refuse(failed(reason)),
        })?;
        if spliced.text.len() + content.len() > MOST_BYTES {
            return Err(refuse(failed("the files together are too large".into())));
        }
        spliced.files.push((name.to_owned(), content));
        let included = spliced.files.len() - 1;
        open.push(included);
        expand(spliced, files, included, open)?;
        open.pop();
    }
    push(spliced, file, &text, at..whole.end.max(at));
    Ok(())
}

fn push(spliced: &mut Spliced, file: usize, text: &str, range: Range<usize>) {
    let Some(part) = text.get(range.clone()) else {
        return;
    };
    let start = spliced.text.len();
    spliced.text += part;
    let place = start..spliced.text.len();
    spliced.pieces.push((place, file, range.start));
}
