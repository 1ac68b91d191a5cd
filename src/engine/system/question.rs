//! Questions posed by name: held, free and guessed coordinates, and where to start.

mod count;
mod demand;
mod drive;
mod error;
mod forces;
mod held;
mod names;
mod outputs;
mod spins;

pub use count::{Count, check_angle, check_angles, check_count, redundant_motors};
pub use demand::{Demand, Role};
pub use drive::{Drive, DriveError};
pub use error::QuestionError;
pub use forces::{ForceError, Load};
pub use held::with_coordinates;
pub use outputs::{
    actuated, coordinate_outputs, default_outputs, free_outputs, inputs_of, platform_outputs,
};
pub use spins::Still;

use super::equations::System;
use crate::description;
use crate::geometry::Pose;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate, Value};
use crate::system::{Coordinate, Held, HeldParts, HeldPlatform};
use demand::DemandTarget;

/// A question about a mechanism: which coordinates are held at which values, and where to start.
///
/// A fresh question holds the actuated joints at home and starts at the home configuration. Joints are named as in the
/// file, platform coordinates `top.x`, `top.y`, `top.z` (m) and `top.roll`, `top.pitch`, `top.yaw` (rad, see
/// [`RollPitchYaw`](crate::geometry::RollPitchYaw)), a whole pose by the platform's name.
#[derive(Clone, Debug)]
pub struct Question<'a> {
    mechanism: &'a Mechanism,
    joints: Vec<bool>,
    /// Joints held by name rather than by the file.
    held_by_name: Vec<bool>,
    coordinates: Vec<[Option<f64>; 6]>,
    start: Configuration<f64>,
    guessed_joints: Vec<bool>,
    guessed_platforms: Vec<bool>,
    changed: bool,
    split_changed: bool,
    /// Coordinates that stay where they are so that links do not spin about their own lines (local freedoms).
    still: Vec<Still>,
    /// True if it is known that no link spins about its own line.
    spinless: bool,
    /// The demands made by name so far.
    demands: Vec<(DemandTarget, Demand)>,
}

impl<'a> Question<'a> {
    /// The file's own question: actuated joints held at home, all else to be found.
    pub fn new(mechanism: &'a Mechanism) -> Self {
        let platforms = mechanism.platforms().len();
        Question {
            joints: (mechanism.joints().iter())
                .map(|joint| joint.role == description::Role::Actuated)
                .collect(),
            held_by_name: vec![false; mechanism.joints().len()],
            coordinates: vec![[None; 6]; platforms],
            start: mechanism.home(),
            guessed_joints: vec![false; mechanism.joints().len()],
            guessed_platforms: vec![false; platforms],
            changed: false,
            split_changed: false,
            still: Vec::new(),
            spinless: false,
            demands: Vec::new(),
            mechanism,
        }
    }

    /// Holds a joint, a platform coordinate or a whole pose.
    ///
    /// `value` is a number in m or rad, or a text as in the file ([`Value`]).
    ///
    /// # Errors
    /// If there is no such joint or coordinate, the value has none, or something else was demanded of it before.
    pub fn hold(mut self, name: &str, value: impl Into<Value>) -> Result<Self, QuestionError> {
        let value = &value.into();
        match self.demand(Role::Hold, name, Some(value))? {
            DemandTarget::Coordinate(of) => {
                let number = self.number(name, value, of)?;
                self.split_changed |= match of {
                    Coordinate::Joint(joint) => {
                        self.held_by_name[joint] = true;
                        !self.joints[joint]
                    }
                    Coordinate::Pose(..) | Coordinate::Turn(..) => true,
                };
                self = self.at_values([(of, number)]);
            }
            DemandTarget::Pose(platform) => {
                let pose = self.guess_pose(name, value, platform)?;
                self.coordinates[platform] = PoseCoordinate::ALL.map(|c| Some(c.of(&pose)));
                self.split_changed = true;
            }
        }
        self.changed = true;
        Ok(self)
    }

    /// The question with some joints left to be found.
    pub(crate) fn letting_go(mut self, joints: &[usize]) -> Self {
        joints.iter().for_each(|&joint| self.joints[joint] = false);
        self.split_changed = true;
        self
    }

    /// Lets a joint be found, actuated or not; `actuated` frees every actuated joint.
    pub fn free(mut self, name: &str) -> Result<Self, QuestionError> {
        if name == "actuated" && self.mechanism.joint(name).is_none() {
            for (held, joint) in self.joints.iter_mut().zip(self.mechanism.joints()) {
                *held &= joint.role != description::Role::Actuated;
            }
        } else {
            match self.demand(Role::Free, name, None)? {
                DemandTarget::Coordinate(Coordinate::Joint(joint)) => self.joints[joint] = false,
                _ => return Err(QuestionError::NotAJoint(name.into())),
            }
        }
        self.split_changed = true;
        Ok(self)
    }

    /// Starts the search at another value of a joint, a platform coordinate or a whole pose.
    ///
    /// A joint that the file holds at home is held at the guess instead; coordinates held by
    /// [`hold`](Self::hold) keep their values.
    ///
    /// # Errors
    /// If there is no such joint or coordinate, the value has none, or something else was guessed of it before.
    pub fn guess(mut self, name: &str, value: impl Into<Value>) -> Result<Self, QuestionError> {
        let value = &value.into();
        match self.demand(Role::Guess, name, Some(value))? {
            DemandTarget::Coordinate(of) => {
                let number = self.number(name, value, of)?;
                match of {
                    Coordinate::Joint(joint) if !self.held_by_name[joint] => {
                        self.start.joints[joint] = number;
                        self.guessed_joints[joint] = true;
                        self.changed = true;
                    }
                    Coordinate::Pose(platform, c) => {
                        let pose = self.mechanism.in_ground(&self.start.platforms[platform]);
                        self.start_at(platform, &with_coordinates(&pose, [(c, number)]));
                    }
                    Coordinate::Joint(_) | Coordinate::Turn(..) => {}
                }
            }
            DemandTarget::Pose(platform) => {
                self.guess_pose(name, value, platform)?;
            }
        }
        Ok(self)
    }

    /// Starts the search at a whole configuration; held coordinates keep their values.
    pub fn near(mut self, at: &Configuration<f64>) -> Self {
        let joints = self.start.joints.iter_mut().zip(&at.joints);
        for ((own, value), held) in joints.zip(&self.joints) {
            if !held {
                *own = *value;
            }
        }
        for (own, pose) in self.start.platforms.iter_mut().zip(&at.platforms) {
            *own = *pose;
        }
        self.guessed_joints.fill(true);
        self.guessed_platforms.fill(true);
        self
    }

    /// The question with held coordinates at other values, in m or rad.
    pub fn at_values(mut self, values: impl IntoIterator<Item = (Coordinate, f64)>) -> Self {
        for (coordinate, value) in values {
            match coordinate {
                Coordinate::Joint(joint) => {
                    self.joints[joint] = true;
                    self.start.joints[joint] = value;
                }
                Coordinate::Pose(platform, c) => {
                    self.coordinates[platform][c as usize] = Some(value);
                }
                // it has no value
                Coordinate::Turn(..) => {}
            }
        }
        self
    }

    /// These coordinates held where they are in a configuration, and nothing else.
    pub fn locking(
        mechanism: &'a Mechanism,
        locked: &[Coordinate],
        at: &Configuration<f64>,
    ) -> Self {
        let joints = (0..mechanism.joints().len()).map(Coordinate::Joint);
        let nothing = joints.fold(Question::new(mechanism), Question::without);
        (nothing.near(at)).at_values(
            locked
                .iter()
                .map(|coordinate| (*coordinate, coordinate.of(mechanism, at))),
        )
    }

    /// Frees one coordinate.
    pub fn without(mut self, coordinate: Coordinate) -> Self {
        match coordinate {
            Coordinate::Joint(joint) => self.joints[joint] = false,
            Coordinate::Pose(platform, c) => self.coordinates[platform][c as usize] = None,
            Coordinate::Turn(platform, _) => self.coordinates[platform] = [None; 6],
        }
        self
    }

    /// The lengths that are held, in m.
    pub(crate) fn held_lengths(&self) -> Vec<f64> {
        let joints = self.mechanism.joints().iter().enumerate();
        let joints = joints.filter(|(i, joint)| self.joints[*i] && !joint.kind.is_angle());
        let own = |of: Coordinate, value: f64| of.own_length(self.mechanism, value);
        let positions = self.coordinates.iter().enumerate().flat_map(|(p, values)| {
            let positions = PoseCoordinate::ALL.into_iter().zip(&values[..3]);
            positions.filter_map(move |(c, value)| Some(own(Coordinate::Pose(p, c), (*value)?)))
        });
        joints
            .map(|(i, _)| own(Coordinate::Joint(i), self.start.joints[i]))
            .chain(positions)
            .collect()
    }

    /// The coordinates of a platform that are held, with their values in m or rad.
    pub fn held_values(&self, platform: usize) -> Vec<(PoseCoordinate, f64)> {
        let given = PoseCoordinate::ALL.into_iter();
        let given = given.zip(&self.coordinates[platform]);
        given
            .filter_map(|(c, value)| Some((c, (*value)?)))
            .collect()
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &'a Mechanism {
        self.mechanism
    }

    /// The held coordinates in the form of the solver, with local spins stopped.
    pub fn held(&self) -> Held<f64> {
        let platforms = (0..self.coordinates.len()).map(|platform| {
            let given = self.held_values(platform);
            let angles = given.iter().filter(|(c, _)| c.is_angle()).count();
            match given.len() {
                0 => HeldPlatform::Free,
                6 => HeldPlatform::Pose,
                // three angles at once are an orientation, which has no gimbal lock
                _ if angles == 3 => HeldPlatform::Partly(HeldParts {
                    orientation: Some(
                        with_coordinates(&Pose::identity(), given.iter().copied()).rotation,
                    ),
                    coordinates: given.into_iter().filter(|(c, _)| !c.is_angle()).collect(),
                    ..HeldParts::default()
                }),
                _ => HeldPlatform::Partly(HeldParts {
                    coordinates: given,
                    ..HeldParts::default()
                }),
            }
        });
        self.with_still(Held {
            joints: self.joints.clone(),
            platforms: platforms.collect(),
        })
    }

    /// The equations of the question.
    pub fn system(&self) -> System<f64> {
        System::reduced(self.mechanism, self.mechanism.dimensions(), &self.held())
    }

    /// The equations over another number, as [`Recorded`](crate::algebra::Recorded).
    pub fn system_over<T: Factorable>(&self) -> System<T> {
        let dimensions = self.mechanism.dimensions().map(&mut T::from_f64);
        System::reduced(self.mechanism, &dimensions, &self.held().map(T::from_f64))
    }

    /// Start of the search: guesses and held values, and the home configuration for the rest.
    pub fn start(&self) -> Configuration<f64> {
        let mut start = self.start.clone();
        for (platform, pose) in start.platforms.iter_mut().enumerate() {
            let given = self.held_values(platform);
            if !given.is_empty() {
                let there = self.mechanism.in_ground(pose);
                *pose = (self.mechanism).from_ground(&with_coordinates(&there, given));
            }
        }
        start
    }

    /// For each joint, true if its starting value was given with the question.
    pub fn guessed_joints(&self) -> &[bool] {
        &self.guessed_joints
    }

    /// The value a joint was to start at, if one was given for it alone.
    pub(super) fn guess_of(&self, joint: usize) -> Option<f64> {
        let asked = (self.demands.iter()).any(|(of, demand)| {
            *of == DemandTarget::Coordinate(Coordinate::Joint(joint)) && demand.role == Role::Guess
        });
        asked.then(|| self.start.joints[joint])
    }

    /// For each platform, true if its starting pose was given with the question.
    pub fn guessed_platforms(&self) -> &[bool] {
        &self.guessed_platforms
    }

    /// True if a value given with the question moves the start from the home configuration.
    pub fn differs_from_home(&self) -> bool {
        self.changed
    }

    /// True if other coordinates are held than the actuated joints of the file.
    pub fn split_changed(&self) -> bool {
        self.split_changed
    }

    /// Starts at the pose that a value stands for.
    fn guess_pose(
        &mut self,
        name: &str,
        value: &Value,
        platform: usize,
    ) -> Result<Pose<f64>, QuestionError> {
        let pose = match value.is_home() {
            true => Ok(self.mechanism.platforms()[platform].home),
            false => value.pose(self.mechanism),
        };
        let pose = pose.map_err(|error| QuestionError::value(name, value, error))?;
        self.start_at(platform, &pose);
        Ok(pose)
    }

    fn start_at(&mut self, platform: usize, pose: &Pose<f64>) {
        self.start.platforms[platform] = self.mechanism.from_ground(pose);
        self.guessed_platforms[platform] = true;
    }
}
