//! The meaningful, immutable mechanism, and its one kinematics over any number.

mod closure;
mod configuration;
mod coordinate;
mod dimensions;
mod kinematics;

pub use configuration::{Configuration, PlatformPose};
pub use coordinate::Coordinate;
pub use dimensions::{ChainDimensions, ClosureDimensions, Dimensions, LinearForm, RowDimensions};
pub use kinematics::{Kinematics, Placement};

pub(crate) use closure::{Closure, Side};
pub(crate) use coordinate::orientation_rows;
pub(crate) use kinematics::{Mover, Need};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosureKind {
    Spherical,
    Revolute,
    Prismatic,
    Universal,
    Cylindrical,
    Planar,
    Rigid,
    Distance,
}
impl ClosureKind {
    pub fn equations(self) -> usize {
        match self {
            Self::Distance => 1,
            Self::Spherical | Self::Planar => 3,
            Self::Universal | Self::Cylindrical => 4,
            Self::Revolute | Self::Prismatic => 5,
            Self::Rigid => 6,
        }
    }

    /// How much of the poses of its two frames the rows of the closure are made from.
    pub(crate) fn needs(self) -> [Need; 2] {
        match self {
            Self::Spherical | Self::Distance => [Need::Position; 2],
            Self::Universal => [Need::Axis; 2],
            Self::Revolute | Self::Cylindrical | Self::Planar => [Need::Pose, Need::Axis],
            Self::Prismatic | Self::Rigid => [Need::Pose; 2],
        }
    }
}

/// A frame of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Frame {
    /// The fixed frame.
    Ground,
    /// A platform's own frame.
    Platform {
        /// Index of the platform.
        platform: usize,
    },
    /// A named frame on a platform.
    OnPlatform {
        /// Index of the platform.
        platform: usize,
        /// Index of the frame among the platform's.
        frame: usize,
    },
    /// The frame after a row of a chain's table; row 0 is the chain's base frame.
    Link {
        /// Index of the chain.
        chain: usize,
        /// Number of the row, from 1; 0 for the base.
        row: usize,
    },
    /// A chain's tip frame.
    Tip {
        /// Index of the chain.
        chain: usize,
    },
}
