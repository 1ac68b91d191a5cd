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
    let mut forest = Forest {
        links: vec![Vec::new(); bodies.len()],
        joined: (0..bodies.len()).collect(),
    };
    for (chain, part) in mechanism.chains().iter().enumerate() {
        let mut below = index(mechanism.body(part.on));
        for (i, row) in part.rows.iter().enumerate() {
            if !row.joints().is_empty() {
                let body = index(mechanism.body(Frame::Link { chain, row: i + 1 }));
                forest.join(below, body, Link::Chain(chain));
                below = body;
            }
        }
    }
    let mut closing = Vec::new();
    for (i, closure) in mechanism.closures().iter().enumerate() {
        let [from, to] = closure.frames.map(|frame| index(mechanism.body(frame)));
        match forest.root(from) == forest.root(to) {
            true => closing.push((i, from, to)),
            false => forest.join(from, to, Link::Closure(i)),
        }
    }
    let rooted = Rooted::new(&forest.links);
    let loops = closing.into_iter().map(|(i, from, to)| {
        let mut way = rooted.way(from, to);
        way.push((to, Link::Closure(i)));
        Loop {
            closed_by: mechanism.closures()[i].name.clone(),
            steps: named(mechanism, &bodies, way),
        }
    });
    loops.collect()
}

/// Bodies with the links that join them to trees.
struct Forest {
    links: Vec<Vec<(usize, Link)>>,
    /// For each body another one of the same tree, or itself.
    joined: Vec<usize>,
}

impl Forest {
    fn root(&mut self, mut body: usize) -> usize {
        while self.joined[body] != body {
            self.joined[body] = self.joined[self.joined[body]];
            body = self.joined[body];
        }
        body
    }

    fn join(&mut self, a: usize, b: usize, link: Link) {
        self.links[a].push((b, link));
        self.links[b].push((a, link));
        let (a, b) = (self.root(a), self.root(b));
        self.joined[a.max(b)] = a.min(b);
    }
}

/// Trees of bodies, each body with its depth and the link to the body above it.
struct Rooted {
    depth: Vec<usize>,
    above: Vec<Option<(usize, Link)>>,
}

impl Rooted {
    fn new(tree: &[Vec<(usize, Link)>]) -> Self {
        let (mut depth, mut above) = (vec![usize::MAX; tree.len()], vec![None; tree.len()]);
        for root in 0..tree.len() {
            if depth[root] != usize::MAX {
                continue;
            }
            depth[root] = 0;
            let mut waiting = vec![root];
            while let Some(at) = waiting.pop() {
                for &(next, link) in &tree[at] {
                    if depth[next] == usize::MAX {
                        (depth[next], above[next]) = (depth[at] + 1, Some((at, link)));
                        waiting.push(next);
                    }
                }
            }
        }
        Rooted { depth, above }
    }

    /// The way from one body to another of the same tree: each body with what leads on from it.
    fn way(&self, mut from: usize, mut to: usize) -> Vec<(usize, Link)> {
        let (mut way, mut back) = (Vec::new(), Vec::new());
        while from != to {
            let climbs = self.depth[from] >= self.depth[to];
            let lower = if climbs { from } else { to };
            let (higher, link) = self.above[lower].expect("only the root has none above it");
            match climbs {
                true => {
                    way.push((from, link));
                    from = higher;
                }
                false => {
                    back.push((higher, link));
                    to = higher;
                }
            }
        }
        way.extend(back.into_iter().rev());
        way
    }
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
