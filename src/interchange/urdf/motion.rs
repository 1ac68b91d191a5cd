//! The motion of the joints of a URDF file.

use std::collections::HashSet;

use roxmltree::Node;

use crate::geometry::Vector3;
use crate::interchange::page::{child, children};
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Joint, Motion};
use crate::interchange::xml::Xml;

/// The unit vector along three numbers, if they give a direction.
pub(crate) fn direction([x, y, z]: [f64; 3]) -> Option<Vector3<f64>> {
    let v = Vector3([x, y, z]);
    let largest = x.abs().max(y.abs()).max(z.abs());
    if !largest.is_finite() || largest < 1e-12 {
        return None;
    }
    let scaled = v.times(1.0 / largest);
    Some(scaled.times(1.0 / scaled.norm()))
}

/// The coordinate axis most across a direction.
pub(super) fn least_along(axis: &Vector3<f64>) -> usize {
    let size = |i: usize| axis.0[i].abs();
    (0..3).fold(0, |i, j| if size(j) < size(i) { j } else { i })
}

/// The same robot without shapes, masses, extensions.
pub(super) fn reduced(robot: Node, links: &[String], joints: &[(Node, String)]) -> String {
    let mut xml = Xml::new();
    let kept = |node: Node, names: &[&'static str]| -> Vec<(&'static str, String)> {
        let given = names
            .iter()
            .filter_map(|name| Some((*name, node.attribute(*name)?.to_owned())));
        given.collect()
    };
    xml.open("robot", &kept(robot, &["name", "version"]));
    for link in links {
        xml.leaf("link", &[("name", link.clone())]);
    }
    for (joint, _) in joints {
        xml.open("joint", &kept(*joint, &["name", "type"]));
        for (element, attributes) in [
            ("origin", &["xyz", "rpy", "quat_xyzw"][..]),
            ("parent", &["link"]),
            ("child", &["link"]),
            ("axis", &["xyz"]),
            ("mimic", &["joint", "multiplier", "offset"]),
        ] {
            if let Some(part) = child(*joint, element) {
                let attributes = kept(part, attributes);
                // an absent axis is the default one
                if element != "axis" || !attributes.is_empty() {
                    xml.leaf(element, &attributes);
                }
            }
        }
        if let Some(limit) = child(*joint, "limit") {
            let mut attributes = kept(limit, &["lower", "upper"]);
            attributes.push(("velocity", "0".into()));
            xml.leaf("limit", &attributes);
        }
        xml.close("joint");
    }
    xml.close("robot");
    xml.text()
}

/// The joints of a link, as turns and slides about axes through its own frame.
pub(super) fn moving(part: &urdf_rs::Joint, actuated: bool) -> Vec<Joint> {
    use urdf_rs::JointType;
    let axis = direction(part.axis.xyz.0).unwrap_or(Vector3::unit(0));
    let limits = (part.limit.lower, part.limit.upper);
    let finite = limits.0.is_finite() && limits.1.is_finite();
    // two zeros mean absent limits
    let limited = finite && limits.0 <= limits.1 && limits != (0.0, 0.0);
    let joint = |name: String, motion: Motion, axis: Vector3<f64>, limited: bool| {
        let limits = limited.then_some(limits);
        Joint {
            home: limits.map_or(0.0, |(low, high)| 0.0_f64.clamp(low, high)),
            limits,
            actuated,
            ..Joint::new(name, motion, axis)
        }
    };
    let name = || part.name.clone();
    match part.joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Revolute => vec![joint(name(), Motion::Turn, axis, limited)],
        JointType::Continuous => vec![joint(name(), Motion::Turn, axis, false)],
        JointType::Prismatic => vec![joint(name(), Motion::Slide, axis, limited)],
        JointType::Floating => vec![joint(name(), Motion::Free, axis, false)],
        JointType::Spherical => vec![joint(name(), Motion::Ball, axis, false)],
        JointType::Planar => {
            // in the plane that the axis is normal to
            let across = axis.cross(&Vector3::unit(least_along(&axis)));
            let x = across.times(1.0 / across.norm());
            let name = |suffix: &str| format!("{}_{suffix}", part.name);
            vec![
                joint(name("x"), Motion::Slide, x, false),
                joint(name("y"), Motion::Slide, axis.cross(&x), false),
                joint(name("turn"), Motion::Turn, axis, false),
            ]
        }
    }
}

/// Which joints are driven: those of transmissions; where there are none, those with an effort, or all.
pub(super) fn driven(
    robot: Node,
    joints: &[(Node, String)],
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
    let strong = |node: &Node| {
        let effort =
            child(*node, "limit").and_then(|limit| limit.attribute("effort")?.trim().parse().ok());
        effort.map(|effort: f64| effort > 0.0)
    };
    let moves = |node: &Node| node.attribute("type") != Some("fixed");
    let efforts: Vec<Option<bool>> = joints.iter().map(|(node, _)| strong(node)).collect();
    if efforts.contains(&Some(true)) && efforts.contains(&Some(false)) {
        let rule = "joints with an effort of 0, or without effort, are passive";
        remarks.push(Remark::Driven(rule));
        let driven = joints.iter().zip(efforts);
        let driven = driven.map(|((node, _), strong)| strong == Some(true) && !follows(node));
        return driven.collect();
    }
    let driven = joints.iter().map(|(node, _)| moves(node) && !follows(node));
    driven.collect()
}

/// The problem of an axis of zero length.
pub(super) fn no_axis(joint: String) -> ImportProblemKind {
    let example = "xyz=\"0 0 1\"";
    ImportProblemKind::NoAxis { joint, example }
}
