//! Carrying the generic solutions to the inputs that are asked for.

use super::coordinates::{C, Coordinates, size};
use super::family::{Family, Member};
use super::generic::polish;
use super::stances::{Stance, learn};
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

/// Ends of all paths, and what following them took.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    pub ends: Vec<End>,
    /// Paths followed, each once: fewer than ends where legs close apart from one another.
    pub paths: usize,
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

/// From the generic member to the asked one: one path for each way of the leg that has most of them,
/// for each pose. Where all of these end well the other solutions are combinations of what they show;
/// where one does not, every solution with that pose is followed by itself.
///
/// A path that is lost, or two that end at the same regular solution (one has jumped), are followed
/// again with greater care, and if that does not help all of them another way round.
pub(super) fn carry(
    family: &Family,
    from: &Member,
    to: &Member,
    stances: &[Stance<C>],
) -> Option<Ends> {
    let way = family.way(from, to)?;
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    for detour in 0..5 {
        // 0: the straight way; then arcs through complex s to either side
        let bend = [0.0, 0.4, -0.4, 0.8, -0.8][detour];
        let care = if detour == 0 { 1.0 } else { 0.1 };
        let ends = combined(&way, stances, &Manner { bend, care });
        retries += ends.retries;
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

/// How paths are followed.
struct Manner {
    /// How far the way is bent to the side, through complex s.
    bend: f64,
    /// The corrections aimed at, beside the usual ones.
    care: f64,
}

fn combined(way: &Way<'_>, stances: &[Stance<C>], manner: &Manner) -> Ends {
    let coordinates = &way.family.coordinates;
    let spanning = stances.iter().flat_map(|s| s.spanning_points(coordinates));
    let mut all = straight(way, &spanning.collect::<Vec<_>>(), manner);
    let shown = std::mem::take(&mut all.ends);
    let mut shown = shown.as_slice();
    let mut points: Vec<Vec<C>> = Vec::new();
    let mut combined: Vec<(&Stance<C>, usize)> = Vec::new();
    let mut apart: Vec<Vec<C>> = Vec::new();
    for stance in stances {
        let (of_stance, rest) = shown.split_at(stance.spanning());
        shown = rest;
        match combinations(coordinates, stance, of_stance) {
            _ if stance.count() == stance.spanning() => all.ends.extend_from_slice(of_stance),
            Some(mut combinations) => {
                combined.push((stance, combinations.len()));
                points.append(&mut combinations);
            }
            None => apart.append(&mut stance.points(coordinates)),
        }
    }
    let arrivals = threads::each(points.len(), way, |way, i| {
        arrived(way, Arrival::There, &points[i])
    });
    let mut arrivals = arrivals.into_iter();
    for (stance, count) in combined {
        let of_stance: Option<Vec<End>> = arrivals.by_ref().take(count).collect();
        match of_stance {
            Some(ends) => all.ends.extend(ends),
            None => apart.append(&mut stance.points(coordinates)),
        }
    }
    if !apart.is_empty() {
        let more = straight(way, &apart, manner);
        all.ends.extend(more.ends);
        all.paths += more.paths;
        all.steps += more.steps;
        all.evaluations += more.evaluations;
        all.retries += more.retries;
    }
    // of paths that still end at one regular solution only one can be right
    let mut kept: Vec<Vec<C>> = Vec::new();
    for end in &mut all.ends {
        if let End::Regular(x) = end {
            match kept.iter().any(|y| coordinates.same(x, y)) {
                true => *end = End::Lost,
                false => kept.push(x.clone()),
            }
        }
    }
    all
}

/// All solutions of a stance from the ends of the paths that show every way of its legs. `None` if
/// one of these ends is not a solution by itself.
fn combinations(
    coordinates: &Coordinates,
    stance: &Stance<C>,
    ends: &[End],
) -> Option<Vec<Vec<C>>> {
    let mut carried: Vec<Stance<C>> = Vec::new();
    for end in ends {
        let End::Regular(x) = end else { return None };
        learn(&mut carried, coordinates, x);
    }
    let [carried] = carried.as_slice() else {
        return None;
    };
    let ways = |stance: &Stance<C>| stance.legs.iter().map(Vec::len).collect::<Vec<_>>();
    (ways(carried) == ways(stance)).then(|| carried.points(coordinates))
}

/// Follows every solution, those that are lost or share an end again.
fn straight(way: &Way<'_>, solutions: &[Vec<C>], manner: &Manner) -> Ends {
    let coordinates = &way.family.coordinates;
    let careful = |level: i32| match manner.care * 0.1f64.powi(level) {
        1.0 => Tracker::default(),
        factor => Tracker::default().tightened(factor),
    };
    let mut all = Ends {
        ends: vec![End::Lost; solutions.len()],
        paths: solutions.len(),
        ..Ends::default()
    };
    let mut waiting: Vec<usize> = (0..solutions.len()).collect();
    for level in 0..3 {
        let tracker = careful(level);
        let followed = threads::each(waiting.len(), way, |way, k| {
            follow(way, &tracker, manner.bend, &solutions[waiting[k]])
        });
        for (i, f) in waiting.into_iter().zip(followed) {
            all.steps += f.steps;
            all.evaluations += f.evaluations;
            all.ends[i] = f.end;
        }
        waiting = doubtful(&all.ends, |x, y| coordinates.same(x, y));
        if waiting.is_empty() {
            break;
        }
        if level < 2 {
            all.retries += waiting.len();
        }
    }
    all
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
