//! Parameter homotopy from the generic member to the target inputs.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::along::repeated;
use super::homotopy::{END, ParameterHomotopy};
use super::lift::{Lift, reduced};
use super::path::{End, Path, arrived, follow};
use super::simple::{are_one, near};
use crate::analysis::assemblies::family::{
    C, Coordinates, Family, LegwiseSolutions, Member, learn, spanning_points,
};
use crate::solve::{Progress, Stage, Tracker, Watch, each};

/// Endpoints of all paths, and the work of tracking them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ends {
    pub ends: Vec<End>,
    /// Paths tracked, each once: fewer than ends where legs close apart from one another.
    pub paths: usize,
    pub steps: usize,
    pub retries: usize,
}

impl Ends {
    /// Number of paths that are lost or may come back from far out, and of those lost.
    fn undecided(&self) -> (usize, usize) {
        let count = |one: End| self.ends.iter().filter(|end| **end == one).count();
        let lost = count(End::Lost);
        (lost + count(End::Gone), lost)
    }
}

/// Tracks one path for each way of the leg that has most of them, for each pose; the other solutions
/// are combinations of their endpoints. A pose of which one endpoint is not regular has all its
/// solutions tracked.
///
/// If paths are undecided, all are tracked again along arcs through complex s. Paths not tracked when the
/// work was stopped count as lost.
pub(crate) fn track_to_target(
    family: &Family,
    from: &Member,
    to: &Member,
    legwise: &[LegwiseSolutions],
    watch: &Watch,
) -> Option<Ends> {
    let with_rods = tracked_with_rods(family, (from, to), legwise, watch);
    with_rods.or_else(|| ends_by(&WAYS, &family.homotopy(from, to)?, legwise, watch))
}

/// Paths tracked with rods in place of parts that are no more. `None` if there are none, or an end is not regular.
fn tracked_with_rods(
    family: &Family,
    (from, to): (&Member, &Member),
    legwise: &[LegwiseSolutions],
    watch: &Watch,
) -> Option<Ends> {
    let with_rods = family.reduced.as_ref()?.homotopy(from, to)?;
    let mut all = ends_by(&WAYS, &with_rods, &reduced(family, legwise), watch)?;
    let lift = Lift::new(family, to)?;
    let found = std::mem::take(&mut all.ends);
    let lifted = each(found.len(), &lift, |lift, k| match &found[k] {
        End::Regular(x) => {
            let points = lift.of(x)?.points(&family.coordinates).into_iter();
            Some(points.map(End::Regular).collect())
        }
        End::Infinite | End::Gone => Some(vec![found[k].clone(); family.ways()]),
        End::Singular(_) | End::Either(_) | End::Lost => None,
    });
    let lifted: Option<Vec<Vec<End>>> = lifted.into_iter().collect();
    all.ends = lifted?.concat();
    Some(all)
}

/// Bends of the ways that are tried one after the other.
pub(crate) const WAYS: [f64; 5] = [0.0, 0.4, -0.4, 0.8, -0.8];

/// The ends of all paths of a homotopy by the first of some ways that leaves none undecided, or the fewest.
pub(crate) fn ends_by(
    bends: &[f64],
    homotopy: &ParameterHomotopy<'_>,
    legwise: &[LegwiseSolutions],
    watch: &Watch,
) -> Option<Ends> {
    let followed = AtomicUsize::new(0);
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    for &bend in bends {
        let mut batch = PathBatch {
            homotopy,
            bend,
            care: if bend == 0.0 { 1.0 } else { 0.1 },
            followed: &followed,
            watch,
            storage: None,
        };
        let ends = batch.combined(legwise);
        retries += ends.retries;
        best = match best {
            Some(best) if best.undecided() <= ends.undecided() => Some(best),
            _ => Some(ends),
        };
        if watch.is_stopped() || best.as_ref().is_some_and(|best| best.undecided().0 == 0) {
            break;
        }
    }
    best.map(|best| Ends { retries, ..best })
}

/// Paths tracked together in the same manner.
struct PathBatch<'a, 'f> {
    homotopy: &'a ParameterHomotopy<'f>,
    /// Bend of the way to the side, through complex s.
    bend: f64,
    /// Factor of the corrections aimed at, relative to the usual ones.
    care: f64,
    /// Number of paths tracked, each as often as it was.
    followed: &'a AtomicUsize,
    watch: &'a Watch<'a>,
    /// For comparing endpoints that are near each other; most are not.
    storage: Option<ParameterHomotopy<'f>>,
}

impl PathBatch<'_, '_> {
    /// For paths that were tracked `level` times before.
    fn tracker(&self, level: i32) -> Tracker {
        let tracker = Tracker {
            largest: Tracker::default().largest * self.homotopy.reach(),
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

    fn combined(&mut self, legwise: &[LegwiseSolutions]) -> Ends {
        let coordinates = &self.homotopy.family.coordinates;
        let mut all = self.tracked(&spanning_points(legwise, coordinates));
        let shown = std::mem::take(&mut all.ends);
        let mut shown = shown.as_slice();
        let mut points: Vec<Vec<C>> = Vec::new();
        let mut combined: Vec<(&LegwiseSolutions, usize)> = Vec::new();
        let mut apart: Vec<Vec<C>> = Vec::new();
        for solutions in legwise {
            let (own, rest) = shown.split_at(solutions.spanning());
            shown = rest;
            if solutions.count() == solutions.spanning() {
                all.ends.extend_from_slice(own);
                continue;
            }
            match combinations(coordinates, solutions, own) {
                Some(mut combinations) => {
                    combined.push((solutions, combinations.len()));
                    points.append(&mut combinations);
                }
                None => apart.append(&mut solutions.points(coordinates)),
            }
        }
        let arrivals = each(points.len(), self.homotopy, |homotopy, i| {
            arrived(homotopy, &points[i])
        });
        let mut arrivals = arrivals.into_iter();
        for (solutions, count) in combined {
            // all of them are taken, whatever the first ones are
            let own: Vec<Option<End>> = arrivals.by_ref().take(count).collect();
            match own.into_iter().collect::<Option<Vec<End>>>() {
                Some(ends) => all.ends.extend(ends),
                None => apart.append(&mut solutions.points(coordinates)),
            }
        }
        if !apart.is_empty() {
            let more = self.tracked(&apart);
            all.ends.extend(more.ends);
            all.paths += more.paths;
            all.steps += more.steps;
            all.retries += more.retries;
        }
        // of paths that still share a regular endpoint only one can be right
        for i in 0..all.ends.len() {
            let (before, rest) = all.ends.split_at_mut(i);
            if self.any_is(&rest[0], before.iter()) {
                rest[0] = End::Lost;
            }
        }
        all
    }

    /// Tracks every solution, those that are lost or share an endpoint again with smaller steps.
    fn tracked(&mut self, solutions: &[Vec<C>]) -> Ends {
        let trackers = [0, 1, 2].map(|level| self.tracker(level));
        let (homotopy, bend, followed, watch) =
            (self.homotopy, self.bend, self.followed, self.watch);
        let before = followed.load(Ordering::Relaxed);
        let lost = Path {
            end: End::Lost,
            steps: 0,
        };
        let mut paths = vec![lost; solutions.len()];
        let track = |homotopy: &mut ParameterHomotopy<'_>, tracker: &Tracker, i: usize| {
            let now = Progress {
                done: followed.fetch_add(1, Ordering::Relaxed),
                ..Progress::of(Stage::Paths)
            };
            if watch.at(now).is_break() {
                return None;
            }
            let path = follow(homotopy, tracker, bend, &solutions[i], (watch, now));
            // one that was stopped on its way ends nowhere
            (!watch.is_stopped()).then_some(path)
        };
        repeated(homotopy, (&trackers, watch), &mut paths, track, |paths| {
            self.share_out(paths);
            self.doubtful(paths)
        });
        Ends {
            paths: paths.len(),
            steps: paths.iter().map(|path| path.steps).sum(),
            retries: followed.load(Ordering::Relaxed) - before - paths.len(),
            ends: paths.into_iter().map(|path| path.end).collect(),
        }
    }

    /// True if one of the ends is the same regular solution as the first one.
    fn any_is<'e>(&mut self, end: &End, mut others: impl Iterator<Item = &'e End>) -> bool {
        let End::Regular(x) = end else { return false };
        let near = near(x);
        others.any(|other| self.is(near, x, other))
    }

    /// True if an end is the solution `x`; `near` is the largest distance, from the size of `x`.
    fn is(&mut self, near: f64, x: &[C], end: &End) -> bool {
        let End::Regular(y) = end else { return false };
        self.homotopy.family.coordinates.within(near, x, y) && {
            let homotopy = self.storage.get_or_insert_with(|| self.homotopy.clone());
            are_one(homotopy, END, x, y)
        }
    }

    /// Gives each path that ends at either of two solutions one that no other path ends at.
    fn share_out(&mut self, paths: &mut [Path]) {
        for i in 0..paths.len() {
            if let End::Either(both) = paths[i].end.clone() {
                let mut both = both.into_iter().map(End::Regular);
                let free = both.find(|end| !self.any_is(end, paths.iter().map(|path| &path.end)));
                paths[i].end = free.unwrap_or(End::Lost);
            }
        }
    }

    /// Paths that were lost, and those that share a regular endpoint.
    fn doubtful(&mut self, paths: &[Path]) -> Vec<usize> {
        let mut doubtful: Vec<bool> = paths.iter().map(|path| path.end == End::Lost).collect();
        for (i, path) in paths.iter().enumerate() {
            let End::Regular(x) = &path.end else { continue };
            let near = near(x);
            for (j, other) in paths[..i].iter().enumerate() {
                if self.is(near, x, &other.end) {
                    (doubtful[i], doubtful[j]) = (true, true);
                }
            }
        }
        (0..paths.len()).filter(|&i| doubtful[i]).collect()
    }
}

/// All solutions with one pose from the endpoints that show every way of its legs. `None` if one of
/// these is not regular.
fn combinations(
    coordinates: &Coordinates,
    solutions: &LegwiseSolutions,
    ends: &[End],
) -> Option<Vec<Vec<C>>> {
    let mut tracked: Vec<LegwiseSolutions> = Vec::new();
    for end in ends {
        let End::Regular(x) = end else { return None };
        learn(&mut tracked, coordinates, x);
    }
    let [tracked] = tracked.as_slice() else {
        return None;
    };
    let ways = |of: &LegwiseSolutions| of.legs.iter().map(Vec::len).collect::<Vec<_>>();
    (ways(tracked) == ways(solutions)).then(|| tracked.points(coordinates))
}
