//! Bundles whose configurations are written down as programs: nothing is built again for other values of the shared numbers.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

use super::elimination::Blocks;
use super::program::{Program, coordinates};
use super::{Bundle, Bundled, Target};
use crate::mechanism::Configuration;
use crate::solve::Misfit;
use crate::system::{HeldPlatform, System};

/// The programs of all configurations.
#[derive(Clone, Debug)]
pub(super) struct Written {
    places: Vec<Place>,
    /// The equations for the numbers of the file, by which configurations are moved.
    pub shape: System<f64>,
}

/// The programs of one configuration.
#[derive(Clone, Debug)]
struct Place {
    /// Closures and targets with their derivatives by the unknowns and by the shared numbers.
    all: Program,
    /// Closures and what must be met with their derivatives by the unknowns.
    closing: Program,
    /// The values of closures and targets.
    values: Program,
}

/// Storage for programs.
#[derive(Clone, Debug, Default)]
pub(super) struct Storage {
    inputs: Vec<f64>,
    values: Vec<f64>,
}

impl Bundle<'_> {
    /// Writes down the closures and targets of so many configurations, where that can be done.
    #[must_use]
    pub fn written(mut self, configurations: usize) -> Self {
        // an angle of a platform that is held has a row of its own over reals
        let held = self
            .held
            .platforms
            .iter()
            .any(|of| *of != HeldPlatform::Free);
        let shape = self.equations::<f64>(&self.file()).filter(|_| !held);
        self.written = shape.and_then(|shape| {
            let (rows, unknowns) = (shape.rows(), shape.unknowns().len());
            let place = |k: usize| {
                let all = Program::new(&self, &self.targets_of(k))?;
                let exact = self.exact(k);
                let met = (0..exact.len()).filter(|i| exact[*i]).map(|i| rows + i);
                Some(Place {
                    closing: all.part((0..rows).chain(met), unknowns),
                    values: all.part(0..rows + exact.len(), 0),
                    all,
                })
            };
            let places = (0..configurations).map(place).collect::<Option<_>>()?;
            Some(Arc::new(Written { places, shape }))
        });
        self
    }

    /// The values of one configuration by a program.
    fn values<'s>(
        &self,
        program: &'s Program,
        numbers: &[f64],
        at: &Configuration<f64>,
        storage: &'s mut Storage,
    ) -> impl ExactSizeIterator<Item = f64> + Clone + 's {
        let count = self.numbers.len();
        storage.inputs.clear();
        storage.inputs.extend(self.in_units(numbers));
        let size = count + at.joints.len() + 7 * at.platforms.len();
        storage.inputs.resize(size, 0.0);
        coordinates(at, &mut storage.inputs[count..]);
        program.values(&storage.inputs, &mut storage.values)
    }

    /// Closures and targets of one configuration, linearised by its program.
    pub(super) fn linear_by(
        &self,
        written: &Written,
        numbers: &[f64],
        (k, at): (usize, &Configuration<f64>),
        storage: &mut Storage,
    ) -> Blocks {
        let (unknowns, count) = (written.shape.unknowns().len(), self.numbers.len());
        let (rows, width) = (written.shape.rows(), 1 + unknowns + count);
        let values = self.values(&written.places[k].all, numbers, at, storage);
        let targets = self.targets.get(&k).into_iter().flatten().enumerate();
        let targets = targets.map(|(i, target)| {
            let mut row = values.clone().skip((rows + i) * width);
            let left = target.rest(self.mechanism, row.next().unwrap_or(f64::NAN));
            let slopes = row.take(width - 1).map(|x| x * target.weight);
            slopes.chain([left]).collect()
        });
        let targets = targets.collect();
        let columns = |from: usize, to: usize| columns(values.clone(), rows, width, from..to);
        Blocks {
            unknowns,
            numbers: count,
            closures: columns(0, 1),
            by_unknowns: columns(1, 1 + unknowns),
            by_numbers: columns(1 + unknowns, width),
            targets,
        }
    }

    /// The closures of one configuration and what it must meet, linearised without the shared numbers.
    pub(super) fn closing_by(
        &self,
        written: &Written,
        numbers: &[f64],
        (k, at): (usize, &Configuration<f64>),
        storage: &mut Storage,
    ) -> Blocks {
        let (rows, unknowns) = (written.shape.rows(), written.shape.unknowns().len());
        let values = self.values(&written.places[k].closing, numbers, at, storage);
        let width = 1 + unknowns;
        let all = values.len() / width;
        let mut closures = columns(values.clone(), all, width, 0..1);
        let mut by_unknowns = columns(values, all, width, 1..width);
        let targets = self.targets.get(&k).into_iter().flatten();
        for (i, target) in (rows..).zip(targets.filter(|of| of.exact)) {
            closures[i] = target.rest(self.mechanism, closures[i]);
            let slopes = by_unknowns.iter_mut().skip(i).step_by(all);
            slopes.for_each(|x| *x *= target.weight);
        }
        Blocks {
            unknowns,
            numbers: 0,
            closures,
            by_unknowns,
            by_numbers: Vec::new(),
            targets: Vec::new(),
        }
    }

    /// The sums of squares of one configuration.
    pub(super) fn misfit_of(
        &self,
        written: &Written,
        numbers: &[f64],
        (k, at): (usize, &Configuration<f64>),
        storage: &mut Storage,
    ) -> Misfit {
        let mut values = self.values(&written.places[k].values, numbers, at, storage);
        let closures = values.by_ref().take(written.shape.rows());
        let mut misfit = Misfit {
            equations: closures.fold(0.0, |sum, x| sum + x * x),
            squares: 0.0,
        };
        for (value, target) in values.zip(self.targets.get(&k).into_iter().flatten()) {
            let left = target.rest(self.mechanism, value);
            match target.exact {
                true => misfit.equations += left * left,
                false => misfit.squares += left * left,
            }
        }
        misfit
    }

    /// The sums of squares at a point.
    pub(super) fn misfit_by(&self, written: &Written, at: &Bundled) -> Misfit {
        let mut misfit = Misfit {
            equations: 0.0,
            squares: self
                .kept(&at.numbers)
                .into_iter()
                .fold(0.0, |sum, x| sum + x * x),
        };
        let mut storage = Storage::default();
        for place in at.configurations.iter().enumerate() {
            let of = self.misfit_of(written, &at.numbers, place, &mut storage);
            misfit.equations += of.equations;
            misfit.squares += of.squares;
        }
        match (misfit.equations + misfit.squares).is_nan() {
            true => Misfit::NONE,
            false => misfit,
        }
    }

    /// Numbers in their units.
    fn in_units<'a>(&'a self, numbers: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        numbers.iter().zip(&self.sizes).map(|(x, size)| x / size)
    }
}

/// Columns of values that are given row by row.
fn columns(
    values: impl Iterator<Item = f64> + Clone,
    rows: usize,
    width: usize,
    columns: Range<usize>,
) -> Vec<f64> {
    let column = |i: usize| values.clone().skip(i).step_by(width).take(rows);
    columns.flat_map(column).collect()
}

impl Target {
    /// w(q − v), of the quantity q, without whole turns of an angle.
    fn rest(&self, mechanism: &crate::mechanism::Mechanism, quantity: f64) -> f64 {
        let left = quantity - self.value;
        let turns = match self.turns(mechanism) {
            true => (left / TAU).round(),
            false => 0.0,
        };
        (left - turns * TAU) * self.weight
    }
}
