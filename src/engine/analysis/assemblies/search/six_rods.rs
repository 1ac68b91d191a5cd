//! The solutions of a platform on six rods, from those of a general one.
//!
//! Poses of a platform are points of a variety of degree 40 in 16-dimensional projective space, beside a part at infinity, and
//! each rod keeps them in a hyperplane (Gallet, Nawratil and Schicho 2015): a general platform has 40 (Ronga and Vust 1992).
//! Their paths lead to all isolated solutions of any other, so that there is nothing to search.

use serde::{Deserialize, Serialize};

use crate::analysis::assemblies::family::{C, Family, LegwiseSolutions, Member};
use crate::analysis::assemblies::track::{End, ParameterHomotopy, WAYS, ends_by};
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{
    ChainDimensions, ClosureDimensions, ClosureKind, Dimensions, Frame, LinearForm,
};
use crate::number::Number;
use crate::solve::Watch;
use crate::system::{Held, HeldPlatform, System};

/// Rods, each with its end on ground, that on the platform, and its length, and poses as quaternions and positions.
#[derive(Debug, Serialize, Deserialize)]
struct General {
    rods: Vec<[C; 7]>,
    poses: Vec<[C; 7]>,
}

/// A platform of which all dimensions are random complex numbers, with its 40 poses.
const GENERAL: &str = include_str!("six_rods.ron");

/// The solutions at the first of some members at which no path is lost and none meet, with its place, and how many of the 40
/// are at infinity there: on the straight way, at the last one on any. `None` if the family is no platform on six rods.
pub(super) fn solved(family: &Family, members: &[Member], watch: &Watch) -> Option<(usize, Poses)> {
    let mut all = members.iter().enumerate();
    all.find_map(|(k, member)| {
        let bends = if k + 1 == members.len() {
            &WAYS[..]
        } else {
            &WAYS[..1]
        };
        let rods = rods(family, member)?;
        Some((k, reached(family, (member, &rods), bends, watch)?))
    })
}

/// Solutions, and a number of others at infinity.
pub(super) type Poses = (Vec<LegwiseSolutions>, usize);

fn reached(
    family: &Family,
    (member, rods): (&Member, &[[C; 7]]),
    bends: &[f64],
    watch: &Watch,
) -> Option<Poses> {
    let general: General = ron::from_str(GENERAL).ok()?;
    let size = family.coordinates.length;
    let from: Vec<[C; 7]> = general
        .rods
        .iter()
        .map(|rod| rod.map(|x| x * size))
        .collect();
    let [from, to] = [from.as_slice(), rods].map(|rods| platform(family, rods));
    let way = ParameterHomotopy::between(family, (&from, &to), member)?;
    let poses = general.poses.iter().map(|pose| LegwiseSolutions {
        pose: pose.to_vec(),
        legs: Vec::new(),
    });
    let (mut solutions, mut infinite) = (Vec::new(), 0);
    let poses: Vec<LegwiseSolutions> = poses.collect();
    for end in ends_by(bends, &way, &poses, watch)?.ends {
        match end {
            End::Regular(pose) => solutions.push(LegwiseSolutions {
                pose,
                legs: Vec::new(),
            }),
            End::Infinite => infinite += 1,
            End::Gone if bends.len() == WAYS.len() => infinite += 1,
            _ => return None,
        }
    }
    Some((solutions, infinite))
}

/// The six rods of a member.
fn rods(family: &Family, member: &Member) -> Option<Vec<[C; 7]>> {
    let c = &family.coordinates;
    if !c.free_joints.is_empty() || c.free_platforms.len() != 1 {
        return None;
    }
    let free = family.held.platforms[c.free_platforms[0]] == HeldPlatform::Free;
    let mut still = family.homotopy(member, member).filter(|_| free)?;
    let [zero, one] = [0.0, 1.0].map(C::from_f64);
    // in its own frame
    still.linearise(zero, &[one, zero, zero, zero, zero, zero, zero]);
    let rods = still.here.system.rods(&still.here.at, &still.here.work)?;
    let flat = rods.into_iter().map(|([a, b], length)| {
        // a point at the origin would have no displacement of its own
        let [a, b] = [a, b].map(|p| p.0.map(|x| x + f64::MIN_POSITIVE));
        [a[0], a[1], a[2], b[0], b[1], b[2], length]
    });
    Some(flat.collect()).filter(|rods: &Vec<_>| rods.len() == 6)
}

/// The equations of a platform on such rods.
fn platform(family: &Family, rods: &[[C; 7]]) -> System<C> {
    let (joints, platforms) = (family.held.joints.len(), family.held.platforms.len());
    let own = family.coordinates.free_platforms[0];
    let point = |at: &[C]| Pose::translation(Vector3([at[0], at[1], at[2]]));
    let mut frames = vec![Vec::new(); platforms];
    frames[own] = rods.iter().map(|rod| point(&rod[3..6])).collect();
    let chains = rods.iter().map(|rod| ChainDimensions {
        on: Frame::Ground,
        base: point(&rod[..3]),
        rows: Vec::new(),
        tip: Pose::identity(),
    });
    let closures = rods.iter().enumerate().map(|(i, rod)| ClosureDimensions {
        kind: ClosureKind::Distance,
        frames: [
            Frame::Tip { chain: i },
            Frame::OnPlatform {
                platform: own,
                frame: i,
            },
        ],
        length: rod[6],
        extension: LinearForm(Vec::new()),
        relation: None,
    });
    let mut held = Held {
        joints: vec![true; joints],
        platforms: vec![HeldPlatform::Pose; platforms],
    };
    held.platforms[own] = HeldPlatform::Free;
    let dimensions = Dimensions {
        characteristic_length: family.coordinates.length,
        centre: [0.0; 3],
        axes: None,
        joint_scales: family.coordinates.joint_scales.clone(),
        chains: chains.collect(),
        platforms: frames,
        closures: closures.collect(),
    };
    System::new(&dimensions, &held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Quaternion;
    use crate::number::complex::norm;

    /// 40 (Ronga and Vust 1992), each assembled but for the 13 digits written and none twice; a rod of another length fits none.
    #[test]
    fn the_general_platform_has_its_forty_poses() {
        let general: General = ron::from_str(GENERAL).unwrap();
        let gap = |rod: &[C; 7], pose: &[C; 7], length: C| {
            let q = Quaternion([pose[0], pose[1], pose[2], pose[3]]);
            let [a, b, at] =
                [&rod[..3], &rod[3..6], &pose[4..]].map(|p| Vector3([p[0], p[1], p[2]]));
            let along = q.rotation() * b + at - a;
            norm(along.dot(&along) - length * length) / (1.0 + norm(along.dot(&along)))
        };
        assert_eq!((general.rods.len(), general.poses.len()), (6, 40));
        for (i, pose) in general.poses.iter().enumerate() {
            for rod in &general.rods {
                assert!(gap(rod, pose, rod[6]) < 1e-9);
                assert!(gap(rod, pose, rod[6] + 0.1) > 1e-6);
            }
            for other in &general.poses[..i] {
                // q and -q are one pose
                let apart = |sign: f64| {
                    let pairs = pose[..4].iter().zip(&other[..4]);
                    pairs.map(|(a, b)| norm(a - b * sign)).fold(0.0, f64::max)
                };
                assert!(apart(1.0).min(apart(-1.0)) > 1e-3);
            }
        }
    }
}
