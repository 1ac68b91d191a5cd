//! Tracking the generic solutions to the target inputs.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::homotopy::ParameterHomotopy;
use super::path::{End, Path, arrived, follow};
use super::simple::{are_one, near};
use crate::analysis::assemblies::family::{
    C, Coordinates, Family, LegwiseSolutions, Member, learn,
};
use crate::number::Number;
use crate::solve::{Progress, Stage, Tracker, Watch};

/// Ends of all paths, and the work of following them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ends {
    pub ends: Vec<End>,
    /// Paths followed, each once: fewer than ends where legs close apart from one another.
    pub paths: usize,
    pub steps: usize,
    pub evaluations: usize,
    pub retries: usize,
}

/// From the generic member to the target member: one path for each way of the leg that has most of
/// them, for each pose. Where all of these end well the other solutions are combinations of what
/// they show; where one does not, every solution with that pose is followed separately.
///
/// A path that is lost, or two that end at the same regular solution (one has jumped), are followed
/// again with greater care, and if that does not help all of them another way round. Paths that
/// were not followed when the work was stopped count as lost.
pub(crate) fn track_to_target(
    family: &Family,
    from: &Member,
    to: &Member,
    legwise: &[LegwiseSolutions<C>],
    watch: &Watch,
) -> Option<Ends> {
    let homotopy = family.homotopy(from, to)?;
    let mut best: Option<Ends> = None;
    let mut retries = 0;
    let followed = AtomicUsize::new(0);
    for detour in 0..5 {
        // 0: the straight way; then arcs through complex s to either side
        let manner = Manner {
            bend: [0.0, 0.4, -0.4, 0.8, -0.8][detour],
            care: if detour == 0 { 1.0 } else { 0.1 },
            followed: (&followed, watch),
        };
        let ends = combined(&homotopy, legwise, &manner);
        retries += ends.retries;
        let lost = |ends: &Ends| ends.ends.iter().filter(|e| **e == End::Lost).count();
        let fewer = best.as_ref().is_none_or(|b| lost(&ends) < lost(b));
        if fewer {
            best = Some(ends);
        }
        if watch.is_stopped() || best.as_ref().is_some_and(|b| lost(b) == 0) {
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
    /// How many paths were followed, each as often as it was.
    followed: (&'a AtomicUsize, &'a Watch<'a>),
}

impl Manner<'_> {
    /// Counts a path that is to be followed; `None` if the work was stopped.
    fn goes_on(&self) -> Option<Progress> {
        let (followed, watch) = self.followed;
        let now = Progress {
            done: followed.fetch_add(1, Ordering::Relaxed),
            ..Progress::of(Stage::Paths)
        };
        watch.at(now).is_continue().then_some(now)
    }

    /// For paths followed again at a higher level.
    fn tracker(&self, homotopy: &ParameterHomotopy<'_>, level: i32) -> Tracker {
        let tracker = Tracker {
            largest: Tracker::default().largest * homotopy.reach(),
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

fn combined(
    homotopy: &ParameterHomotopy<'_>,
    legwise: &[LegwiseSolutions<C>],
    manner: &Manner<'_>,
) -> Ends {
    let coordinates = &homotopy.family.coordinates;
    let spanning = legwise.iter().flat_map(|s| s.spanning_points(coordinates));
    let mut all = straight(homotopy, &spanning.collect::<Vec<_>>(), manner);
    let shown = std::mem::take(&mut all.ends);
    let mut shown = shown.as_slice();
    let mut points: Vec<Vec<C>> = Vec::new();
    let mut combined: Vec<(&LegwiseSolutions<C>, usize)> = Vec::new();
    let mut apart: Vec<Vec<C>> = Vec::new();
    for solutions_at_pose in legwise {
        let (of_stance, rest) = shown.split_at(solutions_at_pose.spanning());
        shown = rest;
        if solutions_at_pose.count() == solutions_at_pose.spanning() {
            all.ends.extend_from_slice(of_stance);
            continue;
        }
        match combinations(coordinates, solutions_at_pose, of_stance) {
            Some(mut combinations) => {
                combined.push((solutions_at_pose, combinations.len()));
                points.append(&mut combinations);
            }
            None => apart.append(&mut solutions_at_pose.points(coordinates)),
        }
    }
    let arrivals = crate::solve::each(points.len(), homotopy, |homotopy, i| {
        arrived(homotopy, &points[i])
    });
    let mut arrivals = arrivals.into_iter();
    for (solutions_at_pose, count) in combined {
        // all of them are taken, whatever the first ones are
        let of_stance: Vec<Option<End>> = arrivals.by_ref().take(count).collect();
        match of_stance.into_iter().collect::<Option<Vec<End>>>() {
            Some(ends) => all.ends.extend(ends),
            None => apart.append(&mut solutions_at_pose.points(coordinates)),
        }
    }
    if !apart.is_empty() {
        let more = straight(homotopy, &apart, manner);
        all.ends.extend(more.ends);
        all.paths += more.paths;
        all.steps += more.steps;
        all.evaluations += more.evaluations;
        all.retries += more.retries;
    }
    told_apart(homotopy, &mut all.ends);
    all
}

/// All solutions of legwise solutions from the ends of the paths that show every way of its legs.
/// `None` if one of these ends is not a simple solution.
fn combinations(
    coordinates: &Coordinates,
    solutions_at_pose: &LegwiseSolutions<C>,
    ends: &[End],
) -> Option<Vec<Vec<C>>> {
    let mut tracked: Vec<LegwiseSolutions<C>> = Vec::new();
    for end in ends {
        let End::Regular(x) = end else { return None };
        learn(&mut tracked, coordinates, x);
    }
    let [tracked] = tracked.as_slice() else {
        return None;
    };
    let ways = |solutions_at_pose: &LegwiseSolutions<C>| {
        solutions_at_pose
            .legs
            .iter()
            .map(Vec::len)
            .collect::<Vec<_>>()
    };
    (ways(tracked) == ways(solutions_at_pose)).then(|| tracked.points(coordinates))
}

/// Follows every solution, those that are lost or share an end again.
fn straight(homotopy: &ParameterHomotopy<'_>, solutions: &[Vec<C>], manner: &Manner<'_>) -> Ends {
    let mut all = Ends {
        ends: vec![End::Lost; solutions.len()],
        paths: solutions.len(),
        ..Ends::default()
    };
    let mut waiting: Vec<usize> = (0..solutions.len()).collect();
    let mut unsure: Vec<usize> = Vec::new();
    for level in 0..=2 {
        let (tracker, bend) = (manner.tracker(homotopy, level), manner.bend);
        let followed: Vec<Option<Path>> =
            crate::solve::each(waiting.len(), homotopy, |homotopy, k| {
                let (now, watch) = (manner.goes_on()?, manner.followed.1);
                let from = &solutions[waiting[k]];
                let path = follow(homotopy, &tracker, bend, from, (watch, now));
                // one that was stopped on its way ends nowhere
                (!watch.is_stopped()).then_some(path)
            });
        for (&i, path) in waiting.iter().zip(followed) {
            let Some(path) = path else { continue };
            all.steps += path.steps;
            all.evaluations += path.evaluations;
            if path.unsure && level == 0 {
                unsure.push(i);
            }
            // a second attempt that finds nothing keeps the result of the first
            if path.end != End::Lost || !unsure.contains(&i) || level == 0 {
                all.ends[i] = path.end;
            }
        }
        shared_out(homotopy, &mut all.ends);
        if level == 2 || manner.followed.1.is_stopped() {
            break;
        }
        waiting = doubtful(homotopy, &all.ends);
        if level == 0 {
            waiting.extend(&unsure);
        }
        all.retries += waiting.len();
    }
    all
}

/// Decides whether ends of paths are one solution. Most are far apart, and then nothing is
/// evaluated.
struct Teller<'a, 'f> {
    homotopy: &'a ParameterHomotopy<'f>,
    storage: Option<ParameterHomotopy<'f>>,
}

impl<'a, 'f> Teller<'a, 'f> {
    fn new(homotopy: &'a ParameterHomotopy<'f>) -> Self {
        Teller {
            homotopy,
            storage: None,
        }
    }

    /// `near` is how far apart they may be, from the first one's size.
    fn one(&mut self, near: f64, x: &[C], y: &[C]) -> bool {
        self.homotopy.family.coordinates.within(near, x, y) && {
            let homotopy = self.storage.get_or_insert_with(|| self.homotopy.clone());
            are_one(homotopy, C::from_f64(1.0), x, y)
        }
    }
}

/// Gives each path that ends at either of two solutions one that no other path ends at.
fn shared_out(homotopy: &ParameterHomotopy<'_>, ends: &mut [End]) {
    let mut teller = Teller::new(homotopy);
    for i in 0..ends.len() {
        let End::Either(both) = ends[i].clone() else {
            continue;
        };
        let mut taken = |y: &Vec<C>| {
            let near = near(y);
            let mut regular = |end: &End| matches!(end, End::Regular(x) if teller.one(near, y, x));
            ends.iter().any(&mut regular)
        };
        let free = both.into_iter().find(|y| !taken(y));
        ends[i] = free.map_or(End::Lost, End::Regular);
    }
}

/// Paths that were lost, and those that share a regular end.
fn doubtful(homotopy: &ParameterHomotopy<'_>, ends: &[End]) -> Vec<usize> {
    let mut teller = Teller::new(homotopy);
    let mut doubtful: Vec<bool> = ends.iter().map(|end| *end == End::Lost).collect();
    for (i, end) in ends.iter().enumerate() {
        let End::Regular(x) = end else { continue };
        let near = near(x);
        for (j, other) in ends.iter().enumerate().take(i) {
            if matches!(other, End::Regular(y) if teller.one(near, x, y)) {
                (doubtful[i], doubtful[j]) = (true, true);
            }
        }
    }
    (0..ends.len()).filter(|&i| doubtful[i]).collect()
}

/// Of paths that still end at one regular solution only one can be right.
fn told_apart(homotopy: &ParameterHomotopy<'_>, ends: &mut [End]) {
    let mut teller = Teller::new(homotopy);
    for i in 0..ends.len() {
        let (before, rest) = ends.split_at_mut(i);
        let End::Regular(x) = &rest[0] else { continue };
        let near = near(x);
        let mut known = |end: &End| matches!(end, End::Regular(y) if teller.one(near, x, y));
        if before.iter().any(&mut known) {
            rest[0] = End::Lost;
        }
    }
}
