//! The least largest change that meets linear conditions.

use crate::linear::{Svd, add, dot};
use crate::number::tolerance::SOLVED;

/// The least largest |δ| of all δ that meet the conditions which a change meets: rows of coefficients, what is left of them at
/// their end. Weighted least squares come near it from above, in which changes that are large cost more from one round to the next
/// (Lawson 1961).
pub(super) fn least_largest(rows: &[Vec<f64>], change: &[f64]) -> f64 {
    const ROUNDS: usize = 200;
    let largest = |x: &[f64]| x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let (count, numbers) = (rows.len(), change.len());
    let wanted: Vec<f64> = rows
        .iter()
        .map(|row| dot(&row[..numbers], change))
        .collect();
    let mut weights = vec![1.0 / numbers as f64; numbers];
    let mut least = largest(change);
    for _ in 0..ROUNDS {
        let columns = (0..numbers).flat_map(|j| {
            let weight = weights[j].sqrt();
            rows.iter().map(move |row| row[j] * weight)
        });
        let columns: Vec<f64> = columns.collect();
        let svd = Svd::of(count, numbers, &columns);
        let mut scaled = vec![0.0; numbers];
        let counted = svd.values.iter().take(count.min(numbers));
        for (i, value) in counted
            .enumerate()
            .filter(|(_, value)| **value > SOLVED * svd.values[0])
        {
            add(
                &mut scaled,
                dot(&svd.left[i], &wanted) / value,
                &svd.right[i],
            );
        }
        let found: Vec<f64> = scaled
            .iter()
            .zip(&weights)
            .map(|(x, w)| x * w.sqrt())
            .collect();
        let met = rows.iter().zip(&wanted).all(|(row, wanted)| {
            (dot(&row[..numbers], &found) - wanted).abs() <= 1e-6 * (1e-300 + wanted.abs())
        });
        if met {
            least = least.min(largest(&found));
        }
        // what is large becomes dearer, what is small cheaper
        let most = largest(&found).max(f64::MIN_POSITIVE);
        let of = found.iter().map(|x| x.abs() / most + 1e-3);
        weights.iter_mut().zip(of).for_each(|(w, x)| *w /= x);
        let most = largest(&weights);
        weights.iter_mut().for_each(|w| *w /= most);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::least_largest;

    #[test]
    fn a_sum_is_shared_evenly_and_what_appears_alone_is_not() {
        // x + y + z = 3; and x = 2
        let sum = vec![1.0, 1.0, 1.0, 0.0];
        assert!((least_largest(std::slice::from_ref(&sum), &[3.0, 0.0, 0.0]) - 1.0).abs() < 1e-3);
        let alone = vec![1.0, 0.0, 0.0, 0.0];
        assert!((least_largest(&[sum, alone], &[2.0, 1.0, 0.0]) - 2.0).abs() < 1e-3);
        // x + 2 y = 3 has the least largest 1, its shortest solution 6/5
        assert!((least_largest(&[vec![1.0, 2.0, 0.0]], &[0.6, 1.2]) - 1.0).abs() < 2e-2);
    }
}
