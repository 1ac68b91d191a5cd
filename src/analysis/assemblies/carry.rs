//! Carrying the generic solutions to the inputs that are asked for.

use std::cell::Cell;

use super::coordinates::{C, Coordinates};
use super::family::{Family, Member};
use super::generic::Progress;
use super::local::Local;
use super::path::{End, NEAR_MEETING, Path, arrived, follow};
use super::stances::{Stance, count, learn};
use super::way::Way;
use crate::number::Number;
use crate::solve::Tracker;

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

/// Two paths that end at the same solution with a smaller quotient of pivots than this end at two
/// solutions nearer to each other than can be told.
const NEARLY_SINGULAR: f64 = 1e-4;
/// Paths between two words about how far it is.
const BATCH: usize = 64;

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
    watch: &dyn Fn(Progress),
) -> Option<Ends> {
    let way = family.way(from, to)?;
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    let (found, followed) = (count(stances), Cell::new(0));
    let tell = |more: usize| {
        followed.set(followed.get() + more);
        watch(Progress {
            found,
            seeds: 0,
            loops: 0,
            followed: followed.get(),
        });
    };
    for detour in 0..5 {
        // 0: the straight way; then arcs through complex s to either side
        let manner = Manner {
            bend: [0.0, 0.4, -0.4, 0.8, -0.8][detour],
            care: if detour == 0 { 1.0 } else { 0.1 },
            tell: &tell,
        };
        let ends = combined(&way, stances, &manner);
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
struct Manner<'a> {
    /// How far the way is bent to the side, through complex s.
    bend: f64,
    /// The corrections aimed at, beside the usual ones.
    care: f64,
    /// Hears of paths that were followed.
    tell: &'a dyn Fn(usize),
}

impl Manner<'_> {
    /// For paths followed again at a higher level.
    fn tracker(&self, way: &Way<'_>, level: i32) -> Tracker {
        let tracker = Tracker {
            largest: Tracker::default().largest * way.reach(),
            ..Tracker::default()
        };
        match self.care * 0.1f64.powi(level) {
            1.0 => tracker,
            factor if level < 2 => tracker.tightened(factor),
            // solutions that pass each other at a distance d leave steps of d²
            factor => Tracker {
                shortest: 1e-14,
                ..tracker.tightened(factor)
            },
        }
    }
}

fn combined(way: &Way<'_>, stances: &[Stance<C>], manner: &Manner<'_>) -> Ends {
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
        if stance.count() == stance.spanning() {
            all.ends.extend_from_slice(of_stance);
            continue;
        }
        match combinations(coordinates, stance, of_stance) {
            Some(mut combinations) => {
                combined.push((stance, combinations.len()));
                points.append(&mut combinations);
            }
            None => apart.append(&mut stance.points(coordinates)),
        }
    }
    let arrivals = crate::solve::each(points.len(), way, |way, i| arrived(way, &points[i]));
    let mut arrivals = arrivals.into_iter();
    for (stance, count) in combined {
        // all of them are taken, whatever the first ones are
        let of_stance: Vec<Option<End>> = arrivals.by_ref().take(count).collect();
        match of_stance.into_iter().collect::<Option<Vec<End>>>() {
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
    told_apart(way, &mut all.ends);
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
fn straight(way: &Way<'_>, solutions: &[Vec<C>], manner: &Manner<'_>) -> Ends {
    let coordinates = &way.family.coordinates;
    let mut all = Ends {
        ends: vec![End::Lost; solutions.len()],
        paths: solutions.len(),
        ..Ends::default()
    };
    let mut waiting: Vec<usize> = (0..solutions.len()).collect();
    for level in 0..=2 {
        let (tracker, bend) = (manner.tracker(way, level), manner.bend);
        for batch in waiting.chunks(BATCH) {
            let followed: Vec<Path> = crate::solve::each(batch.len(), way, |way, k| {
                follow(way, &tracker, bend, &solutions[batch[k]])
            });
            (manner.tell)(batch.len());
            for (&i, path) in batch.iter().zip(followed) {
                all.steps += path.steps;
                all.evaluations += path.evaluations;
                all.ends[i] = path.end;
            }
        }
        if level == 2 {
            break;
        }
        waiting = doubtful(&all.ends, |x, y| coordinates.same(x, y));
        all.retries += waiting.len();
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

/// Of paths that still end at one regular solution only one can be right, unless several solutions
/// are there that cannot be told apart.
fn told_apart(way: &Way<'_>, ends: &mut [End]) {
    let coordinates = &way.family.coordinates;
    let mut at_end = way.clone();
    let singular = |i: usize, ends: &[End]| match &ends[i] {
        End::Singular(y) => Some(y.clone()),
        _ => None,
    };
    // the last digits may take one of two paths to where both meet and the other past it
    for i in 0..ends.len() {
        let Some(y) = singular(i, ends) else {
            continue;
        };
        let at_y = |x: &[C]| coordinates.difference(x, &y) < NEAR_MEETING;
        let alone = (0..ends.len()).all(|k| k == i || singular(k, ends).is_none_or(|x| !at_y(&x)));
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
}
