//! Configurations that share numbers and meet as many targets as there are unknowns: a square system over complex numbers.
//!
//! Unknowns are the shared numbers p, in their units, and the coordinates xₖ of each configuration; equations the closures
//! r(xₖ, p) = 0 and the targets q(xₖ, p) − v = 0, whose values v are the parameters of the family. Each configuration is eliminated
//! alone, with row exchanges; what is left of all is a square system of the shared numbers, so that the cost is linear in the
//! number of configurations.

use super::sides::Rows;
use super::{Bundle, Bundled, Target};
use crate::geometry::Quaternion;
use crate::mechanism::Configuration;
use crate::number::{Complex, Gradient, Number};
use crate::solve::Equations;
use crate::system::System;

type C = Complex<f64>;
type G = Gradient<C>;

/// The square system of a bundle.
#[derive(Clone, Debug)]
pub struct Copies<'b, 'm> {
    pub(super) bundle: &'b Bundle<'m>,
    /// Targets of each configuration with the place of each among the values.
    targets: Vec<Vec<(usize, Target)>>,
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
        let targets: Vec<Vec<(usize, Target)>> = (0..configurations)
            .map(|k| {
                let targets = bundle.targets.get(&k).into_iter().flatten();
                let placed = targets.map(|target| {
                    values.push(target.value);
                    (values.len() - 1, target.clone())
                });
                placed.collect()
            })
            .collect();
        let numbers: Vec<C> = bundle.file().into_iter().map(C::from_f64).collect();
        let shape = bundle.equations(&numbers)?;
        let copies = Copies {
            bundle,
            targets,
            values,
            home: bundle.mechanism.home(),
            unknowns: shape.unknowns().len(),
            closures: shape.rows(),
            shape,
        };
        let enough =
            (copies.targets.iter()).all(|of| copies.closures + of.len() >= copies.unknowns);
        let rows = configurations * copies.closures + copies.values.len();
        let square = rows == configurations * copies.unknowns + bundle.numbers.len();
        (square && enough).then_some(copies)
    }

    /// The values that the targets have.
    pub fn values(&self) -> Vec<C> {
        self.values.iter().map(|x| C::from_f64(*x)).collect()
    }

    /// For each value true if it is an angle.
    pub fn angles(&self) -> Vec<bool> {
        let targets = self.targets.iter().flatten();
        let unit = |(_, target): &(usize, Target)| target.quantity.unit.is_angle();
        targets.map(unit).collect()
    }

    /// Coordinates of one configuration in a flat point.
    pub(super) fn width(&self) -> usize {
        self.home.joints.len() + 7 * self.home.platforms.len()
    }

    /// Number of coordinates of a flat point: the numbers in their units, then all configurations.
    pub fn count(&self) -> usize {
        self.bundle.numbers.len() + self.targets.len() * self.width()
    }

    pub(super) fn flat_into(at: &Configuration<C>, x: &mut [C]) {
        let joints = at.joints.len();
        x[..joints].copy_from_slice(&at.joints);
        for (x, of) in x[joints..].chunks_exact_mut(7).zip(&at.platforms) {
            x[..4].copy_from_slice(&of.orientation.0);
            x[4..].copy_from_slice(&of.position.0);
        }
    }

    pub(super) fn placed(&self, x: &[C]) -> Configuration<C> {
        let mut at = self.home.map(C::from_f64);
        let joints = at.joints.len();
        at.joints.copy_from_slice(&x[..joints]);
        for (x, of) in x[joints..].chunks_exact(7).zip(&mut at.platforms) {
            of.orientation = Quaternion([x[0], x[1], x[2], x[3]]);
            of.position.0.copy_from_slice(&x[4..]);
        }
        at
    }

    /// The flat point of numbers and configurations.
    pub fn flat(&self, numbers: &[C], configurations: &[Configuration<C>]) -> Vec<C> {
        let mut x = vec![C::new(0.0, 0.0); self.count()];
        for ((x, number), size) in x.iter_mut().zip(numbers).zip(&self.bundle.sizes) {
            *x = *number / *size;
        }
        let rest = &mut x[numbers.len()..];
        for (x, at) in rest.chunks_exact_mut(self.width()).zip(configurations) {
            Self::flat_into(at, x);
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
            if size.largest < 1e-13 {
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

    /// The values that all targets have at a flat point.
    pub fn values_at(&self, x: &[C]) -> Option<Vec<C>> {
        let numbers = self.numbers(x);
        let (parameters, _) = self.bundle.dimensions(&numbers)?;
        let system = self.bundle.equations(&numbers)?;
        let mut work = system.work();
        let mut values = Vec::new();
        let rest = &x[numbers.len()..];
        for (targets, x) in self
            .targets
            .iter()
            .zip(rest.chunks_exact(self.width().max(1)))
        {
            let at = self.placed(x);
            system.residual(&at, &mut work);
            for (_, target) in targets {
                let evaluated = (&system, &work);
                let of = (self.bundle.mechanism, evaluated, &parameters[..]);
                values.push(target.quantity(of.0, of.1, of.2, &at)?);
            }
        }
        Some(values)
    }

    /// Rows of all configurations at a flat point: derivatives by the unknowns of each, by the numbers, and the two sides.
    pub(super) fn rows(&self, x: &[C], values: &[C], rates: &[C]) -> Option<Vec<Rows>> {
        let numbers = self.numbers(x);
        let (count, unknowns) = (numbers.len(), self.unknowns);
        let width = unknowns + count + 2;
        let rest = &x[count..];
        let places: Vec<Configuration<C>> = (rest.chunks_exact(self.width().max(1)))
            .map(|x| self.placed(x))
            .collect();
        let zero = C::new(0.0, 0.0);
        let mut all: Vec<Rows> = (self.targets.iter())
            .map(|targets| Rows {
                width,
                entries: vec![zero; width * (self.closures + targets.len())],
            })
            .collect();
        let directions = count + unknowns;
        for from in (0..directions.max(1)).step_by(Gradient::LANES) {
            let lane = |i: usize, x: C, size: f64| match i.checked_sub(from) {
                Some(lane) if lane < Gradient::LANES => {
                    G::variable(C::new(0.0, 0.0), lane).scale(size) + G::constant(x)
                }
                _ => G::constant(x),
            };
            let sizes = self.bundle.sizes.iter();
            let given = numbers.iter().zip(sizes).enumerate();
            let given: Vec<G> = given.map(|(i, (x, size))| lane(i, *x, *size)).collect();
            let (parameters, dimensions) = self.bundle.dimensions(&given)?;
            let held = self.bundle.held.map(G::from_f64);
            let (kept, frames) = (&self.bundle.kept, &self.bundle.frames);
            let system = System::keeping(&dimensions, &held, kept, frames);
            let mut work = system.work();
            let step: Vec<G> = (0..unknowns).map(|i| lane(count + i, zero, 1.0)).collect();
            let moves = from + Gradient::LANES > count;
            for ((targets, at), rows) in self.targets.iter().zip(&places).zip(&mut all) {
                let mut at = at.map(G::constant);
                if moves {
                    system.displace(&mut at, &step);
                }
                system.residual(&at, &mut work);
                let mut put = |row: usize, value: G, rate: C| {
                    let row = &mut rows.entries[row * width..(row + 1) * width];
                    for (lane, slope) in value.slopes.iter().enumerate() {
                        let i = from + lane;
                        match i.checked_sub(count) {
                            None => row[unknowns + i] = *slope,
                            Some(i) if i < unknowns => row[i] = *slope,
                            Some(_) => {}
                        }
                    }
                    row[width - 2] = -value.value;
                    row[width - 1] = -rate;
                };
                let residual = system.residual_of(&work);
                residual
                    .iter()
                    .enumerate()
                    .for_each(|(i, value)| put(i, *value, zero));
                for (i, (place, target)) in targets.iter().enumerate() {
                    let (mechanism, value) = (self.bundle.mechanism, values[*place]);
                    let value = G::constant(value);
                    let evaluated = (&system, &work);
                    let left = target.left_of(mechanism, evaluated, &parameters, &at, value);
                    let rate = -rates[*place] * target.weight;
                    put(self.closures + i, left?, rate);
                }
            }
        }
        Some(all)
    }
}
