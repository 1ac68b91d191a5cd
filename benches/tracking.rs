//! Following a mechanism along a trajectory, and finding it from afar: time for one solved configuration.
//!
//! Criterion times chunks of 10,000 solves, so 1 ms reads as 100 ns a solve. The lines beside it give steps,
//! successes, the largest residual (recomputed here from the geometry) and the median and best time of
//! eleven whole sweeps.

// a bench prints its ratios
#![allow(clippy::print_stdout)]
// the yardstick uses intrinsics of the processor
#![allow(unsafe_code)]

mod engine;
mod generated;
mod limits;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};

use limits::{
    Inline, Pxfm, Report, Std, TOLERANCE, Tally, four_bar, stewart_gough, three_rps, trajectories,
};

const CHUNK: usize = 10_000;
/// Cold questions asked of the engine, of the 10,000 starts.
const QUESTIONS: usize = 1_000;

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .without_plots();
    targets = a_four_bar, b_three_rps, c_stewart_gough
}
criterion_main!(benches);

fn a_four_bar(criterion: &mut Criterion) {
    let inputs = trajectories::crank_angles();
    let mut group = group(criterion, "A: 4-bar");
    let open = four_bar::State::open();
    let angles = |s: &four_bar::State, t1: f64| four_bar_residual(t1, s.t);
    let carried = |s: &four_bar::Carried, t1: f64| four_bar_residual(t1, s.t.map(|c| c.angle()));

    track(
        &mut group,
        "limit, std",
        &inputs,
        open,
        four_bar::solve::<Std>,
        angles,
    );
    track(
        &mut group,
        "limit, pxfm",
        &inputs,
        open,
        four_bar::solve::<Pxfm>,
        angles,
    );
    track(
        &mut group,
        "limit",
        &inputs,
        open,
        four_bar::solve::<Inline>,
        angles,
    );
    track(
        &mut group,
        "limit, predictor",
        &inputs,
        open,
        four_bar::solve_predicted::<Inline>,
        angles,
    );
    track(
        &mut group,
        "limit, carried",
        &inputs,
        open.into(),
        four_bar::track::<Inline>,
        carried,
    );
    track(
        &mut group,
        "limit, carried, predictor",
        &inputs,
        open.into(),
        four_bar::track_predicted::<Inline>,
        carried,
    );

    let mechanism = engine::four_bar();
    let start = engine::follow_four_bar(&mechanism);
    let angles = |f: &engine::Follower<1>, t1: f64| {
        four_bar_residual(t1, engine::four_bar_angles(&mechanism, f))
    };
    track(
        &mut group,
        "generated, predictor",
        &inputs,
        generated::four_bar::Follower::new(start.state()),
        |f, t1| verdict(f.solve(&[t1]) == generated::four_bar::Verdict::Solved),
        |f, t1| four_bar_residual(t1, [t1 + f.state[0], f.state[1]]),
    );
    for (name, start) in [
        ("engine", start.clone().without_predictor()),
        ("engine, predictor", start),
    ] {
        track(
            &mut group,
            name,
            &inputs,
            start,
            |f, t1| f.solve([t1]),
            angles,
        );
    }
    group.finish();
}

fn b_three_rps(criterion: &mut Criterion) {
    let inputs = trajectories::rps_legs();
    let mut group = group(criterion, "B: 3-RPS");
    let start = three_rps::State::ramped_to(inputs[0]);
    let angles = |s: &three_rps::State, legs: [f64; 3]| three_rps_residual(legs, s.angles);
    let carried = |s: &three_rps::Carried, legs: [f64; 3]| {
        three_rps_residual(legs, s.angles.map(|c| c.angle()))
    };

    track(
        &mut group,
        "limit, std",
        &inputs,
        start,
        three_rps::solve::<Std>,
        angles,
    );
    track(
        &mut group,
        "limit, pxfm",
        &inputs,
        start,
        three_rps::solve::<Pxfm>,
        angles,
    );
    track(
        &mut group,
        "limit",
        &inputs,
        start,
        three_rps::solve::<Inline>,
        angles,
    );
    track(
        &mut group,
        "limit, predictor",
        &inputs,
        start,
        three_rps::solve_predicted::<Inline>,
        angles,
    );
    track(
        &mut group,
        "limit, carried",
        &inputs,
        start.into(),
        three_rps::track,
        carried,
    );
    track(
        &mut group,
        "limit, carried, predictor",
        &inputs,
        start.into(),
        three_rps::track_predicted,
        carried,
    );
    for unreachable in [[0.8, 0.8, 5.0], [0.8, 0.8, f64::NAN]] {
        assert!(!three_rps::solve::<Std>(&mut start.clone(), unreachable).converged);
    }
    let starts = trajectories::rps_cold();
    cold(&mut group, "limit, cold", || {
        three_rps::cold_starts(&starts)
    });

    let mechanism = engine::three_rps();
    let start = engine::follow_three_rps(&mechanism, inputs[0]);
    let angles = |f: &engine::Follower<3>, legs| {
        three_rps_residual(legs, engine::three_rps_angles(&mechanism, f))
    };
    track(
        &mut group,
        "generated, predictor",
        &inputs,
        generated::three_rps::Follower::new(start.state()),
        |f, legs| verdict(f.solve(&legs) == generated::three_rps::Verdict::Solved),
        |f, legs| {
            let angles = [0, 1, 2].map(|leg| TAU / 4.0 - f.state[leg]);
            three_rps_residual(legs, angles)
        },
    );
    for (name, start) in [
        ("engine", start.clone().without_predictor()),
        ("engine, predictor", start),
    ] {
        track(
            &mut group,
            name,
            &inputs,
            start,
            engine::Follower::solve,
            angles,
        );
    }
    cold(&mut group, "engine, cold, whole question", || {
        engine::three_rps_cold(&mechanism, &starts[..QUESTIONS])
    });
    group.finish();
}

fn c_stewart_gough(criterion: &mut Criterion) {
    let poses = trajectories::platform_poses();
    let inputs: Vec<_> = poses.iter().map(|pose| (pose.legs(), *pose)).collect();
    let mut group = group(criterion, "C: Stewart-Gough");
    // one row behind the first, so that the first row is a warm start like the others
    let start = stewart_gough::State::at(poses[poses.len() - 1]);
    // the legs' own residual, and the distance from the pose that made them
    let residual = |s: &stewart_gough::State, (legs, truth): ([f64; 6], stewart_gough::Pose)| {
        let distance = s.pose.distance(&truth);
        assert!(
            distance < 1e-11,
            "the pose is {distance:e} away from the truth"
        );
        s.pose
            .legs()
            .iter()
            .zip(legs)
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    };

    track(
        &mut group,
        "limit",
        &inputs,
        start,
        |s, (legs, _)| stewart_gough::solve(s, legs),
        residual,
    );
    track(
        &mut group,
        "limit, predictor",
        &inputs,
        start,
        |s, (legs, _)| stewart_gough::solve_predicted(s, legs),
        residual,
    );
    track(
        &mut group,
        "limit, in order",
        &inputs,
        start,
        |s, (legs, _)| stewart_gough::solve_in_order(s, legs),
        residual,
    );
    track(
        &mut group,
        "limit, in order, predictor",
        &inputs,
        start,
        |s, (legs, _)| stewart_gough::solve_in_order_predicted(s, legs),
        residual,
    );
    #[cfg(target_arch = "x86_64")]
    if stewart_gough::wide::available() {
        use stewart_gough::wide;
        // SAFETY: the processor's features have been asked for
        track(
            &mut group,
            "limit, wide",
            &inputs,
            start,
            |s, (legs, _)| unsafe { wide::solve(s, legs) },
            residual,
        );
        track(
            &mut group,
            "limit, wide, predictor",
            &inputs,
            start,
            |s, (legs, _)| unsafe { wide::solve_predicted(s, legs) },
            residual,
        );
    }
    for unreachable in [5.0, f64::NAN] {
        let legs = [1.0, 1.2, unreachable, 1.2, 1.0, 1.2];
        assert!(!stewart_gough::solve(&mut start.clone(), legs).converged);
    }
    for (name, starts) in [
        (
            "limit, cold from home",
            trajectories::platform_cold_from_home(),
        ),
        (
            "limit, cold from random",
            trajectories::platform_cold_from_random(),
        ),
    ] {
        cold(&mut group, name, || stewart_gough::cold_starts(&starts));
        println!(
            "  {} of {} land in the pose that made the legs",
            stewart_gough::cold_starts_at_truth(&starts),
            starts.len()
        );
    }

    let mechanism = engine::stewart_gough();
    let start = engine::follow_stewart_gough(&mechanism, poses[poses.len() - 1]);
    track(
        &mut group,
        "generated, predictor",
        &inputs,
        generated::stewart_gough_6sps::Follower::new(start.state()),
        |f, (legs, _)| verdict(f.solve(&legs) == generated::stewart_gough_6sps::Verdict::Solved),
        |f, input| residual(&stewart_gough::State::at(engine::pose_of(&f.state)), input),
    );
    let engine_residual = |f: &engine::Follower<6>, input| {
        residual(
            &stewart_gough::State::at(engine::stewart_gough_pose(f)),
            input,
        )
    };
    for (name, start) in [
        ("engine", start.clone().without_predictor()),
        ("engine, predictor", start),
    ] {
        track(
            &mut group,
            name,
            &inputs,
            start,
            |f, (legs, _)| f.solve(legs),
            engine_residual,
        );
    }
    for (from, starts) in [
        ("home", trajectories::platform_cold_from_home()),
        ("random", trajectories::platform_cold_from_random()),
    ] {
        cold(&mut group, &format!("engine, cold from {from}"), || {
            engine::stewart_gough_newton(&mechanism, &starts)
        });
        let name = format!("engine, cold from {from}, whole question");
        cold(&mut group, &name, || {
            engine::stewart_gough_cold(&mechanism, &starts[..QUESTIONS])
        });
    }
    group.finish();
}

/// Solvers written by `generate` count no steps.
fn verdict(converged: bool) -> Report {
    Report {
        steps: 0,
        residual: 0.0,
        converged,
    }
}

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(CHUNK as u64));
    group
}

/// Follows the whole trajectory once, asserting every row; then times it, the chunks in turn.
fn track<S: Clone, I: Copy>(
    group: &mut BenchmarkGroup<WallTime>,
    name: &str,
    inputs: &[I],
    start: S,
    solve: impl Fn(&mut S, I) -> Report,
    residual: impl Fn(&S, I) -> f64,
) {
    let (mut state, mut starts, mut tally) = (start, Vec::new(), Tally::default());
    for (row, &input) in inputs.iter().enumerate() {
        if row % CHUNK == 0 {
            starts.push(state.clone());
        }
        let report = solve(&mut state, input);
        let found = residual(&state, input);
        assert!(
            report.converged && found <= TOLERANCE,
            "{name}: row {row}: {report:?}, recomputed {found:e}"
        );
        tally.solves += 1;
        tally.converged += 1;
        tally.steps += u64::from(report.steps);
        tally.worst = tally.worst.max(found);
    }

    let chunk = |k: usize| {
        let mut state = starts[k].clone();
        let mut steps = 0;
        for &input in &inputs[k * CHUNK..(k + 1) * CHUNK] {
            steps += solve(&mut state, input).steps;
        }
        black_box((state, steps));
    };
    print_line(name, &tally, || (0..starts.len()).for_each(chunk));
    let mut k = 0;
    group.bench_function(name, |b| {
        b.iter(|| {
            chunk(k);
            k = (k + 1) % starts.len();
        })
    });
}

/// Times a set of cold starts; how many succeed is a result, not a demand.
fn cold(group: &mut BenchmarkGroup<WallTime>, name: &str, solve_all: impl Fn() -> Tally) {
    print_line(name, &solve_all(), || {
        black_box(solve_all());
    });
    group.bench_function(name, |b| b.iter(&solve_all));
}

fn print_line(name: &str, tally: &Tally, sweep: impl Fn()) {
    let mut times = [0.0; 11];
    for time in &mut times {
        let start = Instant::now();
        sweep();
        *time = start.elapsed().as_secs_f64() * 1e9 / tally.solves as f64;
    }
    times.sort_by(f64::total_cmp);
    println!(
        "\n{name}: {:.1} ns a solve (best {:.1}), {:.2} steps, {} of {} solved ({:.1} %), residual {:.1e}",
        times[times.len() / 2],
        times[0],
        tally.mean_steps(),
        tally.converged,
        tally.solves,
        100.0 * tally.rate(),
        tally.worst,
    );
}

/// max(|fx|, |fy|), from the angles and the standard library alone.
fn four_bar_residual(t1: f64, [t2, t3]: [f64; 2]) -> f64 {
    use four_bar::{L0, L1, L2, L3};
    assert!(
        (0.0..=TAU / 2.0).contains(&t3.rem_euclid(TAU)),
        "left the open branch"
    );
    let fx = L1 * t1.cos() + L2 * t2.cos() - L0 - L3 * t3.cos();
    let fy = L1 * t1.sin() + L2 * t2.sin() - L3 * t3.sin();
    fx.abs().max(fy.abs())
}

/// The largest error of a squared side, from the spherical joints in space.
fn three_rps_residual(legs: [f64; 3], angles: [f64; 3]) -> f64 {
    let s: [[f64; 3]; 3] = std::array::from_fn(|i| {
        let (e, r) = (TAU * i as f64 / 3.0, 1.0 - legs[i] * angles[i].cos());
        [r * e.cos(), r * e.sin(), legs[i] * angles[i].sin()]
    });
    [(0, 1), (1, 2), (2, 0)]
        .map(|(i, j)| {
            ((0..3).map(|k| (s[i][k] - s[j][k]).powi(2)).sum::<f64>() - three_rps::SIDE2).abs()
        })
        .into_iter()
        .fold(0.0, f64::max)
}
