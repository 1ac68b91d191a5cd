//! Tree → URDF, without its loops.

use crate::description::ClosureKind;
use crate::geometry::{Pose, RollPitchYaw, Vector3};
use crate::interchange::masses::Heavy;
use crate::interchange::remark::Remark;
use crate::interchange::tree::{BodyMotion, Coupling, Tree, TreeBody, TreeJoint, TreeLoop};
use crate::interchange::xml_writer::{Xml, numbers, vector};

/// The limit of a prismatic joint that has none, in units of the size of the mechanism.
const FAR: f64 = 1000.0;

/// The text of a URDF file, with remarks on its losses.
pub fn write(tree: &Tree) -> (String, Vec<Remark>) {
    let mut writer = UrdfWriter {
        tree,
        links: Xml::default(),
        joints: Xml::default(),
        remarks: Vec::new(),
        unlimited: Vec::new(),
        away: Vec::new(),
    };
    let home = tree.home();
    for (i, body) in tree.bodies.iter().enumerate() {
        if !writer.is_lost(body) {
            writer.body(i, body, &home[i]);
        }
    }
    let mut remarks = writer.losses();
    remarks.extend(tree.bent());
    remarks.splice(0..0, writer.remarks);
    if !writer.away.is_empty() {
        let joints = writer.away;
        remarks.push(Remark::HomeLost { joints });
    }
    if !writer.unlimited.is_empty() {
        remarks.push(Remark::LimitsInvented {
            joints: writer.unlimited,
            limit: FAR * tree.size,
        });
    }
    if !tree.is_heavy() {
        remarks.push(Remark::MassesInvented);
    }
    let mut xml = Xml::default();
    xml.open("robot name", &[&tree.name]);
    xml.append(writer.links);
    xml.append(writer.joints);
    xml.close("robot");
    (xml.text(), remarks)
}

struct UrdfWriter<'a> {
    tree: &'a Tree,
    links: Xml,
    joints: Xml,
    remarks: Vec<Remark>,
    unlimited: Vec<String>,
    /// Joints that are not at 0 at home.
    away: Vec<String>,
}

impl UrdfWriter<'_> {
    /// The lengths of distances: joints of bodies that nothing else follows.
    fn is_lost(&self, body: &TreeBody) -> bool {
        let [joint] = body.joints.as_slice() else {
            return false;
        };
        let mut couplings = self.tree.couplings.iter().filter_map(Coupling::pair);
        body.frames.is_empty() && !couplings.any(|(_, leader, ..)| leader == joint.name)
    }

    fn rigid(&self) -> impl Iterator<Item = &TreeLoop> {
        let loops = self.tree.loops.iter();
        loops.filter(|l| l.kind == ClosureKind::Rigid)
    }

    /// The closure that fixes a floating body to a frame of another one, and the body's side of it.
    fn fixing(&self, body: usize) -> Option<(&TreeLoop, usize)> {
        let mut sides = self.rigid().flat_map(|l| [(l, 0), (l, 1)]);
        // an earlier body cannot be a child of this one
        sides.find(|(l, side)| {
            l.sides[*side].body == body && !self.hangs_on(l.sides[1 - side].body, body)
        })
    }

    /// True if another body carries a body, through joints or rigid closures.
    fn hangs_on(&self, body: usize, on: usize) -> bool {
        let mut at = Some(body);
        while let Some(body) = at.filter(|body| *body != on) {
            let part = &self.tree.bodies[body];
            // a floating body may itself be fixed to another one
            let touches = |l: &TreeLoop| l.sides.iter().any(|side| side.body == body);
            if part.home.is_some() && self.rigid().any(touches) {
                return true;
            }
            at = part.parent;
        }
        at.is_some()
    }

    fn body(&mut self, index: usize, body: &TreeBody, home: &Pose<f64>) {
        let tree = self.tree;
        let Some(parent) = body.parent else {
            self.link(&body.name, false, None);
            self.frames(body);
            return;
        };
        let mut parent = tree.bodies[parent].name.clone();
        let mut origin = body.pose;
        for (i, joint) in body.joints.iter().enumerate() {
            let child = match i + 1 == body.joints.len() {
                true => body.name.clone(),
                false => format!("{}.{}", body.name, joint.name),
            };
            let mut kind = None;
            if joint.motion == BodyMotion::Free {
                (kind, parent, origin) = self.floating(index, parent, home);
            }
            self.joint(joint, kind, [&parent, &child], &origin);
            let last = i + 1 == body.joints.len();
            self.link(&child, true, body.heavy.as_ref().filter(|_| last));
            (parent, origin) = (child, Pose::identity());
        }
        self.frames(body);
    }

    /// A floating body is fixed where a rigid closure says so.
    fn floating(
        &mut self,
        body: usize,
        parent: String,
        home: &Pose<f64>,
    ) -> (Option<&'static str>, String, Pose<f64>) {
        let platform = self.tree.bodies[body].name.clone();
        let Some((of, side)) = self.fixing(body) else {
            self.remarks.push(Remark::Floating { platform });
            return (None, parent, *home);
        };
        let (own, other) = (&of.sides[side], &of.sides[1 - side]);
        let parent = self.tree.bodies[other.body].name.clone();
        let origin = other.pose * own.pose.inverse();
        let (closure, frame) = (of.name.clone(), other.frame.clone());
        let fixed = Remark::Fixed {
            platform,
            closure,
            frame,
        };
        self.remarks.push(fixed);
        (Some("fixed"), parent, origin)
    }

    /// Frames that are not the body's own, as links fixed to it.
    fn frames(&mut self, body: &TreeBody) {
        for (name, pose) in &body.frames {
            if *name == body.name && *pose == Pose::identity() {
                continue;
            }
            let joint = format!("{} to {name}", body.name);
            self.open_joint(&joint, "fixed", [&body.name, name], pose);
            // readers want an axis and a limit of joints that do not move too
            self.joints.leaf("axis xyz", &[&"1 0 0"]);
            self.limit(Some((0.0, 0.0)), 0.0, 0.0);
            self.joints.close("joint");
            self.link(name, false, None);
        }
    }

    fn joint(
        &mut self,
        joint: &TreeJoint,
        kind: Option<&'static str>,
        links: [&str; 2],
        origin: &Pose<f64>,
    ) {
        let far = FAR * self.tree.size;
        let (own, limits) = match (joint.motion, joint.limits) {
            (BodyMotion::Turn, None) => ("continuous", None),
            (BodyMotion::Turn, limits) => ("revolute", limits),
            (BodyMotion::Slide, limits) => ("prismatic", limits.or(Some((-far, far)))),
            (BodyMotion::Ball | BodyMotion::Free, _) => ("floating", None),
        };
        if joint.motion == BodyMotion::Slide && joint.limits.is_none() {
            self.unlimited.push(joint.name.clone());
        }
        let mut couplings = self.tree.couplings.iter().filter_map(Coupling::pair);
        let coupling = couplings.find(|(follower, ..)| *follower == joint.name);
        if !joint.motion.floats() && coupling.is_none() && joint.home != 0.0 {
            self.away.push(joint.name.clone());
        }
        self.open_joint(&joint.name, kind.unwrap_or(own), links, origin);
        self.joints.leaf("axis xyz", &[&vector(&joint.axis)]);
        self.limit(limits, if joint.actuated { FAR } else { 0.0 }, FAR);
        if let Some((_, leader, factor, offset)) = coupling {
            self.joints.leaf(
                "mimic joint multiplier offset",
                &[&leader, &numbers([factor]), &numbers([offset])],
            );
        }
        self.joints.close("joint");
    }

    fn open_joint(&mut self, name: &str, kind: &str, links: [&str; 2], origin: &Pose<f64>) {
        self.joints.open("joint name type", &[&name, &kind]);
        write_origin(&mut self.joints, origin);
        self.joints.leaf("parent link", &[&links[0]]);
        self.joints.leaf("child link", &[&links[1]]);
    }

    fn limit(&mut self, limits: Option<(f64, f64)>, effort: f64, velocity: f64) {
        let limits = limits.map(|(low, high)| [low, high].map(|end| numbers([end])));
        let [low, high] = limits.unwrap_or_default();
        self.joints.leaf(
            "limit lower upper effort velocity",
            &[&low, &high, &effort, &velocity],
        );
    }

    /// A link; where no masses are known, one that moves has a made-up one. It has a ball at its joint.
    fn link(&mut self, name: &str, moves: bool, heavy: Option<&Heavy>) {
        let size = self.tree.size;
        let made = moves && !self.tree.is_heavy();
        let (mass, inertia) = match (made, heavy) {
            (_, Some(heavy)) => (heavy.mass, heavy.moments()),
            (true, None) => (
                0.1,
                [1.0, 1.0, 1.0, 0.0, 0.0, 0.0].map(|x| 1e-3 * size * size * x),
            ),
            (false, None) => (0.0, [0.0; 6]),
        };
        let centre = heavy.map_or(Vector3::zero(), |heavy| heavy.centre);
        let xml = &mut self.links;
        xml.open("link name", &[&name]);
        xml.open("inertial", &[]);
        write_origin(xml, &Pose::translation(centre));
        xml.leaf("mass value", &[&mass]);
        let [xx, yy, zz, xy, xz, yz] = inertia;
        xml.leaf(
            "inertia ixx ixy ixz iyy iyz izz",
            &[&xx, &xy, &xz, &yy, &yz, &zz],
        );
        xml.close("inertial");
        if moves {
            xml.open("visual", &[]);
            write_origin(xml, &Pose::identity());
            xml.open("geometry", &[]);
            xml.leaf("sphere radius", &[&(0.02 * size)]);
            xml.close("geometry");
            xml.close("visual");
        }
        xml.close("link");
    }

    fn losses(&self) -> Vec<Remark> {
        let fixes = |of: &TreeLoop| {
            let fixes = |remark: &Remark| matches!(remark, Remark::Fixed { closure, .. } if *closure == of.name);
            self.remarks.iter().any(fixes)
        };
        let mut losses = Vec::new();
        for of in self.tree.loops.iter().filter(|of| !fixes(of)) {
            losses.push(Remark::ClosureLost {
                closure: of.name.clone(),
                kind: of.kind,
                frames: [0, 1].map(|side| of.sides[side].frame.clone()),
            });
        }
        for body in self.tree.bodies.iter().filter(|body| self.is_lost(body)) {
            let joint = &body.joints[0].name;
            let uses = |of: &&TreeLoop| {
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

fn write_origin(xml: &mut Xml, pose: &Pose<f64>) {
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    let rpy = numbers([roll, pitch, yaw]);
    xml.leaf("origin xyz rpy", &[&vector(&pose.position), &rpy]);
}
