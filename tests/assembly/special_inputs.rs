//! All assemblies at inputs where they are not what they are elsewhere: where two meet, where
//! infinitely many are connected, far away, beside what is asked first.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Fit, Followed, LostReason, Wanted,
};
use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::assemblies::completeness;
use linkwork::solve::Watch;
use linkwork::system::{Question, check_count};

fn path_of(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"))
}

fn with(name: &str, values: &[(&str, &str)]) -> Mechanism {
    let text = std::fs::read_to_string(path_of(name)).unwrap();
    let mut description = Description::read(&text).unwrap();
    for (parameter, value) in values {
        description = description.with_parameter(parameter, value).unwrap();
    }
    Mechanism::new(&description).unwrap()
}

fn asked<'a>(mechanism: &'a Mechanism, free: &[&str], held: &[(&str, &str)]) -> Question<'a> {
    let mut question = Question::new(mechanism);
    for name in free {
        question = question.free(name).unwrap();
    }
    for (name, value) in held {
        question = question.hold(name, *value).unwrap();
    }
    question
}

fn answer(question: &Question, seed: u64) -> AssembliesReport {
    let settings = AssembliesSettings {
        seed,
        ..AssembliesSettings::default()
    };
    let solver = AssemblySolver::new(
        question.mechanism(),
        &question.held(),
        &settings,
        &Watch::none(),
    )
    .unwrap();
    let report = solver.at_targets(
        &question.start(),
        &question.held(),
        Wanted::default(),
        &Watch::none(),
    );
    assert_eq!((report.lost, report.unexpected), (0, 0), "seed {seed}");
    report
}

fn turn(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

fn joint(report: &AssembliesReport, k: usize, name: &str) -> f64 {
    *report.assemblies[k].joints.get(name).unwrap()
}

/// The hand of the PUMA where its joints have these values in degrees: the file's table written out.
fn hand(theta: [f64; 6]) -> String {
    let [t1, t2, t3, t4, t5, t6] = theta;
    format!(
        "[Rz({t1} deg), Tz(d1), Rx(90 deg), Rz({t2} deg), Tx(a2), Rz({t3} deg), Tz(d3), Tx(a3), Rx(-90 deg), \
         Rz({t4} deg), Tz(d4), Rx(90 deg), Rz({t5} deg), Rx(-90 deg), Rz({t6} deg)]"
    )
}

fn inverse(theta: [f64; 6], seed: u64) -> AssembliesReport {
    let puma = with("puma560_corke", &[]);
    answer(
        &asked(&puma, &["actuated"], &[("hand", &hand(theta))]),
        seed,
    )
}

/// With the wrist stretched, joints 4 and 6 turn about one line: only the sum of their angles is
/// determined. The other three ways to reach the wrist's place leave it bent.
#[test]
fn a_stretched_wrist_has_infinitely_many_postures_beside_six() {
    for seed in [1, 2] {
        let report = inverse([30.0, 45.0, -135.0, 20.0, 0.0, 10.0], seed);
        assert_eq!(report.fit, Fit::Finite);
        assert_eq!((report.complex, report.not_isolated), (6, 2), "seed {seed}");
        let [set] = &report.continua[..] else {
            panic!("one set, not {:?}", report.continua)
        };
        assert_eq!((set.dimension, set.paths), (1, 2));
        assert!(set.samples.len() > 1);
        for (k, a) in report.assemblies.iter().enumerate() {
            let sample = set.samples.contains(&a.mode);
            assert_eq!(a.dimension, usize::from(sample));
            assert_eq!(a.multiplicity, usize::from(!sample));
            assert_eq!(a.certified, !sample);
            assert_eq!(turn(joint(&report, k, "theta5"), 0.0) < 1e-9, sample);
            if sample {
                let sum = joint(&report, k, "theta4") + joint(&report, k, "theta6");
                assert!(turn(sum, 30f64.to_radians()) < 1e-9);
            }
        }
        assert!(completeness(&report).contains("infinitely many"));
    }
    // bent by two degrees it has eight
    let report = inverse([30.0, 45.0, -135.0, 20.0, 2.0, 10.0], 1);
    assert_eq!((report.complex, report.real), (8, 8));
    assert!(report.continua.is_empty());
}

/// The crank on the ground leaves both couplers to turn freely about the common post; lifted by four
/// degrees, each has its two positions: parallel to the ground or back on the crank.
#[test]
fn rhombi_with_the_crank_on_the_ground_have_a_set_of_dimension_two() {
    let rhombi = with("two_rhombi", &[]);
    for seed in 1..=3 {
        let report = answer(&Question::new(&rhombi), seed);
        assert_eq!((report.complex, report.not_isolated), (0, 4));
        assert_eq!(report.continua.len(), 1);
        assert_eq!(report.continua[0].dimension, 2);
        assert!(!report.continua[0].samples.is_empty());
        for k in 0..report.real {
            for i in ["1", "2"] {
                let [phi, psi] =
                    ["phi", "psi"].map(|name| joint(&report, k, &format!("{name}{i}")));
                assert!(turn(phi, psi) < 1e-9);
            }
        }
    }
    let question = asked(&rhombi, &[], &[("theta", "4 deg")]);
    check_count(&question).expect("the crank can be chosen");
    let report = answer(&question, 1);
    assert_eq!((report.complex, report.real), (4, 4));
    assert!(report.continua.is_empty());
    for k in 0..4 {
        for phi in ["phi1", "phi2"].map(|name| joint(&report, k, name)) {
            let parallel = turn(phi, -4f64.to_radians()) < 1e-9;
            assert!(parallel || turn(phi, PI) < 1e-9);
        }
    }
}

/// Both wrists of a shoulder stretched out along the first axis: the first joint is free too.
#[test]
fn a_wrist_over_the_shoulder_is_not_denied() {
    // without the shoulder's offset the wrist can stand on the first axis
    let puma = with("puma560_corke", &[("d3", "0"), ("a3", "0")]);
    let question = asked(
        &puma,
        &["actuated"],
        &[("hand", "[Tz(d1 + 0.5), Rz(20 deg), Ry(35 deg)]")],
    );
    let report = answer(&question, 1);
    assert_eq!(report.continua.first().map(|set| set.dimension), Some(1));
    assert!(report.real > 0);
    let report = answer(
        &asked(
            &puma,
            &["actuated"],
            &[("hand", "[T(0.1, 0.2, d1 + 0.5), Rz(20 deg), Ry(35 deg)]")],
        ),
        1,
    );
    assert!(report.continua.is_empty());
    assert_eq!(report.real, 8);
}

const STRETCHED: [(&str, &str); 4] = [("l0", "4"), ("l1", "2"), ("l2", "2"), ("l3", "3")];

/// Crank at cos θ = −5/16: coupler and rocker in one line, the rocker's direction is that from its
/// post to the end of the crank.
#[test]
fn two_assemblies_that_meet_are_one_to_the_last_digits() {
    let mechanism = with("four_bar", &STRETCHED);
    let question = asked(&mechanism, &[], &[("theta1", "acos(-5/16)")]);
    let theta = f64::acos(-5.0 / 16.0);
    let rocker = (2.0 * theta.sin()).atan2(2.0 * theta.cos() - 4.0);
    for seed in 1..=12 {
        let report = answer(&question, seed);
        assert_eq!((report.complex, report.real, report.singular), (2, 1, 1));
        assert_eq!(report.assemblies[0].multiplicity, 2, "seed {seed}");
        let found = joint(&report, 0, "phi1");
        assert!(turn(found, rocker) < 1e-12, "seed {seed}: {found}");
        assert!(report.continua.is_empty());
    }
}

/// Beyond the dead point by however little there is none; before it there are two.
#[test]
fn beside_a_dead_point_there_are_two_or_none() {
    let mechanism = with("four_bar", &STRETCHED);
    for little in ["1e-5", "1e-7", "1e-8", "1e-9", "1e-10"] {
        let at = |sign: &str, seed: u64| {
            let value = format!("acos(-5/16) {sign} {little}");
            answer(&asked(&mechanism, &[], &[("theta1", &value)]), seed)
        };
        for seed in [1, 2, 3] {
            let before = at("-", seed);
            assert_eq!((before.real, before.complex), (2, 2), "{little}");
            assert!(before.assemblies.iter().all(|a| a.multiplicity == 1));
            let beyond = at("+", seed);
            assert_eq!((beyond.real, beyond.complex), (0, 2), "{little}");
        }
    }
}

/// A triangle gone flat is two circles that touch: one double point, for all lengths.
#[test]
fn a_shaky_structure_is_one_double_assembly_for_every_seed() {
    let flat = with("flat_triangle", &[]);
    for seed in 1..=12 {
        let report = answer(&Question::new(&flat), seed);
        assert_eq!((report.real, report.complex), (1, 2), "seed {seed}");
        assert!(!report.may_lack_some());
        let only = &report.assemblies[0];
        assert_eq!((only.multiplicity, only.dimension), (2, 0), "seed {seed}");
        assert!(!only.certified && only.condition.is_none());
        for (name, value) in &only.joints.0 {
            assert!(value.abs() < 1e-12, "seed {seed}: {name} = {value}");
        }
    }
    // a triangle with a height has two, mirror images of one another
    let high = answer(&Question::new(&with("triangle", &[])), 1);
    assert_eq!((high.real, high.singular), (2, 0));
}

#[test]
fn a_crank_far_from_home_is_no_mistake() {
    let loop_of_six = with("bricard_line", &[]);
    let question = asked(&loop_of_six, &[], &[("theta1", "-140 deg")]);
    check_count(&question).expect("the crank can be chosen");
    let report = answer(&question, 1);
    assert!(report.real > 0);
    // half a turn about the line of symmetry takes hinge i to hinge i + 3
    for k in 0..report.real {
        assert!(turn(joint(&report, k, "theta4"), -140f64.to_radians()) < 1e-9);
    }
    let both = asked(&loop_of_six, &[], &[("theta2", "1")]);
    assert!(check_count(&both).is_err(), "one freedom, two held");
}

#[test]
fn a_leg_of_a_thousand_kilometres_loses_no_path() {
    let platform = with("stewart_gough_6sps", &[]);
    let report = answer(&asked(&platform, &[], &[("l1", "1e6")]), 1);
    assert_eq!(report.real, 0);
    assert_eq!(report.complex + report.at_infinity, 40);
}

/// A hand held over the first axis of an arm with an offset shoulder: no rotation of the first joint
/// brings the arm there, and its complex angle is infinite.
#[test]
fn a_hand_that_no_angle_reaches_has_its_solutions_at_infinity() {
    let puma = with("puma560_corke", &[]);
    let over = |pose: &str| answer(&asked(&puma, &["actuated"], &[("hand", pose)]), 1);
    let report = over("[T(0, 0, 1), Rx(30 deg), Ry(20 deg)]");
    assert_eq!((report.real, report.at_infinity), (0, 8));
    // a centimetre beside it the angles are complex and finite
    let report = over("[T(0.01, 0, 1), Rx(30 deg), Ry(20 deg)]");
    assert_eq!((report.real, report.complex), (0, 8));
}

/// What is far away because it was asked for there is not at infinity.
#[test]
fn a_hand_held_a_thousand_kilometres_away_is_reached() {
    let robot = with("cylindrical_rpp", &[]);
    let question = asked(
        &robot,
        &["actuated"],
        &[("hand.x", "1e6"), ("hand.y", "2e6"), ("hand.z", "3e6")],
    );
    if check_count(&question).is_err() {
        panic!("the file has another hand");
    }
    let report = answer(&question, 1);
    assert!(report.real > 0, "{}", completeness(&report));
}

#[test]
fn the_closest_approach_is_within_one_turn() {
    for (name, held) in [("four_bar", "theta1"), ("three_rps", "l1")] {
        let mechanism = with(name, &[]);
        let value = if name == "four_bar" { "1" } else { "3" };
        let mechanism = match name {
            "four_bar" => with("four_bar", &[("l1", "50")]),
            _ => mechanism,
        };
        for seed in 1..=5 {
            let report = answer(&asked(&mechanism, &[], &[(held, value)]), seed);
            let closest = report.closest.expect("out of reach");
            for ((_, value), joint) in closest.joints.0.iter().zip(mechanism.joints()) {
                assert!(!joint.kind.is_angle() || value.abs() <= PI, "{value}");
            }
        }
    }
}

fn run(arguments: &[&str], threads: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkwork"));
    let command = command.args(arguments).env("RAYON_NUM_THREADS", threads);
    command.output().unwrap()
}

/// The tables: the section below them says how the search went.
fn tables(name: &str, seed: &str, threads: &str) -> String {
    let path = path_of(name);
    let path = path.to_str().unwrap();
    let output = run(
        &["assemblies", path, "--all-complex", "--seed", seed],
        threads,
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("Complex solutions"), "{name}: {text}");
    let start = text
        .find("\nAssemblies")
        .or(text.find("\nComplex"))
        .unwrap();
    let end = text.find("\nHow it was found").unwrap();
    text[start..end].to_string()
}

/// Chance and threads decide the way; what is printed is the same.
#[test]
fn complex_solutions_are_printed_alike_for_every_seed_and_number_of_threads() {
    for name in ["three_rps", "stewart_gough_6sps", "three_fingered_hand"] {
        let reference = tables(name, "1", "1");
        assert_eq!(tables(name, "1", "3"), reference, "{name}");
        for seed in ["2", "3", "7", "23"] {
            let other = tables(name, seed, "2");
            let mut lines = other.lines().zip(reference.lines());
            if let Some((a, b)) = lines.find(|(a, b)| a != b) {
                panic!("{name}, seed {seed}: `{a}` is not `{b}`");
            }
        }
    }
}

/// Crank against the post, both loops stretched: 2·2 solutions meet, and none is listed beside them.
#[test]
fn where_two_loops_are_stretched_one_fourfold_assembly_is_listed_for_every_seed() {
    let mechanism = with("two_rhombi", &[]);
    for seed in 1..=10 {
        let report = answer(&asked(&mechanism, &[], &[("theta", "pi")]), seed);
        assert_eq!(
            (report.real, report.complex, report.singular),
            (1, 4, 1),
            "seed {seed}"
        );
        assert_eq!(report.assemblies[0].multiplicity, 4);
        for name in ["phi1", "psi1", "phi2", "psi2"] {
            // half a turn is listed one way
            assert!((joint(&report, 0, name) - PI).abs() < 1e-7, "{name}");
        }
    }
}

/// With the crank a little off the post each loop is a parallelogram, or nearly folded: four
/// assemblies, however near the crank is.
#[test]
fn beside_a_set_of_assemblies_there_are_still_four() {
    let mechanism = with("two_rhombi", &[]);
    for theta in [1e-6, 1e-7, 1e-8, 1e-9] {
        let value = format!("{theta:e}");
        let report = answer(&asked(&mechanism, &[], &[("theta", &value)]), 1);
        assert_eq!(
            (report.real, report.complex, report.singular),
            (4, 4, 0),
            "{theta:e}"
        );
        assert!(report.continua.is_empty());
        for k in 0..4 {
            assert_eq!(report.assemblies[k].multiplicity, 1);
            for [phi, psi] in [["phi1", "psi1"], ["phi2", "psi2"]] {
                let [phi, psi] = [phi, psi].map(|name| joint(&report, k, name));
                // the coupler's direction theta + phi and the rocker's psi: along the bars' own, psi =
                // theta and theta + phi = 0, or folded, both half a turn from theta/2
                let parallel = turn(psi, theta).max(turn(theta + phi, 0.0));
                let folded = turn(psi, PI).max(turn(phi, PI));
                assert!(parallel.min(folded) < 1e-6, "{theta:e}: {phi} {psi}");
            }
        }
    }
}

/// Where all directions about the post close within rounding, single ones are no assemblies.
#[test]
fn what_only_rounding_closes_is_not_listed_as_an_assembly_by_itself() {
    let mechanism = with("two_rhombi", &[]);
    for theta in ["1e-11", "1e-12", "1e-13", "1e-15"] {
        let question = asked(&mechanism, &[], &[("theta", theta)]);
        let settings = AssembliesSettings::default();
        let solver =
            AssemblySolver::new(&mechanism, &question.held(), &settings, &Watch::none()).unwrap();
        let report = solver.at(&question.start(), Wanted::default(), &Watch::none());
        let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
        assert!(isolated.count() <= 4, "{theta}: {}", report.real);
        assert_eq!(report.complex + report.not_isolated, 4, "{theta}");
    }
}

/// Beside the change point of a parallelogram the crossed linkage is at φ = −θ (l0 + l1)/(l0 − l1) to
/// first order, the other at φ = θ: two assemblies 4θ apart.
#[test]
fn two_assemblies_that_are_proved_apart_are_listed_apart() {
    let mechanism = with("parallelogram", &[]);
    for (theta, text) in [(1e-5, "1e-5"), (1e-6, "1e-6")] {
        let report = answer(&asked(&mechanism, &[], &[("theta1", text)]), 1);
        assert_eq!(
            (report.real, report.complex, report.singular),
            (2, 2, 0),
            "{text}"
        );
        assert!(report.assemblies.iter().all(|a| a.certified));
        let phi = [0, 1].map(|k| joint(&report, k, "phi1"));
        assert!((phi[0] + 3.0 * theta).abs() < 1e-3 * theta, "{phi:?}");
        assert!((phi[1] - theta).abs() < 1e-3 * theta, "{phi:?}");
        let radii: f64 = report.assemblies.iter().filter_map(|a| a.radius).sum();
        assert!(radii < phi[1] - phi[0]);
    }
    // nearer than double precision can tell
    let report = answer(&asked(&mechanism, &[], &[("theta1", "1e-9")]), 1);
    assert_eq!((report.real, report.complex, report.singular), (1, 2, 1));
    assert_eq!(report.assemblies[0].multiplicity, 2);
}

/// `assemblies` and `solve` call the same configurations assembled, however little is missing.
#[test]
fn what_is_a_little_out_of_reach_is_assembled_for_both_or_for_neither() {
    let arm = with("planar_2r", &[]);
    let linkage = with("four_bar", &[("l0", "7")]);
    let mut verdicts = Vec::new();
    for beyond in ["1e-9", "1e-10", "1e-11", "1e-12", "1e-13", "0", "-1e-11"] {
        let x = format!("1.8 + {beyond}");
        // coupler and rocker stretched: 49 + 1 − 14 cos θ = 49
        let theta = format!("-acos(1/14) - ({beyond})");
        let reach = asked(&arm, &["actuated"], &[("hand.x", &x), ("hand.y", "0")]);
        let fold = asked(&linkage, &[], &[("theta1", &theta)]);
        for question in [reach, fold] {
            let report = answer(&question, 1);
            let one = assemble(&question, &AssemblySettings::default(), &Watch::none()).unwrap();
            let assembled = !matches!(
                one.outcome,
                Outcome::CannotBeAssembled { .. } | Outcome::GaveUp { .. }
            );
            assert_eq!(report.real > 0, assembled, "{beyond}: {:?}", one.outcome);
            assert_eq!(report.closest.is_none(), assembled, "{beyond}");
            assert_eq!(report.complex, 2, "{beyond}");
            verdicts.push(assembled);
        }
    }
    assert!(verdicts.contains(&true) && verdicts.contains(&false));
}

/// Roll, pitch and yaw of the only platform of an assembly.
fn angles(report: &AssembliesReport, k: usize) -> [f64; 3] {
    report.assemblies[k].platforms.0[0].1.roll_pitch_yaw
}

#[test]
fn a_planar_arm_reaches_a_place_under_an_angle_in_two_ways() {
    let arm = with("planar_3r", &[]);
    let held = [("tool.x", "1"), ("tool.y", "0.4"), ("tool.yaw", "30 deg")];
    let question = asked(&arm, &["actuated"], &held);
    check_count(&question).unwrap();
    for seed in 1..=3 {
        let report = answer(&question, seed);
        assert_eq!(
            (report.real, report.complex, report.half_a_turn_away),
            (2, 2, 2)
        );
        assert_eq!(report.generic, report.complex + report.half_a_turn_away);
        // the wrist at (1, 0.4) − 0.5 (cos 30°, sin 30°), by two links of 1 and 0.8
        let (x, y) = (1.0 - 0.5 * (PI / 6.0).cos(), 0.4 - 0.25);
        let bend = ((x * x + y * y - 1.64) / 1.6f64).acos();
        for (k, theta2) in [bend, -bend].into_iter().enumerate() {
            assert!((joint(&report, k, "theta2") - theta2).abs() < 1e-12);
            let sum: f64 = ["theta1", "theta2", "theta3"]
                .iter()
                .map(|j| joint(&report, k, j))
                .sum();
            assert!(turn(sum, PI / 6.0) < 1e-12);
            assert!(report.assemblies[k].certified);
        }
    }
}

/// With roll and pitch held the third row of the rotation is known up to its last two signs, so half of
/// all solutions are turned over.
#[test]
fn a_platform_is_asked_for_by_height_roll_and_pitch() {
    let platform = with("three_rps", &[]);
    let held = [
        ("top.z", "0.5"),
        ("top.roll", "3 deg"),
        ("top.pitch", "-4 deg"),
    ];
    let question = asked(&platform, &["actuated"], &held);
    let reports = [1, 2].map(|seed| answer(&question, seed));
    for report in &reports {
        assert!(report.real > 0);
        assert_eq!(report.complex + report.at_infinity, report.half_a_turn_away);
        let ends = report.complex + report.at_infinity + report.half_a_turn_away;
        assert_eq!(report.generic, ends);
        for k in 0..report.real {
            let [roll, pitch, _] = angles(report, k);
            assert!((roll - 3f64.to_radians()).abs() < 1e-10, "{roll}");
            assert!((pitch + 4f64.to_radians()).abs() < 1e-10, "{pitch}");
        }
    }
    assert_eq!(reports[0].real, reports[1].real);
}

const FLAT: [&str; 12] = [
    "a1z", "a2z", "a3z", "a4z", "a5z", "a6z", "b1z", "b2z", "b3z", "b4z", "b5z", "b6z",
];

/// A flat base and a flat platform: still 40, some of them a thousand lengths away.
#[test]
fn solutions_far_out_are_found_and_counted_for_every_seed() {
    let flat = with("stewart_gough_6sps", &FLAT.map(|name| (name, "0")));
    let question = asked(&flat, &[], &[("l1", "1.1"), ("l4", "0.95")]);
    for seed in 1..=3 {
        let report = answer(&question, seed);
        let counts = (
            report.generic,
            report.complex,
            report.at_infinity,
            report.singular,
        );
        assert_eq!(counts, (40, 38, 2, 0), "seed {seed}");
        // mirrored in the plane of the base
        assert_eq!(report.real, 8);
    }
}

/// Balls moved onto one another make another structure, whose bound is the one that applies.
#[test]
fn the_bound_is_that_of_the_dimensions_given() {
    let onto = [
        ("b2x", "b1x"),
        ("b2y", "b1y"),
        ("b2z", "b1z"),
        ("b4x", "b3x"),
        ("b4y", "b3y"),
        ("b4z", "b3z"),
        ("b6x", "b5x"),
        ("b6y", "b5y"),
        ("b6z", "b5z"),
    ];
    let general = with("stewart_gough_6sps", &[]);
    let value = |name: &str| {
        let parameter = general.parameters().iter().find(|p| *p.name == *name);
        format!("{}", parameter.unwrap().value)
    };
    let values: Vec<(&str, String)> = onto.iter().map(|(b, a)| (*b, value(a))).collect();
    let values: Vec<(&str, &str)> = values.iter().map(|(b, a)| (*b, a.as_str())).collect();
    let report = answer(&asked(&with("stewart_gough_6sps", &values), &[], &[]), 1);
    assert_eq!((report.generic, report.bound), (16, Some(16)));
}

fn followed(question: &Question, mode: usize) -> Followed {
    let settings = AssembliesSettings::default();
    let solver = AssemblySolver::new(
        question.mechanism(),
        &question.held(),
        &settings,
        &Watch::none(),
    )
    .unwrap();
    solver
        .follow(mode, &question.start(), &question.held(), &Watch::none())
        .unwrap()
}

/// The straight way from home to (2.5, 0) leaves the disc of radius 1.8 that the arm reaches.
#[test]
fn the_place_where_a_mode_ends_is_known_to_the_last_digits() {
    let arm = with("planar_2r", &[]);
    let question = asked(&arm, &["actuated"], &[("hand.x", "2.5"), ("hand.y", "0")]);
    let (x, y) = ((PI / 6.0).cos(), 1.3);
    let (dx, dy) = (2.5 - x, -y);
    let (a, b, c) = (dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - 3.24);
    let part = (-b + (b * b - a * c).sqrt()) / a;
    for mode in [1, 2] {
        let Err(LostReason::Ceases(fold)) = followed(&question, mode) else {
            panic!("mode {mode} ends");
        };
        assert!(
            (fold.fraction - part).abs() < 1e-13,
            "{} {part}",
            fold.fraction
        );
        let theta = |name: &str| *fold.joints.get(name).unwrap();
        let direction = (y + part * dy).atan2(x + part * dx);
        assert!((theta("theta1") - direction).abs() < 1e-12);
        assert!(theta("theta2").abs() < 1e-12, "{}", theta("theta2"));
    }
}

/// The rocker of the crank-rocker turns back where crank and coupler are in line:
/// (l1 + l2)² = l0² + l3² + 2 l0 l3 cos φ. A way that leads far beyond must not miss that, though the
/// Jacobian is singular all along φ₂ = 0 and does not see there that nothing closes.
#[test]
fn no_mode_goes_on_beyond_its_fold_through_what_does_not_close() {
    let linkage = with("four_bar", &[]);
    let fold_at = (-0.625f64).acos();
    for (mode, tenths) in [1, 2]
        .into_iter()
        .flat_map(|m| (1..22).map(move |k| (m, k)))
    {
        let asked_for = format!("{}", 0.1 * f64::from(tenths));
        let question = asked(&linkage, &["theta1"], &[("phi1", &asked_for)]);
        let Err(LostReason::Ceases(fold)) = followed(&question, mode) else {
            panic!("mode {mode} ends before {asked_for}");
        };
        let phi = *fold.inputs.get("phi1").unwrap();
        assert!(fold.turns_back, "mode {mode} to {asked_for}: {phi}");
        assert!((phi - fold_at).abs() < 1e-12, "mode {mode}: {phi}");
    }
    let question = asked(&linkage, &["theta1"], &[("phi1", "2.3")]);
    assert!(followed(&question, 1).is_ok());
}

/// Whatever roll and pitch are, the three planes of the legs leave the platform the yaw
/// atan2(sin p sin r, cos p + cos r) or half a turn more, and each leg may point either way.
#[test]
fn single_angles_near_the_pitch_of_a_right_angle_lose_no_assembly() {
    let platform = with("three_rps", &[]);
    for pitch in ["80 deg", "89.999 deg", "89.9997 deg", "89.9999 deg"] {
        let held = [("top.z", "0.4"), ("top.pitch", pitch), ("top.roll", "0.1")];
        let report = answer(&asked(&platform, &["actuated"], &held), 1);
        assert_eq!(report.assemblies.len(), 16, "{pitch}");
    }
}

#[test]
fn a_mode_that_is_double_at_home_is_not_followed_along_a_branch_of_its_own_choice() {
    let linkage = with("parallelogram", &[]);
    let away = followed(&asked(&linkage, &[], &[("theta1", "30 deg")]), 1);
    assert_eq!(away, Err(LostReason::MeetAtHome { multiplicity: 2 }));
    assert!(followed(&asked(&linkage, &[], &[]), 1).is_ok());
    // a mode by itself is followed
    let linkage = with("four_bar", &[]);
    let away = followed(&asked(&linkage, &[], &[("theta1", "30 deg")]), 1);
    assert!(away.is_ok());
}

/// The wrist's centre reaches √(d3² + (a2 + √(a3² + d4²))²) from the shoulder, and the wrist then turns
/// the hand as it should be.
#[test]
fn out_of_reach_the_closest_approach_keeps_no_gap_that_a_free_joint_closes() {
    let puma = with("puma560_modified", &[]);
    let question = asked(&puma, &["actuated"], &[("hand", "[Tx(40)]")]);
    let closest = answer(&question, 1).closest.unwrap();
    assert!(closest.local_minimum);
    let value = |name: &str| {
        let parameter = puma.parameters().iter().find(|p| *p.name == *name);
        parameter.unwrap().value
    };
    let arms = value("a2") + value("a3").hypot(value("d4"));
    let (_, gap) = &closest.gaps.0[0];
    assert!(
        (gap.distance - (40.0 - value("d3").hypot(arms))).abs() < 1e-6,
        "{gap:?}"
    );
    assert!(gap.angle < 1e-5, "{gap:?}");
}

/// Conjugate solutions have the same condition.
#[test]
fn complex_solutions_have_a_condition() {
    let mechanism = with("three_rps", &[]);
    let question = asked(&mechanism, &[], &[]);
    let settings = AssembliesSettings::default();
    let solver =
        AssemblySolver::new(&mechanism, &question.held(), &settings, &Watch::none()).unwrap();
    let wanted = Wanted {
        all_complex: true,
        ..Wanted::default()
    };
    let report = solver.at(&question.start(), wanted, &Watch::none());
    let conditions = report
        .complex_assemblies
        .iter()
        .map(|a| a.condition.unwrap());
    let mut conditions: Vec<f64> = conditions.collect();
    conditions.sort_by(f64::total_cmp);
    assert!(!conditions.is_empty() && conditions.len().is_multiple_of(2));
    for pair in conditions.chunks(2) {
        assert!(
            pair[0] >= 1.0 && (pair[1] - pair[0]).abs() < 1e-9 * pair[0],
            "{pair:?}"
        );
    }
}

/// Held level, the platform of a 3-RPS turns about x or about y. About y both legs beside it are equally long, which
/// they are not here: these solutions go to infinity, where a complex rotation grows without bound.
#[test]
fn solutions_that_a_held_angle_sends_to_infinity_are_decided_at_once() {
    let platform = with("three_rps", &[]);
    for (yaw, real, finite, infinite) in [("0 deg", 8, 32, 32), ("1 deg", 8, 64, 0)] {
        let report = answer(&asked(&platform, &["l1"], &[("top.yaw", yaw)]), 1);
        assert_eq!(report.real, real, "{yaw}");
        let ends = report.complex + report.half_a_turn_away;
        assert_eq!((ends, report.at_infinity), (finite, infinite), "{yaw}");
        assert_eq!(report.retried, 0, "{yaw}");
    }
}

/// With a narrow hand the solutions of free rods that turn it are thousands of lengths away, and poles on the way.
#[test]
fn solutions_that_pass_far_out_are_followed_to_where_they_end() {
    let delta = with("delta", &[]);
    for seed in [3, 53, 54] {
        let level = answer(&asked(&delta, &[], &[]), seed);
        let of = (level.generic, level.complex, level.at_infinity, level.real);
        assert_eq!(of, (40, 28, 12, 16), "seed {seed}");
        assert_eq!(level.conjugates, 0, "seed {seed}");
        // at angles that are not equal fewer are as far out
        let arms = [
            ("theta1", "10 deg"),
            ("theta2", "-5 deg"),
            ("theta3", "20 deg"),
        ];
        let askew = answer(&asked(&delta, &[], &arms), seed);
        assert_eq!(askew.complex + askew.at_infinity, 40, "seed {seed}");
        assert!(
            askew.at_infinity < 12 && askew.conjugates == 0,
            "seed {seed}"
        );
    }
}
