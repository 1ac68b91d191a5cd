//! Singular configurations with two inputs free, as a curve.

use super::{ConfigurationCurve, Curve};
use crate::linear::{add, dot};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::SolutionCurve;
use crate::system::{Coordinate, Held, Lock, Locked, Unknown};

/// An assembled configuration with a motion that leaves the locked coordinates and frames at rest.
#[derive(Clone, Debug)]
pub struct Singular {
    /// The configuration.
    pub at: Configuration<f64>,
    /// The motion, a unit vector, with nothing held.
    pub motion: Vec<f64>,
}

/// Closure r(x) = 0 together with the singularity condition, as the augmented system
///
/// r(x) = 0, M(x) v = 0, ½(vᵀv − 1) = 0
///
/// in the configuration x with two freedoms and the motion v. It is regular wherever the locus is a
/// smooth curve and the motion unique, whatever the shape of M and the redundancy of its rows.
/// Source: Moore and Spence 1980; Seydel 1979.
#[derive(Clone, Debug)]
pub struct LocusCurve {
    closed: Curve,
    locked: Locked,
    /// The unknowns of platforms and inputs.
    seen: Vec<bool>,
}

impl LocusCurve {
    /// `held` leaves two freedoms; `locks` stand still in the motion.
    pub fn new(
        mechanism: &Mechanism,
        held: &Held<f64>,
        inputs: &[Coordinate],
        locks: &[Lock],
    ) -> Self {
        let closed = Curve::along(mechanism, held, Vec::new());
        let whole = mechanism.platforms().is_empty();
        let seen = closed
            .system()
            .unknowns()
            .iter()
            .map(|unknown| match *unknown {
                Unknown::Joint(joint) => whole || inputs.contains(&Coordinate::Joint(joint)),
                Unknown::Twist { .. } => true,
            });
        LocusCurve {
            seen: seen.collect(),
            closed,
            locked: Locked::without_spins(mechanism, held, locks),
        }
    }

    /// The assembled configurations with two freedoms.
    pub fn closed(&mut self) -> &mut Curve {
        &mut self.closed
    }

    /// M.
    pub fn locked(&mut self) -> &mut Locked {
        &mut self.locked
    }

    fn freedoms(&self) -> usize {
        self.closed.unknowns()
    }

    /// M(x) v.
    fn image(&mut self, at: &Configuration<f64>, motion: &[f64]) -> Vec<f64> {
        let entries = self.locked.jacobian(at);
        product(&entries, self.locked.rows(), motion)
    }
}

fn product(entries: &[f64], rows: usize, vector: &[f64]) -> Vec<f64> {
    let mut image = vec![0.0; rows];
    for (column, x) in entries.chunks_exact(rows.max(1)).zip(vector) {
        add(&mut image, *x, column);
    }
    image
}

impl ConfigurationCurve for LocusCurve {
    fn configuration(point: &Singular) -> &Configuration<f64> {
        &point.at
    }

    fn apart(&self, from: &Singular, to: &Singular) -> Vec<f64> {
        self.closed.difference_but_turns(&from.at, &to.at)
    }

    /// Platforms and inputs: legs that are folded the other way about their passive joints do not
    /// make another locus.
    fn seen(&self, step: &[f64]) -> Vec<f64> {
        let parts = step.iter().zip(&self.seen);
        parts
            .map(|(x, seen)| if *seen { *x } else { 0.0 })
            .collect()
    }
}

impl SolutionCurve for LocusCurve {
    type Point = Singular;

    fn unknowns(&self) -> usize {
        self.freedoms() + self.locked.columns()
    }

    fn residual(&mut self, point: &Singular) -> Vec<f64> {
        let mut residual = self.closed.residual(&point.at);
        residual.extend(self.image(&point.at, &point.motion));
        residual.push(0.5 * (dot(&point.motion, &point.motion) - 1.0));
        residual
    }

    fn linearise(&mut self, point: &Singular) -> (Vec<f64>, Vec<f64>) {
        /// Step of the differences: their error, of second order, only delays convergence.
        const STEP: f64 = 1e-5;
        let (mut residual, closure) = self.closed.linearise(&point.at);
        let first = residual.len();
        let matrix = self.locked.jacobian(&point.at);
        let second = self.locked.rows();
        residual.extend(product(&matrix, second, &point.motion));
        residual.push(0.5 * (dot(&point.motion, &point.motion) - 1.0));
        let rows = residual.len();
        let mut jacobian = vec![0.0; rows * self.unknowns()];
        let freedoms = self.freedoms();
        let mut step = vec![0.0; freedoms];
        for k in 0..freedoms {
            let column = &mut jacobian[k * rows..(k + 1) * rows];
            column[..first].copy_from_slice(&closure[k * first..(k + 1) * first]);
            step[k] = STEP;
            let ahead = self.closed.displaced(&point.at, &step);
            step[k] = -STEP;
            let back = self.closed.displaced(&point.at, &step);
            step[k] = 0.0;
            let [ahead, back] = [ahead, back].map(|at| self.image(&at, &point.motion));
            for (i, (a, b)) in ahead.into_iter().zip(back).enumerate() {
                column[first + i] = (a - b) / (2.0 * STEP);
            }
        }
        for (k, v) in point.motion.iter().enumerate() {
            let column = &mut jacobian[(freedoms + k) * rows..(freedoms + k + 1) * rows];
            column[first..first + second].copy_from_slice(&matrix[k * second..(k + 1) * second]);
            column[first + second] = *v;
        }
        (residual, jacobian)
    }

    fn displaced(&self, point: &Singular, step: &[f64]) -> Singular {
        let (x, v) = step.split_at(self.freedoms());
        Singular {
            at: self.closed.displaced(&point.at, x),
            motion: point.motion.iter().zip(v).map(|(a, b)| a + b).collect(),
        }
    }

    fn difference(&self, from: &Singular, to: &Singular) -> Vec<f64> {
        let mut step = self.closed.difference(&from.at, &to.at);
        step.extend(to.motion.iter().zip(&from.motion).map(|(a, b)| a - b));
        step
    }
}
