//! Local freedoms of links, spins about their own lines, stopped.

use super::Question;
use crate::description::Role;
use crate::geometry::{Quaternion, Vector3};
use crate::mechanism::{Configuration, Mechanism};
use crate::system::{Coordinate, Held, Neighbourhood, RegularFreedoms, Spin, System, Unknown};

/// A coordinate that stays where it is so that a link does not spin about its own line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Still {
    /// A passive joint of the link.
    Joint(usize),
    /// A platform that has no such joint.
    Platform(Spin),
}

impl Still {
    /// The joint.
    pub fn joint(self) -> Option<usize> {
        match self {
            Still::Joint(joint) => Some(joint),
            Still::Platform(_) => None,
        }
    }

    /// The held coordinates with these added.
    pub fn held_with(all: &[Still], mut held: Held<f64>) -> Held<f64> {
        for still in all {
            match *still {
                Still::Joint(joint) => held.joints[joint] = true,
                Still::Platform(spin) => held.platforms[spin.platform].stop(&[spin]),
            }
        }
        held
    }

    /// The name of the joint or platform.
    pub fn name(self, mechanism: &Mechanism) -> &str {
        match self {
            Still::Joint(joint) => &mechanism.joints()[joint].name,
            Still::Platform(spin) => &mechanism.platforms()[spin.platform].name,
        }
    }

    /// Its derivative by the unknowns of a system.
    fn slope_in(self, system: &System<f64>, at: &Configuration<f64>) -> Vec<(usize, f64)> {
        match self {
            Still::Joint(joint) => Coordinate::Joint(joint).slope_in(system, at),
            Still::Platform(spin) => {
                let first = system.place_of(Unknown::first_twist(spin.platform));
                let (_, slope) = spin.row(&at.platforms[spin.platform].orientation);
                let places = first.into_iter().flat_map(|first| first..first + 3);
                places.zip(slope).collect()
            }
        }
    }
}

impl Question<'_> {
    /// Stops links that only spin about their own lines, as a rod between two balls does (local freedoms): for each
    /// such freedom a coordinate stays where it is, a passive joint of the link, or else the spin of a platform.
    /// These do not count as held: nobody chose them, and nothing else depends on them.
    ///
    /// Without it a finite number of assemblies would be infinite, and each configuration of a curve one of a surface.
    pub fn with_spins_still(mut self) -> Self {
        let mechanism = self.mechanism;
        if self.spinless {
            return self;
        }
        // near home, so that questions that differ in values make the same choice
        let near = |at| RegularFreedoms::near(mechanism, &at);
        let Some(mobility) = near(mechanism.home()).or_else(|| near(self.start())) else {
            return self;
        };
        if mobility.idle() == 0 {
            return self;
        }
        let mut near = Neighbourhood::holding(mechanism, &self.held());
        let at = mobility.at();
        let mut idle = near.tangent(at.clone()).idle;
        let joints = near.system().unknowns().iter();
        let joints = joints.filter_map(|unknown| match *unknown {
            Unknown::Joint(joint) if mechanism.joints()[joint].role == Role::Passive => {
                Some(Still::Joint(joint))
            }
            _ => None,
        });
        // a joint is as good at all configurations as at one
        let joints: Vec<Still> = joints.collect();
        for candidates in [joints, platforms(mechanism, near.system(), at, &idle)] {
            let rows: Vec<(Still, Vec<(usize, f64)>)> = (candidates.into_iter())
                .map(|still| (still, still.slope_in(near.system(), at)))
                .collect();
            self.still.extend(pivots(&mut idle, &rows));
        }
        self
    }

    /// Skips the search for local spins, for a mechanism that is known to have none.
    pub(crate) fn without_spins(mut self) -> Self {
        self.spinless = true;
        self
    }

    /// Coordinates that stay where they are so that links do not spin about their own lines.
    pub fn still(&self) -> &[Still] {
        &self.still
    }

    /// The held coordinates with those added that stop local spins.
    pub fn with_still(&self, held: Held<f64>) -> Held<f64> {
        Still::held_with(&self.still, held)
    }
}

/// For each platform the spin that is largest in one of the motions.
fn platforms(
    mechanism: &Mechanism,
    system: &System<f64>,
    at: &Configuration<f64>,
    motions: &[Vec<f64>],
) -> Vec<Still> {
    let spins = (0..mechanism.platforms().len()).filter_map(|platform| {
        let first = system.place_of(Unknown::first_twist(platform))?;
        let omegas = (motions.iter()).map(|m| Vector3([m[first], m[first + 1], m[first + 2]]));
        let omega = omegas.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let line = at.platforms[platform]
            .pose()
            .rotation
            .inverse_rotate(&omega);
        // rounding must not choose another line at every start
        let line = line
            .times(1.0 / line.norm())
            .map(|x| (x * 1e9).round() * 1e-9);
        let line = line.times(1.0 / line.norm());
        let home = mechanism.home().platforms[platform].orientation;
        let [x, y, z] = line.0;
        let half_turned = home.then_left(&Quaternion([0.0, x, y, z]));
        let [spin, other] = [home, half_turned].map(|home| Spin::about(&line, platform, &home));
        // half a turn from where it vanishes the condition hardly changes with the spin
        let changes = |spin: &Spin| {
            let (_, slope) = spin.row(&at.platforms[platform].orientation);
            omega.dot(&Vector3(slope)).abs() / omega.norm()
        };
        // at most it changes by 1
        let spin = match changes(&spin) < 0.3 && changes(&other) > changes(&spin) {
            true => other,
            false => spin,
        };
        (omega.norm() >= LEAST).then_some(Still::Platform(spin))
    });
    spins.collect()
}

/// A coordinate that changes less in a motion of unit norm cannot stand for that motion.
const LEAST: f64 = 0.1;

/// Coordinates to hold, given by their derivatives, one for each motion that they distinguish, found
/// by elimination with the largest pivot first. What remains in `motions` moves none of them.
fn pivots(motions: &mut Vec<Vec<f64>>, rows: &[(Still, Vec<(usize, f64)>)]) -> Vec<Still> {
    let rate = |motion: &Vec<f64>, row: &Vec<(usize, f64)>| -> f64 {
        row.iter()
            .map(|(place, slope)| motion[*place] * slope)
            .sum()
    };
    let mut chosen = Vec::new();
    loop {
        let pairs = (0..motions.len()).flat_map(|m| (0..rows.len()).map(move |r| (m, r)));
        let size = |(m, r): (usize, usize)| rate(&motions[m], &rows[r].1).abs();
        // of equal ones the first, whatever rounding says
        let best = pairs.reduce(|best, pair| match size(pair) > size(best) * (1.0 + 1e-9) {
            true => pair,
            false => best,
        });
        let Some((m, r)) = best.filter(|pair| size(*pair) >= LEAST) else {
            chosen.sort_unstable();
            return chosen.into_iter().map(|r: usize| rows[r].0).collect();
        };
        let pivot = motions.swap_remove(m);
        let (_, row) = &rows[r];
        for other in motions.iter_mut() {
            let factor = rate(other, row) / rate(&pivot, row);
            let both = other.iter_mut().zip(&pivot);
            both.for_each(|(x, p)| *x -= factor * p);
        }
        chosen.push(r);
    }
}
