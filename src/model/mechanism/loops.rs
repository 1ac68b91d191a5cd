//! Joints and platforms on which a closure depends.

use super::frames::joints_of;
use super::model::Closure;
use super::{Mechanism, relation};

impl Mechanism {
    /// The joints and platforms on which it depends whether a closure is closed: what moves both of its frames alike does not
    /// open it.
    pub fn within_loop(&self, closure: &Closure) -> (Vec<usize>, Vec<usize>) {
        // from the frame to what carries it
        let [mut first, mut second] = closure.frames.map(|frame| {
            let chains = self.chains_below(frame);
            let rows = chains.flat_map(|(chain, rows)| {
                let rows = rows.iter().enumerate().rev();
                rows.map(move |(i, row)| ((chain, i), row))
            });
            rows.collect::<Vec<_>>()
        });
        let mut carriers: Vec<usize> = Vec::new();
        let [one, other] = closure.frames.map(|frame| self.carrier(frame));
        if one == other {
            while let (Some((a, _)), Some((b, _))) = (first.last(), second.last())
                && a == b
            {
                first.pop();
                second.pop();
            }
        } else {
            carriers.extend([one, other].into_iter().flatten());
        }
        let rows = first.iter().chain(&second);
        let length = closure.length.iter().flat_map(joints_of);
        let related = closure.relation.iter().flat_map(relation::joints_of);
        let joints = rows.flat_map(|(_, row)| row.joints());
        (joints.chain(length).chain(related).collect(), carriers)
    }
}
