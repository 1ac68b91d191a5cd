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

mod copies;
mod elimination;
mod shared;
mod target;

use std::collections::BTreeMap;

pub use copies::{Along, Copies};
use elimination::{Eliminated, Linear};
use shared::Reduced;
pub use target::{Target, TargetError};

use crate::linear::{Factorable, RANK_TOLERANCE, norm};
use crate::mechanism::{Configuration, Dimensions, EVERY_ROW, Frame, Kept, Mechanism};
use crate::number::{Gradient, Number};
use crate::solve::{Equations, LeastSquares, Misfit};
use crate::system::{Held, System, Work};

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
    /// Rows of closures that are evaluated.
    kept: Vec<Kept>,
    rank: Option<usize>,
    cut: f64,
    /// Ranges of the shared numbers, where every configuration is kept closed.
    ranges: Option<Vec<(f64, f64)>>,
}

/// A point of a bundle: its shared numbers, and a configuration for each of its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Bundled {
    /// The values of the shared numbers, in m or rad or without unit.
    pub numbers: Vec<f64>,
    /// The configurations.
    pub configurations: Vec<Configuration<f64>>,
}

/// A bundle linearised at a point, every configuration eliminated.
#[derive(Clone, Debug)]
pub struct Arrow {
    eliminated: Vec<Eliminated>,
    reduced: Reduced,
}

/// The equations of one configuration with their evaluation over some directions of differentiation.
struct Lanes {
    system: System<Gradient>,
    work: Work<Gradient>,
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
            kept: vec![EVERY_ROW; mechanism.dimensions().closures.len()],
            rank: None,
            cut: RANK_TOLERANCE,
            ranges: None,
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
    fn linear(&self, at: &Bundled) -> Option<Vec<Linear>> {
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
            all.push(Linear {
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
            let exact: Vec<bool> = self.targets_of(k).iter().map(|of| of.exact).collect();
            linear.impose(&exact);
        }
        Some(all)
    }

    fn targets_of(&self, configuration: usize) -> Vec<&Target> {
        let of = self.targets.get(&configuration);
        of.into_iter().flatten().collect()
    }

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
        let system = self.equations::<f64>(numbers)?;
        let exact = self.targets.values().flatten().any(|target| target.exact);
        Some(Closer {
            bundle: self,
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
            ..self.clone()
        }
    }

    /// The sum of squares of the targets of one place at each of some configurations.
    pub fn squares_at(
        &self,
        place: usize,
        numbers: &[f64],
        configurations: &[Configuration<f64>],
    ) -> Vec<f64> {
        let each = configurations.iter();
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
    system: System<f64>,
    work: Work<f64>,
    lanes: Option<Lanes>,
}

impl Closer<'_, '_> {
    /// The configuration of one place that closes, and meets what it must, near another one, by Newton's method in steps of
    /// least length.
    pub fn closed(
        &mut self,
        place: usize,
        mut at: Configuration<f64>,
    ) -> Option<Configuration<f64>> {
        const ROUNDS: usize = 25;
        const LONGEST: f64 = 0.5;
        let exact = self.bundle.targets_of(place).into_iter();
        let exact: Vec<&Target> = exact.filter(|target| target.exact).collect();
        let unknowns = self.system.unknowns().len();
        let (mut before, mut slow) = (f64::INFINITY, 0);
        for _ in 0..ROUNDS {
            self.system.linearise(&at, &mut self.work);
            let mut linear = Linear {
                unknowns,
                numbers: 0,
                closures: self.system.residual_of(&self.work).to_vec(),
                by_unknowns: self.system.dense_jacobian(&self.work),
                by_numbers: Vec::new(),
                targets: Vec::new(),
            };
            if let Some(lanes) = self.lanes.as_mut().filter(|_| !exact.is_empty()) {
                linear.targets = self.bundle.rows_by_unknowns(&exact, lanes, &at)?;
                linear.impose(&vec![true; exact.len()]);
            }
            let open = linear
                .closures
                .iter()
                .fold(0.0f64, |most, x| most.max(x.abs()));
            let mut step = linear.alone(self.bundle.rank);
            let size = norm(&step);
            if !(open.is_finite() && size.is_finite()) {
                return None;
            }
            if open < CLOSED && (size < 1e-10 || size >= 0.5 * before) {
                return Some(at);
            }
            let factor = (LONGEST / size).min(1.0);
            step.iter_mut().for_each(|x| *x *= factor);
            self.system.displace(&mut at, &step);
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

/// A configuration is closed when no row exceeds this, in rad or characteristic lengths.
const CLOSED: f64 = 1e-12;

impl LeastSquares for Bundle<'_> {
    type Point = Bundled;
    type Model = Arrow;

    fn misfit(&self, at: &Bundled) -> Misfit {
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
        let mut reduced = Reduced::new(self.numbers.len(), self.cut);
        for (number, departure) in self.kept(&at.numbers).into_iter().enumerate() {
            reduced.near(number, departure);
        }
        let all = self.linear(at)?;
        let eliminated = all.iter().map(|linear| {
            let (eliminated, left) = linear.eliminated(self.rank);
            left.conditions
                .iter()
                .for_each(|row| reduced.condition(row));
            left.targets.iter().for_each(|row| reduced.square(row));
            eliminated
        });
        Some(Arrow {
            eliminated: eliminated.collect(),
            reduced,
        })
    }

    fn stepped(&self, at: &Bundled, arrow: &Arrow, damping: f64) -> (Bundled, f64) {
        let mut step = self.step_within(at, arrow, damping);
        let Some(system) = self.equations::<f64>(&at.numbers) else {
            return (at.clone(), 0.0);
        };
        let steps = |step: &[f64]| -> Vec<Vec<f64>> {
            let eliminated = arrow.eliminated.iter();
            eliminated.map(|of| of.step(step)).collect()
        };
        let mut moves = steps(&step);
        let largest = |all: &mut dyn Iterator<Item = &f64>| all.fold(0.0f64, |m, x| m.max(x.abs()));
        let mut size = largest(&mut step.iter().chain(moves.iter().flatten()));
        if self.ranges.is_some() {
            // what goes further than this closes elsewhere
            const FURTHEST: f64 = 0.5;
            let moved = largest(&mut moves.iter().flatten());
            if moved > FURTHEST {
                let factor = FURTHEST / moved;
                let all = step.iter_mut().chain(moves.iter_mut().flatten());
                all.for_each(|x| *x *= factor);
                size *= factor;
            }
        }
        let moved = at.numbers.iter().zip(&self.sizes).zip(&step);
        let mut numbers: Vec<f64> = moved.map(|((x, size), step)| x + size * step).collect();
        for (x, (low, high)) in numbers.iter_mut().zip(self.ranges.iter().flatten()) {
            *x = x.clamp(*low, *high);
        }
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
    fn step_within(&self, at: &Bundled, arrow: &Arrow, damping: f64) -> Vec<f64> {
        let mut reduced = arrow.reduced.clone();
        loop {
            let step = reduced.step(damping);
            let ranges = self.ranges.iter().flatten().enumerate();
            let leaving: Vec<usize> = ranges
                .filter(|(i, (low, high))| {
                    let x = at.numbers[*i];
                    x <= *low && step[*i] < 0.0 || x >= *high && step[*i] > 0.0
                })
                .map(|(i, _)| i)
                .collect();
            if leaving.is_empty() {
                return step;
            }
            leaving.into_iter().for_each(|i| reduced.without(i));
        }
    }

    /// Distances of the shared numbers from the values near which they stay, in their units.
    fn kept(&self, numbers: &[f64]) -> Vec<f64> {
        let near = self.near.as_ref();
        near.map_or_else(Vec::new, |near| self.departures(numbers, near))
    }

    /// The differences of shared numbers from others, in their units.
    pub fn departures(&self, numbers: &[f64], from: &[f64]) -> Vec<f64> {
        let pairs = numbers.iter().zip(from).zip(&self.sizes);
        pairs.map(|((x, from), size)| (x - from) / size).collect()
    }
}

impl Arrow {
    /// Number of independent conditions of the closures on the shared numbers.
    pub fn conditions(&self) -> usize {
        self.reduced.conditions()
    }

    /// Number of directions of the shared numbers that neither closures nor targets determine.
    pub fn undetermined(&self) -> usize {
        self.reduced.undetermined()
    }

    /// For each shared number the root of the sum of squares of the changes of all weighted targets, for a change of it by its
    /// unit with every configuration closed again.
    pub fn sensitivities(&self) -> Vec<f64> {
        self.reduced.sensitivities()
    }

    /// The conditions that the closures leave for a step of the shared numbers in their units, one row each: coefficients, and
    /// what is left now.
    pub fn rows(&self) -> Vec<Vec<f64>> {
        self.reduced.rows()
    }
}
