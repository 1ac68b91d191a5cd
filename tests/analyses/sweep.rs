//! Motion: sweeps, whole curves, circuits. Expected values are closed forms of the textbooks, computed here
//! without the program, and published tables.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use linkwork::analysis::sweep::{
    CircuitsReport, CircuitsSettings, FourBarClass, MetKind, Row, SweepEnd, SweepReport,
    SweepSettings, circuits, sweep,
};
use linkwork::ask;
use linkwork::description::Description;
use linkwork::mechanism::{Configuration, Mechanism, NamedPoint};
use linkwork::solve::Watch;
use linkwork::solve::{Equations, Newton, Stop};
use linkwork::system::{Coordinate, Curve, Driven, Held, Question, Search, System, Walk};
use serde_json::Value;

/// Rows close to 1e-12 of the characteristic length; times 5 m, the condition number of these linkages, up to 4, and
/// the root of their rows, that leaves positions in m uncertain by this much.
const CLOSED: f64 = 5e-11;

fn with(name: &str, parameters: &[(&str, f64)]) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let mut description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    for (name, value) in parameters {
        description = description
            .with_parameter(name, &format!("{value:?}"))
            .unwrap();
    }
    Mechanism::new(&description).unwrap()
}

fn mechanism(name: &str) -> Mechanism {
    with(name, &[])
}

fn data(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn joint(mechanism: &Mechanism, name: &str, from: f64, to: f64) -> Driven {
    Driven {
        coordinate: Coordinate::Joint(mechanism.joint(name).unwrap()),
        from,
        to,
    }
}

/// Assembled with the inputs at the start of their segment, from a guess for the rest.
fn start(mechanism: &Mechanism, inputs: &[Driven], guess: &[(&str, f64)]) -> Configuration<f64> {
    let mut held = Held::nothing(mechanism);
    let mut at = mechanism.home();
    for (name, value) in guess {
        at.joints[mechanism.joint(name).unwrap()] = *value;
    }
    for input in inputs {
        let Coordinate::Joint(joint) = input.coordinate else {
            panic!("joints only")
        };
        held.joints[joint] = true;
        at.joints[joint] = input.from;
    }
    let system = System::new(mechanism.dimensions(), &held);
    let mut trial = at.clone();
    let report = Newton::default().solve(&system, &mut at, &mut trial, &mut system.work());
    assert_eq!(report.stop, Stop::Solved);
    at
}

/// The number of the step, the configuration, the traced points.
type SweptRow = (Option<usize>, Configuration<f64>, Vec<[f64; 3]>);

struct Swept {
    report: SweepReport,
    rows: Vec<SweptRow>,
}

impl Swept {
    fn ending(&self) -> SweepEnd {
        self.report.ending
    }

    /// The row of a step, the first time it comes.
    fn step(&self, step: usize) -> &SweptRow {
        self.rows.iter().find(|row| row.0 == Some(step)).unwrap()
    }

    fn folds(&self) -> Vec<Vec<f64>> {
        let folds = self.report.met.iter();
        let folds = folds.filter(|met| matches!(met.kind, MetKind::Fold { .. }));
        folds.map(|met| met.joints.clone()).collect()
    }
}

fn run(
    mechanism: &Mechanism,
    inputs: &[Driven],
    guess: &[(&str, f64)],
    settings: &SweepSettings,
) -> Swept {
    let question = ask::Question::new(mechanism.clone()).free("actuated");
    let question = inputs.iter().fold(question, |question, input| {
        question.input(input.coordinate.name(mechanism), input.from, input.to)
    });
    let question = (guess.iter()).fold(question, |q, (name, value)| q.guess(*name, *value));
    let motions = question.motions(settings, &Watch::none()).unwrap();
    let mut rows = Vec::new();
    let mut sink = |row: &Row| {
        rows.push((row.step, row.configuration.clone(), row.points.to_vec()));
    };
    let report = motions.run(&motions.starts[0].1, &mut sink, &Watch::none());
    assert_eq!(report.rows, rows.len());
    Swept { report, rows }
}

fn steps(steps: usize) -> SweepSettings {
    SweepSettings {
        steps,
        ..SweepSettings::default()
    }
}

fn tracing(mechanism: &Mechanism, steps: usize, point: &str) -> SweepSettings {
    SweepSettings {
        points: vec![NamedPoint::read(mechanism, point).unwrap()],
        ..self::steps(steps)
    }
}

/// The difference of two angles but for whole turns.
fn apart(a: f64, b: f64) -> f64 {
    (a - b) - TAU * ((a - b) / TAU).round()
}

/// A 4-bar's rocker angle in closed form: the diagonal from the rocker's pivot to the crank's end.
fn rocker([l0, l1, l2, l3]: [f64; 4], crank: f64, side: f64) -> f64 {
    let (x, y) = (l1 * crank.cos() - l0, l1 * crank.sin());
    let diagonal = x.hypot(y);
    let at_pivot = (l3 * l3 + diagonal * diagonal - l2 * l2) / (2.0 * l3 * diagonal);
    y.atan2(x) - side * at_pivot.acos()
}

fn four_bar(lengths: [f64; 4]) -> Mechanism {
    let [l0, l1, l2, l3] = lengths;
    with(
        "four_bar",
        &[("l0", l0), ("l1", l1), ("l2", l2), ("l3", l3)],
    )
}

/// Guesses for a 4-bar with the crank at an angle.
fn four_bar_guess(lengths: [f64; 4], crank: f64, side: f64) -> [(&'static str, f64); 2] {
    let [l0, l1, _, l3] = lengths;
    let rocker = rocker(lengths, crank, side);
    let (x, y) = (
        l0 + l3 * rocker.cos() - l1 * crank.cos(),
        l3 * rocker.sin() - l1 * crank.sin(),
    );
    [("phi2", y.atan2(x) - crank), ("phi1", rocker)]
}

#[test]
fn the_end_of_a_full_turn_is_its_start() {
    for (name, input) in [
        ("four_bar", "theta1"),
        ("slider_crank", "theta"),
        ("watt_six_bar", "theta"),
        ("bennett", "theta1"),
        ("hoeken", "theta1"),
        ("jansen_leg", "theta"),
        ("klann_leg", "theta"),
    ] {
        let mechanism = mechanism(name);
        let home = mechanism.home().joints[mechanism.joint(input).unwrap()];
        let inputs = [joint(&mechanism, input, home, home + TAU)];
        let swept = run(&mechanism, &inputs, &[], &steps(90));
        assert_eq!(swept.ending(), SweepEnd::Complete, "{name}");
        assert_eq!(swept.rows.len(), 91);
        let (first, last) = (&swept.rows[0].1, &swept.rows[90].1);
        for (joint, (a, b)) in first.joints.iter().zip(&last.joints).enumerate() {
            let gap = match mechanism.repeats(joint) {
                true => apart(*a, *b),
                false => a - b,
            };
            assert!(gap.abs() < 1e-11, "{name}: {gap}");
        }
        // and it is nowhere assembled in another way on its way: every row closes
        let system = System::new(mechanism.dimensions(), &Held::nothing(&mechanism));
        for (_, at, _) in &swept.rows {
            assert!(
                system.residual(at, &mut system.work()).largest < 1e-12,
                "{name}"
            );
        }
    }
}

#[test]
fn rows_of_a_four_bar_are_those_of_the_closed_form_in_either_mode() {
    let lengths = [5.0, 1.0, 3.0, 4.0];
    let mechanism = four_bar(lengths);
    for side in [1.0, -1.0] {
        let inputs = [joint(&mechanism, "theta1", 0.4, 0.4 - 2.0 * TAU)];
        let swept = run(
            &mechanism,
            &inputs,
            &four_bar_guess(lengths, 0.4, side),
            &steps(7),
        );
        assert_eq!(swept.ending(), SweepEnd::Complete);
        for (step, at, _) in &swept.rows {
            let crank = 0.4 - 2.0 * TAU * step.unwrap() as f64 / 7.0;
            assert!((at.joints[0] - crank).abs() < 1e-14);
            let gap = apart(at.joints[2], rocker(lengths, crank, side));
            assert!(gap.abs() < 1e-12, "{step:?}: {gap}");
            assert!(apart(at.joints[2], rocker(lengths, crank, -side)).abs() > 0.1);
        }
    }
}

#[test]
fn a_slider_crank_moves_as_its_closed_form_says() {
    let mechanism = mechanism("slider_crank");
    let inputs = [joint(&mechanism, "theta", 0.5, 0.5 + TAU)];
    let swept = run(&mechanism, &inputs, &[], &steps(25));
    assert_eq!(swept.ending(), SweepEnd::Complete);
    for (_, at, _) in &swept.rows {
        let (theta, s) = (at.joints[0], at.joints[2]);
        let rise: f64 = theta.sin() - 0.5;
        assert!((s - theta.cos() - (9.0 - rise * rise).sqrt()).abs() < CLOSED);
    }
    // dead points of the slider: crank and rod in one line
    let turns: Vec<f64> = (swept.report.met.iter())
        .filter(|met| matches!(&met.kind, MetKind::Turning { joint } if joint == "s"))
        .map(|met| met.joints[2])
        .collect();
    let limit = |reach: f64| (reach * reach - 0.25_f64).sqrt();
    assert_eq!(turns.len(), 2);
    assert!((turns[0] - limit(2.0)).abs() < 1e-13 && (turns[1] - limit(4.0)).abs() < 1e-13);
}

/// cos θ₁ = (l0² + l1² − (l2 ± l3)²)/(2 l0 l1), where coupler and rocker lie in one line.
fn limits([l0, l1, l2, l3]: [f64; 4]) -> [f64; 2] {
    [l2 + l3, l2 - l3].map(|reach| ((l0 * l0 + l1 * l1 - reach * reach) / (2.0 * l0 * l1)).acos())
}

#[test]
fn the_input_limits_of_a_four_bar_are_exact() {
    // a rocker that swings to both sides of its limits, a triple rocker, one with both limits
    let mut tried = 0;
    for lengths in [
        [3.0, 2.5, 2.0, 1.0],
        [4.0, 3.0, 2.2, 2.9],
        [5.0, 4.0, 3.0, 1.5],
        [2.0, 1.9, 2.2, 1.4],
    ] {
        let mechanism = four_bar(lengths);
        for side in [1.0, -1.0] {
            let [wide, narrow] = limits(lengths);
            let narrow = if narrow.is_nan() { 0.0 } else { narrow };
            let wide = if wide.is_nan() { continue } else { wide };
            let from = 0.5 * (wide + narrow);
            for to in [from + TAU, from - TAU] {
                let inputs = [joint(&mechanism, "theta1", from, to)];
                let swept = run(
                    &mechanism,
                    &inputs,
                    &four_bar_guess(lengths, from, side),
                    &steps(50),
                );
                assert_eq!(swept.ending(), SweepEnd::Fold, "{lengths:?}");
                let fold = swept.folds()[0][0];
                let near = limits(lengths)
                    .iter()
                    .any(|limit| (fold.abs() - limit).abs() < 1e-12);
                assert!(near, "{lengths:?}: {fold} {:?}", limits(lengths));
                tried += 1;
                let locked = swept.report.met.iter().any(|met| match &met.kind {
                    MetKind::Fold { locked, .. } => locked == &["theta1"],
                    _ => false,
                });
                assert!(locked && swept.report.met.last().unwrap().singularity == Some(2));
            }
        }
    }
    assert!(tried >= 12);
    // a crank-rocker has none
    let lengths = [5.0, 1.0, 3.0, 4.0];
    assert!(limits(lengths).iter().all(|limit| limit.is_nan()));
}

#[test]
fn round_a_fold_the_same_inputs_come_again_on_the_other_branch() {
    let lengths = [3.0, 2.5, 2.0, 1.0];
    let mechanism = four_bar(lengths);
    let inputs = [joint(&mechanism, "theta1", 0.6, 1.5)];
    let settings = SweepSettings {
        follow: true,
        ..steps(30)
    };
    let swept = run(
        &mechanism,
        &inputs,
        &four_bar_guess(lengths, 0.6, 1.0),
        &settings,
    );
    assert_eq!(swept.ending(), SweepEnd::Returned);
    assert_eq!(swept.folds().len(), 1);
    let there: Vec<usize> = swept.rows.iter().filter_map(|row| row.0).collect();
    let highest = *there.iter().max().unwrap();
    let both: Vec<usize> = (0..=highest).chain((0..=highest).rev()).collect();
    assert_eq!(there, both);
    let fold = swept.rows.iter().position(|row| row.0.is_none()).unwrap();
    let sides = [1.0, -1.0];
    for (i, (_, at, _)) in swept.rows.iter().enumerate().filter(|(i, _)| *i != fold) {
        let side = sides[usize::from(i > fold)];
        let gap = apart(at.joints[2], rocker(lengths, at.joints[0], side));
        assert!(gap.abs() < 1e-10, "{i}: {gap}");
    }
}

#[test]
fn a_sweep_stops_where_branches_cross_and_goes_straight_on_when_told_to() {
    let mechanism = mechanism("parallelogram");
    let inputs = [joint(&mechanism, "theta1", 0.5, 0.5 + TAU)];
    let guess = [("phi2", -0.5), ("phi1", 0.5)];
    let swept = run(&mechanism, &inputs, &guess, &steps(40));
    assert_eq!(swept.ending(), SweepEnd::Crossing);
    let last = swept.report.met.last().unwrap();
    assert!((last.inputs[0] - PI).abs() < 1e-13);
    let MetKind::Crossing { freedoms, branches } = &last.kind else {
        panic!("{last:?}")
    };
    assert_eq!((*freedoms, branches.len()), (2, 2));
    assert_eq!(last.singularity, Some(3));
    // tangents: the parallelogram's, and the antiparallelogram's dφ1/dθ1 = (L + l)/(L − l) = 3 or 1/3
    for branch in branches {
        let slope = branch.rates[2] / branch.rates[0];
        let known = match branch.followed {
            true => (slope - 1.0).abs() < 1e-8,
            false => [3.0, -3.0, 1.0 / 3.0, -1.0 / 3.0]
                .iter()
                .any(|k| (slope - k).abs() < 1e-8),
        };
        assert!(known, "{slope}");
    }
    let settings = SweepSettings {
        follow: true,
        ..steps(40)
    };
    let swept = run(&mechanism, &inputs, &guess, &settings);
    assert_eq!(swept.ending(), SweepEnd::Complete);
    for (_, at, _) in &swept.rows {
        assert!(
            (at.joints[2] - at.joints[0]).abs() < 1e-11,
            "it stays a parallelogram"
        );
    }
    let crossings = swept
        .report
        .met
        .iter()
        .filter(|met| met.singularity == Some(3));
    assert_eq!(crossings.count(), 2);
    // at home, flat, a motion cannot begin
    let inputs = [joint(&mechanism, "theta1", 0.0, 1.0)];
    let report = sweep(
        &mechanism,
        &Held::nothing(&mechanism),
        &inputs,
        &mechanism.home(),
        &steps(10),
        &mut |_| {},
        &Watch::none(),
    );
    assert_eq!((report.ending, report.rows), (SweepEnd::SingularStart, 0));
    assert!(
        matches!(&report.met[0].kind, MetKind::Crossing { branches, .. } if branches.len() == 2)
    );
}

#[test]
fn a_kite_four_bar_crosses_where_its_equal_sides_fold_together() {
    // 5, 1, 3, 3 at θ1 = π: the published change point of rank 1
    let lengths = [4.0, 2.0, 4.0 - 1e-3, 2.0];
    // its neighbour, not quite a parallelogram, has no crossing: it comes by on one side
    let mechanism = four_bar(lengths);
    let inputs = [joint(&mechanism, "theta1", 0.5, 0.5 + TAU)];
    let swept = run(
        &mechanism,
        &inputs,
        &four_bar_guess(lengths, 0.5, 1.0),
        &steps(40),
    );
    assert_ne!(swept.ending(), SweepEnd::Crossing);
    let [wide, _] = limits(lengths);
    if swept.ending() == SweepEnd::Fold {
        assert!((swept.folds()[0][0].abs() - wide).abs() < 1e-10);
    }
}

#[test]
fn a_sweep_ends_at_a_limit_with_its_value() {
    let mechanism = mechanism("three_rps");
    let inputs = [
        joint(&mechanism, "l1", 0.6, 2.0),
        joint(&mechanism, "l2", 0.6, 0.8),
    ];
    let mut held = Held::nothing(&mechanism);
    held.joints[mechanism.joint("l3").unwrap()] = true;
    let mut at = mechanism.home();
    at.joints[mechanism.joint("l1").unwrap()] = 0.6;
    let mut all = held.clone();
    for input in &inputs {
        let Coordinate::Joint(joint) = input.coordinate else {
            panic!()
        };
        all.joints[joint] = true;
    }
    let system = System::new(mechanism.dimensions(), &all);
    let mut trial = at.clone();
    let report = Newton::default().solve(&system, &mut at, &mut trial, &mut system.work());
    assert_eq!(report.stop, Stop::Solved);
    let mut rows = Vec::new();
    let report = sweep(
        &mechanism,
        &held,
        &inputs,
        &at,
        &steps(100),
        &mut |row| {
            rows.push(row.configuration.clone());
        },
        &Watch::none(),
    );
    match report.ending {
        SweepEnd::Limit => {
            let Some(MetKind::Limit { joint, limit, .. }) = report.met.last().map(|m| &m.kind)
            else {
                panic!("{report:?}")
            };
            assert_eq!((joint.as_str(), *limit), ("l1", 1.2));
            assert!(
                (rows.last().unwrap().joints[mechanism.joint("l1").unwrap()] - 1.2).abs() < 1e-12
            );
        }
        SweepEnd::Fold => {}
        other => panic!("{other:?}"),
    }
    // both inputs move together, and the rest closes
    for at in &rows {
        let l = |name| at.joints[mechanism.joint(name).unwrap()];
        assert!(((l("l1") - 0.6) / 1.4 - (l("l2") - 0.6) / 0.2).abs() < 1e-12);
        assert!(system.residual(at, &mut system.work()).largest < 1e-12);
    }
}

#[test]
fn a_sweep_ends_where_a_passive_joint_reaches_its_limit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/slider_crank.ron");
    let text = std::fs::read_to_string(path).unwrap();
    let stopped = |low: f64| {
        let limited = format!("Passive(home: 3.87, limits: ({low:?}, 5.0))");
        let text = text.replace("Passive(home: 3.87)", &limited);
        let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
        let inputs = [joint(&mechanism, "theta", 0.5, PI)];
        let swept = run(&mechanism, &inputs, &[], &steps(50));
        let last = swept.rows.last().unwrap().1.joints.clone();
        (swept.report, last)
    };
    let (report, last) = stopped(2.5);
    assert_eq!(report.ending, SweepEnd::Limit);
    let Some(MetKind::Limit { joint, limit, .. }) = report.met.last().map(|m| &m.kind) else {
        panic!("{report:?}")
    };
    assert_eq!((joint.as_str(), *limit), ("s", 2.5));
    // (s − r cos θ)² + (e − r sin θ)² = l²: s cos θ + e sin θ = (s² + e² + r² − l²)/(2r)
    let (s, e) = (2.5f64, 0.5f64);
    let right = (s * s + e * e + 1.0 - 9.0) / 2.0;
    let theta = e.atan2(s) + (right / s.hypot(e)).acos();
    assert!((last[0] - theta).abs() < 1e-12, "{last:?} {theta}");
    // a slider that need not go so far back lets the crank through
    assert_eq!(stopped(1.5).0.ending, SweepEnd::Complete);
}

#[test]
fn a_platform_coordinate_is_an_input_too() {
    // the 3-RPS platform raised upright: lᵢ = √((b − a)² + z²)
    let mechanism = mechanism("three_rps");
    let question = ["roll=0", "pitch=0", "z=0.5"].iter().fold(
        Question::new(&mechanism).free("actuated").unwrap(),
        |question, held| {
            let (name, value) = held.split_once('=').unwrap();
            question.hold(&format!("top.{name}"), value).unwrap()
        },
    );
    let newton = Newton::default();
    let found = Search::new(&question, &newton).run(20, 1, &Watch::none());
    assert!(found.assembles());
    let (coordinate, _) = question.value("top.z", "0").unwrap();
    let inputs = [Driven {
        coordinate,
        from: 0.5,
        to: 0.8,
    }];
    let held = question.held().without(coordinate);
    let mut rows = 0;
    let at = found.attempt.at;
    let report = sweep(
        &mechanism,
        &held,
        &inputs,
        &at,
        &steps(10),
        &mut |row| {
            if let Some(step) = row.step {
                let z = 0.5 + 0.03 * step as f64;
                for leg in ["l1", "l2", "l3"] {
                    let length = row.configuration.joints[mechanism.joint(leg).unwrap()];
                    assert!((length - 0.5f64.hypot(z)).abs() < 1e-12, "{length} at {z}");
                }
                rows += 1;
            }
        },
        &Watch::none(),
    );
    assert_eq!((report.ending, rows), (SweepEnd::Complete, 11));
    // legs of at most 1.2 m: at √(1.44 − 0.25) m it ends
    let inputs = [Driven {
        to: 1.3,
        ..inputs[0]
    }];
    let mut last = 0.0;
    let report = sweep(
        &mechanism,
        &held,
        &inputs,
        &at,
        &steps(10),
        &mut |row| {
            last = row.configuration.platforms[0].position.0[2];
        },
        &Watch::none(),
    );
    assert_eq!(report.ending, SweepEnd::Limit);
    assert!((last - (1.44f64 - 0.25).sqrt()).abs() < 1e-12, "{last}");
}

#[test]
fn whoever_takes_the_rows_can_stop_the_motion() {
    let mechanism = mechanism("four_bar");
    let inputs = [joint(&mechanism, "theta1", 0.5, 0.5 + TAU)];
    let at = start(&mechanism, &inputs, &[]);
    let taken = AtomicUsize::new(0);
    let enough = |_| match taken.load(Ordering::Relaxed) {
        5.. => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let report = sweep(
        &mechanism,
        &Held::nothing(&mechanism),
        &inputs,
        &at,
        &steps(1000),
        &mut |_| {
            taken.fetch_add(1, Ordering::Relaxed);
        },
        &Watch::new(&enough),
    );
    assert!(report.interrupted);
    assert_eq!((report.ending, report.rows), (SweepEnd::Stopped, 5));
    assert_eq!(taken.into_inner(), 5);
}

#[test]
fn hoekens_point_is_where_the_table_has_it_and_straight_over_half_a_turn() {
    let mechanism = mechanism("hoeken");
    let inputs = [joint(&mechanism, "theta1", 0.0, TAU)];
    let settings = tracing(&mechanism, 3600, "left+2.5");
    let swept = run(
        &mechanism,
        &inputs,
        &[("phi2", 1.4), ("phi1", 1.8)],
        &settings,
    );
    let table = data("hoeken");
    for row in table["answer"]["table"].as_array().unwrap() {
        let step = row["crank_deg"].as_f64().unwrap() * 10.0;
        let point = swept.step(step as usize).2[0];
        for (k, x) in point.iter().enumerate().take(2) {
            assert!((x - row["P"][k].as_f64().unwrap()).abs() < CLOSED, "{row}");
        }
    }
    let straight: Vec<f64> = (900..=2700).map(|step| swept.step(step).2[0][1]).collect();
    let most = straight.iter().copied().fold(0.0, f64::max);
    assert!(straight.iter().all(|y| *y > 4.0 - CLOSED));
    assert!((most - 4.009753683432732).abs() < 1e-7, "{most}");
    // beyond the half turn it is not straight
    assert!(swept.step(600).2[0][1] > 4.05);
}

#[test]
fn chebyshevs_point_touches_its_line_three_times() {
    let mechanism = mechanism("chebyshev");
    let upright = PI / 2.0;
    // acos 0.8, where the other arm stands upright, is a dead point
    let inputs = [joint(
        &mechanism,
        "theta1",
        upright,
        (0.8_f64).acos() + 1e-3,
    )];
    let settings = tracing(&mechanism, 1000, "left+-1");
    let swept = run(
        &mechanism,
        &inputs,
        &[("phi2", PI), ("phi1", 2.498)],
        &settings,
    );
    assert_eq!(swept.ending(), SweepEnd::Complete);
    let heights: Vec<f64> = swept.rows.iter().map(|row| row.2[0][1]).collect();
    // coupler of half length 1 on equal arms: the height of the middle over the two crossed arms
    for (_, at, points) in &swept.rows {
        let (a, b) = (at.joints[0], at.joints[2]);
        let middle = 0.5 * (5.0 * a.sin() + 5.0 * b.sin());
        assert!((middle - points[0][1]).abs() < CLOSED);
    }
    let table = data("chebyshev");
    for row in table["answer"]["table"].as_array().unwrap() {
        let degrees = row["arm_deg"].as_f64().unwrap();
        if row["branch"] == 1 {
            let inputs = [joint(&mechanism, "theta1", upright, degrees.to_radians())];
            if degrees == 90.0 {
                continue;
            }
            let settings = tracing(&mechanism, 1, "left+-1");
            let swept = run(
                &mechanism,
                &inputs,
                &[("phi2", PI), ("phi1", 2.498)],
                &settings,
            );
            let point = swept.step(1).2[0];
            for (k, x) in point.iter().enumerate().take(2) {
                assert!(
                    (x - row["midpoint"][k].as_f64().unwrap()).abs() < CLOSED,
                    "{row}"
                );
            }
        }
    }
    let (low, high) = heights
        .iter()
        .fold((9.0f64, 0.0f64), |(l, h), y| (l.min(*y), h.max(*y)));
    // as far off as Hoeken's point: the two linkages are cognates (Chebyshev and Roberts)
    assert!(
        low > 4.0 - CLOSED && (high - 4.009753683432732).abs() < 1e-6,
        "{low} {high}"
    );
    // touched at x = 0, 2 and 4
    assert!((heights[0] - 4.0).abs() < CLOSED);
}

#[test]
fn watts_point_lies_on_watts_curve() {
    // (x² + y²)(x² + y² − a² − b² + c²)² + 4 a² y² (x² + y² − b²) = 0, x along the ground link and y
    // across it from its middle; 2a ground, b arms, 2c coupler
    let mechanism = mechanism("watt_linkage");
    let mut rows = Vec::new();
    let settings = tracing(&mechanism, 1, "left+-0.5");
    let held = Held::nothing(&mechanism);
    let report = sweep(
        &mechanism,
        &held,
        &[],
        &mechanism.home(),
        &settings,
        &mut |row| {
            rows.push(row.points[0]);
        },
        &Watch::none(),
    );
    assert_eq!(report.ending, SweepEnd::Closed);
    let (arm, coupler): (f64, f64) = (2.0, 1.0);
    let ground = (2.0 * arm).hypot(coupler);
    let (a, b, c) = (0.5 * ground, arm, 0.5 * coupler);
    let (ux, uy) = (2.0 * arm / ground, -coupler / ground);
    for [px, py, _] in &rows {
        let (dx, dy) = (px - arm, py + 0.5 * coupler);
        let (x, y) = (dx * ux + dy * uy, dy * ux - dx * uy);
        let r2 = x * x + y * y;
        let f = r2 * (r2 - a * a - b * b + c * c).powi(2) + 4.0 * a * a * y * y * (r2 - b * b);
        assert!(f.abs() < 1e-10, "({x}, {y}): {f}");
    }
    assert!(rows.len() > 60);
    // nearly straight in the middle: the tangent there is met to fifth order
    let inputs = [joint(&mechanism, "theta1", 0.0, 0.2)];
    let settings = tracing(&mechanism, 20, "left+-0.5");
    let swept = run(&mechanism, &inputs, &[], &settings);
    for (_, at, points) in &swept.rows {
        let [x, y, _] = points[0];
        assert!(
            (x - 2.0).abs() < 0.05 * at.joints[0].powi(3) + 1e-12,
            "{} {x} {y}",
            at.joints[0]
        );
    }
}

#[test]
fn peaucelliers_point_moves_on_an_exact_line() {
    let mechanism = mechanism("peaucellier");
    let table = data("peaucellier");
    // down to where the rhombus folds up at C = D, and beyond straight on
    let settings = SweepSettings {
        follow: true,
        ..tracing(&mechanism, 100, "upper")
    };
    let inputs = [joint(
        &mechanism,
        "theta",
        20.0_f64.to_radians(),
        -100.0_f64.to_radians(),
    )];
    let swept = run(&mechanism, &inputs, &[], &settings);
    assert_eq!(swept.ending(), SweepEnd::Complete);
    for (_, at, points) in &swept.rows {
        assert!((points[0][0] - 4.2).abs() < CLOSED, "{points:?}");
        let c = (2.5 + 2.5 * at.joints[0].cos(), 2.5 * at.joints[0].sin());
        let product = c.0.hypot(c.1) * points[0][0].hypot(points[0][1]);
        assert!((product - 21.0).abs() < 10.0 * CLOSED);
    }
    let crossing = swept
        .report
        .met
        .iter()
        .find(|met| met.singularity == Some(3))
        .unwrap();
    // C on the line: 2.5 + 2.5 cos θ = 4.2
    assert!(
        (crossing.inputs[0].abs() - (1.7_f64 / 2.5).acos()).abs() < 1e-11,
        "{crossing:?}"
    );
    for row in table["answer"]["table"].as_array().unwrap() {
        let crank = row["crank_deg"].as_f64().unwrap().to_radians();
        if crank > 20.0_f64.to_radians() - 1e-9 {
            continue;
        }
        let inputs = [joint(&mechanism, "theta", 20.0_f64.to_radians(), crank)];
        let settings = SweepSettings {
            follow: true,
            ..tracing(&mechanism, 1, "upper")
        };
        let swept = run(&mechanism, &inputs, &[], &settings);
        let point = swept.step(1).2[0];
        for (k, x) in point.iter().enumerate().take(2) {
            assert!((x - row["D"][k].as_f64().unwrap()).abs() < CLOSED, "{row}");
        }
    }
    // another crank moves the line, as the formula has it
    let bent = with("peaucellier", &[("g", 2.4)]);
    let inputs = [joint(&bent, "theta", 0.3, -0.3)];
    let swept = run(&bent, &inputs, &[], &tracing(&bent, 10, "upper"));
    assert!(
        swept
            .rows
            .iter()
            .all(|row| (row.2[0][0] - 21.0 / 4.8).abs() < 1e-11)
    );
}

#[test]
fn jansens_leg_walks_as_its_table_says() {
    let mechanism = mechanism("jansen_leg");
    let table = data("jansen_leg");
    let inputs = [joint(&mechanism, "theta", PI / 2.0, PI / 2.0 + TAU)];
    let swept = run(&mechanism, &inputs, &[], &tracing(&mechanism, 3600, "toe"));
    assert_eq!(swept.ending(), SweepEnd::Complete);
    for row in table["answer"]["table"].as_array().unwrap() {
        let degrees = row["crank_deg"].as_f64().unwrap();
        let step = ((degrees - 90.0).rem_euclid(360.0) * 10.0) as usize;
        let point = swept.step(step).2[0];
        for (k, x) in point.iter().enumerate().take(2) {
            let published = row["points"][7][k].as_f64().unwrap() / 100.0;
            assert!((x - published).abs() < 1e-12, "{degrees}: {x} {published}");
        }
    }
    let path = &table["answer"]["foot_path"];
    let extent = |k: usize| {
        let values = swept.rows.iter().map(|row| row.2[0][k] * 100.0);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        })
    };
    for (k, [low, high]) in [["x_min", "x_max"], ["y_min", "y_max"]]
        .into_iter()
        .enumerate()
    {
        let (l, h) = extent(k);
        // sampled, so below the true extent by the sampling only
        assert!((l - path[low].as_f64().unwrap()).abs() < 1e-4, "{l}");
        assert!((h - path[high].as_f64().unwrap()).abs() < 1e-4, "{h}");
    }
    // it walks: more than half of the turn the foot is within a twentieth of the stride of the ground
    let ((left, right), (ground, _)) = (extent(0), extent(1));
    let stride = right - left;
    let down = swept
        .rows
        .iter()
        .filter(|row| row.2[0][1] * 100.0 < ground + 0.05 * stride);
    assert!(down.count() > 1800 && stride > 60.0);
}

#[test]
fn klanns_leg_closes_as_its_table_says() {
    let mechanism = mechanism("klann_leg");
    let table = data("klann_leg");
    let inputs = [joint(&mechanism, "theta", PI / 2.0, PI / 2.0 + TAU)];
    let settings = SweepSettings {
        points: ["knee", "first.2"]
            .map(|p| NamedPoint::read(&mechanism, p).unwrap())
            .to_vec(),
        ..steps(360)
    };
    let swept = run(&mechanism, &inputs, &[], &settings);
    assert_eq!(swept.ending(), SweepEnd::Complete);
    for row in table["answer"]["crank_table"].as_array().unwrap() {
        let degrees = row["crank_deg"].as_f64().unwrap();
        let step = (degrees - 90.0).rem_euclid(360.0) as usize;
        for (point, name) in swept.step(step).2.iter().zip(["D", "E"]) {
            for (k, x) in point.iter().enumerate().take(2) {
                // at 0 and 180° rod and rocker are nearly in line and the table's lengths have 7 digits
                assert!(
                    (x - row[name][k].as_f64().unwrap()).abs() < 1e-7,
                    "{degrees} {name}"
                );
            }
        }
    }
}

/// All circuits of a 4-bar, from seeds by the closed form.
fn circuits_of(lengths: [f64; 4]) -> CircuitsReport {
    let mechanism = four_bar(lengths);
    let mut seeds = Vec::new();
    for k in 0..24 {
        let crank = 0.1 + TAU * f64::from(k) / 24.0;
        for side in [1.0, -1.0] {
            if rocker(lengths, crank, side).is_nan() {
                continue;
            }
            let mut at = mechanism.home();
            at.joints[0] = crank;
            for (name, value) in four_bar_guess(lengths, crank, side) {
                at.joints[mechanism.joint(name).unwrap()] = value;
            }
            seeds.push(at);
        }
    }
    let held = Held::nothing(&mechanism);
    circuits(
        &mechanism,
        (&held, &[]),
        Coordinate::Joint(0),
        &seeds,
        &CircuitsSettings::default(),
        &Watch::none(),
    )
}

/// The class by Grashof's rule, from the lengths alone.
fn grashof([l0, l1, l2, l3]: [f64; 4]) -> FourBarClass {
    let mut sorted = [l0, l1, l2, l3];
    sorted.sort_by(f64::total_cmp);
    let excess = sorted[0] + sorted[3] - sorted[1] - sorted[2];
    let shortest = sorted[0];
    match () {
        () if excess > 1e-9 => FourBarClass::TripleRocker,
        () if excess > -1e-9 => FourBarClass::ChangePoint,
        () if shortest == l0 => FourBarClass::DoubleCrank,
        () if shortest == l1 || shortest == l3 => FourBarClass::CrankRocker,
        () => FourBarClass::DoubleRocker,
    }
}

/// A 5-bar whose cranks are geared to turn against one another.
const GEARED: &str = r#"Mechanism(version: 1, name: "geared", convention: Modified,
    joints: { "crank": Actuated(home: "60 deg"), "p": Passive(home: "0 deg"), "q": Passive(home: "60 deg") },
    chains: {
        "left": Chain(rows: [(theta: "crank"), (a: 1, theta: "p")], tip: [Tx(3)]),
        "right": Chain(base: [Tx(2)], rows: [(theta: "180 deg - crank"), (a: 1, theta: "q")], tip: [Tx(3)]),
    },
    closures: { "pin": Revolute("left", "right") },
)"#;

#[test]
fn a_geared_five_bar_is_no_four_bar() {
    let mechanism = Mechanism::new(&Description::read(GEARED).unwrap()).unwrap();
    let report = ask::Question::new(mechanism)
        .circuits(&Watch::none())
        .unwrap();
    assert!(report.circuits.iter().all(|circuit| circuit.whole));
    assert_eq!(report.class, Some(FourBarClass::GearedFiveBar));
}

#[test]
fn the_class_of_a_four_bar_follows_from_its_circuits_and_agrees_with_grashof() {
    let mut classes = Vec::new();
    for lengths in [
        [5.0, 1.0, 3.0, 4.0],
        [3.0, 2.5, 2.0, 1.0],
        [1.0, 3.0, 2.5, 2.7],
        [3.0, 2.5, 1.0, 2.2],
        [4.0, 3.0, 2.2, 2.9],
        [3.0, 2.0, 2.0, 2.5],
        [4.0, 2.0, 4.0, 2.0],
        [5.0, 1.0, 3.0, 3.0],
    ] {
        let report = circuits_of(lengths);
        assert_eq!(
            report.class,
            Some(grashof(lengths)),
            "{lengths:?}: {report:#?}"
        );
        let curves = match report.class {
            Some(FourBarClass::TripleRocker) => 1,
            _ => report.circuits.len(),
        };
        assert_eq!(report.circuits.len(), curves, "{lengths:?}");
        assert!(report.circuits.iter().all(|c| c.whole && c.closed));
        classes.extend(report.class);
        // branches lie between the exact dead points
        for branch in report
            .circuits
            .iter()
            .flat_map(|c| &c.branches)
            .filter(|b| !b.turns)
        {
            for end in [branch.low, branch.high] {
                let near = limits(lengths).iter().any(|limit| {
                    apart(end, *limit).abs() < 1e-12 || apart(end, -limit).abs() < 1e-12
                });
                assert!(near, "{lengths:?}: {end}");
            }
        }
    }
    classes.dedup();
    assert!(classes.len() >= 5);
}

#[test]
fn each_angle_of_a_crossing_is_told_once_with_the_number_of_crossings_there() {
    let peaucellier = ["sweep", "mechanisms/peaucellier.ron", "--circuits"];
    let linkwork = |more: &[&str]| {
        let output = assert_cmd::Command::cargo_bin("linkwork")
            .unwrap()
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args([&peaucellier[..], more].concat())
            .output()
            .unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let json: serde_json::Value = serde_json::from_str(&linkwork(&["--format", "json"])).unwrap();
    let crossings = json["circuits"][0]["crossings"].as_array().unwrap().len();
    let text = linkwork(&[]);
    let line = text
        .lines()
        .find(|line| line.contains("crosses circuit 2 at"));
    let (_, places) = line.unwrap().split_once(" = ").unwrap();
    let places: Vec<&str> = places.split(", ").flat_map(|p| p.split(" and ")).collect();
    let angle = |place: &str| place.split('°').next().unwrap().parse::<f64>().unwrap();
    for pair in places.windows(2) {
        assert!(angle(pair[0]) < angle(pair[1]), "{places:?}");
    }
    let times = |place: &&str| match place.split_once('(') {
        Some((_, times)) => times.trim_end_matches(" times)").parse().unwrap(),
        None => 1,
    };
    let counted: usize = places.iter().map(times).sum();
    assert_eq!(counted, crossings);
    assert!(counted > places.len(), "{places:?}");
}

#[test]
fn the_curves_of_a_parallelogram_meet_at_both_change_points() {
    let report = circuits_of([4.0, 2.0, 4.0, 2.0]);
    assert_eq!(report.circuits.len(), 2);
    for (circuit, other) in report.circuits.iter().zip([2, 1]) {
        assert_eq!(circuit.crosses, [other]);
        assert_eq!(circuit.crossings.len(), 2);
        for joints in &circuit.crossings {
            assert!(
                joints.iter().all(|x| apart(2.0 * x, 0.0).abs() < 1e-12),
                "{joints:?}"
            );
        }
    }
}

#[test]
fn a_swing_through_a_half_turn_is_told_where_its_values_are() {
    // crank and coupler in line: l0² + l3² + 2 l0 l3 cos φ₁ = (l1 + l2)², on both sides of φ₁ = π
    let lengths = [5.0, 3.5, 3.0, 4.0];
    let dead = ((42.25f64 - 41.0) / 40.0).acos();
    let seeds_of = |mechanism: &Mechanism, turns: f64| {
        let mut seeds = Vec::new();
        for (crank, side) in [(0.5, 1.0), (0.5, -1.0), (-0.5, 1.0), (-0.5, -1.0)] {
            let mut at = mechanism.home();
            at.joints[0] = crank;
            for (name, value) in four_bar_guess(lengths, crank, side) {
                at.joints[mechanism.joint(name).unwrap()] = value + TAU * turns;
            }
            seeds.push(at);
        }
        seeds
    };
    let swing = |mechanism: &Mechanism, seeds: &[Configuration<f64>]| {
        let held = Held::nothing(mechanism);
        let report = circuits(
            mechanism,
            (&held, &[]),
            Coordinate::Joint(0),
            seeds,
            &CircuitsSettings::default(),
            &Watch::none(),
        );
        let [circuit] = &report.circuits[..] else {
            panic!("{report:#?}")
        };
        let rocker = mechanism.joint("phi1").unwrap();
        (circuit.joints[rocker].low, circuit.joints[rocker].high)
    };
    let free = four_bar(lengths);
    for turns in [-1.0, 0.0, 1.0] {
        for seed in seeds_of(&free, turns) {
            let (low, high) = swing(&free, &[seed]);
            assert!((low - dead).abs() < 1e-11, "{low}");
            assert!((high - (TAU - dead)).abs() < 1e-11, "{high}");
        }
    }
    // limits say where else
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/four_bar.ron");
    let text = std::fs::read_to_string(path).unwrap().replace(
        r#"Passive(home: "129 deg")"#,
        r#"Passive(home: "-231 deg", limits: ("-290 deg", "-70 deg"))"#,
    );
    let description = Description::read(&text).unwrap();
    let description = description.with_parameter("l1", "3.5").unwrap();
    let limited = Mechanism::new(&description).unwrap();
    let (low, high) = swing(&limited, &seeds_of(&limited, 0.0)[..1]);
    assert!((low - (dead - TAU)).abs() < 1e-11, "{low}");
    assert!((high + dead).abs() < 1e-11, "{high}");
}

#[test]
fn angles_of_crossings_are_told_within_a_turn() {
    let report = circuits_of([4.0, 2.0, 4.0, 2.0]);
    let joints = report.circuits.iter().flat_map(|c| &c.crossings).flatten();
    let mut told = 0;
    for x in joints {
        // all links in one line: 0 or π, never −π or a turn more
        assert!(x.abs() < 1e-9 || (x - PI).abs() < 1e-9, "{x}");
        told += 1;
    }
    assert_eq!(told, 12);
}

#[test]
fn seeds_of_one_circuit_find_only_that_one() {
    let lengths = [5.0, 1.0, 3.0, 4.0];
    let mechanism = four_bar(lengths);
    let mut at = mechanism.home();
    for (name, value) in four_bar_guess(lengths, at.joints[0], 1.0) {
        at.joints[mechanism.joint(name).unwrap()] = value;
    }
    let held = Held::nothing(&mechanism);
    let report = circuits(
        &mechanism,
        (&held, &[]),
        Coordinate::Joint(0),
        &[at],
        &CircuitsSettings::default(),
        &Watch::none(),
    );
    assert_eq!((report.circuits.len(), report.class), (1, None));
}

/// The 4-bar swept to and fro over random ranges in random numbers of steps: no row is ever on another branch
/// than that of the closed form.
fn random_steps(rows: usize, seed: u64) -> usize {
    let mut state = seed;
    let mut random = move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 11) as f64) / (1u64 << 53) as f64
    };
    let mut made = 0;
    while made < rows {
        // all sorts of lengths, among them nearly folded ones
        let close = 10f64.powf(-6.0 * random());
        let lengths = match (random() * 3.0) as usize {
            0 => [0, 1, 2, 3].map(|_| 0.3 + 2.0 * random()),
            1 => [4.0, 2.0, 4.0 + close, 2.0],
            _ => [5.0, 1.0, 3.0, 3.0 + close],
        };
        let mechanism = four_bar(lengths);
        for side in [1.0, -1.0] {
            let from = TAU * random();
            if rocker(lengths, from, side).is_nan() {
                continue;
            }
            let to = from + 3.0 * TAU * (random() - 0.5);
            let count = 1 + (3000.0 * random().powi(3)) as usize;
            let inputs = [joint(&mechanism, "theta1", from, to)];
            let mut at = mechanism.home();
            at.joints[0] = from;
            for (name, value) in four_bar_guess(lengths, from, side) {
                at.joints[mechanism.joint(name).unwrap()] = value;
            }
            let held = Held::nothing(&mechanism);
            let report = sweep(
                &mechanism,
                &held,
                &inputs,
                &at,
                &steps(count),
                &mut |row| {
                    let [crank, _, output] = row.configuration.joints[..] else {
                        panic!()
                    };
                    let (own, other) =
                        (rocker(lengths, crank, side), rocker(lengths, crank, -side));
                    if !own.is_nan() {
                        let (own, other) = (apart(output, own).abs(), apart(output, other).abs());
                        assert!(
                            own <= other + 1e-6,
                            "{lengths:?} {crank} {side}: {own} {other}"
                        );
                    }
                    made += 1;
                },
                &Watch::none(),
            );
            assert!(
                matches!(
                    report.ending,
                    SweepEnd::Complete | SweepEnd::Fold | SweepEnd::Crossing
                ),
                "{lengths:?} from {from} to {to}: {:?}",
                report.ending
            );
            // it ends before its end only at a true dead point
            if report.ending == SweepEnd::Fold {
                let fold = report.met.last().unwrap().inputs[0];
                let near = limits(lengths).iter().any(|limit| {
                    apart(fold, *limit).abs() < 1e-7 || apart(fold, -limit).abs() < 1e-7
                });
                assert!(near, "{lengths:?}: {fold}");
            }
        }
    }
    made
}

#[test]
fn no_row_of_random_sweeps_is_on_another_branch() {
    assert!(random_steps(60_000, 7) >= 60_000);
}

#[test]
#[ignore = "minutes: ten million rows"]
fn no_row_of_ten_million_is_on_another_branch() {
    assert!(random_steps(10_000_000, 1) >= 10_000_000);
}

/// Whole turns of every mechanism file with one driven joint that can make them, there in many steps and there in
/// few: rows that both have are the same.
#[test]
fn coarse_and_fine_sweeps_of_the_mechanism_files_agree() {
    let mut compared = 0;
    for name in [
        "watt_six_bar",
        "stephenson_six_bar",
        "rssr",
        "bennett",
        "goldberg_5r",
        "myard_5r",
        "schatz",
        "bricard_line",
        "bricard_plane",
        "bricard_trihedral",
        "spherical_four_bar",
        "four_bar_cut1",
        "four_bar_cut2",
        "four_bar_cut4",
        "jansen_leg",
        "klann_leg",
        "watt_linkage",
        "chebyshev",
    ] {
        let mechanism = mechanism(name);
        let input = CircuitsReport::input_of(&mechanism).unwrap();
        let home = mechanism.home().joints[input];
        let inputs = [Driven {
            coordinate: Coordinate::Joint(input),
            from: home,
            to: home + TAU,
        }];
        let coarse = run(&mechanism, &inputs, &[], &steps(5));
        let fine = run(&mechanism, &inputs, &[], &steps(500));
        assert_eq!(coarse.ending(), fine.ending(), "{name}");
        for (step, at, _) in coarse.rows.iter().filter(|row| row.0.is_some()) {
            let same = fine.step(step.unwrap() * 100);
            for (a, b) in at.joints.iter().zip(&same.1.joints) {
                assert!((a - b).abs() < 1e-8, "{name} {step:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 150, "{compared}");
}

#[test]
fn the_whole_curve_has_the_dead_points_of_every_joint() {
    // crank-rocker 5, 1, 3, 4: the published dead points, crank and coupler in one line
    let mechanism = four_bar([5.0, 1.0, 3.0, 4.0]);
    let mut curve = Curve::new(&mechanism, &Held::nothing(&mechanism));
    let method = linkwork::solve::Continuation::default();
    let place = method.settle(&mut curve, mechanism.home()).unwrap();
    assert!(!place.is_beside_a_crossing());
    let _ = Walk::new(&mechanism, &curve, place, method);
    let report = sweep(
        &mechanism,
        &Held::nothing(&mechanism),
        &[],
        &mechanism.home(),
        &SweepSettings::default(),
        &mut |_| {},
        &Watch::none(),
    );
    let table = data("change_points");
    let published = table["answer"]["dead_points_of_crank_rocker_5_1_3_4"]
        .as_array()
        .unwrap();
    let dead: Vec<[f64; 2]> = (report.met.iter())
        .filter(|met| matches!(&met.kind, MetKind::Turning { joint } if joint == "phi1"))
        .map(|met| [met.joints[0], met.joints[2]])
        .collect();
    assert_eq!((report.ending, dead.len()), (SweepEnd::Closed, 2));
    for [crank, rocker] in dead {
        let known = published.iter().any(|p| {
            let of = |name: &str| p[name].as_f64().unwrap();
            apart(crank, of("theta1")).abs() < 1e-12 && apart(rocker, of("phi1")).abs() < 1e-12
        });
        assert!(known, "{crank} {rocker}");
    }
}

/// Exit code, stdout and stderr of a command line.
fn linkwork(arguments: &[&str]) -> (i32, String, String) {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn questions_that_make_no_sense_are_told_what_to_ask_instead() {
    let four_bar = "mechanisms/four_bar.ron";
    let three_rps = "mechanisms/three_rps.ron";
    for (arguments, help) in [
        (&[four_bar][..], "--input theta1=0deg..360deg"),
        (
            &[four_bar, "--input", "tehta1=0..1"],
            "did you mean `theta1`?",
        ),
        (
            &[four_bar, "--input", "theta1=1"],
            "write --input theta1=FROM..TO",
        ),
        (
            &[four_bar, "--input", "theta1=60deg..pi/3"],
            "use `linkwork solve`",
        ),
        (
            &[four_bar, "--input", "theta1=0..x"],
            "`x` is not a parameter",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--steps", "0"],
            "at least one step",
        ),
        (
            &[
                four_bar,
                "--input",
                "theta1=0..1",
                "--steps",
                "9999999999999",
            ],
            "too many",
        ),
        (
            &[
                four_bar,
                "--input",
                "theta1=0..1",
                "--steps",
                "9999999",
                "--format",
                "json",
            ],
            "--format csv",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--input", "theta1=0..2"],
            "give only one",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--hold", "theta1=1"],
            "`theta1` is given a range and also held",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--of", "rigth"],
            "did you mean `right`?",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--of", "right+1,2,3,4"],
            "FRAME+X,Y,Z",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--mode", "7"],
            "modes 1 to 2",
        ),
        (
            &[four_bar, "--input", "theta1=0..1", "--input", "phi1=0..1"],
            "free phi1",
        ),
        (
            &[
                "mechanisms/five_bar.ron",
                "--input",
                "theta1=1..2",
                "--free",
                "theta2",
            ],
            "leave out --free theta2",
        ),
        (
            &["mechanisms/five_bar.ron", "--follow"],
            "--hold theta1=home",
        ),
        (
            &["mechanisms/triangle.ron", "--follow"],
            "`linkwork mobility`",
        ),
        (&[three_rps, "--input", "l1=2..3"], "--input l1=0.3..1.2"),
    ] {
        let (code, out, err) = linkwork(&[&["sweep"], arguments].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(help), "{arguments:?}: {err}");
    }
}

#[test]
fn csv_has_a_whole_line_for_every_row_and_json_and_svg_hold_the_same_motion() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("hoeken.svg");
    let asked = [
        "sweep",
        "mechanisms/hoeken.ron",
        "--input",
        "theta1=0..2*pi",
        "--steps",
        "50",
        "--of",
        "left+2.5,0",
    ];
    let (code, csv, err) = linkwork(&[&asked[..], &["--format", "csv"]].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    let mut reader = csv.lines();
    let header = reader.next().unwrap();
    assert!(
        header.starts_with(
            "mode,step,theta1 (rad),phi2 (rad),phi1 (rad),C (rad),\"left+2.5,0.x (m)\","
        )
    );
    let rows: Vec<Vec<&str>> = reader.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 51);
    assert!(rows.iter().all(|row| row.len() == 10));
    assert!(csv.ends_with('\n') && !csv.contains("NaN") && !csv.contains("inf"));
    let more = ["--format", "json", "--svg", picture.to_str().unwrap()];
    let (code, json, _) = linkwork(&[&asked[..], &more].concat());
    let json: Value = serde_json::from_str(&json).unwrap();
    let motion = &json["motions"][0];
    assert_eq!((code, &motion["ending"]), (0, &Value::from("complete")));
    for (row, same) in rows.iter().zip(motion["values"].as_array().unwrap()) {
        for k in 0..8 {
            assert_eq!(
                row[k + 1].parse::<f64>().unwrap(),
                same[k].as_f64().unwrap()
            );
        }
    }
    let svg = std::fs::read_to_string(picture).unwrap();
    for label in ["x (m)", "y (m)", "left+2.5", "Hoeken"] {
        assert!(svg.contains(label), "{label}");
    }
    assert!(svg.trim_end().ends_with("</svg>"));
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
}

#[test]
fn a_motion_that_does_not_reach_its_end_answers_no_and_says_why() {
    let asked = [
        "sweep",
        "mechanisms/chebyshev.ron",
        "--input",
        "theta1=60deg..120deg",
    ];
    let (code, text, _) = linkwork(&asked);
    assert_eq!(code, 1);
    assert!(text.contains("theta1 locks at 101.536959°"), "{text}");
    let (code, _, err) = linkwork(&[&asked[..], &["--format", "csv"]].concat());
    assert_eq!(code, 1);
    assert!(err.contains("note: theta1 locks at"), "{err}");
    let (code, text, _) = linkwork(&[&asked[..], &["--follow", "--all-modes"]].concat());
    assert_eq!(code, 0, "{text}");
    assert!(
        text.contains("Mode 1\n") && text.contains("Mode 2\n") && text.contains("round 1 fold")
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_whole_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args([
            "sweep",
            "mechanisms/four_bar.ron",
            "--input",
            "theta1=0deg..360deg",
        ])
        .args(["--steps", "900000000", "--format", "csv"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(std::fs::File::create(&path).unwrap())
        .spawn()
        .unwrap();
    let length = || std::fs::metadata(&path).unwrap().len();
    while length() < 1_000_000 {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let id = child.id().to_string();
    let told = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status()
        .unwrap();
    assert!(told.success());
    assert_eq!(child.wait().unwrap().code(), Some(1));
    let written = std::fs::read_to_string(&path).unwrap();
    assert!(written.ends_with('\n'));
    let columns = written.lines().next().unwrap().split(',').count();
    assert!(
        written
            .lines()
            .all(|line| line.split(',').count() == columns)
    );
}

#[test]
fn a_guess_chooses_the_assembly_that_a_motion_begins_in() {
    // 4-bar of links 1, 3, 4 on a base of 5: the rocker's angle is one of two intersections of circles
    let (l0, l1, l2, l3) = (5.0f64, 1.0, 3.0, 4.0);
    let rocker = |crank: f64, side: f64| {
        let (x, y) = (l1 * crank.cos() - l0, l1 * crank.sin());
        let d = x.hypot(y);
        y.atan2(x) + side * ((l3 * l3 + d * d - l2 * l2) / (2.0 * l3 * d)).acos()
    };
    let question = || ask::Question::new(mechanism("four_bar")).input("theta1", "60 deg", "90 deg");
    let settings = SweepSettings {
        steps: 3,
        ..SweepSettings::default()
    };
    let ends = |question: ask::Question| -> Vec<f64> {
        let motions = question.motions(&settings, &Watch::none()).unwrap();
        let report = motions.report(10, &mut |_, _| {}, &Watch::none());
        assert_eq!(report.motions.len(), 1);
        let columns = &report.motions[0].columns;
        let phi1 = columns.iter().position(|column| column.name == "phi1");
        let rows = &report.motions[0].values;
        let values = [&rows[0], rows.last().unwrap()];
        values.map(|row| row[phi1.unwrap()].unwrap()).to_vec()
    };
    let off = |a: f64, b: f64| ((a - b + 3.0 * PI).rem_euclid(TAU) - PI).abs();
    for (guess, side) in [(None, -1.0), (Some("-150 deg"), 1.0)] {
        let asked = match guess {
            None => question(),
            Some(guess) => question().guess("phi1", guess),
        };
        let found = ends(asked);
        for (found, degrees) in found.iter().zip([60f64, 90.0]) {
            let expected = rocker(degrees.to_radians(), side);
            assert!(off(*found, expected) < 1e-9, "{found} for {expected}");
        }
    }
}

/// A 4-bar of two platforms on hinges and a rod between them: no joint at all.
fn four_bar_of_platforms([l0, l1, l2, l3]: [f64; 4]) -> Mechanism {
    let text = format!(
        r#"Mechanism(version: 1, name: "4-bar of platforms", convention: Modified,
            chains: {{ "left": Chain(rows: []), "right": Chain(base: [Tx({l0})], rows: []) }},
            platforms: {{
                "crank": Platform(home: [Rz("60 deg")], frames: {{ "O": [], "P": [Tx({l1})] }}),
                "rocker": Platform(home: [Tx({l0}), Rz("80 deg")], frames: {{ "O": [], "P": [Tx({l3})] }}),
            }},
            closures: {{ "O": Revolute("left", "crank.O"), "R": Revolute("right", "rocker.O"),
                "coupler": Distance("crank.P", "rocker.P", {l2}) }})"#
    );
    Mechanism::new(&Description::read(&text).unwrap())
        .unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// Grashof's rule tells circuits and what turns, the law of cosines how far the rocker swings.
#[test]
fn circuits_of_a_mechanism_of_platforms_are_those_of_the_same_one_with_joints() {
    let lengths = [4.0, 1.5, 3.5, 3.0];
    let [l0, l1, l2, l3] = lengths;
    let of = |lengths| {
        ask::Question::new(four_bar_of_platforms(lengths))
            .circuits(&Watch::none())
            .unwrap()
    };
    let report = of(lengths);
    assert_eq!(
        (report.input.as_str(), report.circuits.len()),
        ("crank.yaw", 2)
    );
    assert_eq!(circuits_of(lengths).circuits.len(), 2);
    let inner = |side: f64| ((l0 * l0 + l3 * l3 - side * side) / (2.0 * l0 * l3)).acos();
    // the angle of the rocker from the line of the hinges, on one side or the other
    let swing = [PI - inner(l2 + l1), PI - inner(l2 - l1)];
    let mut sides = Vec::new();
    for circuit in &report.circuits {
        assert!(circuit.closed && circuit.whole && circuit.joints.is_empty());
        let motion = |name: &str| circuit.platforms.iter().find(|of| of.name == name);
        assert_eq!(motion("crank.yaw").unwrap().turns.abs(), 1);
        let rocker = motion("rocker.yaw").unwrap();
        assert_eq!(rocker.turns, 0);
        let side = rocker.low.signum();
        let told = if side > 0.0 {
            [rocker.low, rocker.high]
        } else {
            [-rocker.high, -rocker.low]
        };
        for (value, exact) in told.into_iter().zip(swing) {
            assert!((value - exact).abs() < 1e-8, "{value} {exact}");
        }
        sides.push(side);
        assert_eq!(circuit.branches.len(), 1);
        // hinges do not move
        assert!(motion("crank.x").is_none() && motion("rocker.z").is_none());
    }
    assert_ne!(sides[0], sides[1]);
    // the longest and the shortest are together longer than the others: nothing turns fully, one circuit
    let report = of([4.0, 2.0, 1.8, 3.0]);
    let [circuit] = &report.circuits[..] else {
        panic!("{report:#?}")
    };
    assert!(circuit.platforms.iter().all(|of| of.turns == 0));
    assert_eq!(circuit.branches.len(), 2);
    let most = ((16.0 + 4.0 - 4.8f64.powi(2)) / 16.0).acos();
    let crank = circuit
        .platforms
        .iter()
        .find(|of| of.name == "crank.yaw")
        .unwrap();
    assert!((crank.high - most).abs() < 1e-8 && (crank.low + most).abs() < 1e-8);
    // a triangle of rods does not move
    let stiff = ask::Question::new(four_bar_of_platforms(lengths)).hold("crank.yaw", 1.0);
    assert!(stiff.circuits(&Watch::none()).is_err());
}

#[test]
fn a_segment_that_ends_just_before_a_dead_point_is_completed() {
    let chebyshev = mechanism("chebyshev");
    // coupler and rocker in line: 16 + 25 - 40 cos(theta) = 49
    let dead = (-0.2f64).acos();
    let moved = |to: f64| {
        let question = ask::Question::new(chebyshev.clone()).input("theta1", 0.7, to);
        let motions = question
            .motions(&SweepSettings::default(), &Watch::none())
            .unwrap();
        let mut report = motions.report(200, &mut |_, _| {}, &Watch::none());
        let motion = report.motions.remove(0);
        let column = motion.columns.iter().position(|of| of.name == "theta1");
        let last = motion.values.last().unwrap()[column.unwrap()].unwrap();
        (motion.sweep.ending, last)
    };
    for short in [1e-3, 1e-4, 1e-5, 1e-6, 1e-8] {
        let (ending, last) = moved(dead - short);
        assert_eq!(ending, SweepEnd::Complete, "{short:e}");
        assert!((last - (dead - short)).abs() < 1e-12, "{short:e}: {last}");
    }
    for beyond in [1e-6, 1e-4, 0.1] {
        let (ending, last) = moved(dead + beyond);
        assert_eq!(ending, SweepEnd::Fold, "{beyond:e}");
        assert!((last - dead).abs() < 1e-9, "{beyond:e}: {last}");
    }
}

fn certified(steps: usize) -> SweepSettings {
    SweepSettings {
        certify: true,
        ..self::steps(steps)
    }
}

#[test]
fn both_branches_of_a_crank_rocker_are_certified_all_round() {
    let lengths = [5.0, 1.0, 3.0, 4.0];
    let mechanism = four_bar(lengths);
    for side in [1.0, -1.0] {
        let inputs = [joint(&mechanism, "theta1", 1.0, 1.0 + TAU)];
        let guess = four_bar_guess(lengths, 1.0, side);
        let certificate = run(&mechanism, &inputs, &guess, &certified(8))
            .report
            .certificate;
        let certificate = certificate.unwrap();
        assert!(certificate.is_whole() && certificate.boxes >= 8);
        assert_eq!(
            run(&mechanism, &inputs, &guess, &steps(8))
                .report
                .certificate,
            None
        );
    }
}

#[test]
fn a_branch_is_certified_up_to_its_dead_point_and_no_further() {
    let lengths = [3.0, 2.5, 2.0, 1.0];
    let mechanism = four_bar(lengths);
    let [wide, narrow] = limits(lengths);
    let end = [wide, narrow]
        .into_iter()
        .find(|end| end.is_finite())
        .unwrap();
    let inputs = [joint(&mechanism, "theta1", 0.6, 3.0)];
    let guess = four_bar_guess(lengths, 0.6, 1.0);
    let swept = run(&mechanism, &inputs, &guess, &certified(40));
    assert_eq!(swept.ending(), SweepEnd::Fold);
    let certificate = swept.report.certificate.unwrap();
    let [open] = &certificate.uncertified[..] else {
        panic!("{certificate:?}")
    };
    assert!((open.to[0] - end).abs() < 1e-12);
    assert!((0.0..1e-4).contains(&(end - open.from[0])), "{open:?}");
    assert!(!certificate.is_whole());
}

#[test]
fn a_branch_is_certified_up_to_a_crossing_and_past_one_that_is_just_missed() {
    let crossing = mechanism("parallelogram");
    let inputs = [joint(&crossing, "theta1", 0.5, 0.5 + TAU)];
    let guess = [("phi2", -0.5), ("phi1", 0.5)];
    let certificate = run(&crossing, &inputs, &guess, &certified(40))
        .report
        .certificate;
    let open = &certificate.unwrap().uncertified;
    assert!(
        open.len() == 1 && (open[0].to[0] - PI).abs() < 1e-9,
        "{open:?}"
    );
    assert!(PI - open[0].from[0] < 1e-3, "{open:?}");

    // with a slightly shorter crank it goes round, and nearly meets the other branch
    let lengths = [2.0, 0.999, 2.0, 1.0];
    let missed = four_bar(lengths);
    let inputs = [joint(&missed, "theta1", 0.5, 0.5 + TAU)];
    let guess = four_bar_guess(lengths, 0.5, 1.0);
    let swept = run(&missed, &inputs, &guess, &certified(40));
    assert_eq!(swept.ending(), SweepEnd::Complete);
    let certificate = swept.report.certificate.unwrap();
    assert!(certificate.is_whole(), "{certificate:?}");
    // narrower boxes are needed there
    assert!(certificate.boxes > 60, "{certificate:?}");
}

#[test]
fn motions_of_platforms_are_certified() {
    let platform = mechanism("three_rps");
    let raised = ask::Question::new(platform.clone()).free("actuated");
    let raised = raised.hold("top.roll", 0.1).hold("top.pitch", 0.0);
    let raised = raised.input("top.z", 0.5, 0.8);
    let legs = ask::Question::new(platform).hold("l3", 0.7);
    let legs = legs.input("l1", 0.6, 0.8).input("l2", 0.7, 0.75);
    for question in [raised, legs] {
        let motions = question.motions(&certified(10), &Watch::none()).unwrap();
        let report = motions.run(&motions.starts[0].1, &mut |_| {}, &Watch::none());
        assert_eq!(report.ending, SweepEnd::Complete);
        let certificate = report.certificate.unwrap();
        assert!(
            certificate.is_whole() && certificate.boxes >= 10,
            "{certificate:?}"
        );
    }
}

#[test]
fn an_arm_without_loops_is_certified_and_a_turn_is_all_of_a_platforms_angle() {
    let arm = mechanism("planar_2r");
    let question = ask::Question::new(arm);
    let question = question.input("theta1", 0.5, 1.0).input("theta2", 0.5, 1.0);
    let motions = question.motions(&certified(3), &Watch::none()).unwrap();
    let report = motions.run(&motions.starts[0].1, &mut |_| {}, &Watch::none());
    assert!(report.certificate.unwrap().is_whole());

    for (turn, allowed) in [(1.0, true), (1.1, false)] {
        let question = ask::Question::new(mechanism("planar_3rpr")).free("actuated");
        let question = question.hold("platform.x", 14.9).hold("platform.y", -1.3);
        let question = question.input("platform.yaw", 0.0, turn * TAU);
        let motions = question.motions(&steps(10), &Watch::none());
        let refused = matches!(motions, Err(ask::AskError::MoreThanATurn { .. }));
        assert_eq!(refused, !allowed);
    }
}
