//! Configurations of a bundle with its shared numbers as they are.

use std::collections::BTreeMap;

use nalgebra::DMatrix;

use super::elimination::Blocks;
use super::written::Storage;
use super::{Bundle, Bundled, Lanes, Target};
use crate::linear::norm;
use crate::mechanism::Configuration;
use crate::number::tolerance::{LONGEST_STEP, SOLVED};
use crate::solve::Equations;
use crate::system::{Held, System, SystemWork};

impl<'m> Bundle<'m> {
    /// The configurations that close, and meet what they must, near those of a point with the shared numbers as they are;
    /// `None` if one of them does not.
    pub fn closed(&self, at: Bundled) -> Option<Bundled> {
        let mut closer = self.closer(&at.numbers)?;
        let configurations = at.configurations.into_iter().enumerate();
        let closed = configurations.map(|(k, at)| closer.closed(k, at));
        Some(Bundled {
            configurations: closed.collect::<Option<_>>()?,
            numbers: at.numbers,
        })
    }

    /// Closes configurations with given shared numbers.
    pub fn closer(&self, numbers: &[f64]) -> Option<Closer<'_, '_>> {
        let built = match &self.written {
            Some(_) => None,
            None => Some(self.built(numbers)?),
        };
        Some(Closer {
            bundle: self,
            numbers: numbers.to_vec(),
            storage: Storage::default(),
            built,
        })
    }

    fn built(&self, numbers: &[f64]) -> Option<Built> {
        let system = self.equations::<f64>(numbers)?;
        let exact = self.targets.values().flatten().any(|target| target.exact);
        Some(Built {
            work: system.work(),
            system,
            lanes: match exact {
                true => Some(self.lanes(numbers, numbers.len())?),
                false => None,
            },
        })
    }

    /// The bundle without targets, and with something else held.
    pub fn alone(&self, held: Held<f64>) -> Self {
        Bundle {
            held,
            targets: BTreeMap::new(),
            written: None,
            ..self.clone()
        }
        .written(1)
    }

    /// The sum of squares of the targets of one place at each of some configurations.
    pub fn squares_at(
        &self,
        place: usize,
        numbers: &[f64],
        configurations: &[Configuration<f64>],
    ) -> Vec<f64> {
        let each = configurations.iter();
        if let Some(written) = &self.written {
            let mut storage = Storage::default();
            let squares = |at| {
                let of = self.misfit_of(written, numbers, (place, at), &mut storage);
                of.squares + of.equations
            };
            return each.map(squares).collect();
        }
        let (Some(system), Some((parameters, _))) =
            (self.equations::<f64>(numbers), self.dimensions(numbers))
        else {
            return each.map(|_| f64::INFINITY).collect();
        };
        let mut work = system.work();
        each.map(|at| {
            system.residual(at, &mut work);
            let targets = self.targets.get(&place).into_iter().flatten();
            let left = targets.map(|target| {
                let left = target.left(self.mechanism, (&system, &work), &parameters, at);
                left.map_or(f64::INFINITY, |x| x * x)
            });
            left.sum()
        })
        .collect()
    }

    /// For each target what is left of it, without its weight.
    pub fn deviations(&self, at: &Bundled) -> Option<Vec<(&Target, f64)>> {
        let system = self.equations::<f64>(&at.numbers)?;
        let (parameters, _) = self.dimensions(&at.numbers)?;
        let mut work = system.work();
        let mut all = Vec::new();
        for (k, at) in at.configurations.iter().enumerate() {
            system.residual(at, &mut work);
            for target in self.targets.get(&k).into_iter().flatten() {
                let left = target.left(self.mechanism, (&system, &work), &parameters, at)?;
                all.push((target, left / target.weight));
            }
        }
        Some(all)
    }
}

/// Closes configurations of a bundle with given shared numbers.
pub struct Closer<'b, 'm> {
    bundle: &'b Bundle<'m>,
    numbers: Vec<f64>,
    storage: Storage,
    built: Option<Built>,
}

/// The equations for the numbers, where they are not written down.
struct Built {
    system: System<f64>,
    work: SystemWork<f64>,
    lanes: Option<Lanes>,
}

impl Closer<'_, '_> {
    /// Equations of a configuration, linearised there without the shared numbers.
    fn linear(&mut self, place: usize, at: &Configuration<f64>) -> Option<Blocks> {
        let exact = self.bundle.exact(place);
        let mut linear = match (&self.bundle.written, &mut self.built) {
            (Some(written), _) => {
                let (bundle, storage) = (self.bundle, &mut self.storage);
                let at = (place, at);
                return Some(bundle.linear_by(written, &self.numbers, at, true, storage));
            }
            (None, None) => return None,
            (None, Some(built)) => {
                built.system.linearise(at, &mut built.work);
                let targets = match built.lanes.as_mut().filter(|_| exact.contains(&true)) {
                    Some(lanes) => {
                        let targets = self.bundle.targets_of(place);
                        self.bundle.rows_by_unknowns(&targets, lanes, at)?
                    }
                    None => Vec::new(),
                };
                Blocks {
                    unknowns: built.system.unknowns().len(),
                    numbers: 0,
                    closures: built.system.residual_of(&built.work).to_vec(),
                    by_unknowns: built.system.dense_jacobian(&built.work),
                    by_numbers: Vec::new(),
                    targets,
                }
            }
        };
        linear.stand_still();
        linear.impose(&exact);
        linear.targets.clear();
        Some(linear)
    }

    /// The sign of the determinant of what a configuration must meet by its unknowns, which changes where assemblies meet; `None` where
    /// there are not as many of both.
    pub fn side(&mut self, place: usize, at: &Configuration<f64>) -> Option<f64> {
        let linear = self.linear(place, at)?;
        let size = linear.unknowns;
        let square = linear.closures.len() == size;
        square.then(|| {
            DMatrix::from_vec(size, size, linear.by_unknowns)
                .determinant()
                .signum()
        })
    }

    fn displace(&self, at: &mut Configuration<f64>, step: &[f64]) {
        match (&self.bundle.written, &self.built) {
            (Some(written), _) => written.shape.displace(at, step),
            (None, Some(built)) => built.system.displace(at, step),
            (None, None) => {}
        }
    }

    /// The configuration of one place that closes, and meets what it must, near another one, by Newton's method in steps of
    /// least length.
    pub fn closed(
        &mut self,
        place: usize,
        mut at: Configuration<f64>,
    ) -> Option<Configuration<f64>> {
        const ROUNDS: usize = 25;
        let (mut before, mut slow) = (f64::INFINITY, 0);
        for _ in 0..ROUNDS {
            let linear = self.linear(place, &at)?;
            let open = linear
                .closures
                .iter()
                .fold(0.0f64, |most, x| most.max(x.abs()));
            let mut step = linear.alone(self.bundle.rank);
            let size = norm(&step);
            if !(open.is_finite() && size.is_finite()) {
                return None;
            }
            if open < SOLVED && (size < 1e-10 || size >= 0.5 * before) {
                return Some(at);
            }
            let factor = (LONGEST_STEP / size).min(1.0);
            step.iter_mut().for_each(|x| *x *= factor);
            self.displace(&mut at, &step);
            // steps that do not become smaller lead nowhere
            slow = if size > 0.7 * before { slow + 1 } else { 0 };
            if slow > 8 {
                return None;
            }
            before = size;
        }
        None
    }
}
