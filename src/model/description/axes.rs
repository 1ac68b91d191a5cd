//! The contents of a file of joint coordinates: like a mechanism file, before frames are placed.

mod closing;
mod graph;
mod places;
mod rods;
mod tables;
mod values;

use std::ops::Range;

pub use graph::Graph;
pub use tables::JointCoordinates;

use super::file_fields::{axes_structures, declared};
use super::{
    ClosedFormDescription, ClosureKind, Convention, Displacement, Entry, LoadsDescription, Named,
    Role, Spanned, place_of,
};
use crate::algebra::words;

axes_structures!(declared);

/// A point on a body, or a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct PointDescription {
    /// The body.
    pub body: Spanned<String>,
    /// Its position in the drawing.
    pub place: AxisPlace,
}

/// A joint given by its axis.
#[derive(Debug, Clone)]
pub struct AxisDescription {
    /// Its kind.
    pub kind: AxisKind,
    /// Its axis in the drawing.
    pub place: AxisPlace,
    /// Its axis on the second body, if the drawing shows the bodies apart.
    pub second: Option<AxisPlace>,
    /// Actuated or passive, if the file says so.
    pub role: Option<Role>,
    /// The value of its variable in the home configuration; 0 if not given, for a rod the length drawn.
    pub home: Option<Entry>,
    /// The value in the drawing; that at home, if not given.
    pub drawn: Option<Entry>,
    /// Its value in terms of other joints, or the length of a rod; the joint then has no variable of its own.
    pub value: Option<Entry>,
    /// The travel of a screw for a full turn (m).
    pub pitch: Option<Entry>,
    /// Lowest and highest value.
    pub limits: Option<(Entry, Entry)>,
    /// The two bodies it connects; the second moves positively against the first.
    pub between: Option<[Spanned<String>; 2]>,
    /// Place of the joint in the file.
    pub span: Range<usize>,
}

words! {
    /// The kind of a joint given by its axis.
    AxisKind {
        /// Revolute about its axis.
        Revolute = "Revolute",
        /// Prismatic along its axis, which has a direction only.
        Prismatic = "Prismatic",
        /// A screw about its axis.
        Helical = "Helical",
        /// Revolute and prismatic about and along its axis.
        Cylindrical = "Cylindrical",
        /// Revolute about two axes through a point, the first fixed to the first body, the second to the second.
        Universal = "Universal",
        /// Spherical, with a centre only. It is always cut.
        Spherical = "Spherical",
        /// Planar, with the normal of its plane. It is always cut.
        Planar = "Planar",
        /// No motion.
        Fixed = "Fixed",
        /// A rod with a ball at each end. It is always cut.
        Distance = "Distance",
        /// Any motion: a body that nothing else holds to ground floats. It is always cut, without a closure.
        Free = "Free",
    }
}

/// The position of an axis: three coordinates in m, or a direction of any length.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisPlace {
    /// A point, which a prismatic joint need not have, and a direction.
    Along(Option<[Entry; 3]>, [Entry; 3]),
    /// Two points, the axis directed from the first to the second.
    Through([Entry; 3], [Entry; 3]),
    /// A point and the directions of two axes.
    Cross([Entry; 3], [[Entry; 3]; 2]),
    /// The centre of a ball, or a point.
    Centre([Entry; 3]),
    /// A frame, whose z axis is the axis.
    Frame(Vec<Displacement>),
}

impl AxisPlace {
    /// Everything written in it.
    pub fn entries(&self) -> Vec<&Entry> {
        match self {
            AxisPlace::Along(point, direction) => point.iter().flatten().chain(direction).collect(),
            AxisPlace::Through(first, second) => first.iter().chain(second).collect(),
            AxisPlace::Cross(point, directions) => {
                point.iter().chain(directions.iter().flatten()).collect()
            }
            AxisPlace::Centre(point) => point.iter().collect(),
            AxisPlace::Frame(steps) => steps.iter().flat_map(Displacement::entries).collect(),
        }
    }
}

impl AxesDescription {
    /// True for a body or a point of this name; any name can be a body's where joints name no bodies.
    pub fn names(&self, frame: &str) -> bool {
        let joints = self.joints.iter().map(|joint| &joint.value);
        let mut bodies = joints.flat_map(|joint| joint.between.iter().flatten());
        let named = bodies.any(|body| body.value == frame) || self.is_serial();
        named || place_of(&self.points, frame).is_some()
    }

    /// All that places something in the drawing or says where a joint is.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        let joints = || self.joints.iter().map(|joint| &joint.value);
        let places = joints().flat_map(|joint| [Some(&joint.place), joint.second.as_ref()]);
        let points = self.points.iter().map(|point| &point.value.place);
        let bodies = self.bodies.iter().map(|body| &body.value);
        let places = places.flatten().chain(points).chain(bodies);
        let related = self.couplings.iter().map(|coupling| &coupling.value);
        let ends = self.base.iter().chain(&self.tool).flatten();
        (places.flat_map(AxisPlace::entries))
            .chain(joints().flat_map(AxisDescription::values))
            .chain(ends.flat_map(Displacement::entries))
            .chain(related)
    }
}

impl AxisKind {
    /// The closure that restores such a joint; none for a screw, which cannot be cut, and for a body that floats.
    pub fn closure(self) -> Option<ClosureKind> {
        Some(match self {
            Self::Revolute => ClosureKind::Revolute,
            Self::Prismatic => ClosureKind::Prismatic,
            Self::Helical | Self::Free => return None,
            Self::Cylindrical => ClosureKind::Cylindrical,
            Self::Universal => ClosureKind::Universal,
            Self::Spherical => ClosureKind::Spherical,
            Self::Planar => ClosureKind::Planar,
            Self::Fixed => ClosureKind::Rigid,
            Self::Distance => ClosureKind::Distance,
        })
    }

    /// True for a joint with a single variable.
    pub fn has_variable(self) -> bool {
        matches!(self, Self::Revolute | Self::Prismatic | Self::Helical)
    }

    /// True if the variable is a length.
    pub fn is_length(self) -> bool {
        matches!(self, Self::Prismatic | Self::Distance)
    }

    /// The field by which such a joint follows others.
    pub fn follows_by(self) -> &'static str {
        match self {
            Self::Distance => "length",
            _ => "value",
        }
    }

    /// True if the joint is always cut, as a closure.
    pub fn always_cut(self) -> bool {
        matches!(
            self,
            Self::Spherical | Self::Planar | Self::Distance | Self::Free
        )
    }
}

impl AxisDescription {
    /// A joint of a kind at a place, passive and without limits.
    pub fn new(kind: AxisKind, place: AxisPlace) -> Self {
        AxisDescription {
            kind,
            place,
            second: None,
            role: None,
            home: None,
            drawn: None,
            value: None,
            pitch: None,
            limits: None,
            between: None,
            span: 0..0,
        }
    }

    /// Its values in the home configuration and in the drawing, and its limits.
    pub fn values(&self) -> impl Iterator<Item = &Entry> {
        let limits = self.limits.iter().flat_map(|(low, high)| [low, high]);
        self.home.iter().chain(&self.drawn).chain(limits)
    }

    /// True for a joint that is nowhere.
    pub fn has_no_place(&self) -> bool {
        matches!(self.kind, AxisKind::Fixed | AxisKind::Free)
            && self.place == AxisPlace::Frame(Vec::new())
    }

    /// The value of its variable in the drawing.
    pub fn at_drawing(&self) -> Entry {
        // where the bodies are drawn apart, the frames of the joint on them would coincide at 0
        let home = self.home.as_ref().filter(|_| self.second.is_none());
        let given = self.drawn.as_ref().or(home);
        given.cloned().unwrap_or_else(Entry::absent)
    }

    /// True if its value in the drawing is given: by itself, or as 0 where its bodies are drawn apart.
    pub fn is_drawn(&self) -> bool {
        self.drawn.is_some() || self.second.is_some()
    }

    /// True for a rod whose length is a variable of its own.
    pub fn is_driven_length(&self) -> bool {
        let said = self.role.is_some() || self.limits.is_some() || self.home.is_some();
        self.kind == AxisKind::Distance && self.value.is_none() && said
    }

    /// True if it has a variable when it is not cut.
    pub fn is_variable(&self) -> bool {
        self.value.is_none() && (self.kind.has_variable() || self.is_driven_length())
    }
}
