//! A map of the workspace with lanes on all cores beside the same map with single numbers on one.
//!
//! Criterion times the former; the lines beside it give the median quotient of pairs of maps made in
//! turn. Registers are half as wide without AVX2: `RUSTFLAGS="-C target-cpu=x86-64-v3"` builds with it.

// a bench prints its ratios
#![allow(clippy::print_stdout)]

use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use linkwork::analysis::workspace::{WorkspaceSettings, workspace};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::{Driven, Question};

criterion_group!(benches, all);
criterion_main!(benches);

struct Work {
    name: &'static str,
    mapped: &'static [(&'static str, f64, f64)],
    held: &'static [(&'static str, &'static str)],
    nodes: usize,
}

const WORK: [Work; 3] = [
    Work {
        name: "five_bar_hand",
        mapped: &[("hand.x", -0.63, 0.81), ("hand.y", -0.72, 0.74)],
        held: &[],
        nodes: 400,
    },
    Work {
        name: "three_rps",
        mapped: &[("top.roll", -1.2, 1.2), ("top.pitch", -1.2, 1.2)],
        held: &[("top.z", "0.7")],
        nodes: 400,
    },
    Work {
        name: "stewart_gough_6ups",
        mapped: &[("top.x", -0.3, 0.3), ("top.y", -0.3, 0.3)],
        held: &[
            ("top.z", "home"),
            ("top.roll", "home"),
            ("top.pitch", "home"),
            ("top.yaw", "home"),
        ],
        nodes: 240,
    },
];

fn all(criterion: &mut Criterion) {
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let names = |work: &&Work| wanted.is_empty() || wanted.iter().any(|name| name == work.name);
    for work in WORK.iter().filter(names) {
        compare(criterion, work);
    }
}

fn compare(criterion: &mut Criterion, work: &Work) {
    const PAIRS: usize = 5;
    let mechanism =
        Mechanism::load(format!("mechanisms/{}.ron", work.name)).expect("a shipped file");
    let mut question = Question::new(&mechanism)
        .free("actuated")
        .expect("a question");
    for (name, value) in work.held {
        question = question.hold(name, *value).expect("a coordinate");
    }
    for (name, from, to) in work.mapped {
        let middle = format!("{:?}", 0.5 * (from + to));
        question = question.hold(name, &middle).expect("a coordinate");
    }
    let axes: Vec<Driven> = (work.mapped.iter())
        .map(|(name, from, to)| Driven {
            coordinate: question.value(name, "home").expect("a coordinate").0,
            from: *from,
            to: *to,
        })
        .collect();
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let map = |side_by_side: bool| {
        let settings = WorkspaceSettings {
            nodes: vec![work.nodes; axes.len()],
            side_by_side,
            // of the map alone: few places are searched for modes, no boundaries followed
            searched: 4,
            starts: 8,
            probed: 0,
            boundaries: false,
            ..WorkspaceSettings::default()
        };
        let run = || workspace(&question, &axes, (&[], None), &settings, &Watch::none());
        let report = match side_by_side {
            true => run(),
            false => one.install(run),
        };
        report.expect("few enough nodes").cells.len()
    };
    let time = |side_by_side: bool| {
        let begun = Instant::now();
        let cells = map(side_by_side);
        (begun.elapsed().as_secs_f64() / cells as f64, cells)
    };
    let mut quotients = Vec::new();
    let mut fastest = [f64::INFINITY; 2];
    let mut cells = 0;
    for _ in 0..PAIRS {
        let ((alone, count), (beside, again)) = (time(false), time(true));
        assert_eq!(count, again);
        cells = count;
        fastest = [fastest[0].min(alone), fastest[1].min(beside)];
        quotients.push(alone / beside);
    }
    quotients.sort_by(f64::total_cmp);
    println!(
        "workspace/{}: {cells} nodes in modes, {:.2} µs each alone, {:.2} µs with lanes on {} threads{}: \
         {:.2} times as fast (median of {PAIRS})",
        work.name,
        fastest[0] * 1e6,
        fastest[1] * 1e6,
        rayon::current_num_threads(),
        if cfg!(target_feature = "avx2") {
            ""
        } else {
            " without AVX2"
        },
        quotients[PAIRS / 2]
    );
    let mut group = criterion.benchmark_group("workspace");
    group.sample_size(10);
    group.bench_function(work.name, |bencher| bencher.iter(|| map(true)));
    group.finish();
}
