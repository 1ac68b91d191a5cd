//! The contents of an answer, independent of the format in which it is written.
//!
//! A report becomes a [`Document`]: plain data made of an answer, notes, sections, tables and lists. Each output format
//! is one file that renders a document and knows no report; each analysis has one file that makes its document and knows
//! no format.

mod cell;
mod columns;
mod inline;
mod remarks;

pub use cell::Cell;
pub(super) use columns::TableOf;
pub(super) use inline::{Inline, one_line, pieces};
pub use remarks::Remarks;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;

/// Something to read, whatever the format. In all its texts names and commands stand between back
/// quotes; anything else is to be shown as it stands.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// Title: the mechanism's name.
    pub title: String,
    /// The answer, in a sentence or two; may be empty.
    pub answer: String,
    /// Notes on the answer, a line each.
    pub notes: Vec<String>,
    /// The answer in detail.
    pub sections: Vec<Section>,
    /// Method by which the answer was found, a line each: shown last.
    pub method: Vec<String>,
    /// True if the answer is no.
    #[serde(skip)]
    pub no: bool,
    /// Warnings for the reader, a line each: said beside the document.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// Remarks that JSON has in words beside the answer.
    #[serde(skip)]
    pub remarks: Remarks,
}

/// A part of a document under a title.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// The title.
    pub title: String,
    /// Its contents, in order.
    pub blocks: Vec<Block>,
}

/// Part of a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Lines that belong together.
    List(Vec<String>),
    /// A table.
    Table(Table),
    /// Text whose spaces and line breaks matter: a formula, a file, a program.
    Code {
        /// The language, as Markdown names it: `ron`, `latex`; may be empty.
        language: String,
        /// The lines.
        text: String,
    },
    /// A formula under a title.
    Formula(FormulaBlock),
    /// A picture as SVG, with its description: formats of text leave it out.
    Picture(String, String),
    /// A part under a title of its own.
    Section(Section),
}

/// A formula, set for terminals and for TeX.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FormulaBlock {
    /// Its subject; may be empty.
    pub title: String,
    /// Its lines in Unicode.
    pub unicode: String,
    /// Its lines as displayed LaTeX; empty if there are none.
    pub latex: String,
    /// Remarks below it, a line each.
    pub below: Vec<String>,
}

/// Rows under a header.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows, with as many cells as there are columns.
    pub rows: Vec<Vec<Cell>>,
    /// True if it is drawn with lines, like a Denavit–Hartenberg table.
    pub ruled: bool,
}

/// The header of a column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Its title; may be empty.
    pub title: String,
    /// The unit of its numbers, which are then shown without.
    pub unit: SiUnit,
    /// Alignment of its cells.
    pub align: Align,
}

/// Alignment of the cells of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Align {
    /// Words.
    #[default]
    Left,
    /// Numbers, which are easier to compare when they end at the same place.
    Right,
}

impl Document {
    /// A document with a title and an answer.
    pub fn new(title: impl Into<String>, answer: impl Into<String>) -> Self {
        Document {
            title: title.into(),
            answer: answer.into(),
            ..Document::default()
        }
    }

    /// With a line that qualifies the answer.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        self.notes([note.into()])
    }

    /// With lines that qualify the answer.
    #[must_use]
    pub fn notes(mut self, notes: impl IntoIterator<Item = String>) -> Self {
        self.notes.extend(notes);
        self
    }

    /// The answer begins with it where the work was stopped before it was done; a note says what may be missing, if
    /// anything is named.
    #[must_use]
    pub fn interrupted(mut self, interrupted: bool, missing: &str) -> Self {
        if interrupted {
            let found = "Interrupted: this is what was found until then. ";
            self.answer.insert_str(0, found);
        }
        let note = (interrupted && !missing.is_empty())
            .then(|| format!("interrupted: {missing} may be missing"));
        self.notes(note)
    }

    /// The answer is no unless this holds too.
    #[must_use]
    pub fn yes_if(mut self, yes: bool) -> Self {
        self.no |= !yes;
        self
    }

    /// Adds warnings for the reader.
    #[must_use]
    pub fn warnings(mut self, warnings: impl IntoIterator<Item = String>) -> Self {
        self.warnings.extend(warnings);
        self
    }

    /// With what JSON says in words.
    #[must_use]
    pub fn remarks(self, remarks: Remarks) -> Self {
        Document { remarks, ..self }
    }

    /// With a line on how the answer was found.
    #[must_use]
    pub fn method(mut self, line: impl Into<String>) -> Self {
        self.method.push(line.into());
        self
    }

    /// With a section; one without contents is left out.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        if !section.blocks.is_empty() {
            self.sections.push(section);
        }
        self
    }

    /// With a section of one table; nothing if it has no rows.
    #[must_use]
    pub fn table(self, title: &str, table: impl Into<Table>) -> Self {
        self.section(Section::new(title).table(table))
    }

    /// With several sections.
    #[must_use]
    pub fn sections(self, sections: impl IntoIterator<Item = Section>) -> Self {
        sections.into_iter().fold(self, Document::section)
    }

    /// All sections in reading order, with the method last.
    pub(super) fn parts(&self) -> Vec<Section> {
        let method = Section::new("How it was found").list(self.method.clone());
        self.clone().section(method).sections
    }
}

impl Section {
    /// A section without contents.
    pub fn new(title: impl Into<String>) -> Self {
        Section {
            title: title.into(),
            blocks: Vec::new(),
        }
    }

    /// With a block.
    #[must_use]
    pub fn block(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// With a paragraph; an empty one is left out.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        match text.into() {
            text if text.is_empty() => self,
            text => self.block(Block::Text(text)),
        }
    }

    /// With a paragraph where there are no other contents.
    #[must_use]
    pub fn or_text(self, text: &str) -> Self {
        match self.blocks.is_empty() {
            true => self.text(text),
            false => self,
        }
    }

    /// With lines that belong together; nothing if there are none.
    #[must_use]
    pub fn list(self, lines: impl IntoIterator<Item = String>) -> Self {
        match lines.into_iter().collect::<Vec<_>>() {
            lines if lines.is_empty() => self,
            lines => self.block(Block::List(lines)),
        }
    }

    /// With a table; one without rows is left out.
    #[must_use]
    pub fn table(self, table: impl Into<Table>) -> Self {
        let table = table.into();
        match table.rows.is_empty() {
            true => self,
            false => self.block(Block::Table(table)),
        }
    }

    /// With text whose spaces and line breaks matter.
    #[must_use]
    pub fn code(self, language: &str, text: impl Into<String>) -> Self {
        let (language, text) = (language.into(), text.into());
        self.block(Block::Code { language, text })
    }

    /// With formulas, one below the other.
    #[must_use]
    pub fn formulas(mut self, formulas: impl IntoIterator<Item = FormulaBlock>) -> Self {
        let formulas = formulas.into_iter().map(Block::Formula);
        self.blocks.extend(formulas);
        self
    }

    /// With a section inside; one without contents is left out.
    #[must_use]
    pub fn section(self, section: Section) -> Self {
        match section.blocks.is_empty() {
            true => self,
            false => self.block(Block::Section(section)),
        }
    }
}

impl Column {
    /// Title and unit: `Fx (N)`.
    pub fn header(&self) -> String {
        match self.unit {
            SiUnit::ONE => self.title.clone(),
            unit => format!("{} ({unit})", self.title),
        }
    }
}
