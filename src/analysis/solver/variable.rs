use crate::algebra::SiUnit;
use crate::mechanism::{Configuration, Mechanism};
use crate::number::Number;
use crate::system::Coordinate;

/// A number that is given, or one of those by which a configuration is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Variable {
    Held(Coordinate),
    Joint(usize),
    Orientation(usize, usize),
    Position(usize, usize),
}

impl Variable {
    pub fn of<T: Number>(self, mechanism: &Mechanism, at: &Configuration<T>) -> T {
        match self {
            Variable::Held(coordinate) => coordinate.of(mechanism, at),
            Variable::Joint(joint) => at.joints[joint],
            Variable::Orientation(platform, i) => at.platforms[platform].orientation.0[i],
            Variable::Position(platform, i) => at.platforms[platform].position.0[i],
        }
    }

    pub fn name(self, mechanism: &Mechanism) -> String {
        let of = |platform: usize| &mechanism.platforms()[platform].name;
        match self {
            Variable::Held(coordinate) => coordinate.name(mechanism),
            Variable::Joint(joint) => mechanism.joints()[joint].name.clone(),
            Variable::Orientation(platform, i) => {
                format!("{}.q{}", of(platform), ["w", "x", "y", "z"][i])
            }
            Variable::Position(platform, i) => format!("{}.{}", of(platform), ["x", "y", "z"][i]),
        }
    }

    pub fn unit(self, mechanism: &Mechanism) -> SiUnit {
        match self {
            Variable::Held(coordinate) => SiUnit::of_coordinate(coordinate.is_angle(mechanism)),
            Variable::Joint(joint) => {
                SiUnit::of_coordinate(mechanism.joints()[joint].kind.is_angle())
            }
            Variable::Orientation(..) => SiUnit::ONE,
            Variable::Position(..) => SiUnit::METRE,
        }
    }

    pub fn limits(self, mechanism: &Mechanism) -> Option<(f64, f64)> {
        match self {
            Variable::Held(Coordinate::Joint(joint)) | Variable::Joint(joint) => {
                mechanism.joints()[joint].limits
            }
            _ => None,
        }
    }
}
