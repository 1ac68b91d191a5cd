//! Gaussian elimination in an order that is chosen at one point, for numbers that are not known yet.

use super::Recorded;
use crate::linear::{Filled, INDEPENDENT, SparseStep};
use crate::number::Number;
use crate::number::tolerance::ROUNDING;

/// The part of its natural size beyond which a pivot is not small.
pub const LEAST_PIVOT: f64 = 1e-4;

/// The most unknowns that are solved for at once at the end.
const LAST: usize = 3;

/// A divisor in the elimination.
pub struct Pivot {
    /// The number.
    pub number: Recorded,
    /// Its reciprocal.
    pub inverse: Recorded,
    /// Its absolute value at the sample, divided by that of the last of the pivots that it is a product of.
    pub scale: f64,
}

/// Solves A x = b for each of several right-hand sides, with the pivots in the order of elimination. Rows beyond the
/// rank depend on the others. Returns the rank as the error if it is less than the number of unknowns.
///
/// The last two or three unknowns follow by Cramer's rule, with one division, if every pivot would make new entries.
pub fn eliminate(
    mut matrix: Vec<Vec<Recorded>>,
    mut sides: Vec<Vec<Recorded>>,
    unknowns: usize,
) -> Result<(Vec<Vec<Recorded>>, Vec<Pivot>), usize> {
    let is_zero = |x: Recorded| x.constant() == Some(0.0);
    let mut rows: Vec<usize> = (0..matrix.len()).collect();
    let mut columns: Vec<usize> = (0..unknowns).collect();
    let mut order = Vec::with_capacity(unknowns);
    while !columns.is_empty() {
        let (row, column, fills) = chosen(&matrix, &rows, &columns).ok_or(order.len())?;
        if fills && columns.len() <= LAST {
            break;
        }
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
    let pivots = order.iter().map(|&(row, column, inverse)| Pivot {
        number: matrix[row][column],
        inverse,
        scale: 1.0,
    });
    let mut pivots: Vec<Pivot> = pivots.collect();
    let mut last = Vec::new();
    if !columns.is_empty() {
        let eliminated = order.len();
        let (rows, scale) =
            independent(&matrix, rows, &columns).map_err(|rank| eliminated + rank)?;
        let cofactors = cofactors(&matrix, &rows, &columns);
        let first = cofactors.iter().zip(&columns);
        let number = first.fold(Recorded::zero(), |sum, (c, &column)| {
            sum + c[0] * matrix[rows[0]][column]
        });
        let inverse = Recorded::one() / number;
        pivots.push(Pivot {
            number,
            inverse,
            scale,
        });
        last.extend(
            columns
                .into_iter()
                .zip(cofactors)
                .map(|(column, cofactors)| {
                    let rows = rows.clone();
                    (column, move |side: &[Recorded]| {
                        let parts = rows.iter().zip(&cofactors).map(|(&row, &c)| side[row] * c);
                        parts.fold(Recorded::zero(), |sum, part| sum + part) * inverse
                    })
                }),
        );
    }
    let solutions = sides.into_iter().map(|side| {
        let mut x = vec![Recorded::zero(); unknowns];
        let mut known: Vec<usize> = Vec::with_capacity(unknowns);
        for (column, of) in &last {
            x[*column] = of(&side);
            known.push(*column);
        }
        for &(row, column, inverse) in order.iter().rev() {
            let later = known.iter().rev();
            let sum = later.fold(side[row], |sum, &c| sum - matrix[row][c] * x[c]);
            x[column] = sum * inverse;
            known.push(column);
        }
        x
    });
    Ok((solutions.collect(), pivots))
}

/// As many independent rows as there are columns, by the largest entries of what is left at the sample; and the product
/// of all pivots but the last. The rank, if it is less.
fn independent(
    matrix: &[Vec<Recorded>],
    mut rows: Vec<usize>,
    columns: &[usize],
) -> Result<(Vec<usize>, f64), usize> {
    let real = |row: &usize| columns.iter().map(|&c| matrix[*row][c].real()).collect();
    let mut left: Vec<Vec<f64>> = rows.iter().map(real).collect();
    let (mut found, mut scale, mut last) = (Vec::new(), 1.0, 1.0);
    for _ in columns {
        let places = (0..rows.len()).flat_map(|r| (0..columns.len()).map(move |c| (r, c)));
        let size = |&(r, c): &(usize, usize)| left[r][c].abs();
        let largest = places.max_by(|a, b| size(a).total_cmp(&size(b)));
        let (r, c) = largest
            .filter(|place| size(place) >= INDEPENDENT)
            .ok_or(found.len())?;
        let pivot = left.remove(r);
        found.push(rows.remove(r));
        for row in &mut left {
            let factor = row[c] / pivot[c];
            row.iter_mut()
                .zip(&pivot)
                .for_each(|(x, p)| *x -= factor * p);
            row[c] = 0.0;
        }
        scale *= last;
        last = pivot[c].abs();
    }
    found.sort_unstable();
    Ok((found, scale))
}

/// For each column its cofactors by rows.
fn cofactors(matrix: &[Vec<Recorded>], rows: &[usize], columns: &[usize]) -> Vec<Vec<Recorded>> {
    let without = |of: &[usize], i: usize| [&of[..i], &of[i + 1..]].concat();
    let cofactor = |r: usize, c: usize| {
        let (rows, columns) = (without(rows, r), without(columns, c));
        let minor = match (&rows[..], &columns[..]) {
            (&[r, s], &[c, d]) => matrix[r][c] * matrix[s][d] - matrix[r][d] * matrix[s][c],
            (rows, columns) => matrix[rows[0]][columns[0]],
        };
        if (r + c).is_multiple_of(2) {
            minor
        } else {
            -minor
        }
    };
    let all = (0..columns.len()).map(|c| (0..rows.len()).map(|r| cofactor(r, c)).collect());
    all.collect()
}

/// The pivot that makes the fewest new entries, and true if it makes any; constants first, then the largest.
fn chosen(
    matrix: &[Vec<Recorded>],
    rows: &[usize],
    columns: &[usize],
) -> Option<(usize, usize, bool)> {
    let filled = |x: Recorded| x.constant() != Some(0.0);
    // new entries and whether the pivot varies, its size, its place
    let mut best = ((usize::MAX, true), 0.0, None);
    for &column in columns {
        let size = |&row: &usize| matrix[row][column].real().abs();
        let largest = rows.iter().map(size).fold(0.0, f64::max);
        if largest < INDEPENDENT {
            continue;
        }
        let beside = rows.iter().filter(|&&r| filled(matrix[r][column])).count() - 1;
        for &row in rows {
            let entry = matrix[row][column];
            let size = entry.real().abs();
            // stable with entries that vary: a pivot is no less than a tenth of the largest in its column
            if size < (0.1 * largest).max(INDEPENDENT) {
                continue;
            }
            let along = columns.iter().filter(|&&c| filled(matrix[row][c])).count() - 1;
            let cost = (beside * along, entry.constant().is_none());
            let (least, most, _) = best;
            if cost < least || (cost == least && size > most * (1.0 + ROUNDING)) {
                best = (cost, size, Some((row, column, cost.0 > 0)));
            }
        }
    }
    best.2
}

/// Steps by [elimination](eliminate). That no pivot becomes small is a [`Decision`](super::Decision).
#[derive(Clone, Debug)]
pub struct RecordedElimination {
    matrix: Vec<Vec<Recorded>>,
    unknowns: usize,
    undetermined: usize,
}

impl SparseStep<Recorded> for RecordedElimination {
    const ABOVE: usize = 0;

    fn new(unknowns: usize, _: &[Filled<Recorded>], _: usize) -> Self {
        RecordedElimination {
            matrix: Vec::new(),
            unknowns,
            undetermined: 0,
        }
    }

    fn factorise(&mut self, blocks: &[Filled<Recorded>], extra: &[Recorded], _: f64) {
        let zero = Recorded::zero();
        self.matrix.clear();
        for filled in blocks {
            let first = self.matrix.len();
            let rows = first + filled.block.rows;
            self.matrix.resize(rows, vec![zero; self.unknowns]);
            for (unknown, column) in filled.columns() {
                let rows = self.matrix[first..].iter_mut();
                rows.zip(column).for_each(|(row, &x)| row[unknown] = x);
            }
        }
        let extra = extra.chunks_exact(self.unknowns.max(1));
        self.matrix.extend(extra.map(<[Recorded]>::to_vec));
        let eliminated = eliminate(self.matrix.clone(), Vec::new(), self.unknowns);
        self.undetermined = match eliminated {
            Ok((_, pivots)) => {
                let is_small = |of: &Pivot| {
                    let least = Recorded::from_f64(LEAST_PIVOT * of.scale);
                    of.number.abs().less(least)
                };
                pivots.iter().filter(|of| is_small(of)).count()
            }
            Err(rank) => self.unknowns - rank,
        };
    }

    /// Zero if not all unknowns are determined.
    fn step(&self, _: &[Filled<Recorded>], r: &[Recorded], x: &mut [Recorded]) {
        x.fill(Recorded::zero());
        let found = eliminate(self.matrix.clone(), vec![r.to_vec()], self.unknowns);
        if let Ok((found, _)) = found {
            x.iter_mut().zip(&found[0]).for_each(|(x, &y)| *x = -y);
        }
    }

    fn nullity(&self) -> usize {
        self.undetermined
    }
}
