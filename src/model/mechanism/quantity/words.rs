//! The words of quantities: orders of differentiation, parts of forces, screws and energy, figures.

use crate::algebra::{SiUnit, words};

/// Order of differentiation by time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// The coordinate itself.
    #[default]
    Value,
    /// Its rate.
    Velocity,
    /// Its acceleration.
    Acceleration,
}

/// A joint or a closure, by its reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// The joint of that index, by the link behind it.
    Joint(usize),
    /// The closure of that index.
    Closure(usize),
}

/// A source of power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worker {
    /// All drives.
    Drives,
    /// Given forces, dampers and friction, but not weights and springs, which have potential energy.
    Loads,
    /// The weight, spring, force or friction of that number among the [names](crate::mechanism::Loads::names) of the file.
    Load(usize),
}

words! {
    /// A kind of energy.
    Energy {
        /// All of it.
        Total = "energy",
        /// Kinetic energy.
        Kinetic = "energy:kinetic",
        /// Potential energy of weights and springs.
        Potential = "energy:potential",
    }

    /// A part of a force and a moment, along axes of ground.
    #[allow(missing_docs)]
    Effort {
        Fx = "Fx",
        Fy = "Fy",
        Fz = "Fz",
        Mx = "Mx",
        My = "My",
        Mz = "Mz",
        /// The size of the force.
        Force = "F",
        /// The size of the moment.
        Moment = "M",
        /// The force along a rod, or along the axis of a joint; tension is positive.
        Axial = "axial",
    }

    /// A measure of how well the inputs drive the outputs; none has a unit.
    Figure {
        /// Condition number of the input–output Jacobian.
        Condition = "condition",
        /// Determinant of the input–output Jacobian, where it is square.
        Determinant = "determinant",
        /// Product of its singular values.
        Manipulability = "manipulability",
        /// Least singular value of the closures with the inputs at rest.
        Direct = "distance:direct",
        /// Least singular value of the closures with the outputs at rest.
        Inverse = "distance:inverse",
        /// Least singular value of the closures with nothing held.
        Constraint = "distance:constraint",
    }
}

words! {
    /// A number of the instant screw of a body seen from ground.
    ScrewPart {
        /// The point of the axis nearest to the origin of ground.
        X = "x",
        /// Its y.
        Y = "y",
        /// Its z.
        Z = "z",
        /// The direction of the axis, about which the body turns positively.
        Dx = "dx",
        /// Its y.
        Dy = "dy",
        /// Its z.
        Dz = "dz",
        /// Advance of the body along the axis, in m/rad.
        Pitch = "pitch",
    }
}

impl Effort {
    /// True for a part of the moment.
    pub fn is_moment(self) -> bool {
        matches!(self, Effort::Mx | Effort::My | Effort::Mz | Effort::Moment)
    }

    /// A name and the part of its reaction after a dot; the size of the force where none is said.
    pub(super) fn of(name: &str) -> (&str, Effort) {
        let part = name
            .rsplit_once('.')
            .and_then(|(of, word)| Some((of, Effort::from_word(word)?)));
        part.unwrap_or((name, Effort::Force))
    }
}

impl Figure {
    /// True for a distance from singularities.
    pub fn is_distance(self) -> bool {
        matches!(self, Figure::Direct | Figure::Inverse | Figure::Constraint)
    }
}

impl ScrewPart {
    pub(super) fn unit(self) -> SiUnit {
        match self {
            ScrewPart::Dx | ScrewPart::Dy | ScrewPart::Dz => SiUnit::ONE,
            _ => SiUnit::METRE,
        }
    }
}

impl Order {
    /// The kind before the colon: `velocity:l1`.
    pub(super) fn of_kind(kind: &str) -> Option<Self> {
        match kind {
            "velocity" => Some(Order::Velocity),
            "acceleration" => Some(Order::Acceleration),
            _ => None,
        }
    }

    pub(super) fn of(self, unit: SiUnit) -> SiUnit {
        (0..self as usize).fold(unit, |unit, _| unit.per_second())
    }
}
