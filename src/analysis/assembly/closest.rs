//! The closest approach of a mechanism that cannot be assembled.

use std::cell::RefCell;

use crate::mechanism::Configuration;
use crate::solve::walk_down;
use crate::system::System;

/// Comes as close to assembled as possible near a configuration, and tells whether no small motion
/// comes closer: the gradient of the squared gaps vanishes and their curvature is nowhere negative.
pub(super) fn approach(
    system: &System<f64>,
    start: &Configuration<f64>,
) -> (Configuration<f64>, bool) {
    let unknowns = system.unknowns().len();
    let work = RefCell::new(system.work());
    let slope = |at: &Configuration<f64>| system.slope(at, &mut work.borrow_mut());
    let mut at = start.clone();
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
    let (gradient, squares) = slope(&at);
    let steepest = gradient.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
    if steepest > 1e-6 * squares.sqrt() {
        return (at, false);
    }
    let step = 1e-5;
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
    (at, unknowns == 0 || eigenvalues.min() >= -1e-6 * largest)
}
