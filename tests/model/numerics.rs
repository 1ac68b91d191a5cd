//! Linear algebra, interval arithmetic, expressions and solvers, each against what is known otherwise.

mod affine;
mod arrangement;
mod bordered;
mod branching;
mod continuation;
mod decomposed;
mod decomposition;
mod display;
mod elimination;
mod endgame;
mod evaluation;
mod functions;
mod homotopy;
mod interval;
mod law;
mod line;
mod measure;
mod minimum;
mod parser;
mod qr;
mod search;
mod sparse;
mod straight_line;
mod tracker;
mod trigonometric;
mod units;
mod vectors;

/// Numbers in (−1, 1) (Knuth's linear congruential generator).
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
