//! How a joint is written.

use crate::interchange::tree::{Joint, Motion};
use crate::interchange::xml::{numbers, vector};

pub(super) fn joint_tag(joint: &Joint) -> &'static str {
    match joint.motion {
        Motion::Free => "freejoint",
        _ => "joint",
    }
}

pub(super) fn joint_attributes(joint: &Joint) -> Vec<(&'static str, String)> {
    let mut attributes = vec![("name", joint.name.clone())];
    let kind = match joint.motion {
        Motion::Free => return attributes,
        Motion::Turn => "hinge",
        Motion::Slide => "slide",
        Motion::Ball => "ball",
    };
    attributes.push(("type", kind.into()));
    attributes.push(("axis", vector(&joint.axis)));
    if let Some((low, high)) = joint.limits {
        attributes.push(("range", numbers([low, high])));
    }
    attributes
}
