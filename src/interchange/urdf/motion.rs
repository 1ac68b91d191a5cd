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
        let home = limits.map_or(0.0, |(low, high)| 0.0_f64.clamp(low, high));
        Joint {
            name,
            motion,
            axis,
            point: Vector3::zero(),
            reference: 0.0,
            home,
            limits,
            actuated,
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
            let least = (0..3).fold(0, |i, j| {
                if axis.0[j].abs() < axis.0[i].abs() {
                    j
                } else {
                    i
                }
            });
            let across = axis.cross(&Vector3::unit(least));
            let x = across.times(1.0 / across.norm());
            vec![
                joint(format!("{}_x", part.name), Motion::Slide, x, false),
                joint(
                    format!("{}_y", part.name),
                    Motion::Slide,
                    axis.cross(&x),
                    false,
                ),
                joint(format!("{}_turn", part.name), Motion::Turn, axis, false),
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
        .flat_map(|transmission| children(*transmission, "joint"));
    let named: HashSet<&str> = named.filter_map(|joint| joint.attribute("name")).collect();
    let follows = |node: &Node| child(*node, "mimic").is_some();
    if joints.iter().any(|(_, name)| named.contains(name.as_str())) {
        remarks.push(Remark::Driven("the joints of transmissions are actuated"));
        return joints
            .iter()
            .map(|(node, name)| named.contains(name.as_str()) && !follows(node))
            .collect();
    }
    let strong = |node: &Node| {
        let effort =
            child(*node, "limit").and_then(|limit| limit.attribute("effort")?.trim().parse().ok());
        effort.map(|effort: f64| effort > 0.0)
    };
    let moves = |node: &Node| node.attribute("type") != Some("fixed");
    let efforts: Vec<Option<bool>> = joints.iter().map(|(node, _)| strong(node)).collect();
    if efforts.contains(&Some(true)) && efforts.contains(&Some(false)) {
        remarks.push(Remark::Driven(
            "joints with an effort of 0, or without effort, are passive",
        ));
        return joints
            .iter()
            .zip(efforts)
            .map(|((node, _), strong)| strong == Some(true) && !follows(node))
            .collect();
    }
    joints
        .iter()
        .map(|(node, _)| moves(node) && !follows(node))
        .collect()
}

/// The problem of an axis of zero length.
pub(super) fn no_axis(joint: String) -> ImportProblemKind {
    let example = "xyz=\"0 0 1\"";
    ImportProblemKind::NoAxis { joint, example }
}
