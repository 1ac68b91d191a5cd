//! Carrying the generic solutions to the inputs that are asked for.

use std::cell::Cell;

use super::coordinates::{C, size};
use super::family::{Family, Member};
use super::generic::{Progress, polish};
use super::local::Local;
use super::simple::{SETTLED, steepness};
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
const SINGULAR: f64 = 1e-7;
/// Two paths that end at the same solution with a smaller quotient of pivots than this end at two
/// solutions nearer to each other than can be told.
const NEARLY_SINGULAR: f64 = 1e-4;
/// The residual up to which solutions meet: what Newton's method calls solved. Where more is left
/// they pass each other.
const MEETING: f64 = 1e-12;
/// Rounding beside the square of the size of a solution.
const ROUNDING: f64 = 1e-15;
/// Solutions larger than this count as infinite: rounding errors of ε in the dimensions bring a
/// solution that is m-fold at infinity back to ε^(−1/m), some 1e4 for m = 4. Held lengths beyond the
/// characteristic length reach as much further.
const FAR: f64 = 1e3;
/// Where the endgame starts, as distance from the end of the way.
const NEAR_END: f64 = 0.03;

/// How far apart two solutions may be that leave a residual of [`MEETING`] half way between them.
const NEAR_MEETING: f64 = 2e-5;
/// Paths between two words about how far it is.
const BATCH: usize = 64;

/// Ways longer than this, in rad or characteristic lengths, are gone in parts.
const LONG: f64 = 10.0;

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
    watch: &dyn Fn(Progress),
) -> Option<Ends> {
    let way = family.way(from, to)?;
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    let followed = Cell::new(0);
    let tell = |more: usize| {
        followed.set(followed.get() + more);
        watch(Progress {
            found: solutions.len(),
            seeds: 0,
            loops: 0,
            followed: followed.get(),
        });
    };
    for detour in 0..5 {
        // 0: the straight way; then arcs through complex s to either side
        let bend = [0.0, 0.4, -0.4, 0.8, -0.8][detour];
        let first = if detour == 0 { 1.0 } else { 0.1 };
        let mut ends = straight(&way, solutions, (bend, first), &mut retries, &tell);
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
    (bend, care): (f64, f64),
    retries: &mut usize,
    tell: &dyn Fn(usize),
) -> Ends {
    let coordinates = &way.family.coordinates;
    let careful = |level: i32| {
        let tracker = Tracker {
            largest: Tracker::default().largest * way.reach(),
            ..Tracker::default()
        };
        match care * 0.1f64.powi(level) {
            1.0 => tracker,
            factor if level < 2 => tracker.tightened(factor),
            // solutions that pass each other at a distance d leave steps of d²
            factor => Tracker {
                shortest: 1e-14,
                ..tracker.tightened(factor)
            },
        }
    };
    let all: Vec<usize> = (0..solutions.len()).collect();
    let several = |which: &[usize], tracker: &Tracker| -> Vec<Followed> {
        let batches = which.chunks(BATCH).flat_map(|batch| {
            let followed = threads::each(batch.len(), way, |way, k| {
                follow(way, tracker, bend, &solutions[batch[k]])
            });
            tell(batch.len());
            followed
        });
        batches.collect()
    };
    let followed = several(&all, &careful(0));
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
        let followed = several(&again, &careful(level));
        for (i, f) in again.into_iter().zip(followed) {
            steps += f.steps;
            evaluations += f.evaluations;
            ends[i] = f.end;
        }
    }
    // of paths that still end at one regular solution only one can be right, unless several
    // solutions are there that cannot be told apart
    let mut at_end = way.clone();
    let singular = |i: usize, ends: &[End]| match &ends[i] {
        End::Singular(y) => Some(y.clone()),
        _ => None,
    };
    // the last digits may take one of two paths to where both meet and the other past it
    for i in 0..ends.len() {
        let Some(y) = singular(i, &ends) else {
            continue;
        };
        let at_y = |x: &[C]| coordinates.difference(x, &y) < NEAR_MEETING;
        let alone = (0..ends.len()).all(|k| k == i || singular(k, &ends).is_none_or(|x| !at_y(&x)));
        for end in ends.iter_mut().filter(|_| alone) {
            if let End::Regular(x) = end
                && at_y(x)
                && at_end.regularity(C::from_f64(1.0), x) < NEARLY_SINGULAR
            {
                *end = End::Singular(y.clone());
            }
        }
    }
    let mut kept: Vec<usize> = Vec::new();
    for i in 0..ends.len() {
        let End::Regular(x) = &ends[i] else { continue };
        let other = kept.iter().copied().find(|&k| match &ends[k] {
            End::Regular(y) | End::Singular(y) => coordinates.same(x, y),
            End::Infinite | End::Lost => false,
        });
        match other {
            None => kept.push(i),
            Some(other) if at_end.regularity(C::from_f64(1.0), x) < NEARLY_SINGULAR => {
                let x = Local::new(&mut at_end, false).refined(x);
                ends[i] = End::Singular(x.clone());
                ends[other] = End::Singular(x);
            }
            Some(_) => ends[i] = End::Lost,
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
    // a long way is gone in parts, each ten times as long as all before it
    let decades = (way.length() / LONG).log10().ceil().clamp(0.0, 12.0) as i32;
    let mut corners: Vec<C> = (1..=decades)
        .rev()
        .map(|k| C::new(1.0, bend) * 0.1f64.powi(k))
        .collect();
    if bend != 0.0 {
        corners.extend([C::new(0.3, bend), C::new(0.8, bend)]);
    }
    for corner in corners {
        if arrival == Arrival::There {
            arrival = leg(way, &mut x, &mut stages, from_here, corner);
            from_here = corner;
        }
    }
    let far = FAR * way.reach();
    let corner = x.clone();
    let found = match arrival {
        Arrival::There => {
            arrival = leg(way, &mut x, &mut stages, from_here, end);
            arrived(way, arrival, far, &x)
        }
        // a corner of the way is no special place: only what is far out cannot get there, and does
        // not come back on a way as long as all before it
        Arrival::Diverged(_) => Some(End::Infinite),
        Arrival::Stuck(_) if decades > 0 && size(&x) > FAR => Some(End::Infinite),
        Arrival::Stuck(_) => Some(End::Lost),
    };
    let end = found.unwrap_or_else(|| {
        // an end that is not regular: stop short of it and go round
        let mut x = corner;
        let short = C::from_f64(1.0 - NEAR_END);
        match leg(way, &mut x, &mut stages, from_here, short) {
            Arrival::There => go_round(way, tracker, far, &x, &mut stages),
            Arrival::Diverged(_) => End::Infinite,
            Arrival::Stuck(_) if decades > 0 && size(&x) > FAR => End::Infinite,
            Arrival::Stuck(_) => End::Lost,
        }
    });
    Followed {
        end,
        steps,
        evaluations,
    }
}

fn arrived(way: &mut Way<'_>, arrival: Arrival, far: f64, x: &[C]) -> Option<End> {
    let mut x = x.to_vec();
    (arrival == Arrival::There && size(&x) <= far && settles(way, &mut x))
        .then_some(End::Regular(x))
}

/// Newton's method converges there as it does at a solution by itself, and the Jacobian is regular.
fn settles(way: &mut Way<'_>, x: &mut [C]) -> bool {
    let end = C::from_f64(1.0);
    if !polish(way, end, x) {
        return false;
    }
    let step = way.correct(end, &mut x.to_vec());
    step < SETTLED * (1.0 + size(x)) * steepness(x)
        && way.regularity(end, x) > SINGULAR / steepness(x)
}

fn go_round(way: &mut Way<'_>, tracker: &Tracker, far: f64, x: &[C], stages: &mut Stages) -> End {
    match ending(way, tracker, x, NEAR_END, stages) {
        Ending::Finite { mut x, winding } => {
            way.family.coordinates.settle(&mut x);
            let end = C::from_f64(1.0);
            let mut refined = x.clone();
            let near = |way: &Way<'_>, y: &[C]| {
                way.family.coordinates.difference(&x, y) < 1e-6 * size(y).max(1.0)
            };
            if winding == 1
                && settles(way, &mut refined)
                && near(way, &refined)
                && size(&refined) <= far
            {
                return End::Regular(refined);
            }
            if size(&x) > far {
                return End::Infinite;
            }
            let x = Local::new(way, false).refined(&x);
            match way.residual(end, &x) <= MEETING.max(ROUNDING * size(&x).powi(2)) {
                true => End::Singular(x),
                false => End::Lost,
            }
        }
        Ending::Infinite => End::Infinite,
        Ending::Undecided { x } if size(&x) > far => End::Infinite,
        Ending::Undecided { .. } => End::Lost,
    }
}
