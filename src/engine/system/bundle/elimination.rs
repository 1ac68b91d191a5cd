//! A configuration of a bundle, linearised and eliminated.

use super::sides::SideRows;
use crate::linear::{INDEPENDENT, Svd, add, complement, dot, norm, rank};
use crate::number::tolerance::SUMMED;

/// Closures and targets of one configuration, linearised; matrices are dense and column-major.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    pub unknowns: usize,
    pub numbers: usize,
    /// The residual r of the closures.
    pub closures: Vec<f64>,
    /// ∂r/∂x.
    pub by_unknowns: Vec<f64>,
    /// ∂r/∂p.
    pub by_numbers: Vec<f64>,
    /// For each target its derivatives by x, then by p, then what is left of it.
    pub targets: Vec<Vec<f64>>,
}

/// Rows that an eliminated configuration leaves for the shared numbers: coefficients, and the residual at the end.
pub(super) struct Left {
    pub conditions: Vec<Vec<f64>>,
    pub targets: Vec<Vec<f64>>,
}

/// The step of a configuration for a step of the shared numbers: a column for each of these, and a constant.
#[derive(Clone, Debug)]
pub(super) struct Eliminated(Vec<Vec<f64>>);

impl Eliminated {
    pub(super) fn step(&self, numbers: &[f64]) -> Vec<f64> {
        let (constant, columns) = self.0.split_last().expect("there is a constant");
        let mut step = constant.clone();
        for (column, number) in columns.iter().zip(numbers) {
            add(&mut step, *number, column);
        }
        step
    }
}

/// Makes coefficients zero that are what rounding leaves of terms of these sizes: where a configuration meets its targets by itself
/// nothing is left for the shared numbers.
fn cancel(row: &mut [f64], size: impl Fn(usize) -> f64) {
    let (_, coefficients) = row.split_last_mut().expect("there is a constant");
    for (j, x) in coefficients.iter_mut().enumerate() {
        if x.abs() <= SUMMED * size(j) {
            *x = 0.0;
        }
    }
}

impl Blocks {
    /// Number of closures that repeat others for all values of the unknowns and the shared numbers nearby.
    pub(super) fn repeated(&self) -> usize {
        let rows = self.closures.len();
        let columns = [&self.by_unknowns[..], &self.by_numbers[..]].concat();
        let count = self.unknowns + self.numbers;
        let mut svd = Svd::of(rows, count, &columns);
        svd.values.truncate(rows.min(count));
        rows - rank(&svd.values)
    }

    /// Leaves out the shared numbers.
    pub(super) fn stand_still(&mut self) {
        let (unknowns, numbers) = (self.unknowns, self.numbers);
        for row in &mut self.targets {
            row.drain(unknowns..unknowns + numbers);
        }
        self.by_numbers.clear();
        self.numbers = 0;
    }

    /// Makes some targets equations.
    pub(super) fn impose(&mut self, exact: &[bool]) {
        if !exact.contains(&true) {
            return;
        }
        let rows = self.closures.len();
        let mut places = exact.iter();
        let (met, targets): (Vec<_>, Vec<_>) = std::mem::take(&mut self.targets)
            .into_iter()
            .partition(|_| places.next() == Some(&true));
        let taller = |column: usize, from: &[f64]| -> Vec<f64> {
            let more = met.iter().map(|row| row[column]);
            from.iter().copied().chain(more).collect()
        };
        let (unknowns, numbers) = (self.unknowns, self.numbers);
        let of = |all: &[f64], i: usize| all[i * rows..(i + 1) * rows].to_vec();
        let by_unknowns = (0..unknowns).flat_map(|i| taller(i, &of(&self.by_unknowns, i)));
        let by_unknowns = by_unknowns.collect();
        let by_numbers = (0..numbers).flat_map(|i| taller(unknowns + i, &of(&self.by_numbers, i)));
        self.by_numbers = by_numbers.collect();
        self.by_unknowns = by_unknowns;
        self.closures = taller(unknowns + numbers, &self.closures);
        self.targets = targets;
    }

    /// The step of the configuration alone, of least length.
    pub(super) fn alone(&self, given: Option<usize>) -> Vec<f64> {
        self.eliminated(given, 0.0).0.step(&[])
    }

    /// The steps for each of the shared numbers and for none of them, where the equations determine the configuration.
    fn solved(&self) -> Option<Vec<Vec<f64>>> {
        let (rows, size) = (self.closures.len(), self.unknowns);
        if rows != size || rows == 0 {
            return None;
        }
        let width = size + self.numbers + 1;
        let row = |i: usize| {
            let sides = self.by_numbers.iter().skip(i).step_by(rows);
            let sides = sides.chain([&self.closures[i]]).map(|x| -x);
            let unknowns = self.by_unknowns.iter().skip(i).step_by(rows).copied();
            unknowns.chain(sides)
        };
        let mut matrix = SideRows {
            width,
            entries: (0..rows).flat_map(row).collect(),
        };
        let largest = self
            .by_unknowns
            .iter()
            .fold(0.0f64, |most, x| most.max(x.abs()));
        if !matrix.eliminate(size) {
            return None;
        }
        // of smaller pivots the singular values decide
        let regular = (0..size).all(|i| matrix.row(i)[i].abs() * INDEPENDENT * largest < 1.0);
        let step = |side: usize| {
            let mut step = vec![0.0; size];
            matrix.back(size, &[], side, &mut step);
            step
        };
        regular.then(|| (size..width).map(step).collect())
    }

    /// Eliminates the configuration, whose closures have a given rank or that of their singular values. Where these leave it free it
    /// meets its targets as far as steps damped by λ beside the largest curvature can: |A y + t|² + λ|y|² is least.
    pub(super) fn eliminated(&self, given: Option<usize>, damping: f64) -> (Eliminated, Left) {
        let (rows, unknowns) = (self.closures.len(), self.unknowns);
        if let (None, Some(steps)) = (given, self.solved()) {
            let left = |target: &Vec<f64>| {
                let (slopes, rest) = target.split_at(unknowns);
                let pairs = rest.iter().zip(&steps);
                pairs.map(|(x, step)| x + dot(slopes, step)).collect()
            };
            let targets = self.targets.iter().map(left).collect();
            let conditions = Vec::new();
            let left = Left {
                conditions,
                targets,
            };
            return (Eliminated(steps), left);
        }
        let mut svd = Svd::of(rows, unknowns, &self.by_unknowns);
        svd.values.truncate(rows.min(unknowns));
        let rank = given.map_or_else(|| rank(&svd.values), |given| given.min(svd.values.len()));
        svd.left.truncate(rank);
        let redundant = complement(&svd.left, rows);
        let free = &svd.right[rank..];
        let columns = || {
            let by_numbers = self.by_numbers.chunks_exact(rows.max(1));
            let none = std::iter::repeat_n(&[][..], if rows == 0 { self.numbers } else { 0 });
            by_numbers.chain(none).chain([&self.closures[..]])
        };
        let mut steps: Vec<Vec<f64>> = columns()
            .map(|column| {
                let mut step = vec![0.0; unknowns];
                let vectors = svd.left.iter().zip(&svd.right).zip(&svd.values);
                for ((u, v), value) in vectors {
                    add(&mut step, -dot(u, column) / value, v);
                }
                step
            })
            .collect();
        let conditions = redundant.iter();
        let mut conditions: Vec<Vec<f64>> = conditions
            .map(|u| columns().map(|column| dot(u, column)).collect())
            .collect();
        let sizes: Vec<f64> = columns().take(self.numbers).map(norm).collect();
        for condition in &mut conditions {
            cancel(condition, |j| sizes[j]);
        }

        // what targets become for these steps, a column for each
        let count = self.targets.len();
        let left = |step: &[f64], j: usize| -> Vec<f64> {
            let targets = self.targets.iter();
            targets
                .map(|target| target[unknowns + j] + dot(&target[..unknowns], step))
                .collect()
        };
        let mut lefts: Vec<Vec<f64>> = (steps.iter().enumerate())
            .map(|(j, step)| left(step, j))
            .collect();
        if count > 0 && !free.is_empty() {
            // directions in which the closures leave the configuration free meet targets as far as they can
            let along = free.iter().flat_map(|v| {
                let targets = self.targets.iter();
                targets.map(|target| dot(&target[..unknowns], v))
            });
            let along: Vec<f64> = along.collect();
            let mut svd = Svd::of(count, free.len(), &along);
            svd.values.truncate(count.min(free.len()));
            let met = crate::linear::rank(&svd.values);
            let damped = damping * svd.values.first().map_or(0.0, |value| value * value);
            for (step, left) in steps.iter_mut().zip(&mut lefts) {
                for i in 0..met {
                    let part = dot(&svd.left[i], left);
                    let value = svd.values[i];
                    let curvature = value * value + damped;
                    // of the row and that of the damping together
                    add(
                        left,
                        part * ((damped / curvature).sqrt() - 1.0),
                        &svd.left[i],
                    );
                    for (weight, v) in svd.right[i].iter().zip(free) {
                        add(step, -part * value / curvature * weight, v);
                    }
                }
            }
        }
        let sizes: Vec<f64> = steps[..self.numbers]
            .iter()
            .map(|of| 1.0 + norm(of))
            .collect();
        let targets = self.targets.iter().enumerate().map(|(i, target)| {
            let mut row: Vec<f64> = lefts.iter().map(|left| left[i]).collect();
            let size = norm(&target[..unknowns + self.numbers]);
            cancel(&mut row, |j| size * sizes[j]);
            row
        });
        let targets = targets.collect();
        (
            Eliminated(steps),
            Left {
                conditions,
                targets,
            },
        )
    }
}
