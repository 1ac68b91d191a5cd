//! How many freedoms counting leads to expect (Chebyshev, Grübler, Kutzbach).

use serde::{Deserialize, Serialize};

use crate::description::ClosureKind;
use crate::geometry::Vector3;
use crate::mechanism::{Frame, Mechanism};

/// The terms of M = 6·(N − 1) − Σ (6 − f) + (joint variables that are not driven row by row) − Σ equations.
///
/// The count knows nothing of dimensions: it is wrong for every mechanism whose loops are special.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MobilityCount {
    /// N: bodies, the ground among them.
    pub bodies: usize,
    /// Freedoms of each moving row of the chains: 1, or 2 where it turns and slides by different variables.
    pub row_freedoms: Vec<usize>,
    /// Joint variables that the chains and distances use.
    pub variables: usize,
    /// Variables less the freedoms of the rows: below 0 if one variable drives several rows, above 0 if distances have
    /// variables of their own.
    pub correction: i64,
    /// Platforms.
    pub platforms: usize,
    /// Equations of all closures.
    pub equations: usize,
    /// M, the same as variables + 6·platforms − equations.
    pub mobility: i64,
    /// The same with 3 in place of 6, if all joints move in one plane.
    pub planar: Option<PlanarCount>,
}

/// The count of a mechanism all of whose joints move in parallel planes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlanarCount {
    /// Equations of all closures within the plane.
    pub equations: usize,
    /// variables + 3·platforms − equations.
    pub mobility: i64,
}

pub(super) fn count(mechanism: &Mechanism) -> MobilityCount {
    let mut row_freedoms = Vec::new();
    let mut used = vec![false; mechanism.joints().len()];
    for row in mechanism.chains().iter().flat_map(|chain| &chain.rows) {
        let joints = row.joints();
        joints.iter().for_each(|&joint| used[joint] = true);
        let (turns, slides) = (!row.theta.terms.is_empty(), !row.d.terms.is_empty());
        match (turns, slides) {
            (false, false) => {}
            (true, true) if joints.len() > 1 => row_freedoms.push(2),
            _ => row_freedoms.push(1),
        }
    }
    for extension in mechanism.dimensions().closures.iter().map(|c| &c.extension) {
        extension
            .0
            .iter()
            .for_each(|&(joint, _)| used[joint] = true);
    }
    let variables = used.into_iter().filter(|&used| used).count();
    let closures = mechanism.closures().iter();
    let equations = closures.map(|closure| closure.kind.equations()).sum();
    let platforms = mechanism.platforms().len();
    let freedoms: usize = row_freedoms.iter().sum();
    let mobility = |motions: usize, equations: usize| {
        (variables + motions * platforms) as i64 - equations as i64
    };
    MobilityCount {
        bodies: mechanism.bodies().len(),
        row_freedoms,
        variables,
        correction: variables as i64 - freedoms as i64,
        platforms,
        equations,
        mobility: mobility(6, equations),
        planar: planar_equations(mechanism).map(|equations| PlanarCount {
            equations,
            mobility: mobility(3, equations),
        }),
    }
}

/// How far from 0 or 1 the cosine between axes may be that are perpendicular or parallel.
const STRAIGHT: f64 = 1e-9;

/// The equations that the closures set in the plane, if at home all joints move parallel to one plane.
fn planar_equations(mechanism: &Mechanism) -> Option<usize> {
    let home = mechanism.home();
    // z of the frame after a row is the joint axis in the modified convention, z of the frame before in the standard
    let axis = |frame| mechanism.transform(Frame::Ground, frame, &home).rotation.0[2];
    let mut turning: Vec<Vector3<f64>> = Vec::new();
    let mut sliding: Vec<Vector3<f64>> = Vec::new();
    for (chain, part) in mechanism.chains().iter().enumerate() {
        for (i, row) in part.rows.iter().enumerate() {
            let standard = part.convention == crate::mechanism::Convention::Standard;
            let row_number = if standard { i } else { i + 1 };
            let frame = Frame::Link {
                chain,
                row: row_number,
            };
            match (row.theta.terms.is_empty(), row.d.terms.is_empty()) {
                (true, true) => {}
                (false, true) => turning.push(axis(frame)),
                (true, false) => sliding.push(axis(frame)),
                (false, false) => return None,
            }
        }
    }
    // a platform that hangs on balls alone may tilt out of the plane
    let mut closures = mechanism.closures().iter();
    let may_tilt = closures.any(|closure| closure.kind.leaves_orientation());
    if may_tilt && !mechanism.platforms().is_empty() {
        return None;
    }
    let mut equations = 0;
    for closure in mechanism.closures() {
        let [from, to] = closure.frames.map(axis);
        match closure.kind {
            ClosureKind::Spherical => equations += 2,
            ClosureKind::Revolute => {
                turning.extend([from, to]);
                equations += 2;
            }
            ClosureKind::Prismatic => {
                sliding.extend([from, to]);
                equations += 2;
            }
            ClosureKind::Planar => turning.extend([from, to]),
            ClosureKind::Rigid => equations += 3,
            ClosureKind::Distance => equations += 1,
            ClosureKind::Universal | ClosureKind::Cylindrical => return None,
        }
    }
    let normal = *turning.first()?;
    let parallel = |v: &Vector3<f64>| v.dot(&normal).abs() > 1.0 - STRAIGHT;
    let perpendicular = |v: &Vector3<f64>| v.dot(&normal).abs() < STRAIGHT;
    (turning.iter().all(parallel) && sliding.iter().all(perpendicular)).then_some(equations)
}
