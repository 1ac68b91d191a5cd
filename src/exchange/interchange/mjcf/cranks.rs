//! Actuators of MJCF that drive by a slider and a rod.

use roxmltree::Node;

use crate::description::ClosureKind;
use crate::geometry::{Pose, Vector3};
use crate::interchange::tree::{Attachment, BodyMotion, Extent, TreeBody, TreeJoint, TreeLoop};
use crate::interchange::xml_reader::children;

/// The actuators of a file that do.
pub(super) fn slider_cranks<'a, 'i>(root: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    let blocks = children(root, "actuator").into_iter();
    let actuators = blocks.flat_map(|block| block.children().filter(Node::is_element));
    actuators.filter(|node| node.has_attribute("cranksite"))
}

/// A slider that runs along z of one site, and its rod to another.
pub(super) struct SliderCrank {
    /// The name of its variable, that of the actuator.
    pub name: String,
    /// The index of the slider in the tree.
    pub body: usize,
    pub line: Attachment,
    pub crank: Attachment,
    /// The length of the rod, in m.
    pub length: f64,
}

impl SliderCrank {
    /// The slider and the rod, with bodies at home; `None` if the rod does not reach the line. Of its two places the slider
    /// has the one farther back along z, as the format says: p − √(r² − d²), for a pin at the distance d from the line, its foot
    /// at p.
    pub fn parts(self, home: &[Pose<f64>]) -> Option<(TreeBody, TreeLoop)> {
        let (line, crank, name) = (self.line, self.crank, self.name);
        let place = home[line.body] * line.pose;
        let Vector3([x, y, foot]) = place.inverse() * (home[crank.body] * crank.pose).position;
        let square = self.length * self.length - x * x - y * y;
        if square < 0.0 {
            return None;
        }
        let mut slider = TreeBody::new(format!("{name} slider"), Some(line.body), line.pose);
        slider.joints.push(TreeJoint {
            actuated: true,
            home: foot - square.sqrt(),
            ..TreeJoint::new(name.clone(), BodyMotion::Slide, Vector3::unit(2))
        });
        let pin = Attachment {
            body: self.body,
            frame: format!("{name} pin"),
            pose: Pose::identity(),
        };
        let rod = TreeLoop {
            length: Some(Extent {
                constant: self.length,
                terms: Vec::new(),
            }),
            ..TreeLoop::new(format!("{name} rod"), ClosureKind::Distance, [pin, crank])
        };
        Some((slider, rod))
    }
}
