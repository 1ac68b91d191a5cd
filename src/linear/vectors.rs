/// a·b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// √(a·a).
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// x ← x + factor·y.
pub fn add(x: &mut [f64], factor: f64, y: &[f64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x += factor * y);
}

/// A x for a column-major matrix of so many rows.
pub fn product(entries: &[f64], rows: usize, x: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; rows];
    for (column, x) in entries.chunks_exact(rows.max(1)).zip(x) {
        add(&mut product, *x, column);
    }
    product
}

/// Orthonormal basis of what the given vectors span, leaving out what is within the tolerance of
/// depending on the others.
pub fn orthonormal(vectors: &[Vec<f64>], tolerance: f64) -> Vec<Vec<f64>> {
    let mut left: Vec<Vec<f64>> = vectors.to_vec();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    while let Some(best) =
        (0..left.len()).max_by(|&i, &j| norm(&left[i]).total_cmp(&norm(&left[j])))
    {
        let mut next = left.swap_remove(best);
        let before = norm(&next);
        if before <= tolerance {
            break;
        }
        // once more, for what cancellation left of the others
        remove(&mut next, &basis);
        let length = norm(&next);
        next.iter_mut().for_each(|x| *x /= length);
        for other in &mut left {
            remove(other, std::slice::from_ref(&next));
        }
        basis.push(next);
    }
    basis
}

/// Orthonormal basis of all that is orthogonal to orthonormal vectors of `size` components.
pub fn complement(basis: &[Vec<f64>], size: usize) -> Vec<Vec<f64>> {
    let mut known: Vec<Vec<f64>> = basis.to_vec();
    let mut missing: Vec<Vec<f64>> = Vec::new();
    for _ in basis.len()..size {
        // the unit vector that the known ones explain worst
        let explained = |i: usize| known.iter().map(|v| v[i] * v[i]).sum::<f64>();
        let unexplained = |i: usize| 1.0 - explained(i);
        let worst = (0..size).max_by(|&i, &j| unexplained(i).total_cmp(&unexplained(j)));
        let best = worst.expect("size > 0");
        let mut next = vec![0.0; size];
        next[best] = 1.0;
        remove(&mut next, &known);
        remove(&mut next, &known);
        let length = norm(&next);
        next.iter_mut().for_each(|x| *x /= length);
        known.push(next.clone());
        missing.push(next);
    }
    missing
}

/// What is left of a vector without its components along orthonormal ones.
pub fn remove(vector: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis {
        let along = dot(vector, direction);
        add(vector, -along, direction);
    }
}
