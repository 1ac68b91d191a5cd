//! Determinants and condition numbers of small matrices.

use crate::linear::{RANK_TOLERANCE, dot, norm, orthogonalise, rotate};

/// The determinant of a square matrix of `n` columns, which is destroyed; 1 if it is not square.
///
/// Reflections (Householder 1958) make it triangular; each has the determinant −1.
pub(crate) fn determinant(columns: &mut [f64], n: usize) -> f64 {
    if columns.len() != n * n || n == 0 {
        return 1.0;
    }
    let mut product = 1.0;
    for k in 0..n - 1 {
        let (done, rest) = columns.split_at_mut((k + 1) * n);
        let mirror = &mut done[k * n + k..];
        let (head, norm) = (mirror[0], norm(mirror));
        // away from the entry, so that nothing cancels
        let to = -norm.copysign(head);
        mirror[0] = head - to;
        // half the square of the mirror's length
        let half = norm * norm - head * to;
        let factor = if half == 0.0 { 0.0 } else { 1.0 / half };
        for column in rest.chunks_exact_mut(n) {
            let column = &mut column[k..];
            let along = dot(mirror, column) * factor;
            for (x, m) in column.iter_mut().zip(mirror.iter()) {
                *x -= along * *m;
            }
        }
        product *= -to;
    }
    product * columns[n * n - 1]
}

/// Whether `input` loses rank, and the condition number of the matrix that takes its `n` columns to
/// those of `moved`: infinite if it does.
///
/// With the singular value decomposition input = U Σ Vᵀ it is that of moved·V·Σ⁻¹, by one-sided Jacobi
/// rotations (Hestenes 1958).
pub(crate) fn condition(input: &mut [f64], moved: &mut [f64], n: usize) -> (bool, f64) {
    let [length, rows] = [input.len(), moved.len()].map(|entries| entries / n.max(1));
    orthogonalise(length, input, |[p, q], cosine, sine| {
        let (before, after) = moved.split_at_mut(q * rows);
        rotate(
            &mut before[p * rows..][..rows],
            &mut after[..rows],
            cosine,
            sine,
        );
    });
    let inputs = extremes(columns(input, n));
    for (column, of) in moved.chunks_exact_mut(rows.max(1)).zip(columns(input, n)) {
        let size = norm(of);
        column.iter_mut().for_each(|x| *x /= size);
    }
    orthogonalise(rows, moved, |_, _, _| {});
    let outputs = extremes(columns(moved, n));
    let lost = inputs[0] <= RANK_TOLERANCE * inputs[1];
    let flat = outputs[1] <= 0.0 || outputs[0] <= RANK_TOLERANCE * outputs[1];
    let none = lost || flat || !outputs[1].is_finite() || outputs[0].is_nan();
    let condition = match none {
        true => f64::INFINITY,
        false => outputs[1] / outputs[0],
    };
    (lost, condition)
}

fn columns(all: &[f64], n: usize) -> impl Iterator<Item = &[f64]> {
    all.chunks_exact((all.len() / n.max(1)).max(1))
}

/// The least and the greatest length of columns.
fn extremes<'c>(columns: impl Iterator<Item = &'c [f64]>) -> [f64; 2] {
    columns.fold([f64::INFINITY, 0.0], |[least, most], column| {
        let size = norm(column);
        [least.min(size), most.max(size)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_are_those_of_a_singular_value_decomposition() {
        for n in 1..=6usize {
            for k in 0..8 {
                let entry = |i: usize, j: usize, k: usize| {
                    (12.9898 * (i + 7 * j + 53 * k + 1) as f64).sin() * 43758.5453 % 1.0
                };
                let input = nalgebra::DMatrix::from_fn(n, n, |i, j| entry(i, j, k));
                let moved = nalgebra::DMatrix::from_fn(6, n, |i, j| entry(i, j, k + 100));
                let [mut columns, mut with] = [&input, &moved].map(|m| m.as_slice().to_vec());
                let (lost, found) = condition(&mut columns, &mut with, n);
                let values = (moved * input.try_inverse().unwrap()).singular_values();
                let exact = values[0] / values[n - 1];
                assert!((found / exact - 1.0).abs() < 1e-9, "{n}: {found} {exact}");
                assert!(!lost);
            }
        }
    }

    #[test]
    fn determinants_are_those_of_another_library() {
        for n in 1..=7usize {
            for k in 0..8 {
                let entry = |i: usize, j: usize| {
                    (2.7 * ((j * n + i) * (j * n + i)) as f64 + 0.31 * k as f64).cos()
                };
                let matrix = nalgebra::DMatrix::from_fn(n, n, entry);
                let found = determinant(&mut matrix.as_slice().to_vec(), n);
                let exact = matrix.determinant();
                assert!((found - exact).abs() < 1e-12 * (1.0 + exact.abs()));
            }
        }
    }

    #[test]
    fn the_determinant_of_dependent_columns_is_zero_and_that_of_none_one() {
        assert_eq!(determinant(&mut [0.0, 1.0, 0.0, 2.0], 2), 0.0);
        // rounding of the product of the columns' lengths, 20
        assert!(determinant(&mut [1.0, 3.0, 2.0, 6.0], 2).abs() < 20.0 * 4.0 * f64::EPSILON);
        assert_eq!(determinant(&mut [0.0, 1.0, -1.0, 0.0], 2), 1.0);
        assert_eq!(determinant(&mut [], 0), 1.0);
    }

    #[test]
    fn where_inputs_depend_on_one_another_the_condition_is_infinite() {
        let (mut input, mut moved) = ([1.0, 2.0, 2.0, 4.0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(condition(&mut input, &mut moved, 2), (true, f64::INFINITY));
    }
}
