//! Files of other programs as their users have them: names that are alike, coupled joints, constraints, and SDF. The files
//! are our own; what is right follows from trigonometry.
#![cfg(feature = "interchange")]

use linkwork::analysis::assembly::{AssemblyReport, AssemblySettings};
use linkwork::ask::{AskError, Question, Solved};
use linkwork::description::Description;
use linkwork::interchange::{ImportSettings, Imported, NotRead, import, tree_of, write_sdf};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::QuestionError;

fn read_with(text: &str, files: &dyn Fn(&str) -> Result<String, NotRead>) -> (Imported, Question) {
    let imported = import("file", text, files, None, &ImportSettings::default());
    let imported = imported.unwrap_or_else(|wrong| panic!("{:?}", wrong.lines()));
    // as it is written
    let ron = imported.description.to_ron().unwrap();
    let description = Description::read(&ron).unwrap_or_else(|wrong| panic!("{ron}\n{wrong:?}"));
    let mechanism = Mechanism::new(&description).unwrap_or_else(|wrong| panic!("{ron}\n{wrong:?}"));
    (imported, Question::new(mechanism))
}

fn no_files(_: &str) -> Result<String, NotRead> {
    Err(NotRead::Failed("there are no files here".into()))
}

fn read(text: &str) -> (Imported, Question) {
    read_with(text, &no_files)
}

fn refused(text: &str) -> String {
    match import("file", text, &no_files, None, &ImportSettings::default()) {
        Ok(_) => panic!("{text} was read"),
        Err(wrong) => wrong.lines().join("\n"),
    }
}

fn remarks(imported: &Imported) -> String {
    let lines: Vec<String> = imported.remarks.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

fn solved(question: &Question) -> AssemblyReport {
    match question.solve(&AssemblySettings::default(), &Watch::none()) {
        Ok(Solved::Ended(report)) => *report,
        Ok(Solved::Lost(_)) => panic!("the mode was lost"),
        Err(error) => panic!("{error:?}"),
    }
}

/// The value of a joint, or of an output that follows one, of what must be assembled.
fn value(report: &AssemblyReport, name: &str) -> f64 {
    assert!(report.is_assembled(), "{:?}", report.outcome);
    let found = report.joints.get(name).or(report.outputs.get(name));
    *found.unwrap_or_else(|| panic!("there is no {name}"))
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} and {b}");
}

fn freedoms(question: &Question) -> Option<usize> {
    solved(question).mobility
}

/// A spatial slider-crank: the distance of the ball of the crank from the pin of the slider is the rod.
fn slider_crank(ball: &str, constraint: &str, pin: f64) -> String {
    format!(
        r#"<mujoco><worldbody>
        <body name="crank"><joint name="crank" axis="0 0 1"/><geom size="1"/>
          <body name="rod" pos="0.12 0 0"><joint name="{ball}" type="ball"/><geom size="1"/></body></body>
        <body name="slider" pos="{pin} 0.04 0.03"><joint name="slide" type="slide" axis="1 0 0"/><geom size="1"/></body>
        </worldbody><equality><connect name="{constraint}" body1="slider" body2="rod" anchor="0 0 0"/></equality>
        <actuator><position joint="crank"/></actuator></mujoco>"#
    )
}

/// Bodies, joints and constraints of MJCF have names of their own each: however they are called, the rod ends at the slider.
#[test]
fn names_of_different_kinds_do_not_meet() {
    let (crank, pin) = (0.12, 0.4);
    let rod: f64 = ((pin - crank) * (pin - crank) + 0.04f64.powi(2) + 0.03f64.powi(2)).sqrt();
    let slide = |angle: f64| {
        let across = crank * angle.sin() - 0.04;
        crank * angle.cos() + (rod * rod - across * across - 0.03f64.powi(2)).sqrt() - pin
    };
    for (ball, constraint) in [
        ("ball", "pin"),
        ("rod", "rod"),
        ("crank_1", "rod"),
        ("slider", "slider"),
        ("rod_1", "rod"),
        ("rod", "rod_1"),
        ("slide_1", "slide"),
        ("crank_joint", "crank"),
    ] {
        let (_, question) = read(&slider_crank(ball, constraint, pin));
        for angle in [0.0, 0.5, -1.2] {
            let report = solved(&question.clone().hold("crank", angle));
            near(value(&report, "slide"), slide(angle));
        }
    }
    // where the slide runs 0.6 m beside the crank, the rod ends short of the other side
    let text = slider_crank("rod", "rod", 0.12).replace("0.04 0.03", "0.6 0.03");
    let (_, question) = read(&text);
    assert!(solved(&question.clone().hold("crank", 0.3)).is_assembled());
    assert!(!solved(&question.hold("crank", -1.5)).is_assembled());
}

/// A joint without a name is not the one that has the name it gets.
#[test]
fn joints_without_names_are_no_others() {
    let text = r#"<mujoco><worldbody>
        <body name="a"><joint axis="0 0 1"/><geom size="1"/>
          <body name="b" pos="1 0 0"><joint name="a_joint" axis="0 0 1"/><geom size="1"/>
          <site name="tip" pos="1 0 0"/></body></body></worldbody></mujoco>"#;
    let (_, question) = read(text);
    let names: Vec<&str> = question
        .mechanism()
        .joints()
        .iter()
        .map(|j| j.name.as_str())
        .collect();
    assert_eq!(names, ["a_joint_2", "a_joint"]);
}

fn fingers(motor: &str, polynomial: &str) -> String {
    format!(
        r#"<mujoco><worldbody>
        <body name="l" pos="0 0.03 0"><joint name="left" axis="1 0 0"/><geom size="1"/></body>
        <body name="r" pos="0 -0.03 0"><joint name="right" axis="1 0 0"/><geom size="1"/></body></worldbody>
        <equality><joint joint1="left" joint2="right" polycoef="{polynomial}"/></equality>
        <actuator><position joint="{motor}"/></actuator></mujoco>"#
    )
}

/// left = 0.2 − 4 right, whichever has the motor: both have values, can be held, guessed, moved and driven.
#[test]
fn a_coupled_joint_keeps_its_name() {
    for motor in ["left", "right"] {
        let (_, question) = read(&fingers(motor, "0.2 -4"));
        let driven = question.mechanism().joints();
        assert_eq!(
            driven.iter().map(|j| j.name.as_str()).collect::<Vec<_>>(),
            [motor]
        );
        assert_eq!(freedoms(&question), Some(1));
        for (name, held) in [("left", 0.6), ("right", -0.1)] {
            let report = solved(&question.clone().hold(name, held));
            near(value(&report, "left"), 0.6);
            near(value(&report, "right"), -0.1);
        }
        let turned = solved(&question.clone().hold("left", "90 deg"));
        near(
            value(&turned, "right"),
            (0.2 - std::f64::consts::FRAC_PI_2) / 4.0,
        );
        // what contradicts the coupling, and what is no angle
        let solve =
            |question: Question| question.solve(&AssemblySettings::default(), &Watch::none());
        assert!(solve(question.clone().hold("left", 0.6).hold("right", 0.3)).is_err());
        assert!(solve(question.clone().hold("left", "1 m")).is_err());
        assert!(solve(question.clone().hold("left", "360")).is_err());
        let rates = |name: &str, rate: &str| {
            let report = question.clone().hold(name, 0.1).rate(name, rate);
            let report = report.velocity(&Watch::none()).unwrap();
            report.closed().unwrap().joints[0].rate.unwrap()
        };
        let factor = if motor == "left" { 1.0 } else { -0.25 };
        near(rates("left", "2"), 2.0 * factor);
        near(rates("right", "2"), -8.0 * factor);
        // many rows of the follower are rows of the joint that leads
        let names = ["left".to_owned()];
        let many = question
            .solve_many(&names, &[0.6, 1.0], &Watch::none())
            .unwrap();
        let column = many.names.iter().position(|name| name == motor).unwrap();
        near(
            many.values[many.names.len() + column],
            if motor == "left" { 1.0 } else { -0.2 },
        );
    }
}

/// The power of a load is the same on the joint that follows and on the one that leads.
#[test]
fn a_load_on_a_coupled_joint_acts_by_its_factor() {
    let (_, question) = read(&fingers("left", "0.2 -4"));
    let report = question.load("right", "2").statics(&Watch::none()).unwrap();
    // right = (0.2 − left)/4
    let effort = serde_json::to_value(&report).unwrap().to_string();
    assert!(effort.contains("0.5"), "{effort}");
}

/// The hand of two links of 1 and 0.8 m, the second at 0.3 rad.
#[test]
fn a_joint_coupled_to_nothing_stands() {
    let text = |equality: &str| {
        format!(
            r#"<mujoco><worldbody><body name="u"><joint name="shoulder" axis="0 0 1"/><geom size="1"/>
        <body name="l" pos="1 0 0"><joint name="elbow" axis="0 0 1"/><geom size="1"/><site name="hand" pos="0.8 0 0"/>
        </body></body></worldbody><equality>{equality}</equality></mujoco>"#
        )
    };
    let lone = r#"<joint joint1="elbow" polycoef="0.3"/>"#;
    let settings = ImportSettings {
        frames: vec!["hand".into()],
        ..ImportSettings::default()
    };
    let imported = import("file", &text(lone), &no_files, None, &settings).unwrap();
    assert!(remarks(&imported).contains("joint `elbow` stands at 0.3 rad"));
    let question = Question::new(Mechanism::new(&imported.description).unwrap());
    let report = solved(&question.hold("shoulder", 0.5));
    let hand = report.frames.get("hand").unwrap().position;
    near(hand[0], 0.5f64.cos() + 0.8 * 0.8f64.cos());
    near(hand[1], 0.5f64.sin() + 0.8 * 0.8f64.sin());
    let twice = format!("{lone}{}", r#"<joint joint1="elbow" polycoef="0.4"/>"#);
    assert!(refused(&text(&twice)).contains("contradict one another"));
    // told twice it is still so
    read(&text(&format!("{lone}{lone}")));
}

/// L − L₀ = a₀ + a₁ (M − M₀), each length a sum over joints, counted from their references.
#[test]
fn tendons_along_joints_couple_them() {
    let text = |tendons: &str, equalities: &str| {
        format!(
            r#"<mujoco><compiler angle="radian"/><worldbody><body name="p"><joint name="a" axis="0 0 1" ref="0.1"/><geom size="1"/>
        <body name="m" pos="1 0 0"><joint name="b" axis="0 0 1"/><geom size="1"/>
        <body name="d" pos="1 0 0"><joint name="c" axis="0 0 1"/><geom size="1"/></body></body></body></worldbody>
        <tendon>{tendons}</tendon><equality>{equalities}</equality><actuator><position joint="a"/></actuator></mujoco>"#
        )
    };
    let tendons = r#"<fixed name="ab"><joint joint="a" coef="2"/><joint joint="b" coef="-0.5"/></fixed>
        <fixed name="c"><joint joint="c" coef="0.5"/></fixed>
        <fixed name="sum"><joint joint="a" coef="1"/><joint joint="b" coef="3"/></fixed>"#;
    let constraints =
        r#"<tendon tendon1="ab"/><tendon tendon1="c" tendon2="sum" polycoef="0.03 0.25"/>"#;
    let (_, question) = read(&text(tendons, constraints));
    assert_eq!(freedoms(&question), Some(1));
    let report = solved(&question.hold("a", 0.4));
    // 2 (a − 0.1) = b/2; c/2 = 0.03 + ((a − 0.1) + 3 b)/4
    let b = 4.0 * 0.3;
    near(value(&report, "b"), b);
    near(value(&report, "c"), 0.06 + 0.5 * (0.3 + 3.0 * b));
    // one constraint leaves two freedoms
    let (_, question) = read(&text(
        tendons,
        r#"<tendon tendon1="c" tendon2="sum" polycoef="0.03 0.25"/>"#,
    ));
    let report = solved(&question.hold("a", 0.4).hold("b", 0.2));
    near(value(&report, "c"), 0.06 + 0.5 * (0.3 + 0.6));
    let spatial = r#"<spatial name="s"/>"#;
    let text = text(
        &format!("{tendons}{spatial}"),
        r#"<tendon tendon1="ab" tendon2="s"/>"#,
    );
    assert!(refused(&text).contains("cannot read"));
}

/// A motor on a tendon along joints drives the first; what is not read is said.
#[test]
fn motors_on_tendons_drive_their_first_joint() {
    let text = fingers("left", "0 1").replace(
        r#"<position joint="left"/>"#,
        r#"<general tendon="split"/><general site="s"/></actuator>
        <tendon><fixed name="split" range="0 1"><joint joint="right" coef="0.5"/><joint joint="left" coef="0.5"/></fixed></tendon>
        <actuator>"#,
    );
    let (imported, question) = read(&text);
    let said = remarks(&imported);
    for words in [
        "the first joint of a driven tendon is actuated",
        "1 element ignored: `actuator without joint`",
        "1 element ignored: `range of a tendon`",
    ] {
        assert!(said.contains(words), "{said}");
    }
    let joints = question.mechanism().joints();
    assert_eq!((joints.len(), joints[0].name.as_str()), (1, "right"));
    assert_eq!(joints[0].role, linkwork::description::Role::Actuated);
}

/// ratio · Σ joints to the predecessor = Σ joints to the successor, from the link that carries both.
#[test]
fn couplings_of_urdf_relate_sums_of_joints() {
    let joint = |name: &str, parent: &str, child: &str, more: &str| {
        format!(
            r#"<joint name="{name}" type="continuous" {more}><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/></joint>"#
        )
    };
    let text = |ratio: &str| {
        format!(
            r#"<robot name="geared"><link name="base"/><link name="upper"/><link name="arm"/><link name="rotor"/>{}{}{}
        <coupling name="gears" type="rolling"><predecessor link="arm"/><successor link="rotor"/>{ratio}</coupling></robot>"#,
            joint("shoulder", "base", "upper", r#"independent="true""#),
            joint("elbow", "upper", "arm", r#"independent="true""#),
            joint("motor", "base", "rotor", r#"independent="false""#),
        )
    };
    let (imported, question) = read(&text(r#"<ratio value="6"/>"#));
    assert!(remarks(&imported).contains("not independent are passive"));
    assert_eq!(freedoms(&question), Some(2));
    let report = solved(&question.hold("shoulder", 0.2).hold("elbow", 0.1));
    near(value(&report, "motor"), 6.0 * 0.3);
    assert!(refused(&text("")).contains("has no element `ratio`"));
}

/// A four-bar: ground 0.5, crank 0.2 drawn at 1.2 rad, rocker pinned at the origin of its frame; the coupler's pin C is in
/// the ground at (0.4, 0.05), or where `C` puts it, when it is drawn.
fn four_bar(angle: f64) -> [f64; 2] {
    let pin = |at: f64| [0.2 * f64::cos(at), 0.2 * f64::sin(at)];
    let drawn = pin(1.2);
    let c = [drawn[0] + 0.4, drawn[1] + 0.05];
    let far = |a: [f64; 2], b: [f64; 2]| f64::hypot(a[0] - b[0], a[1] - b[1]);
    let (coupler, rocker) = (far(drawn, c), far([0.5, 0.0], c));
    let at = pin(1.2 + angle);
    // by the law of cosines, on the side where it is drawn
    let between = far(at, [0.5, 0.0]);
    let along = f64::atan2(-at[1], 0.5 - at[0]);
    let cos = |a: f64, b: f64, c: f64| (a * a + b * b - c * c) / (2.0 * a * b);
    let up = along + cos(coupler, between, rocker).acos();
    let end = [at[0] + coupler * up.cos(), at[1] + coupler * up.sin()];
    let turn = |from: [f64; 2], of: [f64; 2], to: [f64; 2], then: [f64; 2]| {
        let angle = |a: [f64; 2], b: [f64; 2]| f64::atan2(b[1] - a[1], b[0] - a[0]);
        angle(to, then) - angle(from, of)
    };
    let coupler = turn(drawn, c, at, end);
    [coupler - angle, turn([0.5, 0.0], c, [0.5, 0.0], end)]
}

fn urdf(pose: &str) -> String {
    format!(
        r#"<robot name="four_bar"><link name="base"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
        <joint name="A" type="continuous"><parent link="base"/><child link="crank"/><origin rpy="0 0 1.2"/><axis xyz="0 0 1"/></joint>
        <joint name="B" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0.2 0 0" rpy="0 0 -1.2"/><axis xyz="0 0 1"/></joint>
        <joint name="D" type="continuous"><parent link="base"/><child link="rocker"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/></joint>
        <gazebo><joint name="C" type="revolute"><parent>rocker</parent><child>coupler</child>{pose}<axis><xyz>0 0 1</xyz></axis></joint></gazebo></robot>"#
    )
}

/// The pose of a joint in a frame that is named is where the pose in the child is.
#[test]
fn joints_of_gazebo_are_given_relative_to_any_link() {
    let (x, y) = (0.2 * 1.2f64.cos() + 0.4, 0.2 * 1.2f64.sin() + 0.05);
    for pose in [
        "<pose>0.4 0.05 0 0 0 0</pose>".to_owned(),
        r#"<pose relative_to="coupler">0.4 0.05 0 0 0 0</pose>"#.to_owned(),
        r#"<pose relative_to="B">0.4 0.05 0 0 0 0</pose>"#.to_owned(),
        format!(r#"<pose relative_to="base">{x} {y} 0 0 0 0</pose>"#),
        format!(r#"<pose relative_to="__model__">{x} {y} 0 0 0 0</pose>"#),
        format!(
            r#"<pose relative_to="rocker">{} {y} 0 0 0 0</pose>"#,
            x - 0.5
        ),
    ] {
        let (imported, question) = read(&urdf(&pose));
        assert!(remarks(&imported).contains("all are passive, as loops are closed"));
        let report = solved(&question.hold("A", 0.1));
        let [b, d] = four_bar(0.1);
        near(value(&report, "B"), b);
        near(value(&report, "D"), d);
    }
    let wrong = refused(&urdf(
        r#"<pose relative_to="couplr">0.4 0.05 0 0 0 0</pose>"#,
    ));
    assert!(
        wrong.contains("there is no link `couplr` (did you mean `coupler`?)"),
        "{wrong}"
    );
}

const SDF_LINKS: &str = r#"<link name="crank"><pose>0 0 0 0 0 1.2</pose></link>
    <link name="coupler"><pose relative_to="B"/></link>
    <link name="rocker"><pose>0.5 0 0 0 0 0</pose></link>"#;
const SDF_JOINTS: &str = r#"<joint name="A" type="revolute"><parent>world</parent><child>crank</child>
      <axis><xyz>0 0 1</xyz><limit><lower>-3</lower><upper>1e16</upper></limit></axis></joint>
    <joint name="B" type="revolute"><pose relative_to="crank">0.2 0 0 0 0 -1.2</pose><parent>crank</parent><child>coupler</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
    <joint name="C" type="revolute"><pose>0.4 0.05 0 0 0 0</pose><parent>rocker</parent><child>coupler</child>
      <axis><xyz expressed_in="rocker">0 0 -1</xyz></axis></joint>
    <joint name="D" type="revolute"><parent>world</parent><child>rocker</child>
      <axis><xyz expressed_in="__model__">0 0 1</xyz></axis></joint>"#;

fn sdf(inside: &str) -> String {
    format!(
        r#"<?xml version="1.0"?><sdf version="1.9"><model name="four_bar">{inside}</model></sdf>"#
    )
}

fn closes(question: &Question, [a, b, d]: [&str; 3]) {
    assert_eq!(freedoms(question), Some(1));
    for angle in [0.1, -0.3] {
        let report = solved(&question.clone().hold(a, angle));
        let expected = four_bar(angle);
        near(value(&report, b), expected[0]);
        near(value(&report, d), expected[1]);
    }
}

#[test]
fn a_four_bar_of_sdf_closes_as_it_is_drawn() {
    let whole = sdf(&format!("{SDF_LINKS}{SDF_JOINTS}"));
    let (imported, question) = read(&whole);
    assert!(remarks(&imported).contains("the limit of joint `A` is left out: it has one only"));
    closes(&question, ["A", "B", "D"]);
    // the model elsewhere, and turned, is the same
    let placed = whole.replacen("<link", "<pose>1 2 3 0.1 0.2 0.3</pose><link", 1);
    let held = placed.replace("<parent>world</parent>", "<parent>ground</parent>");
    let held = held.replace(
        "</model>",
        r#"<frame name="ground"/><link name="ground_link"/></model>"#,
    );
    let fixed = r#"<joint name="F" type="fixed"><parent>world</parent><child>ground_link</child></joint></model>"#;
    let held = held.replace(
        r#"<frame name="ground"/>"#,
        r#"<frame name="ground" attached_to="ground_link"/>"#,
    );
    closes(&read(&held.replace("</model>", fixed)).1, ["A", "B", "D"]);
    // without a joint to the world the first link stands on it, and that is said
    let (imported, question) = read(&held);
    assert!(
        remarks(&imported).contains("no joint leads from the world to it"),
        "{}",
        remarks(&imported)
    );
    assert_eq!(freedoms(&question), Some(1));
    // a joint from child to parent turns the other way round its axis
    let back = whole
        .replace(
            "<parent>world</parent><child>crank</child>",
            "<parent>crank</parent><child>world</child>",
        )
        .replace(
            "<axis><xyz>0 0 1</xyz><limit>",
            "<axis><xyz>0 0 -1</xyz><limit>",
        );
    closes(&read(&back).1, ["A", "B", "D"]);
    // before version 1.7 joints and links may have one name
    let alike = whole
        .replace(r#"name="D""#, r#"name="rocker""#)
        .replace("1.9", "1.6");
    closes(&read(&alike).1, ["A", "B", "rocker"]);
    // an axis in another frame
    let turned = whole.replace(
        r#"<xyz expressed_in="rocker">0 0 -1</xyz>"#,
        r#"<xyz expressed_in="tilted">0 1 0</xyz>"#,
    );
    let tilted = r#"<frame name="tilted" attached_to="rocker"><pose>0 0 0 1.5707963267948966 0 0</pose></frame></model>"#;
    closes(
        &read(&turned.replace("</model>", tilted)).1,
        ["A", "B", "D"],
    );
    // with the pin of the rocker at (1, 0) the crank does not turn through
    let long = whole.replace("0.5 0 0 0 0 0", "1 0 0 0 0 0");
    assert!(!solved(&read(&long).1.hold("A", 2.0)).is_assembled());
    for (from, to, words) in [
        (
            "relative_to=\"crank\"",
            "relative_to=\"crnk\"",
            "there is no frame `crnk`",
        ),
        (
            "<child>rocker</child>",
            "<child>rockr</child>",
            "there is no frame `rockr`",
        ),
        (
            "<pose relative_to=\"B\"/>",
            "<pose relative_to=\"coupler\"/>",
            "cycle",
        ),
        (
            "type=\"revolute\"><parent>world",
            "type=\"hinge\"><parent>world",
            "unknown word `hinge`",
        ),
        ("name=\"D\"", "name=\"B\"", "there are two joints `B`"),
    ] {
        let said = refused(&whole.replacen(from, to, 1));
        assert!(said.contains(words), "{said}");
    }
}

/// The same four-bar with the crank in a model within, and with the rocker in another file.
#[test]
fn models_within_models_and_beside_them_are_one_mechanism() {
    let crank = r#"<link name="crank"><pose>0 0 0 0 0 1.2</pose></link>"#;
    let inner = format!(
        r#"<model name="drive"><pose>0 0 0.3 0 0 0</pose>{}</model>"#,
        crank.replace("0 0 0 0 0 1.2", "0 0 -0.3 0 0 1.2")
    );
    let joints = SDF_JOINTS
        .replace("<child>crank</child>", "<child>drive::crank</child>")
        .replace("<parent>crank</parent>", "<parent>drive::crank</parent>")
        .replace("relative_to=\"crank\"", "relative_to=\"drive::crank\"");
    let nested = sdf(&format!("{}{joints}", SDF_LINKS.replace(crank, &inner)));
    closes(&read(&nested).1, ["A", "B", "D"]);
    let rocker = r#"<link name="rocker"><pose>0.5 0 0 0 0 0</pose></link>"#;
    let include = r#"<include><uri>model://parts</uri><name>swing</name><pose>0.5 0 0 0 0 0</pose></include>"#;
    let joints = SDF_JOINTS
        .replace("rocker</parent>", "swing::rocker</parent>")
        .replace("rocker</child>", "swing</child>")
        .replace("expressed_in=\"rocker\"", "expressed_in=\"swing::rocker\"");
    let outer = sdf(&format!("{}{joints}", SDF_LINKS.replace(rocker, include)));
    let part = r#"<sdf version="1.6"><model name="any"><link name="rocker"/></model></sdf>"#;
    let files = |name: &str| match name {
        "parts/model.sdf" => Ok(part.to_owned()),
        _ => Err(NotRead::Failed("there is no such file".into())),
    };
    closes(&read_with(&outer, &files).1, ["A", "B", "D"]);
    assert!(refused(&outer).contains("`parts` cannot be included"));
    // a world around it, with its light
    let world = nested
        .replace(
            "<model name=\"four_bar\">",
            "<world name=\"w\"><include><uri>model://sun</uri></include><model name=\"four_bar\">",
        )
        .replace("</model></sdf>", "</model></world></sdf>");
    let (imported, question) = read(&world);
    closes(&question, ["A", "B", "D"]);
    assert!(remarks(&imported).contains("1 element ignored: `include`"));
    let outside = |_: &str| Err(NotRead::Outside);
    let wrong = import("file", &outer, &outside, None, &ImportSettings::default()).unwrap_err();
    assert!(wrong.lines()[0].contains("lies outside the folder"));
}

/// A joint that follows another, a universal joint, and a screw, whose travel is that of its thread.
#[test]
fn joints_of_sdf_follow_and_advance() {
    let text = sdf(
        r#"<link name="a"/><link name="b"/><link name="c"><pose>1 0 0 0 0 0</pose></link>
        <joint name="turn" type="revolute"><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>
        <joint name="twin" type="revolute"><parent>world</parent><child>b</child><axis><xyz>0 0 1</xyz>
          <mimic joint="turn" axis="axis"><multiplier>-2</multiplier><offset>0.1</offset><reference>0.05</reference></mimic></axis></joint>
        <joint name="screw" type="screw"><parent>a</parent><child>c</child><axis><xyz>1 0 0</xyz></axis>
          <screw_thread_pitch>0.01</screw_thread_pitch></joint>"#,
    );
    let (_, question) = read(&text);
    let report = solved(&question.hold("turn", 0.3).hold("screw", 2.0));
    near(value(&report, "twin"), 0.1 - 2.0 * (0.3 - 0.05));
    near(
        value(&report, "screw_slide"),
        2.0 * 0.01 / std::f64::consts::TAU,
    );
}

/// One line for all home values outside their limits; those within stay.
#[test]
fn home_values_outside_limits_are_moved_inside() {
    let joint = |name: &str, parent: &str, range: &str| {
        format!(
            r#"<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{name}"/><axis xyz="0 0 1"/><limit {range}/></joint><link name="{name}"/>"#
        )
    };
    let text = format!(
        r#"<robot name="r"><link name="base"/>{}{}{}</robot>"#,
        joint("a", "base", r#"lower="0.5" upper="1""#),
        joint("b", "a", r#"lower="-1" upper="-0.25""#),
        joint("c", "b", r#"lower="-1" upper="1""#),
    );
    let (imported, question) = read(&text);
    let said = "the home values of `a` and `b` are outside the limits: moved inside";
    assert_eq!(
        remarks(&imported).matches(said).count(),
        1,
        "{}",
        remarks(&imported)
    );
    let homes: Vec<f64> = question
        .mechanism()
        .joints()
        .iter()
        .map(|joint| joint.home)
        .collect();
    assert_eq!(homes, [0.5, -0.25, 0.0]);
    assert!(question.mechanism().warnings().is_empty());
}

/// What is written where it is assembled is assembled there when it is read, with all joints at 0, and as free.
#[test]
fn what_is_written_as_sdf_and_read_again_is_as_free() {
    for name in [
        "four_bar",
        "slider_crank",
        "five_bar",
        "three_rps",
        "stewart_gough_6sps",
        "rssr",
        "sarrus",
        "planar_3rpr",
        "three_fingered_hand_distances",
    ] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
        let path = path.join(format!("{name}.ron"));
        let mechanism = linkwork::load(&path).unwrap();
        let report = solved(&Question::new(mechanism.clone()));
        let (tree, known) = tree_of(&mechanism, &report.configuration());
        let (text, said) = write_sdf(&tree, &known);
        assert!(
            said.iter()
                .any(|remark| remark.to_string().contains("there all are at 0"))
        );
        let (_, question) = read(&text);
        let driven = |mechanism: &Mechanism| {
            let joints = mechanism.joints().iter();
            joints
                .filter(|joint| joint.role == linkwork::description::Role::Actuated)
                .count()
        };
        assert_eq!(driven(question.mechanism()), driven(&mechanism), "{name}");
        let again = solved(&question);
        assert!(again.is_assembled(), "{name}: {:?}", again.outcome);
        assert_eq!(again.mobility, report.mobility, "{name}\n{text}");
        assert!(
            again.joints.values().all(|value| value.abs() < 1e-6),
            "{name}: {:?}",
            again.joints
        );
    }
}

/// A bell crank and a rocker, joined by a rod with a ball at each end; the rod is written in three ways.
#[test]
fn rods_between_balls_are_distances() {
    let start = r#"<mujoco><compiler angle="radian"/><worldbody>
        <body name="bell"><joint name="bell" axis="0 0 1"/><geom size="1"/>"#;
    let middle = r#"</body><body name="rocker" pos="0.5 0 0.1"><joint name="rocker" axis="0 1 0"/><geom size="1"/></body>"#;
    let point = r#"<connect body1="rod" body2="rocker" anchor="0.3 0.1 0.2"/>"#;
    let end = r#"<actuator><position joint="bell"/></actuator></mujoco>"#;
    // at home the rod leads from (0.2, 0, 0.1) to (0.5, 0.1, 0.3)
    let rod = r#"<body name="rod" pos="0.2 0 0.1"><joint name="rod" type="ball"/><geom size="1"/></body>"#;
    let ball = format!("{start}{rod}{middle}</worldbody><equality>{point}</equality>{end}");
    let free = format!(
        r#"{start}{middle}<body name="rod" pos="0.2 0 0.1"><freejoint/><geom size="1"/></body></worldbody>
        <equality><connect body1="rod" body2="bell" anchor="0 0 0"/>{point}</equality>{end}"#
    );
    let squared: f64 = 0.3 * 0.3 + 0.1 * 0.1 + 0.2 * 0.2;
    for text in [&ball, &free] {
        let (imported, question) = read(text);
        assert!(remarks(&imported).contains("`rod` is a rod between two balls"));
        assert_eq!(question.mechanism().platforms().len(), 0);
        assert_eq!(freedoms(&question), Some(1));
        let bell: f64 = 0.25;
        let report = solved(&question.hold("bell", bell));
        let rocker = value(&report, "rocker");
        // the rocker's end is (0, 0.1, 0.2) from its axis
        let apart = [
            0.5 + 0.2 * rocker.sin() - 0.2 * bell.cos(),
            0.1 - 0.2 * bell.sin(),
            0.1 + 0.2 * rocker.cos() - 0.1,
        ];
        near(apart.iter().map(|x| x * x).sum(), squared);
    }
    // the frame of a rod that is asked for is there, and so is a rod with something on it
    let settings = ImportSettings {
        frames: vec!["rod".into()],
        ..ImportSettings::default()
    };
    let kept = import("file", &ball, &no_files, None, &settings).unwrap();
    assert_eq!(kept.description.platforms.len(), 1);
    let carried = r#"<joint name="rod" type="ball"/><body name="on" pos="0.1 0 0"><joint name="on" axis="0 0 1"/>
        <geom size="1"/></body>"#;
    let loaded = ball.replace(r#"<joint name="rod" type="ball"/>"#, carried);
    assert_eq!(read(&loaded).0.description.platforms.len(), 1);
}

/// A gearbox of SDF: the output turns against the frame by −ratio of what the input turns, whichever way their joints are
/// written. `twist` reverses the output's axis.
#[test]
fn gearboxes_of_sdf_couple_two_joints() {
    let text = |ratio: f64, z: f64| {
        format!(
            r#"  <?xml version="1.0"?><sdf version="1.9"><model name="gears"><link name="frame"/><link name="input"/>
            <link name="output"><pose>0.2 0 0 0 0 0</pose></link>
            <joint name="fixed" type="fixed"><parent>world</parent><child>frame</child></joint>
            <joint name="in" type="revolute"><parent>frame</parent><child>input</child><axis><xyz>0 0 1</xyz></axis></joint>
            <joint name="out" type="revolute"><parent>frame</parent><child>output</child>
              <axis><xyz>0 0 {z}</xyz></axis></joint>
            <joint name="gears" type="gearbox"><parent>input</parent><child>output</child>
              <gearbox_ratio>{ratio}</gearbox_ratio><gearbox_reference_body>frame</gearbox_reference_body>
              <axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint></model></sdf>"#
        )
    };
    for (ratio, z) in [(2.5, 1.0), (2.5, -1.0), (-0.4, 1.0)] {
        let (_, question) = read(&text(ratio, z));
        assert_eq!(freedoms(&question), Some(1));
        let report = solved(&question.hold("in", 0.3));
        near(value(&report, "out"), -ratio * 0.3 * z);
    }
    let oblique = text(2.5, 1.0).replace("<axis2><xyz>0 0 1", "<axis2><xyz>0 1 0");
    assert!(refused(&oblique).contains("gearbox `gears`"));
}

/// Many names that a mechanism file cannot have are told in one line.
#[test]
fn renamed_joints_are_told_in_one_line() {
    let bodies: String = (0..6)
        .map(|i| {
            format!(r#"<body name="l{i}" pos="0 {i} 0"><joint name="left/leg {i}" axis="0 0 1"/><geom size="1"/></body>"#)
        })
        .collect();
    let (imported, _) = read(&format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>"));
    let lines = remarks(&imported);
    let renamed: Vec<&str> = lines
        .lines()
        .filter(|line| line.contains("renamed"))
        .collect();
    assert_eq!(renamed.len(), 1, "{lines}");
    assert!(renamed[0].contains("and 3 more alike"), "{lines}");
}

/// A parallelogram with motors on both cranks: what is held twice must agree.
#[test]
fn joints_held_where_the_others_put_them_are_redundant() {
    let text = r#"<mujoco><compiler angle="radian"/><worldbody>
        <body name="left"><joint name="left" axis="0 0 1"/><geom size="1"/>
          <body name="bar" pos="0 0.2 0"><joint name="bar" axis="0 0 1"/><geom size="1"/></body></body>
        <body name="right" pos="0.5 0 0"><joint name="right" axis="0 0 1"/><geom size="1"/></body></worldbody>
        <equality><connect body1="bar" body2="right" anchor="0.5 0 0"/></equality>
        <actuator><position joint="left"/><position joint="right"/></actuator></mujoco>"#;
    let (_, question) = read(text);
    for angle in [0.0, 0.4, -1.0] {
        let report = solved(&question.clone().hold("left", angle).hold("right", angle));
        near(value(&report, "bar"), -angle);
        assert_eq!(report.redundant, ["right"]);
        assert_eq!(report.held, ["left", "right"]);
    }
    let apart = question.hold("left", 0.4).hold("right", 0.37);
    let error = apart.solve(&AssemblySettings::default(), &Watch::none());
    match error.map(|_| ()) {
        Err(AskError::Question(QuestionError::TooMany {
            mobility: 1,
            held: 2,
            free,
            apart: Some((joint, by, _)),
        })) => {
            assert_eq!((&free[..], &*joint), (&["right".to_owned()][..], "right"));
            near(by, 0.03);
        }
        other => panic!("{other:?}"),
    }
}

/// A joint that closes a loop has an axis, unless it needs none.
#[test]
fn a_loop_joint_without_an_axis_is_refused() {
    let text = |kind: &str| {
        format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
            <joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
            <joint name="k" type="continuous"><parent link="a"/><child link="c"/><axis xyz="0 0 1"/></joint>
            <loop_joint name="l" type="{kind}"><link1 link="b" xyz="1 0 0"/><link2 link="c" xyz="1 0 0"/></loop_joint>
            </robot>"#
        )
    };
    assert!(refused(&text("revolute")).contains("`axis`"));
    assert_eq!(read(&text("spherical")).0.description.closures.len(), 1);
}

/// Each copy is displaced against the one before, and names have its number, inner ones first; those of two digits where there
/// are ten.
#[test]
fn replicate_writes_displaced_copies() {
    let text = |inner: &str| {
        format!(
            r#"<mujoco><compiler angle="radian"/><worldbody><body name="hub"><joint name="hub"/>
            <replicate count="3" offset="0 0.5 0" euler="0 0 1.5707963267948966"><replicate {inner} offset="0 0 1">
            <body name="arm" pos="0 1 0"><joint name="arm"/></body></replicate></replicate></body></worldbody></mujoco>"#
        )
    };
    let settings = ImportSettings {
        all_frames: true,
        ..ImportSettings::default()
    };
    let imported = import("file", &text(r#"count="2""#), &no_files, None, &settings).unwrap();
    let report = solved(&Question::new(
        Mechanism::new(&imported.description).unwrap(),
    ));
    // turned by quarters and shifted along the turned y: (0, 1), (−1, ½), (−½, −½)
    for (frame, place) in [
        ("arm00", [0.0, 1.0, 0.0]),
        ("arm10", [0.0, 1.0, 1.0]),
        ("arm01", [-1.0, 0.5, 0.0]),
        ("arm12", [-0.5, -0.5, 1.0]),
    ] {
        let (_, found) = report.frames.0.iter().find(|of| of.0 == frame).unwrap();
        for (a, b) in found.position.iter().zip(place) {
            near(*a, b);
        }
    }
    let (_, question) = read(&text(r#"count="10" sep="_""#));
    let names = question.mechanism().joints().iter();
    let names: Vec<&str> = names.map(|joint| joint.name.as_str()).collect();
    assert!(
        names.contains(&"arm_070") && names.contains(&"arm_092"),
        "{names:?}"
    );
    assert!(refused(&text(r#"count="two""#)).contains("`two` is not a finite number"));
    assert!(refused(&text(r#"count="1000000000""#)).contains("so many copies"));
}

/// A weld that bears no torques holds a point; so a body of six freedoms keeps three.
#[test]
fn a_weld_without_torques_is_a_point() {
    let text = |scale: &str| {
        format!(
            r#"<mujoco><worldbody><body name="b" pos="1 0 0"><freejoint/></body></worldbody>
            <equality><weld body1="b" {scale} anchor="0 -2 0"/></equality></mujoco>"#
        )
    };
    let (_, question) = read(&text(r#"torquescale="0""#));
    assert_eq!(freedoms(&question), Some(3));
    assert_eq!(freedoms(&read(&text(r#"torquescale="0.1""#)).1), Some(0));
}

/// A keyframe that lacks the values of the last joints leaves these at their references.
#[test]
fn a_keyframe_may_lack_the_last_values() {
    let text = |values: &str| {
        format!(
            r#"<mujoco><compiler angle="radian"/><worldbody><body><joint name="a" ref="0.5"/><body pos="1 0 0"><joint name="b" ref="0.25"/></body></body></worldbody>
            <keyframe><key name="home" qpos="{values}"/></keyframe></mujoco>"#
        )
    };
    let (imported, question) = read(&text("0.1"));
    let homes = question.mechanism().joints().iter().map(|joint| joint.home);
    assert_eq!(homes.collect::<Vec<f64>>(), [0.1, 0.25]);
    assert!(
        remarks(&imported).contains("the last 1 of 2 values, which it lacks, are the references")
    );
    assert!(refused(&text("0.1 0.2 0.3")).contains("has 3 values, the joints have 2"));
}

/// An inertial that cannot be read is left out and told; how links move does not depend on it. A pose of a link is needed.
#[test]
fn inertials_that_cannot_be_read_are_left_out() {
    let inertial = "<inertial><pose>-0.01 -junk0.0001 -0.04 0 0 0</pose><mass>1</mass></inertial>";
    let text = sdf(&format!("{SDF_LINKS}{SDF_JOINTS}")).replacen(
        "</pose></link>",
        &format!("</pose>{inertial}</link>"),
        1,
    );
    let (imported, question) = read(&text);
    assert!(remarks(&imported).contains("1 element ignored: `inertial that no body has`"));
    closes(&question, ["A", "B", "D"]);
    assert!(
        refused(&text.replacen("0 0 0 0 0 1.2", "0 0 0 0 0 -junk1.2", 1))
            .contains("is not 6 finite numbers")
    );
    let heavy = r#"<link name="crank"><inertial><mass value="heavy"/></inertial></link>"#;
    let pose = "<pose>0.4 0.05 0 0 0 0</pose>";
    let (imported, _) = read(&urdf(pose).replace(r#"<link name="crank"/>"#, heavy));
    assert!(remarks(&imported).contains("1 element ignored: `inertial that no body has`"));
}

/// A joint may lead from the world without a link of that name; other links must be there.
#[test]
fn a_joint_of_urdf_may_lead_from_the_world() {
    let pose = "<pose>0.4 0.05 0 0 0 0</pose>";
    let text = urdf(pose)
        .replace(r#"<link name="base"/>"#, "")
        .replace(r#""base""#, r#""world""#);
    let report = solved(&read(&text).1.hold("A", 0.1));
    near(value(&report, "D"), four_bar(0.1)[1]);
    assert!(refused(&text.replace(r#""world""#, r#""wall""#)).contains("there is no link `wall`"));
}

/// Universal joints without axes turn about x and y of their frames, as the program of the format takes them, and without the
/// second about z. Other joints need their axis.
#[test]
fn universal_joints_of_sdf_may_lack_axes() {
    let text = |kind: &str, axes: &str| {
        sdf(&format!(
            r#"<link name="a"/><joint name="u" type="{kind}"><parent>world</parent><child>a</child>{axes}</joint>"#
        ))
    };
    let first = "<axis><xyz>1 0 0</xyz></axis>";
    for (axes, second) in [("", [0.0, 1.0, 0.0]), (first, [0.0, 0.0, 1.0])] {
        let (imported, question) = read(&text("universal", axes));
        assert!(remarks(&imported).contains("`u` lacks an axis"));
        let turned = |joint: &str| {
            let report = solved(&question.clone().hold(joint, 0.1));
            let (_, frame) = &report.frames.0[0];
            let [[_, a, b], [c, _, d], [e, f, _]] = frame.rotation;
            [f - d, b - e, c - a].map(|x| x / (2.0 * 0.1f64.sin()))
        };
        assert_eq!(turned("u").map(f64::round), [1.0, 0.0, 0.0]);
        assert_eq!(turned("u_2").map(f64::round), second);
    }
    assert!(refused(&text("revolute", "")).contains("has no element `axis`"));
}

/// A crank of 0.1 m driven by a slider that runs along (1, ½, 0) through (0, −0.1, 0), and a rod of 0.08 m: MuJoCo's length of the
/// transmission, p − √(r² − d²). The crank keeps its one freedom. A rod that does not reach the line drives nothing.
#[test]
fn slider_cranks_drive_by_their_sliders() {
    let text = |rod: f64| {
        format!(
            r#"<mujoco><worldbody><site name="line" pos="0 -.1 0" zaxis="1 .5 0"/>
            <body><joint name="crank"/><site name="pin" pos=".1 0 0"/></body></worldbody>
            <actuator><position name="push" slidersite="line" cranksite="pin" cranklength="{rod}"/></actuator></mujoco>"#
        )
    };
    let slide = |angle: f64| {
        let (x, y) = (0.1 * angle.cos(), 0.1 * angle.sin() + 0.1);
        let unit = f64::hypot(1.0, 0.5);
        let (foot, aside) = ((x + 0.5 * y) / unit, (y - 0.5 * x) / unit);
        foot - (0.08f64.powi(2) - aside * aside).sqrt()
    };
    let (_, question) = read(&text(0.08));
    assert_eq!(freedoms(&question), Some(1));
    near(value(&solved(&question), "push"), slide(0.0));
    for angle in [-0.2, -0.7] {
        let report = solved(&question.clone().hold("push", slide(angle)));
        near(value(&report, "crank"), angle);
    }
    let (imported, question) = read(&text(0.04));
    assert!(
        remarks(&imported).contains("1 element ignored: `slider-crank whose rod is too short`")
    );
    assert_eq!(question.mechanism().closures().len(), 0);
    assert!(
        refused(&text(0.08).replace("\"pin\" pos", "\"pen\" pos"))
            .contains("there is no site `pin`")
    );
}

/// A gripper of SDF says which links hold things; joints move them. It is told that it is passed over.
#[test]
fn grippers_of_sdf_are_passed_over() {
    let gripper = r#"<gripper name="g"><gripper_link>rocker</gripper_link><palm_link>crank</palm_link></gripper>"#;
    let (imported, question) = read(&sdf(&format!("{SDF_LINKS}{SDF_JOINTS}{gripper}")));
    assert!(remarks(&imported).contains("1 element ignored: `gripper`"));
    closes(&question, ["A", "B", "D"]);
}

/// What MuJoCo's and Gazebo's reader passes over, strict XML does not have: `--` in a comment.
#[test]
fn comments_may_hold_dashes() {
    let text = slider_crank("", "", 0.0);
    let with = |comment: &str| text.replacen("<worldbody>", &format!("{comment}<worldbody>"), 1);
    let plain = read(&text).0.description;
    for comment in ["<!-- ---- arm -- -->", "<!--- a --->", "<!---->"] {
        assert_eq!(read(&with(comment)).0.description, plain, "{comment}");
    }
    assert!(refused(&with("<!-- a -- ")).contains("not XML"));
}

#[test]
fn a_part_of_a_model_and_a_name_given_twice_are_refused() {
    let part = refused("<mujocoinclude/>");
    assert!(part.contains("give the file that includes it"), "{part}");
    let twice = r#"<mujoco><worldbody><body name="a"><joint/></body><body name="a"><joint/></body></worldbody></mujoco>"#;
    let twice = refused(twice);
    assert!(twice.contains("there are two bodies `a`"), "{twice}");
}

/// A four-bar of 0.1, 0.2, 0.15 and 0.2 m whose last two links lie beside each other on their pin.
fn beside(apart: f64, axis: &str) -> String {
    format!(
        r#"<mujoco><compiler angle="radian"/><worldbody>
        <body name="crank"><joint name="crank" axis="0 0 1"/>
            <body name="coupler" pos="0 0.1 0"><joint name="A" axis="0 0 1"/><site name="end" pos="0.2 0 0"/></body></body>
        <body name="rocker" pos="0.2 0 0"><joint name="D" axis="{axis}"/><site name="top" pos="0 0.15 {apart}"/></body>
        </worldbody><equality><connect name="B" site1="end" site2="top"/></equality>
        <actuator><motor joint="crank"/></actuator></mujoco>"#
    )
}

/// Plane links that lie beside each other are joined by one pin; what a motion could close, or lies far away, is as it is drawn.
#[test]
fn links_beside_each_other_are_on_one_pin() {
    let (imported, question) = read(&beside(0.002, "0 0 1"));
    assert!(remarks(&imported).contains("`B` has points up to 2 mm apart along the hinges"));
    assert_eq!(freedoms(&question), Some(1));
    // Freudenstein: coupler and rocker close the triangle over the way from crank to ground
    let report = solved(&question);
    let (x, y) = (
        0.1 * -value(&report, "crank").sin(),
        0.1 * value(&report, "crank").cos(),
    );
    let turned = value(&report, "D");
    let (u, v) = (0.2 - 0.15 * turned.sin(), 0.15 * turned.cos());
    near((u - x).hypot(v - y), 0.2);
    for (apart, axis) in [(0.002, "0 0.1 1"), (0.05, "0 0 1")] {
        let (imported, question) = read(&beside(apart, axis));
        assert!(!remarks(&imported).contains("apart"), "{apart}");
        assert!(!solved(&question).is_assembled(), "{apart} {axis}");
    }
}
