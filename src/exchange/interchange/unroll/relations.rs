//! Relations between the bodies and joints of a tree before it is unrolled.

use std::collections::{HashMap, HashSet};

use crate::geometry::Pose;
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::tree::Tree;

/// The body that carries each body, and the pose of the body in it: the nearest one that moves.
pub(in crate::interchange) fn carriers(tree: &Tree) -> Vec<(usize, Pose<f64>)> {
    let mut carriers: Vec<(usize, Pose<f64>)> = Vec::with_capacity(tree.bodies.len());
    for (i, body) in tree.bodies.iter().enumerate() {
        carriers.push(match body.parent {
            Some(parent) if body.joints.is_empty() => {
                (carriers[parent].0, carriers[parent].1 * body.pose)
            }
            _ => (i, Pose::identity()),
        });
    }
    carriers
}

/// A joint that follows others: offset + Σ factor · value.
#[derive(Debug, Default)]
pub(super) struct FollowingJoint {
    pub offset: f64,
    pub terms: Vec<(String, f64)>,
}

impl FollowingJoint {
    /// Adds a joint; what is lost in rounding of what was there cancels.
    fn add(&mut self, joint: &str, factor: f64) {
        match self.terms.iter().position(|(known, _)| known == joint) {
            None => self.terms.push((joint.to_owned(), factor)),
            Some(place) => {
                let known = &mut self.terms[place].1;
                let largest = known.abs().max(factor.abs());
                *known += factor;
                if known.abs() <= 1e-12 * largest {
                    self.terms.remove(place);
                }
            }
        }
    }

    /// Puts what a joint follows in its place.
    fn replace(&mut self, joint: &str, by: &FollowingJoint) {
        let Some(place) = self.terms.iter().position(|(known, _)| known == joint) else {
            return;
        };
        let (_, factor) = self.terms.remove(place);
        self.offset += factor * by.offset;
        for (leader, of) in &by.terms {
            self.add(leader, factor * of);
        }
    }
}

/// The joints that follow: of each coupling one, if it can be one that is not driven, and first the one that follows in the
/// file. Those that lead follow none.
pub(super) fn followers(tree: &Tree) -> Result<HashMap<String, FollowingJoint>, ImportProblemKind> {
    let driven = tree.joints().filter(|joint| joint.actuated);
    let driven: HashSet<&str> = driven.map(|joint| joint.name.as_str()).collect();
    let mut found: HashMap<String, FollowingJoint> = HashMap::new();
    // the followers of each joint that leads
    let mut led: HashMap<String, Vec<String>> = HashMap::new();
    for coupling in tree.couplings.iter().filter(|of| of.bend.is_none()) {
        // offset + Σ factor · value = 0, in terms of joints that lead
        let mut sum = FollowingJoint {
            offset: -coupling.constant,
            terms: Vec::new(),
        };
        coupling
            .terms
            .iter()
            .for_each(|(joint, factor)| sum.add(joint, *factor));
        for (joint, _) in &coupling.terms {
            if let Some(following) = found.get(joint) {
                sum.replace(joint, following);
            }
        }
        sum.terms.retain(|(_, factor)| *factor != 0.0);
        let is_free = |(joint, _): &(String, f64)| !driven.contains(joint.as_str());
        let place = sum.terms.iter().position(is_free).unwrap_or(0);
        let Some((joint, own)) = sum.terms.get(place).cloned() else {
            if sum.offset.abs() > 1e-9 * coupling.constant.abs().max(1.0) {
                let joint = coupling.terms.first().map(|(joint, _)| joint.clone());
                let joint = joint.unwrap_or_default();
                return Err(ImportProblemKind::Contradiction { joint });
            }
            continue;
        };
        sum.terms.remove(place);
        let following = FollowingJoint {
            offset: -sum.offset / own,
            terms: (sum.terms.into_iter())
                .map(|(leader, factor)| (leader, -factor / own))
                .collect(),
        };
        let before = led.remove(&joint).unwrap_or_default();
        for follower in &before {
            if let Some(known) = found.get_mut(follower) {
                known.replace(&joint, &following);
            }
        }
        for (leader, _) in &following.terms {
            let led = led.entry(leader.clone()).or_default();
            led.extend(before.iter().cloned().chain([joint.clone()]));
        }
        found.insert(joint, following);
    }
    Ok(found)
}

/// Refuses numbers so large that all others would be lost to rounding.
pub(super) fn within_reason(tree: &Tree) -> Result<(), ImportProblemKind> {
    fn entries(pose: &Pose<f64>) -> impl Iterator<Item = f64> {
        let axes = pose.rotation.0.into_iter().chain([pose.position]);
        axes.flat_map(|axis| axis.0)
    }
    fn check(of: &str, mut numbers: impl Iterator<Item = f64>) -> Result<(), ImportProblemKind> {
        let of = of.to_owned();
        let fit = numbers.all(|x| x.abs() <= 1e12);
        fit.then_some(()).ok_or(ImportProblemKind::TooLarge { of })
    }
    let zero = tree.poses(|joint| joint.reference);
    for ((body, zero), home) in tree.bodies.iter().zip(&zero).zip(&tree.home()) {
        let poses = [&body.pose, zero, home];
        check(&body.name, poses.into_iter().flat_map(entries))?;
        for (name, frame) in &body.frames {
            check(name, entries(frame))?;
        }
        for joint in &body.joints {
            let line = joint.point.0.into_iter().chain(joint.axis.0);
            let (low, high) = joint.limits.unwrap_or_default();
            let values = [joint.reference, joint.home, low, high];
            check(&joint.name, line.chain(values))?;
        }
    }
    for coupling in &tree.couplings {
        let bends = coupling.bend.iter().flat_map(|bend| {
            let factors = bend.terms.iter().map(|(_, factor)| *factor);
            factors
                .chain(bend.powers.iter().copied())
                .chain([bend.constant])
        });
        let factors = coupling.terms.iter().map(|(_, factor)| *factor);
        let factors = factors.chain(bends);
        let joint = coupling.terms.first().map_or("", |(joint, _)| joint);
        check(joint, factors.chain([coupling.constant]))?;
    }
    for part in &tree.loops {
        let lengths = part.length.iter().flat_map(|length| {
            let factors = length.terms.iter().map(|(_, factor)| *factor);
            factors.chain([length.constant])
        });
        let sides = part.sides.iter().flat_map(|side| entries(&side.pose));
        check(&part.name, sides.chain(lengths))?;
    }
    Ok(())
}
