//! Gaussian elimination in an order that is chosen at one point, for numbers that are not known yet.

use crate::algebra::Recorded;
use crate::number::Number;

/// A pivot smaller than this is taken for zero; rows and unknowns are dimensionless.
const LEAST: f64 = 1e-6;
/// A pivot is at least this part of the largest entry in its column.
const PART: f64 = 0.1;

/// Solves A x = b for each of several right-hand sides, with the pivots in the order of elimination. Rows that are left
/// over depend on the others. The rank, if it is less than the number of unknowns.
pub(super) fn eliminate(
    mut matrix: Vec<Vec<Recorded>>,
    mut sides: Vec<Vec<Recorded>>,
    unknowns: usize,
) -> Result<(Vec<Vec<Recorded>>, Vec<Recorded>), usize> {
    let is_zero = |x: Recorded| x.constant() == Some(0.0);
    let mut rows: Vec<usize> = (0..matrix.len()).collect();
    let mut columns: Vec<usize> = (0..unknowns).collect();
    let mut order = Vec::with_capacity(unknowns);
    while !columns.is_empty() {
        let (row, column) = chosen(&matrix, &rows, &columns).ok_or(order.len())?;
        rows.retain(|&r| r != row);
        columns.retain(|&c| c != column);
        let pivot = matrix[row][column];
        let inverse = Recorded::one() / pivot;
        for &r in &rows {
            if is_zero(matrix[r][column]) {
                continue;
            }
            let factor = matrix[r][column] * inverse;
            for &c in &columns {
                let change = factor * matrix[row][c];
                matrix[r][c] -= change;
            }
            for side in &mut sides {
                let change = factor * side[row];
                side[r] -= change;
            }
        }
        order.push((row, column, inverse));
    }
    let pivots = order.iter().map(|&(row, column, _)| matrix[row][column]);
    let pivots = pivots.collect();
    let solutions = sides.into_iter().map(|side| {
        let mut x = vec![Recorded::zero(); unknowns];
        for (k, &(row, column, inverse)) in order.iter().enumerate().rev() {
            let later = order[k + 1..].iter();
            let sum = later.fold(side[row], |sum, &(_, c, _)| sum - matrix[row][c] * x[c]);
            x[column] = sum * inverse;
        }
        x
    });
    Ok((solutions.collect(), pivots))
}

/// The pivot that makes the fewest new entries; constants first, then the largest.
fn chosen(matrix: &[Vec<Recorded>], rows: &[usize], columns: &[usize]) -> Option<(usize, usize)> {
    let filled = |x: Recorded| x.constant() != Some(0.0);
    // new entries and whether the pivot varies, its size, its place
    let mut best = ((usize::MAX, true), 0.0, None);
    for &column in columns {
        let size = |&row: &usize| matrix[row][column].real().abs();
        let largest = rows.iter().map(size).fold(0.0, f64::max);
        if largest < LEAST {
            continue;
        }
        let beside = rows.iter().filter(|&&r| filled(matrix[r][column])).count() - 1;
        for &row in rows {
            let entry = matrix[row][column];
            let size = entry.real().abs();
            if size < (PART * largest).max(LEAST) {
                continue;
            }
            let along = columns.iter().filter(|&&c| filled(matrix[row][c])).count() - 1;
            let cost = (beside * along, entry.constant().is_none());
            let (least, most, _) = best;
            if cost < least || (cost == least && size > most * (1.0 + 1e-9)) {
                best = (cost, size, Some((row, column)));
            }
        }
    }
    best.2
}
