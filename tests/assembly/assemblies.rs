//! All assemblies against published counts and numbers, closed forms, and one another.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use linkwork::analysis::assemblies::{
    AssembliesError, AssembliesReport, AssembliesSettings, AssemblySolver, Fit, GenericSolutions,
    LostReason, Wanted,
};
use linkwork::description::Description;
use linkwork::geometry::{Pose, RollPitchYaw, Rotation, Vector3};
use linkwork::mechanism::Mechanism;
use linkwork::output::assemblies::completeness;
use linkwork::solve::Watch;
use linkwork::system::Question;
use serde_json::Value;

fn data(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(|x| x.as_f64().unwrap()).collect()
}

fn text_of(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    std::fs::read_to_string(path).unwrap()
}

fn read(text: &str) -> Mechanism {
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

fn mechanism(name: &str) -> Mechanism {
    read(&text_of(name))
}

/// A mechanism file with other values of some parameters.
fn with(name: &str, values: &[(&str, &str)]) -> Mechanism {
    let mut description = Description::read(&text_of(name)).unwrap();
    for (parameter, value) in values {
        description = description.with_parameter(parameter, value).unwrap();
    }
    Mechanism::new(&description).unwrap()
}

fn asked<'a>(mechanism: &'a Mechanism, free: &[&str], held: &[(&str, String)]) -> Question<'a> {
    let mut question = Question::new(mechanism);
    for name in free {
        question = question.free(name).unwrap();
    }
    for (name, value) in held {
        question = question.hold(name, value).unwrap();
    }
    question
}

fn solver(question: &Question, seed: u64) -> AssemblySolver {
    let settings = AssembliesSettings {
        seed,
        ..AssembliesSettings::default()
    };
    AssemblySolver::new(
        question.mechanism(),
        &question.held(),
        &settings,
        &Watch::none(),
    )
    .unwrap()
}

fn answer(question: &Question, seed: u64) -> AssembliesReport {
    let solver = solver(question, seed);
    solver.at_targets(
        &question.start(),
        &question.held(),
        Wanted::default(),
        &Watch::none(),
    )
}

/// The answer for the file's own inputs.
fn at_home(name: &str) -> AssembliesReport {
    answer(&Question::new(&mechanism(name)), 1)
}

fn joint(report: &AssembliesReport, mode: usize, name: &str) -> f64 {
    *report.assemblies[mode].joints.get(name).unwrap()
}

/// How far apart two angles are.
fn turn(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

/// Every printed row is one of those found, and nothing else is found.
fn same_lists(
    found: &[Vec<f64>],
    printed: &[Vec<f64>],
    apart: impl Fn(f64, f64) -> f64,
    digits: f64,
) {
    assert_eq!(found.len(), printed.len());
    let mut left: Vec<&Vec<f64>> = found.iter().collect();
    for row in printed {
        let far = |f: &Vec<f64>| {
            (f.iter().zip(row))
                .map(|(a, b)| apart(*a, *b))
                .fold(0.0, f64::max)
        };
        let best = (0..left.len())
            .min_by(|a, b| far(left[*a]).total_cmp(&far(left[*b])))
            .unwrap();
        assert!(
            far(left[best]) < digits,
            "{row:?}: nearest is off by {:.1e}",
            far(left[best])
        );
        left.swap_remove(best);
    }
}

fn plain(a: f64, b: f64) -> f64 {
    (a - b).abs()
}

/// What must hold for every answered question.
fn sound(report: &AssembliesReport) {
    assert_eq!(report.lost, 0);
    assert_eq!(report.real, report.assemblies.len());
    assert_eq!(
        report.complex + report.at_infinity,
        report.generic,
        "every path ends somewhere"
    );
    let modes: Vec<usize> = report.assemblies.iter().map(|a| a.mode).collect();
    assert_eq!(modes, (1..=report.real).collect::<Vec<_>>());
}

/// Generic numbers of complex solutions: 4-bar 2 (Freudenstein 1955), planar 3-RPR 6 (Gosselin,
/// Sefrioui and Richard 1992), 3-RPS 16 (Nanua, Waldron and Murthy 1990), general Stewart–Gough 40
/// (Ronga and Vust 1992), Watt and Stephenson six-bars 4 and 6 (Primrose, Freudenstein and Roth
/// 1967), spatial RSSR 2, 5-bar 2. Real numbers: `tests/data`.
#[test]
fn published_counts() {
    for (name, complex, real) in [
        ("four_bar", 2, 2),
        ("slider_crank", 2, 2),
        ("five_bar", 2, 2),
        ("rssr", 2, 2),
        ("spherical_four_bar", 2, 2),
        ("watt_six_bar", 4, 4),
        ("stephenson_six_bar", 6, 6),
        ("planar_3rpr", 6, 6),
        ("three_rps", 16, 8),
        ("three_fingered_hand", 16, 10),
        ("three_fingered_hand_distances", 16, 10),
        ("dietmaier", 40, 40),
        ("bennett", 1, 1),
        ("goldberg_5r", 1, 1),
    ] {
        let report = at_home(name);
        sound(&report);
        assert_eq!((report.complex, report.real), (complex, real), "{name}");
        assert!(report.assemblies.iter().all(|a| a.certified), "{name}");
    }
    let stewart = at_home("stewart_gough_6sps");
    sound(&stewart);
    assert_eq!((stewart.complex, stewart.bound), (40, Some(40)));
    assert!(
        completeness(&stewart)
            .contains("the 40 poses of a general platform on six rods lead to these")
    );
}

/// Structures are recognised by their axes and closures, not by their dimensions: the bounds are
/// those that [`published_counts`] names, for inverse kinematics Primrose 1986 and Pieper 1968.
#[test]
fn known_bounds_are_recognised_by_structure() {
    for (name, bound) in [
        ("four_bar", Some(2)),
        ("four_bar_cut2", Some(2)),
        ("slider_crank", Some(2)),
        ("five_bar", Some(2)),
        ("rssr", Some(2)),
        ("spherical_four_bar", Some(2)),
        ("watt_six_bar", Some(4)),
        ("stephenson_six_bar", Some(6)),
        ("planar_3rpr", Some(6)),
        ("three_rps", Some(16)),
        ("three_fingered_hand", Some(16)),
        ("three_fingered_hand_distances", Some(16)),
        ("dietmaier", Some(40)),
        ("delta", Some(40)),
        // overconstrained: no count of its equations bounds it
        ("sarrus", None),
        ("schatz", None),
    ] {
        let report = at_home(name);
        assert_eq!(report.bound, bound, "{name}");
        assert!(bound.is_none_or(|bound| report.generic <= bound), "{name}");
        assert_eq!(report.bound_source.is_some(), bound.is_some(), "{name}");
    }
    // a universal joint whose axes do not meet moves its leg on a torus, and the legs' points no
    // longer stand on spheres
    let apart = text_of("stewart_gough_6ups").replacen(
        "alpha: \"-90 deg\", theta",
        "alpha: \"-90 deg\", a: 0.1, theta",
        1,
    );
    let apart = read(&apart);
    let question = Question::new(&apart);
    let settings = AssembliesSettings {
        quiet_loops: 0,
        quiet_seeds: 0,
        ..AssembliesSettings::default()
    };
    let solver = AssemblySolver::new(&apart, &question.held(), &settings, &Watch::none()).unwrap();
    let one = Wanted {
        certificates: false,
        all_complex: false,
        starts: false,
        proof: None,
    };
    assert_eq!(
        solver.at(&question.start(), one, &Watch::none()).bound,
        None
    );
}

/// 40 poses, and every universal joint in two ways for each: 40·2⁶.
#[test]
fn legs_that_close_apart_are_combined() {
    let spheres = at_home("stewart_gough_6sps");
    let mechanism = mechanism("stewart_gough_6ups");
    let question = Question::new(&mechanism);
    let solver = solver(&question, 1);
    let report = solver.at(
        &question.start(),
        Wanted {
            certificates: false,
            all_complex: false,
            starts: false,
            proof: None,
        },
        &Watch::none(),
    );
    sound(&report);
    assert_eq!((report.complex, report.real), (2560, 64 * spheres.real));
    assert_eq!((report.paths, report.bound), (40, Some(2560)));
    for assembly in &report.assemblies {
        assert_eq!(assembly.shares_platform_pose_with.len(), 63);
        // u and v, or u + 180° and 180° − v
        let other = &report.assemblies[assembly.shares_platform_pose_with[0] - 1];
        for leg in 1..=6 {
            let both = [assembly, other];
            let [u, v] =
                ["u", "v"].map(|n| both.map(|a| *a.joints.get(&format!("{n}{leg}")).unwrap()));
            let same = turn(u[0], u[1]) < 1e-9 && turn(v[0], v[1]) < 1e-9;
            let flipped = turn(u[0], u[1] + PI) < 1e-9 && turn(v[0], PI - v[1]) < 1e-9;
            assert!(same || flipped, "{leg}: {u:?}, {v:?}");
        }
    }
    // from a store, elsewhere: the same platform poses as with legs that are distances
    let stored = GenericSolutions::from_text(&solver.generic().to_text()).unwrap();
    let stored = AssemblySolver::from_stored(&mechanism, &question.held(), stored).unwrap();
    let short = [("l1", "0.9".to_string()), ("l4", "1.1".to_string())];
    let there = asked(&mechanism, &[], &short);
    let report = stored.at(
        &there.start(),
        Wanted {
            certificates: false,
            all_complex: false,
            starts: false,
            proof: None,
        },
        &Watch::none(),
    );
    sound(&report);
    let other = answer(
        &asked(&self::mechanism("stewart_gough_6sps"), &[], &short),
        1,
    );
    assert_eq!(
        (report.complex, report.real),
        (64 * other.complex, 64 * other.real)
    );
}

/// No bound is known for these. Leg 1 is as long as its end is far from the base, ±, so counts are even.
#[test]
fn counts_without_a_known_bound_do_not_depend_on_the_seed() {
    without_a_bound(1..=3);
}

#[test]
#[ignore = "takes minutes"]
fn counts_without_a_known_bound_do_not_depend_on_many_seeds() {
    without_a_bound(1..=24);
    let delta = mechanism("delta");
    let hand = [("hand.x", "0.1"), ("hand.y", "0.05"), ("hand.z", "-1")];
    let hand = hand.map(|(n, x)| (n, x.to_string()));
    // three equations of degree 8 in the quaternion (Bézout)
    counts(&asked(&delta, &["actuated"], &hand), 512, 1..=20);
}

fn without_a_bound(seeds: std::ops::RangeInclusive<u64>) {
    for (name, held, count) in [
        ("three_rps", ("top.x", "0.01"), 64),
        ("stewart_gough_6sps", ("top.z", "0.9"), 80),
    ] {
        let mechanism = mechanism(name);
        let held = [(held.0, held.1.to_string())];
        counts(&asked(&mechanism, &["l1"], &held), count, seeds.clone());
    }
}

fn counts(question: &Question, count: usize, seeds: impl Iterator<Item = u64>) {
    for seed in seeds {
        let solver = solver(question, seed);
        let generic = solver.generic();
        assert_eq!(
            generic.count(),
            count,
            "{}, seed {seed}",
            question.mechanism().name()
        );
        assert!(!generic.search.exhausted && generic.search.quiet_loops > 0);
    }
}

#[test]
fn every_posture_of_dietmaiers_platform_is_found() {
    let report = at_home("dietmaier");
    let canonical = |pose: &[f64]| {
        let sign = pose[..4].iter().find(|x| x.abs() > 1e-9).unwrap().signum();
        let mut pose = pose.to_vec();
        pose[..4].iter_mut().for_each(|x| *x *= sign);
        pose
    };
    let found = report.assemblies.iter().map(|a| {
        let pose = a.platforms.get("top").unwrap();
        [&pose.quaternion[..], &pose.position[..]].concat()
    });
    let found: Vec<Vec<f64>> = found.collect();
    let printed: Vec<Vec<f64>> = list(&data("dietmaier")["postures"])
        .iter()
        .map(|p| canonical(&numbers(p)))
        .collect();
    same_lists(&found, &printed, plain, 1e-9);
}

#[test]
fn every_assembly_of_the_planar_3_rpr_is_found() {
    let report = at_home("planar_3rpr");
    let found = report.assemblies.iter().map(|a| {
        let pose = a.platforms.get("platform").unwrap();
        vec![pose.position[0], pose.position[1], pose.roll_pitch_yaw[2]]
    });
    let data = data("planar_3rpr");
    let printed: Vec<Vec<f64>> = list(&data["assemblies"]).iter().map(numbers).collect();
    same_lists(&found.collect::<Vec<_>>(), &printed, plain, 1e-10);
    // the reference's determinants split three to three
    let positive = report.assemblies.iter().filter(|a| a.determinant_sign > 0);
    assert_eq!(positive.count(), 3);
}

/// The two operation modes never exchange solutions: what spreads from one solution finds eight.
#[test]
fn both_operation_modes_of_the_3_rps_are_found() {
    let report = at_home("three_rps");
    let found = (0..report.real).map(|k| {
        ["phi1", "phi2", "phi3"]
            .map(|n| joint(&report, k, n))
            .to_vec()
    });
    let data = data("three_rps");
    let printed = list(&data["assemblies"]).iter().map(|a| {
        let theta = numbers(&a["theta"]);
        theta.iter().map(|t| PI / 2.0 - t).collect()
    });
    same_lists(
        &found.collect::<Vec<_>>(),
        &printed.collect::<Vec<_>>(),
        turn,
        1e-11,
    );
    assert_eq!(report.generic, 16);
}

#[test]
fn the_hand_is_found_with_and_without_an_object() {
    let data = data("three_fingered_hand");
    let printed = list(&data["assemblies"]).iter().map(|a| numbers(&a["phi"]));
    let printed: Vec<Vec<f64>> = printed.collect();
    for name in ["three_fingered_hand", "three_fingered_hand_distances"] {
        let report = at_home(name);
        let found = (0..report.real).map(|k| {
            ["phi1", "phi2", "phi3"]
                .map(|n| joint(&report, k, n))
                .to_vec()
        });
        same_lists(&found.collect::<Vec<_>>(), &printed, turn, 1e-10);
    }
}

#[test]
fn planar_linkages_agree_with_their_closed_forms() {
    let watt = mechanism("watt_six_bar");
    let solver_of_watt = solver(&Question::new(&watt), 1);
    for row in list(&data("watt_six_bar")["rows"]) {
        let question = asked(
            &watt,
            &[],
            &[("theta", format!("{} deg", row["theta_deg"]))],
        );
        let report = solver_of_watt.at(&question.start(), Wanted::default(), &Watch::none());
        sound(&report);
        let found =
            (0..report.real).map(|k| ["phi1", "phi2"].map(|n| joint(&report, k, n)).to_vec());
        let printed: Vec<Vec<f64>> = list(&row["phi1_phi2"]).iter().map(numbers).collect();
        same_lists(&found.collect::<Vec<_>>(), &printed, turn, 1e-12);
    }
    let report = at_home("stephenson_six_bar");
    let found: Vec<Vec<f64>> = (0..report.real)
        .map(|k| vec![joint(&report, k, "theta1")])
        .collect();
    let printed = numbers(&data("stephenson_six_bar")["theta1"]);
    let printed: Vec<Vec<f64>> = printed.into_iter().map(|x| vec![x]).collect();
    same_lists(&found, &printed, turn, 1e-11);
}

/// Freudenstein's quadratic gives two real crank positions, one double, or none.
#[test]
fn four_bars_agree_with_freudensteins_equation() {
    for case in list(&data("four_bar")["rows"]) {
        let lengths = ["l0", "l1", "l2", "l3"].map(|n| (n, case[n].to_string()));
        let lengths: Vec<(&str, &str)> = lengths.iter().map(|(n, v)| (*n, v.as_str())).collect();
        let mechanism = with("four_bar", &lengths);
        let question = asked(
            &mechanism,
            &[],
            &[("theta1", format!("{} deg", case["theta1_deg"]))],
        );
        let report = answer(&question, 1);
        assert_eq!(report.lost, 0, "{case}");
        let printed: Vec<Vec<f64>> = list(&case["phi2_phi1"]).iter().map(numbers).collect();
        if report.singular > 0 {
            continue;
        }
        // the file measures phi2 from the crank
        let found = (0..report.real).map(|k| vec![joint(&report, k, "phi1")]);
        let printed: Vec<Vec<f64>> = printed.iter().map(|row| vec![row[1]]).collect();
        same_lists(&found.collect::<Vec<_>>(), &printed, turn, 1e-11);
        assert_eq!(report.real > 0, report.closest.is_none());
    }
}

fn pose_text(pose: &Pose<f64>) -> String {
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    let [x, y, z] = pose.position.0;
    format!("[T({x:?}, {y:?}, {z:?}), Rz({yaw:?}), Ry({pitch:?}), Rx({roll:?})]")
}

/// The rotation and position of a printed 4×4 matrix.
fn matrix(value: &Value) -> Pose<f64> {
    let rows: Vec<Vec<f64>> = list(value).iter().map(numbers).collect();
    Pose {
        rotation: Rotation([0, 1, 2].map(|i| Vector3([rows[i][0], rows[i][1], rows[i][2]])))
            .transpose(),
        position: Vector3([0, 1, 2].map(|i| rows[i][3])),
    }
}

#[test]
fn inverse_kinematics_lists_all_eight_of_the_puma() {
    let data = data("puma560_corke");
    let mechanism = mechanism("puma560_corke");
    let pose = pose_text(&matrix(&data["forward"]["generic"]["T"]));
    let report = answer(&asked(&mechanism, &["actuated"], &[("hand", pose)]), 1);
    sound(&report);
    assert_eq!((report.complex, report.real), (8, 8));
    let names = ["theta1", "theta2", "theta3", "theta4", "theta5", "theta6"];
    let found = (0..8).map(|k| names.map(|n| joint(&report, k, n)).to_vec());
    let printed: Vec<Vec<f64>> = list(&data["inverse_of_generic"])
        .iter()
        .map(numbers)
        .collect();
    same_lists(&found.collect::<Vec<_>>(), &printed, turn, 1e-9);
}

/// A general 6R loop has 16 assemblies (Primrose 1986; Lee and Liang 1988), here all real (Manseur
/// and Doty 1989).
#[test]
fn a_closed_loop_of_six_revolute_joints_has_sixteen() {
    let loops = data("loops");
    let case = list(&loops["loops"])
        .iter()
        .find(|l| l["name"] == "Manseur and Doty 6R")
        .unwrap();
    let (mut joints, mut rows) = (String::new(), String::new());
    for (i, row) in list(&case["a_alpha_d"]).iter().enumerate() {
        let [a, alpha, d] = numbers(row)[..] else {
            panic!("three numbers")
        };
        joints += &format!("\"theta{i}\": Passive(),");
        rows += &format!("(a: {a:?}, alpha: {alpha:?}, d: {d:?}, theta: \"theta{i}\"),");
    }
    let loop_of_six = read(&format!(
        "Mechanism(version: 1, name: \"loop\", convention: Standard, joints: {{{joints}}},
        chains: {{\"links\": Chain(rows: [{rows}])}}, closures: {{\"c\": Rigid(\"links\", \"ground\")}})"
    ));
    let report = answer(&Question::new(&loop_of_six), 1);
    sound(&report);
    assert_eq!((report.complex, report.real), (16, 16));
    let found = report.assemblies.iter().map(|a| a.configuration().joints);
    let printed: Vec<Vec<f64>> = list(&case["assemblies"]).iter().map(numbers).collect();
    same_lists(&found.collect::<Vec<_>>(), &printed, turn, 1e-9);
}

/// Faugère and Lazard 1995: legs that meet by pairs on the platform leave 16 assemblies.
#[test]
fn a_6_3_platform_has_sixteen() {
    let points = [("b2", "b1"), ("b4", "b3"), ("b6", "b5")];
    let names: Vec<(String, String)> = (points.iter())
        .flat_map(|(to, from)| ["x", "y", "z"].map(|c| (format!("{to}{c}"), format!("{from}{c}"))))
        .collect();
    let values: Vec<(&str, &str)> = names
        .iter()
        .map(|(a, b)| (a.as_str(), b.as_str()))
        .collect();
    let report = answer(&Question::new(&with("stewart_gough_6sps", &values)), 1);
    sound(&report);
    assert_eq!(report.complex, 16);
}

/// Three spheres meet in two points: with a hand that keeps its orientation a delta has two.
#[test]
fn a_delta_has_two_assemblies_with_a_translating_hand_among_those_of_six_free_rods() {
    let delta = mechanism("delta");
    let solver = solver(&Question::new(&delta), 1);
    for row in list(&data("delta")["williams"]) {
        let theta = numbers(&row["theta_deg"]);
        let held = ["theta1", "theta2", "theta3"].iter().zip(theta);
        let held: Vec<(&str, String)> = held.map(|(n, t)| (*n, format!("{t} deg"))).collect();
        let report = solver.at(
            &asked(&delta, &[], &held).start(),
            Wanted::default(),
            &Watch::none(),
        );
        sound(&report);
        let hands = report
            .assemblies
            .iter()
            .map(|a| a.platforms.get("hand").unwrap());
        let translating = hands.filter(|hand| hand.quaternion[0].abs() > 1.0 - 1e-9);
        let found: Vec<Vec<f64>> = translating.map(|hand| hand.position.to_vec()).collect();
        let printed: Vec<Vec<f64>> = list(&row["positions"]).iter().map(numbers).collect();
        same_lists(&found, &printed, plain, 1e-9);
    }
}

/// The file's comment: 40 with six free rods, as six legs in general have, 2 of them translating.
#[test]
fn a_delta_of_six_free_rods_has_forty_solutions_and_two_that_translate() {
    let delta = mechanism("delta");
    let solver = solver(&Question::new(&delta), 1);
    assert_eq!(solver.generic().count(), 40);
    let at = |angles: [f64; 3]| {
        let held = ["theta1", "theta2", "theta3"].iter().zip(angles);
        let held: Vec<(&str, String)> = held.map(|(n, t)| (*n, format!("{t} deg"))).collect();
        let report = solver.at(
            &asked(&delta, &[], &held).start(),
            Wanted::default(),
            &Watch::none(),
        );
        sound(&report);
        let level = |a: &&linkwork::analysis::assemblies::Assembly| {
            let [w, ..] = a.platforms.get("hand").unwrap().quaternion;
            w.abs() > 1.0 - 1e-12
        };
        let translating = report.assemblies.iter().filter(level).count();
        (report.complex, report.at_infinity, translating)
    };
    assert_eq!(at([33.0, -12.0, 61.0]), (40, 0, 2));
    assert_eq!(at([20.0, 20.0, 20.0]), (28, 12, 2));
}

#[test]
fn a_bennett_linkage_with_a_wrong_ratio_has_no_assembly() {
    let broken = with("bennett", &[("b", "1.05*a*sin(beta)/sin(alpha)")]);
    let report = answer(&Question::new(&broken), 1);
    assert_eq!((report.real, report.complex), (0, 0));
    let closest = report.closest.expect("a closest approach");
    assert!(closest.gaps.0[0].1.distance > 1e-3 || closest.gaps.0[0].1.angle > 1e-3);
}

/// The 4-bar file cut at each of its four joints.
#[test]
fn another_cut_gives_the_same_assemblies() {
    let reference = at_home("four_bar");
    let crank = |report: &AssembliesReport| -> BTreeSet<i64> {
        (0..report.real)
            .map(|k| (joint(report, k, "phi1") * 1e9).round() as i64)
            .collect()
    };
    for name in ["four_bar_cut2", "four_bar_cut4"] {
        let mechanism = mechanism(name);
        if mechanism.joint("phi1").is_none() {
            continue;
        }
        assert_eq!(crank(&at_home(name)), crank(&reference), "{name}");
    }
}

/// With l1 = 2, l0 = 4, l2 = l3 = 3 the coupler and the rocker are stretched where the crank makes
/// cos θ = (l0² + l1² − (l2 + l3)²)/(2 l0 l1) = −1: both assemblies are one.
#[test]
fn a_dead_point_is_one_double_assembly() {
    let lengths = [("l0", "4"), ("l1", "2"), ("l2", "2"), ("l3", "3")];
    let mechanism = with("four_bar", &lengths);
    // cos θ = (16 + 4 − 25)/16
    let question = asked(&mechanism, &[], &[("theta1", "acos(-5/16)".into())]);
    let report = answer(&question, 1);
    assert_eq!(
        (report.complex, report.real, report.singular, report.lost),
        (2, 1, 1, 0)
    );
    let double = &report.assemblies[0];
    assert_eq!((double.multiplicity, double.determinant_sign), (2, 0));
    assert!(!double.certified && double.uncertified_because.is_some());
    // a little before there are two, a little beyond none
    let at = |value: &str| answer(&asked(&mechanism, &[], &[("theta1", value.into())]), 1);
    let before = at("acos(-5/16) - 1e-4");
    assert_eq!((before.real, before.singular, before.lost), (2, 0, 0));
    let beyond = at("acos(-5/16) + 1e-4");
    assert_eq!((beyond.real, beyond.complex, beyond.lost), (0, 2, 0));
    assert!(beyond.closest.is_some());
}

#[test]
fn a_mode_is_followed_to_the_fold_where_it_ends() {
    let lengths = [("l0", "4"), ("l1", "2"), ("l2", "2"), ("l3", "3")];
    let mechanism = with("four_bar", &lengths);
    let question = asked(&mechanism, &[], &[("theta1", "150 deg".into())]);
    let solver = solver(&question, 1);
    for mode in [1, 2] {
        match solver
            .follow(mode, &question.start(), &question.held(), &Watch::none())
            .unwrap()
        {
            Err(LostReason::Ceases(fold) | LostReason::MeetsOthers(fold)) => {
                let fold = fold.inputs.get("theta1").unwrap();
                assert!((fold - f64::acos(-5.0 / 16.0)).abs() < 1e-13, "{fold}");
            }
            other => panic!("no assembly there, but {other:?}"),
        }
    }
    let near = asked(&mechanism, &[], &[("theta1", "100 deg".into())]);
    let there = solver.at(&near.start(), Wanted::default(), &Watch::none());
    for mode in [1, 2] {
        let Ok(at) = solver
            .follow(mode, &near.start(), &near.held(), &Watch::none())
            .unwrap()
        else {
            panic!("there are assemblies at 100 deg");
        };
        let rocker = at.joints[mechanism.joint("phi1").unwrap()];
        assert!((0..2).any(|k| turn(joint(&there, k, "phi1"), rocker) < 1e-9));
    }
    assert_eq!(
        solver
            .follow(3, &near.start(), &near.held(), &Watch::none())
            .unwrap_err(),
        AssembliesError::NoSuchMode(2)
    );
}

#[test]
fn freedom_left_is_counted_and_sampled() {
    for (name, free, freedom) in [
        ("four_bar", &["theta1"][..], 1),
        ("bennett", &["theta1"][..], 1),
        ("three_rps", &["l1", "l2"][..], 2),
        ("stewart_gough_6sps", &["actuated"][..], 6),
    ] {
        let mechanism = mechanism(name);
        let report = answer(&asked(&mechanism, free, &[]), 1);
        assert_eq!(report.fit, Fit::FreedomLeft(freedom), "{name}");
        assert!(report.real > 1, "{name}: no samples");
        assert!(report.assemblies.iter().all(|a| !a.certified));
    }
}

/// Closed loops that move although Kutzbach's count forbids it, with no joint held.
#[test]
fn overconstrained_loops_have_one_freedom_left() {
    for case in list(&data("loops")["loops"]) {
        if case["mobility"].as_f64() != Some(1.0) {
            continue;
        }
        let degrees = case["alpha_unit"] == "deg";
        let (mut joints, mut rows) = (String::new(), String::new());
        for (i, row) in list(&case["a_alpha_d"]).iter().enumerate() {
            let [a, alpha, d] = numbers(row)[..] else {
                panic!("three numbers")
            };
            let alpha = if degrees { alpha.to_radians() } else { alpha };
            joints += &format!("\"theta{i}\": Passive(),");
            rows += &format!("(a: {a:?}, alpha: {alpha:?}, d: {d:?}, theta: \"theta{i}\"),");
        }
        // as numbers the relations between the dimensions would be lost; only inputs vary
        let text = format!(
            "Mechanism(version: 1, name: \"loop\", convention: Standard, joints: {{{joints}}},
            chains: {{\"links\": Chain(rows: [{rows}])}}, closures: {{\"c\": Rigid(\"links\", \"ground\")}})"
        );
        let report = answer(&Question::new(&read(&text)), 1);
        assert_eq!(report.fit, Fit::FreedomLeft(1), "{}", case["name"]);
    }
}

#[test]
fn inputs_out_of_reach_have_no_real_assembly_and_a_closest_approach() {
    let mechanism = mechanism("three_rps");
    let report = answer(&asked(&mechanism, &[], &[("l1", "3".into())]), 1);
    sound(&report);
    assert_eq!((report.real, report.complex), (0, 16));
    let closest = report.closest.unwrap();
    assert!(closest.gaps.0.iter().all(|(_, gap)| gap.distance > 0.01));
    assert_eq!(closest.worst, "S1");
}

/// A box proved to hold one solution cannot hold another.
#[test]
fn boxes_of_different_assemblies_are_disjoint() {
    for name in ["three_rps", "planar_3rpr", "dietmaier", "watt_six_bar"] {
        let mechanism = mechanism(name);
        let report = at_home(name);
        let length = mechanism.characteristic_length();
        let scales = &mechanism.dimensions().joint_scales;
        for (i, a) in report.assemblies.iter().enumerate() {
            for b in &report.assemblies[i + 1..] {
                let joints = a.joints.0.iter().zip(&b.joints.0).take(scales.len());
                let joints = joints.enumerate();
                let joints =
                    joints.map(|(j, (x, y))| match mechanism.joints()[j].kind.is_angle() {
                        true => turn(x.1, y.1),
                        false => (x.1 - y.1).abs() / scales[j],
                    });
                let poses = a.platforms.0.iter().zip(&b.platforms.0).flat_map(|(x, y)| {
                    let (p, q) = (x.1.position, y.1.position);
                    let (u, v) = (x.1.quaternion, y.1.quaternion);
                    let dot: f64 = (0..4).map(|i| u[i] * v[i]).sum();
                    // the angle between the orientations
                    let angle = 2.0 * dot.abs().min(1.0).acos();
                    [0, 1, 2]
                        .map(|i| (p[i] - q[i]).abs() / length)
                        .into_iter()
                        .chain([angle])
                });
                let apart = joints.chain(poses).fold(0.0, f64::max);
                let radii = a.radius.unwrap() + b.radius.unwrap();
                assert!(apart > radii, "{name}: {} and {}", a.mode, b.mode);
            }
        }
    }
}

#[test]
fn stored_solutions_answer_as_new_ones_do() {
    let mechanism = mechanism("three_rps");
    let question = asked(&mechanism, &[], &[("l1", "0.7".into())]);
    let fresh = solver(&question, 5);
    let text = fresh.generic().to_text();
    let stored = GenericSolutions::from_text(&text).unwrap();
    assert_eq!(&stored, fresh.generic());
    let loaded = AssemblySolver::from_stored(&mechanism, &question.held(), stored.clone()).unwrap();
    let start = question.start();
    assert_eq!(
        loaded.at(&start, Wanted::default(), &Watch::none()),
        fresh.at(&start, Wanted::default(), &Watch::none())
    );
    // other dimensions, another split and other files are refused
    let refused = |mechanism: &Mechanism, question: &Question| {
        let solver = AssemblySolver::from_stored(mechanism, &question.held(), stored.clone());
        assert_eq!(
            solver.unwrap_err(),
            AssembliesError::StoredForAnotherQuestion
        );
    };
    let wider = with("three_rps", &[("b", "1.1")]);
    refused(&wider, &Question::new(&wider));
    refused(
        &mechanism,
        &asked(&mechanism, &["l1"], &[("phi1", "1".into())]),
    );
    assert!(GenericSolutions::from_text("(solutions: [])").is_err());
    assert!(GenericSolutions::from_text(&text[..text.len() / 2]).is_err());
}

/// Work is counted in steps, which do not depend on the machine.
#[test]
fn a_stored_platform_is_answered_in_few_steps() {
    let mechanism = mechanism("stewart_gough_6sps");
    let question = Question::new(&mechanism);
    let solver = solver(&question, 1);
    let held = ["l1", "l2", "l3", "l4", "l5", "l6"].iter().enumerate();
    let held: Vec<(&str, String)> = held
        .map(|(i, n)| (*n, format!("{}", 1.0 + 0.02 * i as f64)))
        .collect();
    let report = solver.at(
        &asked(&mechanism, &[], &held).start(),
        Wanted::default(),
        &Watch::none(),
    );
    sound(&report);
    assert_eq!(report.complex, 40);
    assert!(report.steps < 40 * 20, "{} steps", report.steps);
}

#[test]
fn whole_turns_of_an_input_change_nothing() {
    let mechanism = mechanism("four_bar");
    let list = |turns: f64| {
        let held = Question::new(&mechanism).held();
        let solver = AssemblySolver::new(
            &mechanism,
            &held,
            &AssembliesSettings::default(),
            &Watch::none(),
        )
        .unwrap();
        let mut asked = mechanism.home();
        asked.joints[mechanism.joint("theta1").unwrap()] = 1.0 + turns * std::f64::consts::TAU;
        solver.at(&asked, Wanted::default(), &Watch::none())
    };
    let (near, far) = (list(0.0), list(200.0));
    assert_eq!((near.real, far.real, far.lost), (2, 2, 0));
    for (a, b) in near.assemblies.iter().zip(&far.assemblies) {
        let (a, b) = (a.joints.get("phi1").unwrap(), b.joints.get("phi1").unwrap());
        assert!((a - b).abs() < 1e-9);
    }
}

#[test]
fn assemblies_that_are_not_isolated_are_not_denied() {
    // a wrist stretched out turns about one line with two joints
    let wrist = mechanism("spherical_wrist");
    let question = ["hand.roll", "hand.pitch", "hand.yaw"].iter().fold(
        Question::new(&wrist).free("actuated").unwrap(),
        |question, angle| question.hold(angle, "0").unwrap(),
    );
    let solver = AssemblySolver::new(
        &wrist,
        &question.held(),
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    let report = solver.at_targets(
        &question.start(),
        &question.held(),
        Wanted::default(),
        &Watch::none(),
    );
    // samples of them are listed, none as a solution by itself
    assert_eq!(report.continua.len(), 1);
    assert_eq!(report.continua[0].dimension, 1);
    assert!(report.real > 0 && report.assemblies.iter().all(|a| a.multiplicity == 0));
    // and a real gap is one
    let platform = mechanism("three_rps");
    let question = Question::new(&platform).hold("l1", "3").unwrap();
    let solver = AssemblySolver::new(
        &platform,
        &question.held(),
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    let report = solver.at(&question.start(), Wanted::default(), &Watch::none());
    let gaps = report.closest.unwrap().gaps;
    assert!(gaps.0.iter().any(|(_, gap)| gap.distance > 0.1), "{gaps:?}");
}

/// Limits that reach beyond half a turn, as those of PUMA robots do: joints are given by the turn
/// that their limits mean, and those that no turn brings within them are named.
#[test]
fn joint_values_are_given_by_the_turn_that_is_within_limits() {
    use linkwork::system::Gap;
    let (mut turned, mut named) = (0, 0);
    for name in ["puma560_modified", "puma560_standard", "puma560_corke"] {
        let mechanism = mechanism(name);
        let question = asked(&mechanism, &["actuated"], &[("hand", "home".into())]);
        let report = answer(&question, 1);
        assert_eq!(report.real, 8, "{name}");
        for assembly in &report.assemblies {
            let at = assembly.configuration();
            let gaps = Gap::of(&mechanism, &at);
            assert!(gaps.iter().all(|gap| gap.distance < 1e-9), "{name}");
            for ((joint, value), declared) in assembly.joints.0.iter().zip(mechanism.joints()) {
                let Some((low, high)) = declared.limits else {
                    continue;
                };
                let within = |value: f64| value >= low - 1e-9 && value <= high + 1e-9;
                let outside = assembly.outside_limits.contains(joint);
                assert_eq!(within(*value), !outside, "{name} {joint} {value}");
                if outside {
                    let turns = [-TAU, 0.0, TAU].map(|turn| within(value + turn));
                    assert_eq!(turns, [false; 3], "{name} {joint} {value}");
                    named += 1;
                }
                turned += usize::from(value.abs() > PI);
            }
            assert_eq!(
                assembly.within_limits,
                assembly.outside_limits.is_empty(),
                "{name}"
            );
        }
    }
    assert!(turned > 0, "some value needs a turn");
    assert!(named > 0, "some mode is outside limits");
}

/// A mode that is followed comes by the same turns as it is listed.
#[test]
fn a_mode_that_is_followed_has_the_turns_of_the_list() {
    let mechanism = mechanism("puma560_modified");
    let question = asked(&mechanism, &["actuated"], &[("hand", "home".into())]);
    let solver = solver(&question, 1);
    let (start, held) = (question.start(), question.held());
    let report = solver.at_targets(&start, &held, Wanted::default(), &Watch::none());
    for assembly in report.assemblies.iter().filter(|a| a.multiplicity == 1) {
        let followed = solver
            .follow(assembly.mode, &start, &held, &Watch::none())
            .unwrap();
        let Ok(at) = followed else {
            panic!("home is where it starts");
        };
        for (value, (name, listed)) in at.joints.iter().zip(&assembly.joints.0) {
            assert!((value - listed).abs() < 1e-9, "{name}: {value} {listed}");
        }
    }
}
