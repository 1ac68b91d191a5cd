//! The closest approach of a mechanism that cannot be assembled.

use std::cell::RefCell;

use super::{System, SystemWork};
use crate::linear::CURVED;
use crate::mechanism::Configuration;
use crate::number::tolerance::{DIFFERENCE, NOT_PRINTED};
use crate::solve::{Equations, walk_down};

/// The weight of held coordinates, and how exactly they are kept in the end (rad, characteristic lengths).
const WEIGHT: f64 = 10.0;

/// The closest approach to assembly near a configuration, with held coordinates kept, and true if it is a
/// minimum: the gradient of the squared gaps vanishes and their curvature is nowhere negative.
pub fn approach(system: &System<f64>, start: &Configuration<f64>) -> (Configuration<f64>, bool) {
    let unknowns = system.unknowns().len();
    if unknowns == 0 {
        return (start.clone(), true);
    }
    let work = RefCell::new(system.work());
    let held = system.hold_rows();
    let mut multipliers = vec![0.0; held.len()];
    let mut at = start.clone();
    for _ in 0..50 {
        at = walk(system, at, &multipliers, &work);
        let mut work = work.borrow_mut();
        system.residual(&at, &mut work);
        let left = &system.residual_of(&work)[held.clone()];
        if left.iter().all(|row| row.abs() <= NOT_PRINTED) {
            break;
        }
        for (multiplier, row) in multipliers.iter_mut().zip(left) {
            *multiplier += WEIGHT * row;
        }
    }
    let slope =
        |at: &Configuration<f64>| system.slope(at, WEIGHT, &multipliers, &mut work.borrow_mut());
    let (gradient, squares) = slope(&at);
    let steepest = gradient.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
    // beside the gaps
    if steepest > CURVED * squares.sqrt() {
        return (at, false);
    }
    let step = DIFFERENCE;
    let mut curvature = nalgebra::DMatrix::zeros(unknowns, unknowns);
    for j in 0..unknowns {
        let gradient_at = |distance: f64| {
            let mut shift = vec![0.0; unknowns];
            shift[j] = distance;
            slope(&system.displaced(&at, &shift)).0
        };
        let (ahead, behind) = (gradient_at(step), gradient_at(-step));
        for i in 0..unknowns {
            curvature[(i, j)] = (ahead[i] - behind[i]) / (2.0 * step);
        }
    }
    let symmetric = (&curvature + curvature.transpose()) * 0.5;
    let eigenvalues = symmetric.symmetric_eigenvalues();
    let largest = eigenvalues.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    (at, eigenvalues.min() >= -CURVED * largest)
}

/// Walks down to where the weighted squares no longer fall.
fn walk(
    system: &System<f64>,
    start: Configuration<f64>,
    multipliers: &[f64],
    work: &RefCell<SystemWork<f64>>,
) -> Configuration<f64> {
    let unknowns = system.unknowns().len();
    let slope =
        |at: &Configuration<f64>| system.slope(at, WEIGHT, multipliers, &mut work.borrow_mut());
    let mut at = start;
    // the gradient is that of the point itself only at step zero, so walk in short rounds
    for _ in 0..5 {
        let from = at.clone();
        let step = walk_down(
            vec![0.0; unknowns],
            |step| slope(&system.displaced(&from, step)).1,
            |step| slope(&system.displaced(&from, step)).0,
        );
        let next = system.displaced(&from, &step);
        let (before, after) = (slope(&at).1, slope(&next).1);
        if after >= before {
            break;
        }
        at = next;
        if before - after < 1e-14 * before {
            break;
        }
    }
    at
}
