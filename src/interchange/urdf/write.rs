//! Tree → URDF, without its loops.

use urdf_rs::{
    Axis, Geometry, Inertia, Inertial, JointLimit, JointType, Link, LinkName, Mass, Mimic, Robot,
    Vec3, Visual,
};

use crate::description::ClosureKind;
use crate::geometry::{Pose, RollPitchYaw};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Body, Joint, Loop, Motion, Tree};

/// The limit of a prismatic joint that has none, in units of the size of the mechanism.
const FAR: f64 = 1000.0;

/// The text of a URDF file, with remarks on what it cannot express.
///
/// # Errors
/// If the text cannot be written; with the error of the XML writer.
pub fn write(tree: &Tree) -> Result<(String, Vec<Remark>), String> {
    let mut writer = UrdfWriter {
        tree,
        robot: Robot {
            name: tree.name.clone(),
            version: None,
            links: Vec::new(),
            joints: Vec::new(),
            materials: Vec::new(),
        },
        remarks: Vec::new(),
        unlimited: Vec::new(),
        away: Vec::new(),
    };
    let home = tree.home();
    for (i, body) in tree.bodies.iter().enumerate() {
        if !writer.is_lost(body) {
            writer.body(i, body, &home);
        }
    }
    let kept = writer.losses();
    let UrdfWriter {
        robot,
        mut remarks,
        unlimited,
        away,
        ..
    } = writer;
    remarks.extend(kept);
    if !away.is_empty() {
        remarks.push(Remark::HomeLost { joints: away });
    }
    if !unlimited.is_empty() {
        remarks.push(Remark::LimitsInvented {
            joints: unlimited,
            limit: FAR * tree.size,
        });
    }
    remarks.push(Remark::MassesInvented);
    let text = urdf_rs::write_to_string(&robot).map_err(|error| error.to_string())?;
    Ok((text.trim_end().to_owned() + "\n", remarks))
}

struct UrdfWriter<'a> {
    tree: &'a Tree,
    robot: Robot,
    remarks: Vec<Remark>,
    unlimited: Vec<String>,
    /// Joints that are not at 0 at home.
    away: Vec<String>,
}

impl UrdfWriter<'_> {
    /// The lengths of distances: joints of bodies without children.
    fn is_lost(&self, body: &Body) -> bool {
        let [joint] = body.joints.as_slice() else {
            return false;
        };
        body.frames.is_empty()
            && !self
                .tree
                .couplings
                .iter()
                .any(|coupling| coupling.leader == joint.name)
    }

    fn rigid(&self) -> impl Iterator<Item = &Loop> {
        let loops = self.tree.loops.iter();
        loops.filter(|l| l.kind == ClosureKind::Rigid)
    }

    /// The closure that fixes a floating body to a frame of another one.
    fn fixing(&self, body: usize) -> Option<(&Loop, usize)> {
        let sides = self.rigid().flat_map(|l| [(l, 0), (l, 1)]);
        // an earlier body cannot be a child of this one
        let mut fixing = sides.filter(|(l, side)| {
            l.sides[*side].body == body && !self.hangs_on(l.sides[1 - side].body, body)
        });
        fixing.next()
    }

    /// Whether another body carries a body, through joints or rigid closures.
    fn hangs_on(&self, body: usize, on: usize) -> bool {
        let mut at = Some(body);
        while let Some(body) = at {
            if body == on {
                return true;
            }
            let part = &self.tree.bodies[body];
            // a floating body may itself be fixed to another one
            if part.home.is_some() && body != on {
                let touches = |l: &Loop| l.sides.iter().any(|side| side.body == body);
                if self.rigid().any(touches) {
                    return true;
                }
            }
            at = part.parent;
        }
        false
    }

    fn body(&mut self, index: usize, body: &Body, home: &[Pose<f64>]) {
        let Some(parent) = body.parent else {
            self.robot.links.push(link(&body.name, None));
            self.frames(body);
            return;
        };
        let mut parent = self.tree.bodies[parent].name.clone();
        let mut origin = body.pose;
        let last = body.joints.len().saturating_sub(1);
        for (i, joint) in body.joints.iter().enumerate() {
            let child = match i == last {
                true => body.name.clone(),
                false => format!("{}.{}", body.name, joint.name),
            };
            let mut written = self.joint(joint, &parent, &child, &origin);
            if joint.motion == Motion::Free {
                self.floating(index, body, home, &mut written);
            }
            self.robot.joints.push(written);
            self.robot.links.push(link(&child, Some(self.tree.size)));
            (parent, origin) = (child, Pose::identity());
        }
        self.frames(body);
    }

    /// Fixes floating bodies that a rigid closure attaches.
    fn floating(
        &mut self,
        index: usize,
        body: &Body,
        home: &[Pose<f64>],
        written: &mut urdf_rs::Joint,
    ) {
        let Some((of, side)) = self.fixing(index) else {
            written.origin = placed(&home[index]);
            let platform = body.name.clone();
            self.remarks.push(Remark::Floating { platform });
            return;
        };
        let (own, other) = (&of.sides[side], &of.sides[1 - side]);
        let fixed = Remark::Fixed {
            platform: body.name.clone(),
            closure: of.name.clone(),
            frame: other.frame.clone(),
        };
        written.joint_type = JointType::Fixed;
        written.parent.link = self.tree.bodies[other.body].name.clone();
        written.origin = placed(&(other.pose * own.pose.inverse()));
        self.remarks.push(fixed);
    }

    /// Further frames of the body, as links fixed to it.
    fn frames(&mut self, body: &Body) {
        for (name, pose) in &body.frames {
            if *name == body.name && *pose == Pose::identity() {
                continue;
            }
            let mut joint = fixed(&body.name, name);
            joint.origin = placed(pose);
            self.robot.joints.push(joint);
            self.robot.links.push(link(name, None));
        }
    }

    fn joint(
        &mut self,
        joint: &Joint,
        parent: &str,
        child: &str,
        at: &Pose<f64>,
    ) -> urdf_rs::Joint {
        let (joint_type, limits) = match (joint.motion, joint.limits) {
            (Motion::Turn, None) => (JointType::Continuous, None),
            (Motion::Turn, limits) => (JointType::Revolute, limits),
            (Motion::Slide, Some(limits)) => (JointType::Prismatic, Some(limits)),
            (Motion::Slide, None) => {
                let far = FAR * self.tree.size;
                self.unlimited.push(joint.name.clone());
                (JointType::Prismatic, Some((-far, far)))
            }
            (Motion::Ball | Motion::Free, _) => (JointType::Floating, None),
        };
        let coupling = self.tree.couplings.iter().find(|c| c.joint == joint.name);
        let moves = matches!(joint.motion, Motion::Turn | Motion::Slide);
        if moves && coupling.is_none() && joint.home != 0.0 {
            self.away.push(joint.name.clone());
        }
        let (lower, upper) = limits.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        urdf_rs::Joint {
            name: joint.name.clone(),
            joint_type,
            origin: placed(at),
            axis: Axis {
                xyz: Vec3(joint.axis.0.map(|x| x + 0.0)),
            },
            limit: JointLimit {
                lower,
                upper,
                effort: if joint.actuated { FAR } else { 0.0 },
                velocity: FAR,
                ..JointLimit::default()
            },
            mimic: coupling.map(|coupling| Mimic {
                joint: coupling.leader.clone(),
                multiplier: Some(coupling.factor),
                offset: Some(coupling.offset),
            }),
            ..fixed(parent, child)
        }
    }

    /// The closures and lengths that are left out.
    fn losses(&self) -> Vec<Remark> {
        let said = |of: &Loop| {
            let told = |remark: &Remark| matches!(remark, Remark::Fixed { closure, .. } if *closure == of.name);
            self.remarks.iter().any(told)
        };
        let mut losses = Vec::new();
        for of in self.tree.loops.iter().filter(|of| !said(of)) {
            losses.push(Remark::ClosureLost {
                closure: of.name.clone(),
                kind: of.kind,
                frames: [0, 1].map(|side| of.sides[side].frame.clone()),
            });
        }
        for body in self.tree.bodies.iter().filter(|body| self.is_lost(body)) {
            let joint = &body.joints[0].name;
            let uses = |of: &&Loop| {
                let mut terms = of.length.iter().flat_map(|length| &length.terms);
                terms.any(|(name, _)| name == joint)
            };
            let closures = self.tree.loops.iter().filter(uses);
            losses.push(Remark::LengthLost {
                joint: joint.clone(),
                closures: closures.map(|of| of.name.clone()).collect(),
            });
        }
        losses
    }
}

fn fixed(parent: &str, child: &str) -> urdf_rs::Joint {
    urdf_rs::Joint {
        name: format!("{parent} to {child}"),
        joint_type: JointType::Fixed,
        origin: urdf_rs::Pose::default(),
        parent: LinkName {
            link: parent.into(),
        },
        child: LinkName { link: child.into() },
        axis: Axis::default(),
        limit: JointLimit::default(),
        calibration: None,
        dynamics: None,
        mimic: None,
        safety_controller: None,
    }
}

fn placed(pose: &Pose<f64>) -> urdf_rs::Pose {
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    urdf_rs::Pose {
        xyz: Vec3(pose.position.0.map(|x| x + 0.0)),
        rpy: Vec3([roll, pitch, yaw].map(|x| x + 0.0)),
    }
}

/// A link; one that moves, in a mechanism of some size, has a made-up mass and a ball at its joint.
fn link(name: &str, moves: Option<f64>) -> Link {
    let mut link = Link {
        name: name.into(),
        inertial: Inertial::default(),
        visual: Vec::new(),
        collision: Vec::new(),
    };
    if let Some(size) = moves {
        let inertia = 1e-3 * size * size;
        link.inertial.mass = Mass { value: 0.1 };
        link.inertial.inertia = Inertia {
            ixx: inertia,
            iyy: inertia,
            izz: inertia,
            ..Inertia::default()
        };
        link.visual.push(Visual {
            geometry: Geometry::Sphere {
                radius: 0.02 * size,
            },
            ..Visual::default()
        });
    }
    link
}
