//! Assembled configurations where the equations may lose rank.

use super::{System, Work};
use crate::linear::norm;
use crate::mechanism::Configuration;
use crate::solve::{Equations, Newton, Report, Stop};

/// Newton's method from `at`. Where equations only touch zero, as those of rods stretched straight, it
/// ends when their slopes are lost, short of its tolerance; then by steps of least length from there.
pub fn solve(
    newton: &Newton,
    system: &System<f64>,
    at: &mut Configuration<f64>,
    work: &mut Work<f64>,
) -> Report {
    /// What may be left when the slopes are lost, and how far the solution then is.
    const NEARLY: f64 = 1e-9;
    const REACH: f64 = 1e-3;
    let mut trial = at.clone();
    let mut report = newton.solve(system, at, &mut trial, work);
    let nearly = report.stop != Stop::Solved && report.size.largest < NEARLY;
    if nearly && let Some(settled) = settle(system, work, at.clone(), REACH) {
        *at = settled;
        report.stop = Stop::Solved;
        report.size = system.linearise(at, work);
    }
    report
}

/// The assembled configuration that Gauss–Newton steps of least length reach from a point, to
/// rounding; `None` if they go further than `reach` or do not arrive.
pub fn settle(
    system: &System<f64>,
    work: &mut Work<f64>,
    mut at: Configuration<f64>,
    reach: f64,
) -> Option<Configuration<f64>> {
    const STEPS: usize = 60;
    /// No further step improves the result once this is reached.
    const CLOSED: f64 = 1e-15;
    let tolerance = Newton::default().tolerance;
    let start = at.clone();
    let mut best: Option<(f64, Configuration<f64>)> = None;
    let mut stale = 0;
    for _ in 0..STEPS {
        let size = system.linearise(&at, work).largest;
        if best.as_ref().is_none_or(|(least, _)| size < 0.5 * least) {
            best = Some((size, at.clone()));
            stale = 0;
        } else {
            stale += 1;
        }
        let least = best.as_ref().map_or(f64::INFINITY, |best| best.0);
        if size == 0.0 || (stale > 2 && least <= tolerance) || (stale > 0 && least <= CLOSED) {
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
