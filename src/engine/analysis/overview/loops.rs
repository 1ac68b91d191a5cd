//! The independent loops of a mechanism.

use serde::{Deserialize, Serialize};

use crate::mechanism::{Body, Connector, FundamentalLoop, Linkage, Mechanism};

/// A loop, from a body round to the same body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Loop {
    /// The closure that closes it: no earlier closure and no chain does.
    pub closed_by: String,
    /// Bodies and joints in order round the loop, beginning and ending at the same body.
    pub steps: Vec<LoopStep>,
}

/// A part of a loop.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// The independent loops of the graph of bodies.
pub(super) fn loops(mechanism: &Mechanism) -> Vec<Loop> {
    let linkage = mechanism.linkage();
    let loops = linkage.loops().into_iter();
    let named = loops.map(|found| Loop {
        closed_by: mechanism.closures()[found.closure].name.clone(),
        steps: named(mechanism, &linkage, &found),
    });
    named.collect()
}

/// The names along a loop; links between joints of one chain have none. Begins at ground or a platform if the loop passes
/// there, and passes its closure last.
fn named(mechanism: &Mechanism, linkage: &Linkage, found: &FundamentalLoop) -> Vec<LoopStep> {
    let joints = found.connections.iter().rev();
    let bodies = found.bodies[..1]
        .iter()
        .chain(found.bodies[1..].iter().rev());
    let mut around: Vec<(Body, Connector)> = (bodies.zip(joints))
        .map(|(&body, &joint)| (body, linkage.connections[joint].by))
        .collect();
    // ground sorts first, platforms next
    let first = (0..around.len()).min_by_key(|&i| around[i].0).unwrap_or(0);
    around.rotate_left(first);
    let body_step = |body: Body| match body {
        Body::Ground => Some(LoopStep::Ground),
        Body::Platform(i) => Some(LoopStep::Platform(mechanism.platforms()[i].name.clone())),
        Body::Link { .. } => None,
    };
    let mut steps: Vec<LoopStep> = Vec::new();
    for &(body, joint) in &around {
        steps.extend(body_step(body));
        let step = match joint {
            Connector::Row { chain, .. } => LoopStep::Chain(mechanism.chains()[chain].name.clone()),
            Connector::Closure(i) => LoopStep::Closure(mechanism.closures()[i].name.clone()),
        };
        if steps.last() != Some(&step) {
            steps.push(step);
        }
    }
    steps.extend(body_step(around[0].0));
    steps
}
