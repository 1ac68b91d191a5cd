//! What a question holds.

use super::{Question, with_coordinates};
use crate::geometry::{Axis, Pose, RollPitchYaw};
use crate::mechanism::Coordinate;
use crate::system::Holdable;

impl Question<'_> {
    /// The held coordinates, those asked for before the joints that are held only because the file
    /// says so. A whole pose pitched by ±90° turns about the axes of ground.
    pub fn held_coordinates(&self) -> Vec<Holdable> {
        let platforms = self.coordinates.iter().enumerate();
        let coordinates = platforms.flat_map(|(platform, values)| {
            let held = Coordinate::ALL.into_iter().zip(values);
            let held = held.filter_map(|(c, value)| Some((c, (*value)?)));
            let held: Vec<(Coordinate, f64)> = held.collect();
            let pose = with_coordinates(&Pose::identity(), held.iter().copied());
            let locked = held.len() == 6 && RollPitchYaw::is_locked(&pose.rotation);
            let holdable = move |(c, _): (Coordinate, f64)| match c {
                Coordinate::Roll if locked => Holdable::Turn(platform, Axis::X),
                Coordinate::Pitch if locked => Holdable::Turn(platform, Axis::Y),
                Coordinate::Yaw if locked => Holdable::Turn(platform, Axis::Z),
                c => Holdable::Coordinate(platform, c),
            };
            held.into_iter().map(holdable)
        });
        let held = (0..self.joints.len()).filter(|&joint| self.joints[joint]);
        let (asked, by_file): (Vec<usize>, Vec<usize>) = held.partition(|&joint| self.asked[joint]);
        let joints = |joints: Vec<usize>| joints.into_iter().map(Holdable::Joint);
        (joints(asked).chain(coordinates).chain(joints(by_file))).collect()
    }

    /// The held coordinates as they are driven and as they carry loads: a platform whose whole
    /// orientation is held turns about the axes of ground, which is never singular, where roll, pitch
    /// and yaw are near a pitch of ±90°.
    pub fn driven_coordinates(&self) -> Vec<Holdable> {
        let held = self.held_coordinates().into_iter();
        held.map(|coordinate| match coordinate {
            Holdable::Coordinate(platform, c) if self.held_angles(platform).is_some() => match c {
                Coordinate::Roll => Holdable::Turn(platform, Axis::X),
                Coordinate::Pitch => Holdable::Turn(platform, Axis::Y),
                Coordinate::Yaw => Holdable::Turn(platform, Axis::Z),
                Coordinate::X | Coordinate::Y | Coordinate::Z => coordinate,
            },
            Holdable::Coordinate(..) | Holdable::Joint(_) | Holdable::Turn(..) => coordinate,
        })
        .collect()
    }

    /// Roll, pitch and yaw of a platform whose whole orientation is held.
    pub fn held_angles(&self, platform: usize) -> Option<RollPitchYaw<f64>> {
        let value = |c: Coordinate| self.coordinates[platform][c as usize];
        Some(RollPitchYaw {
            roll: value(Coordinate::Roll)?,
            pitch: value(Coordinate::Pitch)?,
            yaw: value(Coordinate::Yaw)?,
        })
    }

    /// The names of the held coordinates.
    pub fn held_names(&self) -> Vec<String> {
        let joints = self.mechanism.joints().iter().zip(&self.joints);
        let joints = joints
            .filter(|(_, held)| **held)
            .map(|(joint, _)| joint.name.clone());
        let platforms = self.mechanism.platforms().iter().zip(&self.coordinates);
        let coordinates = platforms.flat_map(|(platform, values)| {
            let held = Coordinate::ALL
                .into_iter()
                .zip(values)
                .filter(|(_, v)| v.is_some());
            held.map(|(c, _)| format!("{}.{}", platform.name, c.name()))
        });
        joints.chain(coordinates).collect()
    }
}
