//! Paths tracked again where they are in doubt, and solutions tracked along one edge of a monodromy graph.

use super::homotopy::{END, ParameterHomotopy, START};
use crate::analysis::assemblies::family::{C, size};
use crate::solve::{Arrival, Homotopy, Progress, Stages, Tracker, Watch, each};

/// Follows paths to their ends with one tracker after the other: first all of them, then those that are `doubtful` among all
/// ends, as are all that share one, because all but one have jumped. Returns those in doubt at last. A path that `follow` was
/// stopped on keeps its end.
pub(super) fn repeated<E: Clone + Send + Sync>(
    homotopy: &ParameterHomotopy<'_>,
    (trackers, watch): (&[Tracker], &Watch),
    ends: &mut [E],
    follow: impl Fn(&mut ParameterHomotopy<'_>, &Tracker, usize) -> Option<E> + Sync,
    mut doubtful: impl FnMut(&mut [E]) -> Vec<usize>,
) -> Vec<usize> {
    let mut waiting: Vec<usize> = (0..ends.len()).collect();
    for tracker in trackers {
        let found = each(waiting.len(), homotopy, |homotopy, k| {
            follow(homotopy, tracker, waiting[k])
        });
        for (i, end) in waiting.into_iter().zip(found) {
            ends[i] = end.unwrap_or_else(|| ends[i].clone());
        }
        waiting = doubtful(ends);
        if waiting.is_empty() || watch.is_stopped() {
            break;
        }
    }
    waiting
}

/// Tracks solutions from one end of an edge to the other; `None` for those that are lost.
pub(crate) fn tracked(
    homotopy: &ParameterHomotopy<'_>,
    starts: &[Vec<C>],
    (watch, now): (&Watch, Progress),
) -> Vec<Option<Vec<C>>> {
    let coordinates = &homotopy.family.coordinates;
    let plain = Tracker {
        // at special dimensions some solutions are thousands of characteristic lengths away for all inputs, and farther on the way
        largest: 1e6,
        ..Tracker::default()
    };
    let trackers = [plain.clone(), plain.tightened(0.1), plain.tightened(0.01)];
    let mut ends = vec![None; starts.len()];
    let follow = |homotopy: &mut ParameterHomotopy<'_>, tracker: &Tracker, i: usize| {
        let mut x = starts[i].clone();
        let stages = &mut Stages::new(coordinates.count(), (watch, now));
        let track = tracker.track(homotopy, (START, END), &mut x, stages);
        let arrived = track.arrival == Arrival::There && polish(homotopy, END, &mut x);
        Some(arrived.then_some(x))
    };
    let doubtful = |ends: &mut [Option<Vec<C>>]| {
        let shares = |i: usize, x: &[C]| {
            let mut others = ends.iter().enumerate().filter(|(j, _)| *j != i);
            others.any(|(_, y)| y.as_ref().is_some_and(|y| coordinates.same(x, y)))
        };
        let doubtful = |i: &usize| ends[*i].as_ref().is_none_or(|x| shares(*i, x));
        (0..ends.len()).filter(doubtful).collect()
    };
    let lost = repeated(homotopy, (&trackers, watch), &mut ends, follow, doubtful);
    lost.into_iter().for_each(|i| ends[i] = None);
    ends
}

/// Newton steps until the last digits; true if the point is a solution then.
pub(crate) fn polish(homotopy: &mut impl Homotopy, s: C, x: &mut [C]) -> bool {
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
