//! Walking on the branches through a singular configuration.

use rand::Rng;

use super::super::MobilitySettings;
use super::super::cone::{Cone, combination};
use super::{is_regular, see};
use crate::linear::{dot, norm, orthonormal, remove};
use crate::mechanism::Configuration;
use crate::system::{Neighbourhood, Tangent};

/// The same beside a singular configuration, over the length of the step: shaky freedoms have slack.
const MOVED_ON_A_BRANCH: f64 = 1e-3;

/// Branches whose tangents beside the meeting point differ by less than this are one, seen at two
/// points of a curve.
const SAME_BRANCH: f64 = 0.15;

/// Adds the branch that a small step along a direction settles on, if it does.
pub(super) fn explore(
    near: &mut Neighbourhood,
    own: &[bool],
    tangent: &Tangent,
    direction: &[f64],
    settings: &MobilitySettings,
    seen: &mut Vec<Seen>,
    rng: &mut impl Rng,
) {
    let reach = settings.branch_step;
    if let Some((mut at, way)) = arrive(near, tangent, direction, reach) {
        // too near the meeting point a motion of high order looks finite
        let distance = norm(&near.system().difference(&tangent.at, &at));
        if distance < 0.5 * reach
            && let Some((further, _)) = arrive(near, tangent, &way, reach)
        {
            at = further;
        }
        let beside = near.tangent(at).within(own);
        look(near, own, tangent, beside, settings, seen, rng);
    }
}

/// Directions that are worth a try: some on the quadratic cone, some between the basis vectors,
/// and along each of them both ways. Each is made when it is asked for: seldom are all needed.
pub(super) struct Directions {
    /// Tries on the cone that are left.
    on_cone: usize,
    /// Tries between the basis vectors if none on the cone succeeds; on the cone alone `None`.
    between: Option<usize>,
    /// How many were made on the cone, between the basis vectors, and along these.
    made: [usize; 3],
}

impl Directions {
    pub fn new(cone: &Cone, at: &Tangent, trials: usize) -> Self {
        Directions {
            between: Some(trials * at.motions.len()),
            ..Directions::on_cone(cone, at, trials)
        }
    }

    /// Those on the quadratic cone alone; none where second order excludes nothing.
    pub fn on_cone(cone: &Cone, at: &Tangent, trials: usize) -> Self {
        let n = at.motions.len();
        Directions {
            on_cone: if n < 2 || cone.is_all() {
                0
            } else {
                trials * n
            },
            between: None,
            made: [0; 3],
        }
    }

    pub fn next(&mut self, cone: &Cone, at: &Tangent, rng: &mut impl Rng) -> Option<Vec<f64>> {
        let basis = &at.motions;
        while self.on_cone > 0 {
            self.on_cone -= 1;
            if let Some(direction) = cone.direction(basis, rng) {
                self.made[0] += 1;
                return Some(direction);
            }
        }
        let most = match (basis.len(), self.made[0]) {
            (..2, _) => 0,
            (_, 0) => self.between?,
            // none should be needed: every motion starts on the cone
            (n, _) => self.between.map(|_| n)?,
        };
        if self.made[1] < most {
            self.made[1] += 1;
            return Some(combination(basis, rng));
        }
        let enough = self.made[0] + self.made[1] > basis.len() && !cone.is_all();
        self.between.filter(|_| !enough)?;
        let motion = basis.get(self.made[2] / 2)?;
        let sign = if self.made[2].is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        self.made[2] += 1;
        Some(motion.iter().map(|x| sign * x).collect())
    }
}

/// A branch seen at a point of it that lies on no other.
pub(super) struct Seen {
    /// The tangent there; the motions are those of the branch, of which there may be fewer than
    /// infinitesimal ones.
    beside: Tangent,
    /// Whether every infinitesimal freedom there is finite.
    pub regular: bool,
    pub moved: Vec<bool>,
}

impl Seen {
    fn agrees(&self, other: &Tangent) -> bool {
        same(&self.beside.motions, &other.motions, SAME_BRANCH)
    }

    fn see(&mut self, near: &Neighbourhood, from: &Tangent, at: &Tangent, reach: f64) {
        let way = near.system().difference(&from.at, &at.at);
        see(&mut self.moved, &way, MOVED_ON_A_BRANCH * reach);
    }
}

/// Whether two orthonormal bases span the same but for angles of this sine.
pub(super) fn same(a: &[Vec<f64>], b: &[Vec<f64>], sine: f64) -> bool {
    a.len() == b.len() && contains(a, b, sine)
}

/// Whether an orthonormal basis spans the vectors of another but for angles of this sine.
pub(super) fn contains(space: &[Vec<f64>], vectors: &[Vec<f64>], sine: f64) -> bool {
    vectors.iter().all(|vector| {
        let mut out = vector.clone();
        remove(&mut out, space);
        norm(&out) < sine
    })
}

/// Adds the branch on which a point lies, looked at where it lies on no other: at a point where all
/// infinitesimal freedoms are finite, which is moved on to if need be.
fn look(
    near: &mut Neighbourhood,
    own: &[bool],
    from: &Tangent,
    point: Tangent,
    settings: &MobilitySettings,
    seen: &mut Vec<Seen>,
    rng: &mut impl Rng,
) {
    let reach = settings.branch_step;
    let step = 0.3 * reach;
    if point.motions.is_empty() {
        return;
    }
    let mut points = vec![point];
    for _ in 0..=settings.branch_trials {
        let Some(last) = points.last() else { return };
        let known = |seen: &&mut Seen| seen.regular && seen.agrees(last);
        if let Some(known) = seen.iter_mut().find(known) {
            known.see(near, from, last, reach);
            return;
        }
        if is_regular(near, last, reach, 3, rng) {
            let beside = last.clone();
            return add(near, from, beside, true, reach, seen);
        }
        // on from where the fewest motions were seen
        let Some(least) = points.iter().min_by_key(|point| point.motions.len()) else {
            return;
        };
        let direction = combination(&least.motions, rng);
        if let Some((at, _)) = arrive(near, least, &direction, step) {
            points.push(near.tangent(at).within(own));
        }
    }
    // shaky wherever it was seen
    let least = points.into_iter().min_by_key(|point| point.motions.len());
    if let Some(mut least) = least {
        let cone = Cone::of(near, &least);
        let mut directions = Directions::new(&cone, &least, settings.branch_trials);
        let mut ways: Vec<Vec<f64>> = Vec::new();
        while let Some(direction) = directions.next(&cone, &least, rng) {
            ways.extend(arrive(near, &least, &direction, step).map(|(_, way)| way));
        }
        least.motions = orthonormal(&ways, 0.1);
        if !least.motions.is_empty() && fills(near, &least, step, rng) {
            add(near, from, least, false, reach, seen);
        }
    }
}

/// Whether steps in the span of the motions arrive where they aim: where branches meet they fall
/// to one or the other.
pub(super) fn fills(near: &mut Neighbourhood, at: &Tangent, step: f64, rng: &mut impl Rng) -> bool {
    const TRIALS: usize = 6;
    const ALONG: f64 = 0.95;
    at.motions.len() == 1
        || (0..TRIALS).all(|_| {
            let direction = combination(&at.motions, rng);
            let arrived = arrive(near, at, &direction, step);
            arrived.is_some_and(|(_, way)| dot(&way, &direction) > ALONG)
        })
}

fn add(
    near: &Neighbourhood,
    from: &Tangent,
    beside: Tangent,
    regular: bool,
    reach: f64,
    seen: &mut Vec<Seen>,
) {
    let known = |seen: &&mut Seen| seen.regular == regular && seen.agrees(&beside);
    if let Some(known) = seen.iter_mut().find(known) {
        return known.see(near, from, &beside, reach);
    }
    let mut new = Seen {
        moved: vec![false; beside.columns()],
        beside: beside.clone(),
        regular,
    };
    new.see(near, from, &beside, reach);
    for motion in &beside.motions {
        see(&mut new.moved, motion, MOVED_ON_A_BRANCH);
    }
    seen.push(new);
}

/// The motions of a branch at the meeting point: the limit of its tangents on the way there, by
/// extrapolation.
pub(super) fn there(
    near: &mut Neighbourhood,
    own: &[bool],
    tangent: &Tangent,
    seen: &Seen,
) -> Vec<Vec<f64>> {
    const LEVELS: i32 = 4;
    let basis = &seen.beside.motions;
    let mut way = near.system().difference(&tangent.at, &seen.beside.at);
    remove(&mut way, &tangent.idle);
    let distance = norm(&way);
    // distances and the branch's motions there, as parts of the same basis
    let mut levels: Vec<(f64, Vec<Vec<f64>>)> = vec![];
    for level in 0..LEVELS {
        let factor = 0.5f64.powi(level);
        let step: Vec<f64> = way.iter().map(|x| x * factor).collect();
        let start = near.system().displaced(&tangent.at, &step);
        let Some(at) = near.settle(start, factor * distance) else {
            break;
        };
        let mut back = near.system().difference(&tangent.at, &at);
        remove(&mut back, &tangent.idle);
        let along = dot(&back, &way) / (distance * distance);
        if !(0.5 * factor..2.0 * factor).contains(&along) {
            break;
        }
        if seen.regular {
            let there = near.tangent(at).within(own);
            if there.motions.len() != basis.len() {
                break;
            }
            let part = |motion: &Vec<f64>| {
                let mut out = motion.clone();
                remove(&mut out, &there.motions);
                motion.iter().zip(out).map(|(m, o)| m - o).collect()
            };
            levels.push((along, basis.iter().map(part).collect()));
        } else if basis.len() == 1 {
            // the tangent is not known apart from shaky motions, but the chord is
            let length = norm(&back);
            levels.push((along, vec![back.iter().map(|x| x / length).collect()]));
        }
    }
    let mut limit = match levels.is_empty() {
        true => basis.clone(),
        false => vec![vec![0.0; way.len()]; basis.len()],
    };
    for (i, (own, motions)) in levels.iter().enumerate() {
        let others = levels.iter().enumerate().filter(|(j, _)| *j != i);
        let weight: f64 = others
            .map(|(_, (other, _))| other / (other - own))
            .product();
        for (limit, motion) in limit.iter_mut().zip(motions) {
            limit
                .iter_mut()
                .zip(motion)
                .for_each(|(l, m)| *l += weight * m);
        }
    }
    // every finite motion starts along an infinitesimal one
    for motion in &mut limit {
        let mut out = motion.clone();
        remove(&mut out, &tangent.motions);
        motion.iter_mut().zip(out).for_each(|(m, o)| *m -= o);
    }
    let found = orthonormal(&limit, 0.1);
    match found.len() == basis.len() {
        true => found,
        false => basis.clone(),
    }
}

/// An assembled configuration that a small step settles on, with the unit direction to it; `None`
/// if it comes back or runs away.
fn arrive(
    near: &mut Neighbourhood,
    from: &Tangent,
    direction: &[f64],
    reach: f64,
) -> Option<(Configuration<f64>, Vec<f64>)> {
    let start = match near.follow(from, direction, reach) {
        Some(step) => step.at,
        None => {
            let step: Vec<f64> = direction.iter().map(|x| x * reach).collect();
            near.system().displaced(&from.at, &step)
        }
    };
    let at = near.settle(start, reach)?;
    let mut way = near.system().difference(&from.at, &at);
    remove(&mut way, &from.idle);
    let distance = norm(&way);
    way.iter_mut().for_each(|x| *x /= distance);
    (0.05 * reach < distance && distance < 5.0 * reach).then_some((at, way))
}
