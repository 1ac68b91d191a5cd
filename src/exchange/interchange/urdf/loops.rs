//! The ways in which programs have added loops to URDF.
//!
//! | element | known to |
//! |---|---|
//! | `loop_joint` with `link1`, `link2`, or `parent`, `child` and their origins | NVIDIA Isaac Sim, exporters |
//! | `constraint` with `parent`, `parent_origin`, `child`, `child_origin`, axes | ros/urdfdom pull request 264 |
//! | `loop` with `predecessor`, `successor` | URDF+, Chignoli et al. 2024, arXiv:2411.19753 |
//! | `drake:ball_constraint` | Drake |
//! | `joint` in `gazebo`, as in SDFormat | Gazebo's tutorial of kinematic loops |

use std::collections::HashMap;

use roxmltree::Node;

use super::motion::AXIS;
use crate::description::{ClosureKind, GivenNames};
use crate::geometry::{Pose, Vector3};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Tree, TreeLoop};
use crate::interchange::xml_reader::{Problems, along_z, child, children, pose_of, tag};

/// The types of joints that can close a loop, in the words of the formats.
const TYPES: [(&str, ClosureKind); 10] = [
    ("revolute", ClosureKind::Revolute),
    ("continuous", ClosureKind::Revolute),
    ("hinge", ClosureKind::Revolute),
    ("spherical", ClosureKind::Spherical),
    ("ball", ClosureKind::Spherical),
    ("fixed", ClosureKind::Rigid),
    ("prismatic", ClosureKind::Prismatic),
    ("universal", ClosureKind::Universal),
    ("cylindrical", ClosureKind::Cylindrical),
    ("planar", ClosureKind::Planar),
];

/// True if an element of a robot is a loop.
pub(super) fn is_loop(node: Node) -> bool {
    match node.tag_name().name() {
        "loop_joint" | "loop" | "ball_constraint" => true,
        "constraint" => child(node, "parent").is_some(),
        "gazebo" => child(node, "joint").is_some(),
        _ => false,
    }
}

/// The loops of a robot.
pub(super) fn read(
    robot: Node,
    tree: &Tree,
    problems: &mut Problems,
    remarks: &mut Vec<Remark>,
) -> Vec<TreeLoop> {
    let links = tree.bodies.iter().enumerate();
    let mut reader = LoopReader {
        tree,
        bodies: links.map(|(i, body)| (body.name.as_str(), i)).collect(),
        problems,
        names: GivenNames::default(),
        loops: Vec::new(),
    };
    let elements = robot.children().filter(|node| node.is_element());
    for node in elements.filter(|node| is_loop(*node)) {
        let joints = match node.tag_name().name() {
            "gazebo" => children(node, "joint"),
            _ => vec![node],
        };
        for node in joints {
            let found = match node.tag_name().name() {
                "ball_constraint" => reader.ball(node),
                "joint" => reader.gazebo(node),
                _ => reader.joined(node),
            };
            if let Some((kind, ends)) = found {
                reader.close(node, kind, ends);
            }
        }
    }
    let loops = reader.loops;
    if loops.is_empty() {
        let halves = |link: &str| {
            let name = link.strip_suffix("_1")?;
            let other = format!("{name}_2");
            let known = reader.bodies.contains_key(other.as_str());
            let found = name.starts_with("closing_") && known;
            found.then_some(other)
        };
        for body in &tree.bodies {
            if let Some(other) = halves(&body.name) {
                remarks.push(Remark::Halves([body.name.clone(), other]));
            }
        }
    }
    loops
}

/// A kind of joint and the frames that it joins, by their bodies.
type LoopClosing = (ClosureKind, [(usize, Pose<f64>); 2]);

struct LoopReader<'a> {
    tree: &'a Tree,
    /// The body of each link.
    bodies: HashMap<&'a str, usize>,
    problems: &'a mut Problems,
    names: GivenNames,
    loops: Vec<TreeLoop>,
}

impl LoopReader<'_> {
    /// The link of that name.
    fn link(&mut self, node: Node, attribute: &str, name: &str) -> Option<usize> {
        let links = self.tree.bodies.iter().map(|body| body.name.as_str());
        let found = self.bodies.get(name).copied();
        (self.problems).known(found, (node, attribute), ("link", name), links)
    }

    /// The link in whose frame something is given: that of the name in an attribute, which may be a joint, whose frame is that
    /// of its child, or `__model__`, the root; `own` if there is none.
    fn frame(&mut self, node: Node, attribute: &str, own: usize) -> Option<usize> {
        let mut bodies = self.tree.bodies.iter();
        match node.attribute(attribute).map_or("", str::trim) {
            "" => Some(own),
            "__model__" => Some(0),
            name => {
                let moved = bodies.position(|body| body.joints.iter().any(|j| j.name == name));
                match self.bodies.get(name).copied().or(moved) {
                    Some(found) => Some(found),
                    None => self.link(node, attribute, name),
                }
            }
        }
    }

    fn close(&mut self, node: Node, kind: ClosureKind, ends: [(usize, Pose<f64>); 2]) {
        let own = node.attribute("name").map(str::to_owned);
        let name = own.unwrap_or_else(|| format!("loop{}", self.loops.len() + 1));
        let name = self.names.give_longer(name);
        let sides = TreeLoop::sides(&name, ends);
        self.loops.push(TreeLoop::new(name, kind, sides));
    }

    /// `loop_joint`, `constraint`, `loop`: two links, a frame on each, a type, and axes in the frames.
    fn joined(&mut self, node: Node) -> Option<LoopClosing> {
        let kind = self.problems.word(node, "type", &TYPES)?;
        // the documentation of Isaac Sim writes `link1` for both
        let mut ends = [children(node, "link1"), children(node, "link2")].concat();
        for pair in [["parent", "child"], ["predecessor", "successor"]] {
            ends.extend(pair.iter().filter_map(|name| child(node, name)));
        }
        let [first, second] = ends[..] else {
            let needs = "two links, such as elements `link1` and `link2`";
            self.problems.missing(node, needs.into());
            return None;
        };
        let mut axes = match kind {
            ClosureKind::Universal => [Vector3::unit(0), Vector3::unit(1)],
            _ => [Vector3::unit(0); 2],
        };
        let mut sides = Vec::new();
        for (side, end) in [first, second].into_iter().enumerate() {
            let name = end.tag_name().name();
            let link = self.problems.needed(end, "link")?;
            let body = self.link(end, "link", link)?;
            let origin = child(node, &format!("{name}_origin")).or(child(end, "origin"));
            let pose = self.problems.origin(origin.unwrap_or(end));
            let axis = child(node, &format!("{name}_axis")).or(child(node, "axis"));
            let has_axis = !matches!(kind, ClosureKind::Spherical | ClosureKind::Rigid);
            if axis.is_none() && has_axis && node.has_tag_name("loop_joint") {
                self.problems.missing(node, "element `axis`".into());
                return None;
            }
            if let Some(axis) = axis
                && let Some(along) = self.problems.numbers(axis, "xyz")
            {
                let joint = node.attribute("name").unwrap_or("loop");
                axes[side] = self.problems.axis(along, joint, AXIS, axis)?;
            }
            sides.push((body, pose));
        }
        let sides = [0, 1].map(|side| {
            let (body, pose) = sides[side];
            match kind {
                ClosureKind::Spherical | ClosureKind::Rigid => (body, pose),
                _ => (body, pose * along_z(&axes[side])),
            }
        });
        Some((kind, sides))
    }

    /// Points P on body A and Q on body B coincide.
    fn ball(&mut self, node: Node) -> Option<LoopClosing> {
        let mut sides = Vec::new();
        for (body, point) in [("body_A", "p_AP"), ("body_B", "p_BQ")] {
            let [body, point] = [body, point].map(|name| format!("ball_constraint_{name}"));
            let end = self.problems.needed_child(node, &body)?;
            let name = self.problems.needed(end, "name")?;
            let body = self.link(end, "name", name)?;
            let place = child(node, &point).and_then(|point| self.problems.numbers(point, "value"));
            sides.push((body, pose_of(place.unwrap_or_default(), [0.0; 3])));
        }
        Some((ClosureKind::Spherical, <[_; 2]>::try_from(sides).ok()?))
    }

    /// A joint of SDFormat: its frame is given in the child, and where that is at zero it is on the parent too.
    fn gazebo(&mut self, node: Node) -> Option<LoopClosing> {
        let kind = self.problems.word(node, "type", &TYPES)?;
        let mut bodies = Vec::new();
        for end in ["parent", "child"] {
            let part = self.problems.needed_child(node, end)?;
            let link = part.attribute("link").or(part.text()).unwrap_or_default();
            let body = self.link(part, "link", link.trim())?;
            bodies.push(body);
        }
        let [parent, child_body] = <[usize; 2]>::try_from(bodies).ok()?;
        let numbers = |problems: &mut Problems, part: Node, count: usize| {
            problems.parsed(part.text().unwrap_or_default(), count, tag(part))
        };
        let poses = self.tree.poses(|joint| joint.reference);
        let mut pose = Pose::identity();
        if let Some(part) = child(node, "pose") {
            let v = numbers(self.problems, part, 6)?;
            pose = pose_of([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
            let seen_from = self.frame(part, "relative_to", child_body)?;
            pose = poses[child_body].inverse() * poses[seen_from] * pose;
        }
        // a universal joint has a second axis, which the child carries
        let names = match kind {
            ClosureKind::Universal => ["axis", "axis2"],
            _ => ["axis"; 2],
        };
        let mut axes = [Vector3::unit(2); 2];
        for (axis, name) in axes.iter_mut().zip(names) {
            if let Some(part) = child(node, name).and_then(|axis| child(axis, "xyz")) {
                let v = numbers(self.problems, part, 3)?;
                let joint = node.attribute("name").unwrap_or("joint");
                let (along, example) = ([v[0], v[1], v[2]], "<xyz>0 0 1</xyz>");
                let along = self.problems.axis(along, joint, example, part)?;
                // in the frame of the joint, or in that of a link
                *axis = match part.attribute("expressed_in").unwrap_or_default() {
                    "" => along,
                    _ => {
                        let seen_from = poses[self.frame(part, "expressed_in", child_body)?];
                        let turned = (poses[child_body] * pose).inverse() * seen_from;
                        turned.rotation * along
                    }
                };
            } else if name == "axis2" {
                let needs = "a second axis, an element `axis2`".to_owned();
                self.problems.missing(node, needs);
                return None;
            }
        }
        let [on_parent, on_child] = axes.map(|axis| pose * along_z(&axis));
        let on_parent = poses[parent].inverse() * poses[child_body] * on_parent;
        let ends = [(parent, on_parent), (child_body, on_child)];
        Some((kind, ends))
    }
}
