//! Links that spin about their own lines stand still.

use super::Question;
use crate::description::Role;
use crate::geometry::RollPitchYaw;
use crate::mechanism::PoseCoordinate;
use crate::system::{Coordinate, Held, HeldPlatform, Mobility, Neighbourhood, Unknown};

impl Question<'_> {
    /// The same question where links that only spin about their own lines, as a rod between two
    /// balls, do not: each such freedom is taken away by one coordinate that stays where it is, a
    /// passive joint of the link, or an angle of a platform that has no such joint. These
    /// coordinates do not count as held: nobody chose them, and nothing else depends on them.
    ///
    /// Without it a finite number of assemblies would be infinite, and each configuration of a curve
    /// one of a surface.
    pub fn with_spins_still(mut self) -> Self {
        let mechanism = self.mechanism;
        let start = self.start();
        let Some(mobility) = Mobility::near(mechanism, &start) else {
            return self;
        };
        if mobility.idle() == 0 {
            return self;
        }
        let held = self.held();
        let mut near = Neighbourhood::holding(mechanism, &held);
        let tangent = near.tangent(mobility.at().clone());
        let unknowns = near.system().unknowns();
        let joints = unknowns.iter().filter_map(|unknown| match *unknown {
            Unknown::Joint(joint) if mechanism.joints()[joint].role == Role::Passive => {
                Some(Coordinate::Joint(joint))
            }
            _ => None,
        });
        let angles = |platform: usize| {
            let rotation = mobility.at().platforms[platform].pose().rotation;
            let all = match held.platforms[platform] {
                HeldPlatform::Free if !RollPitchYaw::is_locked(&rotation) => &ANGLES[..],
                _ => &[],
            };
            all.iter().map(move |c| Coordinate::Pose(platform, *c))
        };
        let angles = (0..mechanism.platforms().len()).flat_map(angles);
        let mut idle = tangent.idle;
        // a joint is as good at all configurations as at one, an angle is not
        for candidates in [joints.collect(), angles.collect::<Vec<Coordinate>>()] {
            let rows: Vec<(Coordinate, Vec<(usize, f64)>)> = (candidates.into_iter())
                .map(|c| (c, c.slope_in(near.system(), mobility.at())))
                .collect();
            for chosen in pivots(&mut idle, &rows) {
                let value = chosen.of(&start);
                self.still.push((chosen, value));
            }
        }
        self
    }

    /// What is held, and what stands still in this question too.
    pub fn with_still(&self, mut held: Held<f64>) -> Held<f64> {
        for &(still, value) in &self.still {
            match still {
                Coordinate::Joint(joint) => held.joints[joint] = true,
                Coordinate::Pose(platform, c) => match &mut held.platforms[platform] {
                    HeldPlatform::Partly { coordinates, .. } => coordinates.push((c, value)),
                    free @ HeldPlatform::Free => {
                        *free = HeldPlatform::Partly {
                            coordinates: vec![(c, value)],
                            orientation: None,
                        };
                    }
                    HeldPlatform::Pose => {}
                },
                Coordinate::Turn(..) => {}
            }
        }
        held
    }
}

const ANGLES: [PoseCoordinate; 3] = [
    PoseCoordinate::Roll,
    PoseCoordinate::Pitch,
    PoseCoordinate::Yaw,
];

/// Coordinates, given by their derivatives, that tell motions apart, each with the motion that it
/// tells best. The others of the motions are left, without parts that the coordinates tell:
/// elimination with the largest pivot first.
fn pivots(
    motions: &mut Vec<Vec<f64>>,
    rows: &[(Coordinate, Vec<(usize, f64)>)],
) -> Vec<Coordinate> {
    /// Coordinates that change less in a motion of unit norm do not tell it.
    const LEAST: f64 = 0.1;
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
            return chosen;
        };
        let pivot = motions.swap_remove(m);
        let (coordinate, row) = &rows[r];
        for other in motions.iter_mut() {
            let factor = rate(other, row) / rate(&pivot, row);
            let both = other.iter_mut().zip(&pivot);
            both.for_each(|(x, p)| *x -= factor * p);
        }
        chosen.push(*coordinate);
    }
}
