//! Rows of a motion as columns of numbers.

use crate::algebra::SiUnit;
use crate::analysis::sweep::{MetKind, Row, TracedPoint};
use crate::mechanism::{Frame, Mechanism};
use crate::output::layout::{align_right, indented};
use crate::output::quantity::{number, quantity};
use crate::system::Column as Heading;

/// What the columns are.
#[derive(Clone, Debug)]
pub struct Table {
    columns: Vec<Column>,
}

#[derive(Clone, Debug)]
struct Column {
    name: String,
    unit: Option<SiUnit>,
    source: Source,
}

#[derive(Clone, Copy, Debug)]
enum Source {
    Joint(usize),
    Position(usize, usize),
    Quaternion(usize, usize),
    Point(usize, usize),
}

impl Table {
    /// All joints, platforms and traced points of a mechanism.
    pub fn new(mechanism: &Mechanism, points: &[TracedPoint]) -> Self {
        let mut columns = Vec::new();
        for (i, joint) in mechanism.joints().iter().enumerate() {
            columns.push(Column {
                name: joint.name.clone(),
                unit: Some(SiUnit::of_coordinate(joint.kind.is_angle())),
                source: Source::Joint(i),
            });
        }
        for (i, _) in mechanism.platforms().iter().enumerate() {
            let name = mechanism.frame_name(Frame::Platform { platform: i });
            for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                columns.push(Column {
                    name: format!("{name}.{axis}"),
                    unit: Some(SiUnit::METRE),
                    source: Source::Position(i, k),
                });
            }
            for (k, part) in ["qw", "qx", "qy", "qz"].into_iter().enumerate() {
                columns.push(Column {
                    name: format!("{name}.{part}"),
                    unit: None,
                    source: Source::Quaternion(i, k),
                });
            }
        }
        for (i, point) in points.iter().enumerate() {
            for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                columns.push(Column {
                    name: format!("{}.{axis}", point.name),
                    unit: Some(SiUnit::METRE),
                    source: Source::Point(i, k),
                });
            }
        }
        Table { columns }
    }

    fn value(&self, column: &Column, row: &Row) -> f64 {
        let at = row.configuration;
        match column.source {
            Source::Joint(i) => at.joints[i],
            Source::Position(i, k) => at.platforms[i].position.0[k],
            Source::Quaternion(i, k) => at.platforms[i].orientation.0[k],
            Source::Point(i, k) => row.points[i][k],
        }
    }

    /// The headings of the rows; the first is the number of the step.
    pub fn headings(&self) -> Vec<Heading> {
        let named = self.columns.iter().map(|column| Heading {
            name: column.name.clone(),
            unit: column.unit,
        });
        std::iter::once(Heading::plain("step"))
            .chain(named)
            .collect()
    }

    /// Names of the columns, with units; the first is the number of the step.
    fn columns(&self) -> Vec<String> {
        let headings = self.headings().into_iter();
        headings.map(|heading| heading.to_string()).collect()
    }

    /// The first line of CSV.
    pub fn csv_header(&self) -> String {
        // a name with a comma stands in quotes (RFC 4180)
        let columns = self
            .columns()
            .into_iter()
            .map(|name| match name.contains(',') {
                true => format!("\"{name}\""),
                false => name,
            });
        format!("mode,{},met\n", columns.collect::<Vec<_>>().join(","))
    }

    /// A line of CSV with all digits, added to `to`.
    pub fn csv_line(&self, mode: Option<usize>, row: &Row, to: &mut String) {
        use std::fmt::Write;
        // writing to a string cannot fail
        if let Some(mode) = mode {
            let _ = write!(to, "{mode}");
        }
        to.push(',');
        if let Some(step) = row.step {
            let _ = write!(to, "{step}");
        }
        for column in &self.columns {
            let _ = write!(to, ",{}", self.value(column, row));
        }
        to.push(',');
        to.push_str(row.special.map_or("", word));
        to.push('\n');
    }

    /// Some of the rows of a motion as text.
    pub(super) fn text(&self, sampled: &Sampled, all: usize) -> String {
        if sampled.rows.is_empty() {
            return String::new();
        }
        let shown = |column: &&Column| !matches!(column.source, Source::Quaternion(..));
        let mut table = comfy_table::Table::new();
        table.load_style(comfy_table::presets::NOTHING);
        let names = self.columns.iter().filter(shown).map(|c| c.name.clone());
        table.add_row(std::iter::once("step".to_owned()).chain(names));
        if let Some(first) = table.column_mut(0) {
            first.set_padding((0, 1));
        }
        for row in &sampled.rows {
            let step = row[0].map_or(String::new(), number);
            let values = self.columns.iter().zip(&row[1..]).filter(|(c, _)| shown(c));
            let values = values.map(|(column, value)| match (value, column.unit) {
                (None, _) => String::new(),
                (Some(value), Some(unit)) => quantity(*value, unit.is_angle()),
                (Some(value), None) => number(*value),
            });
            table.add_row(std::iter::once(step).chain(values));
        }
        let width = self.columns.len() + 1;
        align_right(&mut table, 1..width);
        let title = match all > sampled.rows.len() {
            true => format!(
                "Rows, {} of {all}; --format csv and --format json have all of them",
                sampled.rows.len()
            ),
            false => "Rows".into(),
        };
        format!("\n{title}\n{}", indented(&table.to_string()))
    }
}

/// What a special row is called in the last column.
pub(super) fn word(kind: &MetKind) -> &'static str {
    match kind {
        MetKind::Turning { .. } => "turning point",
        MetKind::Fold { .. } => "fold",
        MetKind::Limit { .. } => "limit",
        MetKind::End => "end",
        MetKind::Closed => "closed",
        MetKind::Crossing { .. } => "crossing",
    }
}

/// Rows that are kept: all, or no more than a number, evenly spread.
#[derive(Clone, Debug)]
pub struct Sampled {
    rows: Vec<Vec<Option<f64>>>,
    most: usize,
    every: usize,
    seen: usize,
    last: Option<Vec<Option<f64>>>,
}

impl Sampled {
    /// Keeps no more than this many rows, at least two.
    pub fn of(most: usize) -> Self {
        Sampled {
            rows: Vec::new(),
            most: most.max(2),
            every: 1,
            seen: 0,
            last: None,
        }
    }

    /// Takes in a row.
    pub fn take(&mut self, table: &Table, row: &Row) {
        let values = || {
            let values = table.columns.iter().map(|column| {
                let value = table.value(column, row);
                value.is_finite().then_some(value)
            });
            let step = row.step.map(|step| step as f64);
            std::iter::once(step).chain(values).collect::<Vec<_>>()
        };
        if self.seen.is_multiple_of(self.every) {
            if self.rows.len() == self.most {
                // every second goes, and from now on twice as many are left out
                let mut keep = false;
                self.rows.retain(|_| {
                    keep = !keep;
                    keep
                });
                self.every *= 2;
            }
            if self.seen.is_multiple_of(self.every) {
                self.rows.push(values());
                self.last = None;
            } else {
                self.last = Some(values());
            }
        } else if self.every > 1 {
            self.last = Some(values());
        }
        self.seen += 1;
    }

    /// The same with the last row there was.
    pub fn finished(mut self) -> Self {
        self.rows.extend(self.last.take());
        self
    }

    /// The rows: the number of the step and the values of the columns.
    pub fn rows(&self) -> &[Vec<Option<f64>>] {
        &self.rows
    }
}
