//! The work: three trajectories of 100,000 rows, and 10,000 cold starts from a fixed seed.

use std::array::from_fn;
use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::{stewart_gough, stewart_gough::Pose, three_rps};

pub const ROWS: usize = 100_000;
pub const COLD: usize = 10_000;

const SEED: u64 = 20_240_607;

/// A: one turn of the crank.
pub fn crank_angles() -> Vec<f64> {
    (0..ROWS).map(|k| TAU * k as f64 / ROWS as f64).collect()
}

/// B: three leg lengths, one period.
pub fn rps_legs() -> Vec<[f64; 3]> {
    let phase = [0.0, 1.7, 3.9];
    let row = |k| from_fn(|i| 0.8 + 0.1 * (TAU * k as f64 / ROWS as f64 + phase[i]).sin());
    (0..ROWS).map(row).collect()
}

/// B: legs in [0.7, 0.9], angles in [-π, π].
pub fn rps_cold() -> Vec<three_rps::Cold> {
    let mut rng = Pcg64::seed_from_u64(SEED);
    let mut draw = || {
        let legs = from_fn(|_| rng.random_range(0.7..=0.9));
        (legs, from_fn(|_| rng.random_range(-PI..=PI)))
    };
    (0..COLD).map(|_| draw()).collect()
}

/// C: the poses; their legs follow by inverse kinematics.
pub fn platform_poses() -> Vec<Pose> {
    let row = |k| {
        let t = TAU * k as f64 / ROWS as f64;
        Pose::new(
            [
                0.15 * t.sin(),
                0.12 * (2.0 * t).cos(),
                0.9 + 0.1 * (3.0 * t).sin(),
            ],
            [
                0.25 * (t + 0.3).sin(),
                0.2 * (2.0 * t + 1.0).sin(),
                0.3 * (t + 2.0).sin(),
            ],
        )
    };
    (0..ROWS).map(row).collect()
}

/// C: poses in a box about home, to be found from home.
pub fn platform_cold_from_home() -> Vec<stewart_gough::Cold> {
    platform_cold(|_| Pose::HOME)
}

/// C: the same poses, to be found from anywhere: p in [-1, 1]² × [-1.2, 1.2], rotation uniform on SO(3).
pub fn platform_cold_from_random() -> Vec<stewart_gough::Cold> {
    platform_cold(|rng| {
        let p = [1.0, 1.0, 1.2].map(|h| rng.random_range(-h..=h));
        // Shoemake, Uniform random rotations, Graphics Gems III (1992)
        let u: f64 = rng.random();
        let (s1, c1) = rng.random_range(0.0..TAU).sin_cos();
        let (s2, c2) = rng.random_range(0.0..TAU).sin_cos();
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        Pose {
            p,
            q: [a * s1, a * c1, b * s2, b * c2],
        }
    })
}

fn platform_cold(start: impl Fn(&mut Pcg64) -> Pose) -> Vec<stewart_gough::Cold> {
    // two generators, so that both sets ask for the same poses
    let (mut rng, mut starts) = (
        Pcg64::seed_from_u64(SEED + 1),
        Pcg64::seed_from_u64(SEED + 2),
    );
    let mut draw = || {
        let p = [(-0.3, 0.3), (-0.3, 0.3), (0.65, 1.15)]
            .map(|(low, high)| rng.random_range(low..=high));
        let truth = Pose::new(p, from_fn(|_| rng.random_range(-0.5..=0.5)));
        (truth, truth.legs(), start(&mut starts))
    };
    (0..COLD).map(|_| draw()).collect()
}
