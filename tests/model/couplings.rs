//! Joints that follow others by polynomials and other expressions. What is right follows by hand.
#![cfg(feature = "interchange")]

use linkwork::analysis::assembly::AssemblySettings;
use linkwork::analysis::convert::to_axes;
use linkwork::analysis::frames::{FramesSettings, frames, joint_axes};
use linkwork::ask::{Question, Solved};
use linkwork::description::{AxesDescription, Description};
use linkwork::interchange::{ImportSettings, NotRead, import, tree_of, write_mjcf};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

/// A column steers two wheels; the left one is written from −0.2, and by a tendon the plough follows the sum of both wheels.
const AXLE: &str = r#"<mujoco model="axle"><compiler angle="radian"/><worldbody>
<body name="column"><joint name="steer" axis="0 0 1"/><geom size="1"/></body>
<body name="left" pos="0.4 0.3 0"><joint name="left" axis="0 0 1" ref="-0.2"/><geom size="1"/></body>
<body name="right" pos="0.4 -0.3 0"><joint name="right" axis="0 0 1"/><geom size="1"/></body>
<body name="plough" pos="-0.4 0 0"><joint name="plough" type="slide" axis="0 0 1"/><geom size="1"/></body>
</worldbody>
<tendon><fixed name="sum"><joint joint="left" coef="1"/><joint joint="right" coef="1"/></fixed>
<fixed name="depth"><joint joint="plough" coef="10"/></fixed></tendon>
<equality><joint joint1="left" joint2="steer" polycoef="0.05 1 0.3 0.2 -0.1"/>
<joint joint1="right" joint2="steer" polycoef="0 0.9 -0.3"/>
<tendon tendon1="depth" tendon2="sum" polycoef="0.01 0.5 0 0.25 0"/></equality>
<actuator><position joint="steer"/></actuator></mujoco>"#;

fn read(text: &str) -> Question {
    let no_files = |_: &str| Err(NotRead::Failed("there are no files here".into()));
    let imported = import("file", text, &no_files, None, &ImportSettings::default());
    let imported = imported.unwrap_or_else(|wrong| panic!("{:?}", wrong.lines()));
    mechanism(&imported.description.to_ron().unwrap())
}

fn mechanism(ron: &str) -> Question {
    let description = Description::read(ron).unwrap_or_else(|wrong| panic!("{ron}\n{wrong:?}"));
    let mechanism = Mechanism::new(&description).unwrap_or_else(|wrong| panic!("{ron}\n{wrong:?}"));
    Question::new(mechanism)
}

/// The values of joints of what must be assembled.
fn values<const N: usize>(question: &Question, names: [&str; N]) -> [f64; N] {
    let report = match question.solve(&AssemblySettings::default(), &Watch::none()) {
        Ok(Solved::Ended(report)) => *report,
        other => panic!("{other:?}"),
    };
    assert!(report.is_assembled(), "{:?}", report.outcome);
    names.map(|name| {
        *report
            .joints
            .get(name)
            .or(report.outputs.get(name))
            .unwrap()
    })
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} and {b}");
}

fn left(x: f64) -> f64 {
    -0.2 + 0.05 + x + 0.3 * x * x + 0.2 * x * x * x - 0.1 * x * x * x * x
}

#[test]
fn joints_follow_by_polynomials() {
    let question = read(AXLE);
    for steer in [0.0, 0.4, -0.7] {
        let found = values(
            &question.clone().hold("steer", steer),
            ["left", "right", "plough"],
        );
        let right = 0.9 * steer - 0.3 * steer * steer;
        near(found[0], left(steer));
        near(found[1], right);
        let sum = left(steer) + 0.2 + right;
        near(10.0 * found[2], 0.01 + 0.5 * sum + 0.25 * sum * sum * sum);
    }
    // backwards, through what follows; and beside it, where it does not follow
    let held = question.clone().hold("left", left(0.3)).free("steer");
    near(values(&held, ["steer"])[0], 0.3);
    let both = question
        .clone()
        .hold("steer", 0.3)
        .hold("left", left(0.3) + 1e-3);
    assert!(
        both.solve(&AssemblySettings::default(), &Watch::none())
            .is_err()
    );
}

#[test]
fn a_written_polynomial_reads_back_the_same() {
    let question = read(AXLE);
    let mechanism = question.mechanism();
    let (tree, _) = tree_of(mechanism, &mechanism.home());
    let (text, remarks) = write_mjcf(&tree, &[]);
    assert!(
        text.contains(r#"joint1="right" joint2="steer" polycoef="0 0.9 -0.3 0 0""#),
        "{text}"
    );
    assert!(
        remarks.iter().all(|remark| !remark.is_loss()),
        "{remarks:?}"
    );
    // the sum of two wheels is no polynomial of one joint
    let (_, lost) = tree_of(mechanism, &mechanism.home());
    let lost: Vec<String> = lost.iter().map(ToString::to_string).collect();
    assert!(lost.iter().any(|line| line.contains("plough")), "{lost:?}");
    let again = read(&text).hold("steer", 0.4);
    let [found] = values(&again, ["left"]);
    near(found, left(0.4));
}

/// A rocker that follows a crank by an expression, in a file of our own, and a pendulum that a four-bar drives through a cam.
#[test]
fn joints_follow_by_expressions() {
    let question = mechanism(
        r#"Mechanism(version: 1, name: "cams", convention: Modified,
            parameters: { "rise": "20 mm", "lobes": 3 },
            joints: { "cam": Actuated(home: 0), "lift": Passive(), "turn": Passive() },
            chains: {
                "shaft": Chain(rows: [(theta: "cam")]),
                "follower": Chain(base: [Tx(0.1)], rows: [(d: "lift")]),
                "table": Chain(base: [Tx(0.3)], rows: [(theta: "turn")]),
            },
            closures: {
                "cam": Coupling("lift - rise*(1 - cos(lobes*cam))/2"),
                "Geneva": Coupling("turn - atan2(0.5*sin(cam), 1 - 0.5*cos(cam))"),
            })"#,
    );
    for cam in [0.0f64, 0.3, 1.4, -2.0] {
        let [lift, turn] = values(&question.clone().hold("cam", cam), ["lift", "turn"]);
        near(lift, 0.01 * (1.0 - (3.0 * cam).cos()));
        near(turn, (0.5 * cam.sin()).atan2(1.0 - 0.5 * cam.cos()));
    }
    // a table stands further away than a Geneva wheel of half a crank reaches: 30°
    let beyond = question.clone().hold("turn", 0.6).free("cam");
    match beyond.solve(&AssemblySettings::default(), &Watch::none()) {
        Ok(Solved::Ended(report)) => assert!(!report.is_assembled()),
        other => panic!("{other:?}"),
    }
}

/// A steering whose wheels follow one another by a curve, in joint coordinates, as tables and back, and as axes of tables
/// on numbers: the right wheel follows from the left.
#[test]
fn joint_coordinates_have_couplings_too() {
    let text = r#"Axes(version: 1, name: "steering", parameters: { "gain": 0.4, "half": "0.7 m" },
        joints: {
            "left": Revolute(point: ("-half", 0, 0), direction: (0, 0, 1), between: ("ground", "left wheel"), role: Actuated),
            "right": Revolute(point: ("half", 0, 0), direction: (0, 0, 1), between: ("ground", "right wheel"), role: Passive),
        },
        couplings: { "Ackermann": "right - left - gain*left^2" })"#;
    let angle = |mechanism: &Mechanism| {
        let question = Question::new(mechanism.clone()).hold("left", 0.5);
        near(values(&question, ["left", "right"])[1], 0.5 + 0.4 * 0.25);
    };
    let axes = AxesDescription::read(text).unwrap();
    assert_eq!(
        AxesDescription::read(&axes.to_ron().unwrap()).unwrap(),
        axes
    );
    let tables = axes.tables().unwrap();
    let mechanism = Mechanism::new(&tables).unwrap();
    angle(&mechanism);
    let written = Description {
        coordinates: None,
        ..tables
    };
    let mechanism = Mechanism::new(&written).unwrap();
    let (again, _) = to_axes(&mechanism, &written).unwrap();
    assert_eq!(
        again.couplings[0].value.expression,
        axes.couplings[0].value.expression
    );
    angle(&Mechanism::new(&again.tables().unwrap()).unwrap());
    let numbers = joint_axes(&mechanism, &mechanism.home()).unwrap();
    assert_eq!(numbers.parameters.len(), 1);
    let placed = frames(&numbers, &FramesSettings::default()).unwrap();
    angle(&Mechanism::new(&placed.description).unwrap());
    // a name that no joint has
    let wrong = text.replace("gain*left^2", "gain*middle^2");
    let tables = AxesDescription::read(&wrong).unwrap().tables().unwrap();
    let problems = Mechanism::new(&tables).unwrap_err();
    assert!(problems[0].kind.title().contains("middle"), "{problems:?}");
}

#[test]
fn a_coupling_of_no_joint_is_refused() {
    let text = r#"Mechanism(version: 1, name: "c", convention: Modified, joints: { "a": Actuated() }, parameters: { "b": 1 },
        chains: { "arm": Chain(rows: [(theta: "a")]) }, closures: { "c": Coupling("b - 1") })"#;
    let description = Description::read(text).unwrap();
    let problems = Mechanism::new(&description).unwrap_err();
    let titles: Vec<String> = problems
        .iter()
        .map(|problem| problem.kind.title())
        .collect();
    assert_eq!(titles, ["the coupling `c` contains no joint"]);
    for wrong in [
        "Coupling()",
        "Coupling(\"a\", \"b\")",
        "Coupling(\"a +\")",
        "Coupling(\"a - z\")",
    ] {
        let text = text.replace("Coupling(\"b - 1\")", wrong);
        let read = Description::read(&text);
        assert!(
            read.is_err() || Mechanism::new(&read.unwrap()).is_err(),
            "{wrong}"
        );
    }
}
