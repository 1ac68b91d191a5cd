//! Which infinitesimal freedoms are finite.

use rand::Rng;

use super::{Character, MobilitySettings};
use crate::linear::{norm, orthonormal, remove};
use crate::system::{Neighbourhood, Tangent};

/// A joint that a finite step moves by more than this moves: at a dead point its rate is zero, and
/// a step of 0.05 moves it to second order.
pub(super) const MOVED: f64 = 1e-7;

/// Branches whose tangents differ by less than this are one, seen at two points of a curve.
const SAME_BRANCH: f64 = 0.15;

/// The finite motions through a configuration.
pub(super) struct Finite {
    pub freedoms: usize,
    /// Whether every infinitesimal freedom is finite.
    pub regular: bool,
    pub branches: Vec<Branch>,
    /// For each unknown how far it was seen to move, dimensionless.
    pub moved: Vec<f64>,
    /// What is left of the equations after a finite step.
    pub gap: Option<f64>,
}

/// A branch through a singular configuration, seen from a point beside it.
pub(super) struct Branch {
    pub freedoms: usize,
    pub tangent: Tangent,
    pub moved: Vec<f64>,
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
        moved: vec![0.0; tangent.columns()],
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
                see(&mut finite.moved, &moved);
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
        finite.moved.fill(0.0);
        for branch in &finite.branches {
            see(&mut finite.moved, &branch.moved);
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
fn combination(basis: &[Vec<f64>], rng: &mut impl Rng) -> Vec<f64> {
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

fn see(moved: &mut [f64], step: &[f64]) {
    for (most, step) in moved.iter_mut().zip(step) {
        *most = most.max(step.abs());
    }
}

/// Directions that are worth a try: along each basis vector both ways, and between them.
fn directions(basis: &[Vec<f64>], trials: usize, rng: &mut impl Rng) -> Vec<Vec<f64>> {
    let back = |motion: &Vec<f64>| motion.iter().map(|x| -x).collect();
    let mut directions: Vec<Vec<f64>> = (basis.iter())
        .flat_map(|motion| [motion.clone(), back(motion)])
        .collect();
    if basis.len() > 1 {
        directions.extend((0..trials * basis.len()).map(|_| combination(basis, rng)));
    }
    directions
}

/// The branches through a singular configuration that small steps in many directions settle on.
fn branches(
    near: &mut Neighbourhood,
    tangent: &Tangent,
    settings: &MobilitySettings,
    rng: &mut impl Rng,
) -> Vec<Branch> {
    let reach = settings.branch_step;
    let mut branches: Vec<Branch> = Vec::new();
    for direction in directions(&tangent.motions, settings.branch_trials, rng) {
        let Some((at, _)) = arrive(near, tangent, &direction, reach) else {
            continue;
        };
        let beside = near.tangent(at);
        let known = |branch: &&mut Branch| {
            branch.tangent.motions.len() == beside.motions.len()
                && (beside.motions.iter()).all(|motion| branch.tangent.misses(motion) < SAME_BRANCH)
        };
        let moved = near.system().difference(&tangent.at, &beside.at);
        if let Some(branch) = branches.iter_mut().find(known) {
            see(&mut branch.moved, &moved);
            continue;
        }
        let freedoms = freedoms(near, &beside, 0.1 * reach, settings.branch_trials, rng);
        if freedoms > 0 {
            branches.push(Branch {
                freedoms,
                moved: moved.iter().map(|x| x.abs()).collect(),
                tangent: beside,
            });
        }
    }
    branches.sort_by_key(|branch| std::cmp::Reverse(branch.freedoms));
    branches
}

/// An assembled configuration that a small step settles on, with the unit direction to it; `None`
/// if it comes back or runs away.
fn arrive(
    near: &mut Neighbourhood,
    from: &Tangent,
    direction: &[f64],
    reach: f64,
) -> Option<(crate::mechanism::Configuration<f64>, Vec<f64>)> {
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

/// The finite freedoms at a point of a branch: as many as infinitesimal ones if they are free, else
/// as many as there are independent directions in which a step arrives.
fn freedoms(
    near: &mut Neighbourhood,
    at: &Tangent,
    distance: f64,
    trials: usize,
    rng: &mut impl Rng,
) -> usize {
    if at.motions.is_empty() {
        return 0;
    }
    if is_regular(near, at, distance, 2, rng) {
        return at.motions.len();
    }
    let ways: Vec<Vec<f64>> = (directions(&at.motions, trials, rng).iter())
        .filter_map(|direction| Some(arrive(near, at, direction, distance)?.1))
        .collect();
    orthonormal(&ways, 0.1).len()
}
