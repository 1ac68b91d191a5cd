//! Newton iterations from random complex points.

use super::{MemberSearch, generator};
use crate::analysis::assemblies::family::{C, Coordinates, size};
use crate::analysis::assemblies::search::newton_starts::{Seed, newton_seeds, reached};
use crate::analysis::assemblies::track::{START, stands_alone};
use crate::system::System;

/// Seeds started at once at a node.
const BATCH: usize = 32;

impl MemberSearch<'_> {
    /// True if the solutions are not finite in number: with joints that never come back, or if seeds end at none that
    /// is known already. Were there N in all and known a part m/N of them, n seeds that end at a solution would miss
    /// all known ones with a probability of (1 − m/N)ⁿ: 1 % at 5000 solutions.
    pub(super) fn is_endless(&mut self) -> bool {
        const BATCHES: usize = 4;
        const ENDS: usize = 64;
        let Coordinates {
            screws,
            incommensurate,
            ..
        } = &self.family.coordinates;
        let node = &mut self.nodes[0];
        if !(screws.is_empty() && incommensurate.is_empty()) {
            let mut known = node.shown.iter();
            self.found.endless = known.any(|x| node.still.is_endless(START, x));
        }
        if self.found.endless || self.nodes[0].legwise.len() < self.doubtful {
            return self.found.endless;
        }
        self.doubtful = 2 * self.nodes[0].legwise.len();
        let (mut ends, mut known) = (0, 0);
        for _ in 0..BATCHES {
            for x in self.seeds(0) {
                ends += 1;
                known += usize::from(!self.nodes[0].learn(x).1);
            }
        }
        self.found.endless = ends >= ENDS && known <= ends / ENDS;
        self.found.endless
    }

    /// Newton iterations from random complex points at a node; the isolated solutions they ended at.
    ///
    /// One that seems multiple counts if it is none of the known: far out rounding makes simple ones look so, for complex
    /// rotations grow with every joint.
    fn seeds(&mut self, node: usize) -> Vec<Vec<C>> {
        let (first, seed) = (self.found.search.seeds, self.settings.seed);
        let at = &self.nodes[node];
        let reach = at.reach;
        let ends = crate::solve::each(BATCH, &at.still, |homotopy, i| {
            let mut rng = generator(seed, 1 + (((first + i) as u64) << 1));
            // most solutions are near, some far out
            let further = [1.0, 2.0, 1.0, 4.0, 1.0, 16.0, 2.0, 64.0][(first + i) % 8];
            newton_seeds(homotopy, reach * further, &mut rng)
        });
        self.found.search.seeds += BATCH;
        let mut isolated = Vec::new();
        for end in ends {
            match end {
                Seed::Nothing => {}
                Seed::Multiple(x) => {
                    let near = |y: &Vec<C>| {
                        // to three digits, where rounding blurs them
                        let limit = 1e-3 * (1.0 + size(y));
                        self.family.coordinates.within(limit, &x, y)
                    };
                    let other = self.is_own(node) && !at.shown.iter().any(near);
                    self.found.search.multiple += usize::from(other);
                }
                Seed::Isolated(x) => isolated.push(x),
                Seed::Free(freedom) => {
                    let found = &mut self.found;
                    found.freedom = match found.not_isolated {
                        0 => freedom,
                        _ => found.freedom.min(freedom),
                    };
                    found.not_isolated += 1;
                    found.search.quiet_seeds += 1;
                }
            }
        }
        isolated
    }

    /// Newton iterations for the joints of one leg from random values, with all else as in a known solution of the first
    /// node; true if they found another way to close it.
    pub(super) fn close_legs(&mut self) -> bool {
        const TRIES: usize = 16;
        let node = &mut self.nodes[0];
        let Some(dimensions) = self.family.dimensions(&node.member.parameters) else {
            return false;
        };
        let (coordinates, seed) = (&self.family.coordinates, self.settings.seed);
        if coordinates.legs.len() == 1 && coordinates.free_platforms.is_empty() {
            // seeds have done the same
            return false;
        }
        let known = node.legwise.iter();
        let known: Vec<Vec<C>> = known
            .map(|at_pose| at_pose.spanning_points(coordinates).swap_remove(0))
            .collect();
        let mut new = false;
        for places in &coordinates.legs {
            let system = System::new(&dimensions, &self.family.held_but(places));
            let storage = (system.work(), node.still.clone());
            let ends = crate::solve::each(known.len() * TRIES, &storage, |(work, still), k| {
                // streams beyond those of seeds and nodes
                let stream = (1 << 48) + ((places[0] as u64) << 32) + k as u64;
                let mut x = known[k / TRIES].clone();
                let mut rng = generator(seed, stream);
                let random = still.family.random_point(&mut rng, 1.0);
                places.iter().for_each(|&place| x[place] = random[place]);
                let x = reached(still, Some((&system, work)), &x)?;
                stands_alone(still, START, &x).then_some(x)
            });
            for x in ends.into_iter().flatten() {
                new |= node.learn(x).1;
            }
        }
        new
    }

    pub(super) fn newton_seeds(&mut self, node: usize) {
        for x in self.seeds(node) {
            match self.nodes[node].learn(x).1 {
                true => self.found.search.quiet_seeds = 0,
                false => self.found.search.quiet_seeds += 1,
            }
        }
    }
}
