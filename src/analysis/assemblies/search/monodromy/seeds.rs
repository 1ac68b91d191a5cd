//! Newton iterations from random complex points.

use super::{BATCH, Search, generator};
use crate::analysis::assemblies::family::{C, learn, size};
use crate::analysis::assemblies::search::newton_starts::{Seed, newton, newton_seeds, solution};
use crate::analysis::assemblies::track::{ParameterHomotopy, stands_alone};
use crate::number::Number;
use crate::system::System;

impl Search<'_> {
    /// Newton iterations from random complex points at the member where a way starts; the isolated
    /// solutions they ended at. `reach` is that of the member's inputs.
    ///
    /// A solution that seems multiple counts if the simple solutions there are all `known` and it is none of them: far
    /// out rounding makes simple ones look so, for complex rotations grow with every joint.
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

    /// Newton iterations from points about as far out as paths are followed; true if one of them ended at a solution
    /// that
    /// is new. Where angles are nearly imaginary neither seeds nor loops nearer in may lead to it.
    pub(super) fn look_far_out(&mut self, still: &ParameterHomotopy<'_>) -> bool {
        const TRIES: usize = 512;
        const REACH: f64 = 64.0;
        let (seed, loops) = (self.settings.seed, self.found.loops as u64);
        let ends = crate::solve::each(TRIES, still, |homotopy, k| {
            // streams beyond those of seeds and loops
            let mut rng = generator(seed, (1 << 47) + (loops << 16) + k as u64);
            newton_seeds(homotopy, REACH, &mut rng)
        });
        let mut new = false;
        for end in ends {
            if let Seed::Isolated(x) = end {
                new |= learn(&mut self.found.legwise, &self.family.coordinates, &x);
            }
        }
        if new {
            self.found.quiet_loops = 0;
        }
        new
    }

    /// Newton iterations for the joints of one leg from random values, with all else as in a known
    /// solution; true if they found another way to close it.
    pub(super) fn close_legs(&mut self, still: &ParameterHomotopy<'_>) -> bool {
        const TRIES: u64 = 16;
        let Some(dimensions) = self.family.dimensions(&self.base.parameters) else {
            return false;
        };
        let (coordinates, seed) = (&self.family.coordinates, self.settings.seed);
        if coordinates.legs.len() == 1 && coordinates.free_platforms.is_empty() {
            // seeds have done the same
            return false;
        }
        let known: Vec<Vec<C>> = (self.found.legwise.iter())
            .map(|solutions_at_pose| {
                solutions_at_pose
                    .spanning_points(coordinates)
                    .swap_remove(0)
            })
            .collect();
        let mut new = false;
        for places in &coordinates.legs {
            let system = System::new(&dimensions, &self.family.held_but(places));
            let storage = (system.work(), still.clone());
            let tries = known.len() as u64 * TRIES;
            let ends = crate::solve::each(tries as usize, &storage, |(work, homotopy), k| {
                // streams beyond those of seeds and loops
                let stream = (1 << 48) + ((places[0] as u64) << 32) + k as u64;
                let mut x = known[k / TRIES as usize].clone();
                let mut rng = generator(seed, stream);
                let random = homotopy.family.random_point(&mut rng, 1.0);
                places.iter().for_each(|&place| x[place] = random[place]);
                homotopy.linearise(C::from_f64(0.0), &x);
                let mut point = homotopy.here.at.clone();
                let mut trial = point.clone();
                let report = newton().solve(&system, &mut point, &mut trial, work);
                let x = solution(homotopy, &report, &point)?;
                stands_alone(homotopy, C::from_f64(0.0), &x).then_some(x)
            });
            for x in ends.into_iter().flatten() {
                new |= learn(&mut self.found.legwise, coordinates, &x);
            }
        }
        if new {
            self.found.quiet_loops = 0;
        }
        new
    }
}
