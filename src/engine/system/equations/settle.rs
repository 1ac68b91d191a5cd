//! Assembled configurations where the equations may lose rank.

use super::{System, SystemWork};
use crate::linear::{RANK_TOLERANCE, SPECTRUM_LIMIT, norm};
use crate::mechanism::Configuration;
use crate::number::tolerance::{DOUBLE, EXACT, LONGEST_STEP, SUSPECT};
use crate::solve::{
    Equations, Newton, NewtonReport, Stage, Stop, Watch, deflating_step, step_off_saddle,
};

/// Newton's method from `at`, also where convergence is slow. Near a solution at which equations only touch zero, as
/// those of rods stretched straight, the slopes that vanish there lead to it. From a saddle of the residual, as of rods
/// a little longer than a straight line, the iteration goes on from a point to the side.
pub fn solve(
    newton: &Newton,
    system: &System<f64>,
    at: &mut Configuration<f64>,
    work: &mut SystemWork<f64>,
) -> NewtonReport {
    /// A few for each part that is straight.
    const SADDLES: usize = 8;
    let mut trial = at.clone();
    let mut report = newton.solve(system, at, &mut trial, work);
    let dense = system.unknowns().len() <= SPECTRUM_LIMIT;
    if report.stop == Stop::Solved && dense {
        if let Some(level) = levelled(system, work, at, report.size.largest) {
            *at = level;
            report.size = system.linearise(at, work);
        }
        return report;
    }
    let mut found = None;
    for _ in 0..SADDLES {
        // with wide gaps it is no saddle beside a solution
        if report.stop == Stop::Solved || report.size.largest >= 0.05 || !dense {
            break;
        }
        let Some(level) = level(system, work, at.clone()) else {
            break;
        };
        let left = system.linearise(&level, work).largest;
        if left <= newton.tolerance {
            found = Some(level);
            break;
        }
        // a saddle is where it was
        if norm(&system.difference(at, &level)) > 0.1 {
            break;
        }
        let lost = lost(left);
        let step = step_off_saddle(
            system.unknowns().len(),
            lost,
            linearised(system, work, &level),
        );
        let Some(step) = step else { break };
        let mut beside = system.displaced(&level, &step);
        let again = newton.solve(system, &mut beside, &mut trial, work);
        if again.size.squares >= report.size.squares {
            break;
        }
        *at = beside;
        report = NewtonReport {
            steps: report.steps + again.steps,
            ..again
        };
    }
    let nearly = report.stop != Stop::Solved && report.size.largest < DOUBLE;
    if nearly && found.is_none() {
        found = settle(system, work, at.clone(), 1e-3, None);
    }
    if let Some(found) = found {
        *at = found;
        report.stop = Stop::Solved;
        report.size = system.linearise(at, work);
    }
    report
}

impl System<f64> {
    /// The configuration that Newton's method reaches from a start, if it assembles there.
    pub fn solved(
        &self,
        newton: &Newton,
        start: &Configuration<f64>,
    ) -> Option<Configuration<f64>> {
        let (mut at, mut trial) = (start.clone(), start.clone());
        let report = newton.solve(self, &mut at, &mut trial, &mut self.work());
        (report.stop == Stop::Solved).then_some(at)
    }
}

/// Singular values that vanish where so much of the equations is left are no larger relative to the largest:
/// slopes are of first order in the distance, and what is left of second.
fn lost(left: f64) -> f64 {
    (10.0 * left.sqrt()).clamp(1e-4, 3e-2)
}

/// Residual and Jacobian at a configuration displaced.
fn linearised<'a>(
    system: &'a System<f64>,
    work: &'a mut SystemWork<f64>,
    at: &'a Configuration<f64>,
) -> impl FnMut(&[f64]) -> (Vec<f64>, Vec<f64>) + 'a {
    move |shift: &[f64]| {
        system.linearise(&system.displaced(at, shift), work);
        let residual = system.residual_of(work).to_vec();
        (residual, system.dense_jacobian(work))
    }
}

/// The configuration where slopes vanish beside an assembled one where they nearly do, if rounding does not tell these
/// from one another by what is `left` of the equations.
fn levelled(
    system: &System<f64>,
    work: &mut SystemWork<f64>,
    at: &Configuration<f64>,
    left: f64,
) -> Option<Configuration<f64>> {
    let lost = |tolerance| system.nullity(tolerance, work);
    if lost(SUSPECT) == lost(RANK_TOLERANCE) {
        return None;
    }
    let level = level(system, work, at.clone())?;
    let near = norm(&system.difference(at, &level)) <= DOUBLE;
    (near && system.linearise(&level, work).largest <= left.max(EXACT)).then_some(level)
}

/// The configuration beside a point where the slopes vanish that nearly do there, and of the equations no
/// more is left than what they do not see.
fn level(
    system: &System<f64>,
    work: &mut SystemWork<f64>,
    mut at: Configuration<f64>,
) -> Option<Configuration<f64>> {
    const STEPS: usize = 30;
    /// Longer steps must lower what is left.
    const LONG: f64 = 0.05;
    let mut before = f64::INFINITY;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let left = system.linearise(&at, work).largest;
        let lost = lost(left);
        let mut step =
            deflating_step(system.unknowns().len(), lost, linearised(system, work, &at))?;
        last = norm(&step);
        if last > LONG && left > 0.9 * before {
            return None;
        }
        before = left;
        if last > LONGEST_STEP {
            step.iter_mut().for_each(|x| *x *= LONGEST_STEP / last);
        }
        at = system.displaced(&at, &step);
        if last < 1e-9 {
            break;
        }
    }
    (last <= LONG).then_some(at)
}

/// The assembled configuration that Gauss–Newton steps of least length reach from a point, to
/// rounding; `None` if they go further than `reach`, do not arrive or are stopped.
pub fn settle(
    system: &System<f64>,
    work: &mut SystemWork<f64>,
    mut at: Configuration<f64>,
    reach: f64,
    watch: Option<&Watch>,
) -> Option<Configuration<f64>> {
    const STEPS: usize = 60;
    let tolerance = Newton::default().tolerance;
    let start = at.clone();
    let mut best: Option<(f64, Configuration<f64>)> = None;
    let mut stale = 0;
    // each step factorises, which takes long for large equations only
    let stops = |step| watch.is_some_and(|watch| watch.stops(Stage::Steps, step, Some(STEPS)));
    for step in 0..STEPS {
        if system.is_large() && stops(step) {
            return None;
        }
        let size = system.linearise(&at, work).largest;
        if best.as_ref().is_none_or(|(least, _)| size < 0.5 * least) {
            best = Some((size, at.clone()));
            stale = 0;
        } else {
            stale += 1;
        }
        let least = best.as_ref().map_or(f64::INFINITY, |best| best.0);
        if size == 0.0 || (stale > 2 && least <= tolerance) || (stale > 0 && least <= EXACT) {
            break;
        }
        let decomposition = system.decomposition(work);
        let mut back = decomposition.solve(system.residual_of(work));
        let longest = norm(&back);
        let factor = (reach / longest).min(1.0);
        back.iter_mut().for_each(|x| *x *= -factor);
        at = system.displaced(&at, &back);
        if norm(&system.difference(&start, &at)) > 10.0 * reach {
            return None;
        }
    }
    let (size, at) = best?;
    (size <= tolerance).then_some(at)
}
