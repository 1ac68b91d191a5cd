//! Plain data that the reports of several analyses share.

use std::fmt::{self, Display, Formatter};
use std::marker::PhantomData;
use std::str::FromStr;

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::algebra::SiUnit;
use crate::geometry::{Pose, Quaternion, RollPitchYaw};
use crate::mechanism::Mechanism;

/// Values by name, in the order of the mechanism file; serialised as a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Named<T>(pub Vec<(String, T)>);

impl<T> Default for Named<T> {
    fn default() -> Self {
        Named(Vec::new())
    }
}

impl<T> Named<T> {
    /// The value of that name.
    pub fn get(&self, name: &str) -> Option<&T> {
        let mut found = self.0.iter().filter(|(n, _)| n == name);
        found.next().map(|(_, value)| value)
    }

    /// The values without their names.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &T> {
        self.0.iter().map(|(_, value)| value)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T> FromIterator<(String, T)> for Named<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(values: I) -> Self {
        Named(values.into_iter().collect())
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, value) in &self.0 {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for InOrder<T> {
            type Value = Named<T>;

            fn expecting(&self, f: &mut Formatter) -> fmt::Result {
                f.write_str("a map from names to values")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<T>, A::Error> {
                let mut values = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    values.push(entry);
                }
                Ok(Named(values))
            }
        }
        deserializer.deserialize_map(InOrder(PhantomData))
    }
}

/// A coordinate that takes values: a joint variable or a coordinate of a platform.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// The unit of its values, rad or m.
    pub unit: SiUnit,
}

/// A column of a table of numbers; serialised as its heading: `theta1 (rad)`, `mode`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// What it holds.
    pub name: String,
    /// The unit of its numbers, if they have one.
    pub unit: Option<SiUnit>,
}

impl Column {
    /// A column of numbers without unit.
    pub fn plain(name: &str) -> Self {
        let name = name.into();
        Column { name, unit: None }
    }
}

impl From<Variable> for Column {
    fn from(Variable { name, unit }: Variable) -> Self {
        let unit = Some(unit);
        Column { name, unit }
    }
}

impl Display for Column {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.unit {
            None => f.pad(&self.name),
            Some(unit) => f.pad(&format!("{} ({unit})", self.name)),
        }
    }
}

impl FromStr for Column {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text
            .strip_suffix(')')
            .and_then(|text| text.rsplit_once(" ("));
        let parts = parts.and_then(|(name, unit)| Some((name, unit.parse().ok()?)));
        Ok(match parts {
            None => Column::plain(text),
            Some((name, unit)) => Column {
                name: name.into(),
                unit: Some(unit),
            },
        })
    }
}

impl Serialize for Column {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Column {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}

/// A frame in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameRecord {
    /// Its origin, in m.
    pub position: [f64; 3],
    /// Its rotation matrix, row by row; the columns are its axes n, s, a.
    pub rotation: [[f64; 3]; 3],
    /// The same as a unit quaternion: scalar first, its first component that is not zero positive.
    pub quaternion: [f64; 4],
}

/// A platform in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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

/// The names that stand in formulas about a mechanism.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FormulaNames {
    /// The joint variables, in the order of the file.
    pub joints: Vec<Variable>,
    /// The parameters, in the order of the file.
    pub parameters: Vec<String>,
    /// The platforms, in the order of the file.
    pub platforms: Vec<String>,
}

impl Mechanism {
    /// The joint variables with their units, in the order of the file.
    pub fn variables(&self) -> Vec<Variable> {
        let joints = self.joints().iter();
        joints
            .map(|joint| Variable {
                name: joint.name.clone(),
                unit: SiUnit::of_coordinate(joint.kind.is_angle()),
            })
            .collect()
    }

    /// Values of the joint variables, rad or m, with the names of these.
    pub fn named_joints(&self, values: &[f64]) -> Named<f64> {
        let joints = self.joints().iter().zip(values);
        joints
            .map(|(joint, &value)| (joint.name.clone(), value))
            .collect()
    }

    /// The names that stand in formulas.
    pub fn names_in_formulas(&self) -> FormulaNames {
        let parameters = self.parameters().iter().map(|part| part.name.clone());
        let platforms = self.platforms().iter().map(|part| part.name.clone());
        FormulaNames {
            joints: self.variables(),
            parameters: parameters.collect(),
            platforms: platforms.collect(),
        }
    }
}

/// A number whose absence in JSON means that it is infinite: JSON has no infinite numbers.
pub fn infinite_if_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_read_as_they_are_written() {
        for (name, unit, text) in [
            ("mode", None, "mode"),
            ("theta1", Some(SiUnit::RADIAN), "theta1 (rad)"),
            ("left+1, 0.x", Some(SiUnit::METRE), "left+1, 0.x (m)"),
            ("a (b)", None, "a (b)"),
        ] {
            let name = name.to_owned();
            let column = Column { name, unit };
            assert_eq!(column.to_string(), text);
            assert_eq!(text.parse(), Ok(column));
        }
    }
}
