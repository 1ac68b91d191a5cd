//! Following a solution x(s) of h(x, s) = 0 while the parameter s moves through the complex plane.

use linkwork::number::Complex;
use linkwork::solve::Stage;
use linkwork::solve::*;
use std::ops::ControlFlow;

type C = Complex<f64>;

/// x² = 1 + s: at s = −1 both solutions meet.
struct Roots;

impl Homotopy for Roots {
    fn settle(&self, _: &mut [C]) {}
    fn velocity(&mut self, _: C, x: &[C], out: &mut [C]) -> bool {
        out[0] = C::new(0.5, 0.0) / x[0];
        out[0].re.is_finite()
    }
    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        let step = (x[0] * x[0] - 1.0 - s) / (x[0] * 2.0);
        x[0] -= step;
        step.norm()
    }
    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        (x[0] * x[0] - 1.0 - s).norm()
    }
}

fn track(way: (C, C), x: &mut [C]) -> Arrival {
    let (watch, now) = (Watch::none(), Progress::of(Stage::Paths));
    let mut stages = Stages::new(1, (&watch, now));
    Tracker::default()
        .track(&mut Roots, way, x, &mut stages)
        .arrival
}

#[test]
fn a_regular_way_is_followed_to_the_last_digits() {
    let (zero, end) = (C::new(0.0, 0.0), C::new(8.0, 0.0));
    let mut x = [C::new(-1.0, 0.0)];
    assert_eq!(track((zero, end), &mut x), Arrival::There);
    assert!((x[0] + 3.0).norm() < 1e-9, "{x:?}");
}

#[test]
fn going_once_round_a_meeting_point_exchanges_the_solutions() {
    let mut x = [C::new(1.0, 0.0)];
    let corners = [
        (0.0, 0.0),
        (-1.0, 1.0),
        (-2.0, 0.0),
        (-1.0, -1.0),
        (0.0, 0.0),
    ];
    for pair in corners.windows(2) {
        let way = (C::new(pair[0].0, pair[0].1), C::new(pair[1].0, pair[1].1));
        track(way, &mut x);
    }
    assert!((x[0] + 1.0).norm() < 1e-9, "{x:?}");
}

#[test]
fn a_way_through_a_meeting_point_is_refused() {
    let way = (C::new(0.0, 0.0), C::new(-2.0, 0.0));
    let mut x = [C::new(1.0, 0.0)];
    let arrival = track(way, &mut x);
    let refused = matches!(arrival, Arrival::Stuck(at) if (at - 0.5).abs() < 1e-2);
    assert!(refused, "{arrival:?}");
}

#[test]
fn a_way_is_left_where_it_is_stopped() {
    let steps = std::sync::atomic::AtomicUsize::new(0);
    let third = |_: Progress| match steps.fetch_add(1, std::sync::atomic::Ordering::Relaxed) {
        0..2 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    let watch = Watch::new(&third);
    let way = (C::new(0.0, 0.0), C::new(8.0, 0.0));
    let mut x = [C::new(1.0, 0.0)];
    let mut stages = Stages::new(1, (&watch, Progress::of(Stage::Paths)));
    let tracker = Tracker {
        first: 0.01,
        ..Tracker::default()
    };
    let track = tracker.track(&mut Roots, way, &mut x, &mut stages);
    let Arrival::Stuck(done) = track.arrival else {
        panic!("{track:?}");
    };
    assert!(0.0 < done && done < 1.0 && track.steps == 2, "{track:?}");
    // the point is on the path as far as that went
    assert!((x[0] * x[0] - (1.0 + 8.0 * done)).norm() < 1e-9);
}
