//! Lists of assemblies against closed forms and printed lists, case by case; `tests/data` says where
//! each comes from. More are in `assemblies.rs`, those of random mechanisms in `witness.rs`.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Fit, Wanted,
};
use linkwork::description::Description;
use linkwork::geometry::{Pose, RollPitchYaw, Rotation, Vector3};
use linkwork::mechanism::Mechanism;
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

fn read(text: &str) -> Mechanism {
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

/// A mechanism file with other values of some parameters.
fn with(name: &str, values: &[(&str, String)]) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let mut description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    for (parameter, value) in values {
        description = description.with_parameter(parameter, value).unwrap();
    }
    Mechanism::new(&description).unwrap()
}

fn answer(mechanism: &Mechanism, free: &[&str], held: &[(&str, String)]) -> AssembliesReport {
    let mut question = Question::new(mechanism);
    for name in free {
        question = question.free(name).unwrap();
    }
    for (name, value) in held {
        question = question.hold(name, value).unwrap();
    }
    let held = question.held();
    let solver = AssemblySolver::new(
        mechanism,
        &held,
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    let report = solver.at_targets(&question.start(), &held, Wanted::default(), &Watch::none());
    assert_eq!(report.lost, 0);
    report
}

fn joints(report: &AssembliesReport, names: &[&str]) -> Vec<Vec<f64>> {
    let assemblies = report.assemblies.iter();
    let values = assemblies.map(|a| names.iter().map(|n| *a.joints.get(n).unwrap()).collect());
    values.collect()
}

fn turn(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

fn plain(a: f64, b: f64) -> f64 {
    (a - b).abs()
}

/// Every printed row is found to its digits, and nothing else.
#[track_caller]
fn same_lists(found: &[Vec<f64>], printed: &[Vec<f64>], apart: fn(f64, f64) -> f64, digits: f64) {
    assert_eq!(found.len(), printed.len(), "{found:?}\n{printed:?}");
    let mut left: Vec<&Vec<f64>> = found.iter().collect();
    for row in printed {
        let far = |f: &Vec<f64>| {
            f.iter()
                .zip(row)
                .map(|(a, b)| apart(*a, *b))
                .fold(0.0, f64::max)
        };
        let order = |a: &usize, b: &usize| far(left[*a]).total_cmp(&far(left[*b]));
        let best = (0..left.len()).min_by(order).unwrap();
        assert!(
            far(left[best]) < digits,
            "{row:?}: nearest is {:?}",
            left[best]
        );
        left.swap_remove(best);
    }
}

/// s = r cos θ ± √(l² − (r sin θ − e)²), where both are real and apart.
#[test]
fn slider_cranks_have_both_ends_of_the_chord() {
    let mut compared = 0;
    for row in list(&data("slider_crank")["rows"]) {
        let sizes = ["r", "l", "e"].map(|name| (name, row[name].to_string()));
        let mechanism = with("slider_crank", &sizes);
        let report = answer(
            &mechanism,
            &[],
            &[("theta", format!("{} deg", row["theta_deg"]))],
        );
        assert_eq!(report.complex, 2, "{row}");
        let mut printed: Vec<Vec<f64>> = numbers(&row["s"]).into_iter().map(|s| vec![s]).collect();
        printed.sort_by(|a, b| a[0].total_cmp(&b[0]));
        if printed.len() == 2 && printed[1][0] - printed[0][0] < 1e-9 {
            // both ends in one: so many digits as a double root has
            assert_eq!((report.real, report.singular), (1, 1), "{row}");
            same_lists(&joints(&report, &["s"]), &printed[..1], plain, 1e-7);
        } else {
            assert_eq!(report.singular, 0, "{row}");
            same_lists(&joints(&report, &["s"]), &printed, plain, 1e-13);
            compared += 1;
        }
    }
    assert!(compared > 10);
}

#[test]
fn five_bars_have_both_points_of_two_circles() {
    let mechanism = with("five_bar", &[]);
    for row in list(&data("five_bar")["rows"]) {
        let [first, second] = [0, 1].map(|i| row["theta_deg"][i].as_f64().unwrap());
        let held = [
            ("theta1", format!("{first} deg")),
            ("theta2", format!("{second} deg")),
        ];
        let report = answer(&mechanism, &[], &held);
        assert_eq!((report.complex, report.singular), (2, 0), "{row}");
        let point = |row: &Vec<f64>| {
            let (theta, forearm) = (first.to_radians(), first.to_radians() + row[0]);
            vec![
                0.3 * theta.cos() + 0.4 * forearm.cos(),
                0.3 * theta.sin() + 0.4 * forearm.sin(),
            ]
        };
        let found: Vec<Vec<f64>> = joints(&report, &["psi1"]).iter().map(point).collect();
        let printed: Vec<Vec<f64>> = list(&row["P"]).iter().map(numbers).collect();
        same_lists(&found, &printed, plain, 1e-13);
    }
}

/// tan θ₂ = cos β tan θ₁ leaves θ₂ and θ₂ + 180°: the pin the other way round.
#[test]
fn universal_joints_have_both_ends_of_the_pin() {
    for row in list(&data("spherical_four_bar")["rows"]) {
        let [beta, theta1, theta2] = numbers(row)[..] else {
            panic!("three numbers")
        };
        let mechanism = with("spherical_four_bar", &[("beta", format!("{beta} deg"))]);
        let report = answer(&mechanism, &[], &[("theta1", format!("{theta1} deg"))]);
        assert_eq!((report.complex, report.singular), (2, 0), "{row}");
        let theta2 = theta2.to_radians();
        let printed = [vec![theta2], vec![theta2 + PI]];
        same_lists(&joints(&report, &["theta2"]), &printed, turn, 1e-13);
    }
}

/// Three spheres about the elbows meet in two points; the other assemblies of the six rods turn the
/// hand.
#[test]
fn the_delta_of_the_tutorial_has_two_assemblies_with_a_translating_hand() {
    let sizes = [
        ("sB", "0.4573"),
        ("sP", "0.115"),
        ("L", "0.112"),
        ("l", "0.232"),
        // the tutorial measures to the sides of the hand's triangle
        ("uP", "sqrt(3)/6*sP"),
    ];
    let delta = with(
        "delta",
        &sizes.map(|(name, value)| (name, value.to_owned())),
    );
    let question = Question::new(&delta);
    let held = question.held();
    let solver = AssemblySolver::new(
        &delta,
        &held,
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    for row in list(&data("delta")["zavatsky"]) {
        let mut asked = delta.home();
        for (name, theta) in ["theta1", "theta2", "theta3"]
            .iter()
            .zip(numbers(&row["theta_deg"]))
        {
            asked.joints[delta.joint(name).unwrap()] = theta.to_radians();
        }
        let report = solver.at(&asked, Wanted::default(), &Watch::none());
        assert_eq!(report.lost, 0);
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

/// Loops that move although Kutzbach's count forbids it, with the first angle held.
#[test]
fn overconstrained_loops_have_their_printed_assemblies() {
    let mut compared = 0;
    for case in list(&data("loops")["loops"]) {
        if case["mobility"].as_f64() != Some(1.0) {
            continue;
        }
        let name = &case["name"];
        let degrees = case["alpha_unit"] == "deg";
        let printed: Vec<Vec<f64>> = list(&case["assemblies"]).iter().map(numbers).collect();
        let mut joints = format!("\"theta0\": Actuated(home: {:?}),", printed[0][0]);
        let mut rows = String::new();
        for (i, row) in list(&case["a_alpha_d"]).iter().enumerate() {
            let [a, alpha, d] = numbers(row)[..] else {
                panic!("three numbers")
            };
            let unit = if degrees { " deg" } else { "" };
            if i > 0 {
                joints += &format!("\"theta{i}\": Passive(),");
            }
            rows +=
                &format!("(a: {a:?}, alpha: \"{alpha:?}{unit}\", d: {d:?}, theta: \"theta{i}\"),");
        }
        let mechanism = read(&format!(
            "Mechanism(version: 1, name: \"loop\", convention: Standard, joints: {{{joints}}},
            chains: {{\"links\": Chain(rows: [{rows}])}}, closures: {{\"c\": Rigid(\"links\", \"ground\")}})"
        ));
        let report = answer(&mechanism, &[], &[]);
        assert_eq!(
            (report.fit.clone(), report.singular),
            (Fit::Finite, 0),
            "{name}"
        );
        let found: Vec<Vec<f64>> = (report.assemblies.iter())
            .map(|a| a.configuration().joints)
            .collect();
        same_lists(&found, &printed, turn, 1e-9);
        compared += 1;
    }
    assert_eq!(compared, 9);
}

fn pose_text(matrix: &Value) -> String {
    let rows: Vec<Vec<f64>> = list(matrix).iter().map(numbers).collect();
    let pose = Pose {
        rotation: Rotation([0, 1, 2].map(|i| Vector3([rows[i][0], rows[i][1], rows[i][2]])))
            .transpose(),
        position: Vector3([0, 1, 2].map(|i| rows[i][3])),
    };
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    let [x, y, z] = pose.position.0;
    format!("[T({x:?}, {y:?}, {z:?}), Rz({yaw:?}), Ry({pitch:?}), Rx({roll:?})]")
}

const SIX: [&str; 6] = ["theta1", "theta2", "theta3", "theta4", "theta5", "theta6"];

#[test]
fn an_elbow_manipulator_has_its_printed_inverse() {
    let data = data("elbow_manipulator");
    let mechanism = with("elbow_manipulator", &[]);
    let pose = pose_text(&data["forward"]["g2"]["T"]);
    let report = answer(&mechanism, &["actuated"], &[("hand", pose)]);
    let printed: Vec<Vec<f64>> = list(&data["inverse_of_g2"]).iter().map(numbers).collect();
    same_lists(&joints(&report, &SIX), &printed, turn, 1e-9);
}

/// The elbow mirrored in the line from the shoulder to the wrist.
#[test]
fn a_planar_arm_has_both_elbows() {
    let data = data("planar_3r");
    let mechanism = with(
        "planar_3r",
        &[
            ("l1", "1".into()),
            ("l2", "0.8".into()),
            ("l3", "0.5".into()),
        ],
    );
    let report = answer(
        &mechanism,
        &["actuated"],
        &[("tool", pose_text(&data["T"]))],
    );
    let [q1, q2, q3] = numbers(&data["q"])[..] else {
        panic!("three numbers")
    };
    let other = q1 + 2.0 * f64::atan2(0.8 * q2.sin(), 1.0 + 0.8 * q2.cos());
    let printed = [
        vec![q1, q2, q3],
        vec![other, -q2, q1 + q2 + q3 - other + q2],
    ];
    same_lists(&joints(&report, &SIX[..3]), &printed, turn, 1e-9);
}

/// P. Wenger 2007: an orthogonal 3R arm reaches a point in four ways.
#[test]
fn a_cuspidal_arm_has_its_four_printed_postures() {
    let mechanism = read(
        r#"Mechanism(version: 1, name: "cuspidal 3R", convention: Modified,
            parameters: { "d2": 1, "d3": 2, "d4": 1.5, "r2": 1, "x": 2.5, "y": 0, "z": 0.6 },
            joints: { "q1": Passive(), "q2": Passive(), "q3": Passive() },
            chains: {
                "arm": Chain(rows: [(theta: "q1"), (alpha: "-90 deg", a: "d2", d: "r2", theta: "q2"),
                    (alpha: "90 deg", a: "d3", theta: "q3")], tip: [Tx("d4")]),
                "point": Chain(base: [T("x", "y", "z")]) },
            closures: { "tip": Spherical("arm", "point") })"#,
    );
    let report = answer(&mechanism, &[], &[]);
    assert_eq!((report.complex, report.real), (4, 4));
    // recomputed by a multistart in the angles; the paper prints them to 0.01°
    let printed = [
        [-50.922943069758695, -46.1734875441166, 141.15874405415823],
        [-164.5639358404996, -170.02026257006213, -12.888932784190605],
        [-101.5158729910554, -158.18671033985882, 104.88372974811358],
        [10.132854255469677, -22.32677393237057, -106.28364337223714],
    ];
    let printed = printed.map(|row| row.map(f64::to_radians).to_vec());
    same_lists(&joints(&report, &["q1", "q2", "q3"]), &printed, turn, 1e-11);
    // the signs of the determinant split them two and two
    let positive = report.assemblies.iter().filter(|a| a.determinant_sign > 0);
    assert_eq!(positive.count(), 2);
}

/// Drake's `four_bar.sdf` starts in one of its two assemblies: links 4, 4, 4 on a ground of 2.
#[test]
fn drakes_four_bar_has_its_own_assembly_and_the_folded_one() {
    let sizes = [("l0", "2"), ("l1", "4"), ("l2", "4"), ("l3", "4")];
    let mechanism = with(
        "four_bar",
        &sizes.map(|(name, value)| (name, value.to_owned())),
    );
    let crank = 15.0_f64.sqrt().atan();
    let report = answer(
        &mechanism,
        &[],
        &[("theta1", "180 deg - atan(sqrt(15))".into())],
    );
    assert_eq!(report.complex, 2);
    // Drake's ground points the other way: its q_WC is 180° less this angle
    let printed = [vec![crank], vec![PI]];
    same_lists(&joints(&report, &["phi1"]), &printed, turn, 1e-12);
}
