//! The inverse: the joint axes that the tables of a mechanism describe.

use crate::algebra::Measure;
use crate::description::{
    AxesDescription, AxisDescription, AxisKind, AxisPlace, ClosureKind, Displacement, Entry,
    GROUND, Named, Role, Spanned, free_variable, place_of,
};
use crate::geometry::{Axis, Pose, Vector3};
use crate::mechanism::{Body, Configuration, Frame, Mechanism, Symbol};

/// Reasons for which a mechanism's joints are not given by axes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AxesError {
    /// A row that is not one revolute or prismatic joint with a variable of its own.
    #[error("row {row} of chain `{chain}` is not one joint with a variable of its own")]
    Row {
        /// The chain.
        chain: String,
        /// The row, from 1.
        row: usize,
    },
    /// A rod whose length is no constant plus or minus one variable of its own.
    #[error("the length of the {} closure `{closure}` is not one joint", .kind.word().to_lowercase())]
    Closure {
        /// The closure.
        closure: String,
        /// Its kind.
        kind: ClosureKind,
    },
    /// A chain or platform holds no joint.
    #[error("the mechanism has no joints with axes")]
    TooFew,
}

/// A joint with the bodies it connects.
struct AxisJoint {
    name: String,
    kind: AxisKind,
    point: Vector3<f64>,
    direction: Vector3<f64>,
    home: f64,
    limits: Option<(f64, f64)>,
    role: Option<Role>,
    bodies: [String; 2],
}

impl AxisJoint {
    fn described(self, closed: bool) -> Named<AxisDescription> {
        let vector = |v: Vector3<f64>| v.0.map(Entry::length);
        let value = |x: f64| match self.kind {
            AxisKind::Prismatic => Entry::length(x),
            _ => Entry::angle(x),
        };
        let place = match self.kind {
            AxisKind::Spherical => AxisPlace::Centre(vector(self.point)),
            AxisKind::Prismatic => AxisPlace::Along(None, vector(self.direction)),
            _ => AxisPlace::Along(Some(vector(self.point)), vector(self.direction)),
        };
        let axis = AxisDescription {
            role: self.role,
            home: (self.home != 0.0).then(|| value(self.home)),
            limits: self.limits.map(|(low, high)| (value(low), value(high))),
            between: closed.then(|| self.bodies.map(Spanned::nowhere)),
            ..AxisDescription::new(self.kind, place)
        };
        Named::new(self.name, axis)
    }
}

/// The joint axes of a mechanism at a configuration, which becomes the home of the file of axes.
///
/// Universal and cylindrical closures and cylindrical rows become two joints with a body between them, planar closures
/// three joints; a rod becomes a body, or two that slide, with a ball at each end.
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
    let follows = |pair: &[AxisJoint]| pair[0].bodies[1] == pair[1].bodies[0];
    let chains = mechanism.chains().iter().enumerate();
    let moving: Vec<usize> = chains
        .filter(|(_, c)| !c.rows.is_empty())
        .map(|(i, _)| i)
        .collect();
    let inside = |joint: &AxisJoint| joint.kind != AxisKind::Spherical && joint.bodies[1] != GROUND;
    let serial = moving.len() == 1
        && joints[0].bodies[0] == GROUND
        && joints.windows(2).all(follows)
        && joints.iter().all(inside);
    let ends = |frame: Frame| {
        let pose = mechanism.transform(Frame::Ground, frame, at);
        Displacement::of_pose(&pose)
    };
    let chain = moving.first().copied().filter(|_| serial);
    let convention = mechanism.chains().first().map(|chain| chain.convention);
    let joints = joints.into_iter().map(|joint| joint.described(!serial));
    let (couplings, parameters) = couplings(mechanism);
    Ok(AxesDescription {
        couplings,
        parameters,
        name: Spanned::nowhere(mechanism.name().into()),
        source: mechanism
            .source()
            .map(|source| Spanned::nowhere(source.into())),
        convention: convention.map(Spanned::nowhere),
        joints: joints.collect(),
        base: chain.map(|chain| ends(Frame::Link { chain, row: 0 })),
        tool: chain.map(|chain| ends(Frame::Tip { chain })),
        ..AxesDescription::default()
    })
}

/// The couplings of a mechanism, and the parameters in them as numbers.
pub(super) fn couplings(mechanism: &Mechanism) -> (Vec<Named<Entry>>, Vec<Named<Entry>>) {
    let (mut couplings, mut parameters) = (Vec::new(), Vec::<Named<Entry>>::new());
    for closure in mechanism.closures() {
        let Some(relation) = &closure.relation else {
            continue;
        };
        let named = relation.try_resolve(|symbol, _| {
            let index = match *symbol {
                Symbol::Joint(joint) => return Ok(mechanism.joints()[joint].name.clone()),
                Symbol::Local(_) => return Err(()),
                Symbol::Parameter(index) => index,
            };
            let of = &mechanism.parameters()[index];
            if place_of(&parameters, &of.name).is_none() {
                let value = match of.measure {
                    Measure::Angle => Entry::angle(of.value),
                    _ => Entry::length(of.value),
                };
                parameters.push(Named::new(of.name.to_string(), value));
            }
            Ok(of.name.to_string())
        });
        let named = named.expect("joints and parameters alone stand in couplings");
        couplings.push(Named::new(closure.name.clone(), named.into()));
    }
    (couplings, parameters)
}

/// The name of a body in joint coordinates, where a dot is reserved for frames.
fn plain_name(mechanism: &Mechanism, body: Body) -> String {
    let plain = |body| mechanism.body_name(body).replace('.', "_");
    let name = plain(body);
    let before = mechanism.bodies().into_iter();
    let before = before.take_while(|other| *other != body);
    let alike = before.filter(|other| plain(*other) == name).count();
    name + &"_".repeat(alike)
}

fn rows(mechanism: &Mechanism, at: &Configuration<f64>) -> Result<Vec<AxisJoint>, AxesError> {
    let mut joints: Vec<AxisJoint> = Vec::new();
    for (chain, part) in mechanism.dimensions().chains.iter().enumerate() {
        for (k, dims) in part.rows.iter().enumerate().filter(|(_, row)| row.moves()) {
            let refused = || AxesError::Row {
                chain: mechanism.chains()[chain].name.clone(),
                row: k + 1,
            };
            let frame = |row: usize| Frame::Link { chain, row };
            let before = mechanism.transform(Frame::Ground, frame(k), at) * dims.before;
            let body = |row: usize| plain_name(mechanism, mechanism.body(frame(row)));
            let (turn, slide) = (AxisKind::Revolute, AxisKind::Prismatic);
            let moves = match (&dims.turn.0[..], &dims.slide.0[..]) {
                (&[term], []) => vec![(term, turn, [body(k), body(k + 1)])],
                ([], &[term]) => vec![(term, slide, [body(k), body(k + 1)])],
                // a cylindrical row: a link without extent turns, and the next slides on it
                (&[one], &[two]) => {
                    let middle = format!("{} turned", body(k + 1));
                    let first = (one, turn, [body(k), middle.clone()]);
                    vec![first, (two, slide, [middle, body(k + 1)])]
                }
                _ => return Err(refused()),
            };
            for ((joint, factor), kind, bodies) in moves {
                let variable = &mechanism.joints()[joint];
                let known = joints.iter().any(|known| known.name == variable.name);
                if known || factor.abs() != 1.0 {
                    return Err(refused());
                }
                joints.push(AxisJoint {
                    name: variable.name.clone(),
                    kind,
                    point: before.position,
                    direction: before.rotation.column(Axis::Z).times(factor),
                    home: at.joints[joint],
                    limits: variable.limits,
                    role: Some(variable.role),
                    bodies,
                });
            }
        }
    }
    Ok(joints)
}

/// Adds the closures as joints; returns the bodies that they hold together, one of which stands for
/// both.
fn closures(
    mechanism: &Mechanism,
    at: &Configuration<f64>,
    joints: &mut Vec<AxisJoint>,
) -> Result<Vec<(String, String)>, AxesError> {
    let mut rigid = Vec::new();
    for (index, closure) in mechanism.closures().iter().enumerate() {
        let poses = mechanism.poses(closure.frames, at);
        use AxisKind::{Prismatic, Revolute, Spherical};
        let bodies = closure.frames.map(|frame| mechanism.body(frame));
        let names = bodies.map(|body| plain_name(mechanism, body));
        let joint = |suffix: &str, kind, pose: &Pose<f64>, bodies: [String; 2]| {
            let wanted = format!("{}{suffix}", closure.name);
            let free = |name: &str| mechanism.joint(name).is_none();
            AxisJoint {
                name: free_variable(&wanted, free),
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
            ClosureKind::Spherical => joints.push(joint("", Spherical, &poses[0], names)),
            ClosureKind::Revolute
            | ClosureKind::Prismatic
            | ClosureKind::Universal
            | ClosureKind::Cylindrical => {
                let variables = closure.kind.variables();
                let mut ends = vec![from, to];
                if variables.len() == 2 {
                    ends.insert(1, middle());
                }
                for (k, &(suffix, slides)) in variables.iter().enumerate() {
                    let bodies = [ends[k].clone(), ends[k + 1].clone()];
                    let at = match closure.kind {
                        ClosureKind::Universal => &poses[k],
                        _ => &poses[0],
                    };
                    let kind = if slides { Prismatic } else { Revolute };
                    joints.push(joint(suffix, kind, at, bodies));
                }
            }
            ClosureKind::Rigid => {
                rigid.push(match bodies[1] {
                    Body::Ground => (to, from),
                    _ => (from, to),
                });
            }
            ClosureKind::Planar => {
                let bodies = ["sliding", "between"].map(|word| format!("{} {word}", closure.name));
                let [slid, between] = bodies;
                let [x, y, _] = poses[0].rotation.0;
                let slide = |suffix, direction, bodies| AxisJoint {
                    direction,
                    ..joint(suffix, Prismatic, &poses[0], bodies)
                };
                joints.push(slide("_x", x, [from, slid.clone()]));
                joints.push(slide("_y", y, [slid, between.clone()]));
                joints.push(joint("_turn", Revolute, &poses[1], [between, to]));
            }
            ClosureKind::Coupling => {}
            ClosureKind::Distance => {
                let ball =
                    |suffix, end: usize, bodies| joint(suffix, Spherical, &poses[end], bodies);
                let Some(slide) = length_of(mechanism, at, index, joints)? else {
                    joints.push(ball("_1", 0, [from, middle()]));
                    joints.push(ball("_2", 1, [middle(), to]));
                    continue;
                };
                let [first, second] = slide.bodies.clone();
                joints.push(ball("_1", 0, [from, first]));
                joints.push(slide);
                joints.push(ball("_2", 1, [second, to]));
            }
        }
    }
    Ok(rigid)
}

/// The sliding joint of a rod with a variable length; `None` for one of a constant length.
fn length_of(
    mechanism: &Mechanism,
    at: &Configuration<f64>,
    index: usize,
    known: &[AxisJoint],
) -> Result<Option<AxisJoint>, AxesError> {
    let closure = &mechanism.closures()[index];
    let poses = mechanism.poses(closure.frames, at);
    let [first, second] = poses.map(|pose| pose.position);
    let along = second - first;
    let refused = || AxesError::Closure {
        closure: closure.name.clone(),
        kind: closure.kind,
    };
    let (joint, factor) = match mechanism.dimensions().closures[index].extension.0[..] {
        [] => return Ok(None),
        [(joint, factor)] if factor.abs() == 1.0 && along.norm() > 0.0 => (joint, factor),
        _ => return Err(refused()),
    };
    let variable = &mechanism.joints()[joint];
    if known.iter().any(|known| known.name == variable.name) {
        return Err(refused());
    }
    Ok(Some(AxisJoint {
        name: variable.name.clone(),
        kind: AxisKind::Prismatic,
        point: first,
        direction: along.times(factor / along.norm()),
        home: at.joints[joint],
        limits: variable.limits,
        role: Some(variable.role),
        bodies: ["lower", "upper"].map(|part| format!("{} {part}", closure.name)),
    }))
}
