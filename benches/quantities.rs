//! What quantities add to a row of a sweep: the same motion without any, with each kind, and with five. The aim is 1.5
//! for five; positions and rates are near it, figures that need singular values are not.

// a bench prints its ratios
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::Question;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

const STEPS: usize = 20_000;
const ROUNDS: usize = 5;

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/four_bar.ron");
    let mechanism = Mechanism::load(path).expect("it is shipped");
    let question = Question::new(mechanism)
        .input("theta1", "0 deg", "360 deg")
        .load("phi1", 1.0);
    let alone = row(&question);
    println!("row without quantities: {alone:.0} ns");
    for list in [
        "left.yaw",
        "velocity:left+1",
        "acceleration:left+1",
        "transmission",
        "force:theta1",
        "condition",
        "left.x, left.yaw, velocity:left+1, acceleration:left+1, atan2(left.y, left.x)",
        "transmission, velocity:left+1, condition, force:theta1, left.yaw",
    ] {
        let time = row(&question.clone().report(list));
        println!("{list}: {time:.0} ns, ratio {:.2}", time / alone);
    }
}

/// The time of a row in ns: the median of some motions.
fn row(question: &Question) -> f64 {
    let settings = SweepSettings {
        steps: STEPS,
        ..SweepSettings::default()
    };
    let motions = question.motions(&settings, &Watch::none());
    let motions = motions.expect("the question is right");
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let begin = Instant::now();
            black_box(motions.report(2, &mut |_, row| _ = black_box(row.step), &Watch::none()));
            begin.elapsed().as_nanos() as f64 / STEPS as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}
