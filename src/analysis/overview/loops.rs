//! The independent loops of a mechanism.

use serde::{Deserialize, Serialize};

use crate::mechanism::{Body, Frame, Mechanism};

/// A loop, from a body round to the same body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loop {
    /// The closure that closes it: no earlier closure and no chain does.
    pub closed_by: String,
    /// What one passes going round, beginning and ending at the same body.
    pub steps: Vec<LoopStep>,
}

/// A part of a loop.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LoopStep {
    /// The ground.
    Ground,
    /// A platform.
    Platform(String),
    /// Joints of a chain.
    Chain(String),
    /// A closure.
    Closure(String),
}

/// What joins two bodies.
#[derive(Clone, Copy, PartialEq)]
enum Link {
    /// The moving row of a chain of that index.
    Chain(usize),
    /// The closure of that index.
    Closure(usize),
}

/// The fundamental loops of the graph of bodies over a spanning tree of chains and first closures: each closure that
/// joins bodies already joined closes one loop, and no loop is a combination of the others.
pub(super) fn loops(mechanism: &Mechanism) -> Vec<Loop> {
    let bodies = mechanism.bodies();
    let index = |body: Body| bodies.binary_search(&body).unwrap_or(0);
    let mut tree: Vec<Vec<(usize, Link)>> = vec![Vec::new(); bodies.len()];
    let join = |tree: &mut Vec<Vec<(usize, Link)>>, a: usize, b: usize, link: Link| {
        tree[a].push((b, link));
        tree[b].push((a, link));
    };
    for (chain, part) in mechanism.chains().iter().enumerate() {
        let mut below = index(mechanism.body(part.on));
        for (i, row) in part.rows.iter().enumerate() {
            if !row.joints().is_empty() {
                let body = index(mechanism.body(Frame::Link { chain, row: i + 1 }));
                join(&mut tree, below, body, Link::Chain(chain));
                below = body;
            }
        }
    }
    let mut loops = Vec::new();
    for (i, closure) in mechanism.closures().iter().enumerate() {
        let [from, to] = closure.frames.map(|frame| index(mechanism.body(frame)));
        match path(&tree, from, to) {
            None => join(&mut tree, from, to, Link::Closure(i)),
            Some(mut way) => {
                way.push((to, Link::Closure(i)));
                loops.push(Loop {
                    closed_by: closure.name.clone(),
                    steps: named(mechanism, &bodies, way),
                });
            }
        }
    }
    loops
}

/// The way in the tree from one body to another: each body with what leads on from it.
fn path(tree: &[Vec<(usize, Link)>], from: usize, to: usize) -> Option<Vec<(usize, Link)>> {
    let mut waiting = vec![(from, Vec::new())];
    while let Some((at, way)) = waiting.pop() {
        if at == to {
            return Some(way);
        }
        for &(next, link) in &tree[at] {
            if way.last().is_none_or(|&(before, _)| before != next) {
                waiting.push((next, [&way[..], &[(at, link)]].concat()));
            }
        }
    }
    None
}

/// The names along a loop of bodies with what leads on from them; links between joints of one chain
/// have none. Begins at ground or a platform if the loop passes there.
fn named(mechanism: &Mechanism, bodies: &[Body], mut around: Vec<(usize, Link)>) -> Vec<LoopStep> {
    // ground sorts first, platforms next
    let first = (0..around.len()).min_by_key(|&i| around[i].0).unwrap_or(0);
    around.rotate_left(first);
    let body_step = |body: usize| match bodies[body] {
        Body::Ground => Some(LoopStep::Ground),
        Body::Platform(i) => Some(LoopStep::Platform(mechanism.platforms()[i].name.clone())),
        Body::Link { .. } => None,
    };
    let mut steps: Vec<LoopStep> = Vec::new();
    for &(body, link) in &around {
        steps.extend(body_step(body));
        let step = match link {
            Link::Chain(i) => LoopStep::Chain(mechanism.chains()[i].name.clone()),
            Link::Closure(i) => LoopStep::Closure(mechanism.closures()[i].name.clone()),
        };
        if steps.last() != Some(&step) {
            steps.push(step);
        }
    }
    steps.extend(body_step(around[0].0));
    steps
}
