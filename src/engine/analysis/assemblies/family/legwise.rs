//! Solutions kept leg by leg.
//!
//! Given the poses of the platforms each leg closes by itself, and every combination of one way for
//! each leg is a solution: 40·2⁶ for a 6-UPS platform of 40 poses. A few points for each pose that show
//! every way of every leg are kept and tracked.

use serde::{Deserialize, Serialize};

use super::coordinates::{C, Coordinates};

/// One placement of the platforms and the ways in which the legs close for it. Without platforms to
/// be found there is one placement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LegwiseSolutions {
    /// Seven coordinates for each platform.
    pub pose: Vec<C>,
    /// For each leg its ways, each a value for every joint of the leg.
    pub legs: Vec<Vec<Vec<C>>>,
}

impl LegwiseSolutions {
    /// Number of solutions that it stands for.
    pub fn count(&self) -> usize {
        self.legs.iter().map(Vec::len).product()
    }

    /// Least number of them that show every way of every leg.
    pub fn spanning(&self) -> usize {
        self.legs.iter().map(Vec::len).max().unwrap_or(1)
    }

    /// True if it belongs to these coordinates.
    pub fn fits(&self, coordinates: &Coordinates) -> bool {
        let legs = &coordinates.legs;
        self.pose.len() == 7 * coordinates.free_platforms.len()
            && self.legs.len() == legs.len()
            && (self.legs.iter().zip(legs)).all(|(ways, joints)| {
                !ways.is_empty() && ways.iter().all(|way| way.len() == joints.len())
            })
    }

    fn point(&self, coordinates: &Coordinates, way: impl Fn(usize, usize) -> usize) -> Vec<C> {
        let joints = coordinates.free_joints.len();
        let mut x = vec![C::new(0.0, 0.0); joints];
        for (leg, (joints, ways)) in coordinates.legs.iter().zip(&self.legs).enumerate() {
            for (&joint, value) in joints.iter().zip(&ways[way(leg, ways.len())]) {
                x[joint] = *value;
            }
        }
        x.extend(&self.pose);
        x
    }

    /// The points that show every way of every leg.
    pub fn spanning_points(&self, coordinates: &Coordinates) -> Vec<Vec<C>> {
        (0..self.spanning())
            .map(|k| self.point(coordinates, |_, ways| k % ways))
            .collect()
    }

    /// All solutions: the ways of the first leg change slowest.
    pub fn points(&self, coordinates: &Coordinates) -> Vec<Vec<C>> {
        let mut weights = vec![1; self.legs.len()];
        for leg in (1..self.legs.len()).rev() {
            weights[leg - 1] = weights[leg] * self.legs[leg].len();
        }
        (0..self.count())
            .map(|k| self.point(coordinates, |leg, ways| k / weights[leg] % ways))
            .collect()
    }

    /// Adds the ways of a solution with the same pose; true if anything was new.
    fn learn(&mut self, coordinates: &Coordinates, x: &[C]) -> bool {
        let mut new = false;
        for (joints, ways) in coordinates.legs.iter().zip(&mut self.legs) {
            let way = at(joints, x);
            let mut known = ways.iter();
            if !known.any(|known| coordinates.same_way(joints, known, &way)) {
                ways.push(way);
                new = true;
            }
        }
        new
    }
}

fn at(joints: &[usize], x: &[C]) -> Vec<C> {
    joints.iter().map(|&joint| x[joint]).collect()
}

/// Adds a solution to legwise solutions; true if anything in it was new.
pub(crate) fn learn(
    legwise: &mut Vec<LegwiseSolutions>,
    coordinates: &Coordinates,
    x: &[C],
) -> bool {
    let pose = coordinates.pose_of(x);
    let known = |solutions_at_pose: &&mut LegwiseSolutions| {
        coordinates.same_pose(&solutions_at_pose.pose, pose)
    };
    match legwise.iter_mut().find(known) {
        Some(solutions_at_pose) => solutions_at_pose.learn(coordinates, x),
        None => {
            let legs = coordinates.legs.iter();
            legwise.push(LegwiseSolutions {
                pose: pose.to_vec(),
                legs: legs.map(|joints| vec![at(joints, x)]).collect(),
            });
            true
        }
    }
}

/// All solutions that legwise solutions stand for.
pub(crate) fn points(legwise: &[LegwiseSolutions], coordinates: &Coordinates) -> Vec<Vec<C>> {
    let all = legwise.iter().flat_map(|s| s.points(coordinates));
    all.collect()
}

/// The points that show every way of every leg.
pub(crate) fn spanning_points(
    legwise: &[LegwiseSolutions],
    coordinates: &Coordinates,
) -> Vec<Vec<C>> {
    let all = legwise.iter().flat_map(|s| s.spanning_points(coordinates));
    all.collect()
}

/// Number of solutions that legwise solutions stand for.
pub(crate) fn count(legwise: &[LegwiseSolutions]) -> usize {
    legwise.iter().map(LegwiseSolutions::count).sum()
}
