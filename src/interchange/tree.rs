//! Bodies in a tree with the loops that close it: the common ground of URDF, MJCF and a mechanism.

use crate::description::ClosureKind;
use crate::geometry::{Pose, Vector3};

/// How a joint moves its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// About its axis by an angle in rad.
    Turn,
    /// Along its axis by a length in m.
    Slide,
    /// About its point in any direction.
    Ball,
    /// Without restriction.
    Free,
}

/// A joint between a body and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub motion: Motion,
    /// The unit direction of its axis in the body; meaningless if it has no axis.
    pub axis: Vector3<f64>,
    /// A point of the axis in the body (m).
    pub point: Vector3<f64>,
    /// The value at which the body has the pose [`Body::pose`].
    pub reference: f64,
    /// The value at home, in rad or m.
    pub home: f64,
    /// Lowest and highest value.
    pub limits: Option<(f64, f64)>,
    /// Whether it is driven.
    pub actuated: bool,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Its parent, earlier in the list; only the first body has none, and it is fixed.
    pub parent: Option<usize>,
    /// Parent from body where every joint between them has its reference value; positions in m.
    pub pose: Pose<f64>,
    /// The joints between parent and body, each carrying those after it.
    pub joints: Vec<Joint>,
    /// Ground from body at home, of bodies with a ball or free joint.
    pub home: Option<Pose<f64>>,
    /// Named frames: body from frame.
    pub frames: Vec<(String, Pose<f64>)>,
}

/// A joint whose value follows that of another: `offset + factor · value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// The joint that follows.
    pub joint: String,
    /// The joint that leads.
    pub leader: String,
    /// The motion of the follower for a unit of the leader.
    pub factor: f64,
    /// The follower's value where the leader's is 0.
    pub offset: f64,
}

/// A frame on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// Index of the body.
    pub body: usize,
    /// Name of the frame, one of the body's.
    pub frame: String,
    /// Body from frame.
    pub pose: Pose<f64>,
}

/// A length that may depend on joints: `constant + Σ factor · joint` (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The part that does not change.
    pub constant: f64,
    /// Names of joints and their factors.
    pub terms: Vec<(String, f64)>,
}

/// A joint that closes a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Its name.
    pub name: String,
    /// The kind of joint; its axes are the z axes of the frames.
    pub kind: ClosureKind,
    /// The frames it joins.
    pub sides: [Attachment; 2],
    /// The length of a `Distance`.
    pub length: Option<Extent>,
}

/// Bodies joined into a tree, and the loops that close it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Its name.
    pub name: String,
    /// The bodies, parents before their children; the first is the ground.
    pub bodies: Vec<Body>,
    /// Joints that follow others.
    pub couplings: Vec<Coupling>,
    /// The loops.
    pub loops: Vec<Loop>,
    /// A typical length of the bodies in m.
    pub size: f64,
}

impl Joint {
    /// The displacement of the joint at a value, in its body's frame; none for balls and free joints.
    pub fn displacement(&self, value: f64) -> Pose<f64> {
        let by = value - self.reference;
        match self.motion {
            Motion::Slide => Pose::translation(self.axis.times(by)),
            Motion::Turn => {
                let turn = Pose {
                    rotation: about(&self.axis, by),
                    position: Vector3::zero(),
                };
                Pose::translation(self.point) * turn * Pose::translation(-self.point)
            }
            Motion::Ball | Motion::Free => Pose::identity(),
        }
    }
}

/// The rotation about a unit vector (Rodrigues): R = 1 + sin θ [n]× + (1 − cos θ) [n]×².
fn about(axis: &Vector3<f64>, angle: f64) -> crate::geometry::Rotation<f64> {
    let (sin, cos) = angle.sin_cos();
    crate::geometry::Rotation([0, 1, 2].map(|i| {
        let e = Vector3::unit(i);
        e.times(cos) + axis.cross(&e).times(sin) + axis.times(axis.0[i] * (1.0 - cos))
    }))
}

impl Tree {
    /// Ground from every body, with each joint at the value `of` gives it; floating bodies stay as placed.
    pub fn poses(&self, of: impl Fn(&Joint) -> f64) -> Vec<Pose<f64>> {
        let mut poses: Vec<Pose<f64>> = Vec::with_capacity(self.bodies.len());
        for body in &self.bodies {
            let parent = body.parent.map_or(Pose::identity(), |parent| poses[parent]);
            let moved = body.joints.iter().fold(body.pose, |pose, joint| {
                pose * joint.displacement(of(joint))
            });
            poses.push(parent * moved);
        }
        poses
    }

    /// Ground from every body at home.
    pub fn home(&self) -> Vec<Pose<f64>> {
        let mut poses: Vec<Pose<f64>> = Vec::with_capacity(self.bodies.len());
        for body in &self.bodies {
            let parent = body.parent.map_or(Pose::identity(), |parent| poses[parent]);
            poses.push(body.home.unwrap_or_else(|| {
                let joints = body.joints.iter();
                parent
                    * joints.fold(body.pose, |pose, joint| {
                        pose * joint.displacement(joint.home)
                    })
            }));
        }
        poses
    }

    /// The children of every body, in the order of the list.
    pub fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.bodies.len()];
        for (i, body) in self.bodies.iter().enumerate() {
            if let Some(parent) = body.parent {
                children[parent].push(i);
            }
        }
        children
    }
}
