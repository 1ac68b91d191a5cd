//! A choice of independent coordinates.

use crate::geometry::{RollPitchYaw, Rotation};
use crate::linear::{Decomposition, INDEPENDENT, norm, remove};
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::number::real::hypot;
use crate::solve::Warm;
use crate::system::equations;
use crate::system::{
    Balance, Coordinate, Freedoms, Held, HeldPlatform, Load, Motion, MotionTracker, NoDynamics,
    Still, System,
};

/// An assembled configuration with the derivatives of all unknowns by the independent coordinates.
#[derive(Clone)]
pub(super) struct Base {
    pub at: Configuration<f64>,
    pub values: Vec<f64>,
    pub responses: Vec<Vec<f64>>,
    /// Rates of the independent coordinates there and the curvature of the path along them.
    pub rates: Vec<f64>,
    pub curvature: Vec<f64>,
}

/// For each platform the orientation from which its angles are measured, if not that of ground: where it is pitched far,
/// its roll and yaw turn about nearly one line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct References(Vec<Option<Rotation<f64>>>);

/// cos(pitch) beyond which angles lead well, and below which they no longer do.
const LEVEL: [f64; 2] = [0.5, 0.25];

impl References {
    /// Those at a configuration: none of a platform of which an angle is locked.
    fn at(mechanism: &Mechanism, locked: &[Coordinate], at: &Configuration<f64>) -> Self {
        let turned = |platform: usize| {
            let rotation = at.platforms[platform].pose().rotation;
            let kept = locked
                .iter()
                .any(|of| of.platform() == Some(platform) && of.is_angle(mechanism));
            (!kept && level(&rotation) < LEVEL[0]).then_some(rotation)
        };
        References((0..at.platforms.len()).map(turned).collect())
    }

    /// The configuration with orientations measured from these.
    pub fn measured(&self, at: &Configuration<f64>) -> Configuration<f64> {
        let mut measured = at.clone();
        for (pose, reference) in measured.platforms.iter_mut().zip(&self.0) {
            if reference.is_some() {
                *pose = PlatformPose::from_pose(&equations::measured(&pose.pose(), reference));
            }
        }
        measured
    }
}

/// The cosine of the pitch.
fn level(rotation: &Rotation<f64>) -> f64 {
    hypot(rotation.0[0].0[0], rotation.0[0].0[1])
}

/// One choice of independent coordinates.
pub(super) struct Chart {
    /// The independent coordinates, then those that are locked.
    pub coordinates: Vec<Coordinate>,
    pub free: usize,
    references: References,
    pub motion: Motion,
    pub tracker: MotionTracker,
    pub balance: Balance,
}

impl Chart {
    pub fn at(
        mechanism: &Mechanism,
        load: &Load,
        (locked, still): (&[Coordinate], &[Still]),
        freedoms: usize,
        at: &Configuration<f64>,
    ) -> Result<Self, NoDynamics> {
        let choice = Chart::choice(mechanism, (locked, still), freedoms, at)?;
        Ok(Chart::of(mechanism, load, still, choice, freedoms, at))
    }

    /// The configuration with orientations measured as its coordinates are.
    pub fn measured(&self, at: &Configuration<f64>) -> Configuration<f64> {
        self.references.measured(at)
    }

    /// True if these coordinates are that choice.
    pub fn is(&self, (coordinates, references): &(Vec<Coordinate>, References)) -> bool {
        self.coordinates == *coordinates && self.references == *references
    }

    /// True if an angle of a platform is locked that is pitched by ±90°, where it has no value.
    pub fn is_gimbal_locked(&self, at: &Configuration<f64>) -> bool {
        self.coordinates[self.free..].iter().any(|of| match *of {
            Coordinate::Pose(platform, c) if c.is_angle() => {
                level(&at.platforms[platform].pose().rotation) < 1e-3
            }
            _ => false,
        })
    }

    /// False if an angle of a platform no longer leads well.
    pub fn leads(&self, at: &Configuration<f64>) -> bool {
        let at = self.measured(at);
        self.coordinates[..self.free].iter().all(|of| match *of {
            Coordinate::Pose(platform, c) if c.is_angle() => {
                level(&at.platforms[platform].pose().rotation) > LEVEL[1]
            }
            _ => true,
        })
    }

    /// The name of a coordinate: of an angle measured from where a platform was, that of the turn about an axis of ground.
    pub fn name(&self, of: Coordinate, mechanism: &Mechanism) -> String {
        match of {
            Coordinate::Pose(platform, c) if self.references.0[platform].is_some() => {
                Coordinate::turn_for(platform, c).name(mechanism)
            }
            _ => of.name(mechanism),
        }
    }

    pub fn of(
        mechanism: &Mechanism,
        load: &Load,
        still: &[Still],
        (coordinates, references): (Vec<Coordinate>, References),
        free: usize,
        at: &Configuration<f64>,
    ) -> Self {
        let frames = Balance::<f64>::frames(mechanism, load, false);
        let motion = Motion::placing(mechanism, &coordinates, &frames, |mut held| {
            for (platform, reference) in held.platforms.iter_mut().zip(&references.0) {
                if let HeldPlatform::Partly(parts) = platform {
                    parts.reference = *reference;
                }
            }
            Still::held_with(still, held)
        });
        let balance = Balance::new(mechanism, load, &motion, motion.kinematics(), false);
        let system = System::new(mechanism.dimensions(), motion.held());
        // points between steps are met in any order, so that extrapolation would lead astray
        let from_last = Warm {
            extrapolation: 0,
            ..Warm::default()
        };
        let mut tracker = MotionTracker::new(system, at.clone()).with(from_last);
        tracker.restart(at);
        Chart {
            coordinates,
            references,
            free,
            motion,
            tracker,
            balance,
        }
    }

    pub fn held(
        mechanism: &Mechanism,
        (locked, still): (&[Coordinate], &[Still]),
        at: &Configuration<f64>,
    ) -> Held<f64> {
        let mut held = Held::nothing(mechanism);
        for &coordinate in locked {
            match coordinate {
                Coordinate::Joint(joint) => held.joints[joint] = true,
                Coordinate::Pose(platform, c) => {
                    if let Some(parts) = held.platforms[platform].parts_mut() {
                        parts.coordinates.push((c, coordinate.about_centre(at)));
                    }
                }
                Coordinate::Turn(..) => {}
            }
        }
        Still::held_with(still, held)
    }

    /// The coordinates that lead best at a configuration: each next one is that which the freedoms left move fastest. The
    /// locked ones follow.
    pub fn choice(
        mechanism: &Mechanism,
        (locked, still): (&[Coordinate], &[Still]),
        freedoms: usize,
        at: &Configuration<f64>,
    ) -> Result<(Vec<Coordinate>, References), NoDynamics> {
        let held = Chart::held(mechanism, (locked, still), at);
        let system = System::new(mechanism.dimensions(), &held);
        let found = Freedoms::of(&system, at, &mut system.work());
        if found.motions.len() != freedoms {
            return Err(NoDynamics::Singular);
        }
        let references = References::at(mechanism, locked, at);
        let at = references.measured(at);
        let rate = |of: Coordinate, motion: &Vec<f64>| -> f64 {
            let slope = of.slope_in(&system, &at).into_iter();
            slope.map(|(place, slope)| slope * motion[place]).sum()
        };
        let gimbal =
            |platform: usize| RollPitchYaw::is_locked(&at.platforms[platform].pose().rotation);
        let candidates = Coordinate::all(mechanism).filter(|of| match *of {
            Coordinate::Joint(joint) => !held.joints[joint],
            Coordinate::Pose(platform, c) => {
                !(locked.contains(of) || c.is_angle() && gimbal(platform))
            }
            Coordinate::Turn(..) => false,
        });
        let mut rows: Vec<(Coordinate, Vec<f64>)> = candidates
            .map(|of| {
                (
                    of,
                    found
                        .motions
                        .iter()
                        .map(|motion| rate(of, motion))
                        .collect(),
                )
            })
            .collect();
        let mut chosen = Vec::new();
        while chosen.len() < freedoms {
            // of equals the first
            let mut best: Option<(f64, usize)> = None;
            for (i, (_, row)) in rows.iter().enumerate() {
                let size = norm(row);
                if best.is_none_or(|(most, _)| size > most * (1.0 + 1e-6)) {
                    best = Some((size, i));
                }
            }
            let Some((size, i)) = best.filter(|(size, _)| *size > INDEPENDENT) else {
                return Err(NoDynamics::NoCoordinates);
            };
            let (of, mut row) = rows.remove(i);
            row.iter_mut().for_each(|x| *x /= size);
            for (_, other) in &mut rows {
                remove(other, std::slice::from_ref(&row));
            }
            chosen.push(of);
        }
        chosen.extend_from_slice(locked);
        Ok((chosen, references))
    }
}

/// M⁻¹·Q.
pub(super) fn accelerations(mass: &[f64], forces: &[f64]) -> Vec<f64> {
    match forces {
        [] => Vec::new(),
        [force] => vec![force / mass[0]],
        _ => Decomposition::of(forces.len(), forces.len(), mass).solve(forces),
    }
}
