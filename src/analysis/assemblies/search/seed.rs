//! Newton's method from random complex points at one member of the family.

use rand_pcg::Pcg64;

use crate::analysis::assemblies::family::{C, size};
use crate::analysis::assemblies::track::{Way, polish, stands_alone};
use crate::mechanism::Configuration;
use crate::number::Number;
use crate::solve::{Newton, Report, Stop};

/// Ends of seeds farther out than this do not count: rounding decides where they are.
const FAR: f64 = 1e5;

/// What one seed met.
pub(crate) enum Seed {
    Nothing,
    /// A solution by itself.
    Isolated(Vec<C>),
    /// Solutions that coincide.
    Multiple,
    /// A set of solutions with so much freedom.
    Free(usize),
}

/// For random points: what takes longer rarely ends at a solution.
pub(crate) fn newton() -> Newton {
    Newton {
        max_steps: 60,
        ..Newton::default()
    }
}

/// The solution that Newton's method ended at. Far out, where coordinates are tens of characteristic
/// lengths, rounding keeps residuals above its tolerance; there the last digits tell.
pub(crate) fn solution(
    way: &mut Way<'_>,
    report: &Report,
    point: &Configuration<C>,
) -> Option<Vec<C>> {
    const NEARLY: f64 = 1e-8;
    let mut x = way.family.coordinates.flatten(point);
    if size(&x).is_nan() || size(&x) > FAR {
        return None;
    }
    match report.stop {
        Stop::Solved => Some(x),
        Stop::Minimum if report.size.largest <= NEARLY * (1.0 + size(&x).powi(2)) => {
            polish(way, C::from_f64(0.0), &mut x).then_some(x)
        }
        Stop::Minimum | Stop::StepLimit => None,
    }
}

/// One Newton iteration from a random complex point. `reach` says how far out.
pub(crate) fn sow(way: &mut Way<'_>, reach: f64, rng: &mut Pcg64) -> Seed {
    let start = way.family.random_point(rng, reach);
    let zero = C::from_f64(0.0);
    way.linearise(zero, &start);
    let mut point = way.here.at.clone();
    let mut trial = point.clone();
    let report = newton().solve(&way.here.system, &mut point, &mut trial, &mut way.here.work);
    let Some(x) = solution(way, &report, &point) else {
        return Seed::Nothing;
    };
    if stands_alone(way, zero, &x) {
        return Seed::Isolated(x);
    }
    // Newton's method from beside a set of solutions ends elsewhere on it, but from beside solutions
    // that coincide at the same point again
    way.linearise(zero, &way.family.shaken(&x, 0.03, rng));
    let mut beside = way.here.at.clone();
    let report = newton().solve(
        &way.here.system,
        &mut beside,
        &mut trial,
        &mut way.here.work,
    );
    let beside = way.family.coordinates.flatten(&beside);
    let apart = way.family.coordinates.difference(&x, &beside);
    match (report.stop == Stop::Solved, apart) {
        (true, 1e-3..1.0) => Seed::Free(way.freedom(zero, &x, 1e-5)),
        (true, ..1e-3) => Seed::Multiple,
        _ => Seed::Nothing,
    }
}
