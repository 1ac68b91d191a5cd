//! Changes under which a linkage stays the same: of the signs of lengths, of the senses of axes, and exchanges of links.

use crate::mechanism::Mechanism;
use crate::number::tolerance::{ROUNDING, SAME};
use crate::number::{C, Number};
use crate::solve::monodromy::place;

/// A change of numbers and joints.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flip {
    numbers: Vec<Sense>,
    joints: Vec<Sense>,
}

/// A change of one number: another sign, and for an angle half a turn. Angles change where an axis is reversed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sense {
    negated: bool,
    half: bool,
}

impl Sense {
    fn of(bits: usize) -> Self {
        Sense {
            negated: bits & 1 == 1,
            half: bits & 2 == 2,
        }
    }

    fn after(self, other: Sense) -> Sense {
        Sense {
            negated: self.negated ^ other.negated,
            half: self.half ^ other.half,
        }
    }

    fn changed(self, x: C) -> C {
        let x = if self.negated { -x } else { x };
        match self.half {
            true => x + C::from_f64(std::f64::consts::PI),
            false => x,
        }
    }

    /// The part of a key that belongs to the changed number: an angle is a point of the unit circle there.
    fn of_key(self, x: C, angle: bool) -> C {
        match (angle, self.negated, self.half) {
            (true, true, half) => C::from_f64(if half { -1.0 } else { 1.0 }) / x,
            (true, false, true) | (false, true, _) => -x,
            _ => x,
        }
    }
}

impl Flip {
    fn after(&self, other: &Flip) -> Flip {
        let both = |a: &[Sense], b: &[Sense]| a.iter().zip(b).map(|(a, b)| a.after(*b)).collect();
        Flip {
            numbers: both(&self.numbers, &other.numbers),
            joints: both(&self.joints, &other.joints),
        }
    }

    /// The numbers of a key after the change.
    fn of(&self, key: &[C], angles: &[bool]) -> Vec<C> {
        let parts = key.iter().zip(&self.numbers).zip(angles);
        parts
            .map(|((x, sense), angle)| sense.of_key(*x, *angle))
            .collect()
    }
}

fn exchanged(key: &[C], by: &[usize]) -> Vec<C> {
    by.iter().map(|of| key[*of]).collect()
}

/// All changes of a mechanism's numbers under which a linkage stays the same.
#[derive(Clone, Debug)]
pub(super) struct Symmetries {
    /// For each number true if it is an angle.
    angles: Vec<bool>,
    /// Configurations in a flat point, after the numbers.
    positions: usize,
    /// All of a group, the first of which changes nothing.
    pub group: Vec<Flip>,
    /// Exchanges of numbers that carry each solution to another one, as of two links alike; the first exchanges nothing.
    pub exchanges: Vec<Vec<usize>>,
}

impl Symmetries {
    /// None but the change that changes nothing.
    pub(super) fn none(angles: &[bool], joints: usize, positions: usize) -> Self {
        let nothing = Flip {
            numbers: vec![Sense::default(); angles.len()],
            joints: vec![Sense::default(); joints],
        };
        Symmetries {
            angles: angles.to_vec(),
            positions,
            group: vec![nothing],
            exchanges: vec![(0..angles.len()).collect()],
        }
    }

    /// The numbers, angles as points of the unit circle; of all linkages that are the same the one furthest in a direction
    /// without meaning.
    pub(super) fn key_of(&self, x: &[C]) -> Vec<C> {
        let numbers = x.iter().zip(&self.angles);
        let key = numbers.map(|(x, angle)| match angle {
            true => Number::exp(*x * C::new(0.0, 1.0)),
            false => *x,
        });
        self.furthest(&key.collect::<Vec<C>>())
    }

    /// Of all images of a key under exchanges and changes the furthest.
    fn furthest(&self, key: &[C]) -> Vec<C> {
        let exchanges = self.exchanges.iter().map(|by| exchanged(key, by));
        let images = exchanges.flat_map(|key| {
            let images = (self.group.iter()).map(|flip| flip.of(&key, &self.angles));
            images.collect::<Vec<_>>()
        });
        let images = images.map(|image| {
            let along = image.iter().enumerate().map(|(i, x)| {
                let weight = 1.0 + (0.618_034 * (i + 1) as f64).fract();
                (x.re + 0.37 * x.im) * weight
            });
            (along.sum::<f64>(), image)
        });
        let furthest = images.max_by(|a, b| a.0.total_cmp(&b.0));
        furthest.map_or_else(|| key.to_vec(), |(_, image)| image)
    }

    /// Finds the exchanges of numbers that carry every solution of a generic member to another one.
    pub(super) fn exchange(&mut self, solutions: &[Vec<C>]) {
        let keys: Vec<Vec<C>> = solutions.iter().map(|x| self.key_of(x)).collect();
        let angles = &self.angles;
        let mut all = self.exchanges.clone();
        let Some(first) = keys.first() else {
            return;
        };
        for other in &keys[1..] {
            for flip in &self.group {
                let image = flip.of(other, angles);
                // generic numbers differ, so that each is found once
                let near = |a: C, b: C| (a - b).norm_sqr() < SAME * SAME * (1.0 + a.norm_sqr());
                let of = |i: usize| {
                    let mut places = (0..angles.len()).filter(|j| angles[*j] == angles[i]);
                    places.find(|j| near(first[*j], image[i]))
                };
                let Some(by) = (0..angles.len()).map(of).collect::<Option<Vec<usize>>>() else {
                    continue;
                };
                let distinct = (0..angles.len()).all(|i| by.contains(&i));
                let carries =
                    |key: &Vec<C>| place(&keys, &self.furthest(&exchanged(key, &by))).is_some();
                if distinct && !all.contains(&by) && keys.iter().all(carries) {
                    all.push(by);
                    break;
                }
            }
        }
        self.exchanges = all;
    }

    /// A flat point after a change.
    pub(super) fn flipped(&self, x: &[C], flip: &Flip) -> Vec<C> {
        let mut x = x.to_vec();
        let (numbers, rest) = x.split_at_mut(flip.numbers.len());
        for (x, sense) in numbers.iter_mut().zip(&flip.numbers) {
            *x = sense.changed(*x);
        }
        let width = (rest.len() / self.positions).max(1);
        for x in rest.chunks_exact_mut(width) {
            for (x, sense) in x.iter_mut().zip(&flip.joints) {
                *x = sense.changed(*x);
            }
        }
        x
    }

    /// Finds the changes that carry a generic solution to another one of the same member, by the residuals of its equations. They
    /// are the same for all its solutions: each is a map of the equations to themselves.
    pub(super) fn find(
        &mut self,
        mechanism: &Mechanism,
        x: &[C],
        mut residual: impl FnMut(&[C]) -> f64,
    ) {
        /// Numbers changed together at most, and changes tried at most: each is tried at one point.
        const WEIGHT: usize = 4;
        const MOST: usize = 40_000;
        let joints = mechanism.joints().iter();
        let turns: Vec<bool> = joints.map(|joint| joint.kind.is_angle()).collect();
        let places: Vec<usize> = (0..turns.len()).filter(|i| turns[*i]).collect();
        let angles = &self.angles;
        let mut group = self.group.clone();
        if angles.len() + places.len() > 20 || !mechanism.platforms().is_empty() {
            return;
        }
        // the changes of few numbers first
        let nothing = vec![Sense::default(); angles.len()];
        let (mut level, mut changes) = (vec![nothing], Vec::new());
        for _ in 0..WEIGHT {
            let more = level.iter().flat_map(|change: &Vec<Sense>| {
                let changed = change.iter().rposition(|of| *of != Sense::default());
                let next = changed.map_or(0, |last| last + 1)..angles.len();
                next.flat_map(|i| (1..if angles[i] { 4 } else { 2 }).map(move |bits| (i, bits)))
                    .map(|(i, bits)| {
                        let mut more = change.clone();
                        more[i] = Sense::of(bits);
                        more
                    })
            });
            level = more.take(MOST).collect();
            changes.extend(level.iter().cloned());
        }
        let mut tried = 0;
        for numbers in &changes {
            if group.iter().any(|of| of.numbers == *numbers) {
                continue;
            }
            // only where an axis is reversed its joint turns the other way
            let reversed =
                (numbers.iter().zip(angles)).any(|(of, angle)| *angle && *of != Sense::default());
            let ways: usize = if reversed { 4 } else { 2 };
            for code in 0..ways.pow(places.len() as u32) {
                tried += 1;
                if tried > MOST {
                    self.group = group;
                    return;
                }
                let mut flip = Flip {
                    numbers: numbers.clone(),
                    joints: vec![Sense::default(); turns.len()],
                };
                let mut code = code;
                for joint in &places {
                    let digit = code % ways;
                    code /= ways;
                    // half turns come first
                    flip.joints[*joint] = Sense::of(digit >> 1 | (digit & 1) << 1);
                }
                if residual(&self.flipped(x, &flip)) < ROUNDING {
                    let more: Vec<Flip> = group.iter().map(|of| of.after(&flip)).collect();
                    group.extend(more);
                    break;
                }
            }
        }
        self.group = group;
    }
}
