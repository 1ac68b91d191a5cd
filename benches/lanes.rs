//! Eight motions side by side in vector registers beside the same motions one by one, on one core.
//!
//! Criterion times 8 × 1,000 solves; the lines beside it give the median quotient of eleven pairs of sweeps.

// a bench prints its ratios
#![allow(clippy::print_stdout)]

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::number::{LANES, Lanes};
use linkwork::system::{MotionTracker, Question};

const SOLVES: usize = 1_000;

criterion_group!(benches, all);
criterion_main!(benches);

/// Held joints on circles about home; lane `i` starts a fraction of a turn later.
struct Work {
    name: &'static str,
    joints: &'static [&'static str],
    amplitude: f64,
}

const WORK: [Work; 4] = [
    Work {
        name: "four_bar",
        joints: &["theta1"],
        amplitude: 0.6,
    },
    Work {
        name: "planar_3rpr",
        joints: &["rho1", "rho2", "rho3"],
        amplitude: 0.3,
    },
    Work {
        name: "three_rps",
        joints: &["l1", "l2", "l3"],
        // home is near a fold
        amplitude: 0.005,
    },
    Work {
        name: "stewart_gough_6sps",
        joints: &["l1", "l2", "l3", "l4", "l5", "l6"],
        amplitude: 0.05,
    },
];

impl Work {
    fn mechanism(&self) -> Mechanism {
        Mechanism::load(format!("mechanisms/{}.ron", self.name)).expect("a shipped file")
    }

    fn places(&self, mechanism: &Mechanism) -> Vec<usize> {
        let place = |name: &&str| mechanism.joint(name).expect("a joint of the file");
        self.joints.iter().map(place).collect()
    }

    /// Held values of one lane at step `k`.
    fn value(&self, home: f64, place: usize, lane: usize, k: usize) -> f64 {
        let turn = k as f64 / SOLVES as f64 + lane as f64 / LANES as f64;
        home + self.amplitude * (TAU * (turn + 0.13 * place as f64)).sin()
    }
}

fn all(criterion: &mut Criterion) {
    for work in &WORK {
        compare(criterion, work);
    }
}

fn compare(criterion: &mut Criterion, work: &Work) {
    let mechanism = work.mechanism();
    let question = Question::new(&mechanism);
    let (places, home) = (work.places(&mechanism), mechanism.home());
    // each lane is brought to its start along the motion of the first
    let mut first = MotionTracker::new(question.system(), question.start());
    let mut starts: Vec<Configuration<f64>> = Vec::new();
    for k in 0..SOLVES {
        let report = first.solve(|at| {
            for (i, &place) in places.iter().enumerate() {
                at.joints[place] = work.value(home.joints[place], i, 0, k);
            }
        });
        if !report.solved {
            first.recover(&Default::default());
        }
        if k.is_multiple_of(SOLVES / LANES) {
            starts.push(first.configuration().clone());
        }
    }
    let one_by_one = |starts: &[Configuration<f64>]| -> Vec<Configuration<f64>> {
        let follow = |(lane, start): (usize, &Configuration<f64>)| {
            let mut tracker = MotionTracker::new(question.system(), start.clone());
            for k in 0..SOLVES {
                let report = tracker.solve(|at| {
                    for (i, &place) in places.iter().enumerate() {
                        at.joints[place] = work.value(home.joints[place], i, lane, k);
                    }
                });
                assert!(report.solved);
            }
            tracker.configuration().clone()
        };
        starts.iter().enumerate().map(follow).collect()
    };
    let side_by_side = |starts: &[Configuration<f64>]| -> Configuration<Lanes> {
        let start = Configuration::beside(|lane| &starts[lane]);
        let mut tracker = MotionTracker::<Lanes>::new(question.system_over(), start);
        for k in 0..SOLVES {
            let report = tracker.solve(|at| {
                for (i, &place) in places.iter().enumerate() {
                    let value = |lane| work.value(home.joints[place], i, lane, k);
                    at.joints[place] = Lanes::new(std::array::from_fn(value));
                }
            });
            assert!(report.solved);
        }
        tracker.configuration().clone()
    };
    let (alone, beside) = (one_by_one(&starts), side_by_side(&starts));
    let mut worst = 0.0f64;
    for (lane, alone) in alone.iter().enumerate() {
        let lane = beside.lane(lane);
        for (a, b) in alone.joints.iter().zip(&lane.joints) {
            worst = worst.max((a - b).abs());
        }
    }
    let time = |sweep: &dyn Fn()| {
        let start = Instant::now();
        sweep();
        start.elapsed().as_secs_f64() * 1e9 / (LANES * SOLVES) as f64
    };
    let mut quotients: Vec<(f64, f64, f64)> = (0..11)
        .map(|_| {
            let alone = time(&|| drop(black_box(one_by_one(&starts))));
            let beside = time(&|| drop(black_box(side_by_side(&starts))));
            (alone / beside, alone, beside)
        })
        .collect();
    quotients.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (quotient, alone, beside) = quotients[5];
    println!(
        "\n{}: {alone:.0} ns a solve alone, {beside:.0} ns side by side, {quotient:.2} times as many; they differ by {worst:.1e}",
        work.name
    );
    let mut group = criterion.benchmark_group(work.name);
    group.throughput(Throughput::Elements((LANES * SOLVES) as u64));
    group.sample_size(10);
    group.bench_function("one by one", |b| b.iter(|| one_by_one(&starts)));
    group.bench_function("side by side", |b| b.iter(|| side_by_side(&starts)));
    group.finish();
}
