//! Solutions tracked along a path through the family.

use super::homotopy::ParameterHomotopy;
use crate::analysis::assemblies::family::{C, size};
use crate::number::Number;
use crate::solve::{Arrival, Homotopy, Progress, Stages, Tracker, Watch};

/// Coordinates beyond this count as infinite on loops. At special dimensions some solutions are
/// thousands of characteristic lengths away for all inputs, and farther on the way.
const FARTHEST: f64 = 1e6;

/// Carries solutions along a way. Those that are lost and those that share an end, of which all but
/// one have jumped, are followed again with greater care; what cannot be told is `None`, as are
/// those that were not followed when the work was stopped.
pub(crate) fn tracked(
    homotopy: &ParameterHomotopy<'_>,
    points: &mut [Option<Vec<C>>],
    (watch, now): (&Watch, Progress),
) {
    let coordinates = &homotopy.family.coordinates;
    let starts: Vec<Option<Vec<C>>> = points.to_vec();
    let mut waiting: Vec<usize> = (0..starts.len()).filter(|&i| starts[i].is_some()).collect();
    for care in [1.0, 0.1, 0.01] {
        let tracker = Tracker {
            largest: FARTHEST,
            ..Tracker::default()
        };
        let tracker = match care {
            1.0 => tracker,
            _ => tracker.tightened(care),
        };
        let ends = crate::solve::each(waiting.len(), homotopy, |homotopy, k| {
            match watch.at(now).is_break() {
                true => None,
                false => {
                    let stages =
                        &mut Stages::new(homotopy.family.coordinates.count(), (watch, now));
                    follow(homotopy, &tracker, starts[waiting[k]].as_ref()?, stages)
                }
            }
        });
        for (i, end) in waiting.into_iter().zip(ends) {
            points[i] = end;
        }
        let doubtful = |i: usize| match &points[i] {
            None => starts[i].is_some(),
            Some(x) => (points.iter().enumerate())
                .any(|(j, y)| j != i && y.as_ref().is_some_and(|y| coordinates.same(x, y))),
        };
        waiting = (0..points.len()).filter(|&i| doubtful(i)).collect();
        if waiting.is_empty() || watch.is_stopped() {
            break;
        }
    }
    for i in waiting {
        points[i] = None;
    }
}

fn follow(
    homotopy: &mut ParameterHomotopy<'_>,
    tracker: &Tracker,
    from: &[C],
    stages: &mut Stages<'_>,
) -> Option<Vec<C>> {
    let mut x = from.to_vec();
    let whole = (C::from_f64(0.0), C::from_f64(1.0));
    let track = tracker.track(homotopy, whole, &mut x, stages);
    let end = whole.1;
    (track.arrival == Arrival::There && polish(homotopy, end, &mut x)).then_some(x)
}

/// Newton steps until the last digits; whether the point is a solution then.
pub(crate) fn polish(homotopy: &mut ParameterHomotopy<'_>, s: C, x: &mut [C]) -> bool {
    for _ in 0..4 {
        let step = homotopy.correct(s, x);
        if !step.is_finite() {
            return false;
        }
        if step < 1e-13 * (1.0 + size(x)) {
            break;
        }
    }
    homotopy.residual(s, x) <= 1e-10 * (1.0 + size(x).powi(2))
}
