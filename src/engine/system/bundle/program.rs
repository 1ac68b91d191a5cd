//! Closures and targets of one configuration with their derivatives, written down once for all values of the shared numbers.

use super::{Bundle, Target};
use crate::algebra::{Operation, OperationIndex, Recorded, needed, record, run};
use crate::geometry::Quaternion;
use crate::mechanism::Configuration;
use crate::number::{Gradient, Number};
use crate::solve::Equations;
use crate::system::System;

type RecordedGradient = Gradient<Recorded>;

/// A straight-line program for the rows of one configuration. Its inputs are the shared numbers in their units, then the
/// [coordinates](coordinates) of the configuration.
#[derive(Clone, Debug)]
pub(super) struct Program {
    operations: Vec<Operation>,
    /// For each row its value, then its derivatives by the unknowns and by the shared numbers.
    places: Vec<OperationIndex>,
    directions: usize,
}

/// The coordinates of a configuration: its joints, then orientation and position of its platforms.
pub(super) fn coordinates<T: Number>(at: &Configuration<T>, x: &mut [T]) {
    let joints = at.joints.len();
    x[..joints].copy_from_slice(&at.joints);
    for (x, of) in x[joints..].chunks_exact_mut(7).zip(&at.platforms) {
        x[..4].copy_from_slice(&of.orientation.0);
        x[4..].copy_from_slice(&of.position.0);
    }
}

/// The configuration with these coordinates.
pub(super) fn configuration<T: Number>(home: &Configuration<f64>, x: &[T]) -> Configuration<T> {
    let mut at = home.map(T::from_f64);
    let joints = at.joints.len();
    at.joints.copy_from_slice(&x[..joints]);
    for (x, of) in x[joints..].chunks_exact(7).zip(&mut at.platforms) {
        of.orientation = Quaternion([x[0], x[1], x[2], x[3]]);
        of.position.0.copy_from_slice(&x[4..]);
    }
    at
}

impl Program {
    /// The program of a configuration with these targets; `None` if it holds for some values of the numbers only.
    pub(super) fn new(bundle: &Bundle, targets: &[&Target]) -> Option<Self> {
        let home = bundle.mechanism.home();
        let sizes = bundle.file().into_iter().zip(&bundle.sizes);
        let mut sample: Vec<f64> = sizes.map(|(x, size)| x / size).collect();
        let count = sample.len();
        sample.resize(count + home.joints.len() + 7 * home.platforms.len(), 0.0);
        coordinates(&home, &mut sample[count..]);
        let inputs = sample.len();
        let (places, operations) = record(sample, || {
            let inputs: Vec<Recorded> = (0..inputs).map(Recorded::input).collect();
            let places = written(bundle, targets, &inputs)?;
            Recorded::decisions().is_empty().then_some(places)
        });
        let (directions, mut places) = places?;
        Some(Program {
            operations: needed(&operations, &mut places),
            places,
            directions,
        })
    }

    /// Some of the rows with so many of the first derivatives of each: no more is evaluated than these need.
    pub(super) fn part(&self, rows: impl Iterator<Item = usize>, directions: usize) -> Self {
        let width = 1 + self.directions;
        let kept = rows.flat_map(|row| &self.places[row * width..][..=directions]);
        let mut places: Vec<OperationIndex> = kept.copied().collect();
        Program {
            operations: needed(&self.operations, &mut places),
            places,
            directions,
        }
    }

    /// Evaluates it at some inputs.
    pub(super) fn run<T: Number>(&self, inputs: &[T], values: &mut Vec<T>) {
        run(&self.operations, inputs, values);
    }

    /// A value of the last evaluation: of each row its own, then its derivatives.
    pub(super) fn value<T: Number>(&self, values: &[T], place: usize) -> T {
        values[self.places[place] as usize]
    }

    /// The rows at some inputs, one after another: each its value, then its derivatives by the unknowns and the numbers.
    pub(super) fn rows<'v, T: Number>(
        &self,
        inputs: &[T],
        values: &'v mut Vec<T>,
    ) -> impl Iterator<Item = impl Iterator<Item = T> + use<'v, '_, T>> + use<'v, '_, T> {
        run(&self.operations, inputs, values);
        let values = &*values;
        let rows = self.places.chunks_exact(1 + self.directions);
        rows.map(move |row| row.iter().map(move |place| values[*place as usize]))
    }
}

/// The number of directions, and the places of all rows.
fn written(
    bundle: &Bundle,
    targets: &[&Target],
    inputs: &[Recorded],
) -> Option<(usize, Vec<OperationIndex>)> {
    let home = bundle.mechanism.home();
    let count = bundle.numbers.len();
    let mut rows: Vec<Vec<Recorded>> = Vec::new();
    let mut from = 0;
    let directions = loop {
        let lane = |i: usize, x: Recorded, size: f64| match i.checked_sub(from) {
            Some(lane) if lane < Gradient::LANES => {
                RecordedGradient::variable(Recorded::zero(), lane).scale(size)
                    + RecordedGradient::constant(x)
            }
            _ => RecordedGradient::constant(x),
        };
        let sizes = inputs.iter().zip(&bundle.sizes).enumerate();
        let numbers: Vec<RecordedGradient> = sizes
            .map(|(i, (x, size))| lane(i, x.scale(*size), *size))
            .collect();
        let (parameters, dimensions) = bundle.dimensions(&numbers)?;
        let held = bundle.held.map(RecordedGradient::from_f64);
        let system = System::keeping(&dimensions, &held, &bundle.kept, &bundle.frames);
        let mut work = system.work();
        let unknowns = system.unknowns().len();
        let step: Vec<RecordedGradient> = (0..unknowns)
            .map(|i| lane(count + i, Recorded::zero(), 1.0))
            .collect();
        let mut at = configuration(&home, &inputs[count..]).map(RecordedGradient::constant);
        system.displace(&mut at, &step);
        system.residual(&at, &mut work);
        let mut all = system.residual_of(&work).to_vec();
        for target in targets {
            all.push(target.quantity(bundle.mechanism, (&system, &work), &parameters, &at)?);
        }
        let directions = count + unknowns;
        rows.resize(all.len(), Vec::new());
        for (row, value) in rows.iter_mut().zip(&all) {
            if from == 0 {
                row.push(value.value);
            }
            let width = Gradient::LANES.min(directions - from);
            row.extend(&value.slopes[..width]);
        }
        from += Gradient::LANES;
        if from >= directions {
            break directions;
        }
    };
    // the unknowns first
    for row in &mut rows {
        row[1..].rotate_left(count);
    }
    let places = rows.iter().flatten().map(|of| of.place());
    Some((directions, places.collect()))
}
