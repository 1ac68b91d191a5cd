//! Tree → URDF, without its loops.

use crate::description::ClosureKind;
use crate::geometry::{Pose, RollPitchYaw};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Body, Coupling, Joint, Loop, Motion, Tree};
use crate::interchange::xml::{Xml, number, numbers, vector};

/// The limit of a prismatic joint that has none, in units of the size of the mechanism.
const FAR: f64 = 1000.0;

/// The text of a URDF file, and what it does not say.
pub fn write(tree: &Tree) -> (String, Vec<Remark>) {
    let mut writer = UrdfWriter {
        tree,
        links: Vec::new(),
        joints: Vec::new(),
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
        links,
        joints,
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
    let mut xml = Xml::new();
    xml.open("robot", &[("name", tree.name.clone())]);
    for (name, moves) in &links {
        write_link(&mut xml, name, *moves, tree.size);
    }
    for joint in &joints {
        joint.write(&mut xml);
    }
    xml.close("robot");
    (xml.text(), remarks)
}

struct UrdfWriter<'a> {
    tree: &'a Tree,
    /// The names of links, and which of them move.
    links: Vec<(String, bool)>,
    joints: Vec<Written<'a>>,
    remarks: Vec<Remark>,
    unlimited: Vec<String>,
    /// Joints that are not at 0 at home.
    away: Vec<String>,
}

impl<'a> UrdfWriter<'a> {
    /// The lengths of distances: joints of bodies that nothing else follows.
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

    fn body(&mut self, index: usize, body: &'a Body, home: &[Pose<f64>]) {
        let Some(parent) = body.parent else {
            self.links.push((body.name.clone(), false));
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
            let mut written = self.joint(joint, &parent, &child, origin);
            if joint.motion == Motion::Free {
                self.floating(index, body, home, &mut written);
            }
            self.joints.push(written);
            self.links.push((child.clone(), true));
            (parent, origin) = (child, Pose::identity());
        }
        self.frames(body);
    }

    /// A floating body is fixed where a rigid closure says so.
    fn floating(&mut self, index: usize, body: &Body, home: &[Pose<f64>], written: &mut Written) {
        let Some((of, side)) = self.fixing(index) else {
            written.origin = home[index];
            self.remarks.push(Remark::Floating {
                platform: body.name.clone(),
            });
            return;
        };
        let (own, other) = (&of.sides[side], &of.sides[1 - side]);
        let fixed = Remark::Fixed {
            platform: body.name.clone(),
            closure: of.name.clone(),
            frame: other.frame.clone(),
        };
        written.kind = "fixed";
        written.parent = self.tree.bodies[other.body].name.clone();
        written.origin = other.pose * own.pose.inverse();
        self.remarks.push(fixed);
    }

    /// Frames that are not the body's own, as links fixed to it.
    fn frames(&mut self, body: &'a Body) {
        for (name, pose) in &body.frames {
            if *name == body.name && *pose == Pose::identity() {
                continue;
            }
            self.joints.push(Written {
                name: format!("{} to {name}", body.name),
                kind: "fixed",
                origin: *pose,
                parent: body.name.clone(),
                child: name.clone(),
                moves: None,
            });
            self.links.push((name.clone(), false));
        }
    }

    fn joint(
        &mut self,
        joint: &'a Joint,
        parent: &str,
        child: &str,
        origin: Pose<f64>,
    ) -> Written<'a> {
        let (kind, limits) = match (joint.motion, joint.limits) {
            (Motion::Turn, None) => ("continuous", None),
            (Motion::Turn, limits) => ("revolute", limits),
            (Motion::Slide, Some(limits)) => ("prismatic", Some(limits)),
            (Motion::Slide, None) => {
                let far = FAR * self.tree.size;
                self.unlimited.push(joint.name.clone());
                ("prismatic", Some((-far, far)))
            }
            (Motion::Ball | Motion::Free, _) => ("floating", None),
        };
        let coupling = self.tree.couplings.iter().find(|c| c.joint == joint.name);
        let moves = matches!(joint.motion, Motion::Turn | Motion::Slide);
        if moves && coupling.is_none() && joint.home != 0.0 {
            self.away.push(joint.name.clone());
        }
        Written {
            name: joint.name.clone(),
            kind,
            origin,
            parent: parent.to_owned(),
            child: child.to_owned(),
            moves: Some((joint, limits, coupling)),
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

/// A joint as it is written.
struct Written<'a> {
    name: String,
    /// The word of its type.
    kind: &'static str,
    origin: Pose<f64>,
    parent: String,
    child: String,
    moves: Option<Moving<'a>>,
}

/// A joint that moves, its limits, and what it follows.
type Moving<'a> = (&'a Joint, Option<(f64, f64)>, Option<&'a Coupling>);

impl Written<'_> {
    fn write(&self, xml: &mut Xml) {
        let kind = self.kind.to_owned();
        xml.open("joint", &[("name", self.name.clone()), ("type", kind)]);
        write_origin(xml, &self.origin);
        xml.leaf("parent", &[("link", self.parent.clone())]);
        xml.leaf("child", &[("link", self.child.clone())]);
        match self.moves {
            // readers want an axis and a limit of joints that do not move too
            None => {
                xml.leaf("axis", &[("xyz", numbers([1.0, 0.0, 0.0]))]);
                xml.leaf("limit", &limit(Some((0.0, 0.0)), 0.0, 0.0));
            }
            Some((joint, limits, coupling)) => {
                xml.leaf("axis", &[("xyz", vector(&joint.axis))]);
                let effort = if joint.actuated { FAR } else { 0.0 };
                xml.leaf("limit", &limit(limits, effort, FAR));
                if let Some(coupling) = coupling {
                    let attributes = [
                        ("joint", coupling.leader.clone()),
                        ("multiplier", number(coupling.factor)),
                        ("offset", number(coupling.offset)),
                    ];
                    xml.leaf("mimic", &attributes);
                }
            }
        }
        xml.close("joint");
    }
}

fn limit(limits: Option<(f64, f64)>, effort: f64, velocity: f64) -> Vec<(&'static str, String)> {
    let mut attributes = Vec::new();
    if let Some((low, high)) = limits {
        attributes.extend([("lower", number(low)), ("upper", number(high))]);
    }
    attributes.extend([("effort", number(effort)), ("velocity", number(velocity))]);
    attributes
}

fn write_origin(xml: &mut Xml, pose: &Pose<f64>) {
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    let attributes = [
        ("xyz", vector(&pose.position)),
        ("rpy", numbers([roll, pitch, yaw])),
    ];
    xml.leaf("origin", &attributes);
}

/// A link; one that moves has a made-up mass and a ball at its joint.
fn write_link(xml: &mut Xml, name: &str, moves: bool, size: f64) {
    let (mass, inertia) = match moves {
        true => (0.1, 1e-3 * size * size),
        false => (0.0, 0.0),
    };
    xml.open("link", &[("name", name.to_owned())]);
    xml.open("inertial", &[]);
    write_origin(xml, &Pose::identity());
    xml.leaf("mass", &[("value", number(mass))]);
    let moments = [
        ("ixx", inertia),
        ("ixy", 0.0),
        ("ixz", 0.0),
        ("iyy", inertia),
        ("iyz", 0.0),
        ("izz", inertia),
    ];
    xml.leaf("inertia", &moments.map(|(name, x)| (name, number(x))));
    xml.close("inertial");
    if moves {
        xml.open("visual", &[]);
        write_origin(xml, &Pose::identity());
        xml.open("geometry", &[]);
        xml.leaf("sphere", &[("radius", number(0.02 * size))]);
        xml.close("geometry");
        xml.close("visual");
    }
    xml.close("link");
}
