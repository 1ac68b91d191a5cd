use crate::geometry::{Pose, Quaternion, Vector3};
use crate::number::Number;

/// The pose of a platform as the solver keeps it: orientation by a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatformPose<T> {
    /// Ground from platform.
    pub orientation: Quaternion<T>,
    /// Origin of the platform frame from the [centre](super::Dimensions::centre) along ground's axes, in m. The centre is
    /// ground's origin unless the mechanism is far from it; [`Mechanism::in_ground`](super::Mechanism::in_ground) has both.
    pub position: Vector3<T>,
}

impl<T: Number> PlatformPose<T> {
    /// The pose as a rotation matrix and a position.
    #[inline(always)]
    pub fn pose(&self) -> Pose<T> {
        Pose {
            rotation: self.orientation.rotation(),
            position: self.position,
        }
    }

    /// A pose from a rotation matrix and a position.
    pub fn from_pose(pose: &Pose<T>) -> Self {
        PlatformPose {
            orientation: Quaternion::from_rotation(&pose.rotation),
            position: pose.position,
        }
    }

    /// Moved by a small twist in ground: rotation vector ω about the platform's origin, in rad, and
    /// displacement of the origin, in m.
    #[inline(always)]
    pub fn moved_by(&self, omega: &Vector3<T>, displacement: Vector3<T>) -> Self {
        PlatformPose {
            orientation: self.orientation.turned_by(omega),
            position: self.position + displacement,
        }
    }
}

/// A configuration: a value for every joint variable and a pose for every platform.
///
/// It need not be assembled.
#[derive(Debug, PartialEq)]
pub struct Configuration<T> {
    /// Joint values in the order of the mechanism's joints: rad for revolute and helical joints, m for prismatic ones.
    pub joints: Vec<T>,
    /// Platform poses in the order of the mechanism's platforms.
    pub platforms: Vec<PlatformPose<T>>,
}

impl<T: Clone> Clone for Configuration<T> {
    fn clone(&self) -> Self {
        self.view().owned()
    }

    // in storage that is there
    fn clone_from(&mut self, of: &Self) {
        self.joints.clone_from(&of.joints);
        self.platforms.clone_from(&of.platforms);
    }
}

/// A borrowed configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfigurationRef<'a, T> {
    /// As in [`Configuration`].
    pub joints: &'a [T],
    /// As in [`Configuration`].
    pub platforms: &'a [PlatformPose<T>],
}

impl<T: Clone> ConfigurationRef<'_, T> {
    /// An owned copy.
    pub fn owned(self) -> Configuration<T> {
        Configuration {
            joints: self.joints.to_vec(),
            platforms: self.platforms.to_vec(),
        }
    }
}

impl<T> Configuration<T> {
    /// A view of its numbers.
    pub fn view(&self) -> ConfigurationRef<'_, T> {
        ConfigurationRef {
            joints: &self.joints,
            platforms: &self.platforms,
        }
    }
}

impl<T: Copy> Configuration<T> {
    /// Its numbers in the order in which [`map`](Self::map) takes them: joints, then orientation and position of each
    /// platform.
    pub fn numbers(&self) -> impl Iterator<Item = T> {
        let poses = self.platforms.iter();
        let poses = poses.flat_map(|pose| pose.orientation.0.into_iter().chain(pose.position.0));
        self.joints.iter().copied().chain(poses)
    }

    /// As above, by mutable reference.
    pub fn numbers_mut(&mut self) -> impl Iterator<Item = &mut T> {
        let poses = self.platforms.iter_mut();
        let poses =
            poses.flat_map(|pose| pose.orientation.0.iter_mut().chain(&mut pose.position.0));
        self.joints.iter_mut().chain(poses)
    }
}

impl<T: Number> Configuration<T> {
    /// The configuration over another number.
    pub fn map<U: Number>(&self, mut f: impl FnMut(T) -> U) -> Configuration<U> {
        Configuration {
            joints: self.joints.iter().map(|&x| f(x)).collect(),
            platforms: (self.platforms.iter())
                .map(|p| {
                    let [w, x, y, z] = p.orientation.0;
                    PlatformPose {
                        orientation: Quaternion([f(w), f(x), f(y), f(z)]),
                        position: p.position.map(&mut f),
                    }
                })
                .collect(),
        }
    }
}
