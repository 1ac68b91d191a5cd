//! The way back: the joint axes that the tables of a mechanism describe.

use super::chains::nowhere;
use crate::description::{
    AxesDescription, AxisDescription, AxisKind, AxisPlace, ClosureKind, Displacement, Entry,
    GROUND, Named, Role,
};
use crate::geometry::{Axis, Pose, Vector3};
use crate::mechanism::{Body, Configuration, Frame, Mechanism};

/// Why a mechanism's joints are not given by axes.
#[derive(Clone, Debug, PartialEq)]
pub enum AxesError {
    /// A row that is not one revolute or prismatic joint with a variable of its own.
    Row {
        /// The chain.
        chain: String,
        /// The row, from 1.
        row: usize,
    },
    /// A closure that is not made of axes.
    Closure {
        /// The closure.
        closure: String,
        /// Its kind.
        kind: ClosureKind,
    },
    /// A chain or platform holds no joint.
    TooFew,
}

/// A joint with the bodies it connects.
struct Joint {
    name: String,
    kind: AxisKind,
    point: Vector3<f64>,
    direction: Vector3<f64>,
    home: f64,
    limits: Option<(f64, f64)>,
    role: Option<Role>,
    bodies: [String; 2],
}

impl Joint {
    fn described(self, closed: bool) -> Named<AxisDescription> {
        let vector = |v: Vector3<f64>| v.0.map(Entry::length);
        let value = |x: f64| match self.kind {
            AxisKind::Prismatic => Entry::length(x),
            AxisKind::Revolute | AxisKind::Spherical => Entry::angle(x),
        };
        Named {
            name: nowhere(self.name),
            value: AxisDescription {
                kind: self.kind,
                place: match self.kind {
                    AxisKind::Spherical => AxisPlace::Centre(vector(self.point)),
                    AxisKind::Prismatic => AxisPlace::Along(None, vector(self.direction)),
                    AxisKind::Revolute => {
                        AxisPlace::Along(Some(vector(self.point)), vector(self.direction))
                    }
                },
                role: self.role,
                home: value(self.home),
                limits: self.limits.map(|(low, high)| (value(low), value(high))),
                between: closed.then(|| self.bodies.map(nowhere)),
                span: 0..0,
            },
        }
    }
}

/// The joint axes of a mechanism at a configuration, which becomes the home of the file of axes.
///
/// Universal and cylindrical closures become two joints with a body between them.
///
/// # Errors
/// If a joint is none that has an axis.
pub fn joint_axes(
    mechanism: &Mechanism,
    at: &Configuration<f64>,
) -> Result<AxesDescription, AxesError> {
    let mut joints = rows(mechanism, at)?;
    let rigid = closures(mechanism, at, &mut joints)?;
    if joints.is_empty() {
        return Err(AxesError::TooFew);
    }
    // bodies held together are one
    for (kept, lost) in rigid {
        for joint in &mut joints {
            for body in joint.bodies.iter_mut().filter(|body| **body == lost) {
                body.clone_from(&kept);
            }
        }
    }
    let follows = |pair: &[Joint]| pair[0].bodies[1] == pair[1].bodies[0];
    let serial = mechanism
        .chains()
        .iter()
        .filter(|chain| !chain.rows.is_empty())
        .count()
        == 1
        && joints[0].bodies[0] == GROUND
        && joints.windows(2).all(follows)
        && joints
            .iter()
            .all(|joint| joint.kind != AxisKind::Spherical && joint.bodies[1] != GROUND);
    let ends = |frame: Frame| {
        let pose = mechanism.transform(Frame::Ground, frame, at);
        Displacement::of_pose(&pose)
    };
    let chain = mechanism
        .chains()
        .iter()
        .position(|chain| !chain.rows.is_empty());
    let chain = chain.filter(|_| serial);
    Ok(AxesDescription {
        name: nowhere(mechanism.name().into()),
        source: mechanism.source().map(|source| nowhere(source.into())),
        convention: mechanism
            .chains()
            .first()
            .map(|chain| nowhere(chain.convention)),
        parameters: vec![],
        joints: joints
            .into_iter()
            .map(|joint| joint.described(!serial))
            .collect(),
        base: chain.map(|chain| ends(Frame::Link { chain, row: 0 })),
        tool: chain.map(|chain| ends(Frame::Tip { chain })),
        cut: vec![],
    })
}

fn rows(mechanism: &Mechanism, at: &Configuration<f64>) -> Result<Vec<Joint>, AxesError> {
    let mut joints: Vec<Joint> = Vec::new();
    for (chain, part) in mechanism.dimensions().chains.iter().enumerate() {
        for (k, dims) in part.rows.iter().enumerate().filter(|(_, row)| row.moves()) {
            let refused = || AxesError::Row {
                chain: mechanism.chains()[chain].name.clone(),
                row: k + 1,
            };
            let (joint, factor, kind) = match (&dims.turn.0[..], &dims.slide.0[..]) {
                (&[(joint, factor)], []) => (joint, factor, AxisKind::Revolute),
                ([], &[(joint, factor)]) => (joint, factor, AxisKind::Prismatic),
                _ => return Err(refused()),
            };
            let variable = &mechanism.joints()[joint];
            let known = joints.iter().any(|known| known.name == variable.name);
            if known || factor.abs() != 1.0 {
                return Err(refused());
            }
            let frame = |row: usize| Frame::Link { chain, row };
            let before = mechanism.transform(Frame::Ground, frame(k), at) * dims.before;
            let body = |row: usize| mechanism.body_name(mechanism.body(frame(row)));
            joints.push(Joint {
                name: variable.name.clone(),
                kind,
                point: before.position,
                direction: before.rotation.column(Axis::Z).times(factor),
                home: at.joints[joint],
                limits: variable.limits,
                role: Some(variable.role),
                bodies: [body(k), body(k + 1)],
            });
        }
    }
    Ok(joints)
}

/// Adds the closures as joints; returns the bodies that they hold together, one of which stands for
/// both.
fn closures(
    mechanism: &Mechanism,
    at: &Configuration<f64>,
    joints: &mut Vec<Joint>,
) -> Result<Vec<(String, String)>, AxesError> {
    let mut rigid = Vec::new();
    for closure in mechanism.closures() {
        let poses = mechanism.poses(closure.frames, at);
        let [first, second] = closure.frames.map(|frame| mechanism.body(frame));
        let names = [first, second].map(|body| mechanism.body_name(body));
        let joint = |suffix: &str, kind, pose: &Pose<f64>, bodies: [String; 2]| {
            let wanted = format!("{}{suffix}", closure.name);
            Joint {
                name: variable(mechanism, &wanted),
                kind,
                point: pose.position,
                direction: pose.rotation.column(Axis::Z),
                home: 0.0,
                limits: None,
                role: (kind != AxisKind::Spherical).then_some(Role::Passive),
                bodies,
            }
        };
        let middle = || format!("{} between", closure.name);
        let [from, to] = names.clone();
        match closure.kind {
            ClosureKind::Revolute => {
                joints.push(joint("", AxisKind::Revolute, &poses[0], names));
            }
            ClosureKind::Prismatic => {
                joints.push(joint("", AxisKind::Prismatic, &poses[0], names));
            }
            ClosureKind::Spherical => {
                joints.push(joint("", AxisKind::Spherical, &poses[0], names));
            }
            ClosureKind::Universal => {
                joints.push(joint("_1", AxisKind::Revolute, &poses[0], [from, middle()]));
                joints.push(joint("_2", AxisKind::Revolute, &poses[1], [middle(), to]));
            }
            ClosureKind::Cylindrical => {
                joints.push(joint(
                    "_turn",
                    AxisKind::Revolute,
                    &poses[0],
                    [from, middle()],
                ));
                joints.push(joint(
                    "_slide",
                    AxisKind::Prismatic,
                    &poses[0],
                    [middle(), to],
                ));
            }
            ClosureKind::Rigid => {
                let kept = match (first, second) {
                    (_, Body::Ground) => [to, from],
                    _ => [from, to],
                };
                let [kept, lost] = kept;
                rigid.push((kept, lost));
            }
            kind @ (ClosureKind::Planar | ClosureKind::Distance) => {
                let closure = closure.name.clone();
                return Err(AxesError::Closure { closure, kind });
            }
        }
    }
    Ok(rigid)
}

/// A name for the variable of a closure that no joint has.
fn variable(mechanism: &Mechanism, wanted: &str) -> String {
    let clean: String = (wanted.chars())
        .map(|c| {
            if c.is_alphanumeric() || c == '_' {
                c
            } else {
                '_'
            }
        })
        .collect();
    let numbered = (2..).map(|i| format!("q_{clean}_{i}"));
    let mut names = [clean.clone(), format!("q_{clean}")]
        .into_iter()
        .chain(numbered);
    let free = |name: &String| {
        crate::algebra::is_name(name)
            && !crate::algebra::is_reserved(name)
            && mechanism.joint(name).is_none()
    };
    names.find(free).unwrap_or_default()
}
