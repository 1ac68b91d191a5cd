//! Rows of studies, and shards put together.

use std::iter;

use super::csv::render;
use super::document::Cell;
use super::report::Rows;
use crate::ask::{Study, StudyRows, regions};
use crate::mechanism::Variable;

/// What the first column is called: with the number of all rows, so that a missing shard is noticed.
const ROW: &str = "row of ";

/// The column that says whether the mechanism assembles.
const ASSEMBLED: &str = "assembled";

/// Rows as comma-separated values.
pub fn csv(study: &Study, rows: &StudyRows) -> String {
    let first = format!("{ROW}{}", study.count());
    let rest = rows.columns.iter().skip(1).map(Variable::to_string);
    let rows = rows.rows.iter();
    let rows = rows.map(|row| row.iter().map(|x| Cell::from(*x)).collect());
    render(Rows::new(iter::once(first).chain(rest), rows))
}

/// How the columns of a study are spread over its rows, as comma-separated values.
///
/// # Errors
/// If the rows are not those of a study.
pub fn spread(rows: &str) -> std::io::Result<String> {
    let mut reader = csv::Reader::from_reader(rows.as_bytes());
    let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); names.len()];
    for row in reader.records() {
        for (column, field) in columns.iter_mut().zip(&row?) {
            column.extend(field.parse::<f64>());
        }
    }
    let titles = [
        "quantity",
        "rows",
        "mean",
        "standard deviation",
        "least",
        "greatest",
    ];
    let named = names.into_iter().zip(columns).skip(1);
    let rows = named.map(|(name, values)| {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
        let figures = [
            mean,
            (squares / count.saturating_sub(1) as f64).sqrt(),
            values.iter().copied().fold(f64::NAN, f64::min),
            values.iter().copied().fold(f64::NAN, f64::max),
        ];
        let cells = [Cell::Text(name), Cell::from(count)];
        cells.into_iter().chain(figures.map(Cell::from)).collect()
    });
    Ok(render(Rows::new(titles.map(str::to_owned), rows)))
}

/// Why files are not the shards of one study.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MergeError {
    /// A file that is no shard.
    #[error("{0} is not a shard of a study: its first line does not begin with `row of`")]
    NoShard(String),
    /// A file of another study.
    #[error("{0} has other columns than {1}: they are of two studies")]
    Other(String, String),
    /// A file and its line, from 1, that does not begin with the number of a row.
    #[error("{0}:{1} does not begin with the number of a row")]
    NoRow(String, usize),
    /// Two rows of one number that differ.
    #[error("row {0} is not the same in {files}: they are of two studies", files = .1.join(" and "))]
    Differ(usize, [String; 2]),
    /// So many rows are no grid of these nodes along each coordinate.
    #[error("{0} rows are not a grid of {grid} nodes", grid = .1.iter().map(usize::to_string).collect::<Vec<_>>().join(" by "))]
    Grid(usize, Vec<usize>),
    /// Missing rows.
    #[error("rows {first} to {last} of {of} are missing: compute their shard")]
    Missing {
        /// The first.
        first: usize,
        /// The last before one that is there.
        last: usize,
        /// How many there are in all.
        of: usize,
    },
}

/// The rows of a whole grid with the number of the region to which each belongs: nodes beside each other where the mechanism
/// assembles; empty where it does not.
///
/// # Errors
/// If they are not the rows of that grid.
pub fn mapped(rows: &str, grid: &[usize]) -> Result<String, MergeError> {
    let mut reader = csv::Reader::from_reader(rows.as_bytes());
    let names = reader.headers().cloned().unwrap_or_default();
    let column = names.iter().position(|name| name == ASSEMBLED);
    let within: Vec<bool> = (reader.records())
        .map(|row| row.is_ok_and(|row| column.and_then(|i| row.get(i)) == Some("1")))
        .collect();
    let found = regions(grid, &within);
    let found = found.ok_or_else(|| MergeError::Grid(within.len(), grid.to_vec()))?;
    let mut lines = rows.lines();
    let mut text = format!("{},region\n", lines.next().unwrap_or_default());
    for (line, region) in lines.zip(found) {
        text += line;
        text += &match region {
            0 => ",\n".to_owned(),
            region => format!(",{region}\n"),
        };
    }
    Ok(text)
}

/// The study of which files are all the shards, in any order; a shard that was worked out twice counts once.
///
/// # Errors
/// If they are not those of one study, or rows are missing.
pub fn merge(files: &[(String, String)]) -> Result<String, MergeError> {
    let number = |line: &str| line.split(',').next()?.parse::<usize>().ok();
    let mut header: Option<(&str, &str)> = None;
    let mut rows: Vec<(usize, &str, &str)> = Vec::new();
    let mut all = 0;
    for (file, text) in files {
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        let count = first.strip_prefix(ROW).and_then(number);
        all = count.ok_or_else(|| MergeError::NoShard(file.clone()))?;
        match header {
            Some((known, of)) if known != first => {
                return Err(MergeError::Other(file.clone(), of.into()));
            }
            _ => header = Some((first, file)),
        }
        for (i, line) in rest.lines().enumerate() {
            let number = number(line).ok_or_else(|| MergeError::NoRow(file.clone(), i + 2))?;
            rows.push((number, line, file));
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
                    return Err(MergeError::Differ(number, files));
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

    /// The sample standard deviation of 2, 4, 4, 4, 5, 5, 7, 9 is √(32/7).
    #[test]
    fn the_spread_of_each_column_leaves_out_what_is_empty() {
        let values = ["2", "4", "4", "", "4", "5", "5", "7", "9"];
        let rows: Vec<String> = (values.iter().enumerate())
            .map(|(i, x)| format!("{i},{x},1\n"))
            .collect();
        let text = format!("row of 9,\"f(a, b) (m)\",assembled\n{}", rows.concat());
        let expected = format!(
            "quantity,rows,mean,standard deviation,least,greatest\n\
             \"f(a, b) (m)\",8,5,{},2,9\nassembled,9,1,0,1,1\n",
            (32.0_f64 / 7.0).sqrt()
        );
        assert_eq!(spread(&text).ok(), Some(expected));
    }

    #[test]
    fn shards_of_a_map_are_joined_across_their_seams() {
        let shards = [
            file("a", &["0,1,1", "1,2,0"]),
            file("b", &["2,1,1", "3,2,1"]),
        ];
        let whole = merge(&shards).expect("a whole study");
        let expected = "row of 4,l2 (m),assembled,region\n0,1,1,1\n1,2,0,\n2,1,1,1\n3,2,1,1\n";
        assert_eq!(mapped(&whole, &[2, 2]).as_deref(), Ok(expected));
        let row = "row of 4,l2 (m),assembled,region\n0,1,1,1\n1,2,0,\n2,1,1,2\n3,2,1,2\n";
        assert_eq!(mapped(&whole, &[4]).as_deref(), Ok(row));
        let refused = Err(MergeError::Grid(4, vec![2, 3]));
        assert_eq!(mapped(&whole, &[2, 3]), refused);
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
        let refused = Err(MergeError::Differ(0, files));
        assert_eq!(merge(&[a, changed]), refused);
        let text = ("d".to_owned(), "theta1\n1\n".to_owned());
        assert_eq!(merge(&[text]), Err(MergeError::NoShard("d".into())));
    }
}
