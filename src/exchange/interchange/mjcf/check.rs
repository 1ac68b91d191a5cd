//! Problems of single elements of an MJCF file.

use std::collections::HashSet;

use roxmltree::Node;

use crate::geometry::Vector3;
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::xml_reader::Problems;

/// Elements that do not affect how bodies move.
const IRRELEVANT: &str = "asset camera composite contact custom deformable extension geom hfield light \
                          material mesh option pair plugin sensor size skin statistic texture user visual";

pub(super) fn is_irrelevant(node: Node) -> bool {
    let mut irrelevant = IRRELEVANT.split(' ');
    irrelevant.any(|element| element == node.tag_name().name())
}

/// Example of an axis as the format writes it.
pub(super) const AXIS: &str = "axis=\"0 0 1\"";

/// Elements that create bodies in unsupported ways.
const MAKING: &[&str] = &["attach", "flexcomp", "model", "composite"];

/// Attributes of numbers, and how many.
const NUMBERS: &[(&str, usize)] = &[
    ("pos", 3),
    ("quat", 4),
    ("axisangle", 4),
    ("euler", 3),
    ("xyaxes", 6),
    ("zaxis", 3),
    ("axis", 3),
    ("range", 2),
    ("ref", 1),
    ("anchor", 3),
    ("relpose", 7),
    ("coef", 1),
];

/// The problems of one element.
pub(super) fn look<'a>(
    node: Node<'a, '_>,
    problems: &mut Problems,
    seen: &mut HashSet<(&'a str, String)>,
) {
    let element = node.tag_name().name();
    let mut refuse = |what: String, help| problems.unsupported::<()>(what, help, node);
    if MAKING.contains(&element) {
        refuse(
            format!("the element `{element}`"),
            "load the file into MuJoCo and save it: mj_saveLastXML writes all bodies out",
        );
        return;
    }
    if node.ancestors().any(is_irrelevant) {
        return;
    }
    let within = node.parent().map(|parent| parent.tag_name().name());
    match within {
        Some("frame") if matches!(element, "joint" | "freejoint") => {
            refuse(
                format!("a `{element}` in a `frame`"),
                "move it into the body, with its position and axis transformed by the frame",
            );
        }
        Some("worldbody") if matches!(element, "joint" | "freejoint") => {
            refuse(
                format!("a `{element}` of the world"),
                "the world is fixed: put the joint into a body",
            );
        }
        _ => {}
    }
    if element == "compiler"
        && let Some(word) = node.attribute("eulerseq")
        && (word.len() != 3 || !word.chars().all(|c| "xyzXYZ".contains(c)))
    {
        refuse(
            format!("the sequence of angles `{word}`"),
            "write three letters out of x, y, z, X, Y and Z",
        );
    }
    for &(name, count) in NUMBERS {
        // of spatial tendons, lights and others these have another meaning
        if matches!(name, "range" | "coef") && element != "joint" {
            continue;
        }
        let Some(numbers) = problems.values(node, name, count) else {
            continue;
        };
        let size = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let parallel = |v: &[f64]| {
            let unit = |v: &[f64]| Vector3([v[0], v[1], v[2]]).times(1.0 / size(v));
            let across = unit(&v[..3]).cross(&unit(&v[3..])).norm();
            across.is_nan() || across <= 1e-9
        };
        let nothing = match name {
            "quat" | "zaxis" => size(&numbers) < 1e-12,
            "axisangle" => size(&numbers[..3]) < 1e-12,
            "xyaxes" => parallel(&numbers),
            _ => false,
        };
        if nothing {
            let text = node.attribute(name).unwrap_or_default().to_owned();
            problems.say(ImportProblemKind::NoOrientation { text }, node);
        }
        if name == "axis" && size(&numbers) < 1e-12 {
            let joint = node.attribute("name").unwrap_or("without name").to_owned();
            let example = AXIS;
            problems.say(ImportProblemKind::NoAxis { joint, example }, node);
        }
    }
    let noun = match element {
        "body" => "body",
        "joint" | "freejoint" if within == Some("body") => "joint",
        "site" if matches!(within, Some("body" | "worldbody" | "frame")) => "site",
        "spatial" | "fixed" => "tendon",
        _ => return,
    };
    if let Some(name) = node.attribute("name")
        && !seen.insert((noun, name.to_owned()))
    {
        problems.duplicate(noun, name, node);
    }
}
