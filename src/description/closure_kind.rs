//! Joints that closures restore, and their conditions on the two frames.

use std::ops::Range;

use crate::algebra::words;

words! {
    /// The kind of joint that a closure restores. Its axes are the z axes of the frames.
    ClosureKind {
        /// The origins coincide.
        Spherical = "Spherical",
        /// Origins and axes coincide.
        Revolute = "Revolute",
        /// Axes and orientations coincide, one frame slides along the axis.
        Prismatic = "Prismatic",
        /// Origins coincide and the axes are perpendicular.
        Universal = "Universal",
        /// The axes coincide.
        Cylindrical = "Cylindrical",
        /// The xy planes coincide.
        Planar = "Planar",
        /// The frames coincide.
        Rigid = "Rigid",
        /// The origins have a given distance.
        Distance = "Distance",
        /// An expression of joint variables is zero; no frames take part.
        Coupling = "Coupling",
    }
}

/// Condition of a closure on the z axes of its two frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AxisCondition {
    /// No condition.
    Free,
    /// They are perpendicular.
    Perpendicular,
    /// They are parallel and point the same way.
    Aligned,
    /// The orientations of the frames are equal.
    Oriented,
}

/// The conditions that a closure consists of. [`ClosureKind::Distance`] and [`ClosureKind::Coupling`] have one of their
/// own and none of these.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClosureConditions {
    /// True if the origins coincide.
    pub origins: bool,
    /// The condition on the axes.
    pub axes: AxisCondition,
    /// The axes of the first frame along which the origins do not differ.
    pub offsets: Range<usize>,
}

impl ClosureKind {
    /// The conditions that it consists of.
    pub fn conditions(self) -> ClosureConditions {
        use AxisCondition::{Aligned, Free, Oriented, Perpendicular};
        let (origins, axes, offsets) = match self {
            Self::Spherical => (true, Free, 0..0),
            Self::Revolute => (true, Aligned, 0..0),
            Self::Prismatic => (false, Oriented, 0..2),
            Self::Universal => (true, Perpendicular, 0..0),
            Self::Cylindrical => (false, Aligned, 0..2),
            Self::Planar => (false, Aligned, 2..3),
            Self::Rigid => (true, Oriented, 0..0),
            Self::Distance | Self::Coupling => (false, Free, 0..0),
        };
        ClosureConditions {
            origins,
            axes,
            offsets,
        }
    }

    /// The variables of such a joint, in the order in which its rows move the second frame against the first: the end of the
    /// name of each, and whether it slides along the axis or turns about it. None where no numbers say how far a joint has
    /// moved without a choice: those of balls and planes.
    pub fn variables(self) -> &'static [(&'static str, bool)] {
        match self {
            Self::Revolute => &[("", false)],
            Self::Prismatic => &[("", true)],
            Self::Cylindrical => &[("_turn", false), ("_slide", true)],
            Self::Universal => &[("_1", false), ("_2", false)],
            Self::Spherical | Self::Planar | Self::Rigid | Self::Distance | Self::Coupling => &[],
        }
    }

    /// True if the z axes lie in one line.
    pub fn joins_axes(self) -> bool {
        let conditions = self.conditions();
        self.aligns_axes() && (conditions.origins || conditions.offsets == (0..2))
    }

    /// True if the z axes are parallel, in the same sense.
    pub fn aligns_axes(self) -> bool {
        self.conditions().axes >= AxisCondition::Aligned
    }

    /// True if only the origins of the frames matter.
    pub fn leaves_orientation(self) -> bool {
        self.conditions().axes == AxisCondition::Free
    }

    /// True if the frames may turn about their z axes against each other.
    pub fn leaves_turn(self) -> bool {
        self.conditions().axes < AxisCondition::Oriented
    }

    /// True for a closure with a given length, such as a rod with a ball at each end.
    pub fn has_length(self) -> bool {
        self == Self::Distance
    }

    /// The number of independent equations it imposes on two free bodies.
    pub fn equations(self) -> usize {
        let conditions = self.conditions();
        let turns = match conditions.axes {
            AxisCondition::Free => 0,
            AxisCondition::Perpendicular => 1,
            AxisCondition::Aligned => 2,
            AxisCondition::Oriented => 3,
        };
        let points = if conditions.origins { 3 } else { 0 };
        let own = self.has_length() || self == Self::Coupling;
        points + turns + conditions.offsets.len() + usize::from(own)
    }
}
