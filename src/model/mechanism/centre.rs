//! The place from which positions are measured: amid the bases of a mechanism that is far from the origin of ground.

use super::lift::{nearest, places_on_ground};
use super::{Dimensions, Frame, Mechanism, PlatformPose};
use crate::algebra::EvaluationError;
use crate::description::ProblemKind;
use crate::geometry::{Pose, Vector3};
use crate::number::Number;
use crate::number::tolerance::SOLVED;

impl Mechanism {
    /// The dimensions for given values of the parameters about a centre that is near to the bases there: the one there is,
    /// or the origin, or else the place of the box round the bases that is nearest to it.
    pub(super) fn centred(&self, parameters: &[f64]) -> Result<Dimensions<f64>, EvaluationError> {
        let dimensions = self.dimensions_over(parameters)?;
        // within ten characteristic lengths no more than a digit is lost
        let near = 10.0 * dimensions.characteristic_length;
        let mut places: Vec<[f64; 3]> = places_on_ground(&dimensions)
            .into_iter()
            .map(|(_, place)| place)
            .collect();
        if places.is_empty() {
            let homes = self.home().platforms.into_iter();
            places.extend(homes.map(|pose| pose.position.0));
        }
        let from_centre = Vector3(nearest(&places));
        if from_centre.norm() <= near {
            return Ok(dimensions);
        }
        let centre = Vector3(dimensions.centre) + from_centre;
        let centre = match centre.norm() <= near {
            true => [0.0; 3],
            false => centre.0,
        };
        self.dimensions_about((centre, None), parameters)
    }

    /// The mechanism with positions measured along the axes of a chain's base on ground, from there, if more closure equations
    /// vanish everywhere so, as those across the plane of a loop that is tilted in ground; otherwise a copy.
    ///
    /// Only joints of its configurations mean the same as before: one with platforms stays as it is.
    pub fn level(&self) -> Mechanism {
        let mut level = self.clone();
        if !self.platforms.is_empty() {
            return level;
        }
        let own = self.dimensions();
        let parameters: Vec<f64> = self.parameters.iter().map(|of| of.value).collect();
        let ground = own.ground().inverse();
        for chain in own.chains.iter().filter(|chain| chain.on == Frame::Ground) {
            let base = ground * chain.base;
            let about = (base.position.0, Some(base.rotation));
            if let Ok(mut dimensions) = self.dimensions_about(about, &parameters) {
                (dimensions.characteristic_length, dimensions.joint_scales) =
                    (own.characteristic_length, own.joint_scales.clone());
                let mut turned = self.clone();
                turned.set_dimensions(dimensions);
                if turned.equations_that_vary() < level.equations_that_vary() {
                    level = turned;
                }
            }
        }
        level
    }

    /// That it is so far from the origin of ground that positions there keep fewer digits of its size than equations are
    /// solved to.
    pub(super) fn far_away(&self) -> Option<ProblemKind> {
        let (distance, size) = (
            Vector3(self.dimensions.centre).norm(),
            self.characteristic_length(),
        );
        let rounding = f64::EPSILON * distance / size;
        (rounding > SOLVED).then(|| ProblemKind::FarFromOrigin {
            distance,
            size,
            digits: (1..)
                .take_while(|&k| rounding * 10f64.powi(k) <= 1.0)
                .count() as u32,
        })
    }

    /// The pose of a platform in ground, positions in m: that of a configuration is given from the
    /// [centre](Dimensions::centre).
    pub fn in_ground<T: Number>(&self, platform: &PlatformPose<T>) -> Pose<T> {
        self.shifted(platform.pose())
    }

    /// The pose in a configuration of a platform with this pose in ground.
    pub fn from_ground(&self, pose: &Pose<f64>) -> PlatformPose<f64> {
        let mut from_centre = *pose;
        from_centre.position = self.to_centre(pose.position);
        PlatformPose::from_pose(&from_centre)
    }

    /// A pose with its position from the centre as one in ground.
    pub fn shifted<T: Number>(&self, mut pose: Pose<T>) -> Pose<T> {
        pose.position = self.to_ground(pose.position);
        pose
    }

    /// A place in ground from one given from the centre.
    pub fn to_ground<T: Number>(&self, place: Vector3<T>) -> Vector3<T> {
        match self.dimensions.centre == [0.0; 3] {
            true => place,
            false => place + Vector3(self.dimensions.centre.map(T::from_f64)),
        }
    }

    /// The place in ground of an axis that is nearest to its origin, given that nearest to the centre and its direction.
    pub fn foot(&self, place: Vector3<f64>, along: &Vector3<f64>) -> Vector3<f64> {
        match self.dimensions.centre == [0.0; 3] {
            true => place,
            false => {
                let place = self.to_ground(place);
                place - along.times(place.dot(along) / along.dot(along))
            }
        }
    }

    /// A position in ground as one from the centre.
    pub fn to_centre<T: Number>(&self, place: Vector3<T>) -> Vector3<T> {
        match self.dimensions.centre == [0.0; 3] {
            true => place,
            false => place - Vector3(self.dimensions.centre.map(T::from_f64)),
        }
    }
}
