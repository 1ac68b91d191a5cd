//! What every report can do to be shown.

use serde::{Deserialize, Deserializer, Serialize};

use super::document::{Cell, Document};

/// A report that can be shown. Commands print it as a [`Document`], as JSON or as rows.
pub trait Report {
    /// The report in words and tables, made of nothing but the report.
    fn document(&self) -> Document;

    /// Whether the answer is yes, or at least not no.
    fn is_yes(&self) -> bool {
        true
    }

    /// What a reader must not overlook, a line each.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// What JSON says in words beside the answer.
    fn remarks(&self) -> Remarks {
        Remarks::default()
    }

    /// The report as rows for programs, if it has any.
    fn rows(&self) -> Option<Rows<'_>> {
        None
    }

    /// The mechanism file that was made, if one was.
    fn file(&self) -> Option<Result<String, ron::Error>> {
        None
    }
}

/// What is said beside the answer; each is absent where the question is another one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remarks {
    /// Why the mobility is not that of Kutzbach's count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explanation: Option<String>,
    /// How sure it is that no assembly is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub complete: Option<String>,
    /// How sure it is that no singularity or mode is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub completeness: Option<String>,
    /// What outputs that are full poses may hide; `null` if nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(deserialize_with = "present")]
    pub note: Option<Option<String>>,
    /// What repeats what other closures hold already.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redundant_constraints: Option<Vec<String>>,
}

/// A field that is there, though it may be `null`.
fn present<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Option<String>>, D::Error> {
    Option::deserialize(from).map(Some)
}

/// The values of a row. Only their values are written: numbers with all their digits, nothing for what is not finite.
pub type Record = Vec<Cell>;

/// Rows with the names of their columns.
pub struct Rows<'a> {
    /// The names of the columns, with units.
    pub columns: Vec<String>,
    /// The rows, made as they are asked for.
    pub rows: Box<dyn Iterator<Item = Record> + 'a>,
}

impl<'a> Rows<'a> {
    /// Rows under the names of their columns.
    pub fn new(
        columns: impl IntoIterator<Item = String>,
        rows: impl Iterator<Item = Record> + 'a,
    ) -> Self {
        Rows {
            columns: columns.into_iter().collect(),
            rows: Box::new(rows),
        }
    }

    /// The same without columns that come again: a coordinate that moves or bounds a box is also a joint or part of a pose.
    #[must_use]
    pub fn once(self) -> Self {
        let columns = self.columns.iter().enumerate();
        let first: Vec<bool> = columns
            .map(|(i, of)| !self.columns[..i].contains(of))
            .collect();
        let columns = self.columns.into_iter().zip(first.clone());
        let rows = self.rows.map(move |row| {
            let cells = row.into_iter().zip(&first);
            cells
                .filter(|(_, first)| **first)
                .map(|(cell, _)| cell)
                .collect()
        });
        Rows::new(
            columns.filter(|(_, first)| *first).map(|(name, _)| name),
            rows,
        )
    }
}
