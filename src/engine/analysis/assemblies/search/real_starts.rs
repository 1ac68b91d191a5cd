//! Assembled configurations at the target inputs themselves, without any path.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::analysis::assemblies::family::Family;
use crate::mechanism::Configuration;
use crate::solve::{Newton, Stage, Watch};
use crate::system::Neighbourhood;

/// Assembled configurations reached by Newton's method from the target configuration, start 0, and
/// from random ones. Each start is the same in every run.
pub(crate) fn solved(
    family: &Family,
    near: &Neighbourhood,
    asked: &Configuration<f64>,
    starts: usize,
    watch: &Watch,
) -> Vec<Configuration<f64>> {
    let points = crate::solve::each(starts, near, |near, number| {
        // the assembly beside home is known even when the search was stopped
        if watch.stops(Stage::Starts, number, Some(starts)) && number > 0 {
            return None;
        }
        let start = match number {
            0 => asked.clone(),
            _ => {
                let mut rng = Pcg64::seed_from_u64(number as u64);
                let random = family.random_point(&mut rng, 1.0);
                family.coordinates.real_part(&random, asked)
            }
        };
        near.solve(&Newton::default(), start)
    });
    points.into_iter().flatten().collect()
}
