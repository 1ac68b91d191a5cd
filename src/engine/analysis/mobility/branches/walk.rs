//! Following the branches through a singular configuration by small steps.

use rand_pcg::Pcg64Mcg;

use super::{BRANCH_TRIALS, FiniteSearch, see};
use crate::linear::{add, dot, norm, orthonormal, remove};
use crate::mechanism::Configuration;
use crate::system::{Cone, SET_STEP, Tangent, combination};

/// Part of the step by which a joint that moves on a branch moves: other freedoms leave slack.
pub(super) const MOVED_ON_A_BRANCH: f64 = 1e-3;

/// Directions to try: on the quadratic cone, between the basis vectors, both ways along each.
pub(super) struct WalkDirections {
    /// Tries on the cone that are left.
    on_cone: usize,
    /// Tries between the basis vectors if none on the cone succeeds; on the cone alone `None`.
    between: Option<usize>,
    /// Directions made so far: on the cone, between the basis vectors, and along these.
    made: [usize; 3],
}

impl WalkDirections {
    pub fn new(cone: &Cone, at: &Tangent) -> Self {
        WalkDirections {
            between: Some(BRANCH_TRIALS * at.motions.len()),
            ..WalkDirections::on_cone(cone, at)
        }
    }

    /// Directions on the quadratic cone alone; none where second order excludes nothing.
    pub fn on_cone(cone: &Cone, at: &Tangent) -> Self {
        let n = at.motions.len();
        let curved = n >= 2 && !cone.is_all();
        WalkDirections {
            on_cone: if curved { BRANCH_TRIALS * n } else { 0 },
            between: None,
            made: [0; 3],
        }
    }

    pub fn next(&mut self, cone: &Cone, at: &Tangent, rng: &mut Pcg64Mcg) -> Option<Vec<f64>> {
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
        let sign = [1.0, -1.0][self.made[2] % 2];
        self.made[2] += 1;
        Some(motion.iter().map(|x| sign * x).collect())
    }
}

/// A branch seen at a point of it that lies on no other.
pub(super) struct Seen {
    /// The tangent there with the motions of the branch alone.
    beside: Tangent,
    /// True if every infinitesimal freedom there is finite.
    pub regular: bool,
    pub moved: Vec<bool>,
}

impl Seen {
    fn agrees(&self, other: &Tangent) -> bool {
        // the sine of the angle between tangents of one branch beside the meeting point
        same(&self.beside.motions, &other.motions, 0.15)
    }
}

/// True if two orthonormal bases span the same space, up to angles of this sine.
pub(super) fn same(a: &[Vec<f64>], b: &[Vec<f64>], sine: f64) -> bool {
    a.len() == b.len() && contains(a, b, sine)
}

/// True if an orthonormal basis spans the vectors of another, up to angles of this sine.
pub(super) fn contains(space: &[Vec<f64>], vectors: &[Vec<f64>], sine: f64) -> bool {
    (vectors.iter()).all(|vector| norm(&left_of(vector, space)) < sine)
}

/// A vector without its components along orthonormal ones.
fn left_of(vector: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut left = vector.to_vec();
    remove(&mut left, basis);
    left
}

/// The components of a vector along orthonormal ones.
fn within(vector: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let left = left_of(vector, basis);
    vector.iter().zip(left).map(|(x, out)| x - out).collect()
}

/// The search for the branches of an independent part of a mechanism through a singular configuration.
pub(super) struct BranchWalk<'w, 's, 'm> {
    pub search: &'w mut FiniteSearch<'s, 'm>,
    /// The unknowns of the part.
    pub own: &'w [bool],
    /// The singular configuration.
    pub from: &'w Tangent,
    pub seen: Vec<Seen>,
}

impl BranchWalk<'_, '_, '_> {
    /// Adds the branch that a small step along a direction settles on, if it does.
    pub fn explore(&mut self, direction: &[f64]) {
        let reach = SET_STEP;
        let Some((mut at, way)) = self.search.near.arrive(self.from, direction, reach) else {
            return;
        };
        // too near the meeting point a motion of high order looks finite
        let distance = norm(&self.way(&at));
        if distance < 0.5 * reach
            && let Some((further, _)) = self.search.near.arrive(self.from, &way, reach)
        {
            at = further;
        }
        let beside = self.tangent(at);
        self.look(beside);
    }

    /// Step from the singular configuration to another.
    fn way(&self, to: &Configuration<f64>) -> Vec<f64> {
        self.search.near.system().difference(&self.from.at, to)
    }

    fn tangent(&mut self, at: Configuration<f64>) -> Tangent {
        self.search.near.tangent(at).within(self.own)
    }

    /// Adds the branch of a point, which moves on to where all infinitesimal freedoms are finite.
    fn look(&mut self, point: Tangent) {
        let reach = SET_STEP;
        let step = 0.3 * reach;
        if point.motions.is_empty() {
            return;
        }
        let mut points = vec![point];
        for _ in 0..=BRANCH_TRIALS {
            let Some(last) = points.last() else { return };
            if (self.seen.iter()).any(|seen| seen.regular && seen.agrees(last))
                || self.search.is_regular(last, reach, 3)
            {
                let beside = last.clone();
                return self.add(beside, true);
            }
            // on from where the fewest motions were seen
            let Some(least) = points.iter().min_by_key(|point| point.motions.len()) else {
                return;
            };
            let direction = combination(&least.motions, &mut self.search.rng);
            if let Some((at, _)) = self.search.near.arrive(least, &direction, step) {
                points.push(self.tangent(at));
            }
        }
        // infinitesimally flexible wherever it was seen
        let least = points.into_iter().min_by_key(|point| point.motions.len());
        let Some(mut least) = least else { return };
        let cone = Cone::of(self.search.near, &least);
        let mut directions = WalkDirections::new(&cone, &least);
        let mut ways: Vec<Vec<f64>> = Vec::new();
        while let Some(direction) = directions.next(&cone, &least, &mut self.search.rng) {
            ways.extend(
                self.search
                    .near
                    .arrive(&least, &direction, step)
                    .map(|(_, way)| way),
            );
        }
        least.motions = orthonormal(&ways, 0.1);
        if !least.motions.is_empty() && self.fills(&least, step) {
            self.add(least, false);
        }
    }

    /// True if steps in the span of the motions arrive where they aim; false where branches meet.
    pub fn fills(&mut self, at: &Tangent, step: f64) -> bool {
        let FiniteSearch { near, rng, .. } = &mut *self.search;
        at.motions.len() == 1 || near.follows(at, step, rng).is_some()
    }

    fn add(&mut self, beside: Tangent, regular: bool) {
        let way = self.way(&beside.at);
        let clearly = MOVED_ON_A_BRANCH * SET_STEP;
        let known = |seen: &&mut Seen| seen.regular == regular && seen.agrees(&beside);
        if let Some(known) = self.seen.iter_mut().find(known) {
            return see(&mut known.moved, &way, clearly);
        }
        let mut moved = vec![false; beside.columns()];
        see(&mut moved, &way, clearly);
        for motion in &beside.motions {
            see(&mut moved, motion, MOVED_ON_A_BRANCH);
        }
        self.seen.push(Seen {
            beside,
            regular,
            moved,
        });
    }

    /// The motions of a branch at the meeting point: its tangents on the way there, extrapolated.
    pub fn limit(&mut self, number: usize) -> Vec<Vec<f64>> {
        const LEVELS: i32 = 4;
        let seen = &self.seen[number];
        let (basis, tangent) = (&seen.beside.motions, self.from);
        let mut way = self.way(&seen.beside.at);
        remove(&mut way, &tangent.idle);
        let distance = norm(&way);
        // distances and the branch's motions there, as parts of the same basis
        let mut levels: Vec<(f64, Vec<Vec<f64>>)> = vec![];
        for level in 0..LEVELS {
            let factor = 0.5f64.powi(level);
            let step: Vec<f64> = way.iter().map(|x| x * factor).collect();
            let start = self.search.near.system().displaced(&tangent.at, &step);
            let Some(at) = self.search.near.settle(start, factor * distance) else {
                break;
            };
            let mut back = self.way(&at);
            remove(&mut back, &tangent.idle);
            let along = dot(&back, &way) / (distance * distance);
            if !(0.5 * factor..2.0 * factor).contains(&along) {
                break;
            }
            if seen.regular {
                let there = self.search.near.tangent(at).within(self.own).motions;
                if there.len() != basis.len() {
                    break;
                }
                levels.push((along, basis.iter().map(|m| within(m, &there)).collect()));
            } else if basis.len() == 1 {
                // among infinitesimal motions the tangent is not known, but the chord is
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
            let weight: f64 = (others.map(|(_, (other, _))| other / (other - own))).product();
            for (limit, motion) in limit.iter_mut().zip(motions) {
                add(limit, weight, motion);
            }
        }
        // every finite motion starts along an infinitesimal one
        let limit: Vec<Vec<f64>> = limit.iter().map(|m| within(m, &tangent.motions)).collect();
        let found = orthonormal(&limit, 0.1);
        match found.len() == basis.len() {
            true => found,
            false => basis.clone(),
        }
    }
}
