//! The motion of the joints of a URDF file.

use std::collections::HashSet;

use crate::description::first_free;
use crate::geometry::{Pose, Vector3};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{BodyMotion, TreeJoint};
use crate::interchange::xml_reader::{child, children, least_along};
use roxmltree::Node;

/// The type of a joint.
#[derive(Clone, Copy)]
pub(super) enum JointType {
    /// A motion, and true if limits bound it.
    Moving(BodyMotion, bool),
    /// Two slides across the axis and a turn about it.
    Planar,
    Fixed,
}

/// The types of joints, in the words of the format.
pub(super) const TYPES: [(&str, JointType); 7] = [
    ("revolute", JointType::Moving(BodyMotion::Turn, true)),
    ("continuous", JointType::Moving(BodyMotion::Turn, false)),
    ("prismatic", JointType::Moving(BodyMotion::Slide, true)),
    ("fixed", JointType::Fixed),
    ("floating", JointType::Moving(BodyMotion::Free, false)),
    ("planar", JointType::Planar),
    ("spherical", JointType::Moving(BodyMotion::Ball, false)),
];

/// A joint: the links that it joins, and how the child moves.
pub(super) struct Hanging {
    pub parent: String,
    pub child: String,
    pub kind: JointType,
    pub origin: Pose<f64>,
    /// Unit vector in the child's frame.
    pub axis: Vector3<f64>,
    /// Radians or metres; two zeros or an infinite one are limits that are not given.
    pub limits: (f64, f64),
    /// The joint that is followed, the factor and the offset.
    pub mimic: Option<(String, f64, f64)>,
}

/// The joints of a link, as turns and slides about axes through its own frame.
pub(super) fn moving(
    part: &Hanging,
    name: &str,
    actuated: bool,
    free: &dyn Fn(&str) -> bool,
) -> Vec<TreeJoint> {
    let (axis, limits) = (part.axis, part.limits);
    let finite = limits.0.is_finite() && limits.1.is_finite();
    // two zeros mean absent limits
    let limited = finite && limits.0 <= limits.1 && limits != (0.0, 0.0);
    let joint = |name: String, motion: BodyMotion, axis: Vector3<f64>, limited: bool| {
        let limits = limited.then_some(limits);
        TreeJoint {
            limits,
            actuated,
            ..TreeJoint::new(name, motion, axis)
        }
    };
    match part.kind {
        JointType::Fixed => Vec::new(),
        JointType::Moving(motion, bounded) => {
            vec![joint(name.to_owned(), motion, axis, bounded && limited)]
        }
        JointType::Planar => {
            // in the plane that the axis is normal to
            let across = axis.cross(&Vector3::unit(least_along(&axis)));
            let x = across.times(1.0 / across.norm());
            // no other joint has the name of a part
            let part = |word: &str| first_free(&format!("{name}_{word}"), free);
            vec![
                joint(part("x"), BodyMotion::Slide, x, false),
                joint(part("y"), BodyMotion::Slide, axis.cross(&x), false),
                joint(part("turn"), BodyMotion::Turn, axis, false),
            ]
        }
    }
}

/// Joints that are driven: those of transmissions; where there are none, those that are said to be independent, or
/// those
/// with an effort, or all of a tree and none of a linkage with loops.
pub(super) fn driven(
    robot: Node,
    joints: &[(Node, String)],
    closed: bool,
    remarks: &mut Vec<Remark>,
) -> Vec<bool> {
    let transmissions = children(robot, "transmission");
    let named = transmissions
        .iter()
        .flat_map(|part| children(*part, "joint"));
    let named: HashSet<&str> = named.filter_map(|joint| joint.attribute("name")).collect();
    let follows = |node: &Node| child(*node, "mimic").is_some();
    if joints.iter().any(|(_, name)| named.contains(name.as_str())) {
        remarks.push(Remark::Driven("the joints of transmissions are actuated"));
        let driven =
            |(node, name): &(Node, String)| named.contains(name.as_str()) && !follows(node);
        return joints.iter().map(driven).collect();
    }
    let moves = |node: &Node| node.attribute("type") != Some("fixed");
    // as URDF+ says
    let independent = |node: &Node| node.attribute("independent").map(|word| word == "true");
    if joints.iter().any(|(node, _)| independent(node).is_some()) {
        let rule = "joints that are not independent are passive";
        remarks.push(Remark::Driven(rule));
        let driven = |(node, _): &(Node, String)| {
            independent(node) != Some(false) && moves(node) && !follows(node)
        };
        return joints.iter().map(driven).collect();
    }
    let strong = |node: &Node| {
        let effort =
            child(*node, "limit").and_then(|limit| limit.attribute("effort")?.trim().parse().ok());
        effort.map(|effort: f64| effort > 0.0)
    };
    let efforts: Vec<Option<bool>> = joints.iter().map(|(node, _)| strong(node)).collect();
    if efforts.contains(&Some(true)) && efforts.contains(&Some(false)) {
        let rule = "joints with an effort of 0, or without effort, are passive";
        remarks.push(Remark::Driven(rule));
        let driven = joints.iter().zip(efforts);
        let driven = driven.map(|((node, _), strong)| strong == Some(true) && !follows(node));
        return driven.collect();
    }
    if closed {
        let rule = "no joint has a transmission: all are passive, as loops are closed";
        remarks.push(Remark::Driven(rule));
        return vec![false; joints.len()];
    }
    let driven = joints.iter().map(|(node, _)| moves(node) && !follows(node));
    driven.collect()
}

/// Example of an axis as the format writes it.
pub(super) const AXIS: &str = "xyz=\"0 0 1\"";
