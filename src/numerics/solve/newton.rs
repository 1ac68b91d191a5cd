use super::{Equations, Size};
use crate::number::tolerance::SOLVED;

/// Newton's method from a guess that may be far off: Gauss–Newton steps, damped when they fail (Levenberg 1944,
/// Marquardt 1963). Near a solution the damping is zero and convergence quadratic, redundant rows or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Newton {
    /// A point is a solution when no dimensionless row exceeds this: rounding of some 1e-16 adds up along chains.
    pub tolerance: f64,
    /// Steps after which to give up.
    pub max_steps: usize,
}

impl Default for Newton {
    fn default() -> Self {
        Newton {
            tolerance: SOLVED,
            max_steps: 100,
        }
    }
}

/// Reason for which the iteration stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The residual is below the tolerance.
    Solved,
    /// The residual no longer falls: a minimum that is not a solution, or too flat to tell.
    Minimum,
    /// The permitted number of steps is used up.
    StepLimit,
}

/// Outcome of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonReport {
    /// Reason for which it stopped.
    pub stop: Stop,
    /// Accepted steps.
    pub steps: usize,
    /// The size of the residual there.
    pub size: Size,
}

impl Newton {
    /// Iterates from `point`, which is left at the best point found. `trial` is storage.
    pub fn solve<E: Equations>(
        &self,
        equations: &E,
        point: &mut E::Point,
        trial: &mut E::Point,
        work: &mut E::Work,
    ) -> NewtonReport {
        let mut size = equations.linearise(point, work);
        let mut damping = 0.0;
        let mut slow = 0;
        for steps in 0..self.max_steps {
            if size.largest <= self.tolerance {
                return self.polish(equations, point, trial, work, steps, size);
            }
            let before = size;
            match self.lower(equations, point, trial, work, size, &mut damping) {
                None => return report(Stop::Minimum, steps, size),
                Some(lower) => size = lower,
            }
            // a slow step may be the way round a bend; several in a row are a minimum
            let progress = 1.0 - size.squares / before.squares;
            let is_slow = progress < 1e-9;
            slow = if is_slow { slow + 1 } else { 0 };
            if slow == 3 {
                return report(Stop::Minimum, steps + 1, size);
            }
        }
        let stop = match size.largest <= self.tolerance {
            true => Stop::Solved,
            false => Stop::StepLimit,
        };
        report(stop, self.max_steps, size)
    }

    /// Makes one step, damped as much as needed. `None` if no damping lowers the residual.
    fn lower<E: Equations>(
        &self,
        equations: &E,
        point: &mut E::Point,
        trial: &mut E::Point,
        work: &mut E::Work,
        size: Size,
        damping: &mut f64,
    ) -> Option<Size> {
        loop {
            equations.factorise(*damping, work);
            let longest = equations.step(work);
            if longest.is_finite() {
                // no rotation is linear beyond about 1 rad
                let fraction = (1.0 / longest).min(1.0);
                equations.advance(point, fraction, work, trial);
                let next = equations.residual(trial, work);
                // a direction that the equations hardly see takes up the step; damping leaves it out
                let lost = *damping == 0.0 && fraction < 1.0 && next.squares > 0.99 * size.squares;
                if next.squares < size.squares && !lost {
                    std::mem::swap(point, trial);
                    let gain = next.squares / size.squares;
                    *damping = match gain {
                        _ if *damping < 1e-9 => 0.0,
                        _ if gain < 0.25 => *damping * 0.05,
                        _ if gain < 0.9 => *damping * 0.3,
                        _ => *damping,
                    };
                    return Some(equations.linearise(point, work));
                }
                if longest < 1e-15 {
                    return None;
                }
            }
            *damping = (*damping * 8.0).max(1e-3);
            if *damping > 1e8 {
                return None;
            }
            // the residual of the rejected point has replaced the one the step is made from
            equations.linearise(point, work);
        }
    }

    /// Further steps while they reduce the residual: one at a regular solution, about a dozen at a double one.
    fn polish<E: Equations>(
        &self,
        equations: &E,
        point: &mut E::Point,
        trial: &mut E::Point,
        work: &mut E::Work,
        mut steps: usize,
        mut size: Size,
    ) -> NewtonReport {
        const MOST: usize = 20;
        for _ in 0..MOST {
            if size.largest == 0.0 {
                break;
            }
            equations.factorise(0.0, work);
            let longest = equations.step(work);
            // a long step so near a solution only slides along a freedom
            if longest >= 1e-3 {
                break;
            }
            equations.advance(point, 1.0, work, trial);
            let next = equations.residual(trial, work);
            if next.largest >= 0.5 * size.largest {
                break;
            }
            std::mem::swap(point, trial);
            size = equations.linearise(point, work);
            steps += 1;
        }
        equations.linearise(point, work);
        report(Stop::Solved, steps, size)
    }
}

fn report(stop: Stop, steps: usize, size: Size) -> NewtonReport {
    NewtonReport { stop, steps, size }
}
