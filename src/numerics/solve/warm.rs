use super::Equations;
use crate::number::tolerance::{LONGEST_STEP, SOLVED};

/// Newton's method for following a motion: each point starts from the ones before it, by extrapolation ([`Trail`]).
///
/// Neighbouring points have nearly the same Jacobian, so its factors are kept, and renewed only when a step with them
/// gains too little (Shamanskii 1967).
#[derive(Clone, Debug, PartialEq)]
pub struct Warm {
    /// A point is a solution when no dimensionless row exceeds this.
    pub tolerance: f64,
    /// The highest order of extrapolation, at most 5; 0 starts from the last solution.
    pub extrapolation: usize,
}

impl Default for Warm {
    fn default() -> Self {
        Warm {
            tolerance: SOLVED,
            extrapolation: ORDERS - 1,
        }
    }
}

/// Outcome of a warm solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WarmReport {
    /// True if the residual at the point returned is below the tolerance.
    pub solved: bool,
    /// Steps taken.
    pub steps: usize,
    /// Number of evaluations and factorisations of the Jacobian.
    pub renewals: usize,
    /// The largest residual row at the last point tried, dimensionless.
    pub residual: f64,
}

/// Orders of extrapolation: none, constant moves, moves that change linearly, quadratically and so on.
const ORDERS: usize = 6;

/// Steps after which to give up.
const MAX_STEPS: usize = 20;

/// The past of a motion: its factorised Jacobian, if any, and the backward differences m, ∇m, …, ∇⁵m of the latest
/// moves m from solution to solution.
///
/// Extrapolation of order p adds the first p of them; the order is that which would have missed the latest move least,
/// by ∇ᵖm. As it multiplies errors, at order 3 up to fifteen times, the step that would still lead from the point to
/// the solution is kept too: along a fine trajectory extrapolated points then need no correction.
#[derive(Clone, Debug)]
pub struct Trail<P> {
    next: P,
    spare: P,
    moved: Vec<f64>,
    /// The step from the latest point to the solution, to first order.
    rest: Vec<f64>,
    differences: Vec<[f64; ORDERS]>,
    order: usize,
    factorised: bool,
}

impl<P: Clone> Trail<P> {
    /// A trail without a past. `point` serves as storage.
    pub fn new(point: &P, unknowns: usize) -> Self {
        Trail {
            next: point.clone(),
            spare: point.clone(),
            moved: vec![0.0; unknowns],
            rest: vec![0.0; unknowns],
            differences: vec![[0.0; ORDERS]; unknowns],
            order: 0,
            factorised: false,
        }
    }
}

impl<P> Trail<P> {
    /// Forgets the past, as before a jump.
    pub fn forget(&mut self) {
        self.differences.fill([0.0; ORDERS]);
        self.rest.fill(0.0);
        self.order = 0;
        self.factorised = false;
    }

    /// Takes in the latest move, and the step that remains.
    fn learn(&mut self, left: &[f64]) {
        let mut errors = [0.0; ORDERS];
        let known = self.moved.iter().zip(&mut self.rest).zip(left);
        for (differences, ((&moved, rest), &left)) in self.differences.iter_mut().zip(known) {
            let mut latest = [moved + (left - *rest); ORDERS];
            for i in 1..ORDERS {
                latest[i] = latest[i - 1] - differences[i - 1];
            }
            for i in 0..ORDERS {
                errors[i] += latest[i] * latest[i];
            }
            (*rest, *differences) = (left, latest);
        }
        let better = |best, order| {
            if errors[order] < errors[best] {
                order
            } else {
                best
            }
        };
        self.order = (1..ORDERS).fold(0, better);
    }
}

impl Warm {
    /// Moves `point`, a solution for other held values, to the solution for those it holds now. Nothing allocates.
    ///
    /// On failure `point` is left as it was, a start for [`Newton`](super::Newton), and the past is forgotten.
    #[inline]
    pub fn solve<E: Equations<Scalar = f64>>(
        &self,
        equations: &E,
        point: &mut E::Point,
        trail: &mut Trail<E::Point>,
        work: &mut E::Work,
    ) -> WarmReport {
        let order = trail.order.min(self.extrapolation);
        let mut report = self.attempt(equations, point, order, trail, work);
        if !report.solved && order > 0 {
            trail.factorised = false;
            let again = self.attempt(equations, point, 0, trail, work);
            report = WarmReport {
                steps: report.steps + again.steps,
                renewals: report.renewals + again.renewals,
                ..again
            };
        }
        if report.solved {
            std::mem::swap(point, &mut trail.next);
            let known = self.extrapolation > 0 && trail.factorised;
            let small = known && equations.step(work) <= LONGEST_STEP;
            let left = equations.step_mut(work);
            if !small {
                left.fill(0.0);
            }
            trail.learn(left);
        } else {
            trail.forget();
        }
        report
    }

    #[inline]
    fn attempt<E: Equations<Scalar = f64>>(
        &self,
        equations: &E,
        point: &E::Point,
        order: usize,
        trail: &mut Trail<E::Point>,
        work: &mut E::Work,
    ) -> WarmReport {
        // a guess worth having leaves less to do than it did
        let mut longest_step = LONGEST_STEP;
        let steps = equations.step_mut(work);
        if order > 0 {
            let mut longest = 0.0f64;
            let past = trail.differences.iter().zip(&trail.rest);
            let moves = trail.moved.iter_mut().zip(steps);
            for ((moved, step), (differences, &rest)) in moves.zip(past) {
                let terms = differences[..order].iter();
                let sum = terms.fold(rest, |sum, &d| sum + d);
                (*step, *moved) = (sum, sum);
                if sum.abs() > longest {
                    longest = sum.abs();
                }
            }
            longest_step = longest_step.min(longest);
        } else {
            trail.moved.fill(0.0);
            steps.fill(0.0);
        }
        equations.advance(point, 1.0, work, &mut trail.next);
        let mut report = WarmReport {
            solved: false,
            steps: 0,
            renewals: 0,
            residual: equations.residual(&trail.next, work).largest,
        };
        loop {
            // also false for a residual that is not a number
            report.solved = report.residual <= self.tolerance;
            if report.solved || report.steps == MAX_STEPS {
                return report;
            }
            let fresh = !trail.factorised;
            if fresh {
                equations.linearise(&trail.next, work);
                equations.factorise(0.0, work);
                trail.factorised = true;
                report.renewals += 1;
            }
            let longest = equations.step(work);
            report.steps += 1;
            equations.advance(&trail.next, 1.0, work, &mut trail.spare);
            let residual = equations.residual(&trail.spare, work).largest;
            let acceptable = longest <= longest_step && residual < report.residual;
            let enough = match residual <= self.tolerance {
                // with less gain the Jacobian is too old to tell the error that remains
                true => 1e-2,
                // a new Jacobian costs one to three steps
                false => 1e-3,
            };
            let gained = residual <= enough * report.residual;
            trail.factorised = acceptable && gained;
            if acceptable {
                std::mem::swap(&mut trail.next, &mut trail.spare);
                for (moved, &step) in trail.moved.iter_mut().zip(&*equations.step_mut(work)) {
                    *moved += step;
                }
                report.residual = residual;
            } else if fresh {
                return report;
            }
        }
    }
}
