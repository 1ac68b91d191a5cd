//! Parts of a mechanism that no closure couples.

use super::layout::Unknown;
use crate::mechanism::{Frame, Mechanism, Symbol};

/// For each independent part of a mechanism which of the unknowns are its own.
///
/// Unknowns belong together if a closure feels both. The configurations of a mechanism are the
/// product of those of its parts.
pub fn independent_parts(mechanism: &Mechanism, unknowns: &[Unknown]) -> Vec<Vec<bool>> {
    let mut label: Vec<usize> = (0..unknowns.len()).collect();
    let platforms = 0..mechanism.platforms().len();
    let together = platforms
        .map(|platform| Felt {
            joints: vec![],
            platforms: vec![platform],
        })
        .chain(closures(mechanism));
    for felt in together {
        let own: Vec<usize> = (0..unknowns.len())
            .filter(|&i| match unknowns[i] {
                Unknown::Joint(joint) => felt.joints.contains(&joint),
                Unknown::Twist { platform, .. } => felt.platforms.contains(&platform),
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
    let mut parts: Vec<Vec<bool>> = Vec::new();
    for root in 0..unknowns.len() {
        let own: Vec<bool> = label.iter().map(|l| *l == root).collect();
        if own.contains(&true) {
            parts.push(own);
        }
    }
    parts
}

/// What a closure feels.
struct Felt {
    joints: Vec<usize>,
    platforms: Vec<usize>,
}

fn closures(mechanism: &Mechanism) -> impl Iterator<Item = Felt> {
    mechanism.closures().iter().map(|closure| {
        let lengths = closure.length.iter().flat_map(|length| &length.terms);
        let mut felt = Felt {
            joints: lengths
                .filter_map(|(symbol, _)| match symbol {
                    Symbol::Joint(joint) => Some(*joint),
                    Symbol::Parameter(_) | Symbol::Local(_) => None,
                })
                .collect(),
            platforms: vec![],
        };
        for frame in closure.frames {
            felt.add(mechanism, frame);
        }
        felt
    })
}

impl Felt {
    /// All that moves a frame, down to the ground.
    fn add(&mut self, mechanism: &Mechanism, mut frame: Frame) {
        loop {
            let (chain, rows) = match frame {
                Frame::Ground => return,
                Frame::Platform { platform } | Frame::OnPlatform { platform, .. } => {
                    return self.platforms.push(platform);
                }
                Frame::Link { chain, row } => (chain, row),
                Frame::Tip { chain } => (chain, mechanism.chains()[chain].rows.len()),
            };
            let chain = &mechanism.chains()[chain];
            let rows = chain.rows[..rows].iter();
            self.joints.extend(rows.flat_map(|row| row.joints()));
            frame = chain.on;
        }
    }
}
