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
pub(super) struct BundlePrograms {
    places: Vec<ConfigurationPrograms>,
    /// The equations for the numbers of the file, by which configurations are moved.
    pub shape: System<f64>,
}

/// The programs of one configuration.
#[derive(Clone, Debug)]
struct ConfigurationPrograms {
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
                Some(ConfigurationPrograms {
                    closing: all.part((0..rows).chain(met), unknowns),
                    values: all.part(0..rows + exact.len(), 0),
                    all,
                })
            };
            let places = (0..configurations).map(place).collect::<Option<_>>()?;
            Some(Arc::new(BundlePrograms { places, shape }))
        });
        self
    }

    /// Runs a program of one configuration.
    fn run(
        &self,
        program: &Program,
        numbers: &[f64],
        at: &Configuration<f64>,
        storage: &mut Storage,
    ) {
        let count = self.numbers.len();
        storage.inputs.clear();
        storage.inputs.extend(self.in_units(numbers));
        let size = count + at.joints.len() + 7 * at.platforms.len();
        storage.inputs.resize(size, 0.0);
        coordinates(at, &mut storage.inputs[count..]);
        program.run(&storage.inputs, &mut storage.values);
    }

    /// Closures of one configuration, and what it must meet as further ones, linearised by its program; with targets and derivatives
    /// by the shared numbers unless it is only closed.
    pub(super) fn linear_by(
        &self,
        written: &BundlePrograms,
        numbers: &[f64],
        (k, at): (usize, &Configuration<f64>),
        closing: bool,
        storage: &mut Storage,
    ) -> Blocks {
        let place = &written.places[k];
        let (program, count) = match closing {
            true => (&place.closing, 0),
            false => (&place.all, self.numbers.len()),
        };
        self.run(program, numbers, at, storage);
        let (rows, unknowns) = (written.shape.rows(), written.shape.unknowns().len());
        let width = 1 + unknowns + count;
        let entry = |row: usize, target: Option<&Target>, i: usize| {
            let x = program.value(&storage.values, row * width + i);
            match target {
                None => x,
                Some(target) if i == 0 => target.rest(self.mechanism, x),
                Some(target) => x * target.weight,
            }
        };
        let targets = self.targets.get(&k).into_iter().flatten();
        let targets = (rows..).zip(targets.filter(|of| of.exact || !closing));
        let met = targets.clone().filter(|(_, of)| of.exact);
        let met = met.map(|(row, of)| (row, Some(of)));
        let closures = (0..rows).map(|row| (row, None)).chain(met);
        let columns = |columns: Range<usize>| {
            let column = |i: usize| closures.clone().map(move |(row, of)| entry(row, of, i));
            columns.flat_map(column).collect()
        };
        let left = targets.filter(|(_, of)| !of.exact).map(|(row, of)| {
            let slopes = (1..width).chain([0]);
            slopes.map(|i| entry(row, Some(of), i)).collect()
        });
        Blocks {
            unknowns,
            numbers: count,
            closures: columns(0..1),
            by_unknowns: columns(1..1 + unknowns),
            by_numbers: columns(1 + unknowns..width),
            targets: left.collect(),
        }
    }

    /// The sums of squares of one configuration.
    pub(super) fn misfit_of(
        &self,
        written: &BundlePrograms,
        numbers: &[f64],
        (k, at): (usize, &Configuration<f64>),
        storage: &mut Storage,
    ) -> Misfit {
        let (program, rows) = (&written.places[k].values, written.shape.rows());
        self.run(program, numbers, at, storage);
        let value = |row: usize| program.value(&storage.values, row);
        let mut misfit = Misfit {
            equations: (0..rows).map(value).fold(0.0, |sum, x| sum + x * x),
            squares: 0.0,
        };
        let targets = self.targets.get(&k).into_iter().flatten();
        for (row, target) in (rows..).zip(targets) {
            let left = target.rest(self.mechanism, value(row));
            match target.exact {
                true => misfit.equations += left * left,
                false => misfit.squares += left * left,
            }
        }
        misfit
    }

    /// The sums of squares at a point.
    pub(super) fn misfit_by(&self, written: &BundlePrograms, at: &Bundled) -> Misfit {
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
