//! What a row of a sweep costs beside a warm solve of the kernel: the same inputs, once by a bare tracker, which says
//! nothing of branches, and once by a sweep, which keeps to one. The limit is 1.3.

// a bench prints its ratios
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use linkwork::analysis::sweep::{SweepEnd, SweepSettings, sweep};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::solve::Watch;
use linkwork::solve::{Newton, Stop};
use linkwork::system::{Coordinate, Driven, Held, MotionTracker, Question, System};

const STEPS: usize = 200_000;
const ROUNDS: usize = 7;

fn main() {
    measure("four_bar", &[("theta1", 0.5, 0.5 + std::f64::consts::TAU)]);
    measure(
        "watt_six_bar",
        &[("theta", 1.3, 1.3 + std::f64::consts::TAU)],
    );
    measure("jansen_leg", &[("theta", 1.5, 1.5 + std::f64::consts::TAU)]);
    measure("three_rps", &[("l1", 0.6, 0.66), ("l2", 0.6, 0.62)]);
}

fn measure(name: &str, moved: &[(&str, f64, f64)]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let mechanism = Mechanism::load(path).expect("it is shipped");
    let inputs: Vec<Driven> = (moved.iter())
        .map(|&(name, from, to)| Driven {
            coordinate: Coordinate::Joint(mechanism.joint(name).expect("it has that joint")),
            from,
            to,
        })
        .collect();
    let mut still = Question::new(&mechanism).held();
    let at = start(&mechanism, &inputs);
    let system = Question::new(&mechanism).system();
    for input in &inputs {
        let Coordinate::Joint(joint) = input.coordinate else {
            continue;
        };
        still.joints[joint] = false;
    }
    let (mut bare, mut swept) = (Vec::new(), Vec::new());
    let mut sure = 0;
    for _ in 0..ROUNDS {
        bare.push(warm(&system, &inputs, &at));
        let (time, steps) = whole(&mechanism, &still, &inputs, &at);
        swept.push(time);
        sure = steps;
    }
    bare.sort_by(f64::total_cmp);
    swept.sort_by(f64::total_cmp);
    let (bare, swept) = (bare[ROUNDS / 2], swept[ROUNDS / 2]);
    println!(
        "{name}: warm solve {bare:.0} ns, row of a sweep {swept:.0} ns, ratio {:.2} ({sure} sure steps)",
        swept / bare
    );
}

/// Assembled where the inputs begin.
fn start(mechanism: &Mechanism, inputs: &[Driven]) -> Configuration<f64> {
    let system: System<f64> = Question::new(mechanism).system();
    let mut at = mechanism.home();
    let mut trial = at.clone();
    let newton = Newton::default();
    // in small steps from home, so that it stays what home is
    let home = at.clone();
    for k in 0..=50 {
        for input in inputs {
            if let Coordinate::Joint(joint) = input.coordinate {
                let from = home.joints[joint];
                at.joints[joint] = from + (input.from - from) * f64::from(k) / 50.0;
            }
        }
        let report = newton.solve(&system, &mut at, &mut trial, &mut system.work());
        assert_eq!(report.stop, Stop::Solved);
    }
    at
}

fn warm(system: &System<f64>, inputs: &[Driven], at: &Configuration<f64>) -> f64 {
    let mut tracker = MotionTracker::new(system.clone(), at.clone());
    let begun = Instant::now();
    for step in 0..=STEPS {
        let part = step as f64 / STEPS as f64;
        let report = tracker.solve(|held| {
            for input in inputs {
                if let Coordinate::Joint(joint) = input.coordinate {
                    held.joints[joint] = input.at(part);
                }
            }
        });
        assert!(report.solved);
        black_box(tracker.configuration());
    }
    begun.elapsed().as_secs_f64() * 1e9 / STEPS as f64
}

fn whole(
    mechanism: &Mechanism,
    held: &Held<f64>,
    inputs: &[Driven],
    at: &Configuration<f64>,
) -> (f64, usize) {
    let settings = SweepSettings {
        steps: STEPS,
        ..SweepSettings::default()
    };
    let begun = Instant::now();
    let report = sweep(
        mechanism,
        held,
        inputs,
        at,
        &settings,
        &mut |row| {
            black_box(row.configuration);
        },
        &Watch::none(),
    );
    assert_eq!(report.ending, SweepEnd::Complete, "{report:?}");
    (
        begun.elapsed().as_secs_f64() * 1e9 / STEPS as f64,
        report.sure_steps,
    )
}
