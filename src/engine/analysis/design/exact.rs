//! Exact synthesis: all mechanisms that meet as many targets as there are unknowns.

use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::search::{FoundEnd, SearchedEnds, Task};
use super::symmetry::{Flip, Symmetries};
use crate::mechanism::turn_near;
use crate::number::tolerance::SAME;
use crate::number::{C, Number};
use crate::solve::monodromy::{Monodromy, ParametricSystem, Spread, followed, place, random};
use crate::solve::{Homotopy, LevenbergMarquardt, Stage, Tracker, Watch, each};
use crate::system::{Bundled, Copies, PathForm};

/// All solutions of an exact synthesis, counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Exact {
    /// Solutions for generic targets.
    pub generic: usize,
    /// These without others that differ by the signs of lengths and half turns of angles only, which are the same linkages.
    pub classes: usize,
    /// Fresh random ways through the targets that brought no other solution.
    pub quiet: usize,
    /// Paths lost on these ways.
    pub lost_quietly: usize,
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
    /// The numbers of that one of these which lies least outside, relative to the size of the task.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_outside: Option<Vec<f64>>,
    /// Classes of cognates, for nine points of a four-bar's coupler curve.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub triples: Option<Triples>,
}

/// Classes of three cognate four-bars with one coupler curve, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Triples {
    /// Those for generic points.
    pub generic: usize,
    /// Different ones that were reached.
    pub different: usize,
    /// Real ones.
    pub real: usize,
}

impl Exact {
    /// Ways from generic targets that are tried where one loses paths.
    pub const WAYS: usize = 4;
}

/// A search for all solutions that did not come to its end: least squares are left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NotAll {
    /// Generic targets have more solutions than are kept.
    More {
        /// The most that are kept.
        than: usize,
    },
    /// Paths were lost on every way through other targets, so that nothing shows that the list is complete.
    Lost {
        /// Solutions for generic targets found so far.
        found: usize,
    },
}

/// The targets as parameters of a family.
struct Synthesis<'t, 'b, 'm> {
    task: &'t Task<'m>,
    copies: Copies<'b, 'm>,
    same: Symmetries,
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

impl<'b, 'm> ParametricSystem for Synthesis<'_, 'b, 'm> {
    type Way<'f>
        = PathForm<'f, 'b, 'm>
    where
        Self: 'f;

    fn count(&self) -> usize {
        self.copies.count()
    }

    fn way(&self, from: &[C], to: &[C]) -> Self::Way<'_> {
        PathForm::new(&self.copies, from.to_vec(), to.to_vec())
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
        self.same.key_of(x)
    }

    fn size(&self, x: &[C]) -> f64 {
        let angles = self.task.angles.iter().copied();
        let joints = self.task.mechanism.joints().iter();
        let joints: Vec<bool> = joints.map(|joint| joint.kind.is_angle()).collect();
        let platforms = 7 * self.task.mechanism.platforms().len();
        let of_place = (joints.iter().copied()).chain(std::iter::repeat_n(false, platforms));
        let of_places = std::iter::repeat_n(of_place, self.task.positions).flatten();
        let sizes = x.iter().zip(angles.chain(of_places));
        let sizes = sizes.map(|(x, angle)| match angle {
            true => Number::exp(x.im.abs().min(100.0)),
            false => x.norm_sqr().sqrt(),
        });
        sizes.fold(0.0, |a, b| if b <= a { a } else { b })
    }
}

impl Task<'_> {
    /// All exact solutions, as far as the search came before it was stopped; `None` if there are not as many targets as unknowns.
    ///
    /// # Errors
    /// If the search for generic solutions found more than it keeps, or lost paths on every way.
    pub fn exact(
        &self,
        most: usize,
        watch: &Watch,
    ) -> Result<Option<(Exact, SearchedEnds)>, NotAll> {
        if let Some(found) = self.nine_points(watch) {
            return Ok(Some(found));
        }
        let Some(copies) = Copies::new(&self.bundle, self.positions) else {
            return Ok(None);
        };
        let mut synthesis = Synthesis {
            task: self,
            copies,
            same: Symmetries::none(&self.angles, self.mechanism.joints().len(), self.positions),
        };
        let settings = Monodromy {
            seed: self.seed,
            most,
            ..Monodromy::default()
        };
        let mut rng = <Pcg64 as rand::SeedableRng>::seed_from_u64(self.seed);
        let Some((member, x)) = synthesis.generic(&mut rng) else {
            return Ok(None);
        };
        let mut way = synthesis.way(&member, &member);
        let mut same = synthesis.same.clone();
        same.find(self.mechanism, &x, |x| way.residual(C::from_f64(0.0), x));
        drop(way);
        synthesis.same = same;
        let spread = settings.spread(&synthesis, &member, x, watch);
        let found = spread.solutions.len();
        if watch.is_stopped() {
            let exact = Exact {
                classes: found,
                ..Exact::default()
            };
            let searched = SearchedEnds {
                interrupted: true,
                ..SearchedEnds::default()
            };
            return Ok(Some((exact, searched)));
        }
        if found > most {
            return Err(NotAll::More { than: most });
        }
        if spread.quiet == 0 {
            return Err(NotAll::Lost { found });
        }
        synthesis.same.exchange(&spread.solutions);
        Ok(Some(synthesis.at_targets(&spread, &mut rng, watch)))
    }
}

impl Synthesis<'_, '_, '_> {
    /// Solutions for the targets of the task, from those for generic ones.
    fn at_targets(&self, spread: &Spread, rng: &mut Pcg64, watch: &Watch) -> (Exact, SearchedEnds) {
        let values = self.copies.values();
        let count = spread.solutions.len();
        let tracker = Tracker {
            largest: 1e6,
            ..Tracker::default()
        };
        let mut exact = Exact {
            generic: count * self.same.group.len(),
            classes: count / self.same.exchanges.len(),
            quiet: spread.quiet,
            lost_quietly: spread.lost_quietly,
            ..Exact::default()
        };
        // different keys, with all points that have them
        let mut known: Vec<Vec<C>> = Vec::new();
        let mut different: Vec<Vec<Vec<C>>> = Vec::new();
        let mut members = vec![&spread.member[..], &values[..]];
        let mut middle;
        for way in 0..Exact::WAYS {
            let ends = each(count, &(), |(), i| {
                if watch.stops(Stage::Paths, i, Some(count)) {
                    return Err(false);
                }
                let start = &spread.solutions[i];
                let first = followed(self, &members, start, &tracker, watch);
                first.or_else(|_| followed(self, &members, start, &tracker.tightened(0.03), watch))
            });
            let (mut arrived, mut at_infinity) = (0, 0);
            for end in ends {
                match end {
                    Ok(x) => {
                        arrived += 1;
                        let key = self.key(&x);
                        match place(&known, &key) {
                            Some(place) => different[place].push(x),
                            None => {
                                known.push(key);
                                different.push(vec![x]);
                            }
                        }
                    }
                    Err(infinite) => at_infinity += usize::from(infinite),
                }
            }
            if way == 0 || arrived + at_infinity > exact.arrived + exact.at_infinity {
                (exact.arrived, exact.at_infinity) = (arrived, at_infinity);
            }
            exact.lost = count - exact.arrived - exact.at_infinity;
            if exact.lost == 0 || watch.is_stopped() {
                break;
            }
            // what one way loses another one may bring
            middle = self.member(rng);
            members = vec![&spread.member, &middle, &values];
        }
        let mut searched = SearchedEnds::default();
        for alike in &different {
            exact.different += 1;
            self.real(alike, &mut exact, &mut searched);
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

    /// Takes in a solution if it is real: of those that differ by signs and half turns the first that lies in the ranges, and each
    /// exchange.
    fn real(&self, alike: &[Vec<C>], exact: &mut Exact, searched: &mut SearchedEnds) {
        let is_real = |x: &[C]| {
            let size = x.iter().map(|x| x.norm_sqr()).fold(1.0, f64::max).sqrt();
            x.iter().all(|x| x.im.abs() <= SAME * size)
        };
        if !alike.iter().any(|x| is_real(x)) {
            return;
        }
        exact.real += 1;
        let within = |at: &Bundled| {
            let mut pairs = at.numbers.iter().zip(&self.task.ranges);
            pairs.all(|(x, (low, high))| (*low..=*high).contains(x))
        };
        let image = |x: &Vec<C>, flip: &Flip| {
            let mut at = self.copies.real(&self.same.flipped(x, flip));
            // an angle is in its range after whole turns
            let angles = self.task.angles.iter().zip(&self.task.ranges);
            for (x, (angle, (low, high))) in at.numbers.iter_mut().zip(angles) {
                if *angle {
                    *x = turn_near(*x, 0.5 * (low + high));
                }
            }
            at
        };
        let beyond = |numbers: &[f64]| {
            let all = numbers.iter().zip(&self.task.ranges).zip(&self.task.angles);
            let parts = all.map(|((x, (low, high)), angle)| {
                let unit = if *angle { 1.0 } else { self.task.size };
                (low - x).max(x - high).max(0.0) / unit
            });
            parts.sum::<f64>()
        };
        let polish = LevenbergMarquardt {
            damping: 0.0,
            tolerance: 1e-13,
            steps: 10,
        };
        let class = exact.real;
        let first = searched.found.len();
        for x in alike.iter().filter(|x| is_real(x)) {
            let mut images = self.same.group.iter().map(|flip| image(x, flip));
            let Some(at) = images.find(within) else {
                continue;
            };
            let end = polish.solve(&self.task.bundle, at);
            let mut known = searched.found[first..].iter();
            if !known.any(|of| self.task.same(&of.at, &end.point)) {
                searched.found.push(FoundEnd {
                    at: end.point,
                    squares: end.misfit.squares,
                    reached: 1,
                    finished: true,
                    class,
                });
            }
        }
        if searched.found.len() == first {
            exact.outside += 1;
            let real = alike.iter().filter(|x| is_real(x));
            let images =
                real.flat_map(|x| self.same.group.iter().map(|flip| image(x, flip).numbers));
            let all = images.chain(exact.least_outside.take());
            exact.least_outside = all.min_by(|a, b| beyond(a).total_cmp(&beyond(b)));
        }
    }
}
