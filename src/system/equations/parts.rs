//! Parts of a mechanism that no closure couples.

use super::layout::Unknown;
use crate::mechanism::Mechanism;

/// For each independent part of a mechanism which of the unknowns are its own.
///
/// Unknowns belong together if both affect one closure. The configurations of a mechanism are the
/// product of those of its parts.
pub fn independent_parts(mechanism: &Mechanism, unknowns: &[Unknown]) -> Vec<Vec<bool>> {
    let mut label: Vec<usize> = (0..unknowns.len()).collect();
    let platforms = (0..mechanism.platforms().len()).map(|platform| (vec![], vec![platform]));
    let closures = mechanism.closures().iter().map(|closure| {
        let carriers = closure.frames.into_iter();
        let carriers = carriers.filter_map(|frame| mechanism.carrier(frame));
        (mechanism.joints_moving(closure), carriers.collect())
    });
    for (joints, platforms) in platforms.chain(closures) {
        let own: Vec<usize> = (0..unknowns.len())
            .filter(|&i| match unknowns[i] {
                Unknown::Joint(joint) => joints.contains(&joint),
                Unknown::Twist { platform, .. } => platforms.contains(&platform),
            })
            .collect();
        let Some(&first) = own.first() else { continue };
        let to = label[first];
        for i in own {
            let from = label[i];
            label
                .iter_mut()
                .filter(|l| **l == from)
                .for_each(|l| *l = to);
        }
    }
    let parts = (0..unknowns.len()).map(|root| label.iter().map(|l| *l == root).collect());
    parts
        .filter(|own: &Vec<bool>| own.contains(&true))
        .collect()
}
