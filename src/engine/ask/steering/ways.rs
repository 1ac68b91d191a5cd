//! Motions of a mechanism from a configuration, whatever is held.

use super::Steering;
use crate::linear::{add, dot, norm, remove};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::{SAME, STILL};
use crate::system::{Coordinate, Freedoms, System};

/// The motions of a mechanism with nothing driven held, and how fast its coordinates change in them.
pub(super) struct Ways {
    pub freedoms: Freedoms,
    /// Of each coordinate its rate in each motion, dimensionless.
    rates: Vec<(Coordinate, Vec<f64>)>,
}

impl Ways {
    pub fn of(steering: &Steering, system: &System<f64>, at: &Configuration<f64>) -> Self {
        let mechanism = steering.mechanism();
        let freedoms = Freedoms::of(system, at, &mut system.work());
        let rates = Coordinate::all(mechanism).map(|of| {
            let slope = of.slope_in(system, at);
            let rate = |motion: &Vec<f64>| {
                let parts = slope.iter().map(|(column, slope)| slope * motion[*column]);
                parts.sum()
            };
            (of, freedoms.motions.iter().map(rate).collect())
        });
        Ways {
            rates: rates.collect(),
            freedoms,
        }
    }

    /// Rate of a coordinate in a combination of the motions, dimensionless.
    pub fn rate(&self, of: Coordinate, parts: &[f64]) -> f64 {
        let known = self.rates.iter().find(|(known, _)| *known == of);
        known.map_or(0.0, |(_, rates)| dot(rates, parts))
    }

    /// The rates of coordinates in the motions, one row each.
    pub fn rows(&self, of: &[Coordinate]) -> Vec<&[f64]> {
        let row = |of: &Coordinate| self.rates.iter().find(|(known, _)| known == of);
        of.iter()
            .filter_map(row)
            .map(|(_, rates)| &rates[..])
            .collect()
    }

    /// The motion of these parts.
    pub fn motion(&self, parts: &[f64]) -> Vec<f64> {
        let mut motion = vec![0.0; self.freedoms.unknowns.len()];
        for (part, of) in parts.iter().zip(&self.freedoms.motions) {
            add(&mut motion, *part, of);
        }
        motion
    }

    /// So many coordinates that decide where the mechanism is: `first` of all, then those of `preferred` that are not much
    /// worse than the best. `along` is a motion that the first of them must not miss.
    pub fn chosen(
        &self,
        count: usize,
        first: &[Coordinate],
        preferred: &[Coordinate],
        along: Option<&[f64]>,
    ) -> Vec<Coordinate> {
        let mut left: Vec<(Coordinate, Vec<f64>)> = self
            .rates
            .iter()
            // angles of a platform that is pitched nearly upright change without end
            .filter(|(_, rates)| norm(rates) < 3.0)
            .cloned()
            .collect();
        let mut chosen = Vec::new();
        while chosen.len() < count {
            let size = |(_, rates): &(Coordinate, Vec<f64>)| match along {
                Some(along) if chosen.is_empty() => dot(rates, along).abs() / norm(along),
                _ => norm(rates),
            };
            let best_of = |among: &dyn Fn(&Coordinate) -> bool| {
                let among = (0..left.len()).filter(|&i| among(&left[i].0));
                among.max_by(|&i, &k| size(&left[i]).total_cmp(&size(&left[k])).then(k.cmp(&i)))
            };
            let Some(best) = best_of(&|_| true) else {
                break;
            };
            let enough = |i: &usize, least: f64| size(&left[*i]) > least;
            let wanted = best_of(&|of| first.contains(of)).filter(|i| enough(i, STILL));
            let wanted = wanted.or_else(|| {
                // a coordinate that changes much less than the one that changes most gives way to it
                let least = 0.15 * size(&left[best]);
                best_of(&|of| preferred.contains(of)).filter(|i| enough(i, least))
            });
            let (of, mut rates) = left.swap_remove(wanted.unwrap_or(best));
            let length = norm(&rates);
            if length < STILL {
                break;
            }
            rates.iter_mut().for_each(|x| *x /= length);
            let basis = [rates];
            left.iter_mut().for_each(|(_, rates)| remove(rates, &basis));
            chosen.push(of);
        }
        chosen
    }

    /// Determinant of the rates of coordinates: zero where they do not determine the configuration, with opposite signs
    /// on its two sides. The motions of `other` give the sense of the sign.
    pub fn side(&self, of: &[Coordinate], other: &Ways) -> f64 {
        let count = self.freedoms.motions.len();
        if count != of.len() || other.freedoms.motions.len() != count {
            return 1.0;
        }
        let determinant = |entry: &dyn Fn(usize, usize) -> f64| {
            nalgebra::DMatrix::from_fn(count, count, entry).determinant()
        };
        let (here, there) = (self.rows(of), other.rows(of));
        let motions = (&self.freedoms.motions, &other.freedoms.motions);
        determinant(&|i, k| here[i][k])
            * determinant(&|i, k| there[i][k])
            * determinant(&|i, k| dot(&motions.0[i], &motions.1[k]))
    }
}

/// No joint is beyond a limit.
pub(super) fn within_limits(mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
    let mut joints = mechanism.joints().iter().enumerate();
    joints.all(|(joint, of)| {
        let near = SAME * Coordinate::Joint(joint).scale(mechanism);
        let value = at.joints[joint];
        of.limits
            .is_none_or(|(low, high)| (low - near..=high + near).contains(&value))
    })
}

impl Steering {
    /// The joints that are at a limit, and whether it is the upper one.
    pub fn at_limits(&self) -> Vec<(usize, bool)> {
        let reached = |upper: bool| {
            let rate = if upper { 1.0 } else { -1.0 };
            let there = at_limits(&self.mechanism, &self.at, move |_| rate);
            there.filter_map(move |of| match of {
                Coordinate::Joint(joint) => Some((joint, upper)),
                _ => None,
            })
        };
        reached(false).chain(reached(true)).collect()
    }
}

/// Joints that are at a limit and would go beyond it in a motion.
pub(super) fn at_limits<'m>(
    mechanism: &'m Mechanism,
    at: &'m Configuration<f64>,
    rate: impl Fn(Coordinate) -> f64 + 'm,
) -> impl Iterator<Item = Coordinate> + 'm {
    let joints = mechanism.joints().iter().enumerate();
    joints.filter_map(move |(joint, of)| {
        let (low, high) = of.limits?;
        let coordinate = Coordinate::Joint(joint);
        let near = SAME * coordinate.scale(mechanism);
        let (value, rate) = (at.joints[joint], rate(coordinate));
        let beyond = (value <= low + near && rate < 0.0) || (value >= high - near && rate > 0.0);
        beyond.then_some(coordinate)
    })
}
