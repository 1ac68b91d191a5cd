//! Nonlinear least squares under equations: Gauss–Newton and Levenberg–Marquardt.

use crate::number::tolerance::SOLVED;
use argmin::core::{Error, Executor, IterState, KV, Problem, Solver, State};
use argmin::core::{TerminationReason, TerminationStatus};

/// A least-squares problem: a sum of squares to be made small where equations hold.
pub trait LeastSquares {
    /// A point.
    type Point: Clone;
    /// The problem linearised at a point.
    type Model;

    /// The sums of squares at a point; infinite where it has no value.
    fn misfit(&self, at: &Self::Point) -> Misfit;
    /// The problem linearised at a point; `None` where it has no value.
    fn model(&self, at: &Self::Point) -> Option<Self::Model>;
    /// The point to which a model leads with steps damped by λ (Levenberg 1944), and the size of the step.
    fn stepped(&self, at: &Self::Point, model: &Self::Model, damping: f64) -> (Self::Point, f64);
}

/// Sums of squares of a problem at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// The sum of squares of the equations.
    pub equations: f64,
    /// The sum of squares that is minimised.
    pub squares: f64,
}

impl Misfit {
    /// The sums at a point at which a problem has no value.
    pub const NONE: Misfit = Misfit {
        equations: f64::INFINITY,
        squares: f64::INFINITY,
    };
}

/// The method of Levenberg and Marquardt (Marquardt 1963), as a solver of argmin; with `damping` 0 that of Gauss and
/// Newton as long as its steps improve the point.
///
/// A step is taken if the equations come nearer by half, or if the squares fall and the equations hold no worse: the two are
/// not weighed against each other (a filter, after Fletcher and Leyffer 2002).
#[derive(Clone, Debug)]
pub struct LevenbergMarquardt {
    /// λ at the beginning.
    pub damping: f64,
    /// Steps smaller than this end the search.
    pub tolerance: f64,
    /// Most steps.
    pub steps: u64,
}

/// A search under way, with its present λ; once it has ended, true if it converged.
struct DampedSearch {
    settings: LevenbergMarquardt,
    damping: f64,
    ended: Option<bool>,
}

impl Default for LevenbergMarquardt {
    fn default() -> Self {
        LevenbergMarquardt {
            damping: 1e-3,
            tolerance: SOLVED,
            steps: 100,
        }
    }
}

/// End of a search.
#[derive(Clone, Debug)]
pub struct Fitted<P> {
    /// The point.
    pub point: P,
    /// The sums of squares there.
    pub misfit: Misfit,
    /// The steps taken or tried.
    pub steps: u64,
    /// True if no step improves the point, or the last was smaller than the tolerance.
    pub converged: bool,
}

impl LevenbergMarquardt {
    /// The point to which the search leads from a start.
    pub fn solve<E: LeastSquares>(&self, problem: &E, start: E::Point) -> Fitted<E::Point> {
        let first = start.clone();
        let search = DampedSearch {
            settings: self.clone(),
            damping: self.damping,
            ended: None,
        };
        let run = Executor::new(problem, search)
            .configure(|state| state.param(start).max_iters(self.steps))
            .timer(false)
            .run();
        let (point, steps, converged) = match run {
            Ok(mut end) => {
                let reason = end.state.get_termination_reason();
                let converged = reason == Some(&TerminationReason::SolverConverged);
                let steps = end.state.get_iter();
                (end.state.take_param().unwrap_or(first), steps, converged)
            }
            Err(_) => (first, 0, false),
        };
        Fitted {
            misfit: problem.misfit(&point),
            point,
            steps,
            converged,
        }
    }
}

type Iterate<P> = IterState<P, (), (), (), (), f64>;

impl<E: LeastSquares> Solver<&E, Iterate<E::Point>> for DampedSearch {
    fn name(&self) -> &str {
        "Levenberg–Marquardt"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<&E>,
        mut state: Iterate<E::Point>,
    ) -> Result<(Iterate<E::Point>, Option<KV>), Error> {
        let at = state.take_param();
        let at = at.ok_or_else(|| Error::msg("there is no start"))?;
        let Some(model) = problem.problem("models", |problem| Ok(problem.model(&at)))? else {
            self.ended = Some(false);
            return Ok((state.param(at), None));
        };
        let tolerance = self.settings.tolerance;
        let floor = tolerance * tolerance;
        problem.problem("steps", |problem| {
            let before = problem.misfit(&at);
            loop {
                let (to, step) = problem.stepped(&at, &model, self.damping);
                let after = problem.misfit(&to);
                let nearer = after.equations < 0.5 * before.equations && before.equations > floor;
                let lower = after.squares < before.squares
                    && after.equations <= before.equations.max(floor);
                if nearer || lower {
                    self.damping = match self.damping / 10.0 {
                        // no digit changes by less
                        less if less < 1e-12 => 0.0,
                        less => less,
                    };
                    if step < tolerance {
                        self.ended = Some(true);
                    }
                    return Ok((state.param(to).cost(after.squares), None));
                }
                self.damping = (self.damping * 10.0).max(1e-9);
                // so damped a step leads nowhere
                if step < tolerance || self.damping > 1e12 {
                    self.ended = Some(true);
                    return Ok((state.param(at.clone()).cost(before.squares), None));
                }
            }
        })
    }

    fn terminate(&mut self, _: &Iterate<E::Point>) -> TerminationStatus {
        match self.ended {
            None => TerminationStatus::NotTerminated,
            Some(true) => TerminationStatus::Terminated(TerminationReason::SolverConverged),
            Some(false) => {
                let said = "no value".to_owned();
                TerminationStatus::Terminated(TerminationReason::SolverExit(said))
            }
        }
    }
}
