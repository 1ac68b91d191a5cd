//! Configurations followed from one set of held values to the next.

use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::mechanism::*;
use linkwork::solve::Stop;
use linkwork::solve::*;
use linkwork::system::Held;
use linkwork::system::*;
use std::f64::consts::TAU;

/// The 4-bar with ground 4.5, crank 2, coupler 4 and rocker 3.5, closed by a revolute joint.
fn four_bar() -> MotionTracker {
    let text = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/mechanisms/four_bar.ron"
    ));
    let mut description = Description::read(text).unwrap();
    for (name, value) in [("l0", "4.5"), ("l1", "2"), ("l2", "4"), ("l3", "3.5")] {
        description = description.with_parameter(name, value).unwrap();
    }
    let mechanism = Mechanism::new(&description).unwrap();
    let mut held = Held::nothing(&mechanism);
    held.joints[0] = true;
    let start = Configuration {
        joints: vec![0.0, 1.0, 1.5],
        platforms: vec![],
    };
    let system = System::new(mechanism.dimensions(), &held);
    let mut tracker = MotionTracker::new(system, start);
    assert_eq!(tracker.recover(&Newton::default()).stop, Stop::Solved);
    tracker
}

/// The gap at the closure in m, from the angles alone.
fn gap(tracker: &MotionTracker) -> f64 {
    let [crank, coupler, rocker] = tracker.configuration().joints[..] else {
        panic!("three joints")
    };
    let end = |angle: f64, r: f64| (r * angle.cos(), r * angle.sin());
    let (a, b, c) = (end(crank, 2.0), end(crank + coupler, 4.0), end(rocker, 3.5));
    (a.0 + b.0 - 4.5 - c.0).hypot(a.1 + b.1 - c.1)
}

fn steps_of_a_turn(tracker: &mut MotionTracker, solves: usize) -> usize {
    let turn = (0..solves).map(|k| TAU * k as f64 / solves as f64);
    turn.map(|angle| {
        let report = tracker.solve(|held| held.joints[0] = angle);
        assert!(report.solved, "{angle}: {report:?}");
        assert!(gap(tracker) < 1e-11);
        report.steps
    })
    .sum()
}

#[test]
fn a_smooth_motion_is_extrapolated_and_takes_fewer_steps() {
    let plain = Warm {
        extrapolation: 0,
        ..Warm::default()
    };
    for solves in [100, 10_000] {
        let without = steps_of_a_turn(&mut four_bar().with(plain.clone()), solves);
        let with = steps_of_a_turn(&mut four_bar(), solves);
        assert!(3 * with < 2 * without, "{with} of {without} steps");
    }
}

#[test]
fn the_points_of_a_fine_motion_need_no_correction() {
    // moves of 6e-5: their fourth differences are below rounding
    let steps = steps_of_a_turn(&mut four_bar(), 100_000);
    assert!(steps < 1000, "{steps} steps");
}

#[test]
fn a_motion_without_pattern_is_followed_without_extrapolation() {
    let mut tracker = four_bar();
    for k in 0..1000 {
        let angle = 0.1 * f64::from(k * k * 37 % 101) / 101.0;
        assert!(tracker.solve(|held| held.joints[0] = angle).solved);
        assert!(gap(&tracker) < 1e-11);
    }
}

#[test]
fn what_cannot_be_reached_is_not_called_solved_and_leaves_the_last_solution() {
    let mut tracker = four_bar();
    steps_of_a_turn(&mut tracker, 1000);
    let before = tracker.configuration().clone();
    let report = tracker.solve(|held| held.joints[0] = f64::NAN);
    assert!(!report.solved);
    assert_eq!(tracker.configuration().joints[1..], before.joints[1..]);
    let report = tracker.solve(|held| held.joints[0] = before.joints[0]);
    assert!(report.solved);
    assert!(gap(&tracker) < 1e-11);
}

#[test]
fn a_jump_too_long_to_follow_is_refused_and_recovered_from() {
    let mut tracker = four_bar();
    steps_of_a_turn(&mut tracker, 1000);
    if !tracker.solve(|held| held.joints[0] = 3.0).solved {
        let report = tracker.recover(&Newton::default());
        assert_eq!(report.stop, Stop::Solved);
    }
    assert!(gap(&tracker) < 1e-11);
    assert!(tracker.solve(|held| held.joints[0] = 3.001).solved);
}
