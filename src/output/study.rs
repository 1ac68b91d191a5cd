//! Rows of studies, and shards put together.

use super::csv::Csv;
use super::document::Cell;
use crate::ask::{Study, StudyRows};
use crate::mechanism::Variable;

/// What the first column is called: with the number of all rows, so that a missing shard is noticed.
const ROW: &str = "row of ";

/// Rows as comma-separated values.
pub fn csv(study: &Study, rows: &StudyRows) -> String {
    let first = format!("{ROW}{}", study.count());
    let rest = rows.columns.iter().skip(1).map(Variable::to_string);
    let written = Csv::new(Vec::new(), std::iter::once(first).chain(rest)).and_then(|mut csv| {
        for row in &rows.rows {
            csv.row(row.iter().map(|x| Cell::from(*x)))?;
        }
        csv.finish()
    });
    let bytes = written.expect("writing to memory cannot fail");
    String::from_utf8(bytes).expect("what was written is text")
}

/// Why files are not the shards of one study.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MergeError {
    /// A file that is no shard.
    #[error("{0} is no shard of a study: its first line does not begin with `row of`")]
    NoShard(String),
    /// A file of another study.
    #[error("{0} has other columns than {1}: they are of two studies")]
    Other(String, String),
    /// A line that does not begin with the number of a row.
    #[error("{file}:{line} does not begin with the number of a row")]
    NoRow {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
    },
    /// Two rows of one number that differ.
    #[error("row {row} is not the same in {files}: they are of two studies", files = .files.join(" and "))]
    Differ {
        /// The row.
        row: usize,
        /// The files.
        files: [String; 2],
    },
    /// Missing rows.
    #[error("rows {first} to {last} of {of} are missing: work out their shard")]
    Missing {
        /// The first.
        first: usize,
        /// The last before one that is there.
        last: usize,
        /// How many there are in all.
        of: usize,
    },
}

/// The study of which files are all the shards, in any order; a shard that was worked out twice counts once.
///
/// # Errors
/// If they are not those of one study, or rows are missing.
pub fn merge(files: &[(String, String)]) -> Result<String, MergeError> {
    let mut header: Option<(&str, &str)> = None;
    let mut rows: Vec<(usize, &str, &str)> = Vec::new();
    let mut all = 0;
    for (file, text) in files {
        let name = file.as_str();
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        let count = first
            .strip_prefix(ROW)
            .and_then(|rest| rest.split(',').next());
        let count = count.and_then(|count| count.parse().ok());
        all = count.ok_or_else(|| MergeError::NoShard(file.clone()))?;
        match header {
            Some((known, of)) if known != first => {
                return Err(MergeError::Other(file.clone(), of.into()));
            }
            _ => header = Some((first, file)),
        }
        for (i, line) in rest.lines().enumerate() {
            let number = line
                .split(',')
                .next()
                .and_then(|number| number.parse().ok());
            let (file, at) = (file.clone(), i + 2);
            let number = number.ok_or(MergeError::NoRow { file, line: at })?;
            rows.push((number, line, name));
        }
    }
    // stable: the order of files decides nothing, as equal rows are the same
    rows.sort_by_key(|(number, ..)| *number);
    let mut merged = format!("{}\n", header.map_or("", |(first, _)| first));
    let mut next = 0;
    let mut before: Option<(usize, &str, &str)> = None;
    let missing = |first, end: usize| MergeError::Missing {
        first,
        last: end - 1,
        of: all,
    };
    for (number, line, file) in rows {
        match before {
            Some((known, text, other)) if known == number => {
                if text != line {
                    let files = [other.to_owned(), file.to_owned()];
                    return Err(MergeError::Differ { row: number, files });
                }
                continue;
            }
            _ if number > next => return Err(missing(next, number)),
            _ => {}
        }
        merged += line;
        merged.push('\n');
        next = number + 1;
        before = Some((number, line, file));
    }
    match next < all {
        true => Err(missing(next, all)),
        false => Ok(merged),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str, rows: &[&str]) -> (String, String) {
        let text = format!("row of 4,l2 (m),assembled\n{}\n", rows.join("\n"));
        (name.into(), text)
    }

    #[test]
    fn shards_in_any_order_and_more_than_once_are_the_study() {
        let (a, b) = (
            file("a", &["0,1,1", "1,2,1"]),
            file("b", &["2,3,1", "3,4,0"]),
        );
        let whole = "row of 4,l2 (m),assembled\n0,1,1\n1,2,1\n2,3,1\n3,4,0\n";
        for order in [vec![&a, &b], vec![&b, &a], vec![&b, &a, &b]] {
            let files: Vec<_> = order.into_iter().cloned().collect();
            assert_eq!(merge(&files).as_deref(), Ok(whole));
        }
    }

    #[test]
    fn what_is_missing_or_foreign_is_named() {
        let (a, b) = (file("a", &["0,1,1"]), file("b", &["2,3,1", "3,4,0"]));
        let missing = |first, last| MergeError::Missing { first, last, of: 4 };
        assert_eq!(merge(&[a.clone(), b.clone()]), Err(missing(1, 1)));
        assert_eq!(merge(&[b]), Err(missing(0, 1)));
        assert_eq!(merge(std::slice::from_ref(&a)), Err(missing(1, 3)));
        let other = ("c".to_owned(), a.1.replace("l2", "l3"));
        let refused = Err(MergeError::Other("c".into(), "a".into()));
        assert_eq!(merge(&[a.clone(), other]), refused);
        let changed = ("c".to_owned(), a.1.replace("0,1,1", "0,1,0"));
        let files = ["a".to_owned(), "c".to_owned()];
        let refused = Err(MergeError::Differ { row: 0, files });
        assert_eq!(merge(&[a, changed]), refused);
        let text = ("d".to_owned(), "theta1\n1\n".to_owned());
        assert_eq!(merge(&[text]), Err(MergeError::NoShard("d".into())));
    }
}
