//! Solutions for real inputs that are not real come in conjugate pairs.

use super::{Group, TargetProblem};
use crate::analysis::assemblies::family::{C, size};
use crate::number::tolerance::DOUBLE;
use crate::system::SystemWork;

impl TargetProblem<'_> {
    /// Adds the conjugates of solutions that are not real where no path led to them: for real
    /// inputs they are solutions too. How many there were.
    ///
    /// Each solution has one partner, the nearest to its conjugate of those that have none yet.
    pub(super) fn pair(&self, groups: &mut Vec<Group>, work: &mut SystemWork<f64>) -> usize {
        let mut alone: Vec<usize> = (0..groups.len())
            .filter(|&i| {
                let Group { x, singular, .. } = &groups[i];
                groups[i].dimension == 0 && self.real(x, *singular, work).is_none()
            })
            .collect();
        let mut added = 0;
        while let Some(i) = alone.pop() {
            let conjugate: Vec<C> = groups[i].x.iter().map(|z| z.conj()).collect();
            let apart = |k: usize| self.coordinates.difference(&conjugate, &groups[k].x);
            let limit = DOUBLE * (1.0 + size(&conjugate));
            let nearest = (0..alone.len()).min_by(|&a, &b| {
                let [a, b] = [a, b].map(|place| apart(alone[place]));
                a.total_cmp(&b)
            });
            match nearest.filter(|&place| apart(alone[place]) <= limit) {
                Some(place) => drop(alone.swap_remove(place)),
                // real but for what rounding leaves where solutions meet
                None if apart(i) <= limit => {}
                None => {
                    added += groups[i].paths;
                    groups.push(Group {
                        x: conjugate,
                        ..groups[i]
                    });
                }
            }
        }
        added
    }
}
