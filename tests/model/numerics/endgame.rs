//! Endgame: the limit of a path as s → 1, at a singularity or at infinity.

use linkwork::number::Complex;
use linkwork::solve::*;
use linkwork::solve::{Progress, Stage, Watch};
use std::f64::consts::{PI, TAU};

type C = Complex<f64>;

/// An angle x with e^{ix} (c − s) = 1: at s = c it is infinite.
struct Exponential {
    c: C,
}

impl Homotopy for Exponential {
    fn settle(&self, _: &mut [C]) {}
    fn velocity(&mut self, s: C, _: &[C], out: &mut [C]) -> bool {
        out[0] = C::new(0.0, -1.0) / (self.c - s);
        out[0].re.is_finite()
    }
    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        let value = (C::new(0.0, 1.0) * x[0]).exp() * (self.c - s);
        let step = (value - 1.0) / (value * C::new(0.0, 1.0));
        x[0] -= step;
        step.norm()
    }
    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        ((C::new(0.0, 1.0) * x[0]).exp() * (self.c - s) - 1.0).norm()
    }
}

impl Turning for Exponential {
    fn apart(&self, x: &[C], y: &[C]) -> (f64, bool) {
        let mut gap = x[0] - y[0];
        let turns = (gap.re / TAU).round();
        gap.re -= turns * TAU;
        (gap.norm(), turns != 0.0)
    }
    fn is_far(&self, x: &[C]) -> bool {
        x[0].im.abs() > 14.0
    }
}

/// e^{ix} (c − s) = 1 gives x = i ln(c − s).
fn end(c: C) -> PathEnd {
    let radius = 0.03;
    let x = [C::new(0.0, 1.0) * (c - 1.0 + radius).ln()];
    let watch = Watch::none();
    let mut stages = Stages::new(1, (&watch, Progress::of(Stage::Paths)));
    let tracker = Tracker::default();
    path_end(&mut Exponential { c }, &tracker, &x, radius, &mut stages)
}

#[test]
fn an_angle_that_goes_to_infinity_as_a_logarithm_is_infinite() {
    assert_eq!(end(C::new(1.0, 0.0)), PathEnd::Infinite);
}

#[test]
fn an_angle_that_would_go_to_infinity_later_is_finite() {
    for beyond in [0.5, 0.1, 0.01, 1e-3, 1e-4, 1e-5] {
        // straight ahead, aside, and on the way itself
        for side in [0.0, 0.3, 2.0, -2.5, PI - 1e-4, PI] {
            let gap = C::from_polar(beyond, side);
            let PathEnd::Finite { x, winding: 1 } = end(gap + 1.0) else {
                panic!("{gap}: {:?}", end(gap + 1.0));
            };
            let left = (C::new(0.0, 1.0) * x[0]).exp() * gap - 1.0;
            assert!(left.norm() < 1e-9, "{gap}: {x:?}");
        }
    }
}
