use super::equations::System;
use super::layout::{Held, HeldPlatform, Unknown};
use crate::linear::{SPECTRUM_LIMIT, Spectrum, rank};
use crate::mechanism::{Configuration, Coordinate, Dimensions, Kinematics, Mechanism};
use crate::number::Dual;
use crate::solve::{Equations, Newton, Stop};

/// The infinitesimal motions of a mechanism at a configuration, with some coordinates held.
#[derive(Clone, Debug)]
pub struct Freedoms {
    /// The unknowns, in the order of the motions' components.
    pub unknowns: Vec<Unknown>,
    /// Orthonormal basis of the motions, dimensionless: rad and characteristic lengths.
    pub motions: Vec<Vec<f64>>,
    /// Singular values of the Jacobian, largest first.
    pub singular_values: Vec<f64>,
}

impl Freedoms {
    /// The motions that closures and held coordinates leave at a configuration. Beyond
    /// [`SPECTRUM_LIMIT`] unknowns nothing is computed, and the condition number is NaN.
    pub fn at(dimensions: &Dimensions<f64>, held: &Held<f64>, at: &Configuration<f64>) -> Self {
        let system = System::new(dimensions, held);
        if system.unknowns().len() > SPECTRUM_LIMIT {
            return Freedoms {
                unknowns: system.unknowns().to_vec(),
                motions: Vec::new(),
                singular_values: Vec::new(),
            };
        }
        let mut work = system.work();
        system.linearise(at, &mut work);
        let jacobian = system.dense_jacobian(&mut work);
        let (rows, columns) = (system.rows(), system.unknowns().len());
        let spectrum = Spectrum::of(rows, columns, &jacobian);
        Freedoms {
            unknowns: system.unknowns().to_vec(),
            motions: spectrum.null_space,
            singular_values: spectrum.values,
        }
    }

    /// The numerical rank of the Jacobian.
    pub fn rank(&self) -> usize {
        rank(&self.singular_values)
    }

    /// Ratio of the largest to the smallest singular value that counts; infinite where unknowns are
    /// not determined.
    pub fn condition(&self) -> f64 {
        match (
            self.singular_values.first(),
            self.singular_values
                .get(self.unknowns.len().wrapping_sub(1)),
        ) {
            (Some(largest), Some(smallest)) if self.motions.is_empty() => largest / smallest,
            (_, _) if self.unknowns.is_empty() => 1.0,
            (None, _) => f64::NAN,
            _ => f64::INFINITY,
        }
    }

    /// The same ratio over the unknowns that are determined.
    pub fn condition_of_determined(&self) -> f64 {
        match (self.rank(), self.singular_values.first()) {
            (0, _) | (_, None) => 1.0,
            (rank, Some(largest)) => largest / self.singular_values[rank - 1],
        }
    }

    /// The component of a motion along a joint variable.
    fn joint_rate(&self, motion: &[f64], joint: usize) -> f64 {
        let place = self
            .unknowns
            .iter()
            .position(|u| *u == Unknown::Joint(joint));
        place.map_or(0.0, |place| motion[place])
    }

    /// Whether every motion leaves the origin of every frame where it is: then only links turn
    /// about their own lines, as a rod between two balls does.
    pub fn are_idle(&self, mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
        self.motions.iter().all(|motion| {
            let moving = self.carried_along(mechanism, at, motion);
            let dimensions = mechanism.dimensions().map(&mut Dual::constant);
            let frames = mechanism.frames();
            let kinematics = Kinematics::new(&dimensions, frames.iter().copied());
            let mut placement = kinematics.placement();
            kinematics.place(&moving, &mut placement);
            frames.iter().all(|&frame| {
                let pose = kinematics.pose(frame, &placement);
                pose.is_some_and(|pose| {
                    let speed = pose.position.0.iter().map(|x| x.slope.abs());
                    speed.fold(0.0, f64::max) < 1e-6 * mechanism.characteristic_length()
                })
            })
        })
    }

    /// The configuration as it moves along a motion: values with their rates.
    fn carried_along(
        &self,
        mechanism: &Mechanism,
        at: &Configuration<f64>,
        motion: &[f64],
    ) -> Configuration<Dual<f64>> {
        let dimensions = mechanism.dimensions();
        let mut moving = at.map(Dual::constant);
        for (joint, value) in moving.joints.iter_mut().enumerate() {
            value.slope = self.joint_rate(motion, joint) * dimensions.joint_scales[joint];
        }
        for (platform, pose) in moving.platforms.iter_mut().enumerate() {
            let first = Unknown::Twist {
                platform,
                component: 0,
            };
            let Some(first) = self.unknowns.iter().position(|u| *u == first) else {
                continue;
            };
            let rate = |i: usize, factor: f64| Dual {
                value: 0.0,
                slope: motion[first + i] * factor,
            };
            let omega = crate::geometry::Vector3([0, 1, 2].map(|i| rate(i, 1.0)));
            let length = dimensions.characteristic_length;
            let shift = crate::geometry::Vector3([3, 4, 5].map(|i| rate(i, length)));
            *pose = pose.moved_by(&omega, shift);
        }
        moving
    }
}

/// A coordinate that can be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Holdable {
    /// A joint variable.
    Joint(usize),
    /// A platform coordinate.
    Coordinate(usize, Coordinate),
}

impl Holdable {
    /// Its name in questions.
    pub fn name(self, mechanism: &Mechanism) -> String {
        match self {
            Holdable::Joint(joint) => mechanism.joints()[joint].name.clone(),
            Holdable::Coordinate(platform, coordinate) => {
                let platform = &mechanism.platforms()[platform].name;
                format!("{platform}.{}", coordinate.name())
            }
        }
    }
}

/// The freedoms of a mechanism with nothing held, at an assembled configuration that is not special.
#[derive(Clone, Debug)]
pub struct Mobility {
    freedoms: Freedoms,
    at: Configuration<f64>,
    idle: usize,
}

impl Mobility {
    /// Looks near a configuration for assembled ones and takes the one with the fewest freedoms:
    /// what is lost or gained at a special configuration does not count. `None` if the mechanism
    /// does not assemble near there, or has too many unknowns to tell.
    pub fn near(mechanism: &Mechanism, start: &Configuration<f64>) -> Option<Self> {
        let dimensions = mechanism.dimensions();
        let all_free = Held {
            joints: vec![false; mechanism.joints().len()],
            platforms: vec![HeldPlatform::Free; mechanism.platforms().len()],
        };
        let system = System::new(dimensions, &all_free);
        if system.unknowns().len() > SPECTRUM_LIMIT {
            return None;
        }
        let mut work = system.work();
        let mut fewest: Option<(Freedoms, Configuration<f64>)> = None;
        // the start itself, and three points beside it in directions that have no symmetry
        for k in 0..4 {
            let mut at = start.clone();
            for (joint, value) in at.joints.iter_mut().enumerate() {
                let shake = 0.05 * f64::from(k) * (1.7 * (joint as f64 + 1.0) * f64::from(k)).sin();
                *value += shake * dimensions.joint_scales[joint];
            }
            let mut trial = at.clone();
            let report = Newton::default().solve(&system, &mut at, &mut trial, &mut work);
            if report.stop != Stop::Solved {
                continue;
            }
            let freedoms = Freedoms::at(dimensions, &all_free, &at);
            if fewest
                .as_ref()
                .is_none_or(|(f, _)| freedoms.motions.len() < f.motions.len())
            {
                fewest = Some((freedoms, at));
            }
        }
        let (freedoms, at) = fewest?;
        let idle = idle_freedoms(mechanism, dimensions, &at);
        Some(Mobility { freedoms, at, idle })
    }

    /// The number of freedoms, without those that only turn a link about its own line.
    pub fn count(&self) -> usize {
        self.freedoms.motions.len() - self.idle.min(self.freedoms.motions.len())
    }

    /// The number of freedoms that only turn a link about its own line.
    pub fn idle(&self) -> usize {
        self.idle
    }

    /// The first of the candidates that are independent of one another, as many as there are
    /// freedoms at most: holding them leaves nothing else to choose.
    pub fn independent(&self, mechanism: &Mechanism, candidates: &[Holdable]) -> Vec<Holdable> {
        let mut chosen = Vec::new();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for &candidate in candidates {
            if chosen.len() == self.count() {
                break;
            }
            let mut row = self.rates(mechanism, candidate);
            let size = norm(&row);
            for direction in &basis {
                let along: f64 = row.iter().zip(direction).map(|(a, b)| a * b).sum();
                row.iter_mut()
                    .zip(direction)
                    .for_each(|(a, b)| *a -= along * b);
            }
            let left = norm(&row);
            if left > 1e-6 && left > 1e-6 * size {
                row.iter_mut().for_each(|a| *a /= left);
                basis.push(row);
                chosen.push(candidate);
            }
        }
        chosen
    }

    /// How fast a coordinate changes along each freedom.
    fn rates(&self, mechanism: &Mechanism, candidate: Holdable) -> Vec<f64> {
        match candidate {
            Holdable::Joint(joint) => {
                let motions = self.freedoms.motions.iter();
                motions
                    .map(|motion| self.freedoms.joint_rate(motion, joint))
                    .collect()
            }
            Holdable::Coordinate(platform, coordinate) => {
                let length = mechanism.characteristic_length();
                let pose = self.at.platforms[platform].pose();
                let (_, slope) = coordinate.row(&pose, coordinate.of(&pose), length);
                let first = Unknown::Twist {
                    platform,
                    component: 0,
                };
                let first = self.freedoms.unknowns.iter().position(|u| *u == first);
                let first = first.expect("every platform is free here");
                let motions = self.freedoms.motions.iter();
                motions
                    .map(|motion| (0..6).map(|i| slope[i] * motion[first + i]).sum())
                    .collect()
            }
        }
    }
}

/// How many freedoms are left when every frame's origin stays where it is.
///
/// Counted as the motions of passive joints with all platforms and actuated joints fixed, if all of
/// them are idle.
fn idle_freedoms(
    mechanism: &Mechanism,
    dimensions: &Dimensions<f64>,
    at: &Configuration<f64>,
) -> usize {
    let held = Held {
        joints: (mechanism.joints().iter())
            .map(|joint| joint.role == crate::description::Role::Actuated)
            .collect(),
        platforms: vec![HeldPlatform::Pose; mechanism.platforms().len()],
    };
    let freedoms = Freedoms::at(dimensions, &held, at);
    if freedoms.are_idle(mechanism, at) {
        freedoms.motions.len()
    } else {
        0
    }
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|a| a * a).sum::<f64>().sqrt()
}
