//! Determinants and condition numbers of small matrices, in several places side by side.

use crate::linear::RANK_TOLERANCE;
use crate::number::{LANES, Packed};

/// The determinant of a square matrix of `n` columns, which is destroyed; 1 if it is not square.
///
/// Reflections (Householder 1958) make it triangular; each has the determinant −1.
pub(crate) fn determinant<T: Packed>(columns: &mut [T], n: usize) -> T {
    if columns.len() != n * n || n == 0 {
        return T::one();
    }
    let mut product = T::one();
    for k in 0..n - 1 {
        let (done, rest) = columns.split_at_mut((k + 1) * n);
        let mirror = &mut done[k * n + k..];
        let (head, norm) = (mirror[0], square(mirror).sqrt());
        // away from the entry, so that nothing cancels
        let to = T::of_parts(|p| -norm.part(p).copysign(head.part(p)));
        mirror[0] = head - to;
        // half the square of the mirror's length
        let half = norm * norm - head * to;
        let factor = T::of_parts(|p| match half.part(p) {
            0.0 => 0.0,
            half => 1.0 / half,
        });
        for column in rest.chunks_exact_mut(n) {
            let column = &mut column[k..];
            let both = mirror.iter().zip(column.iter());
            let along = both.fold(T::zero(), |sum, (m, x)| sum + *m * *x) * factor;
            for (x, m) in column.iter_mut().zip(mirror.iter()) {
                *x -= along * *m;
            }
        }
        product = -(product * to);
    }
    product * columns[n * n - 1]
}

/// Whether `input` loses rank, and the condition number of the matrix that takes its `n` columns to
/// those of `moved`, in each place: infinite if it does.
///
/// With the singular value decomposition input = U Σ Vᵀ it is that of moved·V·Σ⁻¹. One-sided Jacobi
/// rotations (Hestenes 1958) do the same in every place, so that places side by side do not wait
/// for one another.
pub(crate) fn condition<T: Packed>(
    input: &mut [T],
    moved: &mut [T],
    n: usize,
) -> [(bool, f64); LANES] {
    rotate(input, moved, n);
    let inputs = extremes(columns(input, n));
    let rows = moved.len() / n.max(1);
    for (column, of) in moved.chunks_exact_mut(rows.max(1)).zip(columns(input, n)) {
        let size = square(of).sqrt();
        column.iter_mut().for_each(|x| *x = *x / size);
    }
    rotate(moved, &mut [], n);
    let outputs = extremes(columns(moved, n));
    let quotient = |place: usize| {
        let [of_inputs, of] = [inputs, outputs].map(|of| of.map(|x| x.part(place)));
        let lost = of_inputs[0] <= RANK_TOLERANCE * of_inputs[1];
        let flat = of[1] <= 0.0 || of[0] <= RANK_TOLERANCE * of[1];
        let none = lost || flat || !of[1].is_finite() || of[0].is_nan();
        (lost, if none { f64::INFINITY } else { of[1] / of[0] })
    };
    std::array::from_fn(|place| match place < T::WIDTH {
        true => quotient(place),
        false => (false, f64::INFINITY),
    })
}

fn columns<T>(all: &[T], n: usize) -> impl Iterator<Item = &[T]> {
    all.chunks_exact((all.len() / n.max(1)).max(1))
}

fn square<T: Packed>(column: &[T]) -> T {
    column.iter().fold(T::zero(), |sum, x| sum + *x * *x)
}

/// The least and the greatest length of columns, in each place.
fn extremes<'c, T: Packed>(columns: impl Iterator<Item = &'c [T]>) -> [T; 2] {
    let none = [f64::INFINITY, 0.0].map(T::from_f64);
    columns.fold(none, |[least, most], column| {
        let size = square(column).sqrt();
        let chosen = |old: T, better: fn(f64, f64) -> bool| {
            T::of_parts(|p| {
                let (new, old) = (size.part(p), old.part(p));
                if better(new, old) { new } else { old }
            })
        };
        [chosen(least, |x, y| x < y), chosen(most, |x, y| x > y)]
    })
}

/// Makes `n` columns orthogonal to one another by rotations, which other columns go along with.
fn rotate<T: Packed>(columns: &mut [T], with: &mut [T], n: usize) {
    /// Cosines of this square are rounding, and so is what one more rotation leaves.
    const ROUNDING: f64 = 1e-24;
    let (rows, others) = (columns.len() / n.max(1), with.len() / n.max(1));
    // two columns take one rotation; six are orthogonal to rounding after seven rounds at most
    let rounds = if n <= 2 { 1 } else { 3 + n / 2 + 1 };
    for _ in 0..rounds {
        let mut straight = true;
        for i in 0..n {
            for j in i + 1..n {
                let (left, right) = columns.split_at_mut(j * rows);
                let (x, y) = (&mut left[i * rows..][..rows], &mut right[..rows]);
                let (a, b) = (square(x), square(y));
                let both = x.iter().zip(y.iter());
                let c = both.fold(T::zero(), |sum, (x, y)| sum + *x * *y);
                straight &= (0..T::WIDTH).all(|place| {
                    let (a, b, c) = (a.part(place), b.part(place), c.part(place));
                    c * c <= ROUNDING * a * b
                });
                let turn = |place: usize| {
                    let (a, b, c) = (a.part(place), b.part(place), c.part(place));
                    let z = (b - a) / (2.0 * c);
                    let tan = 1.0f64.copysign(z) / (z.abs() + (1.0 + z * z).sqrt());
                    if c == 0.0 { 0.0 } else { tan }
                };
                let tan = T::of_parts(turn);
                let cos = T::one() / (T::one() + tan * tan).sqrt();
                let sin = cos * tan;
                let pair = |x: &mut [T], y: &mut [T]| {
                    for (x, y) in x.iter_mut().zip(y) {
                        (*x, *y) = (*x * cos - *y * sin, *x * sin + *y * cos);
                    }
                };
                pair(x, y);
                if others > 0 {
                    let (left, right) = with.split_at_mut(j * others);
                    pair(&mut left[i * others..][..others], &mut right[..others]);
                }
            }
        }
        if straight {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Lanes;

    #[test]
    fn conditions_are_those_of_a_singular_value_decomposition_in_every_lane() {
        for n in 1..=6usize {
            let entry = |i: usize, j: usize, k: usize| {
                (12.9898 * (i + 7 * j + 53 * k + 1) as f64).sin() * 43758.5453 % 1.0
            };
            let lanes = |rows: usize, shift: usize| -> Vec<Lanes> {
                let columns = (0..n).flat_map(|j| (0..rows).map(move |i| (i, j)));
                let one = |(i, j)| Lanes::of_parts(|k| entry(i, j, k + shift));
                columns.map(one).collect()
            };
            let (input, moved) = (lanes(n, 0), lanes(6, 100));
            let found = condition(&mut input.clone(), &mut moved.clone(), n);
            for (k, (lost, found)) in found.into_iter().enumerate() {
                let input = nalgebra::DMatrix::from_fn(n, n, |i, j| input[j * n + i].part(k));
                let moved = nalgebra::DMatrix::from_fn(6, n, |i, j| moved[j * 6 + i].part(k));
                let values = (moved * input.try_inverse().unwrap()).singular_values();
                let exact = values[0] / values[n - 1];
                assert!((found / exact - 1.0).abs() < 1e-9, "{n}: {found} {exact}");
                assert!(!lost);
            }
        }
    }

    #[test]
    fn determinants_are_those_of_each_place() {
        for n in 1..=7usize {
            let entry = |i: usize, k: usize| (2.7 * i as f64 + 0.31 * k as f64).cos();
            let lanes: Vec<Lanes> = (0..n * n)
                .map(|i| Lanes::of_parts(|k| entry(i * i, k)))
                .collect();
            let found = determinant(&mut lanes.clone(), n);
            for k in 0..8 {
                let exact = nalgebra::DMatrix::from_fn(n, n, |i, j| lanes[j * n + i].part(k));
                let exact = exact.determinant();
                assert!((found.part(k) - exact).abs() < 1e-12 * (1.0 + exact.abs()));
            }
        }
    }

    #[test]
    fn the_determinant_of_dependent_columns_is_zero_and_that_of_none_one() {
        assert_eq!(determinant(&mut [0.0, 1.0, 0.0, 2.0], 2), 0.0);
        // rounding of the product of the columns' lengths, 20
        assert!(determinant(&mut [1.0, 3.0, 2.0, 6.0], 2).abs() < 20.0 * 4.0 * f64::EPSILON);
        assert_eq!(determinant(&mut [0.0, 1.0, -1.0, 0.0], 2), 1.0);
        assert_eq!(determinant::<f64>(&mut [], 0), 1.0);
    }

    #[test]
    fn where_inputs_depend_on_one_another_the_condition_is_infinite() {
        let (mut input, mut moved) = ([1.0, 2.0, 2.0, 4.0], [1.0, 0.0, 0.0, 1.0]);
        let [one, ..] = condition::<f64>(&mut input, &mut moved, 2);
        assert_eq!(one, (true, f64::INFINITY));
    }
}
