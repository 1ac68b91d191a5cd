//! Elimination in linear combinations of few terms, over the rationals or modulo a prime.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use crate::number::residue::ExactField;

/// A linear combination: entries by column, none of them zero, and the formulas that it combines.
#[derive(Clone)]
pub(super) struct Combination<T> {
    pub entries: Vec<(usize, T)>,
    pub of: BTreeSet<usize>,
}

impl<T: ExactField> Combination<T> {
    /// Entries that combine no formulas.
    pub fn alone(entries: Vec<(usize, T)>) -> Self {
        Combination {
            entries,
            of: BTreeSet::new(),
        }
    }

    /// The number that this is multiplied by to give the other; `None` if there is none, or this is zero.
    pub fn ratio(&self, other: &Combination<T>) -> Option<T> {
        let ((_, x), (_, y)) = (self.entries.first()?, other.entries.first()?);
        let ratio = x.inverse() * y;
        let mut left = other.clone();
        left.subtract(self, &ratio);
        left.entries.is_empty().then_some(ratio)
    }

    /// Subtracts a multiple.
    fn subtract(&mut self, other: &Combination<T>, factor: &T) {
        let mut left = std::mem::take(&mut self.entries).into_iter().peekable();
        let mut entries = Vec::new();
        for (column, x) in &other.entries {
            while let Some(own) = left.next_if(|own| own.0 < *column) {
                entries.push(own);
            }
            let own = left.next_if(|own| own.0 == *column);
            let mut entry = own.map_or_else(T::zero, |own| own.1);
            entry -= &(x.clone() * factor);
            if !entry.is_zero() {
                entries.push((*column, entry));
            }
        }
        entries.extend(left);
        self.entries = entries;
        self.of.extend(&other.of);
    }
}

/// Combinations in echelon form, by the column of the first entry, which is 1.
pub(super) struct Echelon<T>(FxHashMap<usize, Combination<T>>);

impl<T: ExactField> Echelon<T> {
    pub fn new(rows: impl Iterator<Item = Combination<T>>) -> Self {
        let mut echelon = Echelon(FxHashMap::default());
        for row in rows {
            let mut row = echelon.reduced(row);
            if let Some((first, lead)) = row.entries.first() {
                let (first, inverse) = (*first, lead.inverse());
                for (_, x) in &mut row.entries {
                    *x = x.clone() * &inverse;
                }
                echelon.0.insert(first, row);
            }
        }
        echelon
    }

    /// The remainder after combinations are subtracted.
    pub fn reduced(&self, mut row: Combination<T>) -> Combination<T> {
        let mut at = 0;
        while let Some((column, factor)) = row.entries.get(at) {
            match self.0.get(column) {
                Some(pivot) => {
                    let factor = factor.clone();
                    row.subtract(pivot, &factor);
                }
                None => at += 1,
            }
        }
        row
    }
}
