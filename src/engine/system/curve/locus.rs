//! Singular configurations with two inputs free, as a curve.

use super::{ConfigurationCurve, Curve};
use crate::linear::{Decomposition, add, dot, product};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::FIVE_POINTS;
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
    /// The columns of M of the unknowns of x.
    columns: Vec<usize>,
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
        let unknowns = closed.system().unknowns();
        let seen = unknowns.iter().map(|unknown| match *unknown {
            Unknown::Joint(joint) => whole || inputs.contains(&Coordinate::Joint(joint)),
            Unknown::Twist(..) => true,
        });
        let locked = Locked::without_spins(mechanism, held, locks);
        let column = |unknown: &Unknown| locked.system().place_of(*unknown);
        LocusCurve {
            seen: seen.collect(),
            columns: unknowns.iter().filter_map(column).collect(),
            closed,
            locked,
        }
    }

    /// M.
    pub fn locked(&mut self) -> &mut Locked {
        &mut self.locked
    }

    fn freedoms(&self) -> usize {
        self.closed.unknowns()
    }

    /// The derivative of M along the motion v, column-major, by five points: about as exact as rounding.
    fn change(&mut self, point: &Singular) -> Vec<f64> {
        let mut change = vec![0.0; self.locked.rows() * self.locked.columns()];
        for (length, weight) in FIVE_POINTS {
            let step: Vec<f64> = point.motion.iter().map(|v| length * v).collect();
            let at = self.locked.system().displaced(&point.at, &step);
            add(&mut change, weight, &self.locked.jacobian(&at));
        }
        change
    }

    /// The component of (∂M/∂v) v outside the image of M: zero where v goes on to second order with inputs or outputs
    /// at rest.
    pub fn bend(&mut self, point: &Singular) -> Vec<f64> {
        let (rows, columns) = (self.locked.rows(), self.locked.columns());
        let change = self.change(point);
        let mut bend = product(&change, rows, &point.motion);
        let matrix = self.locked.jacobian(&point.at);
        let within = Decomposition::of_rank(rows, columns, &matrix, columns - 1).solve(&bend);
        add(&mut bend, -1.0, &product(&matrix, rows, &within));
        bend
    }

    /// M(x) v.
    fn image(&mut self, at: &Configuration<f64>, motion: &[f64]) -> Vec<f64> {
        let entries = self.locked.jacobian(at);
        product(&entries, self.locked.rows(), motion)
    }
}

impl ConfigurationCurve for LocusCurve {
    fn configuration(point: &Singular) -> &Configuration<f64> {
        &point.at
    }

    fn closed(&self) -> &Curve {
        &self.closed
    }

    /// Platforms and inputs: legs folded the other way about passive joints make no other locus.
    fn sees(&self, component: usize) -> bool {
        self.seen[component]
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

    /// The derivative of M v along the unknown e is that of M e along v, but for the rotations of
    /// platforms: with left-multiplied turns ω of the platform ∂ₑ(M v) − ∂ᵥ(M e) = M (ω_v × ω_e).
    /// Of frames among the locks a term is left out that vanishes with M v.
    fn linearise(&mut self, point: &Singular) -> (Vec<f64>, Vec<f64>) {
        let (mut residual, closure) = self.closed.linearise(&point.at);
        let first = residual.len();
        let matrix = self.locked.jacobian(&point.at);
        let second = self.locked.rows();
        residual.extend(product(&matrix, second, &point.motion));
        residual.push(0.5 * (dot(&point.motion, &point.motion) - 1.0));
        let rows = residual.len();
        let mut jacobian = vec![0.0; rows * self.unknowns()];
        let freedoms = self.freedoms();
        let change = self.change(point);
        for (k, unknown) in self.closed.system().unknowns().iter().enumerate() {
            let column = &mut jacobian[k * rows..(k + 1) * rows];
            column[..first].copy_from_slice(&closure[k * first..(k + 1) * first]);
            let place = self.columns[k];
            let column = &mut column[first..first + second];
            column.copy_from_slice(&change[place * second..(place + 1) * second]);
            if let Unknown::Twist(_, c @ 0..3) = *unknown {
                let turning = place - c;
                let [y, z] = [(c + 1) % 3, (c + 2) % 3];
                // ω × e with e along component c
                for (to, factor) in [
                    (y, point.motion[turning + z]),
                    (z, -point.motion[turning + y]),
                ] {
                    add(column, factor, &matrix[(turning + to) * second..][..second]);
                }
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
