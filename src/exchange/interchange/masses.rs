//! Masses of bodies, seen from their frames.

use crate::description::{Entry, InertiaDescription, MassDescription, Named};
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Body, Frame, Mechanism};
use crate::number::tolerance::ROUNDING;

/// The names of moments of inertia in URDF and SDF.
pub const MOMENTS: [&str; 6] = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];

/// A mass with its centre and its tensor of inertia about that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heavy {
    /// In kg.
    pub mass: f64,
    /// In m.
    pub centre: Vector3<f64>,
    /// Along the axes of the frame, in kg·m².
    pub inertia: [[f64; 3]; 3],
}

impl Heavy {
    /// The mass of an element whose numbers cannot be read: it has no part in how bodies move.
    pub const UNREADABLE: Heavy = Heavy {
        mass: f64::NAN,
        centre: Vector3([0.0; 3]),
        inertia: [[0.0; 3]; 3],
    };

    /// The tensor of Ixx, Iyy, Izz, Ixy, Ixz, Iyz.
    pub fn tensor([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [[f64; 3]; 3] {
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    /// Ixx, Iyy, Izz, Ixy, Ixz, Iyz.
    pub fn moments(&self) -> [f64; 6] {
        let [[xx, xy, xz], [_, yy, yz], [.., zz]] = self.inertia;
        [xx, yy, zz, xy, xz, yz]
    }

    /// Those of a body that resists every turn, for programs that refuse others: moments of a thin rod or a point are raised
    /// by `least`.
    pub fn moments_above(&self, least: f64) -> [f64; 6] {
        let mut moments = self.moments();
        if self.principal_moments().min() < least {
            moments[..3].iter_mut().for_each(|moment| *moment += least);
        }
        moments
    }

    /// The principal moments.
    fn principal_moments(&self) -> nalgebra::Vector3<f64> {
        nalgebra::Matrix3::from_fn(|i, j| self.inertia[i][j]).symmetric_eigenvalues()
    }

    /// A mass about a pose in a frame: its centre at the origin there, its moments along the axes.
    pub fn at(mass: f64, moments: [f64; 6], pose: &Pose<f64>) -> Self {
        let own = Heavy {
            mass,
            centre: Vector3::zero(),
            inertia: Heavy::tensor(moments),
        };
        own.seen_from(pose)
    }

    /// True if a body can have it: no moment is negative or exceeds the sum of the others.
    pub fn is_possible(&self) -> bool {
        let numbers = self.centre.0.into_iter().chain(self.moments());
        // far beyond any body, and far below what a file may say
        let fine = |x: f64| x.is_finite() && x.abs() < 1e20;
        let mut numbers = numbers.chain([self.mass]);
        if self.mass < 0.0 || !numbers.all(fine) {
            return false;
        }
        let moments = self.principal_moments();
        let (least, most) = (moments.min(), moments.max());
        least >= -ROUNDING * most.abs() && 2.0 * most <= moments.sum() + ROUNDING * most.abs()
    }

    /// Mass and inertia in a frame in which its own has this pose.
    pub fn seen_from(&self, pose: &Pose<f64>) -> Self {
        Heavy {
            mass: self.mass,
            centre: *pose * self.centre,
            inertia: pose.rotation.turned_tensor(&self.inertia),
        }
    }

    /// Both together (theorem of parallel axes).
    pub fn with(&self, other: &Heavy) -> Self {
        let mass = self.mass + other.mass;
        let share = |of: &Heavy| match mass > 0.0 {
            true => of.centre.times(of.mass / mass),
            false => of.centre.times(0.5),
        };
        let centre = share(self) + share(other);
        let about = |of: &Heavy| {
            let arm = of.centre - centre;
            let square = arm.dot(&arm);
            let entry = |i: usize, j: usize| {
                let own = if i == j { square } else { 0.0 };
                of.inertia[i][j] + of.mass * (own - arm.0[i] * arm.0[j])
            };
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
        };
        let (a, b) = (about(self), about(other));
        Heavy {
            mass,
            centre,
            inertia: [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][j] + b[i][j])),
        }
    }

    /// The entry of a file under the name of a frame.
    pub fn entry(&self, frame: &str) -> Named<MassDescription> {
        let number = |x: f64| Entry::number(x + 0.0, 0..0);
        let given = |of: &[f64]| of.iter().any(|x| *x != 0.0);
        let (centre, moments) = (self.centre.0, self.moments());
        let mass = MassDescription {
            mass: Some(number(self.mass)),
            centre: given(&centre).then(|| centre.map(number)),
            inertia: given(&moments).then(|| InertiaDescription(moments.map(number).into())),
            shape: None,
            density: None,
            turned: Vec::new(),
            span: 0..0,
        };
        Named::new(frame, mass)
    }
}

/// The masses of a mechanism, each with the body it is on and seen from its frame.
pub fn masses(mechanism: &Mechanism) -> impl Iterator<Item = (Body, Frame, Heavy)> {
    mechanism.loads().masses.iter().map(|of| {
        let heavy = Heavy {
            mass: of.mass,
            centre: Vector3(of.centre.offset),
            inertia: of.inertia,
        };
        let frame = of.centre.frame;
        (mechanism.body(frame), frame, heavy)
    })
}
