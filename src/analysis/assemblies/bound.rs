//! Structures whose number of solutions is known.

use crate::mechanism::{ClosureKind, Frame, JointKind, Mechanism};
use crate::system::{Held, HeldPlatform};

/// The largest number of isolated complex solutions that a structure has.
pub(super) struct KnownBound {
    pub count: usize,
    pub structure: &'static str,
    pub source: &'static str,
}

/// The known bound for a question, if its structure is recognised.
pub(super) fn known_bound(mechanism: &Mechanism, held: &Held<f64>) -> Option<KnownBound> {
    let free: Vec<usize> = (0..held.joints.len())
        .filter(|&j| !held.joints[j])
        .collect();
    let closures = mechanism.closures();
    let all = |kind: ClosureKind| closures.iter().all(|c| c.kind == kind);
    let platforms = &held.platforms;
    let one_free_platform = matches!(platforms.as_slice(), [HeldPlatform::Free]);
    let to_platform = closures.iter().all(|c| {
        let on = c
            .frames
            .map(|f| matches!(f, Frame::Platform { .. } | Frame::OnPlatform { .. }));
        on[0] != on[1]
    });
    let turns = free
        .iter()
        .all(|&j| mechanism.joints()[j].kind == JointKind::Revolute);
    let bound = |count, structure, source| {
        Some(KnownBound {
            count,
            structure,
            source,
        })
    };
    if one_free_platform
        && to_platform
        && free.is_empty()
        && closures.len() == 6
        && all(ClosureKind::Distance)
    {
        return bound(
            40,
            "six legs between a base and a platform",
            "Ronga and Vust 1992; Raghavan 1993",
        );
    }
    if one_free_platform
        && to_platform
        && turns
        && closures.len() == 3
        && all(ClosureKind::Spherical)
        && free.len() == 3
    {
        // three points of a rigid triangle on three circles
        return bound(
            16,
            "three hinged legs with balls on a platform",
            "Nanua, Waldron and Murthy 1990",
        );
    }
    let serial = closures.len() == 1 && all(ClosureKind::Rigid) && turns && free.len() == 6;
    if serial && matches!(platforms.as_slice(), [HeldPlatform::Pose]) {
        return bound(
            16,
            "serial arm of six revolute joints",
            "Primrose 1986; Lee and Liang 1988",
        );
    }
    None
}
