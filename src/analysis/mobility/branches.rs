//! Which infinitesimal freedoms are finite.

use rand::Rng;

use super::cone::Cone;
use super::{Character, MobilitySettings};
use crate::linear::{dot, norm, orthonormal, remove};
use crate::mechanism::Configuration;
use crate::system::{Neighbourhood, Tangent};

/// A joint that a finite step along free motions moves by more than this moves: at a dead point its
/// rate is zero, and a step of 0.05 moves it to second order.
const MOVED: f64 = 1e-7;

/// The same beside a singular configuration, over the length of the step: shaky freedoms have slack.
const MOVED_ON_A_BRANCH: f64 = 1e-3;

/// Branches whose tangents beside the meeting point differ by less than this are one, seen at two
/// points of a curve.
const SAME_BRANCH: f64 = 0.15;

/// The same of tangents at the meeting point.
const SAME_THERE: f64 = 0.02;

/// The finite motions through a configuration.
pub(super) struct Finite {
    pub freedoms: usize,
    /// Whether every infinitesimal freedom is finite.
    pub regular: bool,
    pub branches: Vec<Branch>,
    /// Whether each unknown was seen to move.
    pub moved: Vec<bool>,
    /// What is left of the equations after a finite step.
    pub gap: Option<f64>,
}

/// A branch through a singular configuration.
pub(super) struct Branch {
    pub freedoms: usize,
    /// Its motions at the configuration.
    pub tangent: Tangent,
    pub moved: Vec<bool>,
}

impl Finite {
    pub fn character(&self, infinitesimal: usize) -> Character {
        let several = self.branches.len() > 1;
        let uneven = several
            && self
                .branches
                .iter()
                .any(|b| b.freedoms != self.branches[0].freedoms);
        match () {
            () if infinitesimal == 0 => Character::Structure,
            () if self.regular => Character::Regular,
            () if self.branches.is_empty() => Character::Shaky,
            () if uneven => Character::Kinematotropic,
            () if several => Character::Bifurcation,
            () => Character::Singular,
        }
    }
}

/// Finds the finite motions.
pub(super) fn find(
    near: &mut Neighbourhood,
    tangent: &Tangent,
    settings: &MobilitySettings,
    rng: &mut impl Rng,
) -> Finite {
    let mut finite = Finite {
        freedoms: tangent.motions.len(),
        regular: true,
        branches: vec![],
        moved: vec![false; tangent.columns()],
        gap: Some(0.0),
    };
    if tangent.motions.is_empty() {
        return finite;
    }
    for _ in 0..settings.directions.max(1) {
        let direction = combination(&tangent.motions, rng);
        match near.free_step(tangent, &direction, settings.step) {
            Ok(step) => {
                finite.gap = finite.gap.map(|gap| gap.max(step.gap));
                let moved = near.system().difference(&tangent.at, &step.at);
                see(&mut finite.moved, &moved, MOVED);
            }
            Err(gap) => {
                finite.gap = gap;
                finite.regular = false;
                break;
            }
        }
    }
    if !finite.regular {
        finite.branches = branches(near, tangent, settings, rng);
        let most = finite.branches.iter().map(|branch| branch.freedoms).max();
        finite.freedoms = most.unwrap_or(0);
        finite.moved.fill(false);
        for branch in &finite.branches {
            let all = finite.moved.iter_mut().zip(&branch.moved);
            all.for_each(|(any, moved)| *any |= moved);
        }
    }
    finite
}

/// Whether random directions of motion are all free, so that every direction is.
pub(super) fn is_regular(
    near: &mut Neighbourhood,
    tangent: &Tangent,
    distance: f64,
    directions: usize,
    rng: &mut impl Rng,
) -> bool {
    (0..directions).all(|_| {
        let direction = combination(&tangent.motions, rng);
        near.free_step(tangent, &direction, distance).is_ok()
    })
}

/// A random unit vector in the span of orthonormal vectors.
pub(super) fn combination(basis: &[Vec<f64>], rng: &mut impl Rng) -> Vec<f64> {
    let mut direction = vec![0.0; basis[0].len()];
    while norm(&direction) < 0.1 {
        direction.fill(0.0);
        for motion in basis {
            let weight = 2.0 * rng.random::<f64>() - 1.0;
            direction
                .iter_mut()
                .zip(motion)
                .for_each(|(d, m)| *d += weight * m);
        }
    }
    let length = norm(&direction);
    direction.iter_mut().for_each(|d| *d /= length);
    direction
}

fn see(moved: &mut [bool], step: &[f64], clearly: f64) {
    for (moved, step) in moved.iter_mut().zip(step) {
        *moved |= step.abs() > clearly;
    }
}

/// Directions that are worth a try: some on the quadratic cone, some between the basis vectors,
/// and along each of them both ways.
fn directions(
    near: &mut Neighbourhood,
    at: &Tangent,
    trials: usize,
    rng: &mut impl Rng,
) -> Vec<Vec<f64>> {
    let basis = &at.motions;
    let mut directions: Vec<Vec<f64>> = vec![];
    if basis.len() > 1 {
        let cone = Cone::of(near, at);
        let on_cone = match cone.is_all() {
            true => 0,
            false => trials * basis.len(),
        };
        directions.extend((0..on_cone).filter_map(|_| cone.direction(basis, rng)));
        let between = match directions.is_empty() {
            true => trials * basis.len(),
            false => trials,
        };
        directions.extend((0..between).map(|_| combination(basis, rng)));
    }
    let back = |motion: &Vec<f64>| motion.iter().map(|x| -x).collect();
    directions.extend(basis.iter().flat_map(|m| [m.clone(), back(m)]));
    directions
}

/// A branch seen at a point of it that lies on no other.
struct Seen {
    /// The tangent there; the motions are those of the branch, of which there may be fewer than
    /// infinitesimal ones.
    beside: Tangent,
    /// Whether every infinitesimal freedom there is finite.
    regular: bool,
    moved: Vec<bool>,
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
fn same(a: &[Vec<f64>], b: &[Vec<f64>], sine: f64) -> bool {
    a.len() == b.len() && contains(a, b, sine)
}

/// Whether an orthonormal basis spans the vectors of another but for angles of this sine.
fn contains(space: &[Vec<f64>], vectors: &[Vec<f64>], sine: f64) -> bool {
    vectors.iter().all(|vector| {
        let mut out = vector.clone();
        remove(&mut out, space);
        norm(&out) < sine
    })
}

/// The branches through a singular configuration that small steps in many directions settle on.
fn branches(
    near: &mut Neighbourhood,
    tangent: &Tangent,
    settings: &MobilitySettings,
    rng: &mut impl Rng,
) -> Vec<Branch> {
    let reach = settings.branch_step;
    let mut seen: Vec<Seen> = Vec::new();
    for direction in directions(near, tangent, settings.branch_trials, rng) {
        if let Some((at, _)) = arrive(near, tangent, &direction, reach) {
            let beside = near.tangent(at);
            look(near, tangent, beside, settings, &mut seen, rng);
        }
    }
    let mut branches: Vec<(bool, Branch)> = Vec::new();
    for seen in seen {
        let motions = there(near, tangent, &seen);
        let one =
            |known: &&mut (bool, Branch)| same(&known.1.tangent.motions, &motions, SAME_THERE);
        if let Some((_, branch)) = branches.iter_mut().find(one) {
            let all = branch.moved.iter_mut().zip(&seen.moved);
            all.for_each(|(any, moved)| *any |= moved);
            continue;
        }
        let branch = Branch {
            freedoms: motions.len(),
            tangent: Tangent {
                motions,
                ..tangent.clone()
            },
            moved: seen.moved,
        };
        branches.push((seen.regular, branch));
    }
    branches.sort_by_key(|(_, branch)| std::cmp::Reverse(branch.freedoms));
    // what was seen from a special point of a larger branch is part of that
    let within = |i: usize| {
        let (regular, branch) = &branches[i];
        let motions = &branch.tangent.motions;
        !regular
            && (branches[..i].iter()).any(|(_, larger)| {
                larger.freedoms > branch.freedoms
                    && contains(&larger.tangent.motions, motions, SAME_THERE)
            })
    };
    let parts: Vec<bool> = (0..branches.len()).map(within).collect();
    let whole = branches.into_iter().zip(parts).filter(|(_, part)| !part);
    whole.map(|((_, branch), _)| branch).collect()
}

/// Adds the branch on which a point lies, looked at where it lies on no other: at a point where all
/// infinitesimal freedoms are finite, which is moved on to if need be.
fn look(
    near: &mut Neighbourhood,
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
        if is_regular(near, last, step, 2, rng) {
            let beside = last.clone();
            return add(near, from, beside, true, reach, seen);
        }
        // on from where the fewest motions were seen
        let Some(least) = points.iter().min_by_key(|point| point.motions.len()) else {
            return;
        };
        let direction = combination(&least.motions, rng);
        if let Some((at, _)) = arrive(near, least, &direction, step) {
            points.push(near.tangent(at));
        }
    }
    // shaky wherever it was seen
    let least = points.into_iter().min_by_key(|point| point.motions.len());
    if let Some(mut least) = least {
        let ways: Vec<Vec<f64>> = directions(near, &least, settings.branch_trials, rng)
            .iter()
            .filter_map(|direction| Some(arrive(near, &least, direction, step)?.1))
            .collect();
        least.motions = orthonormal(&ways, 0.1);
        if !least.motions.is_empty() {
            add(near, from, least, false, reach, seen);
        }
    }
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
fn there(near: &mut Neighbourhood, tangent: &Tangent, seen: &Seen) -> Vec<Vec<f64>> {
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
            let there = near.tangent(at);
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
