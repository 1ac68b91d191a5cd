//! Tree → SDF.
//!
//! Joints of SDF are at 0 where the links are as they are written. A loop is closed there, so what is written is the assembled
//! configuration, from which values and limits are counted. A body with several joints becomes as many links. A rod becomes a
//! link with a universal and a ball joint, and one whose length changes two, with a slide between them.

use crate::description::ClosureKind;
use crate::geometry::{Pose, Quaternion, Vector3};
use crate::interchange::masses::{Heavy, MOMENTS};
use crate::interchange::mjcf::with_sliders;
use crate::interchange::remark::Remark;
use crate::interchange::tree::{
    Attachment, BodyMotion, Coupling, Tree, TreeBody, TreeJoint, TreeLoop,
};
use crate::interchange::xml_reader::along_z;
use crate::interchange::xml_writer::{Xml, numbers, vector};

/// The plugin that drives a joint in Gazebo: the file and the name of the plugin.
const CONTROLLER: [&dyn std::fmt::Display; 2] = [
    &"gz-sim-joint-position-controller-system",
    &"gz::sim::systems::JointPositionController",
];

/// The text of an SDF file, with remarks on its differences from the mechanism.
pub fn write(tree: &Tree, known: &[Remark]) -> (String, Vec<Remark>) {
    let (mut tree, mut remarks) = with_sliders(tree);
    rods(&mut tree);
    remarks.extend(tree.bent());
    remarks.push(Remark::CountedFromHome);
    if !tree.is_heavy() {
        remarks.push(Remark::MassesInvented);
    }
    let home = tree.home();
    let mut xml = Xml::default();
    xml.open("sdf version", &[&"1.9"]);
    xml.open("model name", &[&tree.name]);
    for remark in known.iter().chain(&remarks) {
        xml.comment(&remark.to_string());
    }
    let mut joints = Xml::default();
    for (i, body) in tree.bodies.iter().enumerate().skip(1) {
        link(&mut xml, &body.name, &home[i], body.heavy.as_ref());
        let Some(parent) = body.parent else { continue };
        let mut from = link_name(&tree, parent);
        if body.joints.is_empty() {
            joint(
                &mut joints,
                &format!("{} fixed", body.name),
                "fixed",
                [&from, &body.name],
                &Pose::identity(),
            );
            joints.close("joint");
        }
        let mut at = home[parent] * body.pose;
        for (k, moving) in body.joints.iter().enumerate() {
            let last = k + 1 == body.joints.len();
            at = at * moving.displacement(moving.home);
            let to = match last {
                true => body.name.clone(),
                false => format!("{}.{}", body.name, k + 1),
            };
            if !last {
                link(&mut xml, &to, &at, None);
            }
            moves(&mut joints, &tree, moving, [&from, &to]);
            from = to;
        }
    }
    for closing in &tree.loops {
        closes(&mut joints, &tree, closing);
    }
    xml.append(joints);
    for driven in tree.joints().filter(|joint| joint.actuated) {
        xml.open("plugin filename name", &CONTROLLER);
        xml.leaf_text("joint_name", &[], &driven.name);
        xml.close("plugin");
    }
    xml.close("model");
    xml.close("sdf");
    (xml.text(), remarks)
}

fn link_name(tree: &Tree, body: usize) -> String {
    match body {
        0 => "world".into(),
        body => tree.bodies[body].name.clone(),
    }
}

fn link(xml: &mut Xml, name: &str, at: &Pose<f64>, heavy: Option<&Heavy>) {
    xml.open("link name", &[&name]);
    pose(xml, at);
    if let Some(heavy) = heavy {
        xml.open("inertial", &[]);
        pose(xml, &Pose::translation(heavy.centre));
        xml.leaf_text("mass", &[], &numbers([heavy.mass]));
        xml.open("inertia", &[]);
        for (name, moment) in MOMENTS.iter().zip(heavy.moments()) {
            xml.leaf_text(name, &[], &numbers([moment]));
        }
        xml.close("inertia");
        xml.close("inertial");
    }
    xml.close("link");
}

/// A pose as roll, pitch and yaw would lose its digits: as a quaternion.
fn pose(xml: &mut Xml, at: &Pose<f64>) {
    let [w, x, y, z] = Quaternion::from_rotation(&at.rotation).canonical().0;
    let values = numbers(at.position.0.into_iter().chain([x, y, z, w]));
    xml.leaf_text("pose rotation_format", &[&"quat_xyzw"], &values);
}

/// Opens a joint.
fn joint(xml: &mut Xml, name: &str, kind: &str, [parent, child]: [&str; 2], at: &Pose<f64>) {
    xml.open("joint name type", &[&name, &kind]);
    pose(xml, at);
    xml.leaf_text("parent", &[], parent);
    xml.leaf_text("child", &[], child);
}

fn moves(xml: &mut Xml, tree: &Tree, of: &TreeJoint, links: [&str; 2]) {
    let kind = match of.motion {
        BodyMotion::Turn => "revolute",
        BodyMotion::Slide => "prismatic",
        BodyMotion::Ball => "ball",
        // nothing joins it but loops
        BodyMotion::Free => return,
    };
    joint(xml, &of.name, kind, links, &Pose::translation(of.point));
    if !of.motion.floats() {
        xml.open("axis", &[]);
        xml.leaf_text("xyz", &[], &vector(&of.axis));
        if let Some((low, high)) = of.limits {
            xml.open("limit", &[]);
            xml.leaf_text("lower", &[], &numbers([low - of.home]));
            xml.leaf_text("upper", &[], &numbers([high - of.home]));
            xml.close("limit");
        }
        let mut couplings = tree.couplings.iter().filter_map(Coupling::pair);
        if let Some((_, leader, factor, _)) = couplings.find(|(joint, ..)| *joint == of.name) {
            xml.open("mimic joint axis", &[&leader, &"axis"]);
            xml.leaf_text("multiplier", &[], &numbers([factor]));
            xml.leaf_text("offset", &[], "0");
            xml.leaf_text("reference", &[], "0");
            xml.close("mimic");
        }
        xml.close("axis");
    }
    xml.close("joint");
}

fn closes(xml: &mut Xml, tree: &Tree, of: &TreeLoop) {
    let kind = match of.kind {
        ClosureKind::Revolute => "revolute",
        ClosureKind::Spherical => "ball",
        ClosureKind::Universal => "universal",
        // sliders and rods have replaced the others
        _ => "fixed",
    };
    let [parent, child] = &of.sides;
    let links = [parent, child].map(|side| link_name(tree, side.body));
    let name = format!("{} closure", of.name);
    joint(xml, &name, kind, [&links[0], &links[1]], &child.pose);
    let z = vector(&Vector3::unit(2));
    match of.kind {
        ClosureKind::Revolute => {
            xml.open("axis", &[]);
            xml.leaf_text("xyz", &[], &z);
            xml.close("axis");
        }
        ClosureKind::Universal => {
            let seen_from = if parent.body == 0 {
                "__model__"
            } else {
                links[0].as_str()
            };
            xml.open("axis", &[]);
            let along = vector(&parent.pose.rotation.0[2]);
            xml.leaf_text("xyz expressed_in", &[&seen_from], &along);
            xml.close("axis");
            xml.open("axis2", &[]);
            xml.leaf_text("xyz", &[], &z);
            xml.close("axis2");
        }
        _ => {}
    }
    xml.close("joint");
}

/// Distances as links with a universal joint at one end and a ball at the other.
fn rods(tree: &mut Tree) {
    let home = tree.home();
    for i in 0..tree.loops.len() {
        let TreeLoop {
            name,
            kind,
            sides,
            length,
        } = tree.loops[i].clone();
        if kind != ClosureKind::Distance {
            continue;
        }
        let [a, b] = sides;
        let [p, q] = [&a, &b].map(|side| (home[side.body] * side.pose).position);
        let way = q - p;
        let far = way.norm();
        let along = if far > 0.0 {
            way.times(1.0 / far)
        } else {
            Vector3::unit(2)
        };
        let turned = along_z(&along);
        let at = Pose::translation(p) * turned;
        let turn = |word: &str, axis: usize| {
            let name = format!("{name}.{word}");
            TreeJoint::new(name, BodyMotion::Turn, Vector3::unit(axis))
        };
        let mut end = tree.bodies.len();
        tree.bodies.push(TreeBody {
            joints: vec![turn("x", 0), turn("y", 1)],
            ..TreeBody::new(
                format!("{name}.rod"),
                Some(a.body),
                home[a.body].inverse() * at,
            )
        });
        if let Some((leader, factor)) = length.as_ref().and_then(|of| of.terms.first()) {
            let slide =
                TreeJoint::new(format!("{name}.slide"), BodyMotion::Slide, Vector3::unit(2));
            tree.couplings.push(Coupling::of(
                slide.name.clone(),
                leader.clone(),
                *factor,
                0.0,
            ));
            tree.bodies.push(TreeBody {
                joints: vec![slide],
                ..TreeBody::new(format!("{name}.tube"), Some(end), Pose::identity())
            });
            end += 1;
        }
        let tip = Attachment {
            body: end,
            frame: format!("{name}.end"),
            pose: Pose::translation(Vector3::unit(2).times(far)),
        };
        tree.loops[i] = TreeLoop::new(name, ClosureKind::Spherical, [tip, b]);
    }
}
