//! Determinants and condition numbers of small matrices, in several places side by side.

use crate::linear::RANK_TOLERANCE;
use crate::number::Packed;

/// The determinant of a square matrix of `n` columns in one place; 1 of none.
pub(super) fn determinant<T: Packed>(columns: &[T], n: usize, place: usize) -> f64 {
    const MOST: usize = 6;
    if columns.len() != n * n || n == 0 {
        return 1.0;
    }
    let entry = |i: usize, j: usize| columns[j * n + i].part(place);
    if n > MOST {
        return nalgebra::DMatrix::from_fn(n, n, entry).determinant();
    }
    // with ones beside it on the diagonal it needs no memory of its own
    nalgebra::SMatrix::<f64, MOST, MOST>::from_fn(|i, j| match (i < n, j < n) {
        (true, true) => entry(i, j),
        _ => f64::from(u8::from(i == j)),
    })
    .determinant()
}

/// Whether `input` loses rank, and the condition number of the matrix that takes its `n` columns to
/// those of `moved`, in each place: infinite if it does.
///
/// With the singular value decomposition input = U Σ Vᵀ it is that of moved·V·Σ⁻¹. One-sided Jacobi
/// rotations (Hestenes 1958) do the same in every place, so that places side by side do not wait
/// for one another.
pub(super) fn condition<T: Packed>(input: &mut [T], moved: &mut [T], n: usize) -> Vec<(bool, f64)> {
    rotate(input, moved, n);
    let sizes: Vec<T> = columns(input, n).map(|c| square(c).sqrt()).collect();
    let inputs = extremes(&sizes);
    let rows = moved.len() / n.max(1);
    for (column, size) in moved.chunks_exact_mut(rows.max(1)).zip(&sizes) {
        column.iter_mut().for_each(|x| *x = *x / *size);
    }
    rotate(moved, &mut [], n);
    let sizes: Vec<T> = columns(moved, n).map(|c| square(c).sqrt()).collect();
    let quotient = |((least, greatest), of): (&(f64, f64), &(f64, f64))| {
        let lost = *least <= RANK_TOLERANCE * greatest;
        let flat = of.1 <= 0.0 || of.0 <= RANK_TOLERANCE * of.1;
        let none = lost || flat || !of.1.is_finite() || of.0.is_nan();
        (lost, if none { f64::INFINITY } else { of.1 / of.0 })
    };
    inputs.iter().zip(&extremes(&sizes)).map(quotient).collect()
}

fn columns<T>(all: &[T], n: usize) -> impl Iterator<Item = &[T]> {
    all.chunks_exact((all.len() / n.max(1)).max(1))
}

fn square<T: Packed>(column: &[T]) -> T {
    column.iter().fold(T::zero(), |sum, x| sum + *x * *x)
}

/// The least and the greatest, in each place.
fn extremes<T: Packed>(sizes: &[T]) -> Vec<(f64, f64)> {
    let of = |place: usize| {
        let parts = sizes.iter().map(|size| size.part(place));
        parts.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), x| {
            (
                if x < least { x } else { least },
                if x > most { x } else { most },
            )
        })
    };
    (0..T::WIDTH).map(of).collect()
}

/// Makes `n` columns orthogonal to one another by rotations, which other columns go along with.
fn rotate<T: Packed>(columns: &mut [T], with: &mut [T], n: usize) {
    let (rows, others) = (columns.len() / n.max(1), with.len() / n.max(1));
    // two columns take one rotation; six are orthogonal to rounding after seven rounds
    let rounds = if n <= 2 { 1 } else { 3 + n / 2 + 1 };
    for _ in 0..rounds {
        for i in 0..n {
            for j in i + 1..n {
                let (left, right) = columns.split_at_mut(j * rows);
                let (x, y) = (&mut left[i * rows..][..rows], &mut right[..rows]);
                let (a, b) = (square(x), square(y));
                let both = x.iter().zip(y.iter());
                let c = both.fold(T::zero(), |sum, (x, y)| sum + *x * *y);
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
                let input = nalgebra::DMatrix::from_fn(n, n, |i, j| input[j * n + i].0[k]);
                let moved = nalgebra::DMatrix::from_fn(6, n, |i, j| moved[j * 6 + i].0[k]);
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
            for k in 0..8 {
                let exact = nalgebra::DMatrix::from_fn(n, n, |i, j| lanes[j * n + i].0[k]);
                let exact = exact.determinant();
                assert!((determinant(&lanes, n, k) - exact).abs() < 1e-12 * (1.0 + exact.abs()));
            }
        }
    }

    #[test]
    fn where_inputs_depend_on_one_another_the_condition_is_infinite() {
        let (mut input, mut moved) = ([1.0, 2.0, 2.0, 4.0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            condition::<f64>(&mut input, &mut moved, 2),
            [(true, f64::INFINITY)]
        );
    }
}
