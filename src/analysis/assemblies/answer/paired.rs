//! Solutions for real inputs that are not real come in conjugate pairs.

use super::{END, Group, Question};
use crate::analysis::assemblies::family::{C, size};
use crate::analysis::assemblies::track::{ParameterHomotopy, are_one};
use crate::system::Work;

impl Question<'_> {
    /// Adds the conjugates of solutions that are not real where no path led to them: for real
    /// inputs they are solutions too. How many there were.
    pub(super) fn pair(
        &self,
        groups: &mut Vec<Group>,
        homotopy: &mut ParameterHomotopy<'_>,
        work: &mut Work<f64>,
    ) -> usize {
        let mut added = 0;
        for i in 0..groups.len() {
            let (singular, paths) = (groups[i].singular, groups[i].paths);
            if groups[i].dimension > 0 || self.real(&groups[i].x, singular, work).is_some() {
                continue;
            }
            let conjugate: Vec<C> = groups[i].x.iter().map(|z| z.conj()).collect();
            let near = 1e-5 * (1.0 + size(&conjugate));
            let known = groups.iter().any(|group| match group.singular || singular {
                true => self.coordinates.within(near, &group.x, &conjugate),
                false => are_one(homotopy, END, &group.x, &conjugate),
            });
            if !known {
                added += paths;
                groups.push(Group {
                    x: conjugate,
                    paths,
                    singular,
                    dimension: 0,
                });
            }
        }
        added
    }
}
