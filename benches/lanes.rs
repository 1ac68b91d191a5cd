//! Motions side by side beside the same motions one by one and beside solvers written by hand, on one core.
//!
//! Every figure is the median of eleven sweeps, and every quotient that of pairs of sweeps in turn.

// a bench prints its figures; instructions are chosen at run time
#![allow(clippy::print_stdout, unsafe_code)]

#[allow(dead_code)]
#[path = "engine/mod.rs"]
mod engine;
#[path = "limits/mod.rs"]
mod limits;

use std::array::from_fn;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use limits::lanes::{FourBars, LANES, Platforms};
use limits::stewart_gough::Pose;
use linkwork::algebra::BATCH;
use linkwork::analysis::solver::Follower;
use linkwork::ask;
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::solve::Watch;
use linkwork::system::{Coordinate, MotionTracker, Question};

/// Solves of each motion.
const SOLVES: usize = 1_000;
/// Sweeps of which the median is taken.
const SWEEPS: usize = 11;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for work in &WORK {
        let name = work.name.to_string();
        let names = wanted.iter().filter(|word| !word.starts_with("--"));
        if names.clone().next().is_none() || names.clone().any(|word| *word == name) {
            compare(work);
        }
    }
}

/// Held joints on circles about home; motion `i` begins a fraction of a turn later.
struct Work {
    name: &'static str,
    joints: &'static [&'static str],
    amplitude: f64,
    limit: Option<Limit>,
}

/// A limit that is led from configurations through rows of values.
type Limit = fn(&[Configuration<f64>], &dyn Fn(usize, usize) -> Vec<f64>, &[usize]) -> f64;

const WORK: [Work; 4] = [
    Work {
        name: "four_bar",
        joints: &["theta1"],
        amplitude: 0.6,
        limit: Some(four_bars),
    },
    Work {
        name: "planar_3rpr",
        joints: &["rho1", "rho2", "rho3"],
        amplitude: 0.3,
        limit: None,
    },
    Work {
        name: "three_rps",
        joints: &["l1", "l2", "l3"],
        // home is near a fold
        amplitude: 0.005,
        limit: None,
    },
    Work {
        name: "stewart_gough_6sps",
        joints: &["l1", "l2", "l3", "l4", "l5", "l6"],
        amplitude: 0.05,
        limit: Some(platforms),
    },
];

impl Work {
    fn mechanism(&self) -> Mechanism {
        match self.name {
            "four_bar" => engine::four_bar(),
            name => linkwork::load(format!("mechanisms/{name}.ron")).expect("a shipped file"),
        }
    }
}

fn compare(work: &Work) {
    let mechanism = work.mechanism();
    let question = Question::new(&mechanism);
    let place = |name: &&str| mechanism.joint(name).expect("a joint of the file");
    let places: Vec<usize> = work.joints.iter().map(place).collect();
    let home = mechanism.home();
    let value = |motion: usize, k: usize| -> Vec<f64> {
        let turn = k as f64 / SOLVES as f64 + motion as f64 / BATCH as f64;
        let all = places.iter().enumerate();
        all.map(|(i, &place)| {
            home.joints[place] + work.amplitude * (TAU * (turn + 0.13 * i as f64)).sin()
        })
        .collect()
    };
    // each motion is brought to its start along the first one
    let mut first = MotionTracker::new(question.system(), question.start());
    let mut starts: Vec<Configuration<f64>> = Vec::new();
    for motion in 0..BATCH {
        for k in 0..SOLVES {
            let turn = motion * SOLVES / BATCH;
            if k + turn > (motion + 1) * SOLVES / BATCH {
                break;
            }
            let values = value(0, k + turn);
            let report = first.solve(|at| put(at, &places, &values));
            if !report.solved {
                first.recover(&Default::default());
            }
            if k == 0 {
                starts.push(first.configuration().clone());
            }
        }
    }
    let rows: Vec<Vec<Vec<f64>>> = (0..BATCH)
        .map(|motion| (0..SOLVES).map(|k| value(motion, k)).collect())
        .collect();
    let one_by_one = || {
        for (start, rows) in starts.iter().zip(&rows) {
            let mut tracker = MotionTracker::new(question.system(), start.clone());
            for values in rows {
                assert!(tracker.solve(|at| put(at, &places, values)).solved);
            }
            black_box(tracker.configuration());
        }
    };
    let coordinates: Vec<Coordinate> = places
        .iter()
        .map(|&place| Coordinate::Joint(place))
        .collect();
    let begun = Instant::now();
    let follower = Follower::new(&question, &starts[0], &coordinates);
    let follower = follower.expect("a regular start");
    let recording = begun.elapsed().as_secs_f64() * 1e6;
    let side_by_side = || {
        let mut motions = follower.motions(&starts[0]);
        (starts.iter().enumerate()).for_each(|(motion, at)| follower.put(&mut motions, motion, at));
        for k in 0..SOLVES {
            for i in 0..places.len() {
                let values = follower.values(&mut motions, i);
                for (value, rows) in values.iter_mut().zip(&rows) {
                    *value = rows[k][i];
                }
            }
            let solved = follower.solve(&mut motions, &[true; BATCH]);
            assert!(!solved.contains(&false));
        }
        motions
    };
    // the whole question: rows of the first motion, over and over
    let all: Vec<f64> = (rows.iter().flatten().flatten()).copied().collect();
    let names: Vec<String> = work.joints.iter().map(|name| (*name).into()).collect();
    let asked = ask::Question::new(mechanism.clone());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("a thread");
    let many = || {
        let many = pool.install(|| asked.solve_many(&names, &all, &Watch::none()));
        let many = many.expect("a right question");
        assert!(!many.reached.contains(&false));
        black_box(many);
    };
    let time = |sweep: &dyn Fn()| {
        let start = Instant::now();
        sweep();
        start.elapsed().as_secs_f64() * 1e9 / (BATCH * SOLVES) as f64
    };
    let median = |mut of: Vec<f64>| {
        of.sort_by(f64::total_cmp);
        of[of.len() / 2]
    };
    let mut times: [Vec<f64>; 4] = from_fn(|_| Vec::new());
    for _ in 0..SWEEPS {
        times[0].push(time(&one_by_one));
        times[1].push(time(&|| drop(black_box(side_by_side()))));
        times[2].push(time(&many));
        if let Some(limit) = work.limit {
            times[3].push(limit(
                &starts,
                &|motion, k| rows[motion][k].clone(),
                &places,
            ));
        }
    }
    let quotient =
        |a: usize, b: usize| median(times[a].iter().zip(&times[b]).map(|(a, b)| a / b).collect());
    let [alone, beside, asked] = [0, 1, 2].map(|i| median(times[i].clone()));
    println!(
        "{}: {alone:.0} ns a solve one by one, {beside:.1} side by side ({:.2} times as many), {asked:.1} by solve_many; written down in {recording:.0} µs",
        work.name,
        quotient(0, 1),
    );
    if work.limit.is_some() {
        println!(
            "    by hand in eight lanes {:.1} ns: side by side takes {:.2} times as long",
            median(times[3].clone()),
            quotient(1, 3)
        );
    }
}

fn put(at: &mut Configuration<f64>, places: &[usize], values: &[f64]) {
    for (&place, &value) in places.iter().zip(values) {
        at.joints[place] = value;
    }
}

/// The time of a solve in ns.
fn four_bars(
    starts: &[Configuration<f64>],
    value: &dyn Fn(usize, usize) -> Vec<f64>,
    places: &[usize],
) -> f64 {
    let mechanism = engine::four_bar();
    let [coupler, rocker] = ["phi2", "phi1"].map(|name| mechanism.joint(name).expect("a joint"));
    let crank = places[0];
    let groups = (0..BATCH / LANES).map(|group| {
        let lane = |i: usize| &starts[group * LANES + i].joints;
        let at = FourBars::at([
            from_fn(|i| lane(i)[crank] + lane(i)[coupler]),
            from_fn(|i| lane(i)[rocker]),
        ]);
        let rows = (0..SOLVES).map(|k| from_fn(|i| value(group * LANES + i, k)[0]));
        (at, rows.collect::<Vec<[f64; LANES]>>())
    });
    let groups: Vec<(FourBars, Vec<[f64; LANES]>)> = groups.collect();
    timed(|| {
        for (at, rows) in &groups {
            let mut at = *at;
            assert!(at.follow(rows));
            black_box(at.sines());
        }
    })
}

fn platforms(
    starts: &[Configuration<f64>],
    value: &dyn Fn(usize, usize) -> Vec<f64>,
    _: &[usize],
) -> f64 {
    let groups = (0..BATCH / LANES).map(|group| {
        let at = Platforms::at(from_fn(|i| {
            let top = &starts[group * LANES + i].platforms[0];
            Pose {
                p: top.position.0,
                q: top.orientation.0,
            }
        }));
        let rows = (0..SOLVES).map(|k| {
            let all: [Vec<f64>; LANES] = from_fn(|i| value(group * LANES + i, k));
            from_fn(|leg| from_fn(|i| all[i][leg]))
        });
        (at, rows.collect::<Vec<[[f64; LANES]; 6]>>())
    });
    let groups: Vec<(Platforms, Vec<[[f64; LANES]; 6]>)> = groups.collect();
    timed(|| {
        for (at, rows) in &groups {
            let mut at = *at;
            assert!(at.follow(rows));
            black_box(at.pose(0));
        }
    })
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e9 / (BATCH * SOLVES) as f64
}
