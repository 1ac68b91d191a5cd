//! Newton iterations from random complex points.

use super::{BATCH, Search, generator};
use crate::analysis::assemblies::family::{C, learn, size};
use crate::analysis::assemblies::search::newton_starts::{Seed, newton_seeds};
use crate::analysis::assemblies::track::ParameterHomotopy;

impl Search<'_> {
    /// Newton iterations from random complex points at the member where a way starts; the isolated
    /// solutions they ended at. `reach` is that of the member's inputs.
    ///
    /// What seems multiple counts if the simple solutions there are all `known` and it is none of them: far out
    /// rounding makes simple ones look so, for complex rotations grow with every joint.
    pub(super) fn seeds(
        &mut self,
        still: &ParameterHomotopy<'_>,
        reach: f64,
        known: Option<&[Vec<C>]>,
    ) -> Vec<Vec<C>> {
        const BLURRED: f64 = 1e-3;
        let (first, seed) = (self.found.seeds, self.settings.seed);
        let ends = crate::solve::each(BATCH, still, |homotopy, i| {
            let mut rng = generator(seed, 1 + (((first + i) as u64) << 1));
            // most solutions are near, some far out
            let further = [1.0, 2.0, 1.0, 4.0][(first + i) % 4];
            newton_seeds(homotopy, reach * further, &mut rng)
        });
        self.found.seeds += BATCH;
        let mut isolated = Vec::new();
        for end in ends {
            match end {
                Seed::Nothing => {}
                Seed::Multiple(x) => {
                    let near = |y: &Vec<C>| {
                        let limit = BLURRED * (1.0 + size(y));
                        self.family.coordinates.within(limit, &x, y)
                    };
                    let other = known.is_some_and(|known| !known.iter().any(near));
                    self.found.multiple += usize::from(other);
                }
                Seed::Isolated(x) => isolated.push(x),
                Seed::Free(freedom) => {
                    let found = &mut self.found;
                    found.freedom = match found.not_isolated {
                        0 => freedom,
                        _ => found.freedom.min(freedom),
                    };
                    found.not_isolated += 1;
                    found.quiet_seeds += 1;
                }
            }
        }
        isolated
    }

    /// Seeds at the generic member.
    pub(super) fn newton_seeds(&mut self, still: &ParameterHomotopy<'_>) {
        let known = self.spanning();
        for x in self.seeds(still, 1.0, Some(&known)) {
            match learn(&mut self.found.legwise, &self.family.coordinates, &x) {
                true => (self.found.quiet_seeds, self.found.quiet_loops) = (0, 0),
                false => self.found.quiet_seeds += 1,
            }
        }
    }

    /// Seeds at a corner of a loop, where these solutions are known already. Only what is multiple with the
    /// mechanism's `own` dimensions counts.
    pub(super) fn newton_seeds_beside(
        &mut self,
        homotopy: &ParameterHomotopy<'_>,
        (reach, own): (f64, bool),
        points: &mut Vec<Option<Vec<C>>>,
    ) {
        let coordinates = &self.family.coordinates;
        let mut known = Vec::new();
        for x in points.iter().flatten() {
            learn(&mut known, coordinates, x);
        }
        let all: Option<Vec<Vec<C>>> = points.iter().cloned().collect();
        let all = all.filter(|_| own);
        for x in self.seeds(homotopy, reach, all.as_deref()) {
            match learn(&mut known, coordinates, &x) {
                true => {
                    self.found.quiet_seeds = 0;
                    points.push(Some(x));
                }
                false => self.found.quiet_seeds += 1,
            }
        }
    }
}
