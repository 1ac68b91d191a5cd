//! Ways through the values of the targets of a square bundle.

use super::copies::{Copies, RowsWork};
use super::program::coordinates;
use super::sides::SideRows;
use crate::geometry::Quaternion;
use crate::number::C;
use crate::solve::Homotopy;

/// A straight way through the values of the targets.
pub struct PathForm<'c, 'b, 'm> {
    copies: &'c Copies<'b, 'm>,
    from: Vec<C>,
    /// Derivatives of the values along the way, and the values where it was last evaluated.
    rates: Vec<C>,
    values: Vec<C>,
    work: RowsWork,
    shared: SideRows<C>,
    /// The step that cancels the residual, and that along the way, of the last linearisation.
    steps: [Vec<C>; 2],
    largest: f64,
}

impl<'c, 'b, 'm> PathForm<'c, 'b, 'm> {
    /// The way between values of all targets.
    pub fn new(copies: &'c Copies<'b, 'm>, from: Vec<C>, to: Vec<C>) -> Self {
        let count = copies.bundle.numbers.len();
        PathForm {
            copies,
            rates: from.iter().zip(to).map(|(a, b)| b - a).collect(),
            values: from.clone(),
            from,
            work: RowsWork::default(),
            shared: SideRows {
                width: count + 2,
                entries: Vec::new(),
            },
            steps: [Vec::new(), Vec::new()],
            largest: f64::NAN,
        }
    }
}

impl PathForm<'_, '_, '_> {
    /// Both steps at a point; false if they do not exist.
    fn linear(&mut self, s: C, x: &[C]) -> bool {
        let copies = self.copies;
        let (unknowns, count) = (copies.unknowns, copies.bundle.numbers.len());
        let ends = self
            .values
            .iter_mut()
            .zip(self.from.iter().zip(&self.rates));
        ends.for_each(|(value, (from, rate))| *value = *from + s * *rate);
        copies.rows(x, &self.values, &self.rates, &mut self.work);
        let size = count + self.work.rows.len() * unknowns;
        let zero = C::new(0.0, 0.0);
        self.steps
            .iter_mut()
            .for_each(|step| step.resize(size, zero));
        self.largest = 0.0;
        self.shared.entries.clear();
        for rows in &mut self.work.rows {
            let sides = rows.entries.chunks_exact(rows.width);
            let largest = sides.map(|row| row[row.len() - 2].norm_sqr().sqrt());
            self.largest = largest.fold(self.largest, |a, b| if b <= a { a } else { b });
            if !rows.eliminate(unknowns) {
                return false;
            }
            let left = rows.entries.chunks_exact(rows.width).skip(unknowns);
            left.for_each(|row| self.shared.entries.extend(&row[unknowns..]));
        }
        if !self.shared.eliminate(count) {
            return false;
        }
        for (side, step) in self.steps.iter_mut().enumerate() {
            let (numbers, rest) = step.split_at_mut(count);
            self.shared.back(count, &[], count + side, numbers);
            let each = rest.chunks_exact_mut(unknowns.max(1)).zip(&self.work.rows);
            each.for_each(|(step, rows)| {
                rows.back(unknowns, numbers, unknowns + count + side, step)
            });
        }
        self.steps.iter().flatten().all(|x| x.is_finite())
    }

    /// A flat point moved by a step of the unknowns.
    fn moved(&self, x: &mut [C], step: &[C], factor: f64) {
        let count = self.copies.bundle.numbers.len();
        let (numbers, rest) = x.split_at_mut(count);
        for (x, step) in numbers.iter_mut().zip(step) {
            *x += *step * factor;
        }
        let steps = step[count..].chunks_exact(self.copies.unknowns.max(1));
        for (x, step) in rest.chunks_exact_mut(self.copies.width().max(1)).zip(steps) {
            let step: Vec<C> = step.iter().map(|x| *x * factor).collect();
            let mut at = self.copies.placed(x);
            self.copies.shape.displace(&mut at, &step);
            coordinates(&at, x);
        }
    }

    fn flow(&self, x: &[C], out: &mut [C]) -> bool {
        const SHORT: f64 = 1e-6;
        out.copy_from_slice(x);
        self.moved(out, &self.steps[1], SHORT);
        for (out, x) in out.iter_mut().zip(x) {
            *out = (*out - *x) / SHORT;
        }
        true
    }
}

impl Homotopy for PathForm<'_, '_, '_> {
    fn settle(&self, x: &mut [C]) {
        let (count, width) = (self.copies.bundle.numbers.len(), self.copies.width());
        let joints = self.copies.home.joints.len();
        for x in x[count..].chunks_exact_mut(width.max(1)) {
            for q in x[joints..].chunks_exact_mut(7) {
                let unit = Quaternion([q[0], q[1], q[2], q[3]]).normalised();
                q[..4].copy_from_slice(&unit.0);
            }
        }
    }

    fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        self.linear(s, x) && self.flow(x, out)
    }

    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        if !self.linear(s, x) {
            return f64::NAN;
        }
        let step = std::mem::take(&mut self.steps[0]);
        self.moved(x, &step, 1.0);
        let size = step.iter().map(|x| x.norm_sqr()).fold(0.0, f64::max).sqrt();
        self.steps[0] = step;
        size
    }

    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        match self.linear(s, x) || self.largest.is_finite() {
            true => self.largest,
            false => f64::NAN,
        }
    }

    fn velocity_again(&mut self, _: C, x: &[C], out: &mut [C]) -> bool {
        self.flow(x, out)
    }
}
