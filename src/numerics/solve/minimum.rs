use std::cell::{Cell, RefCell};

use argmin::core::{CostFunction, Error, Executor, Gradient};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::neldermead::NelderMead;
use argmin::solver::quasinewton::LBFGS;

use super::Watch;
use crate::number::tolerance::SOLVED;

/// A smooth function of several variables with its gradient, and the lowest point seen.
struct Smooth<'a, C, G> {
    cost: C,
    gradient: G,
    lowest: &'a RefCell<(f64, Vec<f64>)>,
    evaluations: Cell<usize>,
}

/// A line search among rounding errors may never end; a hundred steps take a few hundred evaluations.
const MOST_EVALUATIONS: usize = 2000;

impl<C: Fn(&[f64]) -> f64, G> CostFunction for Smooth<'_, C, G> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        let cost = (self.cost)(x);
        self.evaluations.set(self.evaluations.get() + 1);
        if !cost.is_finite() || self.evaluations.get() > MOST_EVALUATIONS {
            return Err(Error::msg("no further evaluations"));
        }
        let mut lowest = self.lowest.borrow_mut();
        if cost < lowest.0 {
            *lowest = (cost, x.clone());
        }
        Ok(cost)
    }
}

impl<C, G: Fn(&[f64]) -> Vec<f64>> Gradient for Smooth<'_, C, G> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok((self.gradient)(x))
    }
}

/// Walks down from `start` to where the gradient vanishes, by limited-memory BFGS with the line
/// search of Moré and Thuente (argmin).
///
/// Gauss–Newton ignores the curvature of the equations and converges slowly to a residual that is not
/// zero. Returns the lowest point reached; `start` if the search cannot move.
pub fn walk_down(
    start: Vec<f64>,
    cost: impl Fn(&[f64]) -> f64,
    gradient: impl Fn(&[f64]) -> Vec<f64>,
) -> Vec<f64> {
    // enough pairs for the couple of dozen unknowns a mechanism has
    const HISTORY: usize = 10;
    const STEPS: u64 = 100;
    let lowest = RefCell::new((f64::INFINITY, start.clone()));
    let problem = Smooth {
        cost,
        gradient,
        lowest: &lowest,
        evaluations: Cell::new(0),
    };
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), HISTORY)
        .with_tolerance_grad(1e-13)
        .and_then(|solver| solver.with_tolerance_cost(0.0));
    let Ok(solver) = solver else {
        return start;
    };
    let run = Executor::new(problem, solver)
        .configure(|state| state.param(start).max_iters(STEPS))
        .run();
    // a line search that cannot gain any more ends with an error: then it has arrived
    drop(run);
    lowest.into_inner().1
}

/// A function of several variables, which has no value in some places.
struct Rough<'a, C> {
    cost: RefCell<C>,
    watch: &'a Watch<'a>,
}

impl<C: FnMut(&[f64]) -> Option<f64>> CostFunction for Rough<'_, C> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        if self.watch.is_stopped() {
            return Err(Error::msg("stopped"));
        }
        let cost = (self.cost.borrow_mut())(x);
        // its square is a number, so that spreads of costs are
        Ok(cost.filter(|cost| cost.is_finite()).unwrap_or(1e100))
    }
}

/// Walks down from zero by the simplex method of Nelder and Mead (1965; argmin), which needs no derivatives, with a first simplex
/// of this size. What is evaluated is seen by `cost`.
pub fn simplex(
    variables: usize,
    size: f64,
    watch: &Watch,
    cost: impl FnMut(&[f64]) -> Option<f64>,
) {
    const STEPS: u64 = 60;
    let corner = |i: usize| {
        let mut corner = vec![0.0; variables];
        if let Some(x) = i.checked_sub(1).map(|i| &mut corner[i]) {
            *x = size;
        }
        corner
    };
    let solver = NelderMead::new((0..=variables).map(corner).collect());
    let Ok(solver) = solver.with_sd_tolerance(SOLVED) else {
        return;
    };
    let problem = Rough {
        cost: RefCell::new(cost),
        watch,
    };
    // an error is a search that was stopped
    drop(
        Executor::new(problem, solver)
            .configure(|state| state.max_iters(STEPS * variables as u64))
            .timer(false)
            .run(),
    );
}
