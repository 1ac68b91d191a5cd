//! Carrying the generic solutions to the inputs that are asked for.

use super::coordinates::{C, size};
use super::family::{Family, Member};
use super::generic::polish;
use super::threads;
use super::way::Way;
use crate::number::Number;
use crate::solve::{Arrival, Ending, Homotopy, Stages, Tracker, ending};

/// Where one path ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// A solution by itself.
    Regular(Vec<C>),
    /// A solution where several meet, or that is not isolated.
    Singular(Vec<C>),
    Infinite,
    Lost,
}

/// Ends of all paths, and how often they had to be followed.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    pub ends: Vec<End>,
    pub steps: usize,
    pub evaluations: usize,
    pub retries: usize,
}

/// Beside the largest pivot a smaller one than this means that solutions meet.
const SINGULAR: f64 = 1e-6;
/// Solutions larger than this count as infinite: rounding errors of ε in the dimensions bring a
/// solution that is m-fold at infinity back to ε^(−1/m), some 1e4 for m = 4.
const FAR: f64 = 1e3;
/// Where the endgame starts, as distance from the end of the way.
const NEAR_END: f64 = 0.03;

struct Followed {
    end: End,
    steps: usize,
    evaluations: usize,
}

/// As many paths as solutions, from the generic member to the asked one.
///
/// A path that is lost, or two that end at the same regular solution (one has jumped), are followed
/// again with greater care, and if that does not help all of them another way round.
pub(super) fn carry(
    family: &Family,
    from: &Member,
    to: &Member,
    solutions: &[Vec<C>],
) -> Option<Ends> {
    let way = family.way(from, to)?;
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    for detour in 0..5 {
        // 0: the straight way; then arcs through complex s to either side
        let bend = [0.0, 0.4, -0.4, 0.8, -0.8][detour];
        let first = if detour == 0 { 1.0 } else { 0.1 };
        let mut ends = straight(&way, solutions, bend, first, &mut retries);
        ends.retries = retries;
        let lost = |ends: &Ends| ends.ends.iter().filter(|e| **e == End::Lost).count();
        let fewer = best.as_ref().is_none_or(|b| lost(&ends) < lost(b));
        if fewer {
            best = Some(ends);
        }
        if best.as_ref().is_some_and(|b| lost(b) == 0) {
            break;
        }
    }
    if let Some(best) = &mut best {
        best.retries = retries;
    }
    best
}

fn straight(
    way: &Way<'_>,
    solutions: &[Vec<C>],
    bend: f64,
    care: f64,
    retries: &mut usize,
) -> Ends {
    let coordinates = &way.family.coordinates;
    let careful = |level: i32| match care * 0.1f64.powi(level) {
        1.0 => Tracker::default(),
        factor => Tracker::default().tightened(factor),
    };
    let tracker = careful(0);
    let followed = threads::each(solutions.len(), way, |way, i| {
        follow(way, &tracker, bend, &solutions[i])
    });
    let (mut steps, mut evaluations) = (0, 0);
    for f in &followed {
        steps += f.steps;
        evaluations += f.evaluations;
    }
    let mut ends: Vec<End> = followed.into_iter().map(|f| f.end).collect();
    for level in 1..=2 {
        let again = doubtful(&ends, |x, y| coordinates.same(x, y));
        if again.is_empty() {
            break;
        }
        *retries += again.len();
        let tracker = careful(level);
        let followed = threads::each(again.len(), way, |way, k| {
            follow(way, &tracker, bend, &solutions[again[k]])
        });
        for (i, f) in again.into_iter().zip(followed) {
            steps += f.steps;
            evaluations += f.evaluations;
            ends[i] = f.end;
        }
    }
    // of paths that still end at one regular solution only one can be right
    let mut kept: Vec<Vec<C>> = Vec::new();
    for end in &mut ends {
        if let End::Regular(x) = end {
            match kept.iter().any(|y| coordinates.same(x, y)) {
                true => *end = End::Lost,
                false => kept.push(x.clone()),
            }
        }
    }
    Ends {
        ends,
        steps,
        evaluations,
        retries: 0,
    }
}

/// Paths that were lost, and those that share a regular end.
fn doubtful(ends: &[End], same: impl Fn(&[C], &[C]) -> bool) -> Vec<usize> {
    let regular = |i: usize| match &ends[i] {
        End::Regular(x) => Some(x),
        _ => None,
    };
    let shared = |i: usize| {
        regular(i).is_some_and(|x| {
            (0..ends.len()).any(|j| j != i && regular(j).is_some_and(|y| same(x, y)))
        })
    };
    (0..ends.len())
        .filter(|&i| ends[i] == End::Lost || shared(i))
        .collect()
}

fn follow(way: &mut Way<'_>, tracker: &Tracker, bend: f64, from: &[C]) -> Followed {
    let (start, end) = (C::from_f64(0.0), C::from_f64(1.0));
    let mut stages = Stages::new(from.len());
    let (mut steps, mut evaluations) = (0, 0);
    let mut x = from.to_vec();
    let mut leg = |way: &mut Way<'_>, x: &mut Vec<C>, stages: &mut Stages, a: C, b: C| {
        let track = tracker.track(way, (a, b), x, stages);
        steps += track.steps;
        evaluations += track.evaluations;
        track.arrival
    };
    let mut from_here = start;
    let mut arrival = Arrival::There;
    if bend != 0.0 {
        for corner in [C::new(0.3, bend), C::new(0.8, bend)] {
            if arrival == Arrival::There {
                arrival = leg(way, &mut x, &mut stages, from_here, corner);
                from_here = corner;
            }
        }
    }
    let corner = x.clone();
    let found = match arrival {
        Arrival::There => {
            arrival = leg(way, &mut x, &mut stages, from_here, end);
            arrived(way, arrival, &x)
        }
        _ => None,
    };
    let end = found.unwrap_or_else(|| {
        // an end that is not regular: stop short of it and go round
        let mut x = corner;
        let short = C::from_f64(1.0 - NEAR_END);
        match leg(way, &mut x, &mut stages, from_here, short) {
            Arrival::There => go_round(way, tracker, &x, &mut stages),
            Arrival::Diverged(_) => End::Infinite,
            Arrival::Stuck(_) => End::Lost,
        }
    });
    Followed {
        end,
        steps,
        evaluations,
    }
}

fn arrived(way: &mut Way<'_>, arrival: Arrival, x: &[C]) -> Option<End> {
    let end = C::from_f64(1.0);
    let mut x = x.to_vec();
    if arrival != Arrival::There || size(&x) > FAR || !polish(way, end, &mut x) {
        return None;
    }
    is_regular(way, &x).then_some(End::Regular(x))
}

/// Pivots of solutions far out are small beside the largest as the inverse square of their size,
/// without others being near.
fn is_regular(way: &mut Way<'_>, x: &[C]) -> bool {
    let out = (size(x) / 30.0).max(1.0);
    way.regularity(C::from_f64(1.0), x) > SINGULAR / (out * out)
}

fn go_round(way: &mut Way<'_>, tracker: &Tracker, x: &[C], stages: &mut Stages) -> End {
    match ending(way, tracker, x, NEAR_END, stages) {
        Ending::Finite { mut x, winding } => {
            way.family.coordinates.settle(&mut x);
            let end = C::from_f64(1.0);
            let mut refined = x.clone();
            let near = |way: &Way<'_>, y: &[C]| {
                way.family.coordinates.difference(&x, y) < 1e-6 * size(y).max(1.0)
            };
            if winding == 1
                && polish(way, end, &mut refined)
                && near(way, &refined)
                && is_regular(way, &refined)
                && size(&refined) <= FAR
            {
                return End::Regular(refined);
            }
            if size(&x) > FAR {
                return End::Infinite;
            }
            match way.residual(end, &x) < 1e-6 {
                true => End::Singular(x),
                false => End::Lost,
            }
        }
        Ending::Infinite => End::Infinite,
        Ending::Undecided { x } if size(&x) > FAR => End::Infinite,
        Ending::Undecided { .. } => End::Lost,
    }
}
