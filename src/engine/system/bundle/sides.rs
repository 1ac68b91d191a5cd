//! Gaussian elimination of rows with right-hand sides.

use crate::number::Field;

/// Rows of a matrix with right-hand sides at their ends.
#[derive(Clone, Debug)]
pub(crate) struct SideRows<T> {
    pub width: usize,
    pub entries: Vec<T>,
}

impl<T: Field> SideRows<T> {
    pub fn row(&self, i: usize) -> &[T] {
        &self.entries[i * self.width..(i + 1) * self.width]
    }

    /// Eliminates the first columns with row exchanges, and puts the inverses of the pivots in their places; false if a pivot is none.
    pub fn eliminate(&mut self, columns: usize) -> bool {
        let (width, count) = (self.width, self.entries.len() / self.width);
        for k in 0..columns {
            let size = |i: usize| self.entries[i * width + k].norm_squared();
            let Some(best) = (k..count).max_by(|&i, &j| size(i).total_cmp(&size(j))) else {
                return false;
            };
            let pivot = size(best);
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            if best != k {
                let (above, below) = self.entries.split_at_mut(best * width);
                above[k * width..(k + 1) * width].swap_with_slice(&mut below[..width]);
            }
            let inverse = T::one() / self.entries[k * width + k];
            self.entries[k * width + k] = inverse;
            let (above, below) = self.entries.split_at_mut((k + 1) * width);
            let pivot = &above[k * width..];
            for row in below.chunks_exact_mut(width) {
                let factor = row[k] * inverse;
                if factor.norm_squared() > 0.0 {
                    for (x, y) in row[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
                        *x -= factor * *y;
                    }
                }
            }
        }
        true
    }

    /// Solves the upper triangle of the first columns for the right-hand side at a place, with the values of columns between
    /// them and the sides known.
    pub fn back(&self, columns: usize, known: &[T], side: usize, x: &mut [T]) {
        for k in (0..columns).rev() {
            let row = self.row(k);
            let mut sum = row[side];
            for (entry, value) in row[k + 1..columns].iter().zip(&x[k + 1..columns]) {
                sum -= *entry * *value;
            }
            for (entry, value) in row[columns..].iter().zip(known) {
                sum -= *entry * *value;
            }
            x[k] = sum * row[k];
        }
    }
}
