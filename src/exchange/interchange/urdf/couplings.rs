//! Couplings of URDF+ (Chignoli et al. 2024, arXiv:2411.19753): gears and belts between two links.

use roxmltree::Node;

use crate::interchange::tree::{Coupling, Tree};
use crate::interchange::xml_reader::{Problems, child, children};

/// True if an element of a robot is one.
pub(super) fn is_coupling(node: Node) -> bool {
    node.has_tag_name("coupling") && child(node, "successor").is_some()
}

/// ratio · Σ joints to the predecessor = Σ joints to the successor, both from the nearest link that carries both.
pub(super) fn read(robot: Node, tree: &Tree, problems: &mut Problems) -> Vec<Coupling> {
    let nodes = children(robot, "coupling").into_iter();
    let couplings = nodes.filter(|node| is_coupling(*node)).map(|node| {
        let mut ways = Vec::new();
        for end in ["successor", "predecessor"] {
            let part = problems.needed_child(node, end)?;
            let name = problems.needed(part, "link")?;
            let links = tree.bodies.iter().map(|body| body.name.as_str());
            let found = links.clone().position(|link| link == name);
            let body = problems.known(found, (part, "link"), ("link", name), links)?;
            let way = std::iter::successors(Some(body), |body| tree.bodies[*body].parent);
            ways.push(way.collect::<Vec<usize>>());
        }
        let ratio = problems.needed_child(node, "ratio")?;
        problems.needed(ratio, "value")?;
        let [ratio] = problems.numbers(ratio, "value")?;
        let mut terms = Vec::new();
        for (way, other, factor) in [(&ways[0], &ways[1], 1.0), (&ways[1], &ways[0], -ratio)] {
            let own = way.iter().take_while(|body| !other.contains(body));
            let joints = own.flat_map(|body| &tree.bodies[*body].joints);
            let joints = joints.filter(|joint| !joint.motion.floats());
            terms.extend(joints.map(|joint| (joint.name.clone(), factor)));
        }
        Some(Coupling::linear(terms, 0.0))
    });
    couplings.flatten().collect()
}
