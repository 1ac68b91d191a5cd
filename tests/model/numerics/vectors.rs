//! Vectors, and bases of them.

use super::numbers;
use linkwork::linear::*;

/// Random orthonormal weights: what is left is orthonormal as the vectors were, and orthogonal to the combinations
/// left out; without a reflection it would not be.
#[test]
fn combinations_without_weights_are_orthogonal_to_those_left_out() {
    let (count, size) = (9, 14);
    let mut next = numbers(3);
    let mut random = |many: usize, size: usize| -> Vec<Vec<f64>> {
        let vector = |_| (0..size).map(|_| next()).collect();
        orthonormal(&(0..many).map(vector).collect::<Vec<_>>(), 1e-9)
    };
    let (vectors, weights) = (random(count, size), random(4, count));
    let combined = |weights: &Vec<f64>| -> Vec<f64> {
        let mut sum = vec![0.0; size];
        (weights.iter().zip(&vectors)).for_each(|(w, vector)| add(&mut sum, *w, vector));
        sum
    };
    let out: Vec<Vec<f64>> = weights.iter().map(combined).collect();
    let left = without(vectors.clone(), weights.clone());
    assert_eq!(left.len(), count - weights.len());
    let all = [out, left].concat();
    for (i, a) in all.iter().enumerate() {
        for (j, b) in all.iter().enumerate() {
            let expected = f64::from(u8::from(i == j));
            assert!(
                (dot(a, b) - expected).abs() < 1e-14,
                "{i} {j}: {}",
                dot(a, b)
            );
        }
    }
    let kept = dot(&combined(&weights[0]), &vectors[0]).abs();
    assert!(
        kept > 1e-3,
        "the vectors themselves are not orthogonal to those left out"
    );
}
