//! URDF → tree.
//!
//! Shapes do not matter here, and whatever is wrong with them does not either. Loops,
//! which URDF does not have, are read in the five ways in which programs have added them; `loops.rs` knows these.
//! Versions of the format differ in two points: from 1.1 on `quat_xyzw` may turn an origin, and from 1.2 on a limit that
//! is left out is none (before, it is 0).

use std::collections::{BTreeMap, HashMap, HashSet};

use roxmltree::Node;

use super::couplings;
use super::loops;
use super::motion::{AXIS, Hanging, JointType, TYPES, driven, moving};
use crate::description::unless;
use crate::geometry::{Pose, Vector3};
use crate::interchange::masses::{Heavy, MOMENTS};
use crate::interchange::problem::{ImportProblem, ImportProblemKind};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{BodyMotion, Coupling, Tree, TreeBody};
use crate::interchange::xml_reader::{
    Problems, child, children, direction, document, turned, version,
};

/// A tree with remarks.
pub(crate) type ReadTree = Result<(Tree, Vec<Remark>), Vec<ImportProblem>>;

/// Reads the text of a URDF file.
pub(crate) fn read(text: &str) -> ReadTree {
    let document = document(text).map_err(|problem| vec![problem])?;
    let robot = document.root_element();
    let mut reader = UrdfReader {
        problems: Problems(Vec::new()),
        remarks: Vec::new(),
        version: version(robot).unwrap_or((1, 0)),
        links: Vec::new(),
        known: HashSet::new(),
        masses: HashMap::new(),
        joints: Vec::new(),
    };
    reader.elements(robot);
    reader.finish(robot)
}

struct UrdfReader<'a, 'i> {
    problems: Problems,
    remarks: Vec<Remark>,
    version: (u32, u32),
    links: Vec<String>,
    known: HashSet<String>,
    masses: HashMap<String, Heavy>,
    joints: Vec<(Node<'a, 'i>, String)>,
}

impl<'a, 'i> UrdfReader<'a, 'i> {
    /// Checks names of links and joints, and reports unknown ones.
    fn elements(&mut self, robot: Node<'a, 'i>) {
        let mut ignored: BTreeMap<String, usize> = BTreeMap::new();
        let mut names = HashSet::new();
        for node in robot.children().filter(Node::is_element) {
            let element = node.tag_name().name();
            match element {
                _ if is_xacro(node) => {
                    let element = format!("xacro:{element}");
                    self.problems
                        .say(ImportProblemKind::Macro { element }, node);
                }
                "link" | "joint" => {
                    let noun = if element == "link" { "link" } else { "joint" };
                    let Some(name) = self.problems.needed(node, "name") else {
                        continue;
                    };
                    let (new, name) = (names.insert((noun, name)), name.to_owned());
                    match noun {
                        "link" => {
                            self.links.push(name.clone());
                            let before = self.problems.0.len();
                            let heavy = self.heavy(node);
                            let heavy = match self.problems.forget_after(before) {
                                true => Some(Heavy::UNREADABLE),
                                false => heavy,
                            };
                            self.masses.extend(heavy.map(|heavy| (name.clone(), heavy)));
                        }
                        _ => self.joints.push((node, name.clone())),
                    }
                    if !new {
                        self.problems.duplicate(noun, &name, node);
                    }
                    let shapes = node.descendants().filter(|part| part.has_tag_name("mesh"));
                    *ignored.entry("mesh".into()).or_default() += shapes.count();
                }
                "material" | "transmission" => {}
                _ if loops::is_loop(node) || couplings::is_coupling(node) => {}
                "gazebo" => {}
                _ => *ignored.entry(element.to_owned()).or_default() += 1,
            }
        }
        ignored.retain(|_, count| *count > 0);
        for (element, count) in ignored {
            self.remarks.push(Remark::Ignored { element, count });
        }
    }

    fn finish(mut self, robot: Node<'a, 'i>) -> ReadTree {
        let joints: Vec<(Node, String)> = std::mem::take(&mut self.joints);
        // programs that know the world do not need it as a link
        let stands = |(node, _): &(Node, String)| {
            child(*node, "parent").and_then(|part| part.attribute("link")) == Some("world")
        };
        if joints.iter().any(stands) && !self.links.iter().any(|link| link == "world") {
            self.links.push("world".into());
        }
        self.known = self.links.iter().cloned().collect();
        let hangs: Vec<Option<Hanging>> = joints
            .iter()
            .map(|(node, name)| self.hanging(*node, name))
            .collect();
        let order = self.order(&joints, &hangs);
        if !self.problems.0.is_empty() {
            return Err(self.problems.0);
        }
        let hangs: Vec<Hanging> = hangs.into_iter().flatten().collect();
        let closed = robot
            .children()
            .any(|node| node.is_element() && loops::is_loop(node));
        let driven = driven(robot, &joints, closed, &mut self.remarks);
        let children = hangs.iter().enumerate();
        let joint_of: HashMap<&str, usize> = children.map(|(i, h)| (h.child.as_str(), i)).collect();
        let mut bodies: Vec<TreeBody> = Vec::new();
        let mut couplings = Vec::new();
        let links = order.iter().enumerate();
        let index: HashMap<&str, usize> = links.map(|(i, link)| (link.as_str(), i)).collect();
        for link in &order {
            let mut body = TreeBody::new(link.clone(), None, Pose::identity());
            body.frames.push((link.clone(), Pose::identity()));
            body.heavy = self.masses.get(link).copied();
            if let Some(&i) = joint_of.get(link.as_str()) {
                let (part, name) = (&hangs[i], &joints[i].1);
                body.parent = index.get(part.parent.as_str()).copied();
                body.pose = part.origin;
                let free = |name: &str| joints.iter().all(|(_, joint)| joint != name);
                body.joints = moving(part, name, driven[i], &free);
                if let Some((leader, factor, offset)) = &part.mimic {
                    let leader = leader.clone();
                    couplings.push(Coupling::of(name.clone(), leader, *factor, *offset));
                }
            }
            bodies.push(body);
        }
        let mut tree = Tree {
            name: robot.attribute("name").unwrap_or("robot").to_owned(),
            bodies,
            couplings,
            loops: Vec::new(),
            size: 1.0,
            gravity: None,
        };
        let poses = tree.poses(|joint| joint.reference);
        for (body, pose) in tree.bodies.iter_mut().zip(poses) {
            body.home = body.floats().then_some(pose);
        }
        (tree.couplings).extend(couplings::read(robot, &tree, &mut self.problems));
        tree.loops = loops::read(robot, &tree, &mut self.problems, &mut self.remarks);
        unless(self.problems.0, (tree, self.remarks))
    }

    /// The mass of a link, unless it has none.
    fn heavy(&mut self, link: Node) -> Option<Heavy> {
        let inertial = child(link, "inertial")?;
        let mass = self.problems.number(child(inertial, "mass")?, "value")?;
        let pose = child(inertial, "origin").map(|origin| self.origin(origin));
        let inertia = child(inertial, "inertia");
        let moments = MOMENTS.map(|name| {
            inertia
                .and_then(|of| self.problems.number(of, name))
                .unwrap_or(0.0)
        });
        let heavy = Heavy::at(mass, moments, &pose.unwrap_or(Pose::identity()));
        (mass > 0.0 || moments != [0.0; 6]).then_some(heavy)
    }

    /// The origin of a joint, turned by `rpy` or `quat_xyzw`.
    fn origin(&mut self, node: Node) -> Pose<f64> {
        let mut pose = self.problems.origin(node);
        if self.version < (1, 1) {
            return pose;
        }
        if let Some([x, y, z, w]) = self.problems.numbers::<4>(node, "quat_xyzw") {
            if node.has_attribute("rpy") {
                let what = "an origin with both `rpy` and `quat_xyzw`";
                (self.problems).unsupported::<()>(what, "leave one of them out", node);
            }
            match direction([x, y, z]).is_some() || w != 0.0 {
                true => pose.rotation = turned([w, x, y, z]),
                false => {
                    let text = node.attribute("quat_xyzw").unwrap_or_default().to_owned();
                    self.problems
                        .say(ImportProblemKind::NoOrientation { text }, node);
                }
            }
        }
        pose
    }

    /// The two links of a joint, its pose and its motion.
    fn hanging(&mut self, node: Node, name: &str) -> Option<Hanging> {
        let kind = self.problems.word(node, "type", &TYPES);
        let mut origin = None;
        for part in children(node, "origin") {
            let pose = self.origin(part);
            origin.get_or_insert(pose);
        }
        let mut along = Vector3::unit(0);
        if let Some(axis) = child(node, "axis")
            && let Some(given) = self.problems.numbers::<3>(axis, "xyz")
        {
            let unit = match kind {
                Some(
                    JointType::Planar | JointType::Moving(BodyMotion::Turn | BodyMotion::Slide, _),
                ) => self.problems.axis(given, name, AXIS, axis),
                _ => direction(given),
            };
            along = unit.unwrap_or(along);
        }
        let absent = match self.version < (1, 2) {
            true => (0.0, 0.0),
            false => (f64::NEG_INFINITY, f64::INFINITY),
        };
        let mut limits = None;
        for part in children(node, "limit") {
            let [low, high] = ["lower", "upper"].map(|name| self.problems.number(part, name));
            if let (Some(low), Some(high)) = (low, high)
                && low > high
            {
                let what = format!("limits from {low} to {high}, the lower above the upper");
                self.problems.unsupported::<()>(what, "exchange them", part);
            }
            limits.get_or_insert((low.unwrap_or(absent.0), high.unwrap_or(absent.1)));
        }
        let mut mimic = None;
        if let Some(part) = child(node, "mimic") {
            let [factor] = self.problems.numbers(part, "multiplier").unwrap_or([1.0]);
            let [offset] = self.problems.numbers(part, "offset").unwrap_or([0.0]);
            let leader = self.problems.needed(part, "joint");
            mimic = leader.map(|leader| (leader.to_owned(), factor, offset));
        }
        let ends = ["parent", "child"].map(|end| {
            let part = self.problems.needed_child(node, end)?;
            let link = self.problems.needed(part, "link")?;
            let found = self.known.get(link);
            let links = self.links.iter().map(String::as_str);
            let found = (self.problems).known(found, (part, "link"), ("link", link), links);
            found.cloned()
        });
        let [parent, child] = ends;
        Some(Hanging {
            parent: parent?,
            child: child?,
            kind: kind?,
            origin: origin.unwrap_or(Pose::identity()),
            axis: along,
            limits: limits.unwrap_or((0.0, 0.0)),
            mimic,
        })
    }

    /// The links, each after its parent.
    fn order(&mut self, joints: &[(Node, String)], hangs: &[Option<Hanging>]) -> Vec<String> {
        let mut parent_of: HashMap<&str, (usize, &str)> = HashMap::new();
        let mut below: HashMap<&str, Vec<&str>> = HashMap::new();
        for (i, hanging) in hangs.iter().enumerate() {
            let Some(Hanging { parent, child, .. }) = hanging else {
                continue;
            };
            if let Some((other, _)) = parent_of.get(child.as_str()) {
                let problem = ImportProblemKind::TwoParents {
                    link: child.clone(),
                    joints: [*other, i].map(|i| joints[i].1.clone()),
                };
                self.problems.say(problem, joints[i].0);
                continue;
            }
            parent_of.insert(child, (i, parent));
            below.entry(parent).or_default().push(child);
        }
        let named: HashSet<&str> = joints.iter().map(|(_, name)| name.as_str()).collect();
        for (node, name) in joints {
            let mimic = child(*node, "mimic");
            let Some((mimic, leader)) = mimic.and_then(|m| Some((m, m.attribute("joint")?))) else {
                continue;
            };
            let known = joints.iter().map(|(_, name)| name.as_str());
            (self.problems).known(
                named.get(leader),
                (mimic, "joint"),
                ("joint", leader),
                known,
            );
            if leader == name {
                let problem = ImportProblemKind::FollowsItself {
                    joint: name.clone(),
                };
                self.problems.say(problem, mimic);
            }
        }
        // the missing joints may be those that could not be read
        if !self.problems.0.is_empty() {
            return Vec::new();
        }
        let links = self.links.iter().map(String::as_str);
        let roots: Vec<&str> = links.filter(|link| !parent_of.contains_key(link)).collect();
        if roots.len() != 1 {
            let links = |links: &[&str]| links.iter().map(|link| (*link).to_owned()).collect();
            let problem = match roots.as_slice() {
                [] if self.links.is_empty() => ImportProblemKind::NothingMoves,
                [] => ImportProblemKind::NoRoot {
                    links: self.links.clone(),
                },
                roots => ImportProblemKind::SeveralRoots {
                    links: links(roots),
                },
            };
            self.problems.0.push(problem.anywhere());
            return Vec::new();
        }
        let mut order = Vec::new();
        let mut next = roots;
        while let Some(link) = next.pop() {
            order.push(link.to_owned());
            next.extend(below.get(link).into_iter().flatten().rev());
        }
        if order.len() < self.links.len() {
            let reached: HashSet<&String> = order.iter().collect();
            let links = self.links.iter().filter(|link| !reached.contains(link));
            let links = links.cloned().collect();
            self.problems
                .0
                .push(ImportProblemKind::Cycle { links }.anywhere());
        }
        order
    }
}

fn is_xacro(node: Node) -> bool {
    let namespace = node.tag_name().namespace();
    namespace.is_some_and(|uri| uri.contains("xacro"))
}
