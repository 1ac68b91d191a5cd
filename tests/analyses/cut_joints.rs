//! Joints at which loops are cut have values like all others.

use linkwork::analysis::assembly::AssemblyReport;
use linkwork::analysis::convert::{ConvertSettings, convert, to_axes};
use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::{Question, Solved};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

/// A four-bar of lengths 1, √13, √10 and 4: the joint values follow from the law of cosines.
const PINS: &str = r#"Axes(version: 1, name: "four pins", joints: {
    "O": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, between: ("ground", "crank")),
    "A": Revolute(point: (1, 0, 0), direction: (0, 0, 1), between: ("crank", "coupler")),
    "B": Revolute(point: (3, 3, 0), direction: (0, 0, 1), between: ("coupler", "rocker")),
    "C": Revolute(point: (4, 0, 0), direction: (0, 0, 1), between: ("ground", "rocker")),
})"#;

/// A, B and C at O = 60° on the branch of the drawing, in degrees.
const AT_60: [(&str, f64); 3] = [("A", -78.187691), ("B", 11.86492), ("C", -6.322771)];

fn built(text: &str) -> Mechanism {
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

fn solved(question: &Question) -> AssemblyReport {
    let report = near(question);
    assert!(report.is_assembled());
    report
}

fn near(question: &Question) -> AssemblyReport {
    let solved = question.solve(&Default::default(), &Watch::none());
    match solved.unwrap() {
        Solved::Ended(report) => *report,
        Solved::Lost(lost) => panic!("{lost:?}"),
    }
}

fn degrees(report: &AssemblyReport, joint: &str) -> f64 {
    report.joints.get(joint).unwrap().to_degrees()
}

fn assert_near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() < tolerance, "{found}, not {wanted}");
}

/// The file cut at another joint.
fn cut_at(joint: &str) -> String {
    PINS.replace("joints: {", &format!("cut: [\"{joint}\"], joints: {{"))
}

#[test]
fn every_joint_has_its_value_wherever_the_loop_is_cut() {
    for cut in ["A", "B", "C"] {
        let question = Question::new(built(&cut_at(cut))).hold("O", "60 deg");
        let report = solved(&question);
        assert_eq!(report.cut, [cut]);
        for (joint, value) in AT_60 {
            assert_near(degrees(&report, joint), value, 1e-5);
        }
        // the configuration has the variables alone, and is where it was
        let again = solved(&question.clone().near(report.configuration()));
        assert_near(degrees(&again, "B"), 11.86492, 1e-5);
        let modes = question
            .assemblies(Default::default(), &Watch::none())
            .unwrap();
        let b = modes
            .assemblies
            .iter()
            .map(|of| of.joints.get("B").unwrap().to_degrees());
        assert!(b.into_iter().any(|b| (b - 11.86492).abs() < 1e-5));
    }
}

#[test]
fn a_joint_that_is_cut_can_be_held_and_moved() {
    let free = Question::new(built(PINS)).free("O");
    let held = solved(&free.clone().hold("B", "10 deg"));
    assert_near(degrees(&held, "O").abs(), 54.358964449, 1e-7);
    assert_near(degrees(&held, "B"), 10.0, 1e-12);
    // between crank and rocker are 3 to 5 m: B turns by 42.9° at most
    let far = free.clone().hold("B", "50 deg");
    let report = near(&far);
    assert!(!report.is_assembled());
    let moved = free.guess("O", "20 deg").input("B", "2 deg", "10 deg");
    let motions = moved.motions(&SweepSettings::default(), &Watch::none());
    let report = motions.unwrap().report(10, &mut |_, _| {}, &Watch::none());
    let motion = &report.motions[0];
    let column = |name: &str| {
        motion
            .columns
            .iter()
            .position(|of| of.name == name)
            .unwrap()
    };
    let last = motion.values.last().unwrap();
    assert_near(last[column("B")].unwrap().to_degrees(), 10.0, 1e-9);
    assert_near(last[column("O")].unwrap().to_degrees(), 54.358964449, 1e-6);
}

#[test]
fn a_cut_joint_has_its_drawn_value_and_its_limits() {
    let drawn = cut_at("B").replace(
        "direction: (0, 0, 1), between: (\"coupler\", \"rocker\")",
        "direction: (0, 0, 1), drawn: \"30 deg\", between: (\"coupler\", \"rocker\")",
    );
    let report = solved(&Question::new(built(&drawn)).hold("O", "60 deg"));
    assert_near(degrees(&report, "B"), 41.86492, 1e-5);
    let limited = cut_at("B").replace(
        "direction: (0, 0, 1), between: (\"coupler\", \"rocker\")",
        "direction: (0, 0, 1), limits: (\"-5 deg\", \"5 deg\"), between: (\"coupler\", \"rocker\")",
    );
    let mechanism = built(&limited);
    assert!(mechanism.warnings().is_empty());
    let report = near(&Question::new(mechanism).hold("O", "60 deg"));
    let b = report.variables.iter().find(|of| of.name == "B").unwrap();
    assert!(!b.within_limits);
    assert_near(degrees(&report, "B"), 11.86492, 1e-5);
}

#[test]
fn a_driven_joint_may_be_cut() {
    let driven = cut_at("B").replace("role: Actuated, ", "").replace(
        "direction: (0, 0, 1), between: (\"coupler\", \"rocker\")",
        "direction: (0, 0, 1), role: Actuated, home: \"10 deg\", drawn: 0, between: (\"coupler\", \"rocker\")",
    );
    let report = solved(&Question::new(built(&driven)));
    assert_eq!(report.held, ["B"]);
    assert_near(degrees(&report, "O").abs(), 54.358964449, 1e-7);
}

#[test]
fn a_joint_that_follows_another_may_be_cut() {
    // two gears on one bar: B turns by twice as much as A the other way, wherever the ring of three bodies is cut
    let gears = |cut: &str| {
        format!(
            r#"Axes(version: 1, name: "gears", cut: ["{cut}"], joints: {{
                "A": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, between: ("ground", "one")),
                "B": Revolute(point: (1, 0, 0), direction: (0, 0, 1), value: "-2*A", between: ("one", "two")),
                "C": Planar(point: (3, 0, 0), direction: (0, 0, 1), between: ("ground", "two")),
            }})"#
        )
    };
    for cut in ["A", "B"] {
        let report = solved(&Question::new(built(&gears(cut))).hold("A", "20 deg"));
        let two = report
            .frames
            .get("two")
            .or(report.platforms.get("two").map(|of| &of.frame));
        let [x, ..] = two.unwrap().rotation;
        assert_near(x[0], (-20_f64).to_radians().cos(), 1e-9);
    }
}

#[test]
fn tables_measure_a_closure_and_another_cut_keeps_the_value() {
    let text = std::fs::read_to_string("mechanisms/four_bar.ron").unwrap();
    let description = Description::read(&text).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let names = mechanism.cut_joints();
    let before = solved(&Question::new(mechanism.clone()).hold("theta1", "70 deg"));
    for joint in ["phi2", "phi1"] {
        let settings = ConvertSettings {
            cut: Some(joint.into()),
            ..ConvertSettings::default()
        };
        let made = convert(&mechanism, &description, &settings).unwrap();
        let other = Mechanism::new(&made.description).unwrap();
        let is_cut = |of: &Mechanism, name: &str| of.closures().iter().any(|of| of.name == name);
        assert!(is_cut(&other, joint) && !is_cut(&other, &names[0]));
        let after = Question::new(other.clone()).hold("theta1", "70 deg");
        let after = after
            .assemblies(Default::default(), &Watch::none())
            .unwrap();
        // of the assemblies one is that of before, in all joints
        let same = after.assemblies.iter().any(|of| {
            let all = before.joints.0.iter();
            all.into_iter().all(|(name, value)| {
                let now = of.joints.get(name).unwrap();
                (now - value).sin().abs() < 1e-9 && (now - value).cos() > 0.0
            })
        });
        assert!(same, "{joint}: {:?} {:?}", before.joints, after.assemblies);
        assert!(names.iter().all(|name| other.joint(name).is_some()));
    }
}

#[test]
fn tables_declare_the_joint_of_a_closure_under_its_name() {
    let text = std::fs::read_to_string("mechanisms/four_bar.ron").unwrap();
    let name = built(&text).cut_joints()[0].clone();
    let declared = text.replacen(
        "joints: {",
        &format!("joints: {{ \"{name}\": Passive(limits: (\"-1 deg\", \"1 deg\")),"),
        1,
    );
    let plain = solved(&Question::new(built(&text)));
    let mechanism = built(&declared);
    assert!(mechanism.cut_joints().is_empty());
    let report = near(&Question::new(mechanism));
    let of = report.variables.iter().find(|of| of.name == name).unwrap();
    assert!(!of.within_limits && of.limits.is_some());
    assert_near(degrees(&report, &name), degrees(&plain, &name), 1e-9);
}

/// A crank of 1 and a rod of 3, cut anywhere.
#[test]
fn slides_that_are_cut_have_values_and_can_be_held() {
    let slider = |cut: &str| {
        format!(
            r#"Axes(version: 1, name: "slider", cut: ["{cut}"], joints: {{
                "O": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, between: ("ground", "crank")),
                "A": Revolute(point: (1, 0, 0), direction: (0, 0, 1), between: ("crank", "rod")),
                "B": Revolute(point: (4, 0, 0), direction: (0, 0, 1), between: ("rod", "piston")),
                "P": Prismatic(direction: (1, 0, 0), home: 4, between: ("ground", "piston")),
            }})"#
        )
    };
    // of a crank of 1 and a rod of 3
    let angle = 40_f64.to_radians();
    let wanted = angle.cos() + (9.0 - angle.sin().powi(2)).sqrt();
    for cut in ["P", "A", "B"] {
        let report = solved(&Question::new(built(&slider(cut))).hold("O", "40 deg"));
        assert_near(*report.joints.get("P").unwrap(), wanted, 1e-9);
        let held = Question::new(built(&slider(cut)))
            .free("O")
            .guess("O", "30 deg");
        let held = solved(&held.hold("P", wanted));
        assert_near(degrees(&held, "O").abs(), 40.0, 1e-6);
    }
}

/// Legs of a platform whose own frame stands askew, for a pose of another frame of it: distances between the points in base
/// and plate, computed with numpy.
const LEGS: [f64; 6] = [
    0.6845091013263247,
    0.5404873901120499,
    0.653640774266365,
    0.6416958045383443,
    0.6443883089325569,
    0.5448175271609121,
];

fn plate() -> Mechanism {
    let base = |k: usize| {
        format!(
            "[Rz(\"{} deg\"), T(0.5, {}, 0)]",
            120 * (k / 2),
            [0.1, -0.1][k % 2]
        )
    };
    let turns = [60, -60, 180, 60, 300, 180];
    let point = |k: usize| {
        let back = "Rz(\"-25 deg\"), Rx(\"-40 deg\"), T(-0.02, -0.01, 0)";
        let y = [-0.05, 0.05][k % 2];
        let turn = turns[k];
        format!(
            "\"P{}\": [{back}, Rz(\"{turn} deg\"), T(0.3, {y}, 0)]",
            k + 1
        )
    };
    let list = |of: &dyn Fn(usize) -> String| (0..6).map(of).collect::<Vec<_>>().join(", ");
    let text = format!(
        r#"Mechanism(version: 1, name: "plate", convention: Modified, joints: {{ {} }}, chains: {{ {} }},
            platforms: {{ "plate": Platform(home: [T(0.02, 0.01, 0.5), Rx("40 deg"), Rz("25 deg")], frames: {{
                "tool": [Rz("-25 deg"), Rx("-40 deg"), T(-0.02, -0.01, 0.05)], {} }}) }},
            closures: {{ {} }})"#,
        list(&|k| format!("\"l{}\": Actuated(home: 0.6)", k + 1)),
        list(&|k| format!("\"B{}\": Chain(base: {})", k + 1, base(k))),
        list(&point),
        list(&|k| format!(
            "\"leg{0}\": Distance(\"B{0}\", \"plate.P{0}\", \"l{0}\")",
            k + 1
        )),
    );
    built(&text)
}

#[test]
fn a_frame_of_a_platform_has_angles_and_a_pose() {
    let free = Question::new(plate()).free("actuated");
    let whole = "[T(0.03, -0.02, 0.56), Rz(15 deg), Ry(-5 deg), Rx(10 deg)]";
    let parts = [
        ("x", "0.03"),
        ("y", "-0.02"),
        ("z", "0.56"),
        ("roll", "10 deg"),
        ("pitch", "-5 deg"),
        ("yaw", "15 deg"),
    ];
    let parts = parts.iter().fold(free.clone(), |question, (part, value)| {
        question.hold(format!("plate.tool.{part}"), *value)
    });
    for question in [free.clone().hold("plate.tool", whole), parts] {
        let report = solved(&question);
        for (k, length) in LEGS.iter().enumerate() {
            assert_near(
                *report.joints.get(&format!("l{}", k + 1)).unwrap(),
                *length,
                1e-12,
            );
        }
        let tool = report.frames.get("plate.tool").unwrap();
        assert_near(tool.position[2], 0.56, 1e-12);
    }
    // ground has no angles to hold, nor has a frame that is not there
    for name in ["ground.yaw", "plate.hand.yaw", "B1.yaw"] {
        let wrong = free.clone().hold(name, 0.1);
        assert!(
            wrong.solve(&Default::default(), &Watch::none()).is_err(),
            "{name}"
        );
    }
}

/// The coupler of a planar four-bar turns by O + A.
#[test]
fn a_link_has_an_angle_to_hold() {
    let turned = (60.0 - 78.187691_f64).to_radians();
    let question = Question::new(built(PINS)).free("O").guess("O", "50 deg");
    let report = solved(&question.hold("coupler.yaw", turned));
    assert_near(degrees(&report, "O"), 60.0, 1e-4);
}

/// A loop of seven freedoms; the axes of its universal joints are askew, one of them written with a parameter.
const UNIVERSALS: &str = r#"Axes(version: 1, name: "two universals", parameters: { "c": 0.6 }, joints: {
    "A": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, between: ("ground", "crank")),
    "U": Universal(point: (0.1, 0, 0), directions: ((0, "c", 0.8), (1, 0, 0)), between: ("crank", "rod")),
    "V": Universal(point: (0.3, 0.4, 0.2), directions: ((0.36, 0.48, -0.8), (0.8, -0.6, 0)), between: ("rod", "slider")),
    "P": Cylindrical(point: (0.6, 0.1, 0), direction: (0, 0.2, 1), between: ("ground", "slider")),
})"#;

#[test]
fn a_universal_joint_has_the_values_of_its_drawing_wherever_the_loop_is_cut() {
    let cut =
        |joint: &str| UNIVERSALS.replace("joints: {", &format!("cut: [\"{joint}\"], joints: {{"));
    let names = ["U_1", "U_2", "V_1", "V_2"];
    let drawn = solved(&Question::new(built(&cut("U"))));
    for name in names {
        assert_near(degrees(&drawn, name), 0.0, 1e-9);
    }
    let at = |joint: &str| solved(&Question::new(built(&cut(joint))).hold("A", "25 deg"));
    let whole = at("P");
    for (cut, name) in ["U", "V"]
        .iter()
        .flat_map(|cut| names.map(|name| (cut, name)))
    {
        assert_near(degrees(&at(cut), name), degrees(&whole, name), 1e-7);
    }
    // tables, and coordinates made of these, measure it from the same zero
    let tables = Description {
        coordinates: None,
        ..Description::read(&cut("U")).unwrap()
    };
    let (axes, _) = to_axes(&Mechanism::new(&tables).unwrap(), &tables).unwrap();
    let again = Mechanism::new(&axes.tables().unwrap()).unwrap();
    let again = solved(&Question::new(again).hold("A", "25 deg"));
    for name in names {
        assert_near(degrees(&again, name), degrees(&whole, name), 1e-7);
    }
}

/// Rates and accelerations of all joints by name, in rad.
fn rates(question: &Question) -> Vec<(String, f64, f64)> {
    let found = question.velocity(&Watch::none()).unwrap().closed().unwrap();
    let all = found.joints.iter().chain(&found.cut);
    let all = all.map(|of| (of.name.clone(), of.rate.unwrap(), of.acceleration.unwrap()));
    let mut all: Vec<_> = all.collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

#[test]
fn joints_have_the_same_rates_wherever_the_loop_is_cut() {
    let pins = |cut: &str| Question::new(built(&cut_at(cut))).hold("O", "60 deg");
    let universals = |cut: &str| {
        let text = UNIVERSALS.replace("joints: {", &format!("cut: [\"{cut}\"], joints: {{"));
        Question::new(built(&text)).hold("A", "25 deg")
    };
    let near = |a: &[(String, f64, f64)], b: &[(String, f64, f64)]| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            assert_eq!(a.0, b.0);
            assert_near(a.1, b.1, 1e-8);
            assert_near(a.2, b.2, 1e-7);
        }
    };
    let driven = |question: Question, input: &str| {
        rates(&question.rate(input, 1.5).acceleration(input, -0.5))
    };
    let known = driven(pins("A"), "O");
    near(&driven(pins("B"), "O"), &known);
    near(&driven(pins("C"), "O"), &known);
    let known = driven(universals("P"), "A");
    near(&driven(universals("U"), "A"), &known);
    near(&driven(universals("V"), "A"), &known);
    // and they are the differences of values
    let values = |angle: f64| {
        let report = solved(&Question::new(built(&cut_at("B"))).hold("O", angle));
        *report.joints.get("B").unwrap()
    };
    let (at, h) = (60_f64.to_radians(), 1e-4);
    let slope = (values(at + h) - values(at - h)) / (2.0 * h);
    let b = driven(pins("B"), "O")
        .into_iter()
        .find(|of| of.0 == "B")
        .unwrap();
    assert_near(b.1, 1.5 * slope, 1e-7);
}
