//! Bases along coordinate axes, as far as possible.

use super::{norm, orthonormal, remove};
use crate::number::tolerance::SAME;

/// A basis of a space: the unit vectors in it, and the rest in echelon form.
pub fn axis_aligned(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let space = orthonormal(vectors, SAME);
    let Some(size) = space.first().map(Vec::len) else {
        return vec![];
    };
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for i in 0..size {
        let share: f64 = space.iter().map(|vector| vector[i] * vector[i]).sum();
        if share > 1.0 - SAME * SAME.sqrt() {
            let mut unit = vec![0.0; size];
            unit[i] = 1.0;
            basis.push(unit);
        }
    }
    let mut rest = space;
    rest.iter_mut().for_each(|vector| remove(vector, &basis));
    basis.extend(echelon(orthonormal(&rest, 1e-3)));
    basis
}

/// Reduced echelon form with rows scaled to unit length.
fn echelon(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let size = rows.first().map_or(0, Vec::len);
    let mut done = 0;
    for column in 0..size {
        let pivot = (done..rows.len())
            .max_by(|&i, &j| rows[i][column].abs().total_cmp(&rows[j][column].abs()));
        let Some(pivot) = pivot.filter(|&pivot| rows[pivot][column].abs() > 1e-3) else {
            continue;
        };
        rows.swap(done, pivot);
        let scale = rows[done][column];
        rows[done].iter_mut().for_each(|x| *x /= scale);
        for i in 0..rows.len() {
            if i != done {
                let factor = rows[i][column];
                let pivot_row = rows[done].clone();
                let row = rows[i].iter_mut().zip(&pivot_row);
                row.for_each(|(x, p)| *x -= factor * p);
            }
        }
        done += 1;
    }
    for row in &mut rows {
        let length = norm(row);
        let zero = |x: f64| x.abs() < SAME * length;
        row.iter_mut()
            .for_each(|x| *x = if zero(*x) { 0.0 } else { *x / length });
    }
    rows
}
