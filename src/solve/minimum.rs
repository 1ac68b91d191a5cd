use argmin::core::{CostFunction, Error, Executor, Gradient, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;

/// A smooth function of several variables with its gradient.
struct Smooth<C, G> {
    cost: C,
    gradient: G,
}

impl<C: Fn(&[f64]) -> f64, G> CostFunction for Smooth<C, G> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok((self.cost)(x))
    }
}

impl<C, G: Fn(&[f64]) -> Vec<f64>> Gradient for Smooth<C, G> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok((self.gradient)(x))
    }
}

/// Walks down from `start` to where the gradient vanishes, by limited-memory BFGS with the line
/// search of Moré and Thuente (argmin).
///
/// Where a residual does not vanish Gauss–Newton converges slowly or not at all, because it leaves
/// the curvature of the equations out; a quasi-Newton method learns it. Returns the best point
/// reached; `start` if the search cannot move.
pub fn walk_down(
    start: Vec<f64>,
    cost: impl Fn(&[f64]) -> f64,
    gradient: impl Fn(&[f64]) -> Vec<f64>,
) -> Vec<f64> {
    // enough pairs for the couple of dozen unknowns a mechanism has
    const HISTORY: usize = 10;
    const STEPS: u64 = 100;
    let problem = Smooth { cost, gradient };
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), HISTORY)
        .with_tolerance_grad(1e-13)
        .and_then(|solver| solver.with_tolerance_cost(0.0));
    let Ok(solver) = solver else {
        return start;
    };
    let first = start.clone();
    let run = Executor::new(problem, solver)
        .configure(|state| state.param(first).max_iters(STEPS))
        .run();
    match run {
        Ok(result) => result.state().get_best_param().cloned().unwrap_or(start),
        // a line search that cannot gain any more ends with an error: then it has arrived
        Err(_) => start,
    }
}

#[cfg(test)]
mod tests {
    use super::walk_down;

    #[test]
    fn finds_the_bottom_of_a_bent_valley() {
        // Rosenbrock 1960
        let cost = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let gradient = |x: &[f64]| {
            let bend = x[1] - x[0] * x[0];
            vec![-2.0 * (1.0 - x[0]) - 400.0 * x[0] * bend, 200.0 * bend]
        };
        let x = walk_down(vec![-1.2, 1.0], cost, gradient);
        assert!(
            (x[0] - 1.0).abs() < 1e-6 && (x[1] - 1.0).abs() < 1e-6,
            "{x:?}"
        );
    }
}
