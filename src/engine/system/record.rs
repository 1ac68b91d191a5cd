//! Plain data that the reports of several analyses share.

use serde::{Deserialize, Deserializer, Serialize};

use super::{ByName, Coordinate};
use crate::algebra::SiUnit;
use crate::mechanism::Mechanism;

/// The name of a number with its unit: a coordinate, a column of values, a row of a matrix.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NamedUnit {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
}

impl NamedUnit {
    pub(crate) fn new(name: impl Into<String>, unit: SiUnit) -> Self {
        let name = name.into();
        NamedUnit { name, unit }
    }

    pub(crate) fn of(mechanism: &Mechanism, coordinate: Coordinate) -> Self {
        let unit = SiUnit::of_coordinate(coordinate.is_angle(mechanism));
        NamedUnit::new(coordinate.name(mechanism), unit)
    }
}

/// The values of joints that are not cut, of joints by name.
pub(crate) fn uncut(joints: &ByName<f64>, cut: &[String]) -> Vec<f64> {
    let joints = joints.0.iter().filter(|(name, _)| !cut.contains(name));
    joints.map(|(_, value)| *value).collect()
}

/// True if positions are measured from the origin of ground.
pub(crate) fn is_origin(centre: &[f64; 3]) -> bool {
    *centre == [0.0; 3]
}

/// A number whose absence in JSON means that it is infinite: JSON has no infinite numbers.
pub fn infinite_if_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
}
