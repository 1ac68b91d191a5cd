//! All assemblies: the first search, and new inputs from stored generic solutions.
//!
//! Run with RAYON_NUM_THREADS=1 for the time of one core. The lines beside the times give solutions, steps for each path, and
//! how many of a hundred new inputs were answered without a lost path.

// a bench prints its ratios
#![allow(clippy::print_stdout)]
// the yardsticks use intrinsics of the processor
#![allow(unsafe_code)]

mod limits;

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};

use linkwork::analysis::assemblies::{AssembliesSettings, AssemblySolver, Wanted};
use linkwork::description::load;
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::solve::Watch;
use linkwork::system::Question;

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .without_plots();
    targets = truss, searches, stored
}
criterion_main!(benches);

const MECHANISMS: [&str; 6] = [
    "four_bar",
    "planar_3rpr",
    "three_rps",
    "dietmaier",
    "stewart_gough_6sps",
    "stewart_gough_6ups",
];

fn mechanism(name: &str) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let (_, description) = load(&path).expect("the mechanism files are right");
    Mechanism::new(&description).expect("the mechanism files are right")
}

fn solver(mechanism: &Mechanism, seed: u64) -> AssemblySolver {
    let settings = AssembliesSettings {
        seed,
        ..AssembliesSettings::default()
    };
    let held = Question::new(mechanism).held();
    AssemblySolver::new(mechanism, &held, &settings, &Watch::none())
        .expect("dimensions have values")
}

/// The 13-link truss from nothing, beside a program written by hand for it.
fn truss(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/truss_13.ron");
    let (_, description) = load(&path).expect("the file is right");
    let mechanism = Mechanism::new(&description).expect("the file is right");
    let home = mechanism.home();
    let (ends, paths, steps) = limits::truss::all(1);
    println!(
        "truss by hand: {} solutions, {paths} paths, {:.1} steps a path",
        ends.len(),
        steps as f64 / paths as f64
    );
    let mut group = criterion.benchmark_group("13-link truss");
    group.sample_size(10);
    let mut seed = 0;
    group.bench_function("by hand, no trace test", |bencher| {
        bencher.iter(|| {
            seed += 1;
            black_box(limits::truss::all(seed))
        });
    });
    let mut seed = 0;
    group.bench_function("first run", |bencher| {
        bencher.iter(|| {
            seed += 1;
            black_box(solver(&mechanism, seed).at(&home, Wanted::default(), &Watch::none()))
        });
    });
    group.finish();
}

/// The first run: seeds, loops, and the answer at home.
fn searches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("first run");
    group.sample_size(10);
    for name in MECHANISMS {
        let mechanism = mechanism(name);
        let home = mechanism.home();
        let mut seed = 0;
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                seed += 1;
                black_box(solver(&mechanism, seed).at(&home, Wanted::default(), &Watch::none()))
            });
        });
    }
    group.finish();
}

/// Inputs within 5 % or 3° of home, spread evenly by an additive recurrence.
fn inputs(mechanism: &Mechanism) -> Vec<Configuration<f64>> {
    let held = Question::new(mechanism).held();
    let all = (0..100).map(|k| {
        let mut at = mechanism.home();
        for (j, value) in at
            .joints
            .iter_mut()
            .enumerate()
            .filter(|(j, _)| held.joints[*j])
        {
            let spread = (f64::from(k) * 0.618_033_988_749_895 + 0.37 * j as f64).fract() - 0.5;
            *value += 0.1 * spread * value.abs().max(1.0);
        }
        at
    });
    all.collect()
}

/// New inputs for a mechanism whose generic solutions are known.
fn stored(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stored");
    for name in MECHANISMS {
        let mechanism = mechanism(name);
        let solver = solver(&mechanism, 1);
        let inputs = inputs(&mechanism);
        let reports = inputs
            .iter()
            .map(|at| solver.at(at, Wanted::default(), &Watch::none()));
        let (mut complete, mut paths, mut steps, mut retried) = (0, 0, 0, 0);
        for report in reports {
            complete += usize::from(report.lost == 0);
            paths += report.generic;
            steps += report.steps;
            retried += report.retried;
        }
        println!(
            "{name}: {} solutions, {:.1} steps a path, {retried} of {paths} paths followed \
             again, {complete} of {} inputs complete",
            solver.generic().count(),
            steps as f64 / paths as f64,
            inputs.len()
        );
        for (what, certificates) in [("certified", true), ("not certified", false)] {
            let wanted = Wanted {
                starts: false,
                proof: None,
                certificates,
                all_complex: false,
            };
            let mut next = inputs.iter().cycle();
            group.bench_function(format!("{name}, {what}"), |bencher| {
                bencher.iter(|| {
                    let at = next.next().expect("a cycle never ends");
                    black_box(solver.at(at, wanted, &Watch::none()))
                });
            });
        }
    }
    group.finish();
}
