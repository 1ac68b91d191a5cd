//! Starts of a search: random numbers, and configurations in which the mechanism is assembled in all positions.

use std::f64::consts::{PI, TAU};

use rand::Rng;
use rand_pcg::Pcg64;

use super::search::Task;
use crate::mechanism::Configuration;
use crate::number::real;
use crate::system::Bundled;

impl Task<'_> {
    /// Random numbers in their ranges: lengths of the order of the task's size first of all.
    pub(super) fn numbers(&self, rng: &mut Pcg64) -> Vec<f64> {
        let ranges = self.ranges.iter().zip(&self.angles);
        ranges
            .map(|(&(low, high), angle)| {
                let part = rng.random::<f64>();
                let even = low + (high - low) * part;
                if *angle || low == high {
                    return even;
                }
                // from a twentieth of the size to five times that, evenly by the logarithm
                let far = self.size * real::pow(100.0, rng.random::<f64>()) * 0.05;
                let signed = if rng.random::<bool>() { far } else { -far };
                let far = if low < 0.0 { signed } else { far };
                if (low..=high).contains(&far) {
                    far
                } else {
                    even
                }
            })
            .collect()
    }

    /// A random configuration, far from assembled.
    pub(super) fn random(&self, rng: &mut Pcg64) -> Configuration<f64> {
        let mut at = self.mechanism.home();
        for (joint, value) in self.mechanism.joints().iter().zip(&mut at.joints) {
            let random = 2.0 * rng.random::<f64>() - 1.0;
            *value += match joint.kind.is_angle() {
                true => PI * random,
                false => 0.5 * self.size * random,
            };
        }
        at
    }

    /// Numbers of the file, or random ones, with all positions assembled; `None` where one cannot be.
    pub(super) fn start(&self, own: bool, rng: &mut Pcg64) -> Option<Bundled> {
        /// Random configurations from which the first position is closed at most.
        const FIRST: usize = 5;
        let numbers = match own {
            true => self.bundle.file(),
            false => self.numbers(rng),
        };
        let configurations = match (self.ranges.is_empty(), self.free_driver) {
            (true, _) => self.each_alone(&numbers, rng),
            (false, Some(driver)) => self.along(driver, &numbers, rng),
            (false, None) => {
                let mut closer = self.bundle.closer(&numbers)?;
                let first = (0..FIRST).find_map(|_| closer.closed(0, self.random(rng)));
                let first = first?;
                let mut at = first.clone();
                let others = (1..self.positions).map(|position| {
                    at = closer.closed(position, at.clone())?;
                    Some(at.clone())
                });
                [Some(first)].into_iter().chain(others).collect()
            }
        };
        Some(Bundled {
            configurations: configurations?,
            numbers,
        })
    }

    /// For each position the nearest of many configurations, in all assemblies that random starts lead to.
    fn each_alone(&self, numbers: &[f64], rng: &mut Pcg64) -> Option<Vec<Configuration<f64>>> {
        const STARTS: usize = 12;
        let mut samples = Vec::new();
        if let Some(driver) = self.free_driver {
            for _ in 0..STARTS {
                let of = self.samples(driver, numbers, rng);
                samples.extend(of.into_iter().flat_map(|(samples, _)| samples));
            }
        }
        let mut closer = self.bundle.closer(numbers)?;
        let each = (0..self.positions).map(|position| {
            let mut samples = samples.clone();
            if self.free_driver.is_none() {
                let random = (0..STARTS).map(|_| self.random(rng));
                samples.extend(random.filter_map(|at| closer.closed(position, at)));
            }
            let squares = self.bundle.squares_at(position, numbers, &samples);
            let all = samples.into_iter().zip(squares);
            let nearest = all.min_by(|a, b| a.1.total_cmp(&b.1));
            nearest.map(|(at, _)| at)
        });
        each.collect()
    }

    /// Configurations at evenly spaced values of the driving joint, and true if it goes round.
    fn samples(
        &self,
        driver: usize,
        numbers: &[f64],
        rng: &mut Pcg64,
    ) -> Option<(Vec<Configuration<f64>>, bool)> {
        const SAMPLES: usize = 48;
        let angle = self.mechanism.joints()[driver].kind.is_angle();
        let stride = match angle {
            true => TAU / SAMPLES as f64,
            false => 2.0 * self.size / SAMPLES as f64,
        };
        let mut closer = self.plain.as_ref()?.closer(numbers)?;
        let first = closer.closed(0, self.random(rng))?;
        let mut samples = vec![first.clone()];
        let mut round = angle;
        for sign in [1.0, -1.0] {
            let mut at = first.clone();
            while samples.len() < SAMPLES {
                at.joints[driver] += sign * stride;
                match closer.closed(0, at.clone()) {
                    Some(next) => at = next,
                    None => {
                        round = false;
                        break;
                    }
                }
                match sign > 0.0 {
                    true => samples.push(at.clone()),
                    false => samples.insert(0, at.clone()),
                }
            }
        }
        Some((samples, round))
    }

    /// Samples of one motion, of which those are taken that are nearest to the targets when they are passed one after another at
    /// an even pace.
    fn along(
        &self,
        driver: usize,
        numbers: &[f64],
        rng: &mut Pcg64,
    ) -> Option<Vec<Configuration<f64>>> {
        let (samples, round) = self.samples(driver, numbers, rng)?;
        let count = samples.len();
        let squares: Vec<Vec<f64>> = (0..self.positions)
            .map(|position| self.bundle.squares_at(position, numbers, &samples))
            .collect();
        let mut best: Option<(f64, Vec<usize>)> = None;
        let parts = [1.0, 0.6, 0.3, 0.15].map(|part| part * (0.8 + 0.4 * rng.random::<f64>()));
        for pace in parts.iter().flat_map(|part| [*part, -part]) {
            for begin in 0..count {
                let place = |position: usize| {
                    let part = position as f64 / self.positions as f64;
                    let place = begin as f64 + pace * part * count as f64;
                    let whole = place.round() as i64;
                    match round {
                        true => whole.rem_euclid(count as i64) as usize,
                        false => whole.clamp(0, count as i64 - 1) as usize,
                    }
                };
                let places: Vec<usize> = (0..self.positions).map(place).collect();
                let sum = places.iter().zip(&squares).map(|(i, of)| of[*i]).sum();
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, places));
                }
            }
        }
        let (_, places) = best?;
        Some(places.into_iter().map(|i| samples[i].clone()).collect())
    }
}
