//! Circuits: as many as the closed forms of the textbooks, or a dense count of assemblies, say there are.

use std::f64::consts::{PI, TAU};

use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::sweep::{Circuit, CircuitsReport, FourBarClass};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;
use linkwork::system::Coordinate;

fn question(text: &str) -> Question {
    Question::new(Mechanism::new(&Description::read(text).unwrap()).unwrap())
}

fn circuits(text: &str) -> CircuitsReport {
    question(text).circuits(&Watch::none()).unwrap()
}

fn branches(report: &CircuitsReport) -> usize {
    report.circuits.iter().map(|c| c.branches.len()).sum()
}

/// A 4-bar with its crank at an angle, assembled by the law of cosines on one side of the diagonal; none where it does
/// not reach.
fn four_bar([g, a, b, c]: [f64; 4], t: f64, side: f64) -> Option<String> {
    let (x, y) = (g - a * t.cos(), -a * t.sin());
    let diagonal = x.hypot(y);
    let corner = (b * b + diagonal * diagonal - c * c) / (2.0 * b * diagonal);
    if corner.abs() > 1.0 {
        return None;
    }
    let coupler = y.atan2(x) + side * corner.acos();
    let (x, y) = (coupler.cos() * b - x, coupler.sin() * b - y);
    let (f, s) = (coupler - t, y.atan2(x));
    Some(format!(
        r#"Mechanism(version: 1, name: "4-bar", convention: Modified,
            joints: {{ "t": Actuated(home: {t:?}), "f": Passive(home: {f:?}), "s": Passive(home: {s:?}) }},
            chains: {{ "left": Chain(rows: [(theta: "t"), (a: {a:?}, theta: "f")], tip: [Tx({b:?})]),
                "right": Chain(base: [Tx({g:?})], rows: [(theta: "s")], tip: [Tx({c:?})]) }},
            closures: {{ "pin": Revolute("left", "right") }})"#
    ))
}

/// A geared 5-bar: crank, coupler, coupler, crank and ground lengths, and the second crank's angle.
fn geared([a, p, q, b, g]: [f64; 5], angle: &str) -> String {
    format!(
        r#"Mechanism(version: 1, name: "geared 5-bar", convention: Modified,
            joints: {{ "a": Actuated(home: 0.5), "p": Passive(), "q": Passive() }},
            chains: {{ "left": Chain(rows: [(theta: "a"), (a: {a:?}, theta: "p")], tip: [Tx({p:?})]),
                "right": Chain(base: [Tx({g:?})], rows: [(theta: "{angle}"), (a: {b:?}, theta: "q")], tip: [Tx({q:?})]) }},
            closures: {{ "pin": Revolute("left", "right") }})"#
    )
}

/// Numbers in (0, 1), the same in every run.
fn dice(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 11) as f64) / (1u64 << 53) as f64
    }
}

fn is_near(x: f64, degrees: f64) -> bool {
    (x.to_degrees() - degrees).abs() < 0.01
}

#[test]
fn circuits_on_which_the_input_swings_little_are_found() {
    let lengths @ [g, a, b, c] = [1.748, 1.804, 1.602, 0.355];
    let report = circuits(&four_bar(lengths, -1.07, 1.0).unwrap());
    assert_eq!((report.circuits.len(), branches(&report)), (2, 4));
    assert_eq!(report.class, Some(FourBarClass::CrankRocker));
    // dead points by the law of cosines: coupler and rocker in line
    let dead = |reach: f64| ((g * g + a * a - reach * reach) / (2.0 * g * a)).acos();
    let (low, high) = (dead(b - c), dead(b + c));
    for circuit in &report.circuits {
        let t = &circuit.joints[0];
        let ends = [t.low.abs().min(t.high.abs()), t.low.abs().max(t.high.abs())];
        assert!(
            (ends[0] - low).abs() < 1e-9 && (ends[1] - high).abs() < 1e-9,
            "{t:?}"
        );
    }
    let document = report.document();
    assert!(document.answer.starts_with("2 circuits with 4 branches"));
    assert!(document.method[0].contains("these are all circuits on which t moves"));
}

#[test]
fn four_bars_of_every_class_have_the_circuits_that_grashof_says() {
    let mut random = dice(7);
    let mut classes = Vec::new();
    for _ in 0..60 {
        let lengths = [(); 4].map(|()| 0.2 + 2.3 * random());
        let begun = (0..20).find_map(|_| four_bar(lengths, TAU * random() - PI, 1.0));
        let Some(text) = begun else { continue };
        let report = circuits(&text);
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let [shortest, second, third, longest] = sorted;
        let expected = match () {
            () if shortest + longest > second + third => FourBarClass::TripleRocker,
            () if shortest == lengths[0] => FourBarClass::DoubleCrank,
            () if shortest == lengths[2] => FourBarClass::DoubleRocker,
            () => FourBarClass::CrankRocker,
        };
        let count = if expected == FourBarClass::TripleRocker {
            1
        } else {
            2
        };
        assert_eq!(report.circuits.len(), count, "{lengths:?}");
        assert_eq!(report.class, Some(expected), "{lengths:?}");
        assert_eq!(report.grashof.unwrap().class, expected, "{lengths:?}");
        assert!(report.is_whole(), "{lengths:?}: {:?}", report.swept);
        classes.push(expected);
    }
    for class in [
        FourBarClass::TripleRocker,
        FourBarClass::DoubleCrank,
        FourBarClass::DoubleRocker,
        FourBarClass::CrankRocker,
    ] {
        assert!(classes.contains(&class), "{class:?} was not among them");
    }
}

/// A spherical 4-bar of arcs: ground, input, coupler and output.
fn spherical([ground, input, coupler, output]: [f64; 4], t: f64) -> String {
    format!(
        r#"Mechanism(version: 1, name: "spherical 4-bar", convention: Standard,
            joints: {{ "t": Actuated(home: {t:?}), "p": Passive(home: 0.5), "f": Passive(home: 0.5) }},
            chains: {{ "left": Chain(rows: [(alpha: {input:?}, theta: "t"), (alpha: {coupler:?}, theta: "p")], tip: [Tz(0.1)]),
                "right": Chain(base: [Rx({ground:?})], rows: [(alpha: {output:?}, theta: "f")], tip: [Tz(0.1)]) }},
            closures: {{ "pin": Revolute("left", "right") }})"#
    )
}

/// The ends u of the input and v of the output are a coupler apart: u·v = cos(coupler) is A sin f + B cos f = C, with two
/// solutions where A² + B² > C². One circuit goes round each interval of the input where that holds; where it holds for a
/// whole turn there are two.
#[test]
fn spherical_four_bars_have_a_circuit_for_each_interval_of_the_input() {
    const ANGLES: usize = 5000;
    let mut random = dice(11);
    let mut seen = [0; 3];
    while seen.iter().sum::<usize>() < 14 {
        let arcs @ [ground, input, coupler, output] = [(); 4].map(|()| 0.2 + 2.7 * random());
        let open = |i: usize| {
            let (s, c) = (TAU * i as f64 / ANGLES as f64).sin_cos();
            // the end of the input in axes of the output's pivot
            let [x, y, z] = [s * input.sin(), -c * input.sin(), input.cos()];
            let (s, c) = ground.sin_cos();
            let [y, z] = [c * y + s * z, c * z - s * y];
            let (a, b) = (x * output.sin(), -y * output.sin());
            a * a + b * b - (coupler.cos() - z * output.cos()).powi(2)
        };
        let open: Vec<f64> = (0..ANGLES).map(open).collect();
        let before = |i: usize| open[(i + ANGLES - 1) % ANGLES];
        let ends = (0..ANGLES)
            .filter(|&i| (open[i] > 0.0) != (before(i) > 0.0))
            .count();
        let (begin, most) = open
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(b.1))
            .unwrap();
        // an interval between samples would be a linkage next to its change point
        let next = |i: usize| open[(i + 1) % ANGLES];
        let turns = (0..ANGLES).filter(|&i| (open[i] > before(i)) == (open[i] > next(i)));
        if *most < 1e-3 || turns.into_iter().any(|i| open[i].abs() < 1e-3) {
            continue;
        }
        let report = circuits(&spherical(arcs, TAU * begin as f64 / ANGLES as f64));
        let expected = if ends == 0 { 2 } else { ends / 2 };
        assert_eq!(report.circuits.len(), expected, "{arcs:?}");
        assert!(report.is_whole(), "{arcs:?}: {:?}", report.swept);
        seen[ends / 2] += 1;
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}

/// A Stephenson six-bar with three circuits, of which the input q2 turns fully on none.
const SIX_BAR: &str = r#"Mechanism(version: 1, name: "six-bar", convention: Modified,
    joints: { "q0": Passive(home: -1.4785313930596062), "q1": Passive(home: -1.5072427335563254),
        "q2": Actuated(home: 1.548865253075535), "q3": Passive(home: -1.447511902878361),
        "q4": Passive(home: -0.21336047560464122) },
    chains: {
        "A": Chain(rows: [(a: 1.3665912272652294, theta: "q0"), (a: 1.3439089730454539, theta: "q1")],
            tip: [Tx(1.3148753676736833)]),
        "B": Chain(base: [T(1.9177327531535044, 0.5787452202086016, 0)],
            rows: [(a: 1.0597531647553338, theta: "q2")],
            tip: [T(-2.181577374199833, 2.7388384320893473, 0), Rz(1.2079308622515248)]),
        "C": Chain(base: [T(0.11990138243563497, -0.27903272032388404, 0)],
            rows: [(a: 1.018737675524863, theta: "q3"), (a: 0.7926395247815419, theta: "q4")],
            tip: [Tx(1.811456926870304)]),
        "D": Chain(on: "A.2", base: [T(-1.669183471129203, -1.5176924368545994, 0)],
            tip: [T(2.319059469221833, 2.9659614765289675, 0), Rz(1.1783740814784895)]),
    },
    closures: { "c1": Revolute("A", "B"), "c2": Revolute("C", "D") })"#;

/// How far joints are from the course of a circuit: from the chords of its steps, whole turns left out.
fn distance(circuit: &Circuit, joints: &[f64]) -> f64 {
    let gap = |from: &[f64], to: &[f64]| -> Vec<f64> {
        let apart = to.iter().zip(from).map(|(a, b)| a - b);
        apart.map(|x| x - TAU * (x / TAU).round()).collect()
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let chords = circuit.course.windows(2).map(|pair| {
        let (chord, way) = (gap(&pair[0], &pair[1]), gap(&pair[0], joints));
        let part = (dot(&chord, &way) / dot(&chord, &chord)).clamp(0.0, 1.0);
        let beside = way.iter().zip(&chord).map(|(w, c)| w - part * c);
        beside.map(|x| x * x).sum::<f64>().sqrt()
    });
    chords.fold(f64::INFINITY, f64::min)
}

#[test]
fn circuits_of_a_six_bar_hold_every_assembly() {
    let asked = question(SIX_BAR);
    let report = asked.circuits(&Watch::none()).unwrap();
    assert_eq!(report.circuits.len(), 3);
    assert!(report.is_whole());
    // from counting both assemblies on a dense grid
    for (low, high) in [(52.247, 89.817), (23.872, 38.989), (100.293, 118.574)] {
        let swings =
            |c: &&Circuit| is_near(c.joints[2].low, low) && is_near(c.joints[2].high, high);
        assert!(report.circuits.iter().any(|c| swings(&c)), "{low}");
    }
    let input = asked.mechanism().joint("q2").unwrap();
    let mut met = 0;
    for degrees in [24.0, 25.0, 30.0, 38.0, 60.0, 89.0, 101.0, 118.0] {
        let held = asked.clone().hold("q2", f64::to_radians(degrees));
        let wanted = Wanted::default();
        let found = held.assemblies(wanted, &Watch::none()).unwrap();
        for assembly in &found.assemblies {
            let joints = assembly.configuration().joints;
            assert!(
                (Coordinate::Joint(input).of(asked.mechanism(), &assembly.configuration())
                    - degrees.to_radians())
                .abs()
                    < 1e-9
            );
            let nearest = report.circuits.iter().map(|c| distance(c, &joints));
            assert!(
                nearest.fold(f64::INFINITY, f64::min) < 0.02,
                "{degrees}: {joints:?}"
            );
            met += 1;
        }
    }
    assert!(met > 12, "{met}");
}

#[test]
fn geared_circuits_close_after_the_common_period() {
    // ratio 1/2: everything is where it was after two turns of a
    let report = circuits(&geared([0.5, 1.5, 1.45, 0.4, 1.0], "a/2"));
    assert_eq!(report.circuits.len(), 2);
    for circuit in &report.circuits {
        assert!(circuit.closed && circuit.whole);
        assert_eq!(circuit.joints[0].turns.abs(), 2);
    }
    // ratio 3/2: where |AB| lies between the sum and the difference of the couplers, from a dense grid
    let report = circuits(&geared([0.9, 0.9, 0.6, 0.6, 0.9], "3*a/2 + 0.72"));
    assert_eq!(report.circuits.len(), 3);
    let lone =
        |c: &Circuit| is_near(c.joints[0].low, 285.755) && is_near(c.joints[0].high, 420.565);
    assert!(report.circuits.iter().any(lone), "{report:#?}");
}

#[test]
fn as_many_circuits_of_geared_five_bars_as_ranges_in_which_their_couplers_reach() {
    let mut random = dice(3);
    let ratios = [
        (1, 2),
        (-1, 2),
        (1, 3),
        (-1, 3),
        (2, 3),
        (3, 2),
        (5, 4),
        (2, 1),
    ];
    let mut counted = 0;
    for (over, under) in ratios.into_iter().cycle().take(24) {
        let lengths @ [a, p, q, b, g] = [(); 5].map(|()| 0.2 + 1.3 * random());
        let turned = 6.0 * random();
        let period = TAU * f64::from(under);
        let apart = |t: f64| {
            let second = f64::from(over) * t / f64::from(under) + turned;
            let (x, y) = (
                g + b * second.cos() - a * t.cos(),
                b * second.sin() - a * t.sin(),
            );
            x.hypot(y)
        };
        let reaches = |t: f64| ((p - q).abs()..=p + q).contains(&apart(t));
        let grid: Vec<bool> = (0..40_000)
            .map(|k| reaches(period * f64::from(k) / 40_000.0))
            .collect();
        let begins =
            (0..grid.len()).filter(|&k| grid[k] && !grid[(k + grid.len() - 1) % grid.len()]);
        let expected = match grid.iter().all(|reaches| *reaches) {
            true => 2,
            false => begins.count(),
        };
        if expected == 0 {
            continue;
        }
        // begun where the couplers are farthest from being in line
        let bent = |t: f64| (apart(t) - p.max(q)).abs();
        let values = (0..400).map(|k| TAU * f64::from(k) / 400.0);
        let home = values.min_by(|a, b| bent(*a).total_cmp(&bent(*b))).unwrap();
        if !reaches(home) {
            continue;
        }
        let text = geared(lengths, &format!("{over}*a/{under} + {turned:?}"));
        let report = circuits(&text.replace("home: 0.5", &format!("home: {home:?}")));
        assert_eq!(
            report.circuits.len(),
            expected,
            "{over}/{under}: {lengths:?}, {turned}"
        );
        assert!(report.is_whole() && report.circuits.iter().all(|c| c.closed));
        counted += 1;
    }
    assert!(counted > 12, "{counted}");
}

#[test]
fn a_ratio_that_is_no_fraction_ends_with_a_word_about_it() {
    let report = circuits(&geared([0.5, 1.5, 1.45, 0.4, 1.0], "a*sqrt(2)"));
    assert!(!report.is_whole() && report.circuits.iter().any(|c| !c.whole));
    assert!(report.document().answer.starts_with("At least"));
    assert!(!report.is_yes());
}

#[test]
fn a_curve_begun_beside_a_crossing_is_the_one_that_crosses() {
    // l0 + l1 = l2 + l3 in three kinds, each with all links in one line at t = 0 or π
    let told = |report: &CircuitsReport| {
        let mut lengths: Vec<f64> = report.circuits.iter().map(|c| c.length).collect();
        lengths.sort_by(f64::total_cmp);
        (branches(report), lengths)
    };
    for (lengths, line) in [
        ([4.0, 3.0, 2.0, 3.0], 0.0),
        ([4.0, 2.0, 4.0, 2.0], 0.0),
        ([4.0, 2.0, 4.0, 2.0], PI),
        ([1.46, 1.23, 0.58, 2.11], PI),
    ] {
        let far = circuits(&four_bar(lengths, line + 0.9, 1.0).unwrap());
        let (expected, expected_lengths) = told(&far);
        for distance in [1e-7, 1e-6, 1e-5, 1e-4, 2.4e-4, 1e-3, 1e-2] {
            for side in [1.0, -1.0] {
                let Some(text) = four_bar(lengths, line - distance, side) else {
                    continue;
                };
                let report = circuits(&text);
                let (branches, found) = told(&report);
                assert_eq!(branches, expected, "{lengths:?} at {distance:e}");
                assert_eq!(report.class, Some(FourBarClass::ChangePoint));
                assert_eq!(found.len(), expected_lengths.len());
                for (a, b) in found.iter().zip(&expected_lengths) {
                    assert!((a - b).abs() < 1e-5, "{a} for {b}");
                }
                let swings = report.circuits.iter().flat_map(|c| &c.joints);
                assert!(
                    swings
                        .filter(|j| j.turns == 0)
                        .all(|j| j.high - j.low < TAU)
                );
            }
        }
    }
}

#[test]
fn limits_cut_a_circuit_into_the_pieces_between_them() {
    // a crank-rocker whose rocker swings from 128.68° to 157.67° and back once a turn: limits inside leave two pieces
    let free = four_bar([5.0, 1.0, 3.0, 4.0], 0.5, 1.0).unwrap();
    let limits = [f64::to_radians(135.0), f64::to_radians(150.0)];
    let home = free.split(r#""s": Passive(home: "#).nth(1).unwrap();
    let home = home.split(')').next().unwrap();
    let limited = free.replace(
        &format!(r#""s": Passive(home: {home})"#),
        &format!(
            r#""s": Passive(home: {home}, limits: ({:?}, {:?}))"#,
            limits[0], limits[1]
        ),
    );
    assert_ne!(free, limited);
    let report = circuits(&limited);
    assert_eq!(report.circuits.len(), 2);
    for circuit in &report.circuits {
        let s = &circuit.joints[2];
        assert!(!circuit.closed && circuit.whole);
        assert!(
            (s.low - limits[0]).abs() < 1e-9 && (s.high - limits[1]).abs() < 1e-9,
            "{s:?}"
        );
    }
}

/// Curves that end on the way may be parts of one circuit, and are not counted as circuits.
#[test]
fn curves_that_were_not_followed_to_their_end_are_not_counted_as_circuits() {
    let text = four_bar([5.0, 1.0, 3.0, 4.0], 1.0, 1.0).unwrap();
    let mut report = circuits(&text);
    assert_eq!(report.circuits.len(), 2);
    report.circuits[1].whole = false;
    let said = report.document().answer;
    assert!(said.starts_with("At least 2 circuits with"), "{said}");
    report.circuits[0].whole = false;
    let said = report.document().answer;
    let one = "At least 1 circuit for t: 2 curves were not followed to their end, and may be parts of one circuit.";
    assert_eq!(said, one);
}

#[test]
fn configurations_with_more_freedoms_are_on_no_circuit_and_leave_the_others_whole() {
    let circuits = |name: &str| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms");
        let (_, description) = Mechanism::read(format!("{folder}/{name}.ron")).unwrap();
        let mechanism = Mechanism::new(&description).unwrap();
        Question::new(mechanism).circuits(&Watch::none()).unwrap()
    };
    let report = circuits("axes/scissor_lift");
    assert!(report.is_whole(), "{:?}", report.swept);
    let swept = report.swept.as_ref().unwrap();
    assert_eq!((swept.freedoms, swept.configurations), (1, 4));
    // each turns once, and so passes every value once
    let turns = report
        .circuits
        .iter()
        .map(|circuit| circuit.joints[0].turns);
    assert_eq!(turns.map(i64::abs).collect::<Vec<_>>(), [1; 4]);
    // the rhombus of the inversor folds where O and C are L − S = 3 m apart: 2 g cos(θ/2) = 3 m. Its arms stand on either side
    // of OC and its other bars too: two curves, on which θ goes to and fro between the folds
    let report = circuits("peaucellier");
    assert!(report.is_whole(), "{:?}", report.swept);
    assert_eq!(report.circuits.len(), 2);
    let folded = 2.0 * f64::acos(3.0 / 5.0);
    let branches = report.circuits.iter().flat_map(|circuit| &circuit.branches);
    let ends: Vec<[f64; 2]> = branches.map(|branch| [branch.low, branch.high]).collect();
    assert_eq!(ends.len(), 4);
    for [low, high] in ends {
        assert!((low + folded).abs() < 1e-8 && (high - folded).abs() < 1e-8);
    }
}

/// Rods of a delta robot on both sides of each other: with two arms held, most poses are far from those of the robot, and some
/// hundreds of its sizes away, whose paths are long.
#[test]
fn a_delta_with_two_arms_held_has_a_branch_for_every_assembly() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms");
    let (_, description) = Mechanism::read(format!("{folder}/delta.ron")).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let asked = (Question::new(mechanism).hold("theta1", 0.1)).hold("theta2", 0.2);
    let report = asked.circuits(&Watch::none()).unwrap();
    // far away paths are lost, and may have led to others
    assert!(!report.is_whole());
    assert!(report.document().answer.starts_with("At least"));
    for degrees in [80.0_f64, 30.0, -40.0] {
        let at = degrees.to_radians();
        let held = asked.clone().hold("theta3", at);
        let found = held.assemblies(Wanted::default(), &Watch::none()).unwrap();
        let branches = report.circuits.iter().flat_map(|circuit| &circuit.branches);
        let passing = branches.filter(|of| of.low < at && at < of.high);
        assert_eq!(passing.count(), found.real, "theta3 = {degrees}°");
    }
}
