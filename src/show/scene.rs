//! A mechanism in a configuration as named shapes in ground, ready to be drawn.
//!
//! Links follow the common normals of the table: along d, then along a. A joint stands where its axis meets the link
//! that carries it, a closure where its frames meet. The shapes have no size or colour of their own: whoever draws
//! them takes both from the extent of the whole.

mod answers;
mod bearings;
mod links;
mod loads;
mod motion;

pub(crate) use motion::across;

use serde::{Deserialize, Serialize};

use crate::description::{ClosureKind, Role};
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};

/// A point or a direction in ground: x, y, z (points in m).
pub type Triple = [f64; 3];

/// A mechanism in one configuration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    pub rods: Vec<SceneRod>,
    /// Travels of joints to their limits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub travels: Vec<Travel>,
    /// Pitch circles of gears.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wheels: Vec<Wheel>,
    /// Frames that are shown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<Triad>,
    /// Curves that points trace.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub paths: Vec<Trace>,
    /// Screws of freedoms gained.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub screws: Vec<ScrewAxis>,
    /// Instant centres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub centres: Vec<Mark>,
    /// Forces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub arrows: Vec<ForceArrow>,
    /// Springs and dampers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<SpringShape>,
    /// Bodies with mass, and their weights.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub weights: Vec<Weight>,
}

/// A spring or a damper.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpringShape {
    /// Its name.
    pub name: String,
    /// Its ends; at a hinge both are the point about which it turns.
    pub ends: [Triple; 2],
    /// The axis of the hinge at which it acts: a unit vector.
    pub axis: Option<Triple>,
    /// True if it pulls or pushes.
    pub elastic: bool,
    /// True if it damps.
    pub damping: bool,
}

/// A mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weight {
    /// The body, or a frame on it.
    pub name: String,
    /// The centre of mass.
    pub at: Triple,
    /// Its weight, in N.
    pub force: Triple,
}

/// Travel of a joint to its limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Travel {
    /// The joint variable.
    pub joint: String,
    /// A point of its axis.
    pub at: Triple,
    /// Its axis: a unit vector.
    pub axis: Triple,
    /// For a revolute joint the unit vector along the link it moves, perpendicular to the axis; none for a slide.
    pub arm: Option<Triple>,
    /// Travel to the lower and to the upper limit, about or along the axis, in rad or m; negative to go back.
    pub ends: [f64; 2],
}

/// The pitch circle of a gear. Of two that turn opposite ways the circles touch from outside, of others one lies in the
/// other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wheel {
    /// The body that it belongs to, as a number in the list of bodies.
    pub body: usize,
    /// Its centre.
    pub at: Triple,
    /// Its axis: a unit vector.
    pub axis: Triple,
    /// Its radius, in m.
    pub radius: f64,
}

/// A curve that a point traces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// The point.
    pub name: String,
    /// Its places, one after the other.
    pub points: Vec<Triple>,
}

/// A frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Triad {
    /// Its name.
    pub name: String,
    /// Its origin.
    pub at: Triple,
    /// Unit vectors along x, y and z.
    pub axes: [Triple; 3],
}

/// Screw axis of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScrewAxis {
    /// Name of the body that moves.
    pub name: String,
    /// A point of it.
    pub at: Triple,
    /// Its unit vector.
    pub along: Triple,
    /// Advance for a rotation by 1 rad, in m/rad; `None` of a translation.
    pub pitch: Option<f64>,
}

/// A point with a name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Its name.
    pub name: String,
    /// Its position.
    pub at: Triple,
}

/// A force or a moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForceArrow {
    /// The frame that is loaded, or the joint or closure that passes it on.
    pub name: String,
    /// True for an applied load; false for a reaction.
    pub applied: bool,
    /// The point it acts at.
    pub at: Triple,
    /// Force in N.
    pub force: Triple,
    /// Moment in N·m.
    pub moment: Triple,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyShape {
    /// The frame that carries it.
    pub name: String,
    /// True for the fixed body.
    pub ground: bool,
    /// True for a platform.
    pub platform: bool,
    /// Its links as lines from point to point.
    pub lines: Vec<Vec<Triple>>,
    /// Points at which joints and rods connect it to other bodies.
    pub corners: Vec<Triple>,
}

/// A joint between two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointShape {
    /// The joint variables or the closure.
    pub names: Vec<String>,
    /// Its symbol.
    pub kind: JointSymbol,
    /// Its position.
    pub at: Triple,
    /// The unit vectors of its axes: none of a spherical joint, two of a universal joint, the normal of a planar one.
    pub axes: Vec<Triple>,
    /// The bodies it joins, as numbers in the list of bodies.
    pub bodies: [usize; 2],
    /// True if it is driven.
    pub driven: bool,
    /// True if a closure restores it.
    pub closure: bool,
}

/// A rod of given length with a ball at each end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneRod {
    /// The closure.
    pub name: String,
    /// Its ends.
    pub ends: [Triple; 2],
    /// The bodies it joins, as numbers in the list of bodies.
    pub bodies: [usize; 2],
    /// True if a driven joint changes its length.
    pub driven: bool,
}

/// The symbol of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum JointSymbol {
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
            ..Scene::default()
        };
        for chain in 0..mechanism.chains().len() {
            scene.chain(mechanism, chain, &pose, &number);
        }
        for (closure, dimensions) in
            (mechanism.closures().iter()).zip(&mechanism.dimensions().closures)
        {
            if closure.kind == ClosureKind::Coupling {
                continue;
            }
            let poses = closure.frames.map(&pose);
            let bodies = closure.frames.map(number);
            for (body, pose) in bodies.into_iter().zip(&poses) {
                scene.attach(body, pose.position);
            }
            if closure.kind.has_length() {
                let driven = (dimensions.extension.0.iter())
                    .any(|(joint, _)| mechanism.joints()[*joint].role == Role::Actuated);
                scene.rods.push(SceneRod {
                    name: closure.name.clone(),
                    ends: poses.map(|pose| pose.position.0),
                    bodies,
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
        scene.blocks();
        scene.bearings(mechanism, &pose, &number);
        scene.travels(mechanism, at, &pose);
        scene.gears(mechanism, &pose, &number);
        scene
    }

    /// Adds the frames of chains and platforms that have names of their own.
    #[must_use]
    pub fn with_frames(mut self, mechanism: &Mechanism, at: &Configuration<f64>) -> Self {
        let frames = mechanism.frames().into_iter();
        self.frames.extend(frames.map(|frame| {
            let pose = mechanism.transform(Frame::Ground, frame, at);
            Triad {
                name: mechanism.frame_name(frame),
                at: pose.position.0,
                axes: pose.rotation.0.map(|axis| axis.0),
            }
        }));
        self
    }

    /// Every point from which something is drawn.
    pub fn points(&self) -> Vec<Triple> {
        let bodies = self.bodies.iter();
        let bodies = bodies.flat_map(|body| body.lines.iter().flatten().chain(&body.corners));
        let rods = self.rods.iter().flat_map(|rod| &rod.ends);
        let joints = self.joints.iter().map(|joint| &joint.at);
        let traced = self.paths.iter().flat_map(|path| &path.points);
        let wheels = self.wheels.iter().flat_map(Wheel::points);
        let centres = self.centres.iter().map(|centre| &centre.at);
        let all = bodies
            .chain(rods)
            .chain(joints)
            .chain(traced)
            .chain(centres);
        let slides = self.travels.iter().filter(|travel| travel.arm.is_none());
        let ends = slides.flat_map(|travel| {
            let (at, axis) = (Vector3(travel.at), Vector3(travel.axis));
            travel.ends.map(|end| (at + axis.times(end)).0)
        });
        all.copied().chain(wheels).chain(ends).collect()
    }

    fn attach(&mut self, body: usize, at: Vector3<f64>) {
        let corners = &mut self.bodies[body].corners;
        if !corners.iter().any(|corner| close(&Vector3(*corner), &at)) {
            corners.push(at.0);
        }
    }
}

/// The least and the greatest of values; of none infinities, the greater one first.
pub(crate) fn least_and_greatest(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    values.fold(none, |(low, high), x| (low.min(x), high.max(x)))
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
        ClosureKind::Spherical | ClosureKind::Distance | ClosureKind::Coupling => {
            (JointSymbol::Spherical, middle, vec![])
        }
        ClosureKind::Revolute => (JointSymbol::Revolute, middle, vec![z[0]]),
        ClosureKind::Universal => (JointSymbol::Universal, middle, z.to_vec()),
        ClosureKind::Rigid => (JointSymbol::Rigid, middle, vec![]),
        // the second frame slides along the axis of the first
        ClosureKind::Prismatic => (JointSymbol::Prismatic, b.position.0, vec![z[0]]),
        ClosureKind::Cylindrical => (JointSymbol::Cylindrical, b.position.0, vec![z[0]]),
        ClosureKind::Planar => (JointSymbol::Planar, b.position.0, vec![z[0]]),
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
