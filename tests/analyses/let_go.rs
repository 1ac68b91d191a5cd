//! Mechanisms that are let go, and rest positions, against published motions computed by two routes each.

use std::fmt::Write as _;

use linkwork::analysis::equilibrium::{
    EquilibriumReport, EquilibriumSettings, NoRest, RestPosition, Stability,
};
use linkwork::analysis::simulation::{
    Happened, NoSimulation, SimulationEnd, SimulationReport, SimulationSettings,
};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::NotAlgebraic;
use serde_json::Value;

fn known() -> Value {
    serde_json::from_str(include_str!("../data/let_go.json")).unwrap()
}

fn rows(of: &Value) -> Vec<Vec<f64>> {
    let numbers = |row: &Value| {
        row.as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect()
    };
    of["rows"].as_array().unwrap().iter().map(numbers).collect()
}

fn question(text: &str) -> Question {
    Question::new(Mechanism::new(&Description::read(text).unwrap()).unwrap())
}

fn let_go(question: &Question, duration: f64, rows: usize) -> SimulationReport {
    let settings = SimulationSettings {
        duration,
        rows,
        ..SimulationSettings::default()
    };
    simulated(question, &settings)
}

fn simulated(question: &Question, settings: &SimulationSettings) -> SimulationReport {
    question
        .simulation(settings, &Watch::none())
        .unwrap()
        .closed()
        .unwrap()
}

fn rest(question: &Question, all: bool) -> EquilibriumReport {
    let settings = EquilibriumSettings {
        all,
        starts: 40,
        ..EquilibriumSettings::default()
    };
    question
        .equilibrium(&settings, &Watch::none())
        .unwrap()
        .closed()
        .unwrap()
}

/// The values of columns at a time that is a row.
fn at(report: &SimulationReport, time: f64, names: &[&str]) -> Vec<f64> {
    let row = report
        .rows
        .iter()
        .find(|row| (row[0] - time).abs() < 1e-9)
        .unwrap();
    let place = |name: &&str| {
        report
            .columns
            .iter()
            .position(|of| of.name == **name)
            .unwrap()
    };
    names.iter().map(|name| row[place(name)]).collect()
}

fn near(found: &[f64], expected: &[f64], within: f64) {
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < within, "{found:?} instead of {expected:?}");
    }
}

/// A four-bar with crank 0.1, coupler 0.3, rocker 0.2 and ground 0.38 m, its crank at 1 rad.
const FOUR_BAR: &str = r#"Mechanism(
    version: 1, name: "four-bar", convention: Modified,
    joints: {
        "theta": Actuated(home: 1, LIMITS), "A": Passive(home: -0.62364), "B": Passive(home: 1.8078),
    },
    chains: {
        "left": Chain(rows: [(theta: "theta", link: "crank"), (a: 0.1, theta: "A", link: "coupler")], tip: [Tx(0.3)]),
        "right": Chain(base: [Tx(0.38)], rows: [(theta: "B", link: "rocker")], tip: [Tx(0.2)]),
    },
    closures: { "pin": Revolute("left", "right") },
    gravity: (0, -9.81, 0),
    masses: {
        "crank": (mass: 0.6, centre: ("0.03*cos(30 deg)", "0.03*sin(30 deg)", 0), inertia: 0.0012),
        "coupler": (mass: 2, centre: ("0.16*cos(15 deg)", "0.16*sin(15 deg)", 0), inertia: 0.018),
        "rocker": (mass: 1.5, centre: (0.1, 0, 0), inertia: 0.009),
    },
)"#;

fn four_bar(limits: &str) -> Question {
    question(&FOUR_BAR.replace("LIMITS", limits))
}

#[test]
fn a_four_bar_that_is_let_go_keeps_its_energy_and_stays_closed() {
    let report = let_go(&four_bar(""), 1.0, 10);
    assert_eq!(
        (report.end.clone(), report.freedoms),
        (SimulationEnd::Over, 1)
    );
    for row in rows(&known()["four_bar"]) {
        near(
            &at(&report, row[0], &["theta", "rate:theta"]),
            &row[1..],
            1e-6,
        );
    }
    assert!(
        report.energy.error < 1e-8 && report.residual < 1e-11,
        "{report:?}"
    );
    // with another mass the motion is another one
    let heavier = question(
        &FOUR_BAR
            .replace("LIMITS", "")
            .replace("mass: 2,", "mass: 2.1,"),
    );
    let heavier = at(&let_go(&heavier, 1.0, 10), 1.0, &["theta"]);
    assert!((heavier[0] - at(&report, 1.0, &["theta"])[0]).abs() > 1e-3);
}

#[test]
fn a_limit_ends_the_motion_or_sends_it_back_with_a_loss_of_energy() {
    let stopped = four_bar("limits: (0, 2)");
    let report = let_go(&stopped, 1.0, 10);
    let SimulationEnd::Limit { joint, limit, .. } = &report.end else {
        panic!("{:?}", report.end);
    };
    assert_eq!((joint.as_str(), *limit), ("theta", 0.0));
    // the crank passes 0 between 0.2 and 0.3 s
    assert!((0.2..0.21).contains(&report.reached), "{}", report.reached);
    let settings = SimulationSettings {
        restitution: Some(0.5),
        ..SimulationSettings::default()
    };
    let report = simulated(&stopped, &settings);
    let Some(Happened::Impact { loss, .. }) = report.events.first().map(|of| &of.event) else {
        panic!("{:?}", report.events);
    };
    // three quarters of the kinetic energy of one freedom are lost
    let gone = 5.127_766_561_725_37 - at_zero();
    assert!((loss - 0.75 * gone).abs() < 1e-6, "{loss} of {gone}");
    assert!(report.energy.error < 1e-8);
}

/// A bar of 2 kg on a hinge falls on a stop at −60°: by energy, ½I·ω² = m·g·r·sin 60°; what lifts it has to exceed its weight.
#[test]
fn a_joint_rests_on_its_limit_until_it_is_lifted() {
    let text = r#"Axes(version: 1, name: "flap", gravity: (0, 0, -9.81),
        joints: { "q": Revolute(point: (0, 0, 0), direction: (0, -1, 0), role: Actuated, between: ("ground", "b"), limits: ("-60 deg", "90 deg")) },
        points: { "m": (body: "b", at: (0.8, 0, 0)) }, masses: { "m": (mass: 2, inertia: (0.03, 0.03, 0.03, 0, 0, 0)) })"#;
    let with = |restitution: f64, lift: &str| {
        let settings = SimulationSettings {
            duration: 3.0,
            rows: 6,
            restitution: Some(restitution),
            ..SimulationSettings::default()
        };
        simulated(&question(text).load("q", lift), &settings)
    };
    let (inertia, weight) = (0.03f64 + 2.0 * 0.64, 2.0 * 9.81 * 0.8);
    let fallen = weight * 60f64.to_radians().sin();
    let lying = with(0.0, "if(time < 1 s, 0 N*m, 7 N*m)");
    let [of] = &lying.events[..] else {
        panic!("{:?}", lying.events);
    };
    let Happened::Rests { speed, loss, .. } = &of.event else {
        panic!("{of:?}");
    };
    near(
        &[*speed, *loss],
        &[(2.0 * fallen / inertia).sqrt(), fallen],
        1e-9,
    );
    near(&at(&lying, 3.0, &["q"]), &[-60f64.to_radians()], 1e-12);
    assert_eq!(lying.end, SimulationEnd::Over);
    // 7 N·m do not lift weight·cos 60°, 7.848 N·m; a moment that grows does when it has reached that
    let lifted = with(0.0, "if(time < 1 s, 0 N*m, 4 N*m/s*time)");
    let left = lifted
        .events
        .iter()
        .find(|of| matches!(of.event, Happened::Leaves { .. }));
    near(&[left.unwrap().time], &[0.5 * weight / 4.0], 1e-9);
    assert!(at(&lifted, 3.0, &["q"])[0] > -60f64.to_radians() + 0.1);
    // each impact leaves 0.6 of the speed, until it rests
    let bounced = with(0.6, "0");
    let speeds = bounced.events.iter().map(|of| match of.event {
        Happened::Impact { speed, .. } | Happened::Rests { speed, .. } => speed,
        _ => panic!("{of:?}"),
    });
    let speeds: Vec<f64> = speeds.collect();
    for pair in speeds.windows(2) {
        near(&[pair[1]], &[0.6 * pair[0]], 1e-8);
    }
    assert!(
        speeds.len() > 15 && bounced.energy.error < 1e-9,
        "{:?}",
        bounced.energy
    );
    assert!((bounced.energy.lost - fallen).abs() < 1e-8);
}

#[test]
fn a_limit_that_is_passed_only_for_a_moment_is_seen() {
    // a pendulum that is let go 0.1 rad from where it hangs turns back 0.1 rad on the other side
    let swings = |limit: f64| {
        let text = format!(
            r#"Axes(version: 1, name: "pendulum", gravity: (0, -9.81, 0),
                joints: {{ "pin": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("ground", "rod"), role: Actuated, limits: (-0.2, {limit:?})) }},
                points: {{ "middle": (body: "rod", at: (0, -1, 0)) }}, masses: {{ "middle": (mass: 3) }})"#
        );
        let_go(&question(&text).hold("pin", -0.1), 3.0, 2)
    };
    let ended = swings(0.1 - 1e-7);
    assert!(
        matches!(ended.end, SimulationEnd::Limit { .. }),
        "{:?}",
        ended.end
    );
    assert_eq!(swings(0.1 + 1e-7).end, SimulationEnd::Over);
}

/// β, Θ, γ, Φ, δ, Ω and ε after 0.03 s.
///
/// Source: F. Mazzia and C. Magherini, Test Set for Initial Value Problem Solvers (2008), Andrews' squeezing mechanism.
const ANDREWS: [(&str, f64); 7] = [
    ("beta", 15.810_771_196_299_04),
    ("Theta", -15.756_371_059_842_98),
    ("gamma", 0.040_822_240_130_731_01),
    ("Phi", -0.534_730_116_322_694_8),
    ("delta", 0.524_409_965_880_530_4),
    ("Omega", 0.534_730_116_322_694_8),
    ("epsilon", 1.048_080_741_042_263),
];

#[test]
fn seven_bodies_turn_fast_as_published() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/mechanisms/loads/andrews_squeezer.ron"
    );
    let question = Question::new(linkwork::load(file).unwrap());
    let settings = SimulationSettings {
        duration: 0.03,
        rows: 3,
        tolerance: 1e-12,
        ..SimulationSettings::default()
    };
    let report = simulated(&question, &settings);
    let (names, values): (Vec<&str>, Vec<f64>) = ANDREWS.into_iter().unzip();
    // the published equations integrated in Python to 1e-13 are 1.2e-9 rad from the published digits too
    near(&at(&report, 0.03, &names), &values, 2e-9);
    // without the motor it turns less far
    let other = simulated(&question.without("motor"), &settings);
    assert!(at(&other, 0.03, &["beta"])[0] < 10.0);
}

#[test]
fn what_is_balanced_stays_and_what_falls_without_end_is_said() {
    let shipped = |name: &str| {
        let file = format!("{}/mechanisms/loads/{name}.ron", env!("CARGO_MANIFEST_DIR"));
        Question::new(linkwork::load(file).unwrap())
    };
    let lamp = rest(&shipped("desk_lamp").hold("a", 0.3).hold("b", 0.2), false);
    let [position] = &lamp.positions[..] else {
        panic!("{lamp:?}");
    };
    let values: Vec<f64> = position.joints.values().copied().collect();
    near(&values, &[0.3, 0.2], 1e-12);
    assert_eq!(position.stability, Stability::Undecided { directions: 2 });
    assert_eq!(position.modes[0].frequency, Some(0.0));
    assert_eq!(
        rest(&shipped("stewart_payload"), false).none,
        Some(NoRest::Endless)
    );
}

/// A rod 2 m long with 3 kg on a pin at its end, along x at 0.
const PENDULUM: &str = r#"Axes(version: 1, name: "pendulum", gravity: (0, -9.81, 0),
    joints: { "pin": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("ground", "rod"), role: Actuated) },
    points: { "middle": (body: "rod", at: (1, 0, 0)) }, masses: { "middle": (mass: 3, shape: Rod(2)) })"#;

/// The four-bar swings to and fro about once in 1.65 s; the number of times its crank turns back.
fn swings(duration: f64) -> usize {
    let settings = SimulationSettings {
        duration,
        rows: 20 * duration as usize,
        ..SimulationSettings::default()
    };
    let report = simulated(&four_bar(""), &settings);
    assert_eq!(report.end, SimulationEnd::Over);
    assert!(report.energy.error < 1e-8, "{:?}", report.energy);
    assert!(
        report.energy.corrected < 1e-7 * duration,
        "{:?}",
        report.energy
    );
    let column = report.columns.iter().position(|of| of.name == "rate:theta");
    let rates = report.rows.iter().map(|row| row[column.unwrap()]);
    let rates: Vec<f64> = rates.collect();
    rates
        .windows(2)
        .filter(|pair| pair[0] * pair[1] < 0.0)
        .count()
}

#[test]
fn energy_is_kept_over_many_swings() {
    assert!(swings(40.0) > 20);
}

/// Takes minutes without optimisation.
#[test]
#[ignore]
fn energy_is_kept_over_ten_thousand_swings() {
    let swings = swings(10_000.0);
    assert!(swings > 10_000, "{swings}");
}

#[test]
fn a_motor_follows_its_law() {
    // 4 kg·m² on a spring of 20 N·m and a damper of 3 N·m·s: θ = 1 − e^(−σt)·(cos ωt + σ/ω·sin ωt)
    let law = "20 N*m*(1 - pin) - 3 N*m*s*velocity:pin";
    let driven = question(PENDULUM).without("weight").load("pin", law);
    let report = let_go(&driven, 2.0, 4);
    let (sigma, square) = (0.375, 5.0f64);
    let omega = (square - sigma * sigma).sqrt();
    for t in [0.5f64, 1.0, 2.0] {
        let swing = (omega * t).cos() + sigma / omega * (omega * t).sin();
        near(
            &at(&report, t, &["pin"]),
            &[1.0 - (-sigma * t).exp() * swing],
            1e-8,
        );
    }
    let settings = SimulationSettings::default();
    let refused = |question: Question| question.simulation(&settings, &Watch::none()).err();
    assert!(refused(question(PENDULUM).load("pin", "3 m*pin")).is_some());
    assert!(refused(question(PENDULUM).load("pin", "force:pin*1")).is_some());
}

#[test]
fn a_driven_joint_goes_at_its_speed_and_tells_its_force() {
    // θ = t², held by 4·2 N·m and against the weight 3·9.81 N at 1 m
    let driven = question(PENDULUM).lock("pin").rate("pin", "2 rad/s^2*time");
    let report = let_go(&driven, 1.0, 4);
    assert_eq!(
        (report.end.clone(), report.freedoms),
        (SimulationEnd::Over, 0)
    );
    for t in [0.25f64, 0.5, 1.0] {
        let (angle, force) = (t * t, 8.0 + 3.0 * 9.81 * (t * t).cos());
        near(
            &at(&report, t, &["pin", "rate:pin", "force:pin"]),
            &[angle, 2.0 * t, force],
            1e-8,
        );
    }
    assert!(report.energy.error < 1e-8, "{:?}", report.energy);
    // the crank of the four-bar at 25 rad/s, whose torque is known at 24 angles
    let driven = four_bar("")
        .hold("theta", 0.0)
        .lock("theta")
        .rate("theta", 25.0);
    let report = let_go(&driven, std::f64::consts::TAU / 25.0, 24);
    let known: Value = serde_json::from_str(include_str!("../data/loads_four_bar.json")).unwrap();
    for (k, row) in rows(&known["answer"]).iter().enumerate().take(24) {
        let torque = report.rows[k].len() - 4;
        assert_eq!(report.columns[torque].name, "force:theta");
        near(
            &[report.rows[k][1], report.rows[k][torque]],
            &row[..2],
            1e-7,
        );
    }
    // what depends on a joint is no law of time
    let wrong = question(PENDULUM).lock("pin").rate("pin", "2*pin");
    let settings = SimulationSettings::default();
    assert!(wrong.simulation(&settings, &Watch::none()).is_err());
}

const BODY_ON_A_BALL: &str = r#"Mechanism(version: 1, name: "body on a ball", convention: Modified, joints: {},
    chains: { "A": Chain() }, platforms: { "top": Platform() }, closures: { "ball": Spherical("A", "top") },
    gravity: (0, 0, "-9.81 m/s^2"),
    masses: { "top+0.1,0.05,0.2": (mass: 2, inertia: (0.03, 0.02, 0.025, 0.001, 0.002, -0.003)) },
)"#;

fn turned_body() -> Question {
    question(BODY_ON_A_BALL)
        .hold("top.roll", 0.1)
        .hold("top.pitch", 0.2)
        .hold("top.yaw", 0.3)
}

const ANGLES: [&str; 3] = ["top.roll", "top.pitch", "top.yaw"];

/// Lagrange's equations in roll, pitch and yaw, written down by sympy and integrated by scipy (DOP853 to 1e-12): the body
/// turns about several times, and is pitched by more than 70°.
#[test]
fn a_body_turns_through_every_orientation() {
    let found = let_go(&turned_body(), 3.0, 6);
    for (time, expected) in [
        (0.5, [-2.60074605, -0.29052054, -3.08411473]),
        (
            1.5,
            [7.01061752 - std::f64::consts::TAU, 0.44353117, 0.34095161],
        ),
        (
            2.5,
            [5.09977529 - std::f64::consts::TAU, -1.26450004, 0.61454554],
        ),
        (3.0, [1.54364967, -0.89019365, 0.38811473]),
    ] {
        near(&at(&found, time, &ANGLES), &expected, 2e-8);
    }
    assert!(found.energy.error < 1e-9 && found.end == SimulationEnd::Over);
}

/// By the same equations, with a roll or yaw that is driven ever faster over several turns while the other angles stay, and
/// with one angle driven and the others free; the moment of the drive too.
#[test]
fn angles_of_a_platform_are_driven_over_whole_turns() {
    let driven = |name: &str, locked: &[&str], duration: f64| {
        let mut asked = turned_body().rate(name, "5 rad/s^2*time");
        for name in locked {
            asked = asked.lock(*name);
        }
        let settings = SimulationSettings {
            duration,
            rows: 1,
            ..SimulationSettings::default()
        };
        simulated(&asked, &settings)
    };
    let force = |name: &str| format!("force:{name}");
    for (name, moment) in [("top.yaw", 0.31960235), ("top.roll", 1.98582212)] {
        let found = driven(name, &ANGLES, 3.0);
        near(&at(&found, 3.0, &[&force(name)]), &[moment], 1e-7);
    }
    for (name, angles, moment) in [
        ("top.yaw", [0.22613606, 1.38890764, 0.525], -0.175367355),
        ("top.roll", [0.325, 1.37389642, 0.58133299], -0.200661017),
        ("top.pitch", [-0.49596467, 0.425, -0.11368488], -0.148681653),
    ] {
        let found = driven(name, &[name], 0.3);
        near(&at(&found, 0.3, &ANGLES), &angles, 2e-8);
        near(&at(&found, 0.3, &[&force(name)]), &[moment], 1e-8);
        // a little later it is pitched by 90°, where roll and yaw have no value
        if name != "top.pitch" {
            assert_eq!(
                driven(name, &[name], 1.0).end,
                SimulationEnd::Singular,
                "{name}"
            );
        }
    }
}

#[test]
fn equations_are_linearised_as_textbooks_do() {
    // an inverted pendulum of 0.2 kg at 0.5 m on a cart of 0.8 kg: ẍ = (u + m·g·θ)/M, θ̈ = (u + (M + m)·g·θ)/(M·l)
    let cart = question(
        r#"Axes(version: 1, name: "cart", gravity: (0, -9.81, 0),
            joints: {
                "x": Prismatic(direction: (1, 0, 0), between: ("ground", "cart"), role: Actuated),
                "pole": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("cart", "pole")),
            },
            points: { "c": (body: "cart", at: (0, 0, 0)), "p": (body: "pole", at: (0, 0.5, 0)) },
            masses: { "c": (mass: 0.8), "p": (mass: 0.2) })"#,
    );
    let settings = SimulationSettings {
        linearised: true,
        ..SimulationSettings::default()
    };
    let report = simulated(&cart, &settings);
    assert_eq!(report.end, SimulationEnd::Linearised);
    let linear = report.linear.unwrap();
    let place = |name: &str| linear.states.iter().position(|of| of.name == name).unwrap();
    let (x, pole) = (place("rate:x"), place("rate:pole"));
    let (m, big, g, l) = (0.2, 0.8, 9.81, 0.5);
    near(
        &[linear.a[x][place("pole")], linear.a[pole][place("pole")]],
        &[m * g / big, (big + m) * g / (big * l)],
        1e-9,
    );
    near(
        &[linear.b[x][0], linear.b[pole][0]],
        &[1.0 / big, 1.0 / (big * l)],
        1e-12,
    );
    assert_eq!(linear.inputs[0].name, "force:x");
    let row = linear
        .outputs
        .iter()
        .position(|of| of.name == "pole")
        .unwrap();
    near(
        &[linear.c[row][place("pole")], linear.c[row][place("x")]],
        &[1.0, 0.0],
        1e-12,
    );
    // hanging it swings: A turns its sign
    let hangs = simulated(
        &cart.hold("x", 0.0).guess("pole", std::f64::consts::PI),
        &settings,
    );
    let a = &hangs.linear.unwrap().a;
    near(
        &[a[pole][place("pole")]],
        &[-(big + m) * g / (big * l)],
        1e-8,
    );
}

#[test]
fn accelerations_are_those_of_mujoco_and_pinocchio() {
    let mujoco: Value = serde_json::from_str(include_str!("../data/accelerations.json")).unwrap();
    let pinocchio = include_str!("../data/accelerations_pinocchio.json");
    let pinocchio: Value = serde_json::from_str(pinocchio).unwrap();
    let cases = [&mujoco, &pinocchio].map(|known| known["cases"].as_array().unwrap());
    assert_eq!(cases.map(Vec::len), [9, 6]);
    for case in cases.into_iter().flatten() {
        let name = case["file"].as_str().unwrap();
        let file = format!("{}/mechanisms/loads/{name}.ron", env!("CARGO_MANIFEST_DIR"));
        let mut question = Question::new(linkwork::load(file).unwrap());
        for group in ["springs", "forces", "friction"] {
            question = question.without(group);
        }
        for (joint, rate) in case["rates"].as_object().unwrap() {
            let place = question.mechanism().joint(joint).unwrap();
            let home = question.mechanism().joints()[place].home;
            question = question
                .hold(joint, home)
                .rate(joint, rate.as_f64().unwrap());
        }
        let settings = SimulationSettings {
            linearised: true,
            ..SimulationSettings::default()
        };
        let linear = simulated(&question, &settings).linear.unwrap();
        let known = &case["accelerations"];
        let numbers = known.as_object().unwrap().values();
        let largest = numbers.fold(0.0, |most: f64, x| most.max(x.as_f64().unwrap().abs()));
        let mut compared = 0;
        for (state, change) in linear.states.iter().zip(&linear.change) {
            let joint = state.name.strip_prefix("rate:").map(|joint| &known[joint]);
            if let Some(expected) = joint.and_then(Value::as_f64) {
                let off = (change - expected).abs() / largest;
                assert!(
                    off < 1e-9,
                    "{name}: {} {change} instead of {expected}",
                    state.name
                );
                compared += 1;
            }
        }
        assert!(compared > 0, "{name}");
    }
}

/// The exported files with the stiffness of closures and the step that stand in them.
#[test]
fn the_first_second_is_that_of_mujoco_on_exported_files() {
    let known: Value = serde_json::from_str(include_str!("../data/second.json")).unwrap();
    let cases = known["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 4);
    for case in cases {
        let name = case["file"].as_str().unwrap();
        let file = format!("{}/mechanisms/loads/{name}.ron", env!("CARGO_MANIFEST_DIR"));
        let mut question = Question::new(linkwork::load(file).unwrap());
        for group in ["springs", "forces", "friction"] {
            question = question.without(group);
        }
        let report = let_go(&question, 1.0, 4);
        let joints = case["joints"].as_array().unwrap().iter();
        let joints: Vec<&str> = joints.map(|of| of.as_str().unwrap()).collect();
        for row in rows(case) {
            near(&at(&report, row[0], &joints), &row[1..], 1e-7);
        }
    }
}

#[test]
fn friction_holds_a_pendulum_where_it_turns_back() {
    let rubbed = PENDULUM.replace(
        "masses:",
        r#"loads: { "rub": Friction(joint: "pin", moment: 6) }, masses:"#,
    );
    let report = let_go(&question(&rubbed).hold("pin", -0.5), 10.0, 4);
    assert_eq!(report.end, SimulationEnd::Over);
    // from turn to turn the weight does as much work as friction takes; it stays where 29.43 N·m·cos θ is less than 6 N·m
    let (weight, friction) = (3.0 * 9.81, 6.0);
    let (mut angle, mut side) = (-0.5f64, -1.0);
    while (weight * angle.cos()).abs() > friction {
        let lost = |to: f64| weight * (angle.sin() - to.sin()) - friction * (to - angle).abs();
        // beyond the middle it slows down
        let (mut within, mut far) = (
            -std::f64::consts::FRAC_PI_2,
            angle + side * std::f64::consts::PI,
        );
        for _ in 0..100 {
            let middle = 0.5 * (within + far);
            match lost(middle) > 0.0 {
                true => within = middle,
                false => far = middle,
            }
        }
        (angle, side) = (within, -side);
    }
    near(
        &at(&report, 10.0, &["pin", "rate:pin"]),
        &[angle, 0.0],
        1e-7,
    );
    let [event] = &report.events[..] else {
        panic!("{:?}", report.events);
    };
    assert!(matches!(event.event, Happened::Sticks { .. }));
    assert!(report.energy.error < 1e-8, "{:?}", report.energy);
}

/// A block of 2 kg pushed back by 5 N against a stop of 2000 N/m with 20 N·s/m: free flight, then the closed equations of
/// each part integrated by scipy (DOP853 to 1e-12). The stop neither damps before it is touched nor pulls as it is left.
#[test]
fn a_stop_damps_only_while_it_is_touched() {
    let block = question(
        r#"Axes(version: 1, name: "block",
            joints: { "s": Prismatic(point: (0, 0, 0), direction: (1, 0, 0), between: ("ground", "block"), role: Actuated) },
            points: { "m": (body: "block", at: (0, 0, 0)) }, masses: { "m": (mass: 2) },
            loads: {
                "stop": Spring(joint: "s", stiffness: 2000, rest: 0.1, damping: 20, compression_only: true),
                "push": Force(joint: "s", force: -5),
            })"#,
    );
    let report = let_go(&block.hold("s", 0.3), 0.7, 14);
    for (time, place) in [
        (0.4, 0.1),
        (0.45, 0.07288989),
        (0.5, 0.09562015),
        (0.6, 0.14410371),
        (0.7, 0.16758727),
    ] {
        near(&at(&report, time, &["s"]), &[place], 1e-7);
    }
}

#[test]
fn a_block_sticks_until_it_is_pushed_hard_enough() {
    // 2 kg pushed by 2 N/s·t against 5 N: it slips after 2.5 s, and then x = (t − 2.5)³/6
    let block = question(
        r#"Axes(version: 1, name: "block",
            joints: { "x": Prismatic(direction: (1, 0, 0), between: ("ground", "block"), role: Actuated) },
            points: { "c": (body: "block", at: (0, 0, 0)) }, masses: { "c": (mass: 2) },
            loads: { "rub": Friction(joint: "x", force: 5), "push": Force(joint: "x", force: "2 N*time/1 s") })"#,
    );
    let report = let_go(&block, 4.0, 4);
    assert_eq!(at(&report, 2.0, &["x"]), [0.0]);
    near(&at(&report, 4.0, &["x"]), &[1.5f64.powi(3) / 6.0], 1e-8);
    let [held, slips] = &report.events[..] else {
        panic!("{:?}", report.events);
    };
    assert!(held.time == 0.0 && matches!(held.event, Happened::Sticks { .. }));
    assert!((slips.time - 2.5).abs() < 1e-8 && matches!(slips.event, Happened::Slips { .. }));
    // pushed less it never moves
    let report = let_go(&block, 2.4, 2);
    assert!(report.events.len() == 1 && at(&report, 2.4, &["x"]) == [0.0]);
}

#[test]
fn a_four_bar_comes_to_rest_by_friction_in_two_pins() {
    let text = FOUR_BAR.replace("LIMITS", "").replace(
        "masses:",
        r#"loads: { "O": Friction(joint: "theta", moment: 0.5), "B": Friction(joint: "B", coefficient: 0.1, radius: 0.02) },
        masses:"#,
    );
    let report = let_go(&question(&text).hold("theta", 0.0), 10.0, 5);
    assert_eq!(report.end, SimulationEnd::Over);
    let turned = at(&report, 10.0, &["theta"])[0];
    assert!(turned < -1.0, "{turned}");
    let rates = ["rate:theta", "rate:A", "rate:B"];
    near(&at(&report, 10.0, &rates), &[0.0; 3], 1e-12);
    assert!(report.energy.error < 1e-7, "{:?}", report.energy);
    assert!(matches!(
        report.events.last().unwrap().event,
        Happened::Sticks { .. }
    ));
}

/// The potential energy of the four-bar with its crank along ground.
fn at_zero() -> f64 {
    let still = four_bar("").hold("theta", 0.0);
    let report = let_go(&still, 1e-9, 1);
    at(&report, 0.0, &["potential energy"])[0]
}

/// N four-bars side by side.
fn four_bars(n: usize) -> Question {
    let (mut joints, mut points, mut masses) = (String::new(), String::new(), String::new());
    for i in 0..=n {
        let role = if i == 0 { ", role: Actuated" } else { "" };
        let _ = write!(
            joints,
            r#""v{i}": Revolute(point: ({i}, 0, 0), direction: (0, 0, 1), between: ("ground", "V{i}"){role}),"#
        );
        let _ = write!(points, r#""m{i}": (body: "V{i}", at: ({i}, 0.5, 0)),"#);
        let _ = write!(
            masses,
            r#""m{i}": (mass: 1, shape: Rod(1), turned: [Rz("90 deg")]),"#
        );
    }
    for (i, j) in (0..n).map(|i| (i, i + 1)) {
        let _ = write!(
            joints,
            r#""a{i}": Revolute(point: ({i}, 1, 0), direction: (0, 0, 1), between: ("V{i}", "C{i}")),"#
        );
        let _ = write!(
            joints,
            r#""b{i}": Revolute(point: ({j}, 1, 0), direction: (0, 0, 1), between: ("C{i}", "V{j}")),"#
        );
        let _ = write!(points, r#""n{i}": (body: "C{i}", at: ({i}.5, 1, 0)),"#);
        let _ = write!(masses, r#""n{i}": (mass: 1, shape: Rod(1)),"#);
    }
    question(&format!(
        r#"Axes(version: 1, name: "four-bars", gravity: (0, -9.81, 0), joints: {{{joints}}}, points: {{{points}}}, masses: {{{masses}}})"#
    ))
}

#[test]
fn singular_positions_end_the_motion_or_are_passed_straight() {
    for case in known()["n_four_bar"]["cases"].as_array().unwrap() {
        let n = case["N"].as_u64().unwrap() as usize;
        let question = four_bars(n).rate("v0", -1.0);
        let ended = let_go(&question, 5.0, 20);
        assert_eq!(ended.end, SimulationEnd::Singular);
        let time = case["first_horizontal_time"].as_f64().unwrap();
        assert!(
            (ended.reached - time).abs() < 1e-6,
            "{} instead of {time}",
            ended.reached
        );
        let settings = SimulationSettings {
            duration: 5.0,
            rows: 20,
            through: true,
            ..SimulationSettings::default()
        };
        let report = simulated(&question, &settings);
        assert_eq!(report.end, SimulationEnd::Over, "{n}");
        assert!(!report.events.is_empty());
        let met = report
            .events
            .iter()
            .all(|of| of.event == Happened::Singular);
        assert!(
            met && (report.events[0].time - time).abs() < 1e-6,
            "{:?}",
            report.events
        );
        for row in rows(case).iter().filter(|row| row[0] <= 5.0) {
            near(&at(&report, row[0], &["v0"]), &[-row[1]], 1e-6);
        }
    }
}

const BRICARD: &str = r#"Axes(version: 1, name: "Bricard", gravity: (0, -9.81, 0),
    joints: {
        "j0": Revolute(point: (0, 0, 0), direction: (0, 1, 0), between: ("ground", "b1"), role: Actuated),
        "j1": Revolute(point: (1, 0, 0), direction: (0, 0, 1), between: ("b1", "b2")),
        "j2": Revolute(point: (1, -1, 0), direction: (1, 0, 0), between: ("b2", "b3")),
        "j3": Revolute(point: (1, -1, 1), direction: (0, 1, 0), between: ("b3", "b4")),
        "j4": Revolute(point: (0, -1, 1), direction: (0, 0, 1), between: ("b4", "b5")),
        "j5": Revolute(point: (0, 0, 1), direction: (1, 0, 0), between: ("b5", "ground")),
    },
    points: {
        "m1": (body: "b1", at: (0.5, 0, 0)), "m2": (body: "b2", at: (1, -0.5, 0)), "m3": (body: "b3", at: (1, -1, 0.5)),
        "m4": (body: "b4", at: (0.5, -1, 1)), "m5": (body: "b5", at: (0, -0.5, 1)),
        "P2": (body: "b2", at: (1, -1, 0)), "P3": (body: "b3", at: (1, -1, 1)),
    },
    masses: {
        "m1": (mass: 1, inertia: (0, "1/12", "1/12", 0, 0, 0)), "m2": (mass: 1, inertia: ("1/12", 0, "1/12", 0, 0, 0)),
        "m3": (mass: 1, inertia: ("1/12", "1/12", 0, 0, 0, 0)), "m4": (mass: 1, inertia: (0, "1/12", "1/12", 0, 0, 0)),
        "m5": (mass: 1, inertia: ("1/12", 0, "1/12", 0, 0, 0)),
    },
)"#;

#[test]
fn an_overconstrained_loop_falls() {
    let report = let_go(&question(BRICARD).point("P2").point("P3"), 5.0, 50);
    for row in rows(&known()["bricard"]) {
        near(
            &at(
                &report,
                row[0],
                &["P2.x", "P2.y", "P2.z", "P3.x", "P3.y", "P3.z"],
            ),
            &row[1..7],
            1e-6,
        );
    }
    assert!(report.energy.error < 1e-8);
}

#[test]
fn a_stiff_governor_is_simulated_by_implicit_steps() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/mechanisms/loads/flyball_governor.ron"
    );
    let question =
        Question::new(linkwork::load(folder).unwrap()).rate("spin", std::f64::consts::TAU);
    let report = let_go(&question, 1.0, 10);
    for row in rows(&known()["governor"])
        .iter()
        .filter(|row| row[0] <= 1.0)
    {
        near(&at(&report, row[0], &["s"]), &row[1..2], 1e-6);
    }
    assert!(report.stiff);
}

#[test]
fn a_platform_rests_on_its_springs() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/mechanisms/three_rps.ron"
    ))
    .unwrap();
    let spring =
        |i: usize| format!(r#""k{i}": Spring(joint: "l{i}", stiffness: 2000, rest: 0.8),"#);
    let loads = (1..=3).map(spring).collect::<String>();
    let end = text.rfind(')').unwrap();
    let text = format!(
        r#"{}    gravity: (0, 0, -9.81), masses: {{ "top": (mass: 20, centre: (0.05, -0.03, 0.02)) }}, loads: {{ {loads} }},
)"#,
        &text[..end]
    );
    let report = rest(&question(&text), false);
    let [position] = &report.positions[..] else {
        panic!("{report:?}");
    };
    let known = &known()["three_rps"];
    let numbers = |of: &Value| {
        of.as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect::<Vec<f64>>()
    };
    let lengths = ["l1", "l2", "l3"].map(|name| *position.joints.get(name).unwrap());
    near(&lengths, &numbers(&known["leg_lengths"]), 1e-8);
    let top = position.platforms.get("top").unwrap();
    near(
        &top.frame.position,
        &numbers(&known["position_of_platform_origin"]),
        1e-8,
    );
    near(
        &[position.potential],
        &[known["energy"].as_f64().unwrap()],
        1e-6,
    );
    assert_eq!(position.stability, Stability::Stable);
    assert_eq!(position.modes.len(), 3);
}

#[test]
fn rest_positions_of_a_pendulum_and_what_has_none() {
    // a rod on a pin: it hangs, with ω² = 3g/(2l), or stands and departs at that rate
    let pendulum = |masses: &str| {
        question(&format!(
            r#"Axes(version: 1, name: "pendulum", gravity: (0, -9.81, 0),
                joints: {{ "pin": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("ground", "rod"), role: Actuated) }},
                points: {{ "middle": (body: "rod", at: (1, 0, 0)) }}, masses: {{ {masses} }})"#
        ))
    };
    let rod = pendulum(r#""middle": (mass: 3, shape: Rod(2))"#);
    let report = rest(&rod, true);
    let [hangs, stands] = &report.positions[..] else {
        panic!("{report:?}");
    };
    let pace = (3.0 * 9.81 / 4.0f64).sqrt();
    near(
        &[
            hangs.modes[0].frequency.unwrap() * std::f64::consts::TAU,
            stands.modes[0].departure.unwrap(),
        ],
        &[pace, pace],
        1e-6,
    );
    assert_eq!(
        (hangs.stability, stands.stability),
        (Stability::Stable, Stability::Unstable { directions: 1 })
    );
    assert_eq!(
        rest(&rod.clone().lock("pin"), false).none,
        Some(NoRest::Structure)
    );
    let falling = r#"Axes(version: 1, name: "stone", gravity: (0, -9.81, 0),
        joints: { "s": Prismatic(point: (0, 0, 0), direction: (0, 1, 0), between: ("ground", "stone"), role: Actuated) },
        points: { "m": (body: "stone", at: (0, 0, 0)) }, masses: { "m": (mass: 1) })"#;
    assert_eq!(rest(&question(falling), false).none, Some(NoRest::Endless));
    let massless = let_go(&pendulum(""), 1.0, 2);
    assert_eq!(
        massless.end,
        SimulationEnd::NotBegun(NoSimulation::NoMass(vec!["pin".into()]))
    );
    // T = 2π·√(2l/(3g))·(1 + θ²/16 + 11θ⁴/3072 + …) for a swing of θ = 0.1
    let swing = 0.1 - std::f64::consts::FRAC_PI_2;
    let period = std::f64::consts::TAU / pace * (1.0 + 0.01 / 16.0 + 11.0e-4 / 3072.0);
    let report = let_go(&rod.hold("pin", swing), period, 2);
    near(&at(&report, period, &["pin"]), &[swing], 1e-7);
}

/// The number of extremes of a function of an angle, on a fine grid.
fn extremes(energy: impl Fn(f64) -> f64) -> usize {
    const COUNT: usize = 20_000;
    let angle = |i: usize| (i as f64 + 0.37) * std::f64::consts::TAU / COUNT as f64;
    let values: Vec<f64> = (0..COUNT).map(|i| energy(angle(i))).collect();
    let next = |i: usize| values[(i + 1) % COUNT];
    let turns =
        |i: &usize| (next(*i) - values[*i] > 0.0) != (next((i + 1) % COUNT) - next(*i) > 0.0);
    (0..COUNT).filter(turns).count()
}

/// As many as the energy has extremes along the curve, computed by formulas of its own; a torsion spring leaves random starts.
#[test]
fn rest_positions_are_all_that_there_are() {
    const G: f64 = 9.81;
    let arm = |more: &str| {
        question(&format!(
            r#"Mechanism(version: 1, name: "arms", convention: Modified, gravity: (0, -9.81, 0),
                joints: {{ "a": Actuated(), "b": Actuated() }},
                chains: {{ "arm": Chain(rows: [(theta: "a", link: "upper"), (a: 1, theta: "b", link: "lower")]) }},
                masses: {{ "upper": (mass: 1, centre: (0.6, 0, 0), inertia: 0.1),
                    "lower": (mass: 2, centre: (0.7, 0.1, 0), inertia: 0.1) }}, {more})"#
        ))
    };
    // each of two pendulums hangs or stands; generic terms of a, b and a + b have 2! times the area of the hexagon of their
    // exponents (Bernstein 1975)
    let report = rest(&arm(""), true);
    let complete = report.complete.as_ref().unwrap();
    assert_eq!(
        (report.positions.len(), complete.generic, complete.real),
        (4, 6, 4)
    );
    let below = |of: &RestPosition| match of.stability {
        Stability::Stable => 0,
        Stability::Unstable { directions } => directions,
        Stability::Undecided { .. } => panic!(),
    };
    assert_eq!(
        report.positions.iter().map(below).collect::<Vec<_>>(),
        [0, 1, 1, 2]
    );
    let torsion = arm(r#"loads: { "coil": Spring(joint: "b", stiffness: 1) }"#);
    let report = rest(&torsion, true);
    assert_eq!((report.complete, report.starts), (None, 40));
    assert_eq!(
        report.not_algebraic,
        Some(NotAlgebraic::TorsionSpring("coil".into()))
    );
    // a rod of 1 m, 1 kg at its end, on two springs: rest positions come and go with their stiffness
    let mut counts = Vec::new();
    for (k, free) in [(3.0, 1.0), (12.0, 1.0), (60.0, 1.0), (60.0, 1.5)] {
        let rod = question(&format!(
            r#"Mechanism(version: 1, name: "rod", convention: Modified, gravity: (0, -9.81, 0),
                joints: {{ "a": Actuated(home: 1.3) }},
                chains: {{ "rod": Chain(rows: [(theta: "a", link: "bar")], tip: [Tx(1)]) }},
                masses: {{ "rod": (mass: 1) }},
                loads: {{ "left": Spring(between: ("rod", "ground+-1.5,1,0"), stiffness: {k}, length: {free}),
                    "right": Spring(between: ("rod", "ground+1.6,1,0"), stiffness: {k}, length: {free}) }})"#
        ));
        let spring = |angle: f64, x: f64| {
            let stretch = (x - angle.cos()).hypot(1.0 - angle.sin()) - free;
            0.5 * k * stretch * stretch
        };
        let energy = |angle: f64| G * angle.sin() + spring(angle, -1.5) + spring(angle, 1.6);
        let report = rest(&rod, true);
        assert_eq!(report.complete.as_ref().unwrap().multiple, 0, "{k}");
        assert_eq!(report.positions.len(), extremes(energy), "{k}");
        counts.push(report.positions.len());
    }
    assert_eq!(counts, [2, 4, 2, 6]);
    // dE has as many zeros as poles on the complex curve of a four-bar: two at each of six points at infinity
    let branch = |side: f64| {
        move |theta: f64| {
            let (x, y) = (0.1 * theta.cos(), 0.1 * theta.sin());
            let (dx, dy) = (0.38 - x, -y);
            let apart = dx.hypot(dy);
            let along = (apart * apart + 0.09 - 0.04) / (2.0 * apart);
            let coupler = dy.atan2(dx) + side * (along / 0.3).acos();
            let pin = y + 0.3 * coupler.sin();
            let coupler = coupler + 15f64.to_radians();
            let crank = 0.03 * (theta + 30f64.to_radians()).sin();
            G * (0.6 * crank + 2.0 * (y + 0.16 * coupler.sin()) + 1.5 * pin / 2.0)
        }
    };
    let report = rest(&four_bar(""), true);
    let expected = extremes(branch(1.0)) + extremes(branch(-1.0));
    let complete = report.complete.as_ref().unwrap();
    assert_eq!((report.positions.len(), complete.generic), (expected, 12));
}

/// Shipped files close as they are given, and what rests does so within its limits; a softer spring does not hold the wheel.
#[test]
fn shipped_mechanisms_close_as_given_and_rest_within_their_limits() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/loads");
    let outside = |question: &Question| -> Vec<String> {
        let report = rest(question, false);
        let positions = report.positions.iter();
        positions.flat_map(|of| of.outside_limits.clone()).collect()
    };
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "ron") {
            continue;
        }
        let question = Question::new(linkwork::load(&path).unwrap());
        assert_eq!(outside(&question), [""; 0], "{}", path.display());
        let pose = rest(&question, false).pose;
        assert!(pose.moved.is_none(), "{}: {pose:?}", path.display());
        count += 1;
    }
    assert!(count >= 11);
    let wishbone = std::fs::read_to_string(format!("{folder}/wishbone.ron")).unwrap();
    let soft = wishbone.replace("80 N/mm", "35 N/mm");
    assert_ne!(soft, wishbone);
    assert_eq!(outside(&question(&soft)), ["lower"]);
}
