//! Ways from a configuration to a rest position.

use std::cell::RefCell;

use super::NoRest;
use crate::linear::{Decomposition, dot, norm};
use crate::number::tolerance::{FIVE_POINTS, SAME, SUMMED};
use crate::solve::walk_down;
use crate::system::Dynamics;

/// Walks down the potential energy, or up for −1, to where the forces vanish.
pub(super) fn fall(dynamics: &mut Dynamics, sign: f64) -> Result<(), NoRest> {
    /// Choices of coordinates and of the length of the first step.
    const ROUNDS: usize = 40;
    for _ in 0..ROUNDS {
        let (forces, potential) = dynamics.at_rest()?;
        dynamics.stand();
        let units = dynamics.units();
        let slope = norm(&scaled(&forces, &units));
        if is_balanced(dynamics, &forces) {
            return Ok(());
        }
        if is_near_rest(dynamics, &forces) {
            return settle(dynamics);
        }
        let start = dynamics.values(dynamics.configuration());
        let start: Vec<f64> = start.iter().zip(&units).map(|(x, unit)| x / unit).collect();
        // the first step is as long as the gradient of the cost: 0.3 rad or characteristic lengths
        let size = 0.3 / slope;
        let shared = RefCell::new(&mut *dynamics);
        let here = |x: &[f64]| {
            let mut dynamics = shared.borrow_mut();
            let closed = dynamics.close(&scaled(x, &units));
            closed.then(|| dynamics.at_rest().ok()).flatten()
        };
        let cost = |x: &[f64]| match here(x) {
            Some((_, energy)) => sign * (energy - potential) * size,
            None => f64::INFINITY,
        };
        let gradient = |x: &[f64]| match here(x) {
            Some((forces, _)) => {
                let slope = forces.iter().zip(&units);
                slope
                    .map(|(force, unit)| -sign * force * unit * size)
                    .collect()
            }
            None => vec![f64::NAN; units.len()],
        };
        let lowest = walk_down(start.clone(), cost, gradient);
        let gone = lowest.iter().zip(&start).map(|(a, b)| (a - b).abs());
        let gone = gone.fold(0.0, f64::max);
        if !dynamics.close(&scaled(&lowest, &units)) || dynamics.at_rest().is_err() {
            return Err(NoRest::Endless);
        }
        dynamics.stand();
        if gone < 1e-10 {
            return settle(dynamics);
        }
        let rates = vec![0.0; units.len()];
        dynamics.choose(&rates)?;
    }
    Err(NoRest::Endless)
}

/// Newton's method for Q(q) = 0, with steps of at most 0.3 rad and characteristic lengths.
pub(super) fn settle(dynamics: &mut Dynamics) -> Result<(), NoRest> {
    const STEPS: usize = 60;
    for _ in 0..STEPS {
        let (forces, _) = dynamics.at_rest()?;
        dynamics.stand();
        if is_balanced(dynamics, &forces) {
            return Ok(());
        }
        let units = dynamics.units();
        let free = units.len();
        let hessian = hessian(dynamics)?;
        let mut step = Decomposition::of(free, free, &hessian).solve(&forces);
        let long = step.iter().zip(&units).map(|(x, unit)| (x / unit).abs());
        let long = long.fold(0.0, f64::max);
        if long > 0.3 {
            step.iter_mut().for_each(|x| *x *= 0.3 / long);
        }
        let values = dynamics.values(dynamics.configuration());
        let to: Vec<f64> = values.iter().zip(&step).map(|(a, b)| a + b).collect();
        if !dynamics.close(&to) || dynamics.at_rest().is_err() {
            return Err(NoRest::Endless);
        }
        dynamics.stand();
        if long < 1e-11 {
            // arrived; where the energy falls evenly no step leads anywhere, and more than rounding of the forces is left
            let left = norm(&scaled(&forces, &units));
            let rests = left <= 1e-6 * dynamics.size();
            return rests.then_some(()).ok_or(NoRest::Endless);
        }
        let still = vec![0.0; free];
        dynamics.choose(&still)?;
    }
    let (forces, _) = dynamics.at_rest()?;
    match is_near_rest(dynamics, &forces) {
        true => Ok(()),
        false => Err(NoRest::Endless),
    }
}

/// True if the forces left over are rounding of those that act.
fn is_balanced(dynamics: &Dynamics, forces: &[f64]) -> bool {
    norm(&scaled(forces, &dynamics.units())) <= SUMMED * dynamics.size()
}

/// True if the forces are so small that the rest position is within 1e-6 rad and characteristic lengths.
fn is_near_rest(dynamics: &mut Dynamics, forces: &[f64]) -> bool {
    let units = dynamics.units();
    let Ok(hessian) = hessian(dynamics) else {
        return false;
    };
    let step = Decomposition::of(units.len(), units.len(), &hessian).solve(forces);
    let met = (0..units.len()).map(|i| {
        let row = &hessian[i * units.len()..][..units.len()];
        (dot(row, &step) - forces[i]).abs() * units[i]
    });
    let size = norm(&scaled(forces, &units));
    let met = met.fold(0.0, f64::max) <= 1e-3 * size;
    met && step
        .iter()
        .zip(&units)
        .all(|(x, unit)| (x / unit).abs() < SAME)
}

/// −∂Q/∂q at the base, row by row and symmetric, by central differences of fourth order.
pub(super) fn hessian(dynamics: &mut Dynamics) -> Result<Vec<f64>, NoRest> {
    let units = dynamics.units();
    let free = units.len();
    let base = dynamics.values(dynamics.base());
    let mut columns = vec![0.0; free * free];
    for (i, unit) in units.iter().enumerate() {
        for (length, weight) in FIVE_POINTS {
            let mut to = base.clone();
            to[i] += length * unit;
            if !dynamics.close(&to) {
                return Err(NoRest::Endless);
            }
            let (forces, _) = dynamics.at_rest()?;
            for (row, force) in forces.iter().enumerate() {
                columns[row * free + i] -= weight * force / unit;
            }
        }
    }
    let entry = |i: usize, j: usize| 0.5 * (columns[i * free + j] + columns[j * free + i]);
    let hessian = (0..free * free)
        .map(|k| entry(k / free, k % free))
        .collect();
    dynamics
        .close(&base)
        .then_some(hessian)
        .ok_or(NoRest::Endless)
}

fn scaled(values: &[f64], units: &[f64]) -> Vec<f64> {
    values.iter().zip(units).map(|(x, unit)| x * unit).collect()
}
