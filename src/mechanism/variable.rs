//! Names of numbers in rows.

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

use super::Mechanism;

/// The name of a number with its unit, written `theta1 (rad)`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub struct Variable {
    /// The name.
    pub name: String,
    /// `rad`, `m`; empty if it has none.
    pub unit: String,
}

impl Variable {
    /// A number with a unit, or without one if that is empty.
    pub fn new(name: impl Into<String>, unit: impl ToString) -> Self {
        Variable {
            name: name.into(),
            unit: unit.to_string(),
        }
    }

    /// The joints of a mechanism, in the order of the file.
    pub fn joints(mechanism: &Mechanism) -> Vec<Self> {
        let joints = mechanism.joints().iter();
        let unit = |is_angle: bool| if is_angle { "rad" } else { "m" };
        joints
            .map(|joint| Variable::new(&joint.name, unit(joint.kind.is_angle())))
            .collect()
    }

    /// The poses of its platforms: position and quaternion.
    pub fn poses(mechanism: &Mechanism) -> Vec<Self> {
        const PARTS: [(&str, &str); 7] = [
            ("x", "m"),
            ("y", "m"),
            ("z", "m"),
            ("qw", ""),
            ("qx", ""),
            ("qy", ""),
            ("qz", ""),
        ];
        let platforms = mechanism.platforms().iter();
        let parts =
            |name: &str| PARTS.map(|(part, unit)| Variable::new(format!("{name}.{part}"), unit));
        platforms
            .flat_map(|platform| parts(&platform.name))
            .collect()
    }
}

impl Display for Variable {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.unit.is_empty() {
            true => f.write_str(&self.name),
            false => write!(f, "{} ({})", self.name, self.unit),
        }
    }
}

impl From<Variable> for String {
    fn from(variable: Variable) -> String {
        variable.to_string()
    }
}

impl From<String> for Variable {
    fn from(written: String) -> Self {
        let parts = written.strip_suffix(')').and_then(|w| w.rsplit_once(" ("));
        match parts {
            Some((name, unit)) => Variable::new(name, unit),
            None => Variable::new(written, ""),
        }
    }
}
