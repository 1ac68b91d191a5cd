//! Cost of a mechanism against its size: rows of 1,000, 2,000 and 4,000 4-bars.
//!
//! `cargo bench --bench growth`; another number of loops to begin with may follow after `--`. Prints ms for reading,
//! checking, assembling, mobility, velocity, statics and a sweep of ten rows, each with the ratio to the shortest row:
//! linear growth is 2 and 4. Limits to stay under on one thread of a desktop machine: 2.6 and 6.8, which leave room for
//! caches and for the order of names.

// a bench prints its ratios
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use linkwork::analysis::assembly::{AssemblySettings, assemble};
use linkwork::analysis::mobility::{MobilitySettings, mobility};
use linkwork::analysis::statics::statics;
use linkwork::analysis::sweep::{SweepEnd, SweepSettings, sweep};
use linkwork::analysis::velocity::velocity;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::{Coordinate, Drive, Driven, Held, Load, Question};

/// Crank-rockers in a row; the rocker of one is the crank of the next.
fn row(loops: usize) -> String {
    let mut joints = String::from("\"r0\": Actuated(home: \"60 deg\"),");
    let (mut chains, mut closures) = (String::new(), String::new());
    for k in 0..loops {
        let next = k + 1;
        joints += &format!(
            "\"c{k}\": Passive(home: \"-60 deg\"), \"r{next}\": Passive(home: \"60 deg\"),\n"
        );
        chains += &format!(
            "\"left{k}\": Chain(base: [Tx(\"{k}*l0\")], rows: [(theta: \"r{k}\"), (a: \"l1\", theta: \"c{k}\")], tip: [Tx(\"l2\")]),
             \"right{k}\": Chain(base: [Tx(\"{next}*l0\")], rows: [(theta: \"r{next}\")], tip: [Tx(\"l3\")]),\n"
        );
        closures += &format!("\"pin{k}\": Revolute(\"left{k}\", \"right{k}\"),\n");
    }
    format!(
        "Mechanism(version: 1, name: \"row\", convention: Modified,
            parameters: {{ \"l0\": 4, \"l1\": 2, \"l2\": 4.001, \"l3\": 2.001 }},
            joints: {{ {joints} }}, chains: {{ {chains} }}, closures: {{ {closures} }})"
    )
}

/// The value of a computation, whose time in ms is added to the list.
fn timed<T>(times: &mut Vec<f64>, compute: impl FnOnce() -> T) -> T {
    let begin = Instant::now();
    let value = black_box(compute());
    times.push(begin.elapsed().as_secs_f64() * 1e3);
    value
}

/// The times of all that is measured, for a row of so many loops.
fn measured(loops: usize) -> Vec<f64> {
    let (text, none, mut times) = (row(loops), Watch::none(), Vec::new());
    let times_of = &mut times;
    let description = timed(times_of, || Description::read(&text).expect("well formed"));
    let mechanism = timed(times_of, || {
        Mechanism::new(&description).expect("meaningful")
    });
    let question = Question::new(&mechanism);
    let settings = AssemblySettings::default();
    let assembled = timed(times_of, || assemble(&question, &settings, &none));
    let assembled = assembled.expect("one input");
    assert!(assembled.is_assembled());
    let settings = MobilitySettings::default();
    let report = timed(times_of, || mobility(&question, &settings, &none));
    assert_eq!(report.closed().expect("it closes").mobility, 1);
    let drive = Drive::still(&question);
    let report = timed(times_of, || velocity(&question, &drive, &[], &none));
    assert!(report.expect("one input").closed().is_some());
    let mut load = Load::default();
    let last = mechanism.joint(&format!("r{loops}"));
    load.joints.push((last.expect("the last rocker"), 1.0));
    let report = timed(times_of, || statics(&question, &load, &none));
    assert!(
        report
            .expect("one input")
            .closed()
            .is_some_and(|r| r.balanced)
    );
    let input = Driven {
        coordinate: Coordinate::Joint(mechanism.joint("r0").expect("the input")),
        from: 60f64.to_radians(),
        to: 80f64.to_radians(),
    };
    let (held, start) = (Held::nothing(&mechanism), assembled.configuration());
    let settings = SweepSettings {
        steps: 10,
        ..SweepSettings::default()
    };
    let report = timed(times_of, || {
        sweep(
            &mechanism,
            &held,
            &[input],
            &start,
            &settings,
            &mut |_| {},
            &none,
        )
    });
    assert_eq!(report.ending, SweepEnd::Complete);
    times
}

fn main() {
    const MEASURED: [&str; 7] = [
        "read", "check", "assemble", "mobility", "velocity", "statics", "sweep",
    ];
    let shortest = std::env::args().filter_map(|word| word.parse().ok()).next();
    let shortest: usize = shortest.unwrap_or(1000);
    let rows = [1, 2, 4].map(|times| measured(times * shortest));
    println!(
        "{:>10}  {:>8} loops  {:>16}  {:>16}",
        "",
        shortest,
        2 * shortest,
        4 * shortest
    );
    for (i, name) in MEASURED.iter().enumerate() {
        let [first, second, fourth] = [0, 1, 2].map(|row| rows[row][i]);
        let [twice, four_times] = [second / first, fourth / first];
        println!(
            "{name:>10}  {first:>11.1} ms  {second:>7.1} ms ×{twice:>4.2}  {fourth:>7.1} ms ×{four_times:>4.2}"
        );
    }
}
