//! Straight on through singular configurations.

use super::*;

/// Evaluates the state of a motion, and, where branches of motion meet, from the states beside it along its rates: what
/// is evaluated is analytic along the branch, so that interpolation between both sides, of order 8, gives it where
/// equations that lose rank leave rounding only.
///
/// Below the margin `sick` of the closure equations rounding is felt; states beside are at least as far away. With 0 every
/// state is evaluated itself. `None` where there is no value.
pub(super) fn across(
    dynamics: &mut Dynamics,
    laws: &Laws,
    (time, state): (f64, &[f64]),
    sick: f64,
    mut evaluate: impl FnMut(&mut Dynamics, &[f64]) -> Option<Vec<f64>>,
) -> Option<Vec<f64>> {
    /// (4!)²·(−1)ᵏ⁺¹ / ((4 − k)!·(4 + k)!) for the states k steps before and after.
    const WEIGHTS: [f64; 4] = [0.8, -0.4, 4.0 / 35.0, -1.0 / 70.0];
    /// Steps tried, in rad and characteristic lengths.
    const STEPS: [f64; 6] = [0.05, 0.075, 0.1, 0.14, 0.2, 0.28];
    if sick == 0.0 || margin(dynamics, laws, state)? >= sick {
        return evaluate(dynamics, state);
    }
    let [rates, _] = laws.rates(time, state);
    let rates = rates.iter().zip(&laws.units).map(|(x, unit)| x / unit);
    let rates: Vec<f64> = rates.collect();
    let speed = norm(&rates);
    if speed == 0.0 {
        return None;
    }
    let beside = |by: f64| {
        let mut beside = state.to_vec();
        add(&mut beside[..rates.len()], by / speed, &rates);
        beside
    };
    'steps: for step in STEPS {
        let mut sum: Vec<f64> = Vec::new();
        for (k, weight) in (1..).zip(WEIGHTS) {
            for side in [-1.0, 1.0] {
                let there = beside(side * f64::from(k) * step);
                if margin(dynamics, laws, &there).is_none_or(|found| found < sick) {
                    continue 'steps;
                }
                let Some(found) = evaluate(dynamics, &there) else {
                    continue 'steps;
                };
                sum.resize(found.len(), 0.0);
                add(&mut sum, weight, &found);
            }
        }
        return Some(sum);
    }
    None
}

/// The part of the largest margin below which rounding is felt in accelerations.
pub(super) const NEARLY_SINGULAR: f64 = 0.03;

/// The margin of the closure equations at a state.
fn margin(dynamics: &mut Dynamics, laws: &Laws, state: &[f64]) -> Option<f64> {
    let closed = dynamics.close(&laws.values(state)[..laws.units.len()]);
    closed.then(|| dynamics.margin())
}

impl Run<'_, '_> {
    /// The margin below which rounding is felt in accelerations; 0 if singular configurations end the motion.
    pub(super) fn sick(&self) -> f64 {
        match self.settings.through {
            true => NEARLY_SINGULAR * self.widest,
            false => 0.0,
        }
    }
}
