//! Configurations that share numbers and meet as many targets as there are unknowns: a square system over complex numbers.
//!
//! Unknowns are the shared numbers p, in their units, and the coordinates xₖ of each configuration; equations the closures
//! r(xₖ, p) = 0 and the targets q(xₖ, p) − v = 0, whose values v are the parameters of the family. Each configuration is eliminated
//! alone, with row exchanges; what is left of all is a square system of the shared numbers, so that the cost is linear in the
//! number of configurations.

use std::f64::consts::TAU;

use super::program::{Program, configuration, coordinates};
use super::sides::SideRows;
use super::{Bundle, Bundled};
use crate::mechanism::Configuration;
use crate::number::tolerance::SUMMED;
use crate::number::{C, Number};
use crate::solve::Equations;
use crate::system::System;

/// One configuration.
#[derive(Clone, Debug)]
struct Copy {
    program: Program,
    targets: Vec<Aim>,
}

/// A target of a configuration.
#[derive(Clone, Debug)]
struct Aim {
    /// Its place among the values.
    place: usize,
    weight: f64,
    angle: bool,
    /// True if it means the same after a turn.
    turns: bool,
}

/// The square system of a bundle.
#[derive(Clone, Debug)]
pub struct Copies<'b, 'm> {
    pub(super) bundle: &'b Bundle<'m>,
    places: Vec<Copy>,
    /// The values that the bundle asks for.
    values: Vec<f64>,
    pub(super) home: Configuration<f64>,
    /// The equations for the numbers of the file, by which configurations are moved.
    pub(super) shape: System<C>,
    /// Unknowns and rows of the closures of one configuration.
    pub(super) unknowns: usize,
    closures: usize,
}

impl<'b, 'm> Copies<'b, 'm> {
    /// The square system of so many configurations; `None` if it is not square.
    pub fn new(bundle: &'b Bundle<'m>, configurations: usize) -> Option<Self> {
        let mut values = Vec::new();
        let mut places = Vec::new();
        for k in 0..configurations {
            let targets = bundle.targets_of(k);
            let program = Program::new(bundle, &targets)?;
            let aims = targets.into_iter().map(|target| {
                values.push(target.value);
                Aim {
                    place: values.len() - 1,
                    weight: target.weight,
                    angle: target.quantity.unit.is_angle(),
                    turns: target.turns(bundle.mechanism),
                }
            });
            let targets = aims.collect();
            places.push(Copy { program, targets });
        }
        let numbers: Vec<C> = bundle.file().into_iter().map(C::from_f64).collect();
        let shape = bundle.equations(&numbers)?;
        let copies = Copies {
            bundle,
            places,
            values,
            home: bundle.mechanism.home(),
            unknowns: shape.unknowns().len(),
            closures: shape.rows(),
            shape,
        };
        let enough =
            (copies.places.iter()).all(|of| copies.closures + of.targets.len() >= copies.unknowns);
        (enough && bundle.surplus(configurations) == Some(0)).then_some(copies)
    }

    /// The values that the targets have.
    pub fn values(&self) -> Vec<C> {
        self.values.iter().map(|x| C::from_f64(*x)).collect()
    }

    /// For each value true if it is an angle.
    pub fn angles(&self) -> Vec<bool> {
        let aims = self.places.iter().flat_map(|of| &of.targets);
        aims.map(|aim| aim.angle).collect()
    }

    /// Coordinates of one configuration in a flat point.
    pub(super) fn width(&self) -> usize {
        self.home.joints.len() + 7 * self.home.platforms.len()
    }

    /// Number of coordinates of a flat point: the numbers in their units, then all configurations.
    pub fn count(&self) -> usize {
        self.bundle.numbers.len() + self.places.len() * self.width()
    }

    /// The configuration of one place in a flat point.
    pub(super) fn placed(&self, x: &[C]) -> Configuration<C> {
        configuration(&self.home, x)
    }

    /// The flat point of numbers and configurations.
    pub fn flat(&self, numbers: &[C], configurations: &[Configuration<C>]) -> Vec<C> {
        let mut x = vec![C::new(0.0, 0.0); self.count()];
        for ((x, number), size) in x.iter_mut().zip(numbers).zip(&self.bundle.sizes) {
            *x = *number / *size;
        }
        let rest = &mut x[numbers.len()..];
        for (x, at) in rest.chunks_exact_mut(self.width()).zip(configurations) {
            coordinates(at, x);
        }
        x
    }

    /// The numbers of a flat point.
    pub fn numbers(&self, x: &[C]) -> Vec<C> {
        let numbers = x.iter().zip(&self.bundle.sizes);
        numbers.map(|(x, size)| *x * *size).collect()
    }

    /// The point without imaginary parts.
    pub fn real(&self, x: &[C]) -> Bundled {
        let rest = &x[self.bundle.numbers.len()..];
        let places = rest.chunks_exact(self.width().max(1));
        Bundled {
            numbers: self.numbers(x).iter().map(|x| x.re).collect(),
            configurations: places.map(|x| self.placed(x).map(|x| x.re)).collect(),
        }
    }

    /// A configuration that closes for complex numbers near another one, by Newton's method in steps of least length.
    pub fn closed(&self, numbers: &[C], mut at: Configuration<C>) -> Option<Configuration<C>> {
        const ROUNDS: usize = 40;
        let system = self.bundle.equations(numbers)?;
        let mut work = system.work();
        for _ in 0..ROUNDS {
            let size = system.linearise(&at, &mut work);
            if size.largest < SUMMED {
                return Some(at);
            }
            system.factorise(0.0, &mut work);
            let long = system.step(&mut work);
            if !long.is_finite() {
                return None;
            }
            let factor = (0.5 / long).min(1.0);
            let step: Vec<C> = system
                .step_mut(&mut work)
                .iter()
                .map(|x| *x * factor)
                .collect();
            system.displace(&mut at, &step);
        }
        None
    }

    /// The inputs of the program of one place.
    fn inputs(&self, x: &[C], place: usize, inputs: &mut Vec<C>) {
        let (count, width) = (self.bundle.numbers.len(), self.width());
        inputs.clear();
        inputs.extend(&x[..count]);
        inputs.extend(&x[count + place * width..][..width]);
    }

    /// The values that all targets have at a flat point.
    pub fn values_at(&self, x: &[C]) -> Option<Vec<C>> {
        let (mut inputs, mut storage, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (k, place) in self.places.iter().enumerate() {
            self.inputs(x, k, &mut inputs);
            let rows = place.program.rows(&inputs, &mut storage);
            values.extend(rows.skip(self.closures).filter_map(|mut row| row.next()));
        }
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    /// Rows of all configurations at a flat point: derivatives by the unknowns of each, by the numbers, and the two sides.
    pub(super) fn rows(&self, x: &[C], values: &[C], rates: &[C], work: &mut RowsWork) {
        let zero = C::new(0.0, 0.0);
        let width = self.unknowns + self.bundle.numbers.len() + 2;
        let empty = || SideRows {
            width,
            entries: Vec::new(),
        };
        work.rows.resize_with(self.places.len(), empty);
        for (k, (place, rows)) in self.places.iter().zip(&mut work.rows).enumerate() {
            self.inputs(x, k, &mut work.inputs);
            let entries = &mut rows.entries;
            entries.clear();
            let all = place.program.rows(&work.inputs, &mut work.values);
            for (i, mut row) in all.enumerate() {
                let value = row.next().unwrap_or(zero);
                match i.checked_sub(self.closures).map(|i| &place.targets[i]) {
                    None => {
                        entries.extend(row);
                        entries.extend([-value, zero]);
                    }
                    Some(aim) => {
                        let mut left = value - values[aim.place];
                        if aim.turns {
                            left -= TAU * (left.re / TAU).round();
                        }
                        entries.extend(row.map(|x| x * aim.weight));
                        entries.extend([-left * aim.weight, rates[aim.place] * aim.weight]);
                    }
                }
            }
        }
    }
}

/// Storage for [`Copies::rows`].
#[derive(Clone, Debug, Default)]
pub(super) struct RowsWork {
    inputs: Vec<C>,
    values: Vec<C>,
    pub rows: Vec<SideRows<C>>,
}
