//! All solutions of one member of a family, spread by monodromy from one of them.
//!
//! Two generic members are joined by several random ways. What is known at one is followed along every way to the other and
//! back, until every way carries all that is known at one to what is known at the other (the graph of Duff, Hill, Jensen, Lee,
//! Leykin and Sommars 2019). Then fresh ways must bring nothing new. If only part of the solutions that belong together is
//! known, a random way brings something new with probability ½ at least, as those that do not make up a proper subgroup.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::homotopy::{Arrival, Homotopy, Stages, Tracker};
use super::threads::each;
use super::{Progress, Stage, Watch};
use crate::number::C;
use crate::number::tolerance::SAME;

/// Square systems with parameters.
pub trait ParametricSystem: Sync {
    /// The way between two members.
    type Way<'f>: Homotopy
    where
        Self: 'f;
    /// Number of coordinates of a point.
    fn count(&self) -> usize;
    /// The straight way between two members.
    fn way(&self, from: &[C], to: &[C]) -> Self::Way<'_>;
    /// A random member.
    fn member(&self, rng: &mut Pcg64) -> Vec<C>;
    /// Numbers that tell solutions apart; the same for those that are one.
    fn key(&self, x: &[C]) -> Vec<C>;
    /// Size of a point, by which one that goes to infinity is told.
    fn size(&self, x: &[C]) -> f64 {
        x.iter().map(|x| x.norm_sqr()).fold(0.0, f64::max).sqrt()
    }
}

/// All known solutions of a generic member.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spread {
    /// The parameters of the member.
    pub member: Vec<C>,
    /// Its solutions.
    pub solutions: Vec<Vec<C>>,
    /// Fresh random ways that carried the known solutions to known ones.
    pub quiet: usize,
    /// Paths lost on these ways, which is allowed among many.
    pub lost_quietly: usize,
    /// Paths lost on the way.
    pub lost: usize,
}

/// Settings of a search by monodromy.
#[derive(Clone, Debug, PartialEq)]
pub struct Monodromy {
    /// Seed of all that is random.
    pub seed: u64,
    /// Ways in the graph.
    pub ways: usize,
    /// Fresh ways that must bring nothing new.
    pub quiet: usize,
    /// Solutions at most; more are given up.
    pub most: usize,
    /// Tolerances.
    pub tracker: Tracker,
}

impl Default for Monodromy {
    fn default() -> Self {
        Monodromy {
            seed: 1,
            ways: 4,
            quiet: 6,
            most: 20_000,
            tracker: Tracker::default(),
        }
    }
}

/// Known solutions of one member, found again by a random projection of their keys.
#[derive(Default)]
struct KnownSolutions {
    solutions: Vec<Vec<C>>,
    keys: Vec<Vec<C>>,
}

impl KnownSolutions {
    /// The number of a solution, and true if it is new.
    fn place<F: ParametricSystem>(&mut self, family: &F, x: Vec<C>) -> (usize, bool) {
        let key = family.key(&x);
        if let Some(place) = place(&self.keys, &key) {
            return (place, false);
        }
        self.solutions.push(x);
        self.keys.push(key);
        (self.keys.len() - 1, true)
    }
}

/// The place of a key among others: no part differs by more than this from it, relative to its size.
pub fn place(keys: &[Vec<C>], key: &[C]) -> Option<usize> {
    let size = key.iter().map(|x| x.norm_sqr()).fold(1.0, f64::max).sqrt();
    let near = |other: &Vec<C>| {
        let mut parts = other.iter().zip(key);
        parts.all(|(a, b)| (a - b).norm_sqr() <= (SAME * size) * (SAME * size))
    };
    keys.iter().position(near)
}

/// The end of a path through members, polished; `None` if it was lost, and true if it went to infinity.
pub fn followed<F: ParametricSystem>(
    family: &F,
    members: &[&[C]],
    start: &[C],
    tracker: &Tracker,
    watch: &Watch,
) -> Result<Vec<C>, bool> {
    let mut x = start.to_vec();
    let (zero, one) = (C::new(0.0, 0.0), C::new(1.0, 0.0));
    let mut stages = Stages::new(family.count(), (watch, Progress::of(Stage::Paths)));
    for pair in members.windows(2) {
        let mut way = family.way(pair[0], pair[1]);
        match tracker
            .track(&mut way, (zero, one), &mut x, &mut stages)
            .arrival
        {
            Arrival::There => {}
            Arrival::Diverged(_) => return Err(true),
            // towards the end of a path a solution goes to infinity or meets another one
            Arrival::Stuck(done) => {
                return Err(done > 0.9 && family.size(&x) > 1e3);
            }
        }
    }
    if let [.., last] = members {
        let mut end = family.way(last, last);
        let mut before = f64::INFINITY;
        for _ in 0..8 {
            let step = end.correct(one, &mut x);
            if !step.is_finite() {
                return Err(false);
            }
            // what rounding leaves of an ill-conditioned solution is less than what tells two apart
            if step < 1e-13 || step >= 0.5 * before && step < 0.1 * SAME {
                return Ok(x);
            }
            before = step;
        }
        return Err(false);
    }
    Ok(x)
}

impl Monodromy {
    fn ends<F: ParametricSystem>(
        &self,
        family: &F,
        members: [&[C]; 3],
        starts: &[&Vec<C>],
        watch: &Watch,
    ) -> Vec<Option<Vec<C>>> {
        each(starts.len(), &(), |(), i| {
            let first = followed(family, &members, starts[i], &self.tracker, watch);
            let again = || {
                let tight = self.tracker.tightened(0.05);
                followed(family, &members, starts[i], &tight, watch)
            };
            first.or_else(|_| again()).ok()
        })
    }

    /// Spreads a solution of a member.
    pub fn spread<F: ParametricSystem>(
        &self,
        family: &F,
        member: &[C],
        solution: Vec<C>,
        watch: &Watch,
    ) -> Spread {
        let mut rng = Pcg64::seed_from_u64(self.seed ^ 0x6d6f_6e6f);
        let other = family.member(&mut rng);
        let ends = [member, &other[..]];
        let mut ways: Vec<Vec<C>> = (0..self.ways).map(|_| family.member(&mut rng)).collect();
        let mut known = [KnownSolutions::default(), KnownSolutions::default()];
        known[0].place(family, solution);
        // for each way and end what was followed along it
        let mut done: Vec<[Vec<bool>; 2]> = vec![[Vec::new(), Vec::new()]; ways.len()];
        let (mut lost, mut quiet, mut lost_quietly) = (0, 0, 0);
        loop {
            let mut new = false;
            let mut moved = false;
            for (way, done) in ways.iter().zip(&mut done) {
                for end in [0, 1] {
                    let now = Progress {
                        done: known[0].keys.len(),
                        ..Progress::of(Stage::Loops {
                            found: known[0].keys.len(),
                        })
                    };
                    if watch.at(now).is_break() || known[0].keys.len() > self.most {
                        return Spread {
                            member: member.to_vec(),
                            solutions: std::mem::take(&mut known[0].solutions),
                            quiet: 0,
                            lost_quietly: 0,
                            lost,
                        };
                    }
                    let [here, there] = [end, 1 - end];
                    done[here].resize(known[here].keys.len(), false);
                    let waiting: Vec<usize> =
                        (0..done[here].len()).filter(|i| !done[here][*i]).collect();
                    if waiting.is_empty() {
                        continue;
                    }
                    moved = true;
                    let starts: Vec<&Vec<C>> =
                        waiting.iter().map(|i| &known[here].solutions[*i]).collect();
                    let members = [ends[here], &way[..], ends[there]];
                    let arrived = self.ends(family, members, &starts, watch);
                    for (i, end) in waiting.into_iter().zip(arrived) {
                        done[here][i] = true;
                        let Some(x) = end else {
                            lost += 1;
                            continue;
                        };
                        let (place, is_new) = known[there].place(family, x);
                        new |= is_new;
                        let size = known[there].keys.len();
                        done[there].resize(size, false);
                        done[there][place] = true;
                    }
                }
            }
            if moved {
                if new {
                    (quiet, lost_quietly) = (0, 0);
                }
                continue;
            }
            if quiet >= self.quiet {
                break;
            }
            // all ways agree: a fresh one
            let fresh = family.member(&mut rng);
            let starts: Vec<&Vec<C>> = known[0].solutions.iter().collect();
            let arrived = self.ends(family, [ends[0], &fresh[..], ends[1]], &starts, watch);
            let missing = arrived.iter().filter(|end| end.is_none()).count();
            let mut brought = false;
            for x in arrived.into_iter().flatten() {
                brought |= known[1].place(family, x).1;
            }
            match (brought, missing) {
                (true, _) => {
                    (quiet, lost_quietly) = (0, 0);
                    ways.push(fresh);
                    done.push([Vec::new(), Vec::new()]);
                }
                (false, 0) => quiet += 1,
                (false, missing) => {
                    lost += missing;
                    // where paths are lost over and over nothing is gained by more of them
                    if lost > 10 * (self.quiet + known[0].keys.len()) {
                        break;
                    }
                    if known[0].keys.len() > 500 {
                        quiet += 1;
                        lost_quietly += missing;
                    }
                }
            }
        }
        let [first, _] = known;
        Spread {
            member: member.to_vec(),
            solutions: first.solutions,
            quiet,
            lost_quietly,
            lost,
        }
    }
}

/// A random complex number with parts in (−1, 1).
pub fn random(rng: &mut Pcg64) -> C {
    let mut part = || 2.0 * rng.random::<f64>() - 1.0;
    C::new(part(), part())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x⁵ + a x² + b x + c = 0, whose group is that of all permutations.
    struct Quintic;

    struct QuinticPath(Vec<C>, Vec<C>);

    fn value(p: &[C], x: C) -> (C, C) {
        let (x2, x4) = (x * x, x * x * x * x);
        (
            x4 * x + p[0] * x2 + p[1] * x + p[2],
            x4 * 5.0 + p[0] * x * 2.0 + p[1],
        )
    }

    impl QuinticPath {
        fn at(&self, s: C) -> Vec<C> {
            let pairs = self.0.iter().zip(&self.1);
            pairs.map(|(a, b)| *a + s * (*b - *a)).collect()
        }
    }

    impl Homotopy for QuinticPath {
        fn settle(&self, _: &mut [C]) {}
        fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
            let d: Vec<C> = self.0.iter().zip(&self.1).map(|(a, b)| b - a).collect();
            let slope = value(&self.at(s), x[0]).1;
            out[0] = -(d[0] * x[0] * x[0] + d[1] * x[0] + d[2]) / slope;
            out[0].re.is_finite()
        }
        fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
            let (value, slope) = value(&self.at(s), x[0]);
            x[0] -= value / slope;
            (value / slope).norm_sqr().sqrt()
        }
        fn residual(&mut self, s: C, x: &[C]) -> f64 {
            value(&self.at(s), x[0]).0.norm_sqr().sqrt()
        }
    }

    impl ParametricSystem for Quintic {
        type Way<'f> = QuinticPath;
        fn count(&self) -> usize {
            1
        }
        fn way(&self, from: &[C], to: &[C]) -> QuinticPath {
            QuinticPath(from.to_vec(), to.to_vec())
        }
        fn member(&self, rng: &mut Pcg64) -> Vec<C> {
            (0..3).map(|_| random(rng) * 3.0).collect()
        }
        fn key(&self, x: &[C]) -> Vec<C> {
            x.to_vec()
        }
    }

    #[test]
    fn all_roots_of_a_quintic_come_from_one() {
        // (x − 1)(…): c = −1 − a − b
        let (a, b) = (C::new(0.3, 1.1), C::new(-0.7, 0.4));
        let member = [a, b, -C::new(1.0, 0.0) - a - b];
        let found =
            Monodromy::default().spread(&Quintic, &member, vec![C::new(1.0, 0.0)], &Watch::none());
        assert_eq!((found.solutions.len(), found.quiet), (5, 6));
        let mut sum = C::new(0.0, 0.0);
        for x in &found.solutions {
            assert!(value(&member, x[0]).0.norm_sqr() < 1e-20);
            sum += x[0];
        }
        // no fourth power
        assert!(sum.norm_sqr() < 1e-20);
    }
}
