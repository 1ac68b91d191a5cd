//! Published and independently recomputed numbers. Each file in `tests/data` says where its numbers
//! come from and how they were verified; tolerances are their printed digits.

use std::path::Path;

use linkwork::analysis::assembly::{AssemblySettings, assemble};
use linkwork::description::{Description, Entry};
use linkwork::geometry::{Pose, Quaternion, RollPitchYaw, Rotation, Vector3};
use linkwork::mechanism::{Configuration, Mechanism, PlatformPose, Role};
use linkwork::solve::Watch;
use linkwork::solve::{Equations, Newton, Stop};
use linkwork::system::{Freedoms, Held, HeldPlatform, Question, System};
use serde_json::Value;

/// Numbers printed with 15 digits or computed by another program.
const DIGITS: f64 = 1e-12;

fn data(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

fn triple(value: &Value) -> [f64; 3] {
    numbers(value).try_into().unwrap()
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

fn mechanism(name: &str) -> Mechanism {
    with_parameters(name, &[])
}

/// A mechanism file with other values of some parameters.
fn with_parameters(name: &str, values: &[(&str, f64)]) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let mut description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    for (name, value) in values {
        let mut parameters = description.parameters.iter_mut();
        let parameter = parameters.find(|p| p.name.value == *name).expect(name);
        parameter.value = Entry::number(*value, 0..0);
    }
    Mechanism::new(&description).unwrap()
}

/// The home configuration with some joints elsewhere.
fn joints_at(mechanism: &Mechanism, values: &[(&str, f64)]) -> Configuration<f64> {
    let mut at = mechanism.home();
    for (name, value) in values {
        at.joints[mechanism.joint(name).expect(name)] = *value;
    }
    at
}

/// The configuration with joints at the given values in the order of the file.
fn all_joints_at(mechanism: &Mechanism, values: &[f64]) -> Configuration<f64> {
    let mut at = mechanism.home();
    at.joints.copy_from_slice(values);
    at
}

/// The equations with the actuated joints held.
fn direct(mechanism: &Mechanism) -> System<f64> {
    let joints = mechanism.joints().iter();
    let held = Held {
        joints: joints.map(|joint| joint.role == Role::Actuated).collect(),
        platforms: vec![HeldPlatform::Free; mechanism.platforms().len()],
    };
    System::new(mechanism.dimensions(), &held)
}

/// The equations with the platforms held and all joints free.
fn inverse(mechanism: &Mechanism) -> System<f64> {
    let held = Held {
        joints: vec![false; mechanism.joints().len()],
        platforms: vec![HeldPlatform::Pose; mechanism.platforms().len()],
    };
    System::new(mechanism.dimensions(), &held)
}

/// The solution from a guess, or `None` if there is none near it.
fn solve(system: &System<f64>, guess: &Configuration<f64>) -> Option<Configuration<f64>> {
    let (mut at, mut trial, mut work) = (guess.clone(), guess.clone(), system.work());
    let report = Newton::default().solve(system, &mut at, &mut trial, &mut work);
    if report.stop != Stop::Solved {
        return None;
    }
    assert!(report.size.largest <= 1e-12);
    Some(at)
}

/// The printed configuration is a solution to its digits, and is found again from beside it.
#[track_caller]
fn is_found(system: &System<f64>, printed: &Configuration<f64>, beside: f64, digits: f64) {
    let mut work = system.work();
    let size = system.residual(printed, &mut work);
    assert!(size.largest <= digits, "residual {}", size.largest);
    let unknowns = system.unknowns().len();
    let aside: Vec<f64> = (0..unknowns)
        .map(|i| beside * (1.7 * i as f64 + 0.5).sin())
        .collect();
    let found = solve(system, &system.displaced(printed, &aside)).expect("it assembles");
    same(&found, printed, digits);
}

/// The same configuration, angles and signs of quaternions modulo whole turns.
#[track_caller]
fn same(a: &Configuration<f64>, b: &Configuration<f64>, digits: f64) {
    for (a, b) in a.joints.iter().zip(&b.joints) {
        // joints are either lengths that agree or angles that agree modulo a turn
        assert!(
            turn(a - b).abs() <= digits || (a - b).abs() <= digits,
            "{a} {b}"
        );
    }
    for (a, b) in a.platforms.iter().zip(&b.platforms) {
        close(&a.pose(), &b.pose(), digits);
    }
}

fn turn(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

#[track_caller]
fn close(a: &Pose<f64>, b: &Pose<f64>, digits: f64) {
    let (a_rows, b_rows) = (a.rotation.rows(), b.rotation.rows());
    for (x, y) in a_rows.iter().flatten().zip(b_rows.iter().flatten()) {
        assert!((x - y).abs() <= digits, "{a:?} {b:?}");
    }
    near_point(a.position.0, b.position.0, digits);
}

#[track_caller]
fn near_point(a: [f64; 3], b: [f64; 3], digits: f64) {
    let largest = a.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (x, y) in a.into_iter().zip(b) {
        assert!((x - y).abs() <= digits * largest, "{a:?} {b:?}");
    }
}

/// A frame at `origin` with x towards `along` and `beside` in its xy plane, on the side of y.
fn frame(origin: [f64; 3], along: [f64; 3], beside: [f64; 3]) -> Pose<f64> {
    let origin = Vector3(origin);
    let unit = |v: Vector3<f64>| v.times(1.0 / v.norm());
    let x = unit(Vector3(along) - origin);
    let z = unit(x.cross(&(Vector3(beside) - origin)));
    Pose {
        rotation: Rotation([x, z.cross(&x), z]),
        position: origin,
    }
}

#[test]
fn four_bars() {
    for row in list(&data("four_bar")["rows"]) {
        let parameters = ["l0", "l1", "l2", "l3"].map(|name| (name, number(&row[name])));
        let mechanism = with_parameters("four_bar", &parameters);
        let system = direct(&mechanism);
        let theta1 = number(&row["theta1_deg"]).to_radians();
        let solutions = list(&row["phi2_phi1"]);
        assert_eq!(solutions.len() as f64, number(&row["n_real"]));
        for solution in solutions {
            let [phi2, phi1] = numbers(solution)[..] else {
                panic!("two angles")
            };
            let values = [("theta1", theta1), ("phi2", phi2), ("phi1", phi1)];
            is_found(&system, &joints_at(&mechanism, &values), 0.05, DIGITS);
        }
        if solutions.is_empty() {
            for k in 0..12 {
                let angle = f64::from(k);
                let values = [("theta1", theta1), ("phi2", angle), ("phi1", 2.3 * angle)];
                assert!(solve(&system, &joints_at(&mechanism, &values)).is_none());
            }
        }
    }
}

#[test]
fn the_eight_assemblies_of_the_3_rps() {
    let mechanism = mechanism("three_rps");
    let system = direct(&mechanism);
    let assemblies = data("three_rps")["assemblies"].clone();
    assert_eq!(list(&assemblies).len(), 8);
    for assembly in list(&assemblies) {
        let theta = triple(&assembly["theta"]);
        let balls: Vec<[f64; 3]> = list(&assembly["S"]).iter().map(triple).collect();
        let middle = [0, 1, 2].map(|i| (balls[0][i] + balls[1][i] + balls[2][i]) / 3.0);
        let phi = theta.map(|theta| std::f64::consts::FRAC_PI_2 - theta);
        let values = [("phi1", phi[0]), ("phi2", phi[1]), ("phi3", phi[2])];
        let mut printed = joints_at(&mechanism, &values);
        printed.platforms[0] = PlatformPose::from_pose(&frame(middle, balls[0], balls[1]));
        is_found(&system, &printed, 0.01, DIGITS);
        for (leg, ball) in ["leg1", "leg2", "leg3"].into_iter().zip(&balls) {
            let tip = mechanism.pose(leg, &printed).unwrap();
            near_point(tip.position.0, *ball, DIGITS);
        }

        // the same through a question with a guess in rounded numbers
        let rough = |x: f64| (x * 100.0).round() / 100.0;
        let pose = printed.platforms[0].pose();
        let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
        let [x, y, z] = pose.position.0.map(rough);
        let guess = format!(
            "[T({x}, {y}, {z}), Rz({}), Ry({}), Rx({})]",
            rough(yaw),
            rough(pitch),
            rough(roll)
        );
        let mut question = Question::new(&mechanism).guess("top", &guess).unwrap();
        for (name, value) in values {
            question = question.guess(name, rough(value).to_string()).unwrap();
        }
        let report = assemble(&question, &AssemblySettings::default(), &Watch::none()).unwrap();
        assert_eq!(report.restarts, 0);
        assert!(report.residual <= 1e-12);
        same(&report.configuration(), &printed, DIGITS);
    }
}

#[test]
fn the_ten_assemblies_of_the_three_fingered_hand() {
    let with_object = mechanism("three_fingered_hand");
    let by_distances = mechanism("three_fingered_hand_distances");
    let assemblies = data("three_fingered_hand")["assemblies"].clone();
    assert_eq!(list(&assemblies).len(), 10);
    for assembly in list(&assemblies) {
        let phi = triple(&assembly["phi"]);
        let tips: Vec<[f64; 3]> = list(&assembly["p"]).iter().map(triple).collect();
        let values = [("phi1", phi[0]), ("phi2", phi[1]), ("phi3", phi[2])];
        let printed = joints_at(&by_distances, &values);
        is_found(&direct(&by_distances), &printed, 1e-3, DIGITS);
        let mut printed = joints_at(&with_object, &values);
        printed.platforms[0] = PlatformPose::from_pose(&frame(tips[0], tips[1], tips[2]));
        is_found(&direct(&with_object), &printed, 1e-3, 1e-11);
        for (finger, tip) in ["finger1", "finger2", "finger3"].into_iter().zip(&tips) {
            let found = with_object.pose(finger, &printed).unwrap();
            near_point(found.position.0, *tip, DIGITS);
        }
    }
}

#[test]
fn the_six_assemblies_of_the_planar_3_rpr() {
    let mechanism = mechanism("planar_3rpr");
    let system = direct(&mechanism);
    let assemblies = data("planar_3rpr")["assemblies"].clone();
    assert_eq!(list(&assemblies).len(), 6);
    let feet = [[0.0, 0.0], [15.91, 0.0], [0.0, 10.0]];
    for assembly in list(&assemblies) {
        let [x, y, phi] = triple(assembly);
        let pose = Pose {
            rotation: Pose::rotation(linkwork::geometry::Axis::Z, phi).rotation,
            position: Vector3([x, y, 0.0]),
        };
        let mut printed = mechanism.home();
        printed.platforms[0] = PlatformPose::from_pose(&pose);
        let names = ["theta1", "theta2", "theta3"];
        for (i, (name, [fx, fy])) in names.into_iter().zip(feet).enumerate() {
            let hinge = mechanism
                .pose(&format!("platform.B{}", i + 1), &printed)
                .unwrap();
            let [hx, hy, _] = hinge.position.0;
            printed.joints[mechanism.joint(name).unwrap()] = (hy - fy).atan2(hx - fx);
        }
        is_found(&system, &printed, 1e-3, DIGITS);
    }
}

#[test]
fn forward_kinematics_of_serial_arms() {
    let corke = data("puma560_corke");
    let modified = data("puma560_modified");
    let standard = data("puma560_standard");
    let elbow = data("elbow_manipulator");
    for (name, poses) in [
        ("puma560_corke", &corke["forward"]),
        ("puma560_modified", &modified["forward"]),
        ("puma560_standard", &standard["forward"]),
        ("elbow_manipulator", &elbow["forward"]),
    ] {
        let mechanism = mechanism(name);
        for (pose, case) in poses.as_object().unwrap() {
            let at = all_joints_at(&mechanism, &numbers(&case["q"]));
            let hand = mechanism.pose("arm", &at).unwrap();
            assert!(!pose.is_empty());
            close(&hand, &matrix(&case["T"]), DIGITS);
        }
    }
    let (scara, stanford) = (data("scara"), data("stanford_arm"));
    let (cylindrical, planar) = (data("cylindrical_rpp"), data("planar_3r"));
    for (name, q, expected) in [
        ("scara_modified", &scara["q"], &scara["modified"]),
        ("scara_standard", &scara["q"], &scara["standard"]),
        ("stanford_arm", &stanford["q"], &stanford["T"]),
        (
            "cylindrical_rpp",
            &cylindrical["arm"]["q"],
            &cylindrical["arm"]["T"],
        ),
        (
            "rpp_wrist",
            &cylindrical["with_wrist"]["q"],
            &cylindrical["with_wrist"]["T"],
        ),
        ("planar_3r", &planar["q"], &planar["T"]),
    ] {
        let mechanism = mechanism(name);
        let at = all_joints_at(&mechanism, &numbers(q));
        close(
            &mechanism.pose("arm", &at).unwrap(),
            &matrix(expected),
            DIGITS,
        );
    }
}

#[test]
fn inverse_kinematics_of_the_puma_and_the_elbow_manipulator() {
    let (corke, elbow) = (data("puma560_corke"), data("elbow_manipulator"));
    for (name, target, solutions, count) in [
        (
            "puma560_corke",
            &corke["forward"]["generic"]["T"],
            &corke["inverse_of_generic"],
            8,
        ),
        (
            "elbow_manipulator",
            &elbow["forward"]["g2"]["T"],
            &elbow["inverse_of_g2"],
            4,
        ),
    ] {
        let mechanism = mechanism(name);
        let system = inverse(&mechanism);
        assert_eq!(list(solutions).len(), count);
        // the printed pose is orthonormal to its 15 digits only
        let digits = 1e-11;
        for solution in list(solutions) {
            let mut printed = all_joints_at(&mechanism, &numbers(solution));
            close(
                &mechanism.pose("arm", &printed).unwrap(),
                &matrix(target),
                digits,
            );
            printed.platforms[0] = PlatformPose::from_pose(&matrix(target));
            is_found(&system, &printed, 0.02, digits);
        }
    }
}

#[test]
fn delta_robots() {
    let data = data("delta");
    let (third, sixth) = (3.0_f64.sqrt() / 3.0, 3.0_f64.sqrt() / 6.0);
    // the tutorial joins the rods to the middles of the sides of the hand's triangle
    let tutorial = [
        ("sB", 0.4573),
        ("sP", 0.115),
        ("L", 0.112),
        ("l", 0.232),
        ("uP", sixth * 0.115),
    ];
    let tutorial = with_parameters("delta", &tutorial);
    let flexpicker = mechanism("delta");
    let parameters = flexpicker.parameters();
    let up = parameters.iter().find(|p| &*p.name == "uP").unwrap();
    assert!((up.value - third * 0.076).abs() < 1e-15);
    let names = ["theta1", "theta2", "theta3"];
    for (mechanism, rows) in [
        (&tutorial, &data["zavatsky"]),
        (&flexpicker, &data["williams"]),
    ] {
        let system = direct(mechanism);
        for row in list(rows) {
            let theta = triple(&row["theta_deg"]);
            for position in list(&row["positions"]) {
                let values = [0, 1, 2].map(|i| (names[i], theta[i].to_radians()));
                let mut printed = joints_at(mechanism, &values);
                printed.platforms[0].position = Vector3(triple(position));
                printed.platforms[0].orientation = Quaternion::identity();
                is_found(&system, &printed, 1e-3, DIGITS);
            }
        }
    }
    let system = inverse(&flexpicker);
    for row in list(&data["williams_inverse"]) {
        let branches: Vec<Vec<f64>> = list(&row["theta_deg"]).iter().map(numbers).collect();
        for choice in 0..8 {
            let values = [0, 1, 2].map(|i| (names[i], branches[i][choice >> i & 1].to_radians()));
            let mut printed = joints_at(&flexpicker, &values);
            printed.platforms[0].position = Vector3(triple(&row["position"]));
            printed.platforms[0].orientation = Quaternion::identity();
            is_found(&system, &printed, 0.05, DIGITS);
        }
    }
}

#[test]
fn the_forty_postures_of_dietmaiers_platform() {
    let mechanism = mechanism("dietmaier");
    let system = direct(&mechanism);
    let postures = data("dietmaier")["postures"].clone();
    assert_eq!(list(&postures).len(), 40);
    for posture in list(&postures) {
        let posture = numbers(posture);
        let mut printed = mechanism.home();
        printed.platforms[0] = PlatformPose {
            orientation: Quaternion(posture[..4].try_into().unwrap()),
            position: Vector3(posture[4..].try_into().unwrap()),
        };
        // the least singular value of some postures is 5e-5
        let mut work = system.work();
        assert!(system.residual(&printed, &mut work).largest <= 1e-14);
        is_found(&system, &printed, 1e-5, 1e-10);
    }
}

#[test]
fn slider_cranks() {
    for row in list(&data("slider_crank")["rows"]) {
        let parameters = ["r", "l", "e"].map(|name| (name, number(&row[name])));
        let mechanism = with_parameters("slider_crank", &parameters);
        let [(_, r), (_, l), (_, e)] = parameters;
        let system = direct(&mechanism);
        let theta = number(&row["theta_deg"]).to_radians();
        let solutions = numbers(&row["s"]);
        for &s in &solutions {
            let rod = (e - r * theta.sin()).atan2(s - r * theta.cos());
            let values = [("theta", theta), ("phi", rod - theta), ("s", s)];
            let printed = joints_at(&mechanism, &values);
            let mut work = system.work();
            assert!(system.residual(&printed, &mut work).largest <= DIGITS);
            // with r = l and e = 0 the two assemblies meet at 90 deg, or lie on the crank's pivot
            if (solutions[0] - solutions[1]).abs() > 0.1 {
                is_found(&system, &printed, 0.01, DIGITS);
            }
        }
        if solutions.is_empty() {
            assert!(l < (e - r * theta.sin()).abs());
            let values = [("theta", theta), ("phi", 0.3), ("s", 1.0)];
            assert!(solve(&system, &joints_at(&mechanism, &values)).is_none());
        }
    }
}

#[test]
fn five_bars() {
    let mechanism = mechanism("five_bar");
    let system = direct(&mechanism);
    for row in list(&data("five_bar")["rows"]) {
        let [t1, t2] = numbers(&row["theta_deg"])[..] else {
            panic!("two angles")
        };
        let (t1, t2) = (t1.to_radians(), t2.to_radians());
        for point in list(&row["P"]) {
            let [x, y] = numbers(point)[..] else {
                panic!("two coordinates")
            };
            let arm = |foot: f64, t: f64| (y - 0.3 * t.sin()).atan2(x - foot - 0.3 * t.cos()) - t;
            let values = [
                ("theta1", t1),
                ("theta2", t2),
                ("psi1", arm(0.0, t1)),
                ("psi2", arm(0.2, t2)),
            ];
            let printed = joints_at(&mechanism, &values);
            is_found(&system, &printed, 0.02, DIGITS);
            let tip = mechanism.pose("left", &printed).unwrap();
            near_point(tip.position.0, [x, y, 0.0], DIGITS);
        }
    }
}

#[test]
fn watt_six_bars() {
    let mechanism = mechanism("watt_six_bar");
    let system = direct(&mechanism);
    for row in list(&data("watt_six_bar")["rows"]) {
        let theta = number(&row["theta_deg"]).to_radians();
        assert_eq!(list(&row["phi1_phi2"]).len(), 4);
        for outputs in list(&row["phi1_phi2"]) {
            let [phi1, phi2] = numbers(outputs)[..] else {
                panic!("two angles")
            };
            let coupler = |g: f64, a: f64, input: f64, c: f64, output: f64| {
                let x = g + c * output.cos() - a * input.cos();
                (c * output.sin() - a * input.sin()).atan2(x) - input
            };
            let second = phi1 + 40_f64.to_radians();
            let values = [
                ("theta", theta),
                ("phi1", phi1),
                ("phi2", phi2),
                ("psi1", coupler(5.0, 2.0, theta, 3.5, phi1)),
                ("psi2", coupler(6.0, 2.5, second, 4.0, phi2)),
            ];
            is_found(&system, &joints_at(&mechanism, &values), 0.01, DIGITS);
        }
    }
}

#[test]
fn the_six_assemblies_of_the_stephenson_six_bar() {
    let mechanism = mechanism("stephenson_six_bar");
    let system = direct(&mechanism);
    let data = data("stephenson_six_bar");
    let [px, py] = numbers(&data["P"])[..] else {
        panic!("two coordinates")
    };
    let angles = numbers(&data["theta1"]);
    assert_eq!(angles.len(), 6);
    let (g, a, b, c, u, v, l) = (6.0, 2.0, 5.0, 4.0, 2.3, -1.4, 2.0_f64);
    for theta1 in angles {
        // the 4-bar's two branches; the coupler point of one lies on the circle about P
        let (x, y) = (g - a * f64::cos(theta1), -a * f64::sin(theta1));
        let diagonal = x.hypot(y);
        let at_crank = ((b * b + diagonal * diagonal - c * c) / (2.0 * b * diagonal)).acos();
        let branches = [1.0, -1.0].map(|side| {
            let beta = y.atan2(x) + side * at_crank;
            let point = [
                a * theta1.cos() + u * beta.cos() - v * beta.sin(),
                a * theta1.sin() + u * beta.sin() + v * beta.cos(),
            ];
            let off = ((px - point[0]).hypot(py - point[1]) - l).abs();
            (off, beta, point)
        });
        let (off, beta, point) = match branches[0].0 < branches[1].0 {
            true => branches[0],
            false => branches[1],
        };
        assert!(off < 1e-11, "{off}");
        let (ex, ey) = (
            a * theta1.cos() + b * beta.cos(),
            a * theta1.sin() + b * beta.sin(),
        );
        let values = [
            ("theta", std::f64::consts::FRAC_PI_2),
            ("theta1", theta1),
            ("psi1", beta - theta1),
            ("phi1", ey.atan2(ex - g)),
            ("chi", (py - point[1]).atan2(px - point[0]) - beta),
        ];
        is_found(&system, &joints_at(&mechanism, &values), 1e-3, 1e-11);
    }
}

#[test]
fn universal_joints() {
    for row in list(&data("spherical_four_bar")["rows"]) {
        let [beta, theta1, theta2] = triple(row).map(f64::to_radians);
        let mechanism = with_parameters("spherical_four_bar", &[("beta", beta)]);
        let system = direct(&mechanism);
        // the cross's angle is not printed: found from home with the yoke angles held near
        let guess = joints_at(&mechanism, &[("theta1", theta1), ("theta2", theta2)]);
        let at = solve(&system, &guess).expect("it assembles");
        let found = at.joints[mechanism.joint("theta2").unwrap()];
        assert!(turn(found - theta2).abs() <= DIGITS, "{found} {theta2}");
    }
}

/// A loop of standard rows that ends where it starts.
fn closed_loop(rows: &Value, unit: &str) -> Mechanism {
    let (mut joints, mut table) = (String::new(), String::new());
    for (i, row) in list(rows).iter().enumerate() {
        let [a, alpha, d] = triple(row);
        joints += &format!("\"theta{i}\": Passive(),");
        table +=
            &format!("(a: {a:?}, alpha: \"{alpha:?} {unit}\", d: {d:?}, theta: \"theta{i}\"),");
    }
    let text = format!(
        "Mechanism(version: 1, name: \"loop\", convention: Standard, joints: {{{joints}}},
        chains: {{\"links\": Chain(rows: [{table}])}}, closures: {{\"c\": Rigid(\"links\", \"ground\")}})"
    );
    Mechanism::new(&Description::read(&text).unwrap()).unwrap()
}

#[test]
fn closed_loops_of_one_chain() {
    for case in list(&data("loops")["loops"]) {
        let mechanism = closed_loop(&case["a_alpha_d"], case["alpha_unit"].as_str().unwrap());
        let mobility = number(&case["mobility"]);
        let mut joints = vec![false; mechanism.joints().len()];
        joints[0] = mobility == 1.0;
        let platforms = vec![];
        let system = System::new(mechanism.dimensions(), &Held { joints, platforms });
        for angles in list(&case["assemblies"]) {
            let printed = all_joints_at(&mechanism, &numbers(angles));
            is_found(&system, &printed, 0.01, 1e-11);
            let held = Held {
                joints: vec![false; printed.joints.len()],
                platforms: vec![],
            };
            let freedoms = Freedoms::at(mechanism.dimensions(), &held, &printed);
            assert_eq!(freedoms.motions.len() as f64, mobility, "{}", case["name"]);
        }
    }
}

#[test]
fn overconstrained_loops_of_the_mechanism_files() {
    let data = data("loops");
    for (file, name) in [
        ("bennett", "Bennett 4R"),
        ("sarrus", "Sarrus 6R"),
        ("schatz", "Schatz 6R"),
    ] {
        let mechanism = mechanism(file);
        let mut loops = list(&data["loops"]).iter();
        let case = loops.find(|case| case["name"] == name).unwrap();
        for angles in list(&case["assemblies"]) {
            let angles = numbers(angles);
            // the last hinge is the broken one
            let printed = all_joints_at(&mechanism, &angles[..angles.len() - 1]);
            is_found(&direct(&mechanism), &printed, 0.02, 1e-11);
        }
    }
}

#[test]
fn a_bennett_linkage_with_a_ratio_five_percent_off_does_not_assemble() {
    let broken = with_parameters("bennett", &[("b", 1.608693330549854)]);
    let right = mechanism("bennett");
    for k in 1..12 {
        let theta1 = 0.25 * f64::from(k);
        let guess = joints_at(&right, &[("theta1", theta1)]);
        let assembled = solve(&direct(&right), &guess).expect("it moves");
        assert!(solve(&direct(&broken), &assembled).is_none(), "{theta1}");
    }
    // flat it is whole
    let pi = std::f64::consts::PI;
    for flat in [[0.0, -pi, 0.0], [-pi, 0.0, -pi]] {
        let mut work = direct(&broken).work();
        let size = direct(&broken).residual(&all_joints_at(&broken, &flat), &mut work);
        assert!(size.largest < 1e-14);
    }
}
