//! A mechanism in a configuration as named shapes in ground, ready to be drawn.
//!
//! Links follow the common normals of the table: along d, then along a. A joint stands where its axis meets the link
//! that carries it, a closure where its frames meet. The shapes have no size or colour of their own: whoever draws
//! them takes both from the extent of the whole.

mod links;

use serde::{Deserialize, Serialize};

use crate::description::{ClosureKind, Role};
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};

/// A point or a direction in ground: x, y, z (points in m).
pub type Triple = [f64; 3];

/// A mechanism in one configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// The name of the mechanism.
    pub mechanism: String,
    /// The unit normal of the plane of motion, if there is one.
    pub normal: Option<Triple>,
    /// The bodies, ground first; a body is drawn once, whatever chains carry it.
    pub bodies: Vec<BodyShape>,
    /// The joints of the chains, then those that the closures restore.
    pub joints: Vec<JointShape>,
    /// The rods of given length.
    pub rods: Vec<Rod>,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyShape {
    /// The frame that carries it.
    pub name: String,
    /// Whether it is the fixed body.
    pub ground: bool,
    /// Whether it is a platform.
    pub platform: bool,
    /// Its links as lines from point to point.
    pub lines: Vec<Vec<Triple>>,
    /// Where joints and rods join it to other bodies.
    pub corners: Vec<Triple>,
}

/// A joint between two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointShape {
    /// The joint variables or the closure.
    pub names: Vec<String>,
    /// What moves.
    pub kind: Symbol,
    /// Where it stands.
    pub at: Triple,
    /// The unit vectors of its axes: none of a spherical joint, two of a universal joint, the normal of a planar one.
    pub axes: Vec<Triple>,
    /// The bodies it joins, as numbers in the list of bodies.
    pub bodies: [usize; 2],
    /// Whether it is driven.
    pub driven: bool,
    /// Whether a closure restores it.
    pub closure: bool,
}

/// A rod of given length with a ball at each end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rod {
    /// The closure.
    pub name: String,
    /// Its ends.
    pub ends: [Triple; 2],
    /// Whether a driven joint changes its length.
    pub driven: bool,
}

/// The symbol of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Symbol {
    /// Turns about its axis.
    Revolute,
    /// Slides along its axis.
    Prismatic,
    /// Turns about its axis and slides along it in proportion.
    Helical,
    /// Turns about its axis and slides along it.
    Cylindrical,
    /// Turns about two perpendicular axes that meet.
    Universal,
    /// Turns about a point.
    Spherical,
    /// Slides in a plane and turns about its normal.
    Planar,
    /// Does not move: the two bodies are one.
    Rigid,
}

impl Scene {
    /// The mechanism in a configuration.
    pub fn of(mechanism: &Mechanism, at: &Configuration<f64>) -> Self {
        let pose = |frame: Frame| mechanism.transform(Frame::Ground, frame, at);
        let bodies = mechanism.bodies();
        let number = |frame: Frame| {
            let body = mechanism.body(frame);
            let place = bodies.iter().position(|b| *b == body);
            place.expect("every frame belongs to a body of the mechanism")
        };
        let mut scene = Scene {
            mechanism: mechanism.name().to_owned(),
            normal: mechanism.plane_of_motion().map(|normal| normal.0),
            bodies: (bodies.iter())
                .map(|&body| BodyShape {
                    name: mechanism.body_name(body),
                    ground: body == Body::Ground,
                    platform: matches!(body, Body::Platform(_)),
                    lines: Vec::new(),
                    corners: Vec::new(),
                })
                .collect(),
            joints: Vec::new(),
            rods: Vec::new(),
        };
        for chain in 0..mechanism.chains().len() {
            scene.chain(mechanism, chain, &pose, &number);
        }
        for (closure, dimensions) in
            (mechanism.closures().iter()).zip(&mechanism.dimensions().closures)
        {
            let poses = closure.frames.map(&pose);
            let bodies = closure.frames.map(number);
            for (body, pose) in bodies.into_iter().zip(&poses) {
                scene.attach(body, pose.position);
            }
            if closure.kind.has_length() {
                let driven = (dimensions.extension.0.iter())
                    .any(|(joint, _)| mechanism.joints()[*joint].role == Role::Actuated);
                scene.rods.push(Rod {
                    name: closure.name.clone(),
                    ends: poses.map(|pose| pose.position.0),
                    driven,
                });
            } else {
                scene.joints.push(of_closure(
                    closure.name.clone(),
                    closure.kind,
                    &poses,
                    bodies,
                ));
            }
        }
        scene
    }

    /// Every point from which something is drawn.
    pub fn points(&self) -> Vec<Triple> {
        let bodies = self.bodies.iter();
        let bodies = bodies.flat_map(|body| body.lines.iter().flatten().chain(&body.corners));
        let rods = self.rods.iter().flat_map(|rod| &rod.ends);
        let joints = self.joints.iter().map(|joint| &joint.at);
        bodies.chain(rods).chain(joints).copied().collect()
    }

    fn attach(&mut self, body: usize, at: Vector3<f64>) {
        let corners = &mut self.bodies[body].corners;
        if !corners.iter().any(|corner| close(&Vector3(*corner), &at)) {
            corners.push(at.0);
        }
    }
}

/// Points so close that no picture shows them apart.
fn close(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    let size = a.norm().max(b.norm());
    (*a - *b).norm() <= 1e-9 * size
}

fn of_closure(
    name: String,
    kind: ClosureKind,
    poses: &[Pose<f64>; 2],
    bodies: [usize; 2],
) -> JointShape {
    let [a, b] = poses;
    let z = [a.rotation.0[2].0, b.rotation.0[2].0];
    let middle = (a.position + b.position).times(0.5).0;
    let (symbol, at, axes) = match kind {
        ClosureKind::Spherical | ClosureKind::Distance => (Symbol::Spherical, middle, vec![]),
        ClosureKind::Revolute => (Symbol::Revolute, middle, vec![z[0]]),
        ClosureKind::Universal => (Symbol::Universal, middle, z.to_vec()),
        ClosureKind::Rigid => (Symbol::Rigid, middle, vec![]),
        // the second frame slides along the axis of the first
        ClosureKind::Prismatic => (Symbol::Prismatic, b.position.0, vec![z[0]]),
        ClosureKind::Cylindrical => (Symbol::Cylindrical, b.position.0, vec![z[0]]),
        ClosureKind::Planar => (Symbol::Planar, b.position.0, vec![z[0]]),
    };
    JointShape {
        names: vec![name],
        kind: symbol,
        at,
        axes,
        bodies,
        driven: false,
        closure: true,
    }
}
