//! Tables declared by their columns.

use super::{Align, Cell, Column, Table};
use crate::algebra::SiUnit;
use crate::output::quantity::Quantified;

impl Table {
    /// A table with a row for each item; its columns follow, each with what stands in it:
    /// `Table::of(joints).words("name", |j| &j.name).numbers("home", |j| j.home)`.
    pub(in crate::output) fn of<T: Copy>(items: impl IntoIterator<Item = T>) -> TableOf<T> {
        let items: Vec<T> = items.into_iter().collect();
        let table = Table {
            columns: Vec::new(),
            rows: vec![Vec::new(); items.len()],
            ruled: false,
        };
        TableOf { items, table }
    }
}

/// A table whose columns are being given.
pub(in crate::output) struct TableOf<T> {
    items: Vec<T>,
    table: Table,
}

impl<T: Copy> TableOf<T> {
    /// With a column of words.
    pub fn words<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(T) -> C) -> Self {
        self.column(title.into(), Align::Left, cell)
    }

    /// With a column of numbers.
    pub fn numbers<C: Into<Cell>>(self, title: impl Into<String>, cell: impl Fn(T) -> C) -> Self {
        self.column(title.into(), Align::Right, cell)
    }

    fn column<C: Into<Cell>>(mut self, title: String, align: Align, cell: impl Fn(T) -> C) -> Self {
        let unit = SiUnit::ONE;
        self.table.columns.push(Column { title, unit, align });
        for (row, &item) in self.table.rows.iter_mut().zip(&self.items) {
            row.push(cell(item).into());
        }
        self
    }

    /// With a column of numbers for each title; `cell` has the index of the title too.
    pub fn each<N: Into<String>, C: Into<Cell>>(
        self,
        titles: impl IntoIterator<Item = N>,
        cell: impl Fn(T, usize) -> C,
    ) -> Self {
        let titles = titles.into_iter().enumerate();
        titles.fold(self, |table, (i, title)| {
            table.numbers(title, |item| cell(item, i))
        })
    }

    /// With a column for each of several quantities; each number says its unit.
    pub fn quantities<Q: Quantified, V: Into<Option<f64>>>(
        self,
        of: &[Q],
        value: impl Fn(T, usize) -> V,
    ) -> Self {
        self.each(of.iter().map(Q::name), |item, k| {
            let value = value(item, k).into();
            value.map(|value| Cell::quantity(value, of[k].unit()))
        })
    }

    /// With a column for each of several quantities; headers say the units.
    pub fn values<Q: Quantified, V: Into<Option<f64>>>(
        self,
        of: &[Q],
        value: impl Fn(T, usize) -> V,
    ) -> Self {
        self.each(of.iter().map(Q::head), |item, k| value(item, k).into())
    }

    /// Without columns that come again: a coordinate that moves or bounds a box is also a joint or part of a pose.
    pub fn without_repeats(mut self) -> Self {
        let Table { columns, rows, .. } = &mut self.table;
        let heads: Vec<String> = columns.iter().map(Column::header).collect();
        for i in (0..heads.len())
            .rev()
            .filter(|&i| heads[..i].contains(&heads[i]))
        {
            columns.remove(i);
            rows.iter_mut().for_each(|row| drop(row.remove(i)));
        }
        self
    }

    /// With a unit for all numbers of the last column.
    pub fn in_unit(mut self, unit: SiUnit) -> Self {
        let last = self.table.columns.last_mut();
        last.into_iter().for_each(|column| column.unit = unit);
        self
    }

    /// Drawn with lines.
    pub fn ruled(mut self) -> Self {
        self.table.ruled = true;
        self
    }
}

impl<T> From<TableOf<T>> for Table {
    fn from(of: TableOf<T>) -> Self {
        of.table
    }
}
