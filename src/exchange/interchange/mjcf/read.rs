//! MJCF → tree.
//!
//! Bodies, joints, defaults and units are read by mjcf-rs, from a text reduced to bodies, joints and constraints.
//! Sites of constraints and spatial tendons, which it does not support, are read separately.

use std::collections::HashSet;
use std::ops::Range;

use mjcf_rs::Model;
use mjcf_rs::body::{InertiaSpec, Inertial, JointType};
use mjcf_rs::equality::Equality;
use roxmltree::Node;

use super::check::{AXIS, is_irrelevant, look};
use super::constraints;
use super::cranks::slider_cranks;
use super::part::{BodyParts, pose};
use crate::description::{GivenNames, unless};
use crate::geometry::{Pose, Quaternion, Rotation, Vector3};
use crate::interchange::masses::Heavy;
use crate::interchange::problem::{ImportProblem, ImportProblemKind};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{BodyMotion, Tree, TreeBody, TreeJoint};
use crate::interchange::xml_reader::{Problems, child, children, direction, document, parse};
use crate::number::sorting::sort_by_key;

/// Reads the text of an MJCF file without `include`.
pub(crate) fn read(text: &str) -> Result<(Tree, Vec<Remark>), Vec<ImportProblem>> {
    let document = document(text).map_err(|problem| vec![problem])?;
    let root = document.root_element();
    let mut problems = Problems(Vec::new());
    let mut removed: Vec<Range<usize>> = Vec::new();
    let mut seen: HashSet<(&str, String)> = HashSet::new();
    for node in root.descendants().filter(Node::is_element) {
        look(node, &mut problems, &mut seen);
        if is_irrelevant(node) {
            removed.push(node.range());
        }
        // a named outermost class of defaults applies to everything
        let outermost = node.has_tag_name("default") && node.parent().is_some_and(|p| p == root);
        if let Some(class) = node.attribute_node("class").filter(|_| outermost) {
            removed.push(class.range());
        }
    }
    if !problems.0.is_empty() {
        return Err(problems.0);
    }
    let reduced = without(text, removed);
    let model = Model::from_str(&reduced, ".").map_err(|error| {
        let message = error.to_string();
        vec![ImportProblemKind::Reader { message }.anywhere()]
    })?;
    let mut remarks = Vec::new();
    let (mut tree, parts) =
        bodies(&model, root, &mut remarks).map_err(|kind| vec![kind.anywhere()])?;
    constraints::read(root, &model, &mut tree, &parts, &mut problems, &mut remarks);
    unless(problems.0, (tree, remarks))
}

/// The text without some ranges, which may be nested.
fn without(text: &str, mut removed: Vec<Range<usize>>) -> String {
    sort_by_key(&mut removed, |range| range.start);
    let mut kept = String::new();
    let mut at = 0;
    for range in removed {
        if range.start >= at {
            kept += &text[at..range.start];
        }
        at = at.max(range.end);
    }
    kept + &text[at..]
}

/// All bodies, and for each body of the model the corresponding bodies of the tree.
fn bodies(
    model: &Model,
    root: Node,
    remarks: &mut Vec<Remark>,
) -> Result<(Tree, Vec<BodyParts>), ImportProblemKind> {
    let driven = model.actuators.iter().filter_map(|a| a.joint.as_deref());
    let mut driven: HashSet<&str> = driven.collect();
    drive_further(root, &mut driven, remarks);
    let closes = |equality: &Equality| !matches!(equality, Equality::Joint(_));
    let cranked = slider_cranks(root).next().is_some();
    let closed = cranked || model.equality.iter().any(closes);
    if driven.is_empty() && !cranked {
        remarks.push(Remark::Driven(match closed {
            true => "no joint has an actuator: all are passive",
            false => "no joint has an actuator: all are taken as actuated",
        }));
    }
    // no joint that the file names has the name of one that it does not
    let joints = model.bodies.iter().flat_map(|entry| &entry.body.joints);
    let mut names: GivenNames = joints.filter_map(|joint| joint.name.clone()).collect();
    let mut bodies: Vec<TreeBody> = Vec::new();
    let mut parts: Vec<BodyParts> = Vec::new();
    for (index, entry) in model.bodies.iter().enumerate() {
        let name = match (&entry.body.name, index) {
            (_, 0) => "world".to_owned(),
            (Some(name), _) => name.clone(),
            (None, index) => format!("body{index}"),
        };
        let mut own = Vec::new();
        let parent = entry
            .parent
            .and_then(|parent| parts[parent].last().copied());
        let mut part = TreeBody::new(name.clone(), parent, pose(&entry.body.pose));
        for (i, joint) in entry.body.joints.iter().enumerate() {
            let motion = match joint.type_ {
                JointType::Hinge => BodyMotion::Turn,
                JointType::Slide => BodyMotion::Slide,
                JointType::Ball => BodyMotion::Ball,
                JointType::Free => BodyMotion::Free,
            };
            // a ball joint stands alone in its body
            if let Some(before) = part.joints.last()
                && (before.motion.floats() || motion.floats())
            {
                part.name = format!("{name}_{}", before.name);
                own.push(bodies.len());
                let next = TreeBody::new(name.clone(), Some(bodies.len()), Pose::identity());
                bodies.push(std::mem::replace(&mut part, next));
            }
            let joint_name = match (&joint.name, entry.body.joints.len()) {
                (Some(name), _) => name.clone(),
                (None, 1) => names.give(&format!("{name}_joint")),
                (None, _) => names.give(&format!("{name}_joint{}", i + 1)),
            };
            let (automatic, range) = (model.compiler.autolimits, joint.range);
            let limited = joint.limited.resolve(automatic, range.is_some());
            let limits = range.filter(|[low, high]| limited && low < high);
            let axis = match direction(joint.axis) {
                Some(axis) => axis,
                None if motion.floats() => Vector3::unit(2),
                None => {
                    let (joint, example) = (joint_name, AXIS);
                    return Err(ImportProblemKind::NoAxis { joint, example });
                }
            };
            part.joints.push(TreeJoint {
                actuated: driven.contains(joint_name.as_str()) || !closed && driven.is_empty(),
                point: Vector3(joint.pos),
                reference: joint.ref_,
                home: joint.ref_,
                limits: limits.map(|[low, high]| (low, high)),
                ..TreeJoint::new(joint_name, motion, axis)
            });
        }
        let sites = entry.body.sites.iter();
        let sites = sites.filter_map(|site| Some((site.name.clone()?, pose(&site.pose))));
        part.frames.extend(sites);
        if !part.frames.iter().any(|(frame, _)| *frame == name) {
            part.frames.push((name, Pose::identity()));
        }
        part.heavy = entry.body.inertial.as_ref().and_then(heavy);
        own.push(bodies.len());
        bodies.push(part);
        parts.push(own);
    }
    let mut tree = Tree {
        name: root.attribute("model").unwrap_or("mechanism").to_owned(),
        bodies,
        couplings: Vec::new(),
        loops: Vec::new(),
        size: 1.0,
        gravity: Some(gravity(root)),
    };
    home(model, &mut tree, remarks)?;
    Ok((tree, parts))
}

/// The acceleration of free fall: that of the format, unless the file says another.
fn gravity(root: Node) -> [f64; 3] {
    let given = child(root, "option").and_then(|option| option.attribute("gravity"));
    let given = given.and_then(parse).and_then(|of| of.try_into().ok());
    given.unwrap_or([0.0, 0.0, -9.81])
}

/// The mass of a body, unless it has none. Masses that follow from shapes are not read.
fn heavy(of: &Inertial) -> Option<Heavy> {
    let moments = match of.inertia {
        InertiaSpec::Diagonal([x, y, z]) => [x, y, z, 0.0, 0.0, 0.0],
        InertiaSpec::Full(moments) => moments,
    };
    (of.mass > 0.0).then(|| Heavy::at(of.mass, moments, &pose(&of.pose)))
}

/// Joints that actuators drive in other ways: in the axes of their parents, and the first of a tendon along joints.
fn drive_further<'a>(root: Node<'a, '_>, driven: &mut HashSet<&'a str>, remarks: &mut Vec<Remark>) {
    let tendons = children(root, "tendon").into_iter();
    let tendons: Vec<Node> = tendons.flat_map(|block| children(block, "fixed")).collect();
    let actuators = children(root, "actuator").into_iter();
    let actuators = actuators.flat_map(|block| block.children().filter(Node::is_element));
    let (mut along, mut others) = (false, 0);
    let others_than =
        |node: &Node| !node.has_attribute("joint") && !node.has_attribute("cranksite");
    for actuator in actuators.filter(others_than) {
        let tendon = actuator.attribute("tendon");
        let tendon = tendons
            .iter()
            .find(|known| tendon.is_some() && known.attribute("name") == tendon);
        let first = tendon.and_then(|tendon| child(*tendon, "joint")?.attribute("joint"));
        along |= first.is_some();
        match actuator.attribute("jointinparent").or(first) {
            Some(joint) => _ = driven.insert(joint),
            None => others += 1,
        }
    }
    if along {
        remarks.push(Remark::Driven(
            "the first joint of a driven tendon is actuated",
        ));
    }
    if others > 0 {
        let element = "actuator without joint".into();
        remarks.push(Remark::Ignored {
            element,
            count: others,
        });
    }
    let limited = root.descendants().filter(|node| {
        let tendon = node
            .parent()
            .is_some_and(|block| block.has_tag_name("tendon"));
        tendon && node.has_attribute("range") && node.attribute("limited") != Some("false")
    });
    let count = limited.count();
    if count > 0 {
        let element = "range of a tendon".into();
        remarks.push(Remark::Ignored { element, count });
    }
}

/// The home values: those of the keyframe `home`, or of the first one, or the references.
fn home(
    model: &Model,
    tree: &mut Tree,
    remarks: &mut Vec<Remark>,
) -> Result<(), ImportProblemKind> {
    let frames = model.keyframes.iter();
    let frames: Vec<_> = frames.filter(|frame| !frame.qpos.is_empty()).collect();
    let named = frames.iter().find(|f| f.name.as_deref() == Some("home"));
    let keyframe = named.or(frames.first());
    let size = |motion: BodyMotion| match motion {
        BodyMotion::Turn | BodyMotion::Slide => 1,
        BodyMotion::Ball => 4,
        BodyMotion::Free => 7,
    };
    let expected: usize = tree.joints().map(|joint| size(joint.motion)).sum();
    let values = match keyframe {
        None => None,
        Some(keyframe) => {
            let name = keyframe.name.clone().unwrap_or_else(|| "0".into());
            let found = keyframe.qpos.len();
            if found > expected || keyframe.qpos.iter().any(|x| !x.is_finite()) {
                return Err(ImportProblemKind::WrongKeyframe {
                    name,
                    found,
                    expected,
                });
            }
            let rest = match expected - found {
                0 => String::new(),
                rest => format!(
                    "; the last {rest} of {expected} values, which it lacks, are the references"
                ),
            };
            let said = format!("home is the keyframe `{name}`{rest}");
            remarks.push(Remark::Home(said));
            Some(keyframe.qpos.clone())
        }
    };
    let mut poses: Vec<Pose<f64>> = Vec::with_capacity(tree.bodies.len());
    let mut at = 0;
    for body in &mut tree.bodies {
        let parent = body.parent.map_or(Pose::identity(), |parent| poses[parent]);
        let mut pose = parent * body.pose;
        for joint in &mut body.joints {
            let count = size(joint.motion);
            let given = values
                .as_ref()
                .and_then(|values| values.get(at..at + count));
            at += count;
            let turned = |q: &[f64]| {
                let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
                match length > 1e-12 {
                    true => Quaternion([q[0], q[1], q[2], q[3]].map(|x| x / length)).rotation(),
                    false => Rotation::identity(),
                }
            };
            match (joint.motion, given) {
                (BodyMotion::Turn | BodyMotion::Slide, Some(given)) => joint.home = given[0],
                (BodyMotion::Turn | BodyMotion::Slide, None) => {}
                (BodyMotion::Ball, given) => {
                    pose = pose * joint.about_point(given.map_or(Rotation::identity(), turned));
                    body.home = Some(pose);
                }
                (BodyMotion::Free, given) => {
                    if let Some(v) = given {
                        pose = Pose {
                            rotation: turned(&v[3..]),
                            position: Vector3([v[0], v[1], v[2]]),
                        };
                    }
                    body.home = Some(pose);
                }
            }
            pose = pose * joint.displacement(joint.home);
        }
        poses.push(pose);
    }
    Ok(())
}
