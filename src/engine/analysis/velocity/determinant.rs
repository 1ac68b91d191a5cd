//! Determinants of matrices over any number.

use crate::number::Number;

/// The determinant of a square matrix, by elimination with the largest pivot of each column; none where such a pivot is
/// small, if many matrices are eliminated in the order of one.
pub(super) fn determinant<T: Number>(size: usize, entries: &[T]) -> Option<T> {
    let mut matrix = entries.to_vec();
    let mut product = T::one();
    for k in 0..size {
        let size_of = |row: &usize| matrix[k * size + row].real().abs();
        let pivot = (k..size).max_by(|a, b| size_of(a).total_cmp(&size_of(b)));
        let pivot = pivot.unwrap_or(k);
        if pivot != k {
            (0..size).for_each(|column| matrix.swap(column * size + k, column * size + pivot));
            product = -product;
        }
        let top = matrix[k * size + k];
        product *= top;
        if k + 1 == size || top == T::zero() {
            break;
        }
        // small beside what it was where the order was chosen
        if (top.abs()).less(T::from_f64(1e-3 * top.real().abs())) {
            return None;
        }
        for row in k + 1..size {
            let factor = matrix[k * size + row] / top;
            for column in k..size {
                let change = factor * matrix[column * size + k];
                matrix[column * size + row] -= change;
            }
        }
    }
    Some(product)
}
