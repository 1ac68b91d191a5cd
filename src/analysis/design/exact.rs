//! Exact synthesis: all mechanisms that meet as many targets as there are unknowns.

use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::search::{Found, Searched, Task};
use crate::mechanism::turn_near;
use crate::number::{Complex, Number};
use crate::solve::monodromy::{Family, Monodromy, Spread, followed, place, random};
use crate::solve::{Homotopy, LevenbergMarquardt, Stage, Tracker, Watch, each};
use crate::system::{Along, Bundled, Copies};

type C = Complex<f64>;

/// All solutions of an exact synthesis, counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Exact {
    /// Solutions for generic targets.
    pub generic: usize,
    /// These without others that differ by the signs of lengths and half turns of angles only, which are the same linkages.
    pub classes: usize,
    /// Fresh random ways through the targets that brought no other solution.
    pub quiet: usize,
    /// Paths that arrived at the targets.
    pub arrived: usize,
    /// Different solutions to which they led, each linkage once.
    pub different: usize,
    /// Paths that went to infinity.
    pub at_infinity: usize,
    /// Paths that were lost.
    pub lost: usize,
    /// Different real solutions.
    pub real: usize,
    /// Real solutions outside of the ranges.
    pub outside: usize,
}

/// The targets as parameters of a family.
struct Synthesis<'t, 'b, 'm> {
    task: &'t Task<'m>,
    copies: Copies<'b, 'm>,
    /// Changes under which a linkage stays the same: all of a group, the first of which changes nothing.
    group: Vec<Flip>,
}

/// A change of the signs of lengths, and half turns of angles and joints.
#[derive(Clone, Debug, PartialEq)]
struct Flip {
    numbers: Vec<bool>,
    joints: Vec<bool>,
}

impl Flip {
    fn after(&self, other: &Flip) -> Flip {
        let both = |a: &[bool], b: &[bool]| a.iter().zip(b).map(|(a, b)| a ^ b).collect();
        Flip {
            numbers: both(&self.numbers, &other.numbers),
            joints: both(&self.joints, &other.joints),
        }
    }
}

impl Synthesis<'_, '_, '_> {
    /// A random complex mechanism in random configurations that close.
    fn point(&self, rng: &mut Pcg64) -> Option<Vec<C>> {
        let size = self.task.size;
        let near = |x: f64, by: f64, rng: &mut Pcg64| C::from_f64(x) + random(rng) * by;
        let file = self.task.bundle.file();
        let numbers = file
            .iter()
            .zip(&self.task.angles)
            .map(|(x, angle)| match angle {
                true => near(*x, 1.5, rng),
                false => near(*x, 0.4 * x.abs().max(0.5 * size), rng),
            });
        let numbers: Vec<C> = numbers.collect();
        let mechanism = self.task.mechanism;
        let mut configurations = Vec::new();
        for _ in 0..self.task.positions {
            let mut tries = 0;
            let closed = loop {
                let mut at = mechanism.home().map(C::from_f64);
                for (x, joint) in at.joints.iter_mut().zip(mechanism.joints()) {
                    *x += match joint.kind.is_angle() {
                        true => C::new(
                            std::f64::consts::PI * (2.0 * rng.random::<f64>() - 1.0),
                            0.6 * (2.0 * rng.random::<f64>() - 1.0),
                        ),
                        false => random(rng) * (0.3 * size),
                    };
                }
                match self.copies.closed(&numbers, at) {
                    Some(at) => break at,
                    None if tries < 20 => tries += 1,
                    None => return None,
                }
            };
            configurations.push(closed);
        }
        Some(self.copies.flat(&numbers, &configurations))
    }

    fn generic(&self, rng: &mut Pcg64) -> Option<(Vec<C>, Vec<C>)> {
        (0..50).find_map(|_| {
            let x = self.point(rng)?;
            Some((self.copies.values_at(&x)?, x))
        })
    }
}

impl<'b, 'm> Family for Synthesis<'_, 'b, 'm> {
    type Way<'f>
        = Along<'f, 'b, 'm>
    where
        Self: 'f;

    fn count(&self) -> usize {
        self.copies.count()
    }

    fn way(&self, from: &[C], to: &[C]) -> Self::Way<'_> {
        Along::new(&self.copies, from.to_vec(), to.to_vec())
    }

    fn member(&self, rng: &mut Pcg64) -> Vec<C> {
        match self.generic(rng) {
            Some((values, _)) => values,
            None => self
                .copies
                .values()
                .iter()
                .map(|x| x + random(rng))
                .collect(),
        }
    }

    /// The numbers, angles as points of the unit circle; of all linkages that are the same the one furthest in a direction without
    /// meaning.
    fn key(&self, x: &[C]) -> Vec<C> {
        let numbers = x.iter().zip(&self.task.angles);
        let key = numbers.map(|(x, angle)| match angle {
            true => Number::exp(*x * C::new(0.0, 1.0)),
            false => *x,
        });
        let key: Vec<C> = key.collect();
        let images = self.group.iter().map(|flip| {
            let pairs = key.iter().zip(&flip.numbers);
            let image: Vec<C> = pairs
                .map(|(x, flip)| if *flip { -*x } else { *x })
                .collect();
            let parts = image.iter().enumerate();
            let along = parts.map(|(i, x)| {
                let weight = 1.0 + (0.618_034 * (i + 1) as f64).fract();
                (x.re + 0.37 * x.im) * weight
            });
            (along.sum::<f64>(), image)
        });
        let furthest = images.max_by(|a, b| a.0.total_cmp(&b.0));
        furthest.map_or(key, |(_, image)| image)
    }
}

impl Task<'_> {
    /// All exact solutions; `None` if there are not as many targets as unknowns, or the search for generic solutions found more
    /// than it keeps or was stopped.
    pub fn exact(&self, most: usize, watch: &Watch) -> Option<(Exact, Searched)> {
        let count = self.angles.len();
        let nothing = Flip {
            numbers: vec![false; count],
            joints: vec![false; self.mechanism.joints().len()],
        };
        let mut synthesis = Synthesis {
            task: self,
            copies: Copies::new(&self.bundle, self.positions)?,
            group: vec![nothing],
        };
        let settings = Monodromy {
            seed: self.seed,
            most,
            ..Monodromy::default()
        };
        let mut rng = <Pcg64 as rand::SeedableRng>::seed_from_u64(self.seed);
        let (member, x) = synthesis.generic(&mut rng)?;
        synthesis.group = synthesis.symmetries(&member, &x);
        let spread = settings.spread(&synthesis, &member, x, watch);
        if spread.quiet == 0 {
            return None;
        }
        Some(synthesis.at_targets(&spread, &mut rng, watch))
    }
}

impl Synthesis<'_, '_, '_> {
    /// Solutions for the targets of the task, from those for generic ones.
    fn at_targets(&self, spread: &Spread, rng: &mut Pcg64, watch: &Watch) -> (Exact, Searched) {
        let values = self.copies.values();
        let middle = self.member(rng);
        let count = spread.solutions.len();
        let tracker = Tracker {
            largest: 1e6,
            ..Tracker::default()
        };
        let direct = [&spread.member[..], &values[..]];
        let round = [&spread.member[..], &middle[..], &values[..]];
        let ends = each(count, &(), |(), i| {
            if watch.stops(Stage::Paths, i, Some(count)) {
                return Err(false);
            }
            let start = &spread.solutions[i];
            let first = followed(self, &direct, start, &tracker, watch);
            first.or_else(|_| followed(self, &direct, start, &tracker.tightened(0.03), watch))
        });
        let mut exact = Exact {
            generic: count * self.group.len(),
            classes: count,
            quiet: spread.quiet,
            ..Exact::default()
        };
        let mut known: Vec<Vec<C>> = Vec::new();
        let mut different: Vec<Vec<C>> = Vec::new();
        let mut missing = false;
        let mut add = |x: Vec<C>, known: &mut Vec<Vec<C>>| {
            let key = self.key(&x);
            if place(known, &key).is_none() {
                known.push(key);
                different.push(x);
            }
        };
        for end in &ends {
            match end {
                Ok(x) => {
                    exact.arrived += 1;
                    add(x.clone(), &mut known);
                }
                Err(true) => exact.at_infinity += 1,
                Err(false) => {
                    exact.lost += 1;
                    missing = true;
                }
            }
        }
        // what one way loses another one may bring
        if missing && !watch.is_stopped() {
            let again = each(count, &(), |(), i| {
                followed(self, &round, &spread.solutions[i], &tracker, watch).ok()
            });
            again.into_iter().flatten().for_each(|x| add(x, &mut known));
        }
        let mut searched = Searched::default();
        for x in &different {
            exact.different += 1;
            self.real(x, &mut exact, &mut searched);
        }
        searched.found.sort_by(|a, b| {
            let pairs = a.at.numbers.iter().zip(&b.at.numbers);
            let mut orders = pairs.map(|(a, b)| a.total_cmp(b));
            orders
                .find(|order| order.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        searched.interrupted = watch.is_stopped();
        (exact, searched)
    }

    /// Takes in a solution if it is real: of those that are the same linkage the first that lies in the ranges.
    fn real(&self, x: &[C], exact: &mut Exact, searched: &mut Searched) {
        const REAL: f64 = 1e-7;
        let size = x.iter().map(|x| x.norm_sqr()).fold(1.0, f64::max).sqrt();
        if x.iter().any(|x| x.im.abs() > REAL * size) {
            return;
        }
        exact.real += 1;
        let within = |at: &Bundled| {
            let mut pairs = at.numbers.iter().zip(&self.task.ranges);
            pairs.all(|(x, (low, high))| (*low..=*high).contains(x))
        };
        let mut images = self.group.iter().map(|flip| {
            let mut at = self.copies.real(&self.flipped(x, flip));
            // an angle is in its range after whole turns
            let angles = self.task.angles.iter().zip(&self.task.ranges);
            for (x, (angle, (low, high))) in at.numbers.iter_mut().zip(angles) {
                if *angle {
                    *x = turn_near(*x, 0.5 * (low + high));
                }
            }
            at
        });
        let Some(at) = images.find(within) else {
            exact.outside += 1;
            return;
        };
        let polish = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 10,
        };
        let end = polish.solve(&self.task.bundle, at);
        searched.starts += 1;
        searched.found.push(Found {
            at: end.point,
            squares: end.misfit.squares,
            reached: 1,
        });
    }

    /// A flat point with other signs of lengths and half turns.
    fn flipped(&self, x: &[C], flip: &Flip) -> Vec<C> {
        let half = C::from_f64(std::f64::consts::PI);
        let count = flip.numbers.len();
        let mut x = x.to_vec();
        let (numbers, rest) = x.split_at_mut(count);
        let parts = numbers.iter_mut().zip(&flip.numbers).zip(&self.task.angles);
        for ((x, _), angle) in parts.filter(|((_, flip), _)| **flip) {
            *x = if *angle { *x + half } else { -*x };
        }
        let width = (rest.len() / self.task.positions).max(1);
        for x in rest.chunks_exact_mut(width) {
            for (x, _) in x.iter_mut().zip(&flip.joints).filter(|(_, flip)| **flip) {
                *x += half;
            }
        }
        x
    }

    /// The changes that carry a generic solution to another one of the same member. They are the same for all its solutions: each
    /// is a map of the equations to themselves.
    fn symmetries(&self, member: &[C], x: &[C]) -> Vec<Flip> {
        /// Bits at most: each change is tried at one point.
        const MOST: usize = 12;
        const CLOSED: f64 = 1e-9;
        let joints = self.task.mechanism.joints().iter();
        let turns: Vec<bool> = joints.map(|joint| joint.kind.is_angle()).collect();
        let places: Vec<usize> = (0..turns.len()).filter(|i| turns[*i]).collect();
        let numbers = self.task.angles.len();
        let mut group = self.group.clone();
        if numbers + places.len() > MOST || !self.task.mechanism.platforms().is_empty() {
            return group;
        }
        let mut way = self.way(member, member);
        for mask in 1..1usize << (numbers + places.len()) {
            let mut flip = Flip {
                numbers: (0..numbers).map(|i| mask >> i & 1 == 1).collect(),
                joints: vec![false; turns.len()],
            };
            for (bit, joint) in places.iter().enumerate() {
                flip.joints[*joint] = mask >> (numbers + bit) & 1 == 1;
            }
            let known = group.iter().any(|of| of.numbers == flip.numbers);
            if known || !flip.numbers.contains(&true) {
                continue;
            }
            if way.residual(C::from_f64(0.0), &self.flipped(x, &flip)) < CLOSED {
                let more: Vec<Flip> = group.iter().map(|of| of.after(&flip)).collect();
                group.extend(more);
            }
        }
        group
    }
}
