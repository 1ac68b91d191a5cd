//! All configurations of a bundle, linearised.

use super::elimination::Blocks;
use super::written::Storage;
use super::{Bundle, Bundled, Lanes};
use crate::mechanism::Configuration;
use crate::number::{Gradient, Number};
use crate::solve::Equations;

impl Bundle<'_> {
    /// ∂r/∂p of the closures at each of some configurations: dense and column-major, each column times the unit of its number.
    pub fn by_numbers(&self, at: &Bundled) -> Option<Vec<Vec<f64>>> {
        let mut columns = vec![Vec::new(); at.configurations.len()];
        self.over_numbers(at, |lanes, k, _, (_, width)| {
            let residual = lanes.system.residual_of(&lanes.work);
            for lane in 0..width {
                columns[k].extend(residual.iter().map(|row| row.slopes[lane]));
            }
            Some(())
        })?;
        Some(columns)
    }

    /// Evaluates every configuration over the shared numbers, so many of them at once.
    fn over_numbers(
        &self,
        at: &Bundled,
        mut visit: impl FnMut(&Lanes, usize, &Configuration<Gradient>, (usize, usize)) -> Option<()>,
    ) -> Option<()> {
        for from in (0..self.numbers.len()).step_by(Gradient::LANES) {
            let mut lanes = self.lanes(&at.numbers, from)?;
            let width = Gradient::LANES.min(self.numbers.len() - from);
            for (k, at) in at.configurations.iter().enumerate() {
                let at = at.map(Gradient::from_f64);
                lanes.system.residual(&at, &mut lanes.work);
                visit(&lanes, k, &at, (from, width))?;
            }
        }
        Some(())
    }

    /// Closures and targets of every configuration, linearised.
    pub(super) fn linear(&self, at: &Bundled) -> Option<Vec<Blocks>> {
        if let Some(written) = &self.written {
            let mut storage = Storage::default();
            let each = at.configurations.iter().enumerate();
            let each =
                each.map(|place| self.linear_by(written, &at.numbers, place, false, &mut storage));
            return Some(each.collect());
        }
        let system = self.equations::<f64>(&at.numbers)?;
        let mut work = system.work();
        let (unknowns, numbers) = (system.unknowns().len(), self.numbers.len());
        let mut lanes = self.lanes(&at.numbers, numbers)?;
        let mut all = Vec::new();
        for (k, at) in at.configurations.iter().enumerate() {
            system.linearise(at, &mut work);
            let mut targets = self.rows_by_unknowns(&self.targets_of(k), &mut lanes, at)?;
            for row in &mut targets {
                let left = row.pop().expect("what is left is at the end");
                row.resize(unknowns + numbers, 0.0);
                row.push(left);
            }
            all.push(Blocks {
                unknowns,
                numbers,
                closures: system.residual_of(&work).to_vec(),
                by_unknowns: system.dense_jacobian(&work),
                by_numbers: Vec::new(),
                targets,
            });
        }
        self.over_numbers(at, |lanes, k, at, (from, width)| {
            let residual = lanes.system.residual_of(&lanes.work);
            let linear = &mut all[k];
            for lane in 0..width {
                let column = residual.iter().map(|row| row.slopes[lane]);
                linear.by_numbers.extend(column);
            }
            for (target, row) in self.targets_of(k).iter().zip(&mut linear.targets) {
                let evaluated = (&lanes.system, &lanes.work);
                let left = target.left(self.mechanism, evaluated, &lanes.parameters, at)?;
                row[unknowns + from..][..width].copy_from_slice(&left.slopes[..width]);
            }
            Some(())
        })?;
        for (k, linear) in all.iter_mut().enumerate() {
            linear.impose(&self.exact(k));
        }
        Some(all)
    }

    /// For each target of a configuration true if it is an equation.
    pub(super) fn exact(&self, k: usize) -> Vec<bool> {
        self.targets_of(k).iter().map(|of| of.exact).collect()
    }
}
