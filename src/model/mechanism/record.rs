//! Values of joints, frames and platforms as reports carry them.

use std::fmt::{self, Formatter};
use std::marker::PhantomData;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Configuration, Mechanism, Variable};
use crate::geometry::{Pose, Quaternion, RollPitchYaw};

/// Values by name, in the order of the mechanism file; serialised as a map.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(inline, with = "std::collections::BTreeMap<String, T>")
)]
pub struct ByName<T>(pub Vec<(String, T)>);

impl<T> ByName<T> {
    /// The value of that name.
    pub fn get(&self, name: &str) -> Option<&T> {
        let mut found = self.0.iter().filter(|(n, _)| n == name);
        found.next().map(|(_, value)| value)
    }

    /// The values without their names.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &T> {
        self.0.iter().map(|(_, value)| value)
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if there are no values.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T> FromIterator<(String, T)> for ByName<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(values: I) -> Self {
        ByName(values.into_iter().collect())
    }
}

impl<T: Serialize> Serialize for ByName<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for ByName<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for InOrder<T> {
            type Value = ByName<T>;

            fn expecting(&self, f: &mut Formatter) -> fmt::Result {
                f.write_str("a map from names to values")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ByName<T>, A::Error> {
                let entries = std::iter::from_fn(|| map.next_entry().transpose());
                entries.collect::<Result<_, _>>().map(ByName)
            }
        }
        deserializer.deserialize_map(InOrder(PhantomData))
    }
}

/// A frame in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrameRecord {
    /// Its origin, in m.
    pub position: [f64; 3],
    /// Its rotation matrix, row by row; the columns are its axes n, s, a.
    pub rotation: [[f64; 3]; 3],
    /// Its rotation as a unit quaternion: scalar first, the first component other than zero positive.
    pub quaternion: [f64; 4],
}

/// A platform in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlatformRecord {
    /// Its own frame.
    #[serde(flatten)]
    pub frame: FrameRecord,
    /// Roll, pitch, yaw in rad: R = Rz(yaw)·Ry(pitch)·Rx(roll).
    pub roll_pitch_yaw: [f64; 3],
}

impl FrameRecord {
    /// The frame at a pose.
    pub fn of(pose: &Pose<f64>) -> Self {
        FrameRecord {
            position: pose.position.0,
            rotation: pose.rotation.rows(),
            quaternion: Quaternion::from_rotation(&pose.rotation).canonical().0,
        }
    }
}

impl PlatformRecord {
    /// The platform at a pose.
    pub fn of(pose: &Pose<f64>) -> Self {
        let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
        PlatformRecord {
            frame: FrameRecord::of(pose),
            roll_pitch_yaw: [roll, pitch, yaw],
        }
    }
}

/// The names in formulas about a mechanism.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FormulaNames {
    /// The joint variables, in the order of the file.
    pub joints: Vec<Variable>,
    /// The parameters, in the order of the file.
    pub parameters: Vec<String>,
    /// The platforms, in the order of the file.
    pub platforms: Vec<String>,
}

impl Mechanism {
    /// Values of the joint variables, rad or m, with the names of these.
    pub fn named_joints(&self, values: &[f64]) -> ByName<f64> {
        let joints = self.joints().iter().zip(values);
        joints
            .map(|(joint, &value)| (joint.name.clone(), value))
            .collect()
    }

    /// Values of all joints with their names, those of joints at which loops are cut after those of the joint variables.
    pub fn all_joints(&self, at: &Configuration<f64>) -> ByName<f64> {
        let mut all = self.named_joints(&at.joints);
        let cut = self.closing_joints().iter().zip(self.closing_values(at));
        all.0
            .extend(cut.map(|(joint, value)| (joint.name.clone(), value)));
        all
    }

    /// The names of the joints at which loops are cut.
    pub fn cut_joints(&self) -> Vec<String> {
        let cut = self.closing_joints().iter();
        cut.map(|joint| joint.name.clone()).collect()
    }

    /// The names in formulas.
    pub fn names_in_formulas(&self) -> FormulaNames {
        let parameters = self.parameters().iter().map(|part| part.name.to_string());
        let platforms = self.platforms().iter().map(|part| part.name.clone());
        FormulaNames {
            joints: Variable::joints(self),
            parameters: parameters.collect(),
            platforms: platforms.collect(),
        }
    }
}
