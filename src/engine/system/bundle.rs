//! Configurations of one mechanism that share numbers of its file, as one least-squares problem.
//!
//! Unknowns are the coordinates xₖ of each configuration and the shared numbers p. The closures of every configuration hold,
//! r(xₖ, p) = 0. Beside them targets are met as nearly as possible, Σ w²(q(xₖ, p) − v)² with quantities q, and numbers stay
//! near given values, Σ ((p − p₀)/s)².
//!
//! The Jacobian is an arrow, Aₖ = ∂r/∂xₖ beside Bₖ = ∂r/∂p, as in the bundle adjustment of cameras and points (Triggs et
//! al. 2000). Each configuration is eliminated alone by the singular vectors of Aₖ = U Σ Vᵀ: xₖ = −A⁺(r + B p) + V₂ y. What
//! redundant closures leave for the shared numbers is U₂ᵀ(r + B p) = 0; of the targets what no y meets is left. The cost is
//! linear in the number of configurations. Columns of B come from the one kinematics over [`Gradient`]s.

mod along;
mod arrow;
mod closer;
mod copies;
mod elimination;
mod linear;
mod program;
mod shared;
mod sides;
mod target;
mod written;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use along::PathForm;
pub use arrow::Arrow;
pub use closer::Closer;
pub use copies::Copies;
use shared::Reduced;
pub(crate) use sides::SideRows;
pub use target::{Target, TargetError};

use crate::linear::{Factorable, RANK_TOLERANCE};
use crate::mechanism::{Configuration, Dimensions, EVERY_ROW, Frame, Kept, Mechanism};
use crate::number::tolerance::LONGEST_STEP;
use crate::number::{Gradient, Number};
use crate::solve::{Equations, LeastSquares, Misfit};
use crate::system::{Held, System, SystemWork};

/// Configurations of one mechanism that share some of its parameters.
#[derive(Clone, Debug)]
pub struct Bundle<'m> {
    mechanism: &'m Mechanism,
    held: Held<f64>,
    /// The rows of each closure that are asked for.
    kept: Vec<Kept>,
    /// Indices of the unknown ones among the independent parameters.
    numbers: Vec<usize>,
    /// The unit in which steps of each are measured.
    sizes: Vec<f64>,
    /// Values near which they stay, within about their sizes.
    near: Option<Vec<f64>>,
    /// Targets by configuration.
    targets: BTreeMap<usize, Vec<Target>>,
    frames: Vec<Frame>,
    rank: Option<usize>,
    cut: f64,
    /// Ranges of the shared numbers, where every configuration is kept closed.
    ranges: Option<Vec<(f64, f64)>>,
    written: Option<Arc<written::BundlePrograms>>,
}

/// A point of a bundle: its shared numbers, and a configuration for each of its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Bundled {
    /// The values of the shared numbers, in m or rad or without unit.
    pub numbers: Vec<f64>,
    /// The configurations.
    pub configurations: Vec<Configuration<f64>>,
}

/// The equations of one configuration with their evaluation over some directions of differentiation.
struct Lanes {
    system: System<Gradient>,
    work: SystemWork<Gradient>,
    parameters: Vec<Gradient>,
}

impl<'m> Bundle<'m> {
    /// The bundle in which these independent parameters, by their indices, are unknown, each with the unit in which its steps
    /// are measured. What is held keeps the value it has in each configuration.
    ///
    /// # Panics
    /// If a parameter is not independent ([`Mechanism::independent_parameters`]), or is given twice.
    pub fn new(mechanism: &'m Mechanism, held: Held<f64>, numbers: &[(usize, f64)]) -> Self {
        let independent = mechanism.independent_parameters();
        let place = |of: &usize| independent.iter().position(|i| i == of);
        let places: Vec<usize> = (numbers.iter())
            .map(|(of, _)| place(of).expect("the parameter is independent"))
            .collect();
        let twice = |(i, of): (usize, &usize)| places[..i].contains(of);
        assert!(!places.iter().enumerate().any(twice), "each is given once");
        Bundle {
            mechanism,
            held,
            kept: vec![EVERY_ROW; mechanism.closures().len()],
            numbers: places,
            sizes: numbers.iter().map(|(_, size)| *size).collect(),
            near: None,
            targets: BTreeMap::new(),
            frames: Vec::new(),
            rank: None,
            cut: RANK_TOLERANCE,
            ranges: None,
            written: None,
        }
    }

    /// Leaves out all closures but these.
    #[must_use]
    pub fn only(mut self, closures: &[usize]) -> Self {
        let of = |(i, kept): (usize, Kept)| kept.map(|row| row && closures.contains(&i));
        self.kept = self.kept.into_iter().enumerate().map(of).collect();
        self
    }

    /// Keeps the shared numbers within ranges, and every configuration closed on the way: a step after which one of them cannot
    /// be assembled is none.
    #[must_use]
    pub fn within(mut self, ranges: Vec<(f64, f64)>) -> Self {
        self.ranges = Some(ranges);
        self.kept = self.mechanism.rows_that_vary().to_vec();
        self
    }

    /// Keeps the shared numbers near values, each within about its unit: of what closes that which is nearest is sought.
    #[must_use]
    pub fn near(mut self, values: Vec<f64>) -> Self {
        self.near = Some(values);
        self
    }

    /// Adds a target.
    ///
    /// # Errors
    /// If it is a rate, a force or a figure, which a configuration alone does not have.
    pub fn target(mut self, target: Target) -> Result<Self, TargetError> {
        for frame in target.frames()? {
            if !self.frames.contains(&frame) {
                self.frames.push(frame);
            }
        }
        let of = self.targets.entry(target.configuration).or_default();
        of.push(target);
        Ok(self)
    }

    /// The bundle with these targets instead of its own.
    ///
    /// # Panics
    /// If one is a rate, a force or a figure.
    #[must_use]
    pub fn aimed(&self, targets: Vec<Target>) -> Self {
        let plain = Bundle {
            targets: BTreeMap::new(),
            frames: Vec::new(),
            written: None,
            ..self.clone()
        };
        let with = |bundle: Self, target| bundle.target(target).expect("a configuration has it");
        targets.into_iter().fold(plain, with)
    }

    /// Gives its targets other values, position by position.
    pub fn aim(&mut self, values: &[f64]) {
        let targets = self.targets.values_mut().flatten();
        targets
            .zip(values)
            .for_each(|(target, value)| target.value = *value);
    }

    /// Takes the closures of every configuration to have this rank, and conditions on the shared numbers that are smaller than
    /// a part of the largest to be none: for closures that are redundant only within the rounding of the numbers.
    #[must_use]
    pub fn redundant(mut self, rank: usize, cut: f64) -> Self {
        (self.rank, self.cut) = (Some(rank), cut);
        self
    }

    /// The values of the shared numbers in the file.
    pub fn file(&self) -> Vec<f64> {
        let independent = self.mechanism.independent_parameters();
        let value = |&place: &usize| self.mechanism.parameters()[independent[place]].value;
        self.numbers.iter().map(value).collect()
    }

    /// The values of all parameters, and the dimensions, for values of the shared numbers over any number; `None` if an
    /// expression has no value there. Lengths are measured as for the mechanism itself.
    pub fn dimensions<T: Number>(&self, numbers: &[T]) -> Option<(Vec<T>, Dimensions<T>)> {
        let independent = self.mechanism.independent_parameters();
        let of_file = |i: &usize| T::from_f64(self.mechanism.parameters()[*i].value);
        let mut values: Vec<T> = independent.iter().map(of_file).collect();
        for (&place, &value) in self.numbers.iter().zip(numbers) {
            values[place] = value;
        }
        let parameters = self.mechanism.parameters_from(&values).ok()?;
        let mut dimensions = self.mechanism.dimensions_over(&parameters).ok()?;
        let own = self.mechanism.dimensions();
        dimensions.characteristic_length = own.characteristic_length;
        dimensions.joint_scales.clone_from(&own.joint_scales);
        Some((parameters, dimensions))
    }

    /// The equations of one configuration for values of the shared numbers, over any number.
    pub fn equations<T: Factorable>(&self, numbers: &[T]) -> Option<System<T>> {
        let (_, dimensions) = self.dimensions(numbers)?;
        let held = self.held.map(|x| T::from_f64(x));
        Some(System::keeping(
            &dimensions,
            &held,
            &self.kept,
            &self.frames,
        ))
    }

    /// Number of closures and targets of so many configurations beyond that of unknowns; negative for fewer.
    pub fn surplus(&self, configurations: usize) -> Option<i64> {
        let system = self.equations::<f64>(&self.file())?;
        let targets: usize = self.targets.values().map(Vec::len).sum();
        let rows = configurations * system.rows() + targets;
        let unknowns = configurations * system.unknowns().len() + self.numbers.len();
        Some(rows as i64 - unknowns as i64)
    }

    /// The equations over the shared numbers from one on as directions of differentiation; from beyond the last on those of
    /// constants.
    fn lanes(&self, numbers: &[f64], from: usize) -> Option<Lanes> {
        let lane = |(i, &x): (usize, &f64)| match i.checked_sub(from) {
            Some(lane) if lane < Gradient::LANES => {
                Gradient::variable(0.0, lane).scale(self.sizes[i]) + Gradient::from_f64(x)
            }
            _ => Gradient::from_f64(x),
        };
        let numbers: Vec<Gradient> = numbers.iter().enumerate().map(lane).collect();
        let (parameters, dimensions) = self.dimensions(&numbers)?;
        let held = self.held.map(Gradient::from_f64);
        let system = System::keeping(&dimensions, &held, &self.kept, &self.frames);
        Some(Lanes {
            work: system.work(),
            system,
            parameters,
        })
    }

    fn targets_of(&self, configuration: usize) -> Vec<&Target> {
        let of = self.targets.get(&configuration);
        of.into_iter().flatten().collect()
    }
}

impl LeastSquares for Bundle<'_> {
    type Point = Bundled;
    type Model = Arrow;

    fn misfit(&self, at: &Bundled) -> Misfit {
        if let Some(written) = &self.written {
            return self.misfit_by(written, at);
        }
        let (Some(system), Some((parameters, _))) = (
            self.equations::<f64>(&at.numbers),
            self.dimensions(&at.numbers),
        ) else {
            return Misfit::NONE;
        };
        let mut work = system.work();
        let mut misfit = Misfit {
            equations: 0.0,
            squares: self.kept(&at.numbers).iter().map(|x| x * x).sum(),
        };
        for (k, at) in at.configurations.iter().enumerate() {
            misfit.equations += system.residual(at, &mut work).squares;
            for target in self.targets.get(&k).into_iter().flatten() {
                let left = target.left(self.mechanism, (&system, &work), &parameters, at);
                let square = left.map_or(f64::INFINITY, |x| x * x);
                match target.exact {
                    true => misfit.equations += square,
                    false => misfit.squares += square,
                }
            }
        }
        misfit
    }

    fn model(&self, at: &Bundled) -> Option<Arrow> {
        let mut near = Reduced::new(self.numbers.len(), self.cut);
        for (number, departure) in self.kept(&at.numbers).into_iter().enumerate() {
            near.near(number, departure);
        }
        Some(Arrow {
            blocks: self.linear(at)?,
            rank: self.rank,
            near,
        })
    }

    fn stepped(&self, at: &Bundled, arrow: &Arrow, damping: f64) -> (Bundled, f64) {
        let (eliminated, reduced) = arrow.eliminated(damping);
        let mut step = self.step_within(at, reduced, damping);
        let system = match &self.written {
            Some(written) => Some(written.shape.clone()),
            None => self.equations::<f64>(&at.numbers),
        };
        let Some(system) = system else {
            return (at.clone(), 0.0);
        };
        let steps =
            |step: &[f64]| -> Vec<Vec<f64>> { eliminated.iter().map(|of| of.step(step)).collect() };
        let mut moves = steps(&step);
        let largest = |all: &mut dyn Iterator<Item = &f64>| all.fold(0.0f64, |m, x| m.max(x.abs()));
        let mut size = largest(&mut step.iter().chain(moves.iter().flatten()));
        if self.ranges.is_some() {
            // what goes further closes elsewhere
            let moved = largest(&mut moves.iter().flatten());
            if moved > LONGEST_STEP {
                let factor = LONGEST_STEP / moved;
                let all = step.iter_mut().chain(moves.iter_mut().flatten());
                all.for_each(|x| *x *= factor);
                size *= factor;
            }
        }
        let numbers = self.stepped_numbers(&at.numbers, &step);
        let configurations = at.configurations.iter().zip(&moves);
        let configurations = configurations.map(|(at, step)| system.displaced(at, step));
        let moved = Bundled {
            configurations: configurations.collect(),
            numbers,
        };
        match self.ranges.is_some() {
            true => (self.closed(moved.clone()).unwrap_or(moved), size),
            false => (moved, size),
        }
    }
}

impl Bundle<'_> {
    /// The step of the shared numbers, in which those that would leave their ranges stand still.
    fn step_within(&self, at: &Bundled, mut reduced: Reduced, damping: f64) -> Vec<f64> {
        let mut still = vec![false; self.numbers.len()];
        loop {
            let mut step = reduced.step(damping);
            let ranges = self.ranges.iter().flatten().enumerate();
            let leaving: Vec<usize> = ranges
                .filter(|(i, (low, high))| {
                    let x = at.numbers[*i];
                    !still[*i] && (x <= *low && step[*i] < 0.0 || x >= *high && step[*i] > 0.0)
                })
                .map(|(i, _)| i)
                .collect();
            if leaving.is_empty() {
                // of what stands still rounding is left
                let parts = step.iter_mut().zip(&still).filter(|(_, still)| **still);
                parts.for_each(|(x, _)| *x = 0.0);
                return step;
            }
            for i in leaving {
                still[i] = true;
                reduced.without(i);
            }
        }
    }

    /// Distances of the shared numbers from the values near which they stay, in their units.
    fn kept(&self, numbers: &[f64]) -> Vec<f64> {
        let near = self.near.as_ref();
        near.map_or_else(Vec::new, |near| self.departures(numbers, near))
    }

    /// Shared numbers after a step in their units, kept within their ranges.
    pub fn stepped_numbers(&self, numbers: &[f64], step: &[f64]) -> Vec<f64> {
        let moved = numbers.iter().zip(&self.sizes).zip(step);
        let mut numbers: Vec<f64> = moved.map(|((x, size), step)| x + size * step).collect();
        for (x, (low, high)) in numbers.iter_mut().zip(self.ranges.iter().flatten()) {
            *x = x.clamp(*low, *high);
        }
        numbers
    }

    /// The differences of shared numbers from others, in their units.
    pub fn departures(&self, numbers: &[f64], from: &[f64]) -> Vec<f64> {
        let pairs = numbers.iter().zip(from).zip(&self.sizes);
        pairs.map(|((x, from), size)| (x - from) / size).collect()
    }
}
